//! The doors of a way that keeps off walls, and whether it stays in its rooms.

use super::super::cone::{Segment, cross};
use super::super::graph::RouteGraph;
use super::super::parts::{DoorIndex, RoomIndex};
use super::super::way::Leg;
use super::run::Run;
use super::{HALVINGS, Passed};
use crate::geometry::Point;
use crate::geometry::tolerance::SNAP_M;

/// A way that goes no farther into the next room is still in this one, metres.
const UNSEEN_M: f64 = 0.01;

impl Run {
    /// Whether it keeps no farther off walls than the tight way.
    pub fn is_as_tight(&self) -> bool {
        !self.is_moved && !self.corners.iter().any(|corner| corner.is_active && corner.share > 0.0)
    }

    /// What the way passes between its ends where it keeps off corners; `None` where it had better stay as it was.
    pub fn walked(&mut self, graph: &RouteGraph, legs: &[Leg]) -> Option<Vec<Passed>> {
        let rooms = (legs[self.legs.start].room, legs[self.legs.end - 1].room);
        for halved in 0..2 * HALVINGS {
            if self.is_as_tight() {
                return None;
            }
            let bends = self.pulled();
            let line = self.line(&bends);
            let left = match self.walk(graph, &line, rooms) {
                Ok(passed) => return Some(passed),
                Err(leg) => leg,
            };
            let mut is_less = false;
            for &(_, corner) in bends.get(left.saturating_sub(1)..bends.len().min(left + 1))? {
                let share = &mut self.corners[corner].share;
                is_less |= *share > 0.0;
                *share = if halved < HALVINGS { *share / 2.0 } else { 0.0 };
            }
            if !is_less {
                return None;
            }
        }
        None
    }

    /// What a way over these points passes; the error is the number of the leg on which it would leave the rooms.
    fn walk(
        &self,
        graph: &RouteGraph,
        line: &[Point],
        (first, into): (RoomIndex, RoomIndex),
    ) -> Result<Vec<Passed>, usize> {
        let mut passed: Vec<Passed> = Vec::new();
        let mut room = first;
        for (number, ends) in line.windows(2).enumerate() {
            let leg = Segment::new(ends[0], ends[1]);
            let mut through = vec![room];
            let mut done = 0.0;
            let next = |room: RoomIndex, done: f64, through: &[RoomIndex]| {
                exit(graph, room, leg, done, through).or_else(|| self.around(graph, room, leg, through))
            };
            while let Some((share, door, to)) = next(room, done, &through) {
                let at = leg.at(share);
                if !self.is_free(graph, room, at, leg) || !self.is_free(graph, to, at, leg) {
                    return Err(number);
                }
                if !self.stays(graph, &mut passed, (Some(door), at, to), leg) {
                    passed.push((Some(door), at, to));
                }
                (room, done) = (to, share);
                through.push(room);
            }
            if !self.is_free(graph, room, leg.b, leg) {
                return Err(number);
            }
            if number + 2 < line.len() {
                passed.push((None, leg.b, room));
            }
        }
        let last = line.len() - 2;
        if room != into {
            let end = line[last + 1];
            let mut exits = graph.exits.portals(room).iter();
            let exit = exits.find(|exit| {
                let crossing = &graph[exit.door].crossing;
                exit.to == into
                    && graph.costs_nothing(exit.door)
                    && crossing.nearest_to(end).distance(end) <= SNAP_M
            });
            passed.push((Some(exit.ok_or(last)?.door), end, into));
        }
        Ok(passed)
    }

    /// Whether a way that comes back into a room by the door by which it left has been nowhere else all the while, but for
    /// what nobody sees: then it had better not have left.
    fn stays(
        &self,
        graph: &RouteGraph,
        passed: &mut Vec<Passed>,
        (door, at, room): Passed,
        leg: Segment,
    ) -> bool {
        let Some(left) = passed.iter().rposition(|(door, ..)| door.is_some()) else { return false };
        let is_here = |p: Point, leg: Segment| {
            graph[room].outline.distance(p) <= UNSEEN_M || self.is_free(graph, room, p, leg)
        };
        let is_back = passed[left].0 == door
            && passed[left].2 != room
            && passed[left..].windows(2).all(|ends| is_here(ends[1].1, Segment::new(ends[0].1, ends[1].1)))
            && is_here(at, leg);
        if is_back {
            passed.remove(left);
            passed[left..].iter_mut().for_each(|passed| passed.2 = room);
        }
        is_back
    }

    /// The door by which a way leaves a room for good about the arc at one of its corners.
    fn around(
        &self,
        graph: &RouteGraph,
        room: RoomIndex,
        leg: Segment,
        through: &[RoomIndex],
    ) -> Option<(f64, DoorIndex, RoomIndex)> {
        if self.is_free(graph, room, leg.b, leg) {
            return None;
        }
        let off = |room: RoomIndex| graph[room].outline.distance(leg.b);
        let arcs = self.corners.iter().filter_map(|corner| corner.arc.as_ref());
        arcs.filter(|arc| graph[room].outline.distance(arc.at) <= 2.0 * SNAP_M).find_map(|arc| {
            let (enters, leaves) = arc.dent().shares(leg.a, leg.b)?;
            let exits = graph.exits.portals(room).iter().filter(|exit| {
                let segment = graph[exit.door].crossing.segment();
                let ends_there =
                    |door: Segment| door.a.distance(arc.at).min(door.b.distance(arc.at)) <= SNAP_M;
                graph.costs_nothing(exit.door)
                    && !through.contains(&exit.to)
                    && segment.is_some_and(ends_there)
            });
            let exit = exits.min_by(|one, two| off(one.to).total_cmp(&off(two.to)))?;
            Some((f64::midpoint(enters, leaves), exit.door, exit.to))
        })
    }

    /// Whether a point of a leg in a room is free: in its outline, or up to an arc about one of its corners.
    fn is_free(&self, graph: &RouteGraph, room: RoomIndex, p: Point, leg: Segment) -> bool {
        let outline = &graph[room].outline;
        if outline.distance(p) <= SNAP_M {
            return true;
        }
        let mut arcs = self.corners.iter().filter_map(|corner| corner.arc.as_ref());
        arcs.any(|arc| arc.holds(p) && arc.leaves_free(leg) && outline.distance(arc.at) <= 2.0 * SNAP_M)
    }
}

/// The door by which a way leaves a room after a share of it, with where it does, and the room behind.
fn exit(
    graph: &RouteGraph,
    room: RoomIndex,
    leg: Segment,
    done: f64,
    through: &[RoomIndex],
) -> Option<(f64, DoorIndex, RoomIndex)> {
    let exits = graph.exits.portals(room).iter().filter_map(|exit| {
        let door = graph[exit.door].crossing.segment()?;
        let off = |p: Point| cross(door.a, door.b, p) / door.length();
        let (one, two) = (off(leg.a), off(leg.b));
        let share = (one / (one - two)).max(done);
        let is_through = || door.distance(leg.at(share)) <= SNAP_M;
        if two.abs() <= SNAP_M || !(0.0..=1.0).contains(&share) || !is_through() {
            return None;
        }
        let is_outward = || {
            let corners = graph[room].outline.corners().map(off);
            corners.fold(0.0_f64, |most, off| if off.abs() > most.abs() { off } else { most }) * two < 0.0
        };
        let is_next = !through.contains(&exit.to) && graph.costs_nothing(exit.door) && is_outward();
        is_next.then_some((share, exit.door, exit.to))
    });
    exits.min_by(|one, two| one.0.total_cmp(&two.0))
}
