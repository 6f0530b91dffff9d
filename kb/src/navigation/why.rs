//! Why a robot did what its journal says: the rules are asked anew, with the facts of that moment.

use std::path::Path;
use std::sync::Arc;

use adit_db::Store;
use adit_db::mission::{Decision, Happened};
use adit_engine::Datum;
use serde::Serialize;
use serde_json::{Map, Value};

use super::judge::RuleJudge;
use super::missions::ended;
use super::story::{self, Chapter};
use crate::error::{Code, Error, Result};
use crate::plan::Spoke;
use crate::site::base::Base;
use crate::site::rules;
use crate::words::number::number;
use crate::words::suggest::did_you_mean;

/// A decision of a mission, and the rules that were looked at.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    pub world: String,
    pub mission: i64,
    /// Which robot it was, if that is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    /// How it ended: `arrived`, `no_way`, `lost`, `silent` or `gave_up`.
    pub ending: String,
    /// Where the mission led from and to, metres.
    pub ends: [[f64; 2]; 2],
    /// Metres that the robot went in all.
    pub length: f64,
    /// What it met until then.
    pub story: Vec<Chapter>,
    pub entry: i64,
    /// Seconds by the robot's clock.
    pub time: f64,
    /// Where the robot thought it was, metres.
    pub at: [f64; 2],
    pub state: String,
    pub next: String,
    /// What was done on the way.
    pub action: String,
    pub rules: String,
    /// What the rules say now, where they have been changed since: next state and action.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub now: Option<[String; 2]>,
    pub facts: Map<String, Value>,
    /// The rules that say what comes next, tables row by row: which spoke, and why the others did not.
    pub considered: Vec<Spoke>,
}

/// A decision, if there was one, and what happened until then.
type Found = (Option<Decision>, Vec<Happened>);

/// A time that people write may be less than the one of the journal by so much.
const ROUNDED_S: f64 = 0.005;

/// Asks why a robot stopped for good.
///
/// # Arguments
/// `world` may be left out where the database has missions of one only; `at` are seconds: the decision that was in force
/// then, instead of the last one of the mission. `rules` stands instead of the rule base that the mission had.
pub fn why(
    database: &Path,
    mission: &str,
    world: Option<&str>,
    at: Option<f64>,
    rules: Option<&Path>,
) -> Result<Answer> {
    let number: i64 = mission.trim().trim_start_matches("mission ").trim().parse().map_err(|_| {
        let message = format!("`{mission}` is no mission of {}: missions have numbers", database.display());
        Error::said(Code::WhyNoMission, message, None)
    })?;
    if let Some(at) = at.filter(|at| !at.is_finite()) {
        return Err(Error::said(Code::WhyTime, format!("--at {at} is no time; expected seconds"), None));
    }
    let mut store = Store::open_read_only(database)?;
    let (world, found) = store.snapshot(|tx| -> Result<(String, Found)> {
        let world = one_world(&tx.worlds_of_missions()?, world, database)?;
        let (count, first, last) = tx.numbers_of_missions(&world)?;
        if !(first..=last).contains(&number) {
            let message =
                format!("{world} has no mission {number}; its {count} are numbered {first} to {last}");
            return Err(Error::said(Code::WhyNoMission, message, None));
        }
        // Times are read from tables, where they are rounded.
        let until = at.map_or(f64::INFINITY, |at| at + ROUNDED_S);
        let decision = tx.decision(&world, number, until)?;
        let happened = tx.events_of_mission(&world, number, until)?;
        Ok((world, (decision, happened)))
    })?;
    let (decision, happened) = found;
    let story = story::told(&happened);
    let Some(decision) = decision else {
        let when = at.map_or_else(String::new, |at| format!(" yet at {} s", self::number(at)));
        let because = story.last().map_or_else(String::new, |last| format!(": {}", last.text));
        let message = format!("mission {number} of {world} had decided nothing{when}{because}");
        return Err(Error::said(Code::WhyNoStop, message, None));
    };
    let mut answer = explained((world, number), decision, rules)?;
    answer.story = story;
    Ok(answer)
}

