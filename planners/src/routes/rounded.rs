//! Bends about corners of walls as arcs. The rooms of a disc end at the tangents of the arc about a corner; beyond them, up to
//! the arc, the ground is as free.

use std::f64::consts::{PI, TAU};

use super::graph::RouteGraph;
use super::parts::{DoorIndex, RoomIndex};
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Point, Sector, Segment, cross};

/// An arc is drawn around by tangents that turn by no more than this from one to the next.
const TURN: f64 = TAU / 24.0;

/// The arc about a corner of a wall, where the tangents at both of its ends meet in the end of doors.
pub(super) struct Arc {
    /// Where the tangents meet.
    pub at: Point,
    /// The corner of the wall.
    pub centre: Point,
    /// How far the arc keeps from the corner, metres.
    pub radius: f64,
    /// What the wall takes of the directions about there.
    wall: Sector,
    /// Corners about the arc, counterclockwise.
    corners: Vec<Point>,
    /// The doors that end there, each with the direction in which it leads away: counterclockwise, radians from the wall.
    doors: Vec<(f64, Segment)>,
}

/// By what a way about an arc is kept in its place.
pub(super) struct Kept {
    /// The end that lies on the side of the wall.
    pub inner: Point,
    pub outer: Point,
    /// The link that is passed there.
    pub link: Option<usize>,
}

impl RouteGraph {
    /// What arcs about a few corners save of a way beside their tangents, about.
    pub(super) fn saved_by_arcs(&self) -> f64 {
        let radius = self.rooms.iter().filter_map(|room| room.radius).fold(0.0, f64::max);
        radius * self.least_per_m()
    }

    /// The arc about which a way bends at the end of a door; `None` where it is not known that all is free up to one.
    pub(super) fn arc(&self, door: DoorIndex, at: Point) -> Option<Arc> {
        let radius = self[self[door].room1].radius? + SNAP_M;
        let doors = self.turning().mesh.doors_at(door, at)?;
        if !doors.iter().all(|&door| self.costs_nothing(door)) {
            return None;
        }
        let around = self.rooms_of(doors);
        let wall = self.wall_between(&around, at).filter(|wall| wall.turn < PI)?;
        let first = wall.from + wall.turn;
        let feet = feet(at, wall, radius);
        let is_straight = |foot: Point| {
            let sides = || around.iter().flat_map(|&room| self[room].outline.sides());
            sides().any(|side| side.distance(at) <= SNAP_M && side.distance(foot) <= 2.0 * SNAP_M)
        };
        if !feet.into_iter().all(is_straight) {
            return None;
        }
        let centre = at + wall.middle() * (radius / (wall.turn / 2.0).sin());
        let normals = Sector { from: (feet[0] - centre).angle(), turn: PI - wall.turn };
        let corners = tangents(centre, normals, radius);
        let segments = doors.iter().filter_map(|&door| self[door].crossing.segment());
        let doors =
            segments.map(|door| (((far(door, at) - at).angle() - first).rem_euclid(TAU), door)).collect();
        let arc = Arc { at, centre, radius, wall, corners, doors };
        // one that is passed one way is passed about the arc as well as beside it
        arc.is_clear_of(self.shut_of(self[door].room1)).then_some(arc)
    }

    /// The rooms that some doors join.
    pub(super) fn rooms_of(&self, doors: &[DoorIndex]) -> Vec<RoomIndex> {
        let mut rooms: Vec<RoomIndex> =
            doors.iter().flat_map(|&door| [self[door].room1, self[door].room2]).collect();
        rooms.sort_unstable();
        rooms.dedup();
        rooms
    }

    /// What of the directions about a point some rooms leave to a wall; `None` where none of them has a corner or a side there.
    pub(super) fn wall_between(&self, rooms: &[RoomIndex], at: Point) -> Option<Sector> {
        Sector::widest_gap(rooms.iter().filter_map(|&room| self[room].outline.sector_at(at)))
    }
}

/// Where the arc about a corner of a wall begins and ends on the wall's sides, which meet at a point.
fn feet(at: Point, wall: Sector, radius: f64) -> [Point; 2] {
    let foot = radius / (wall.turn / 2.0).tan();
    [wall.from + wall.turn, wall.from].map(|angle| at + Point::towards(angle) * foot)
}

/// Corners about an arc, counterclockwise.
///
/// # Arguments
/// `normals` are the directions from the centre to the arc.
pub(super) fn tangents(centre: Point, normals: Sector, radius: f64) -> Vec<Point> {
    let count = (normals.turn / TURN).ceil().max(1.0);
    let step = normals.turn / count;
    let from = normals.from + step / 2.0;
    let reach = radius / (step / 2.0).cos();
    let corner = |number: u32| centre + Point::towards(from + step * f64::from(number)) * reach;
    (0..count as u32).map(corner).collect()
}

/// The end of a door that is not here.
fn far(door: Segment, here: Point) -> Point {
    if door.a.distance(here) > door.b.distance(here) { door.a } else { door.b }
}

