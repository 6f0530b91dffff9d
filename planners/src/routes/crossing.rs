//! Where a door may be crossed.

use crate::geometry::{Point, Rect};

/// Points of a crossing that are worth going to from `from`, the nearest first: of a segment its ends, too; of an
/// area the nearest point of each side, so that what is straight ahead is reached straight.
pub(super) fn points(crossing: &Rect, from: Point) -> impl Iterator<Item = Point> {
    let Rect { x0, y0, x1, y1 } = *crossing;
    let nearest = crossing.nearest_to(from);
    let more = if x0 < x1 && y0 < y1 {
        [
            Point::new(x0, nearest.y),
            Point::new(x1, nearest.y),
            Point::new(nearest.x, y0),
            Point::new(nearest.x, y1),
        ]
    } else {
        [Point::new(x0, y0), Point::new(x1, y1), nearest, nearest]
    };
    std::iter::once(nearest).chain(more.into_iter().filter(move |point| *point != nearest))
}
