//! A face of the plan that is not convex: its walls, and the corners at which it has to be cut.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::planar::Planar;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, RayGrid, Segment, cross};
use crate::search::Csr;

/// Angles that differ by less count as equal, radians.
pub(super) const ANGLE: f64 = 1e-7;

/// Directions past a bound by less than this sine are looked at closely: more than rounding and [`ANGLE`] make of one.
const NEARLY: f64 = 1e-5;

/// A wall of a face, and on which sides of it the face lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub ends: [u32; 2],
    /// The edge of the plan that this is.
    pub edge: u32,
    pub direction: Point,
    /// Whether the face lies left, and right.
    pub free: [bool; 2],
}

/// A reflex vertex: more than half a turn of free space, from the direction `from` counterclockwise.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    pub node: u32,
    /// Directions that bound the free space: at 0 and at its whole angle.
    pub bounds: [(f64, Point); 2],
    /// Directions in which a cut may be good: to the nodes that are seen from here, and where a cut to both sides is
    /// halved by the corner, which makes what it cuts off least or most.
    pub sights: Vec<Sight>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub direction: Point,
    pub node: Option<u32>,
    /// The corner that a cut along it resolves as well as this one.
    pub resolves: Option<u32>,
}

/// A face to be cut into convex regions.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pub points: Vec<Point>,
    /// The node of the plan that each point is.
    pub nodes: Vec<u32>,
    pub sides: Vec<Side>,
    pub corners: Vec<Corner>,
    /// The sides, found by what is looked across.
    grid: RayGrid,
}

/// The angle from one direction counterclockwise to another, 0 to a whole turn.
pub(super) fn angle(from: Point, to: Point) -> f64 {
    let turned = (from.cross(to)).atan2(from.dot(to));
    if turned < 0.0 { turned + TAU } else { turned }
}

impl Corner {
    /// Where a direction lies in the free space of this corner; `None` where it does not.
    pub fn place(&self, direction: Point) -> Option<f64> {
        let turned = angle(self.bounds[0].1, direction);
        (ANGLE < turned && turned < self.bounds[1].0 - ANGLE).then_some(turned)
    }

    /// Tells most directions quickly that do not resolve: of what it lets pass, some do not either.
    fn may_be_resolved_along(&self, d: Point) -> bool {
        let [(_, from), (_, to)] = self.bounds;
        let slack = -NEARLY * d.length();
        let left = |a: Point, b: Point, length: Point| a.cross(b) >= slack * length.length();
        left(from, d, from) && left(d, to, to)
    }

    /// Whether a cut in this direction alone leaves no more than half a turn on either side.
    fn is_resolved_by(&self, turned: f64) -> bool {
        turned <= PI + ANGLE && self.bounds[1].0 - turned <= PI + ANGLE
    }
}

/// Pairs of walls are looked at from each corner of a face with no more sides: a scanned map has thousands, and its largest
/// region hardly grows by it.
const MOST_SIDES: usize = 160;

/// So many pairs of a corner and a point of a face are looked at.
const MOST_SEEN: usize = 500_000;

