//! Rooms and doors that weigh differently after an inference.

use std::collections::BTreeMap;

use adit_db::Derived;
use adit_db::door::{Door, DoorWeight};
use adit_db::room::{Room, RoomWeight};
use adit_engine::{Changes, KnowledgeBase as Inference, RuleBase, Value};

use crate::graph::SiteGraph;
use crate::look::{self, number, text, truth};
use crate::store::decides_rooms;

/// Rooms and doors by index, with what rules now say of them. Which facts a rule chose is left out.
#[derive(Clone, Debug, Default)]
pub struct Reweighed {
    /// Rooms, ascending.
    pub rooms: Vec<(usize, RoomWeight)>,
    /// Doors, ascending.
    pub doors: Vec<(usize, DoorWeight)>,
}

impl Reweighed {
    /// What differs from the graph after an update.
    pub(crate) fn of(knowledge: &Inference, rules: &RuleBase, changes: &Changes, graph: &SiteGraph) -> Self {
        let look = Look { knowledge, changes };
        let mut rooms: BTreeMap<usize, RoomWeight> = BTreeMap::new();
        let room = |row: usize| graph.rooms[row].weight();
        look.at("ROOMS", "hardness", number, |row, to| {
            rooms.entry(row).or_insert_with(|| room(row)).hardness = to;
        });
        look.at("ROOMS", "action", text, |row, to| {
            rooms.entry(row).or_insert_with(|| room(row)).action = to;
        });
        let is_decided = decides_rooms(rules);
        look.at("ROOMS", "passable", truth, |row, mut to| {
            to.value = to.value.or(if is_decided { None } else { Some(true) });
            rooms.entry(row).or_insert_with(|| room(row)).passable = to;
        });
        let mut doors: BTreeMap<usize, DoorWeight> = BTreeMap::new();
        let door = |row: usize| weight(&graph.doors[row]);
        look.at("DOORS", "hardness", number, |row, to| {
            doors.entry(row).or_insert_with(|| door(row)).hardness = to;
        });
        look.at("DOORS", "action", text, |row, to| {
            doors.entry(row).or_insert_with(|| door(row)).action = to;
        });
        look.at("DOORS", "passable", truth, |row, to| {
            doors.entry(row).or_insert_with(|| door(row)).passable = to;
        });
        rooms.retain(|row, to| is_other_room(&graph.rooms[*row], to));
        doors.retain(|row, to| is_other_door(&graph.doors[*row], to));
        Self { rooms: rooms.into_iter().collect(), doors: doors.into_iter().collect() }
    }

    /// What differs between two graphs; `None` where other rooms or doors are in them.
    pub(crate) fn between(before: &SiteGraph, after: &SiteGraph) -> Option<Self> {
        let rooms = || before.rooms.iter().zip(&after.rooms);
        let doors = || before.doors.iter().zip(&after.doors);
        let is_same = before.rooms.len() == after.rooms.len()
            && before.doors.len() == after.doors.len()
            && rooms().all(|(old, new)| {
                old.rect.map(f64::to_bits) == new.rect.map(f64::to_bits)
                    && old.layer == new.layer
                    && old.facing == new.facing
            })
            && doors().all(|(old, new)| {
                old.segment.map(f64::to_bits) == new.segment.map(f64::to_bits)
                    && (old.side1.room, old.side2.room) == (new.side1.room, new.side2.room)
            });
        is_same.then(|| Self {
            rooms: rooms()
                .enumerate()
                .filter(|(_, (old, new))| is_other_room(old, &new.weight()))
                .map(|(row, (_, new))| (row, new.weight()))
                .collect(),
            doors: doors()
                .enumerate()
                .map(|(row, (old, new))| (row, old, weight(new)))
                .filter(|(_, old, new)| is_other_door(old, new))
                .map(|(row, _, new)| (row, new))
                .collect(),
        })
    }

    /// Whether everything weighs what it weighed.
    pub fn is_empty(&self) -> bool {
        self.rooms.is_empty() && self.doors.is_empty()
    }

    /// Gives the rooms and doors of a graph these weights.
    pub(crate) fn lay_over(&self, graph: &mut SiteGraph) {
        graph.write(&self.rooms, &self.doors);
    }
}

fn weight(door: &Door) -> DoorWeight {
    let (hardness, action) = (door.hardness.clone(), door.action.clone());
    DoorWeight { door: door.door, hardness, action, passable: door.passable.clone() }
}

fn is_other_room(now: &Room, to: &RoomWeight) -> bool {
    differs(&now.hardness, &to.hardness)
        || differs(&now.action, &to.action)
        || differs(&now.passable, &to.passable)
}

fn is_other_door(now: &Door, to: &DoorWeight) -> bool {
    differs(&now.hardness, &to.hardness)
        || differs(&now.action, &to.action)
        || differs(&now.passable, &to.passable)
}

/// Whether the value or its rule is another one; the number of a witness says nothing here.
fn differs<T: PartialEq>(now: &Derived<T>, to: &Derived<T>) -> bool {
    now.value != to.value || now.rule != to.rule
}

struct Look<'a> {
    knowledge: &'a Inference,
    changes: &'a Changes,
}

impl Look<'_> {
    fn at<T>(
        &self,
        class: &str,
        property: &str,
        value: fn(&Value) -> Option<T>,
        mut found: impl FnMut(usize, Derived<T>),
    ) {
        let rows = look::rows(self.changes, class, property);
        let grounds = self.knowledge.grounds(class, property, &rows);
        for (row, grounds) in rows.into_iter().zip(grounds) {
            let row = row as usize;
            let value = self.knowledge.value_at(class, row, property).as_ref().and_then(value);
            let rule = grounds.map(|grounds| grounds.rule as i64 + 1);
            found(row, Derived { value, rule, witness: None });
        }
    }
}
