//! What keeps an easier state out where a route is driven in a harder one: the physical fact, or what rules say.

use adit_engine::Value;
use adit_planners::clearance::Hindrance;
use adit_planners::geometry::{Point, Segment};
use adit_planners::routes::{RoomIndex, Walking};
use serde::Serialize;

use crate::graph::{SiteGraph, is_weighed};
use crate::state::State;
use crate::why::said::listed;
use crate::words::number::number;

/// Metres that a length may differ by and be called the same.
const SLIGHT_M: f64 = 1e-9;

/// What keeps a state out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// What it would have to pass under leaves less height than it has.
    Low,
    /// The passage is narrower than it needs.
    Narrow,
    /// It does not fit there.
    NoRoom,
    /// Rules, or what is told, keep it out.
    Shut,
    /// It is no easier there.
    Harder,
    /// It fits; but a change into it and back saves nothing.
    Change,
}

/// An easier state, and what keeps it out.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Hindered {
    /// The state.
    pub state: String,
    pub kind: Kind,
    /// Where.
    pub x: f64,
    pub y: f64,
    /// The height or width that is left there, metres; of one that is no easier what a metre of it weighs.
    pub leaves: Option<f64>,
    /// The height that it has, or the width that it needs, metres.
    pub needs: Option<f64>,
    /// The rule that keeps it out; `null`: it is told.
    pub rule: Option<String>,
    /// The named area in which that is.
    pub area: Option<String>,
}

/// A stretch of a way in one state: its legs, with what a metre weighs there.
pub struct Driven<'d> {
    pub legs: &'d [Segment],
    pub per_m: f64,
}

impl State {
    /// What keeps a state of a robot out of a stretch that is driven in another one.
    pub(super) fn hindered(&self, of: &(String, String), driven: &Driven) -> Option<Hindered> {
        let (graph, gauge) = (self.graph(), &*self.gauge);
        let physical = gauge.hindrance(of, &graph.facings(of), driven.legs);
        let hindered = |kind: Kind, at: Point| Hindered {
            state: of.1.clone(),
            kind,
            x: at.x,
            y: at.y,
            leaves: None,
            needs: None,
            rule: None,
            area: None,
        };
        match physical {
            Some(Hindrance::Low { leaves, at }) => {
                let needs = gauge.size(of).map(|size| size.height);
                return Some(Hindered { leaves: Some(leaves), needs, ..hindered(Kind::Low, at) });
            }
            Some(Hindrance::Narrow { leaves, at }) => {
                let needs = gauge.needs(of);
                return Some(Hindered { leaves: Some(leaves), needs, ..hindered(Kind::Narrow, at) });
            }
            _ => {}
        }
        let points: Vec<Point> = driven.legs.iter().map(Segment::middle).collect();
        let rooms: Vec<(Point, RoomIndex)> =
            points.iter().flat_map(|&at| graph.rooms_at(of, at).map(move |room| (at, room))).collect();
        if let Some(&(at, room)) = rooms.iter().find(|(_, room)| !is_weighed(&graph[*room])) {
            let passable = &graph[room].passable;
            let rule = passable.rule.filter(|_| passable.value == Some(false));
            let rule = rule.and_then(|rule| self.inputs.rule_names.get(&rule).cloned());
            return Some(Hindered { rule, area: self.area_of(room), ..hindered(Kind::Shut, at) });
        }
        let harder = rooms.iter().find_map(|&(at, room)| match graph.graph()[room].walking {
            Walking::PerMetre(per_m) if per_m >= driven.per_m - SLIGHT_M => Some((at, room, per_m)),
            _ => None,
        });
        if let Some((at, room, per_m)) = harder {
            let area = self.area_of(room);
            return Some(Hindered {
                leaves: Some(per_m),
                needs: Some(driven.per_m),
                area,
                ..hindered(Kind::Harder, at)
            });
        }
        match physical {
            Some(found) => Some(hindered(Kind::NoRoom, found.at())),
            None => points.get(points.len() / 2).map(|&at| hindered(Kind::Change, at)),
        }
    }

