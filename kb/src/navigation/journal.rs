//! The journal of a mission: what happened, and by which rule.

use adit_db::mission::{Entry, Mission as Record};
use adit_engine::{Considered, Datum};
use adit_planners::navigation::{self, Happening, StateFacts};
use adit_planners::pose::Pose;
use serde_json::{Value, json};

use super::judge::{action_word, state_word, told_of};
use super::missions::Row;
use crate::plan::decided;

pub fn record(
    (world, rules, robot): (&str, &str, &str),
    row: &Row,
    shapes: &[String],
    entries: &[navigation::Entry],
    decided_by: Vec<Option<Considered>>,
) -> Record {
    let mut spoke = decided_by.into_iter();
    let entry = |entry: &navigation::Entry| {
        let (event, change, detail) = told(&entry.event.what, shapes);
        let rule = change.as_ref().and_then(|_| spoke.next().flatten());
        Entry {
            time: entry.event.time_s,
            event: event.to_owned(),
            change,
            rule: rule.as_ref().map(decided),
            pose: numbers(&entry.event.pose),
            truth: entry.truth.as_ref().map(numbers),
            detail: detail.map(|detail| detail.to_string()),
        }
    };
    Record {
        world: world.to_owned(),
        mission: row.mission as i64,
        seed: row.truth.as_ref().map(|truth| truth.seed.to_string()).unwrap_or_default(),
        rules: rules.to_owned(),
        robot: Some(row.robot.as_deref().unwrap_or(robot).to_owned()),
        start: row.start,
        goal: row.goal,
        obstacles: row.truth.as_ref().map_or(0, |truth| truth.obstacles as i64),
        ending: row.ending.to_owned(),
        length: row.length,
        optimum: row.truth.as_ref().and_then(|truth| truth.optimum),
        seconds: row.seconds,
        journal: entries.iter().map(entry).collect(),
    }
}

fn numbers(pose: &Pose) -> [f64; 3] {
    [pose.at.x, pose.at.y, pose.heading.to_degrees()]
}

type Told = (&'static str, Option<[String; 3]>, Option<Value>);

fn told(what: &Happening, shapes: &[String]) -> Told {
    let points = |points: &[adit_planners::geometry::Point]| -> Vec<[f64; 2]> {
        points.iter().map(|at| [at.x, at.y]).collect()
    };
    match what {
        Happening::State { facts, decision } => {
            let change = [state_word(facts.state), state_word(decision.state), action_word(decision.action)];
            ("state", Some(change.map(str::to_owned)), Some(situation(facts)))
        }
        Happening::SetEstimatedPosition(estimate) => {
            ("set estimated position", None, Some(json!({"pose": numbers(&estimate.pose)})))
        }
        Happening::Segments { entered, removed } => {
            ("segments", None, Some(json!({"entered": entered.len(), "removed": removed.len()})))
        }
        Happening::Contact { bearing } => ("contact", None, Some(json!({"bearing": bearing.to_degrees()}))),
        Happening::Planned { points: way, length_m, is_off_network } => (
            "planned",
            None,
            Some(json!({"points": points(way), "length": length_m, "off_network": is_off_network})),
        ),
        Happening::Detour { points: way, length_m, other_m } => {
            ("detour", None, Some(json!({"points": points(way), "length": length_m, "other": other_m})))
        }
        Happening::WayClosed { at, doorway, region, is_known, seen } => {
            let seen: Vec<[f64; 4]> =
                seen.iter().map(|line| [line.a.x, line.a.y, line.b.x, line.b.y]).collect();
            let at = [at.x, at.y];
            let detail =
                json!({"at": at, "doorway": doorway, "region": region, "known": is_known, "seen": seen});
            ("way closed", None, Some(detail))
        }
        Happening::Forbidden { doorways } => ("doorways closed", None, Some(json!({"doorways": doorways}))),
        Happening::Shape(shape) => ("shape", None, Some(json!({"state": shapes.get(*shape)}))),
        Happening::Located { poses, is_anywhere } => {
            let poses: Vec<[f64; 3]> = poses.iter().map(numbers).collect();
            ("located", None, Some(json!({"poses": poses, "anywhere": is_anywhere})))
        }
        Happening::Sought(at) => ("sought", None, Some(json!({"at": [at.x, at.y]}))),
        Happening::Told { laid, lifted } => ("told", None, Some(json!({"laid": laid, "lifted": lifted}))),
        Happening::Heard { is_other } => ("heard", None, Some(json!({"other_way": is_other}))),
        Happening::Silent(why) => ("silent", None, Some(json!({"why": why}))),
        Happening::Retried => ("begun anew", None, None),
        Happening::Reached(at) => ("reached", None, Some(json!({"at": [at.x, at.y]}))),
        Happening::Ended(ending) => {
            ("ended", None, Some(json!({"ending": super::missions::ending(*ending)})))
        }
        _ => ("other", None, None),
    }
}

fn situation(facts: &StateFacts) -> Value {
    let value = |datum| match datum {
        Datum::Number(number) => json!(number),
        Datum::Text(text) => json!(text),
        Datum::Truth(truth) => json!(truth),
        Datum::Unknown => Value::Null,
    };
    Value::Object(told_of(facts).map(|(name, datum)| (name.to_owned(), value(datum))).collect())
}
