//! Walls as they were seen, made to meet: a scan leaves out the corners between them.

use crate::geometry::Point;
use crate::segment::Segment;

/// An end is lengthened by up to so much until it meets another wall, metres.
const LONGER_M: f64 = 0.3;

/// Walls that meet at a smaller angle have no corner (its sine).
const CORNER: f64 = 0.3;

/// Ends nearer than this are one, metres.
const SNAP_M: f64 = 1e-6;

/// The same walls with their ends lengthened to where they meet others, and with links across what gaps are left.
pub(super) fn joined(walls: &[Segment]) -> Vec<Segment> {
    let others = |index: usize| walls.iter().enumerate().filter(move |(other, _)| *other != index);
    let mut joined = walls.to_vec();
    for (index, wall) in walls.iter().enumerate() {
        let along = wall.direction();
        let longer = |end: Point, sign: f64| {
            let out = Point::new(sign * along.x, sign * along.y);
            let corners = others(index).filter_map(|(_, other)| corner(end, out, other));
            let nearest = corners.min_by(f64::total_cmp).unwrap_or(0.0);
            Point::new(end.x + nearest * out.x, end.y + nearest * out.y)
        };
        joined[index] = Segment::new(longer(wall.a, -1.0), longer(wall.b, 1.0));
    }
    let links: Vec<Segment> = (0..joined.len()).flat_map(|index| links(&joined, index)).collect();
    joined.extend(links);
    joined
}

/// By how much an end has to be lengthened to meet another wall, or where that will be when it is lengthened, too.
fn corner(end: Point, out: Point, other: &Segment) -> Option<f64> {
    let along = other.direction();
    let sine = out.x * along.y - out.y * along.x;
    if sine.abs() < CORNER {
        return None;
    }
    let to = Point::new(other.a.x - end.x, other.a.y - end.y);
    let longer = (to.x * along.y - to.y * along.x) / sine;
    let place = (to.x * out.y - to.y * out.x) / sine;
    let is_on = (-LONGER_M..=other.length() + LONGER_M).contains(&place);
    (is_on && (0.0..=LONGER_M).contains(&longer)).then_some(longer)
}

/// From the ends of a wall that lie on no other one to what is nearest, where that is near.
fn links(walls: &[Segment], index: usize) -> Vec<Segment> {
    let link = |end: Point| {
        let others = walls.iter().enumerate().filter(|(other, _)| *other != index);
        let near = others.map(|(_, other)| end.nearest_on(other.a, other.b));
        let nearest = near.min_by(|a, b| a.distance(end).total_cmp(&b.distance(end)))?;
        (SNAP_M..=LONGER_M).contains(&nearest.distance(end)).then(|| Segment::new(end, nearest))
    };
    [walls[index].a, walls[index].b].into_iter().filter_map(link).collect()
}
