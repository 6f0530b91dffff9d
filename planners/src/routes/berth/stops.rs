//! Where a shape is changed, or a way refracted, farther off walls than at the best point.

use super::super::closed::CLEAR_M;
use super::super::gates::without;
use super::super::graph::RouteGraph;
use super::super::parts::RoomIndex;
use super::super::way::Leg;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Rect, Segment};

/// So often a stop is moved away from the wall of which it has too little room.
const ROUNDS: usize = 8;

impl RouteGraph {
    /// Where the stop between two legs may lie instead, with more room beside it.
    pub(super) fn roomier_stop(&self, before: &Leg, after: &Leg) -> Point {
        let at = before.to;
        let roomier = self.moved_off_walls(before, after.room);
        let is_closed = |wall: &Segment| wall.distance(roomier) < CLEAR_M;
        let is_clear = |room: RoomIndex| !self.walls_of(room).any(is_closed);
        if is_clear(before.room) && is_clear(after.room) { roomier } else { at }
    }

    fn moved_off_walls(&self, before: &Leg, after: RoomIndex) -> Point {
        let at = before.to;
        let Some(door) = before.door else { return at };
        let crossing = &self[door].crossing;
        let walls: Vec<(Segment, f64)> = [before.room, after]
            .into_iter()
            .flat_map(|room| {
                let berth = self[room].berth.metres;
                self.walls_near(room, at, 2.0 * berth).into_iter().map(move |wall| (wall, berth))
            })
            .collect();
        let worst = |p: Point| {
            let missing = walls.iter().map(|(wall, berth)| (berth - wall.distance(p), wall));
            missing.max_by(|one, two| one.0.total_cmp(&two.0)).filter(|(missing, _)| *missing > SNAP_M)
        };
        let (mut best, mut p) = (at, at);
        for _ in 0..ROUNDS {
            let Some((missing, wall)) = worst(p) else { return p };
            if worst(best).is_some_and(|(most, _)| missing < most) {
                best = p;
            }
            let near = wall.nearest_to(p);
            let away = if near.distance(p) > SNAP_M {
                Segment::new(near, p).direction()
            } else {
                wall.direction().perpendicular()
            };
            p = crossing.nearest_to(p + away * missing);
        }
        best
    }

    /// What bounds a room, and those that doors join with it, about a point.
    fn walls_near(&self, room: RoomIndex, at: Point, reach: f64) -> Vec<Segment> {
        let (mut rooms, mut next, mut walls) = (vec![room], 0, Vec::new());
        let about = Rect::around([at]).grown(reach);
        while let Some(&room) = rooms.get(next) {
            next += 1;
            walls.extend(self.walls_beside(room, about));
            for exit in self.exits.portals(room).iter().filter(|exit| self.is_open(exit.door)) {
                let is_near =
                    self[exit.door].crossing.segment().is_some_and(|door| door.distance(at) <= reach);
                if is_near && !rooms.contains(&exit.to) {
                    rooms.push(exit.to);
                }
            }
        }
        walls
    }

    /// What of a room's sides near a rectangle nobody passes, with the room to the left.
    pub(super) fn walls_beside(&self, room: RoomIndex, about: Rect) -> Vec<Segment> {
        let sides = self[room].outline.sides().filter(|side| side.bounds().overlaps(&about));
        let portals = self.exits.portals_beside(room).filter(|exit| self.is_open(exit.door));
        let open: Vec<Segment> = portals.filter_map(|exit| self[exit.door].crossing.segment()).collect();
        let walls = |side: Segment| {
            let open: Vec<Segment> = open.iter().filter_map(|open| side.shared_with(open)).collect();
            without(side, &open)
        };
        sides.flat_map(walls).collect()
    }
}