    /// The named area in which a room lies.
    fn area_of(&self, room: RoomIndex) -> Option<String> {
        let (knowledge, key) = (&self.knowledge, self.graph()[room].room as f64);
        let mut rows = 0..knowledge.len("AREA_ROOMS").unwrap_or(0);
        let is_own = |row: &usize| matches!(knowledge.value_at("AREA_ROOMS", *row, "room"), Some(Value::Number(of)) if of.total_cmp(&key).is_eq());
        match knowledge.value_at("AREA_ROOMS", rows.find(is_own)?, "area") {
            Some(Value::Text(area)) => Some(area.to_string()),
            _ => None,
        }
    }
}

/// The easiest state of a robot: what a metre of each weighs where it weighs least, the least first.
pub(super) fn by_ease(graph: &SiteGraph, robot: &str) -> Vec<((String, String), f64)> {
    let mut states: Vec<((String, String), f64)> = Vec::new();
    for (room, of) in graph.graph().room_indices().zip(&graph.rooms) {
        let Some(layer) = of.layer.as_ref().filter(|(of, _)| of == robot) else { continue };
        let Walking::PerMetre(per_m) = graph.graph()[room].walking else { continue };
        match states.iter_mut().rev().find(|(known, _)| known == layer) {
            Some((_, least)) => *least = least.min(per_m),
            None => states.push((layer.clone(), per_m)),
        }
    }
    states.sort_by(|(_, one), (_, two)| one.total_cmp(two));
    states
}

/// What keeps states out, in one sentence: states that the same thing keeps out stand together.
pub(super) fn sentence(hindered: &[Hindered]) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut said = vec![false; hindered.len()];
    for (index, one) in hindered.iter().enumerate() {
        if said[index] {
            continue;
        }
        let is_same = |other: &Hindered| {
            let near = (one.x - other.x).hypot(one.y - other.y) < 0.5;
            one.kind == other.kind
                && near
                && one.leaves.map(number) == other.leaves.map(number)
                && (&one.rule, &one.area) == (&other.rule, &other.area)
        };
        let alike: Vec<&Hindered> = hindered.iter().filter(|other| is_same(other)).collect();
        said.iter_mut().zip(hindered).for_each(|(said, other)| *said |= is_same(other));
        parts.push(part(one, &alike));
    }
    parts.join("; ")
}

fn part(one: &Hindered, alike: &[&Hindered]) -> String {
    let at = format!("({:.1}, {:.1})", one.x, one.y);
    let leaves = one.leaves.map(number).unwrap_or_default();
    let each = |words: &dyn Fn(&Hindered) -> String| -> String {
        listed(&alike.iter().map(|one| words(one)).collect::<Vec<_>>())
    };
    let names = each(&|one| one.state.clone());
    let is = |one: &str, more: &str| if alike.len() == 1 { one.to_owned() } else { more.to_owned() };
    let in_area = one.area.as_ref().map_or_else(String::new, |area| format!(" in {area}"));
    match one.kind {
        Kind::Low => {
            let heights: Vec<String> =
                alike.iter().map(|one| number(one.needs.unwrap_or_default())).collect();
            let high = if heights.iter().all(|height| *height == heights[0]) {
                format!("{names} {} {} m high", is("is", "are"), heights[0])
            } else {
                each(&|one| format!("{} is {} m high", one.state, number(one.needs.unwrap_or_default())))
            };
            format!("what it passes under at {at} leaves {leaves} m, and {high}")
        }
        Kind::Narrow => {
            let needs =
                |one: &Hindered| format!("{} needs {}", one.state, number(one.needs.unwrap_or_default()));
            format!("the passage at {at} is {leaves} m wide, and {}", each(&needs))
        }
        Kind::NoRoom => format!("{names} {} not fit at {at}", is("does", "do")),
        Kind::Shut => match &one.rule {
            Some(rule) => format!("{names} {} kept out{in_area} at {at} (rule \"{rule}\")", is("is", "are")),
            None => format!(
                "{names} {} told not to enter{in_area} at {at}, or nothing says how hard that is",
                is("is", "are")
            ),
        },
        Kind::Harder => format!(
            "{names} {} no easier{in_area} at {at}: a metre weighs {leaves} against {}",
            is("is", "are"),
            number(one.needs.unwrap_or_default())
        ),
        Kind::Change => {
            format!("{names} {} there, too, but changing shape for it gains nothing", is("fits", "fit"))
        }
    }
}
