//! Walls as they were seen, made to meet: a scan leaves out the corners between them.

use super::grid::GRAIN_M;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Segment};

/// An end is lengthened by up to so much until it meets another wall, metres.
const LONGER_M: f64 = 0.3;

/// Walls nearer to one another than this are joined at whatever end comes so near, metres: cells of the grid that touch may
/// be so far apart, and what the grid takes for closed has to be closed.
const CLOSED_M: f64 = 3.0 * GRAIN_M;

/// Walls that meet at a smaller angle have no corner (its sine).
const CORNER: f64 = 0.3;

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
            end + out * nearest
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
    let sine = out.cross(along);
    if sine.abs() < CORNER {
        return None;
    }
    let to = other.a - end;
    let longer = (to.cross(along)) / sine;
    let place = (to.cross(out)) / sine;
    let is_on = (-LONGER_M..=other.length() + LONGER_M).contains(&place);
    (is_on && (0.0..=LONGER_M).contains(&longer)).then_some(longer)
}

/// From the ends of a wall to every other one that is next to them, and to the nearest one where that is not far.
fn links(walls: &[Segment], index: usize) -> Vec<Segment> {
    let mut links = Vec::new();
    for end in [walls[index].a, walls[index].b] {
        let others = walls.iter().enumerate().filter(|(other, _)| *other != index);
        let mut feet: Vec<Point> = others.map(|(_, other)| end.nearest_on(other.a, other.b)).collect();
        feet.sort_by(|a, b| a.distance(end).total_cmp(&b.distance(end)));
        let next = feet
            .iter()
            .enumerate()
            .take_while(|(place, foot)| foot.distance(end) <= if *place == 0 { LONGER_M } else { CLOSED_M });
        let apart = next.filter(|(_, foot)| foot.distance(end) > SNAP_M);
        links.extend(apart.map(|(_, foot)| Segment::new(end, *foot)));
    }
    links
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_beside_another_of_the_same_wall_is_joined_with_the_corner_as_well() {
        // A wall that was seen as two, beside one another, and a short way off the end of both another wall along it.
        let line = |x0, y0, x1, y1| Segment::new(Point::new(x0, y0), Point::new(x1, y1));
        let walls = [line(0.0, 0.0, 2.0, 0.0), line(1.0, 0.01, 2.0, 0.01), line(2.1, 0.02, 4.0, 0.02)];
        let joined = joined(&walls);
        let is_joined = |a: Point, b: Point| joined.contains(&Segment::new(a, b));
        assert!(is_joined(walls[0].b, walls[1].b) && is_joined(walls[0].b, walls[2].a), "{joined:?}");
    }
}