fn one_world(worlds: &[String], wanted: Option<&str>, database: &Path) -> Result<String> {
    let listed = || format!("it has missions of {}", worlds.join(", "));
    match (wanted, worlds) {
        (_, []) => {
            let help = "`adit simulate WORLD --db FILE` keeps missions with their journals".to_owned();
            Err(Error::said(
                Code::WhyNoMissions,
                format!("{} keeps no missions", database.display()),
                Some(help),
            ))
        }
        (None, [world]) => Ok(world.clone()),
        (None, _) => {
            let message = format!("{} has missions of several worlds", database.display());
            Err(Error::said(
                Code::WhyWhichWorld,
                message,
                Some(format!("--world NAME says which: {}", listed())),
            ))
        }
        (Some(wanted), _) if worlds.iter().any(|world| world == wanted) => Ok(wanted.to_owned()),
        (Some(wanted), _) => {
            let help = did_you_mean(wanted, worlds.iter().map(String::as_str)).unwrap_or_else(listed);
            let message = format!("{} has no missions of a world `{wanted}`", database.display());
            Err(Error::said(Code::WhyWhichWorld, message, Some(help)))
        }
    }
}

fn facts(decision: &Decision) -> Map<String, Value> {
    decision.detail.as_deref().and_then(|detail| serde_json::from_str(detail).ok()).unwrap_or_default()
}

fn explained((world, mission): (String, i64), decision: Decision, rules: Option<&Path>) -> Result<Answer> {
    let instead = rules.map(|rules| rules.display().to_string());
    let names = instead.unwrap_or_else(|| decision.rules.clone());
    let bases: Vec<Base> = names.lines().map(|name| Base::named(name, Path::new(""))).collect();
    let base = Arc::new(rules::load_bases(&bases)?.base);
    let mut judge = RuleJudge::new(&base).map_err(Error::of(Code::WhyRules))?;
    let facts = facts(&decision);
    let (said, considered) = judge.consider(|name| match facts.get(name) {
        Some(Value::Number(number)) => number.as_f64().into(),
        Some(Value::String(text)) => Datum::Text(text),
        Some(Value::Bool(truth)) => Datum::Truth(*truth),
        _ => Datum::Unknown,
    });
    if let Some(trouble) = judge.trouble() {
        return Err(Error::said(Code::WhyRules, trouble.to_owned(), None));
    }
    let was = [decision.next.clone(), decision.action.clone()];
    Ok(Answer {
        world,
        mission,
        robot: decision.robot,
        ending: decision.ending,
        ends: decision.ends,
        length: decision.length,
        story: Vec::new(),
        entry: decision.entry,
        time: decision.time,
        at: decision.at,
        state: decision.state,
        next: decision.next,
        action: decision.action,
        rules: names.replace('\n', ", "),
        now: (said != was).then_some(said),
        considered: considered.into_iter().map(Spoke::from).collect(),
        facts,
    })
}

impl Answer {
    pub fn lines(&self) -> Vec<String> {
        let action = if self.action == "none" { String::new() } else { format!(", {}", self.action) };
        let [[x0, y0], [x1, y1]] = self.ends;
        let robot = self.robot.as_ref().map_or_else(String::new, |robot| format!(" by {robot}"));
        let mut lines = vec![
            format!(
                "mission {} of {}{robot}, from ({x0:.2}, {y0:.2}) to ({x1:.2}, {y1:.2})",
                self.mission, self.world
            ),
            format!("it {}, after {} m", ended(&self.ending), number(self.length)),
        ];
        lines.extend(self.story.iter().map(Chapter::line));
        lines.push(format!(
            "at {:.2} s it stood at ({:.2}, {:.2}): {} -> {}{action}",
            self.time, self.at[0], self.at[1], self.state, self.next
        ));
        if let Some([next, action]) = &self.now {
            lines.push(format!("the rules have changed since: now they say {next}, action {action}"));
        }
        let of_state = |spoke: &&Spoke| spoke.row.is_some();
        for spoke in self.considered.iter().filter(of_state).filter(|spoke| spoke.spoke) {
            lines.push(format!("because of {}", spoke.text()));
        }
        let facts = self.facts.iter().filter(|(_, value)| !value.is_null());
        let facts: Vec<String> = facts.map(|(name, value)| format!("{name} {}", told(value))).collect();
        lines.push(format!("told: {}", facts.join(", ")));
        for spoke in self.considered.iter().filter(of_state).filter(|spoke| !spoke.spoke) {
            lines.push(format!("not {}", spoke.text()));
        }
        lines
    }
}

fn told(value: &Value) -> String {
    match value {
        Value::Number(value) => value.as_f64().map_or_else(|| value.to_string(), number),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
