//! What rooms and doors weigh.

use std::ops;

use adit_planners::routes::{DoorIndex, RoomIndex, RouteGraph, Walking};

/// What rooms and doors weigh, by index.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    pub rooms: Vec<Walking>,
    /// What passing a door weighs; infinite where it is not passed.
    pub doors: Vec<f64>,
}

impl ops::Index<RoomIndex> for Weights {
    type Output = Walking;

    fn index(&self, room: RoomIndex) -> &Walking {
        &self.rooms[room.index()]
    }
}

impl ops::Index<DoorIndex> for Weights {
    type Output = f64;

    fn index(&self, door: DoorIndex) -> &f64 {
        &self.doors[door.index()]
    }
}

impl Weights {
    pub fn of(graph: &RouteGraph) -> Self {
        let rooms = graph.rooms().iter().map(|room| room.walking);
        let doors = graph.doors().iter().map(|door| door.weight().unwrap_or(f64::INFINITY));
        Self { rooms: rooms.collect(), doors: doors.collect() }
    }

    /// Whether nothing weighs less than in others.
    pub fn are_no_less_than(&self, other: &Self) -> bool {
        let rooms = self.rooms.iter().zip(&other.rooms).all(|pair| match pair {
            (Walking::PerMetre(one), Walking::PerMetre(two)) => one >= two,
            (one, two) => one == two,
        });
        rooms && self.doors.iter().zip(&other.doors).all(|(one, two)| one >= two)
    }

    /// Whether something weighs a little differently, and nothing much differently.
    pub fn differ_a_little(&self, other: &Self) -> bool {
        /// Beyond this share it is a step, not a slope.
        const LITTLE: f64 = 1e-3;
        let is_near = |one: f64, two: f64| {
            one.total_cmp(&two).is_eq()
                || one.is_finite() && two.is_finite() && (one - two).abs() <= LITTLE * one.abs().max(1.0)
        };
        let rooms = self.rooms.iter().zip(&other.rooms).all(|(one, two)| match (one, two) {
            (Walking::PerMetre(one), Walking::PerMetre(two)) => is_near(*one, *two),
            (one, two) => one == two,
        });
        self != other && rooms && self.doors.iter().zip(&other.doors).all(|(one, two)| is_near(*one, *two))
    }
}
