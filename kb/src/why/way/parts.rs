//! The stretches of a way, each driven in one manner, and how easy a manner is.

use adit_planners::geometry::Segment;
use adit_planners::routes::{DoorIndex, RoomIndex, Walking};

use crate::graph::SiteGraph;
use crate::state::State;
use crate::why::contrast::Choice;
use crate::why::contrast::through::Via;
use crate::why::hindered::by_ease;
use crate::why::meant::Meant;

/// A stretch that is shorter is none, metres.
const SHORT_M: f64 = 1e-6;

/// What is done on a stretch: in a state, or by an action.
#[derive(Clone, Debug, PartialEq)]
pub enum Manner {
    State((String, String)),
    Action(String),
}

/// A stretch as it is found on a way.
pub struct Part {
    pub manner: Manner,
    pub action: String,
    pub spaces: Vec<String>,
    pub legs: Vec<Segment>,
    pub cost: f64,
    /// What a metre of it weighs at most.
    pub per_m: f64,
    pub doors: Vec<DoorIndex>,
    pub rooms: Vec<RoomIndex>,
}

impl Manner {
    /// The rooms and doors in which this is done.
    pub fn without(&self, graph: &SiteGraph) -> (Vec<RoomIndex>, Vec<DoorIndex>) {
        match self {
            Self::State(of) => {
                let is_own = |room: &RoomIndex| graph[*room].layer.as_ref() == Some(of);
                (graph.graph().room_indices().filter(is_own).collect(), Vec::new())
            }
            Self::Action(action) => {
                let is_own = |door: &DoorIndex| graph[*door].action.value.as_ref() == Some(action);
                (Vec::new(), graph.graph().door_indices().filter(is_own).collect())
            }
        }
    }
}

/// How easy what a robot does is.
pub struct Ease {
    /// By state, the easiest first.
    states: Vec<((String, String), f64)>,
    /// What is done in the state that the tables say is easiest.
    action: Option<String>,
}

impl Ease {
    pub fn of(fork: &State, robot: &str) -> Self {
        let knowledge = &fork.knowledge;
        let texts = |property| knowledge.texts("ROBOTS", property).unwrap_or_default();
        let (robots, actions) = (texts("robot"), texts("action"));
        let hardness = knowledge.numbers("ROBOTS", "hardness").unwrap_or_default();
        let rows = (0..robots.len()).filter(|&row| robots[row].as_deref() == Some(robot));
        let weighed = rows.filter_map(|row| Some((hardness.get(row).copied()??, actions.get(row)?.clone()?)));
        let action = weighed.min_by(|one, two| one.0.total_cmp(&two.0)).map(|(_, action)| action.to_string());
        Self { states: by_ease(fork.graph(), robot), action }
    }

    pub fn easiest(&self, fork: &State) -> Option<String> {
        let of = self.states.first().map(|(of, _)| of);
        let room = of.and_then(|of| fork.graph().rooms.iter().find(|room| room.layer.as_ref() == Some(of)));
        room.and_then(|room| room.action.value.clone()).or_else(|| self.action.clone())
    }

    pub fn is_easiest(&self, manner: &Manner) -> bool {
        match manner {
            Manner::State(of) => self.states.first().is_none_or(|(easiest, _)| easiest == of),
            Manner::Action(action) => self.action.as_ref().is_none_or(|easiest| easiest == action),
        }
    }

    /// The states of which a metre weighs less somewhere than so much.
    pub fn easier_than(&self, of: &(String, String), per_m: f64) -> Vec<&(String, String)> {
        let easier = self.states.iter().filter(|(other, least)| other != of && *least < per_m);
        easier.map(|(other, _)| other).collect()
    }
}

/// The spaces that a way leads through, each once, in their order.
pub fn spaces_of(graph: &SiteGraph, way: &Choice) -> Vec<String> {
    let mut spaces: Vec<String> = Vec::new();
    for leg in &way.driven.legs {
        let space = graph[leg.room].space.filter(|_| leg.length() > SHORT_M);
        if let Some(space) = space.and_then(|space| graph.building.space(space))
            && !spaces.contains(&space)
        {
            spaces.push(space);
        }
    }
    spaces
}

/// The stretches of a way: by state, or where all hardness lies on the doors door by door.
pub fn parts(graph: &SiteGraph, way: &Choice, is_on_doors: bool) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for leg in &way.driven.legs {
        let room = &graph[leg.room];
        let space = room.space.and_then(|space| graph.building.space(space));
        let (manner, action, cost) = if is_on_doors {
            let Some(door) = leg.door else { continue };
            let Some(action) = graph[door].action.value.clone() else { continue };
            (Manner::Action(action.clone()), action, graph[door].hardness.value.unwrap_or_default())
        } else {
            let Some(layer) = room.layer.clone() else { continue };
            (Manner::State(layer), room.action.value.clone().unwrap_or_default(), leg.hardness)
        };
        if parts.last().is_none_or(|part| part.manner != manner) {
            let (spaces, legs, doors, rooms) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
            parts.push(Part { manner, action, spaces, legs, cost: 0.0, per_m: 0.0, doors, rooms });
        }
        let Some(part) = parts.last_mut() else { continue };
        part.cost += cost;
        part.doors.extend(leg.door.filter(|_| is_on_doors));
        part.rooms.push(leg.room);
        part.legs.push(Segment::new(leg.from, leg.to));
        if let Walking::PerMetre(per_m) = graph.graph()[leg.room].walking
            && leg.length() > SHORT_M
        {
            part.per_m = part.per_m.max(per_m);
        }
        if let Some(space) = space.filter(|space| part.spaces.last() != Some(space))
            && (leg.length() > SHORT_M || is_on_doors)
        {
            part.spaces.push(space);
        }
    }
    parts.retain(|part| is_on_doors || part.legs.iter().map(Segment::length).sum::<f64>() > SHORT_M);
    parts
}

/// Whether a stretch leads through what is meant; of a point, whether it lies in one of its rooms' spaces.
pub fn is_at(graph: &SiteGraph, meant: &Meant, part: &Part) -> bool {
    match &meant.via {
        Via::Rooms(rooms) => part.rooms.iter().any(|room| rooms.contains(room)),
        Via::Doors(doors) => {
            let sides = doors.iter().flat_map(|&door| [graph.graph()[door].room1, graph.graph()[door].room2]);
            let is_own = part.doors.iter().any(|door| doors.contains(door));
            is_own || sides.into_iter().any(|room| part.rooms.contains(&room))
        }
        Via::Point(_, entries) => {
            let spaces: Vec<Option<i64>> = entries.iter().map(|entry| graph[entry.room].space).collect();
            part.rooms.iter().any(|&room| spaces.contains(&graph[room].space))
        }
    }
}