impl Face {
    /// The face of which these are the outlines.
    pub fn new(plan: &Planar, cycles: &[u32]) -> Self {
        let mut nodes: Vec<u32> =
            cycles.iter().flat_map(|&c| plan.along(c)).map(|half| plan.tail(half)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let local = |node: u32| nodes.binary_search(&node).expect("every node was listed") as u32;
        let mut halves: Vec<u32> = cycles.iter().flat_map(|&c| plan.along(c)).collect();
        let corners = halves.iter().filter_map(|&half| corner(plan, half, &local)).collect();
        halves.sort_unstable();
        let has = |half: u32| halves.binary_search(&half).is_ok();
        let mut edges: Vec<u32> = halves.iter().map(|half| half / 2).collect();
        edges.dedup();
        let side = |&edge: &u32| Side {
            ends: plan.edges[edge as usize].ends.map(local),
            edge,
            direction: plan.edges[edge as usize].direction,
            free: [has(2 * edge), has(2 * edge + 1)],
        };
        let sides: Vec<Side> = edges.iter().map(side).collect();
        let points: Vec<Point> = nodes.iter().map(|&node| plan.points[node as usize]).collect();
        let line = |side: &Side| Segment::from(side.ends.map(|node| points[node as usize]));
        let grid = RayGrid::new(sides.iter().map(line).collect());
        Self { points, nodes, sides, corners, grid }
    }

    /// Pairs of corners that see and resolve one another.
    ///
    /// # Arguments
    /// `near` has for each point others near it: of a large face these alone are looked at.
    pub fn chords(&self, near: Option<&Csr<u32>>) -> Vec<[u32; 2]> {
        let corner_at = self.corner_at();
        let of = |first: usize| {
            let a = &self.corners[first];
            let others = self.worth_a_look(a, near).into_iter().filter_map(|node| corner_at[node as usize]);
            let seen = others.filter(|&second| {
                let b = &self.corners[second as usize];
                let (p, q) = (self.points[a.node as usize], self.points[b.node as usize]);
                let there = q - p;
                let back = -there;
                second as usize > first
                    && a.may_be_resolved_along(there)
                    && b.may_be_resolved_along(back)
                    && a.place(there).is_some_and(|angle| a.is_resolved_by(angle))
                    && b.place(back).is_some_and(|angle| b.is_resolved_by(angle))
                    && self.is_seen(a.node, b.node)
            });
            let mut seen: Vec<u32> = seen.collect();
            seen.sort_unstable();
            seen.into_iter().map(move |second| [first as u32, second])
        };
        (0..self.corners.len()).into_par_iter().flat_map_iter(of).collect()
    }

    /// For each point the corner that it is.
    pub fn corner_at(&self) -> Vec<Option<u32>> {
        let mut corner_at = vec![None; self.points.len()];
        for (number, corner) in (0..).zip(&self.corners) {
            corner_at[corner.node as usize] = Some(number);
        }
        corner_at
    }

    /// Whether one cut may resolve two corners: some that pass do not see one another.
    pub fn may_be_joined(&self, [one, other]: [u32; 2]) -> bool {
        let [one, other] = [one, other].map(|corner| &self.corners[corner as usize]);
        let there = self.points[other.node as usize] - self.points[one.node as usize];
        one.may_be_resolved_along(there) && other.may_be_resolved_along(-there)
    }

    /// Whether the straight way between two points meets no wall but at its ends.
    fn is_seen(&self, from: u32, to: u32) -> bool {
        let (p, q) = (self.points[from as usize], self.points[to as usize]);
        let length = p.distance(q);
        let is_between = |node: usize| {
            let r = self.points[node];
            cross(p, q, r).abs() <= ROUNDING_M * length
                && (r - p).dot(q - p) > 0.0
                && (r - q).dot(p - q) > 0.0
        };
        let way = Segment::new(p, q);
        // each node is an end of a side
        self.grid.beside(way).all(|side| {
            let ends = self.sides[side].ends;
            let is_own = |node: &u32| *node == from || *node == to;
            ends.iter().all(|node| is_own(node) || !is_between(*node as usize))
                && (ends.iter().any(is_own) || !way.crosses(&self.line(ends)))
        })
    }

    /// Whether there are so many corners and points that not each is looked at from each.
    pub fn is_large(&self) -> bool {
        self.corners.len() * self.points.len() > MOST_SEEN
    }

    /// Finds the sights of all corners.
    ///
    /// # Arguments
    /// `near` has for each point others near it: of a large face these alone are looked at.
    pub fn look_around(&mut self, near: Option<&Csr<u32>>) {
        let corner_at = self.corner_at();
        let look = |corner: &Corner| {
            let from = self.points[corner.node as usize];
            let mut sights = Vec::new();
            for node in self.worth_a_look(corner, near) {
                let direction = self.points[node as usize] - from;
                let Some(angle) = corner.place(direction).filter(|_| node != corner.node) else { continue };
                if self.is_seen(corner.node, node) {
                    let back = -direction;
                    let is_resolved = |other: u32| {
                        let other = &self.corners[other as usize];
                        other.place(back).is_some_and(|angle| other.is_resolved_by(angle))
                    };
                    let resolves = corner_at[node as usize]
                        .filter(|&other| corner.is_resolved_by(angle) && is_resolved(other));
                    sights.push(Sight { direction, node: Some(node), resolves });
                }
            }
            sights.extend(self.halved(corner).into_iter().map(|direction| Sight {
                direction,
                node: None,
                resolves: None,
            }));
            sights
        };
        let sights: Vec<Vec<Sight>> = self.corners.par_iter().map(look).collect();
        for (corner, sights) in self.corners.iter_mut().zip(sights) {
            corner.sights = sights;
        }
    }

    fn worth_a_look(&self, corner: &Corner, near: Option<&Csr<u32>>) -> Vec<u32> {
        near.map_or_else(
            || (0..self.points.len() as u32).collect(),
            |near| near.of(corner.node as usize).to_vec(),
        )
    }

    /// Whether cuts between two pairs of corners cross, or have a corner in common.
    pub fn do_hinder(&self, one: [u32; 2], other: [u32; 2]) -> bool {
        one.iter().any(|corner| other.contains(corner)) || self.between(one).crosses(&self.between(other))
    }

    /// The cut between two corners.
    pub fn between(&self, corners: [u32; 2]) -> Segment {
        self.line(corners.map(|corner| self.corners[corner as usize].node))
    }

    fn line(&self, ends: [u32; 2]) -> Segment {
        Segment::from(ends.map(|n| self.points[n as usize]))
    }

    /// The directions in which a line from wall to wall is halved by a corner; none in a face of very many walls.
    fn halved(&self, corner: &Corner) -> Vec<Point> {
        if self.sides.len() > MOST_SIDES {
            return Vec::new();
        }
        let centre = self.points[corner.node as usize];
        let walls = self.sides.iter().filter(|side| !side.ends.contains(&corner.node));
        let walls: Vec<Segment> = walls.map(|side| self.line(side.ends)).collect();
        let mirrored = |p: Point| Point::new(2.0 * centre.x - p.x, 2.0 * centre.y - p.y);
        let mut directions = Vec::new();
        for (i, &wall) in walls.iter().enumerate() {
            for &other in &walls[..i] {
                let image = Segment::new(mirrored(other.a), mirrored(other.b));
                let Some(at) = wall.crossing(&image) else { continue };
                let there = at - centre;
                let back = -there;
                let is_clear = |to: Point, ends_on: Segment| {
                    let sight = Segment::new(centre, to);
                    !walls.iter().any(|wall| *wall != ends_on && wall.crosses(&sight))
                };
                let lies_free = corner.place(there).is_some() && corner.place(back).is_some();
                if lies_free && is_clear(at, wall) && is_clear(mirrored(at), other) {
                    directions.push(there);
                }
            }
        }
        directions
    }
}

/// The corner at the end of a half-edge, where there is more than half a turn to its left.
fn corner(plan: &Planar, half: u32, local: &impl Fn(u32) -> u32) -> Option<Corner> {
    let onward = plan.next[half as usize];
    let (from, to) = (plan.direction(onward), plan.direction(half ^ 1));
    let whole = if onward == half ^ 1 { TAU } else { angle(from, to) };
    (whole > PI + ANGLE).then(|| Corner {
        node: local(plan.head(half)),
        bounds: [(0.0, from), (whole, to)],
        sights: Vec::new(),
    })
}
