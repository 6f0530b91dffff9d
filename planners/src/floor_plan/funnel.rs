//! The shortest way through gates, as a string pulled tight (the funnel of Chazelle 1982, Lee and Preparata 1984).

use super::mesh::Gate;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, orient};

/// The points at which the shortest way through the gates bends, with its ends.
pub(super) fn funnel(from: Point, gates: &[Gate], to: Point) -> Vec<Point> {
    let all: Vec<Gate> = gates.iter().copied().chain([[to, to]]).collect();
    let mut way = vec![from];
    let (mut apex, mut left, mut right) = (from, from, from);
    let (mut left_at, mut right_at) = (0, 0);
    let mut at = 0;
    while at < all.len() {
        let [new_left, new_right] = all[at];
        if orient(apex, right, new_right) >= 0.0 {
            if apex == right || orient(apex, left, new_right) < 0.0 {
                (right, right_at) = (new_right, at);
            } else {
                at = restart(&mut way, left, left_at);
                (apex, right, right_at) = (left, left, left_at);
                continue;
            }
        }
        if orient(apex, left, new_left) <= 0.0 {
            if apex == left || orient(apex, right, new_left) > 0.0 {
                (left, left_at) = (new_left, at);
            } else {
                at = restart(&mut way, right, right_at);
                (apex, left, left_at) = (right, right, right_at);
                continue;
            }
        }
        at += 1;
    }
    way.push(to);
    straightened(way)
}

fn restart(way: &mut Vec<Point>, bend: Point, gate: usize) -> usize {
    way.push(bend);
    gate + 1
}

/// Without points that stand twice or on the straight line between their neighbours.
pub(super) fn straightened(way: Vec<Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(way.len());
    for point in way {
        if kept.last().is_some_and(|last| last.distance(point) <= ROUNDING_M) {
            continue;
        }
        while let [.., before, last] = kept[..]
            && last.distance(last.nearest_on(before, point)) <= ROUNDING_M
        {
            kept.pop();
        }
        kept.push(point);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn a_way_through_wide_gates_is_straight() {
        let gates = [[p(1.0, 1.0), p(1.0, -1.0)], [p(2.0, 1.0), p(2.0, -1.0)]];
        assert_eq!(funnel(p(0.0, 0.0), &gates, p(3.0, 0.5)), [p(0.0, 0.0), p(3.0, 0.5)]);
    }

    #[test]
    fn a_way_bends_where_gates_are_aside() {
        let gates = [[p(1.0, 3.0), p(1.0, 1.0)], [p(2.0, -1.0), p(2.0, -3.0)], [p(3.0, 3.0), p(3.0, 1.0)]];
        let bends = [p(0.0, 0.0), p(1.0, 1.0), p(2.0, -1.0), p(3.0, 1.0), p(4.0, 0.0)];
        assert_eq!(funnel(p(0.0, 0.0), &gates, p(4.0, 0.0)), bends);
    }
}
