//! What a plan is answered with, as JSON and as text.

use adit_db::plan::{Channel, Junction, PathStep, Plan};
use adit_planners::channels::assembly::{Cuboid, PartPath};
use serde_json::{Value, json};

use super::assembly::Assembly;
use super::said::Answer;
use super::steps::{AXES, named};
use crate::words::number::number;

/// A rule's number as rules give it: 1, not 1.0.
fn rule(rule: Option<f64>) -> Value {
    match rule {
        Some(whole) if whole.fract() == 0.0 && whole.abs() < 1e15 => json!(whole as i64),
        other => json!(other),
    }
}

impl<const D: usize> Answer<PartPath<D>> {
    /// As JSON: waypoints are the part's corner with the smallest coordinates.
    pub fn json(&self, world: &Assembly<D>, explained: bool) -> Value {
        self.as_json(explained, |path| json_of(path, world))
    }

    pub fn lines(&self, world: &Assembly<D>, explained: bool) -> Vec<String> {
        self.as_lines(explained, |path| lines_of(path, world))
    }

    pub fn record(&self, plan: &str, rules: &str, world: &Assembly<D>) -> Plan {
        let axes = world.geometry.axes();
        let channels = world.geometry.channels().iter().zip(axes);
        let junctions = (1_i64..).zip(world.geometry.junctions());
        let mut record = Plan {
            plan: plan.to_owned(),
            kind: "assembly".to_owned(),
            rules: rules.to_owned(),
            channels: channels
                .map(|(channel, axis)| Channel {
                    axis: AXES[named::<D>(*axis)].to_owned(),
                    extent: extent(channel),
                })
                .collect(),
            junctions: junctions
                .map(|(number, junction)| Junction {
                    channels: [number, number + 1],
                    extent: extent(junction),
                })
                .collect(),
            ..Plan::default()
        };
        self.add_to(&mut record, |path| (path.length, path.min_clearance, steps(world, path)));
        record
    }
}

fn json_of<const D: usize>(path: &PartPath<D>, world: &Assembly<D>) -> Value {
    let legs: Vec<Value> = path
        .legs
        .iter()
        .map(|leg| {
            let number = if leg.junction == 0 { json!("exit") } else { rule(leg.rule) };
            let mut object = json!({"junction": leg.junction, "rule": number});
            for (axis, by) in leg.displacement.iter().enumerate() {
                object[format!("md{}", AXES[named::<D>(axis)])] = json!(by);
            }
            object["min_clearance"] = json!(leg.min_clearance);
            object
        })
        .collect();
    let points = |points: &[[f64; D]]| -> Vec<Vec<f64>> { points.iter().map(|at| at.to_vec()).collect() };
    let mut answer = json!({
        "status": "ok",
        "waypoints": points(&path.waypoints),
        "length": path.length,
        "legs": legs,
        "min_clearance": path.min_clearance,
        "clearances": path.clearances,
        "states": (0..path.waypoints.len()).map(|at| world.state(path, at)).collect::<Vec<_>>(),
        "assembly": points(&path.reversed().waypoints),
    });
    if let Some(female) = world.female_waypoints(path) {
        answer["female"] = json!(points(&female));
    }
    answer
}

fn lines_of<const D: usize>(path: &PartPath<D>, world: &Assembly<D>) -> Vec<String> {
    let mut lines = Vec::new();
    let from = path.waypoints.first().map(|at| point(at)).unwrap_or_default();
    lines.push(format!("the part leaves {from}"));
    for (leg, at) in path.legs.iter().zip(path.waypoints.iter().skip(1)) {
        let whereto = match (leg.junction, leg.rule) {
            (0, _) => "out".to_owned(),
            (junction, Some(rule)) => format!("junction {junction}, rule {}", number(rule)),
            (junction, None) => format!("junction {junction}"),
        };
        let clearance = number(leg.min_clearance);
        lines.push(format!("  to {} ({whereto}; clearance {clearance})", point(at)));
    }
    lines.push(format!(
        "length {}, least clearance {}; reversed it is the way in",
        number(path.length),
        number(path.min_clearance)
    ));
    if let Some(female) = world.female_waypoints(path) {
        let points: Vec<String> = female.iter().map(|at| point(at)).collect();
        lines.push(format!("the other part moves: its origin is at {}", points.join(", ")));
    }

    lines
}

fn steps<const D: usize>(world: &Assembly<D>, path: &PartPath<D>) -> Vec<PathStep> {
    let step = |kind, junction, rule, at: &[f64; D], length, clearance| PathStep {
        kind,
        state: None,
        junction,
        rule,
        at: three(at),
        circle: None,
        turn: None,
        heading: None,
        length,
        clearance,
    };
    let start = path.waypoints.iter().zip(&path.clearances).take(1);
    let start = start.map(|(at, clearance)| step("start", None, None, at, 0.0, *clearance));
    let legs = path.legs.iter().zip(path.waypoints.iter().skip(1)).map(|(leg, at)| {
        let length = leg.displacement.iter().map(|by| by * by).sum::<f64>().sqrt();
        let junction = (leg.junction > 0).then_some(leg.junction as i64);
        step("line", junction, leg.rule, at, length, leg.min_clearance)
    });
    let mut steps: Vec<PathStep> = start.chain(legs).collect();
    for (at, step) in steps.iter_mut().enumerate() {
        step.state = world.state(path, at);
    }
    steps
}

/// x, y and z of a point; what its world has not is unknown.
fn three<const D: usize>(at: &[f64; D]) -> [Option<f64>; 3] {
    let mut three = [None; 3];
    for (axis, value) in at.iter().enumerate() {
        three[named::<D>(axis)] = Some(*value);
    }
    three
}

fn extent<const D: usize>(of: &Cuboid<D>) -> [Option<f64>; 6] {
    let ([x0, y0, z0], [x1, y1, z1]) = (three(&of.min), three(&of.max));
    [x0, y0, z0, x1, y1, z1]
}

fn point(at: &[f64]) -> String {
    let numbers: Vec<String> = at.iter().map(|value| number(*value)).collect();
    format!("({})", numbers.join(", "))
}
