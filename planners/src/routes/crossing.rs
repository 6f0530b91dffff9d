//! Where a door may be crossed.

use crate::geometry::{Point, Rect};

/// A crossing shorter than this share of the way to it has one point.
const NEGLIGIBLE: f64 = 0.05;

/// Points of a crossing that are worth going to from `from`: the nearest, its corners and the middles of its sides.
/// A segment has two corners and one middle.
pub(super) fn points(crossing: &Rect, from: Point) -> impl Iterator<Item = Point> {
    let nearest = crossing.nearest_to(from);
    let size = crossing.dx().hypot(crossing.dy());
    let middle = crossing.centre();
    let (xs, ys) = ([crossing.x0, middle.x, crossing.x1], [crossing.y0, middle.y, crossing.y1]);
    let is_area = crossing.dx() > 0.0 && crossing.dy() > 0.0;
    let grid = (0..3).flat_map(move |i| (0..3).map(move |j| (i, j)));
    let more = grid
        .filter(move |&(i, j)| match (is_area, crossing.dx() > 0.0) {
            (true, _) => (i, j) != (1, 1),
            (false, true) => j == 0,
            (false, false) => i == 0,
        })
        .map(move |(i, j)| Point::new(xs[i], ys[j]))
        .filter(move |point| *point != nearest);
    let wanted = size > NEGLIGIBLE * from.distance(nearest);
    std::iter::once(nearest).chain(more.take(if wanted { 9 } else { 0 }))
}
