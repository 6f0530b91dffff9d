//! Walls as drawn, cut where another one ends on them, so that they meet only at their ends.

use std::collections::BTreeMap;

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::planar::Edge;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Segment};

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
///
/// # Complexity
/// O(w log w) for w walls that meet few others each.
pub(super) fn node(walls: &[[Point; 2]]) -> Result<Noded, Vec<Clash>> {
    let mut numbered = Numbered::default();
    let ends: Vec<[u32; 2]> = walls.iter().map(|&[a, b]| [numbered.number(a), numbered.number(b)]).collect();
    let points = numbered.points;
    let clashes = clashes(&points, &ends);
    if !clashes.is_empty() {
        return Err(clashes);
    }
    let standing = points.iter().enumerate().map(|(n, p)| GeomWithData::new([p.x, p.y], n as u32));
    let index = RTree::bulk_load(standing.collect());
    let (mut edges, mut wall_of) = (Vec::new(), Vec::new());
    for (wall, &[a, b]) in ends.iter().enumerate() {
        let line = [points[a as usize], points[b as usize]];
        let near = index.locate_in_envelope(around(line)).map(|point| point.data);
        let on_it = near.filter(|&n| n == a || n == b || is_on(points[n as usize], line));
        let mut stops: Vec<u32> = on_it.collect();
        let far = |n: u32| line[0].distance(points[n as usize]);
        stops.sort_by(|&m, &n| far(m).total_cmp(&far(n)).then(m.cmp(&n)));
        let direction = Edge::between(&points, a, b).direction;
        for part in stops.windows(2) {
            edges.push(Edge { ends: [part[0], part[1]], direction });
            wall_of.push(wall);
        }
    }
    Ok(Noded { points, edges, wall_of })
}

/// Points by number, found by where they are.
#[derive(Default)]
struct Numbered {
    points: Vec<Point>,
    /// Their numbers by squares of twice [`SNAP_M`], so that those closer than it lie in the same or in the next one.
    squares: BTreeMap<[i64; 2], Vec<u32>>,
}

impl Numbered {
    /// The number of the first point that was as close as [`SNAP_M`]; a new one where there is none.
    fn number(&mut self, p: Point) -> u32 {
        let [x, y] = [p.x, p.y].map(|v| (v / (2.0 * SNAP_M)).floor() as i64);
        let about = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let near = about.filter_map(|square| self.squares.get(&square)).flatten().copied();
        let known = near.filter(|&n| self.points[n as usize].distance(p) <= SNAP_M).min();
        known.unwrap_or_else(|| {
            let new = self.points.len() as u32;
            self.points.push(p);
            self.squares.entry([x, y]).or_default().push(new);
            new
        })
    }
}

/// The box about a wall, with what may be as good as on it.
fn around([a, b]: [Point; 2]) -> AABB<[f64; 2]> {
    AABB::from_corners(
        [a.x.min(b.x) - SNAP_M, a.y.min(b.y) - SNAP_M],
        [a.x.max(b.x) + SNAP_M, a.y.max(b.y) + SNAP_M],
    )
}

fn is_on(p: Point, [a, b]: [Point; 2]) -> bool {
    p.distance(p.nearest_on(a, b)) <= SNAP_M
}

fn clashes(points: &[Point], ends: &[[u32; 2]]) -> Vec<Clash> {
    let line = |wall: usize| ends[wall].map(|n| points[n as usize]);
    let boxed = (0..ends.len()).map(|wall| {
        let [a, b] = line(wall).map(|p| [p.x, p.y]);
        GeomWithData::new(Rectangle::from_corners(a, b), wall)
    });
    let index = RTree::bulk_load(boxed.collect());
    let mut found = Vec::new();
    for i in 0..ends.len() {
        let first = line(i);
        let near = index.locate_in_envelope_intersecting(around(first)).map(|wall| wall.data);
        let mut others: Vec<usize> = near.filter(|&j| j > i).collect();
        others.sort_unstable();
        for j in others {
            let second = line(j);
            if let Some(at) = crossing(first, second) {
                found.push(Clash::Cross { walls: [i, j], at });
            } else if do_overlap(first, second) {
                found.push(Clash::Overlap { walls: [i, j] });
            }
        }
    }
    found
}

/// Where two segments cross, if at no end of either.
pub(super) fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<Point> {
    let ends_apart = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])].iter().all(|&(p, s)| !is_on(p, s));
    let crossing = || Segment::new(c, d).crossing(&Segment::new(a, b));
    if ends_apart { crossing() } else { None }
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
