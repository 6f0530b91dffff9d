//! Dents of free space, filled: no shortest way of a state leads through one, and each costs a room or two.

use std::collections::VecDeque;

use rstar::{AABB, RTree};

use super::grown::Rings;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Rect, Segment, cross};

/// Free space without dents up to so many metres deep. What is taken lies straight beyond a side of what is left, in sight
/// of all of it, so that no passage becomes narrower than what it joins.
pub(super) fn without_dents(free: &Rings, deep_m: f64) -> Rings {
    let corners = free.iter().flatten().map(|corner| [corner.x, corner.y]);
    let index = RTree::bulk_load(corners.collect());
    free.iter().map(|ring| filled(ring, &index, deep_m)).collect()
}

fn filled(ring: &[Point], all: &RTree<[f64; 2]>, deep_m: f64) -> Vec<Point> {
    let count = ring.len();
    let mut after: Vec<usize> = (1..=count).map(|next| next % count).collect();
    let mut before: Vec<usize> = (0..count).map(|at| (at + count - 1) % count).collect();
    // what was taken between a corner and the one after it
    let mut taken: Vec<Vec<Point>> = vec![Vec::new(); count];
    let mut is_left = vec![true; count];
    let mut left = count;
    let mut open: VecDeque<usize> = (0..count).collect();
    while let Some(at) = open.pop_front().filter(|_| left > 3) {
        if !is_left[at] {
            continue;
        }
        let (from, to) = (before[at], after[at]);
        let [a, c, b] = [from, at, to].map(|corner| ring[corner]);
        let side = Segment::new(a, b);
        let between = || taken[from].iter().chain(&taken[at]).chain([&c]);
        let is_dent = cross(a, c, b) > 0.0
            && side.length() > SNAP_M
            && between().all(|&corner| side.distance(corner) <= deep_m)
            && is_empty([a, c, b], all);
        if is_dent {
            let between = between().copied().collect();
            taken[from] = between;
            (after[from], before[to], is_left[at]) = (to, from, false);
            left -= 1;
            open.extend([from, to]);
        }
    }
    (0..count).filter(|&at| is_left[at]).map(|at| ring[at]).collect()
}

/// Whether no other corner lies in a triangle, or as near to it as a rounding.
fn is_empty(corners: [Point; 3], all: &RTree<[f64; 2]>) -> bool {
    let Rect { x0, y0, x1, y1 } = Rect::around(corners).grown(SNAP_M);
    let [a, c, b] = corners;
    let sides = [(a, c), (c, b), (b, a)];
    let is_in = |p: Point| sides.iter().all(|&(from, to)| cross(from, to, p) >= -SNAP_M * from.distance(to));
    let mut near =
        all.locate_in_envelope(AABB::from_corners([x0, y0], [x1, y1])).map(|&[x, y]| Point::new(x, y));
    !near.any(|p| !corners.contains(&p) && is_in(p))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::geometry::polygon::{encloses, sides};

    const DEEP_M: f64 = 0.1;

    /// A ring with spokes of so many lengths.
    fn ring() -> impl Strategy<Value = Vec<Point>> {
        prop::collection::vec(0.8f64..1.0, 5..40).prop_map(|spokes| {
            let turn = TAU / spokes.len() as f64;
            (0..).zip(spokes).map(|(number, long)| Point::towards(turn * f64::from(number)) * long).collect()
        })
    }

    proptest! {
        #[test]
        fn only_what_is_shallow_is_taken_and_no_shortest_way_leads_through_it(
            outer in ring(), inner in ring(), points in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0), 60)
        ) {
            // a ring of five spokes is no wider than 0.647 between them
            let hole = inner.iter().rev().map(|&corner| corner * 0.6).collect();
            let free = vec![outer, hole];
            let left = without_dents(&free, DEEP_M);
            let is_in = |rings: &Rings, p| encloses(rings.iter().flat_map(|ring| sides(ring)), p);
            for p in points.into_iter().map(|(x, y)| Point::new(x, y)) {
                let near = free.iter().flat_map(|ring| sides(ring)).map(|side| side.distance(p));
                let near = near.fold(f64::INFINITY, f64::min);
                prop_assert!(!is_in(&left, p) || is_in(&free, p) || near < 1e-9, "{p:?} is new");
                prop_assert!(is_in(&left, p) || !is_in(&free, p) || near <= DEEP_M, "{p:?} is {near} deep");
            }
            for (before, after) in free.iter().zip(&left) {
                let turns_right = |ring: &[Point]| -> Vec<Point> {
                    let count = ring.len();
                    let corners = (0..count).map(|at| [ring[at], ring[(at + 1) % count], ring[(at + 2) % count]]);
                    corners.filter(|[a, b, c]| cross(*a, *b, *c) < 0.0).map(|[_, b, _]| b).collect()
                };
                // ways bend about what juts out
                prop_assert!(turns_right(after).iter().all(|corner| turns_right(before).contains(corner)));
                prop_assert!(after.iter().all(|corner| before.contains(corner)));
            }
        }
    }
}