impl Arc {
    /// The triangle in which the ground between the arc and its tangents lies.
    pub fn dent(&self) -> Convex {
        let [first, last] = feet(self.at, self.wall, self.radius);
        Convex::new(vec![self.at, last, first])
    }

    /// Whether a point lies between the arc and its tangents, where the ground is free.
    pub fn holds(&self, p: Point) -> bool {
        let is_near = p.squared_distance(self.at) <= self.at.squared_distance(self.centre);
        is_near && self.leaves_free(Segment::new(p, p)) && self.dent().distance(p) <= SNAP_M
    }

    /// Whether a straight way does not come nearer to the corner than the arc.
    pub fn leaves_free(&self, way: Segment) -> bool {
        // rooms keep off by as much more as two points are told apart
        way.distance(self.centre) >= self.radius - SNAP_M
    }

    /// Whether no boundary lies between the arc and its tangents.
    fn is_clear_of<'w>(&self, walls: impl Iterator<Item = &'w Segment>) -> bool {
        let mut walls = walls.peekable();
        if walls.peek().is_none() {
            return true;
        }
        let mut between = vec![self.at];
        between.extend(self.corners.iter().rev());
        let between = Convex::new(between);
        walls.all(|wall| between.clip(*wall).is_none())
    }

    /// What keeps a way in its place that goes around the arc.
    ///
    /// # Arguments
    /// `links` with their doors, which all end where the tangents meet, in their order; `is_left` says whether the wall lies
    /// to the left. `along` are the places where the same wall bends the way before and after: a door between two such places
    /// lies between the way and the room that it is pulled out of, and is not passed.
    ///
    /// # Returns
    /// In the way's order: doors by which it comes to the wall, corners of the arc, doors by which it leaves the wall.
    pub fn keeps(&self, links: &[(usize, Segment)], is_left: bool, along: [Option<Point>; 2]) -> Vec<Kept> {
        let kept = |inner: Point, outer: Point, link: Option<usize>| Kept { inner, outer, link };
        let angle =
            |door: &Segment| self.doors.iter().find(|(_, of)| of == door).map_or(PI, |(angle, _)| *angle);
        let angles: Vec<f64> = links.iter().map(|(_, door)| angle(door)).collect();
        let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
        let most = angles.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut all: Vec<Kept> = Vec::new();
        let beside = |is_beside: &dyn Fn(f64) -> bool, all: &mut Vec<Kept>| {
            let mut doors: Vec<_> = self.doors.iter().filter(|(angle, _)| is_beside(*angle)).collect();
            doors.sort_by(|one, two| two.0.total_cmp(&one.0));
            if !is_left {
                doors.reverse();
            }
            let is_along = |far: Point| along.iter().flatten().any(|at| at.distance(far) <= SNAP_M);
            let fars = doors.into_iter().map(|(_, door)| far(*door, self.at)).filter(|&far| !is_along(far));
            all.extend(fars.map(|far| kept(far, self.at, None)));
        };
        let (below, above) = (|angle: f64| angle < least, |angle: f64| angle > most);
        beside(if is_left { &below } else { &above }, &mut all);
        // doors that meet the arc between the same two of its corners do so in the order of their angles
        let mut on: Vec<(f64, f64, Kept)> = Vec::new();
        for (number, corner) in (0..).zip(&self.corners) {
            on.push((f64::from(number), 0.0, kept(*corner, self.at, None)));
        }
        for (&(link, _), angle) in links.iter().zip(angles) {
            let (place, corner) = self.met(angle);
            on.push((place, angle, kept(corner, self.at, Some(link))));
        }
        on.sort_by(|one, two| one.0.total_cmp(&two.0).then(one.1.total_cmp(&two.1)));
        if !is_left {
            on.reverse();
        }
        all.extend(on.into_iter().map(|(_, _, kept)| kept));
        beside(if is_left { &above } else { &below }, &mut all);
        all
    }

    /// Where a door that leads away at an angle meets the corners about the arc when it is carried on, and behind how many of
    /// them.
    fn met(&self, angle: f64) -> (f64, Point) {
        let (first, last) = (self.corners[0], self.corners[self.corners.len() - 1]);
        // carried on, it leads into the wall, from one of its sides to the other
        let share = (angle - (PI - self.wall.turn)) / self.wall.turn;
        if share <= 0.0 {
            return (-0.5, first);
        }
        let along = (first - self.at).rotated(Point::towards(-share * self.wall.turn));
        let side = |p: Point| cross(self.at, self.at + along, p);
        let met = self.corners.windows(2).position(|ends| side(ends[0]) >= 0.0 && side(ends[1]) < 0.0);
        let Some(number) = met.filter(|_| share < 1.0) else {
            return (self.corners.len() as f64 - 0.5, last);
        };
        let (one, two) = (side(self.corners[number]), side(self.corners[number + 1]));
        (number as f64 + 0.5, self.corners[number].lerp(self.corners[number + 1], one / (one - two)))
    }
}
