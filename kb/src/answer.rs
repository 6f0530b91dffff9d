//! Answers to "how do I get from here to there": from the kept routes, or computed where none is kept.

mod json;
pub(crate) mod reason;
mod search;
mod steps;

use adit_db::route::{Route, Step, Waypoint};
use adit_db::{Store, Tx};
use serde::Serialize;

use crate::error::suggest::did_you_mean;
use crate::error::{Error, Result};
use crate::graph::gauge::{Gauge, sizes_of};
use crate::graph::{Rules, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::live::Memory;
use crate::site::states;
use crate::state::generation;

pub(crate) use search::Basis;

/// What became of the question. Never an empty answer without a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// There is a route.
    Ok,
    /// Start and goal lie in the same room: no door is passed.
    SameRoom,
    /// No route; the answer says why.
    NoRoute,
    /// The start is no place, room or point of the map.
    UnknownStart,
    /// The goal is no place, room or point of the map.
    UnknownGoal,
}

/// A route with its steps, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Answer {
    /// What became of the question.
    pub status: Status,
    /// Whose route.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// The state of the knowledge base that the answer rests on.
    pub generation: u64,
    /// Total hardness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// Metres; only where rooms weigh them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// Why there is no route, or which name is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The rows of `action_sequence`.
    pub steps: Vec<Step>,
    /// The rows of `waypoints`: where the way bends, changes shape, starts and ends.
    pub waypoints: Vec<Waypoint>,
}

impl KnowledgeBase {
    /// The route of least hardness between two places, rooms or points (`x,y`).
    ///
    /// As [`route_to_nearest`](Self::route_to_nearest), with one goal.
    pub fn route(&self, start: &str, goal: &str, robot: Option<&str>) -> Result<Answer> {
        self.route_to_nearest(start, &[goal.to_owned()], robot)
    }

    /// The route to the one of several goals that costs least; the answer's `goal` says which.
    ///
    /// Where tables, `site.toml` or the map were edited since the last build, or the time is over up to which it holds,
    /// everything is derived again first. Asked about [another moment](KnowledgeBase::at), it answers for that one, and
    /// leaves the site as it is.
    pub fn route_to_nearest(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        if self.asks_about_another_moment() {
            return self.rehearsed(|tx| self.answer(tx, start, goals, robot));
        }
        self.fresh()?.snapshot(|tx| self.answer(tx, start, goals, robot))
    }

    /// Does `work` on what would be derived now, and takes all of it back.
    pub(crate) fn rehearsed<T>(&self, work: impl FnOnce(&mut Tx<'_>) -> Result<T>) -> Result<T> {
        let inputs = self.inputs(&crate::report::progress::Silent)?;
        Store::open(self.database())?.rehearse(|tx| {
            Memory::build(tx, &self.shared(), &inputs, &crate::report::progress::Silent)?;
            work(tx)
        })
    }

    /// The database for reading. Where tables, `site.toml` or the map were edited since the last build, everything is
    /// derived again first.
    pub(crate) fn fresh(&self) -> Result<Store> {
        let mut store = Store::open_read_only(self.database())?;
        let texts = self.site().texts().to_string();
        let is_old = |tx: &mut Tx<'_>| -> Result<bool> {
            // a first build that was killed leaves tables, and nothing in them
            let is_unbuilt = generation::read(tx)? == 0;
            Ok(is_unbuilt || tx.is_stale()? || tx.site_value("texts")?.is_some_and(|built| built != texts))
        };
        if store.snapshot(is_old)? {
            drop(store);
            self.build(&crate::report::progress::Silent)?;
            store = Store::open_read_only(self.database())?;
        }
        Ok(store)
    }

    fn answer(&self, tx: &mut Tx<'_>, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        let robot = pick_robot(tx, robot)?;
        let mut answer = Answer::blank(&robot, start, goals, generation::read(tx)?);
        if let Some(route) = kept(tx, &robot, start, goals)? {
            answer.status = if route.status == "ok" { Status::Ok } else { Status::SameRoom };
            (answer.cost, answer.distance) = (route.cost, route.distance);
            answer.steps = tx.action_sequence(&robot, start, &route.goal)?;
            answer.waypoints = tx.waypoints(&robot, start, &route.goal)?;
            answer.goal = route.goal;
            return Ok(answer);
        }
        let graph = SiteGraph::new(tx.rooms()?, tx.doors()?, tx.places()?);
        let rules: Rules = tx.rules()?.into_iter().map(|rule| (rule.rule, rule.name)).collect();
        let states = states::in_force(tx)?;
        let (world, _, _) = self.site().world()?;
        let gauge = Gauge::new(&world, sizes_of(&states));
        let basis = Basis { knowledge: self, graph: &graph, rules: &rules, world: &world, gauge: &gauge };
        basis.search(goals, answer)
    }
}

impl Answer {
    /// An answer of which no more is known than the question.
    pub(crate) fn blank(robot: &str, start: &str, goals: &[String], generation: u64) -> Self {
        Self {
            status: Status::Ok,
            robot: robot.to_owned(),
            start: start.to_owned(),
            goal: goals.join(" "),
            generation,
            cost: None,
            distance: None,
            reason: None,
            steps: Vec::new(),
            waypoints: Vec::new(),
        }
    }
}

/// The kept route that costs least, if routes to all of the goals are kept.
fn kept(tx: &mut Tx<'_>, robot: &str, start: &str, goals: &[String]) -> Result<Option<Route>> {
    let mut best: Option<Route> = None;
    for goal in goals {
        let Some(route) = tx.route(robot, start, goal)? else { return Ok(None) };
        match route.status.as_str() {
            "ok" | "same_room" => {}
            "no_route" if goals.len() > 1 => continue,
            _ => return Ok(None),
        }
        if best.as_ref().is_none_or(|best| route.cost < best.cost) {
            best = Some(route);
        }
    }
    Ok(best)
}

/// The robot that is meant, or the only one.
pub(crate) fn pick_robot(tx: &mut Tx<'_>, wanted: Option<&str>) -> Result<String> {
    let mut robots: Vec<String> = tx.states()?.into_iter().map(|state| state.robot).collect();
    robots.dedup();
    pick(&robots, wanted)
}

/// The robot of these that is meant, or the only one.
pub(crate) fn pick(robots: &[String], wanted: Option<&str>) -> Result<String> {
    match wanted {
        Some(name) if robots.iter().any(|robot| robot == name) => Ok(name.to_owned()),
        Some(name) => {
            let help = did_you_mean(name, robots.iter().map(String::as_str));
            Err(Error::said("route/unknown-robot", format!("there is no robot `{name}`"), help))
        }
        None if robots.len() > 1 => {
            let message =
                format!("the site has several robots: say which with --robot ({})", robots.join(", "));
            Err(Error::said("route/which-robot", message, None))
        }
        None => robots.first().cloned().ok_or_else(|| {
            Error::said(
                "route/unbuilt",
                "the site has no robot yet",
                Some("run `adit build` first".to_owned()),
            )
        }),
    }
}
