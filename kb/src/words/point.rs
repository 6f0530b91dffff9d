//! Points as people write them.

use adit_planners::geometry::Point;

/// `x,y`, metres; `None` where it is anything else, or no finite numbers.
pub fn point(text: &str) -> Option<Point> {
    let (x, y) = text.split_once(',')?;
    let (x, y): (f64, f64) = (x.trim().parse().ok()?, y.trim().parse().ok()?);
    (x.is_finite() && y.is_finite()).then(|| Point::new(x, y))
}
