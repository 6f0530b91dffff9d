//! Which rooms and doors are seen. Layers of states lie over each other, so not all can be.

use std::collections::BTreeSet;

use adit_db::door::DoorKind;

use super::layers::Layers;
use super::scene::{Scene, StepKind};

/// The rooms and doors of a picture, as indices of the scene's lists.
#[derive(Debug, Default, PartialEq)]
pub(super) struct View {
    /// The state whose layer is the base, where rooms belong to states.
    pub state: Option<String>,
    pub rooms: Vec<usize>,
    /// Rooms of other layers that the route uses.
    pub route_rooms: Vec<usize>,
    /// Doors within what is seen.
    pub doors: Vec<usize>,
    /// Of those, the doors of the route.
    pub route_doors: BTreeSet<usize>,
}

impl View {
    pub fn of(scene: &Scene, layers: &Layers) -> Self {
        let state = layers.state.clone().or_else(|| largest_layer(scene));
        let passed = |kind: StepKind| -> BTreeSet<&str> {
            let steps = scene.route.iter().flat_map(|r| &r.steps);
            steps.filter(|s| s.kind == kind).map(|s| s.place.as_str()).collect()
        };
        let (rooms_passed, doors_passed) = (passed(StepKind::Room), passed(StepKind::Door));
        let (mut rooms, mut route_rooms) = (Vec::new(), Vec::new());
        for (i, room) in scene.rooms.iter().enumerate() {
            if room.state.is_none() || room.state == state {
                rooms.push(i);
            } else if rooms_passed.contains(room.name.as_str()) {
                route_rooms.push(i);
            }
        }
        let seen: BTreeSet<usize> = rooms.iter().copied().collect();
        let (mut doors, mut route_doors) = (Vec::new(), BTreeSet::new());
        for (i, door) in scene.doors.iter().enumerate().filter(|(_, d)| d.kind == DoorKind::Door) {
            let used = doors_passed.contains(door.number.to_string().as_str());
            if used {
                route_doors.insert(i);
            }
            if used || (seen.contains(&door.room1) && seen.contains(&door.room2)) {
                doors.push(i);
            }
        }
        Self { state, rooms, route_rooms, doors, route_doors }
    }
}

/// The state whose rooms have the largest area; of equal ones the first.
fn largest_layer(scene: &Scene) -> Option<String> {
    let mut areas: Vec<(&str, f64)> = Vec::new();
    for room in &scene.rooms {
        if let Some(state) = room.state.as_deref() {
            match areas.iter_mut().find(|(name, _)| *name == state) {
                Some((_, area)) => *area += room.outline.area(),
                None => areas.push((state, room.outline.area())),
            }
        }
    }
    let largest = areas.into_iter().reduce(|best, next| if next.1 > best.1 { next } else { best });
    largest.map(|(state, _)| state.to_owned())
}
