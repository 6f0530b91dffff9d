//! A face of the plan that is not convex: its walls, and the corners at which it has to be cut.

use std::f64::consts::{PI, TAU};

use super::planar::Planar;
use crate::geometry::Point;

/// Angles that differ by less count as equal, radians.
pub(super) const ANGLE: f64 = 1e-7;

/// A wall of a hall, and on which sides of it the hall lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub ends: [u32; 2],
    /// The edge of the plan that this is.
    pub edge: u32,
    pub direction: Point,
    /// Whether the hall lies left, and right.
    pub free: [bool; 2],
}

/// A corner with more than half a turn of free space, from the direction `from` counterclockwise.
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
    /// The node that is seen.
    pub node: Option<u32>,
    /// The corner that a cut along it mends as well as this one.
    pub mends: Option<u32>,
}

/// A face to be cut into convex regions.
#[derive(Clone, Debug)]
pub(super) struct Hall {
    pub points: Vec<Point>,
    /// The node of the plan that each point is.
    pub nodes: Vec<u32>,
    pub sides: Vec<Side>,
    pub corners: Vec<Corner>,
}

/// The angle from one direction counterclockwise to another, 0 to a whole turn.
pub(super) fn angle(from: Point, to: Point) -> f64 {
    let turned = (from.x * to.y - from.y * to.x).atan2(from.x * to.x + from.y * to.y);
    if turned < 0.0 { turned + TAU } else { turned }
}

impl Corner {
    /// Where a direction lies in the free space of this corner; `None` where it does not.
    pub fn place(&self, direction: Point) -> Option<f64> {
        let turned = angle(self.bounds[0].1, direction);
        (ANGLE < turned && turned < self.bounds[1].0 - ANGLE).then_some(turned)
    }

    /// Tells most directions quickly that do not mend: of what it lets pass, some do not either.
    fn may_be_mended_along(&self, d: Point) -> bool {
        let [(_, from), (_, to)] = self.bounds;
        let slack = -1e-5 * d.x.hypot(d.y);
        let left =
            |a: Point, b: Point, length: Point| a.x * b.y - a.y * b.x >= slack * length.x.hypot(length.y);
        left(from, d, from) && left(d, to, to)
    }

    /// Whether a cut in this direction alone leaves no more than half a turn on either side.
    fn is_mended_by(&self, turned: f64) -> bool {
        turned <= PI + ANGLE && self.bounds[1].0 - turned <= PI + ANGLE
    }
}

/// Pairs of walls are looked at from each corner of a hall with no more sides: a scanned map has thousands, and its largest
/// region hardly grows by it.
const MOST_SIDES: usize = 160;

