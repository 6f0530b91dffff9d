//! What a way takes of each measure, summed leg by leg: the search itself knows of hardness alone.

use adit_db::measure::Measures;
use adit_planners::routes::{DoorIndex, Leg, RoomIndex, Way};

use crate::graph::SiteGraph;

/// A way as far as it was followed.
pub(super) struct Taken<'a> {
    graph: &'a SiteGraph,
    /// Whether ways have metres: those over doors have none.
    is_measured: bool,
    /// Up to the door passed last.
    before: Measures,
    /// Walked since then.
    metres: f64,
}

/// What a leg takes.
pub(super) struct Taking {
    /// In its room since the door before.
    pub room: Measures,
    /// At the door at its end.
    pub door: Option<Measures>,
    /// From the start to its end.
    pub so_far: Measures,
}

impl<'a> Taken<'a> {
    /// At the start, where what is known of the first room is 0.
    pub fn new(graph: &'a SiteGraph, way: &Way) -> Self {
        let is_measured = !graph.graph().is_on_doors();
        let before = way.legs.first().map(|leg| of_room(graph, leg.room).along(Some(0.0)));
        Self { graph, is_measured, before: before.unwrap_or_default(), metres: 0.0 }
    }

    /// What is said at the start.
    pub fn at_start(&self) -> Measures {
        self.before.clone()
    }

    /// Follows a leg.
    pub fn follow(&mut self, leg: &Leg) -> Taking {
        self.metres += leg.length();
        // of a way that leads to a room, and not to a point of it, nothing is walked there
        let is_nothing = leg.door.is_none() && leg.from == leg.to;
        let metres = (self.is_measured || is_nothing).then_some(self.metres);
        let room = of_room(self.graph, leg.room).along(metres);
        let mut so_far =
            if is_nothing && self.metres == 0.0 { self.before.clone() } else { self.before.and(&room) };
        let door = leg.door.map(|door| of_door(self.graph, door));
        if let Some(door) = &door {
            so_far = so_far.and(door);
            (self.before, self.metres) = (so_far.clone(), 0.0);
        }
        let door = door.map(|door| door.rounded());
        Taking { room: room.rounded(), door, so_far: so_far.rounded() }
    }
}

fn of_room(graph: &SiteGraph, room: RoomIndex) -> Measures {
    Measures::of(graph[room].measures.as_deref())
}

fn of_door(graph: &SiteGraph, door: DoorIndex) -> Measures {
    Measures::of(graph[door].measures.as_deref())
}
