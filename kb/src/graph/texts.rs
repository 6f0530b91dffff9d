//! What answers over doors say of rooms and doors, as JSON: written once, and again when they are weighed anew.

use std::sync::{Arc, OnceLock};

use adit_db::Derived;
use adit_db::door::DoorKind;
use adit_planners::routes::{DoorIndex, RoomIndex};
use serde_json::{Result, to_string};

use super::{Rules, SiteGraph};

/// Texts of rooms and doors; each is written when it is first asked for.
#[derive(Clone)]
pub struct Texts {
    rooms: Vec<OnceLock<Arc<Text>>>,
    doors: Vec<OnceLock<Arc<Text>>>,
}

/// What steps and waypoints say of a room or a door, around what differs from route to route.
pub struct Text {
    all: Box<[u8]>,
    rule: usize,
    point: usize,
}

impl Text {
    fn new(step: &str, rule: &str, point: &str) -> Arc<Self> {
        let all = [step, rule, point].concat().into_bytes().into_boxed_slice();
        Arc::new(Self { all, rule: step.len(), point: step.len() + rule.len() })
    }

    /// A step, from its kind up to its cost.
    pub fn step(&self) -> &[u8] {
        &self.all[..self.rule]
    }

    /// A step after its heading, up to what it takes.
    pub fn rule(&self) -> &[u8] {
        &self.all[self.rule..self.point]
    }

    /// Of a room: a waypoint, after its heading up to its cost. Of a door: where it is, up to the heading.
    pub fn point(&self) -> &[u8] {
        &self.all[self.point..]
    }
}

impl Texts {
    /// No texts yet.
    pub fn new(rooms: usize, doors: usize) -> Self {
        Self { rooms: vec![OnceLock::new(); rooms], doors: vec![OnceLock::new(); doors] }
    }

    /// Forgets what was written of rooms and doors.
    pub fn forget(&mut self, rooms: impl Iterator<Item = RoomIndex>, doors: impl Iterator<Item = DoorIndex>) {
        for room in rooms {
            self.rooms[room.index()].take();
        }
        for door in doors {
            self.doors[door.index()].take();
        }
    }

    /// What is said of a room in which no metre weighs anything.
    pub fn room(&self, graph: &SiteGraph, rules: &Rules, room: RoomIndex) -> Result<&Text> {
        kept(&self.rooms[room.index()], || room_text(graph, rules, room))
    }

    /// What is said of a door between such rooms.
    pub fn door(&self, graph: &SiteGraph, rules: &Rules, door: DoorIndex) -> Result<&Text> {
        kept(&self.doors[door.index()], || door_text(graph, rules, door))
    }
}

fn kept(place: &OnceLock<Arc<Text>>, write: impl FnOnce() -> Result<Arc<Text>>) -> Result<&Text> {
    if let Some(text) = place.get() {
        return Ok(text);
    }
    let text = write()?;
    Ok(place.get_or_init(|| text))
}

/// The end of a step: its rule, space and doorway.
fn end<T>(
    value: &Derived<T>,
    rules: &Rules,
    (space, doorway): (Option<String>, Option<String>),
) -> Result<String> {
    let rule = to_string(&value.rule.and_then(|rule| rules.get(&rule)))?;
    let (space, doorway) = (to_string(&space)?, to_string(&doorway)?);
    Ok(format!(r#","rule":{rule},"space":{space},"doorway":{doorway}"#))
}

fn room_text(graph: &SiteGraph, rules: &Rules, room: RoomIndex) -> Result<Arc<Text>> {
    let room = &graph[room];
    let (name, action) = (to_string(&room.name)?, to_string(&room.action.value)?);
    let facing = to_string(&room.facing)?;
    let step =
        format!(r#","kind":"room","place":{name},"state":null,"action":{action},"hardness":0.0,"cost":"#);
    let waypoint = format!(
        r#","state":null,"action":{action},"facing":{facing},"clearance":null,"distance":null,"cost":"#
    );
    let space = room.space.and_then(|space| graph.building.space(space));
    Ok(Text::new(&step, &end(&room.action, rules, (space, None))?, &waypoint))
}

fn door_text(graph: &SiteGraph, rules: &Rules, door: DoorIndex) -> Result<Arc<Text>> {
    let (door, at) = (&graph[door], graph.graph()[door].at);
    let (action, hardness) = (to_string(&door.action.value)?, to_string(&door.hardness.value)?);
    let (kind, number) = (word(door.kind), door.door);
    let step = format!(
        r#","kind":"{kind}","place":"{number}","state":null,"action":{action},"hardness":{hardness},"cost":"#
    );
    let at = format!(r#","x":{},"y":{},"heading":"#, to_string(&at.x)?, to_string(&at.y)?);
    let doorway = graph.doorway(door);
    Ok(Text::new(&step, &end(&door.hardness, rules, (None, doorway))?, &at))
}

/// What steps call a door.
pub fn word(kind: DoorKind) -> &'static str {
    match kind {
        DoorKind::Door => "door",
        DoorKind::Change => "change",
    }
}