impl Hall {
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
        let sides = edges.iter().map(side).collect();
        let points = nodes.iter().map(|&node| plan.points[node as usize]).collect();
        Self { points, nodes, sides, corners }
    }

    /// Pairs of corners that see and mend one another.
    pub fn chords(&self) -> Vec<[u32; 2]> {
        let mut chords = Vec::new();
        for (first, a) in (0_u32..).zip(&self.corners) {
            for (second, b) in (0_u32..).zip(&self.corners).skip(first as usize + 1) {
                let (p, q) = (self.points[a.node as usize], self.points[b.node as usize]);
                let there = Point::new(q.x - p.x, q.y - p.y);
                let back = Point::new(-there.x, -there.y);
                if a.may_be_mended_along(there)
                    && b.may_be_mended_along(back)
                    && a.place(there).is_some_and(|angle| a.is_mended_by(angle))
                    && b.place(back).is_some_and(|angle| b.is_mended_by(angle))
                    && self.is_seen(a.node, b.node)
                {
                    chords.push([first, second]);
                }
            }
        }
        chords
    }

    /// Whether the straight way between two points meets no wall but at its ends.
    fn is_seen(&self, from: u32, to: u32) -> bool {
        let (p, q) = (self.points[from as usize], self.points[to as usize]);
        let length = p.distance(q);
        let cross = |a: Point, b: Point, c: Point| (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        let is_between = |node: usize| {
            let r = self.points[node];
            cross(p, q, r).abs() <= super::layout::NEAR_M * length
                && (r.x - p.x) * (q.x - p.x) + (r.y - p.y) * (q.y - p.y) > 0.0
                && (r.x - q.x) * (p.x - q.x) + (r.y - q.y) * (p.y - q.y) > 0.0
        };
        let ends = [from as usize, to as usize];
        let is_free = (0..self.points.len()).all(|node| ends.contains(&node) || !is_between(node));
        is_free
            && self.sides.iter().all(|side| {
                let [a, b] = side.ends.map(|n| self.points[n as usize]);
                let touches = side.ends.contains(&from) || side.ends.contains(&to);
                touches || cross(p, q, a) * cross(p, q, b) >= 0.0 || cross(a, b, p) * cross(a, b, q) >= 0.0
            })
    }

    /// Finds the sights of all corners.
    pub fn look_around(&mut self) {
        let mut corner_at = vec![None; self.points.len()];
        for (number, corner) in (0_u32..).zip(&self.corners) {
            corner_at[corner.node as usize] = Some(number);
        }
        for number in 0..self.corners.len() {
            let corner = &self.corners[number];
            let from = self.points[corner.node as usize];
            let mut sights = Vec::new();
            for (node, &to) in (0_u32..).zip(&self.points) {
                let direction = Point::new(to.x - from.x, to.y - from.y);
                let Some(angle) = corner.place(direction).filter(|_| node != corner.node) else { continue };
                if self.is_seen(corner.node, node) {
                    let back = Point::new(-direction.x, -direction.y);
                    let is_mended = |other: u32| {
                        let other = &self.corners[other as usize];
                        other.place(back).is_some_and(|angle| other.is_mended_by(angle))
                    };
                    let mends = corner_at[node as usize]
                        .filter(|&other| corner.is_mended_by(angle) && is_mended(other));
                    sights.push(Sight { direction, node: Some(node), mends });
                }
            }
            sights.extend(self.halved(corner).into_iter().map(|direction| Sight {
                direction,
                node: None,
                mends: None,
            }));
            self.corners[number].sights = sights;
        }
    }

    /// Whether cuts between two pairs of corners cross, or have a corner in common.
    pub fn do_hinder(&self, one: [u32; 2], other: [u32; 2]) -> bool {
        let line = |ends: [u32; 2]| ends.map(|c| self.points[self.corners[c as usize].node as usize]);
        one.iter().any(|corner| other.contains(corner)) || crossing(line(one), line(other)).is_some()
    }

    /// The directions in which a line from wall to wall is halved by a corner; none in a hall of very many walls.
    fn halved(&self, corner: &Corner) -> Vec<Point> {
        if self.sides.len() > MOST_SIDES {
            return Vec::new();
        }
        let centre = self.points[corner.node as usize];
        let walls = self.sides.iter().filter(|side| !side.ends.contains(&corner.node));
        let walls: Vec<[Point; 2]> = walls.map(|side| side.ends.map(|n| self.points[n as usize])).collect();
        let mirrored = |p: Point| Point::new(2.0 * centre.x - p.x, 2.0 * centre.y - p.y);
        let mut directions = Vec::new();
        for (i, &wall) in walls.iter().enumerate() {
            for &other in &walls[..i] {
                let Some(at) = crossing(wall, other.map(mirrored)) else { continue };
                let there = Point::new(at.x - centre.x, at.y - centre.y);
                let back = Point::new(-there.x, -there.y);
                let is_clear = |to: Point, ends_on: [Point; 2]| {
                    let is_met =
                        |&wall: &[Point; 2]| wall != ends_on && crossing(wall, [centre, to]).is_some();
                    !walls.iter().any(is_met)
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

/// Where two segments cross; `None` where they are parallel or do not meet.
fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<Point> {
    let side = |p: Point, q: Point, r: Point| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    let (from, to) = (side(c, d, a), side(c, d, b));
    let share = from / (from - to);
    (from * to < 0.0 && side(a, b, c) * side(a, b, d) < 0.0)
        .then(|| Point::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)))
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
