//! How far segments keep from walls.

use crate::geometry::Point;

/// The distance between two segments, metres; 0 where they meet.
pub fn distance_between([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let side = |p: Point, q: Point, r: Point| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
        return 0.0;
    }
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    ends.into_iter().map(|(p, q, r)| p.distance(p.nearest_on(q, r))).fold(f64::INFINITY, f64::min)
}

/// The least distance of a way from any barrier, metres.
pub fn wall_distance(way: &[Point], barriers: &[[Point; 2]]) -> f64 {
    let legs = || way.windows(2).map(|leg| [leg[0], leg[1]]);
    let mut least = f64::INFINITY;
    for &barrier in barriers {
        for leg in legs() {
            if box_distance(leg, barrier) < least {
                least = least.min(distance_between(leg, barrier));
            }
        }
    }
    least
}

/// No more than the distance of the segments.
fn box_distance([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let gap = |a: f64, b: f64, c: f64, d: f64| (c.min(d) - a.max(b)).max(a.min(b) - c.max(d)).max(0.0);
    gap(a.x, b.x, c.x, d.x).max(gap(a.y, b.y, c.y, d.y))
}
