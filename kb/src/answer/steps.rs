//! The rows of `action_sequence` and of `waypoints` of a route that is not kept.

use adit_db::door::DoorKind;
use adit_db::measure::Measures;
use adit_db::route::{Step, Waypoint};
use adit_planners::routes::{Leg, Way};

use super::taken::Taken;
use crate::graph::gauge::{Gauge, bends, headings};
use crate::graph::heading;
use crate::graph::{Rules, SiteGraph, word};

/// The steps of a way; where it does not lead to a point, nothing is walked in the last room.
pub(super) fn steps(graph: &SiteGraph, rules: &Rules, way: &Way, to_point: bool) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::with_capacity(way.legs.len() * 2);
    let (mut before, mut walked) = (0.0, 0.0);
    let mut taken = Taken::new(graph, way);
    for (index, leg) in way.legs.iter().enumerate() {
        let is_goal = index + 1 == way.legs.len();
        walked += leg.hardness;
        let taking = taken.follow(leg);
        if leg.door.is_none() && !is_goal {
            // a bend within a room is no step
            continue;
        }
        let leg = &Leg { hardness: std::mem::take(&mut walked), ..*leg };
        let heading = heading(leg.from, leg.to).filter(|_| !is_goal || to_point);
        let step = room_step(graph, rules, leg, before + leg.hardness);
        steps.push(Step { heading, measures: taking.room, ..step });
        before = leg.cost;
        let Some(door) = leg.door.map(|door| &graph[door]) else { continue };
        let layer_of = match door.kind {
            DoorKind::Door => leg.room,
            DoorKind::Change => way.legs.get(index + 1).map_or(leg.room, |next| next.room),
        };
        steps.push(Step {
            step: 0,
            kind: word(door.kind).to_owned(),
            place: door.door.to_string(),
            state: graph[layer_of].layer.as_ref().map(|(_, state)| state.clone()),
            action: door.action.value.clone(),
            hardness: door.hardness.value,
            cost: leg.cost,
            x: Some(leg.to.x),
            y: Some(leg.to.y),
            heading,
            rule: door.hardness.rule.and_then(|rule| rules.get(&rule).cloned()),
            space: None,
            doorway: graph.doorway(door),
            measures: taking.door.unwrap_or_default(),
            z: None,
        });
    }
    for (number, step) in (1..).zip(&mut steps) {
        step.step = number;
    }
    steps
}

fn room_step(graph: &SiteGraph, rules: &Rules, leg: &Leg, cost: f64) -> Step {
    let room = &graph[leg.room];
    Step {
        step: 0,
        kind: "room".to_owned(),
        place: room.name.clone(),
        state: room.layer.as_ref().map(|(_, state)| state.clone()),
        action: room.action.value.clone(),
        hardness: Some(leg.hardness),
        cost,
        x: Some(leg.to.x),
        y: Some(leg.to.y),
        heading: None,
        rule: room.action.rule.and_then(|rule| rules.get(&rule).cloned()),
        space: room.space.and_then(|space| graph.building.space(space)),
        doorway: None,
        measures: Measures::default(),
        z: None,
    }
}

/// Where a way bends, changes shape, starts and ends. Ways over doors are not measured, and need no gauge.
pub(super) fn waypoints(graph: &SiteGraph, way: &Way, gauge: Option<&Gauge>) -> Vec<Waypoint> {
    let is_measured = gauge.is_some();
    let bends = if is_measured { bends(graph, way) } else { vec![true; way.legs.len()] };
    let clearances = gauge.map(|gauge| gauge.clearances(graph, way, &bends));
    let headings = headings(way, &bends);
    let mut points: Vec<Waypoint> = Vec::new();
    let (mut distance, mut taken) = (0.0, Taken::new(graph, way));
    for (index, leg) in way.legs.iter().enumerate() {
        let room = &graph[leg.room];
        let here = Waypoint {
            waypoint: 1,
            x: leg.from.x,
            y: leg.from.y,
            heading: None,
            state: room.layer.as_ref().map(|(_, state)| state.clone()),
            action: room.action.value.clone(),
            facing: room.facing,
            clearance: None,
            distance: is_measured.then_some(0.0),
            cost: 0.0,
            measures: taken.at_start(),
            ..Waypoint::default()
        };
        if index == 0 {
            points.push(here.clone());
        }
        distance += leg.length();
        let taking = taken.follow(leg);
        if bends.get(index + 1).is_none_or(|bends| *bends) {
            points.push(Waypoint {
                waypoint: points.len() as i64 + 1,
                x: leg.to.x,
                y: leg.to.y,
                heading: headings[index],
                clearance: clearances.as_ref().and_then(|clearances| clearances[index]),
                distance: is_measured.then_some(distance),
                cost: leg.cost,
                measures: taking.so_far,
                ..here
            });
        }
    }
    points
}
