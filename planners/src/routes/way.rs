//! A way from a start to a goal, leg by leg.

use super::graph::RouteGraph;
use super::parts::{DoorIndex, RoomIndex};
use crate::geometry::Point;

/// The straight way through one room, up to the door that is passed then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    pub room: RoomIndex,
    pub from: Point,
    pub to: Point,
    /// Hardness of the way: metres times the room's hardness.
    pub hardness: f64,
    /// The door passed at its end; `None` for the last leg.
    pub door: Option<DoorIndex>,
    /// Total hardness at its end, with the door's.
    pub cost: f64,
}

impl Leg {
    /// Metres.
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }
}

#[derive(Clone, Debug, PartialEq, Default)]
pub struct Ways {
    /// To each goal, in their order; `None` where it is not reached.
    pub goals: Vec<Option<Way>>,
    /// To each room, by index: to where it is reached first. Empty unless asked for.
    pub rooms: Vec<Option<Way>>,
}

/// A way, pulled tight: from the start's point to the goal's.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// At least one.
    pub legs: Vec<Leg>,
    pub cost: f64,
}

impl Way {
    /// The way through these doors, each with where it is passed and the room behind it; or about points without a door.
    pub(super) fn through(
        graph: &RouteGraph,
        (room, start): (RoomIndex, Point),
        doors: impl IntoIterator<Item = (Option<DoorIndex>, Point, RoomIndex)>,
        goal: Point,
    ) -> Self {
        let mut legs: Vec<Leg> = Vec::new();
        let (mut room, mut from, mut cost) = (room, start, 0.0);
        for (mut door, to, next) in doors {
            if let Some(last) = legs.last_mut().filter(|last| returns(graph, last, door, next)) {
                (last.door, room, door) = (None, next, None);
            }
            let hardness = walked(graph, room, from, to);
            cost += hardness + door.and_then(|door| graph.passage(door)).unwrap_or(0.0);
            legs.push(Leg { room, from, to, hardness, door, cost });
            (room, from) = (next, to);
        }
        let hardness = walked(graph, room, from, goal);
        cost += hardness;
        legs.push(Leg { room, from, to: goal, hardness, door: None, cost });
        Self { legs, cost }
    }

    /// The same with straight legs from a start and to a goal that lie outside of its first and last room.
    pub(super) fn joined(mut self, graph: &RouteGraph, start: Point, goal: Point) -> Self {
        let (Some(first), Some(last)) = (self.legs.first().copied(), self.legs.last().copied()) else {
            return self;
        };
        if start != first.from {
            let hardness = walked(graph, first.room, start, first.from);
            for leg in &mut self.legs {
                leg.cost += hardness;
            }
            self.legs.insert(
                0,
                Leg { from: start, to: first.from, hardness, door: None, cost: hardness, ..first },
            );
            self.cost += hardness;
        }
        if goal != last.to {
            let hardness = walked(graph, last.room, last.to, goal);
            self.cost += hardness;
            self.legs.push(Leg { from: last.to, to: goal, hardness, door: None, cost: self.cost, ..last });
        }
        self
    }

    /// Metres.
    pub fn length(&self) -> f64 {
        self.legs.iter().map(Leg::length).sum()
    }
}

/// Whether a way that has just left a room comes back by the same door: then it has gone along the door, and may as well have
/// stayed.
fn returns(graph: &RouteGraph, last: &Leg, door: Option<DoorIndex>, next: RoomIndex) -> bool {
    door.is_some_and(|door| last.door == Some(door) && last.room == next && graph.is_free(door))
}

fn walked(graph: &RouteGraph, room: RoomIndex, from: Point, to: Point) -> f64 {
    let per_m = graph.per_m(room);
    if per_m > 0.0 { per_m * from.distance(to) } else { 0.0 }
}
