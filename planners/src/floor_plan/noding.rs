//! Walls as drawn, cut where another one ends on them, so that they meet only at their ends.

use super::planar::Edge;
use crate::geometry::Point;

/// Points closer than this are one, metres.
pub(super) const SNAP_M: f64 = 1e-6;

/// How two walls must not meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Clash {
    /// They cross at a point that is an end of neither.
    Cross { walls: [usize; 2], at: Point },
    /// They lie on one another.
    Overlap { walls: [usize; 2] },
}

/// Walls that meet only at ends.
#[derive(Clone, Debug, Default)]
pub(super) struct Noded {
    pub points: Vec<Point>,
    pub edges: Vec<Edge>,
    /// For each edge the wall that it is a part of.
    pub wall_of: Vec<usize>,
}

/// Cuts walls where others end on them.
pub(super) fn node(walls: &[[Point; 2]]) -> Result<Noded, Vec<Clash>> {
    let mut points: Vec<Point> = Vec::new();
    let mut number = |p: Point| {
        let known = points.iter().position(|q| q.distance(p) <= SNAP_M);
        known.unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    let ends: Vec<[u32; 2]> = walls.iter().map(|&[a, b]| [number(a), number(b)]).collect();
    let clashes = clashes(&points, &ends);
    if !clashes.is_empty() {
        return Err(clashes);
    }
    let (mut edges, mut wall_of) = (Vec::new(), Vec::new());
    for (wall, &[a, b]) in ends.iter().enumerate() {
        let on_it = (0..points.len() as u32).filter(|&n| {
            n == a || n == b || is_on(points[n as usize], [points[a as usize], points[b as usize]])
        });
        let mut stops: Vec<u32> = on_it.collect();
        let start = points[a as usize];
        stops.sort_by(|&m, &n| {
            start.distance(points[m as usize]).total_cmp(&start.distance(points[n as usize]))
        });
        let direction = Edge::between(&points, a, b).direction;
        for part in stops.windows(2) {
            edges.push(Edge { ends: [part[0], part[1]], direction });
            wall_of.push(wall);
        }
    }
    Ok(Noded { points, edges, wall_of })
}

fn is_on(p: Point, [a, b]: [Point; 2]) -> bool {
    p.distance(p.nearest_on(a, b)) <= SNAP_M
}

fn clashes(points: &[Point], ends: &[[u32; 2]]) -> Vec<Clash> {
    let line = |wall: usize| ends[wall].map(|n| points[n as usize]);
    let mut found = Vec::new();
    for i in 0..ends.len() {
        for j in i + 1..ends.len() {
            let (first, second) = (line(i), line(j));
            if !do_boxes_meet(first, second) {
                continue;
            }
            if let Some(at) = crossing(first, second) {
                found.push(Clash::Cross { walls: [i, j], at });
            } else if do_overlap(first, second) {
                found.push(Clash::Overlap { walls: [i, j] });
            }
        }
    }
    found
}

fn do_boxes_meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    a.x.min(b.x) <= c.x.max(d.x) + SNAP_M
        && c.x.min(d.x) <= a.x.max(b.x) + SNAP_M
        && a.y.min(b.y) <= c.y.max(d.y) + SNAP_M
        && c.y.min(d.y) <= a.y.max(b.y) + SNAP_M
}

/// Where two segments cross, if at no end of either.
pub(super) fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<Point> {
    let ends_apart = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])].iter().all(|&(p, s)| !is_on(p, s));
    let side = |p: Point, q: Point, r: Point| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    let (c_side, d_side) = (side(a, b, c), side(a, b, d));
    let crosses = c_side * d_side < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    let share = c_side / (c_side - d_side);
    (ends_apart && crosses).then(|| Point::new(c.x + share * (d.x - c.x), c.y + share * (d.y - c.y)))
}

/// Whether two segments have a part of some length in common: two points that are ends, apart, and on both.
fn do_overlap(first: [Point; 2], second: [Point; 2]) -> bool {
    let common: Vec<Point> = first
        .into_iter()
        .filter(|&p| is_on(p, second))
        .chain(second.into_iter().filter(|&p| is_on(p, first)))
        .collect();
    common.iter().any(|p| common.iter().any(|q| p.distance(*q) > 2.0 * SNAP_M))
}
