//! Where spaces meet.

use std::collections::BTreeMap;

use petgraph::unionfind::UnionFind;

use super::record::Doorway;
use crate::geometry::{Point, Segment};
use crate::world::Occupancy;

/// Parts of the border of two spaces so near to each other are one, metres: a table's leg may stand between.
const ONE_M: f64 = 0.3;

/// What is narrower is no doorway, metres.
const LEAST_M: f64 = 0.2;

/// An opening so near to the border that follows from it is where people see the doorway, metres.
const NEAR_M: f64 = 0.5;

/// The doorways between spaces, by their spaces and then from below.
///
/// # Arguments
/// `openings` in cells.
pub(super) fn doorways(floor: &Occupancy, of_cell: &[u32], openings: &[Segment]) -> Vec<Doorway> {
    let mut borders: BTreeMap<(u32, u32), Vec<Point>> = BTreeMap::new();
    let middle =
        |cell: usize| Point::new((cell % floor.columns) as f64 + 0.5, (cell / floor.columns) as f64 + 0.5);
    for (cell, &space) in of_cell.iter().enumerate().filter(|(_, space)| **space > 0) {
        // a floor has a rim of solid cells
        for next in [cell + 1, cell + floor.columns] {
            let other = of_cell[next];
            if other > 0 && other != space {
                let pair = (space.min(other), space.max(other));
                borders.entry(pair).or_default().push(middle(cell).midpoint(middle(next)));
            }
        }
    }
    let mut doorways = Vec::new();
    for ((one, other), border) in borders {
        for part in parts(&border, ONE_M / floor.resolution) {
            let segment = across(&part);
            if (segment.length() + 1.0) * floor.resolution < LEAST_M {
                continue;
            }
            let near = |opening: &&Segment| {
                let off = opening.distance(segment.middle()).max(segment.distance(opening.middle()));
                off * floor.resolution <= NEAR_M
            };
            let seen = openings.iter().find(near).copied().unwrap_or(segment);
            let metres = |p: Point| {
                let (x, y) = (p.x * floor.resolution, p.y * floor.resolution);
                Point::new(floor.origin.x + x, floor.origin.y + y)
            };
            let segment = Segment::new(metres(seen.a), metres(seen.b));
            let spaces = [one as usize - 1, other as usize - 1];
            doorways.push(Doorway { spaces, segment, named: None });
        }
    }
    doorways
}

/// Points parted where they lie further from each other.
fn parts(points: &[Point], near: f64) -> Vec<Vec<Point>> {
    let mut sets = UnionFind::<usize>::new(points.len());
    let mut squares: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    let square = |p: Point| ((p.x / near).floor() as i64, (p.y / near).floor() as i64);
    for (number, &point) in points.iter().enumerate() {
        let (x, y) = square(point);
        for place in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))) {
            for &other in squares.get(&place).into_iter().flatten() {
                if points[other].distance(point) <= near {
                    sets.union(number, other);
                }
            }
        }
        squares.entry((x, y)).or_default().push(number);
    }
    let mut parts: BTreeMap<usize, Vec<Point>> = BTreeMap::new();
    for (number, &point) in points.iter().enumerate() {
        parts.entry(sets.find_mut(number)).or_default().push(point);
    }
    parts.into_values().collect()
}

/// The line between the two points of a border that are furthest apart, as far as two looks tell.
fn across(border: &[Point]) -> Segment {
    let furthest = |from: Point| {
        let far = |p: &&Point| from.squared_distance(**p);
        border.iter().max_by(|a, b| far(a).total_cmp(&far(b))).copied().unwrap_or(from)
    };
    let one = furthest(border[0]);
    Segment::new(one, furthest(one))
}
