//! Answers to "how do I get from here to there": from the kept routes, or computed where none is kept.

use adit_db::door::DoorKind;
use adit_db::route::Step;
use adit_db::{Store, Tx};
use adit_planners::geometry::Point;
use adit_planners::routes::Arrival;
use serde::Serialize;

use crate::error::{Error, Result};
use crate::graph::{End, Rules, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::suggest::did_you_mean;
use crate::{generation, reason, trees};

/// What became of the question. Never an empty answer without a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    /// Why there is no route, or which name is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The rows of `action_sequence`.
    pub steps: Vec<Step>,
}

impl KnowledgeBase {
    /// The route of least hardness between two places, rooms or points (`x,y`).
    ///
    /// Where tables, `site.toml` or the map were edited since the last build, or the time is over up to which it holds,
    /// everything is derived again first. Asked about [another moment](KnowledgeBase::at), it answers for that one, and
    /// leaves the site as it is.
    pub fn route(&self, start: &str, goal: &str, robot: Option<&str>) -> Result<Answer> {
        if self.asks_about_another_moment() {
            return self.rehearsed(|tx| self.answer(tx, start, goal, robot));
        }
        self.fresh()?.snapshot(|tx| self.answer(tx, start, goal, robot))
    }

    /// Does `work` on what would be derived now, and takes all of it back.
    pub(crate) fn rehearsed<T>(&self, work: impl FnOnce(&mut Tx<'_>) -> Result<T>) -> Result<T> {
        let inputs = self.inputs(&crate::progress::Silent)?;
        Store::open(self.database())?.rehearse(|tx| {
            self.follow(tx, &inputs, &crate::progress::Silent)?;
            work(tx)
        })
    }

    /// The database for reading. Where tables, `site.toml` or the map were edited since the last build, everything is
    /// derived again first.
    pub(crate) fn fresh(&self) -> Result<Store> {
        let mut store = Store::open_read_only(self.database())?;
        let texts = self.site().texts().to_string();
        let is_old = |tx: &mut Tx<'_>| -> Result<bool> {
            Ok(tx.is_stale()? || tx.site_value("texts")?.is_some_and(|built| built != texts))
        };
        if store.snapshot(is_old)? {
            drop(store);
            self.build(&crate::progress::Silent)?;
            store = Store::open_read_only(self.database())?;
        }
        Ok(store)
    }

    fn answer(&self, tx: &mut Tx<'_>, start: &str, goal: &str, robot: Option<&str>) -> Result<Answer> {
        let robot = pick_robot(tx, robot)?;
        let generation = generation::read(tx)?;
        let mut answer = Answer {
            status: Status::Ok,
            robot: robot.clone(),
            start: start.to_owned(),
            goal: goal.to_owned(),
            generation,
            cost: None,
            reason: None,
            steps: Vec::new(),
        };
        if let Some(route) = tx.route(&robot, start, goal)?
            && ["ok", "same_room"].contains(&route.status.as_str())
        {
            answer.status = if route.status == "ok" { Status::Ok } else { Status::SameRoom };
            answer.cost = route.cost;
            answer.steps = tx.action_sequence(&robot, start, goal)?;
            return Ok(answer);
        }
        let graph = SiteGraph::new(tx.rooms()?, tx.doors()?, tx.places()?);
        let rules = tx.rules()?.into_iter().map(|rule| (rule.rule, rule.name)).collect();
        self.search(&graph, &rules, answer)
    }

    fn search(&self, graph: &SiteGraph, rules: &Rules, mut answer: Answer) -> Result<Answer> {
        let mut ends = Vec::new();
        let names = [answer.start.clone(), answer.goal.clone()];
        for (name, status) in names.iter().zip([Status::UnknownStart, Status::UnknownGoal]) {
            let Some(end) = graph.end(name) else {
                let meant =
                    did_you_mean(name, graph.names()).map_or(String::new(), |help| format!("; {help}"));
                answer.reason = Some(format!("`{name}` is no place, no room and no point `x,y`{meant}"));
                answer.status = status;
                return Ok(answer);
            };
            ends.push(end);
        }
        for end in &ends {
            self.check_point(end)?;
        }
        let (start, goals) =
            (graph.start(&ends[0], Some(&answer.robot)), graph.rooms_of(&ends[1], Some(&answer.robot)));
        let goal = match ends[1] {
            End::Room(_) => None,
            _ => Some(graph.point(&ends[1])),
        };
        let tree = graph.graph().tree_until(&start, &goals, goal);
        let reached = match goal {
            Some(goal) => tree.best_at(graph.graph(), &goals, goal),
            None => goals.iter().find_map(|&room| tree.of_room[room].first()).map(|&arrival| (arrival, 0.0)),
        };
        let Some((arrival, leg)) = reached else {
            answer.status = Status::NoRoute;
            answer.reason = Some(reason::no_route(self, graph, rules, &start, &ends, &answer.robot)?);
            return Ok(answer);
        };
        let last = goal.map(|goal| (goal, leg));
        answer.steps = steps(graph, rules, &tree.way(arrival), last);
        answer.cost = answer.steps.last().map(|step| step.cost);
        let doors = answer.steps.iter().filter(|step| step.kind != "room").count();
        answer.status = if doors == 0 { Status::SameRoom } else { Status::Ok };
        Ok(answer)
    }

    /// A point of the command line must lie on the floor.
    fn check_point(&self, end: &End) -> Result<()> {
        let End::Point(point) = end else { return Ok(()) };
        let (world, _, _) = self.site().world()?;
        let named = format!("{},{}", point.x, point.y);
        if !world.bounds.contains(*point) {
            let b = world.bounds;
            let map = format!("the map goes from {},{} to {},{}", b.x0, b.y0, b.x1, b.y1);
            return Err(Error::said("route/outside", format!("{named} is outside of the map"), Some(map)));
        }
        if world.is_solid(*point) {
            return Err(Error::said("route/solid", format!("{named} is inside an obstacle"), None));
        }
        Ok(())
    }
}

/// The robot that is meant, or the only one.
pub(crate) fn pick_robot(tx: &mut Tx<'_>, wanted: Option<&str>) -> Result<String> {
    let mut robots: Vec<String> = tx.states()?.into_iter().map(|state| state.robot).collect();
    robots.dedup();
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
        None => robots.pop().ok_or_else(|| {
            Error::said(
                "route/unbuilt",
                "the site has no robot yet",
                Some("run `adit build` first".to_owned()),
            )
        }),
    }
}

/// The rows of `action_sequence` of a route that is not kept; `last` is a goal point and the hardness of the way to it.
fn steps(graph: &SiteGraph, rules: &Rules, way: &[&Arrival], last: Option<(Point, f64)>) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::with_capacity(way.len() * 2);
    for pair in way.windows(2) {
        let (entry, exit) = (pair[0], pair[1]);
        let Some(door) = exit.from.and_then(|(_, door)| graph.door(i64::from(door))) else { continue };
        let heading = trees::heading(entry.at, exit.at);
        steps.push(room_step(graph, rules, entry.room, exit.leg, entry.cost + exit.leg, exit.at, heading));
        let (kind, layer_of) = match door.kind {
            DoorKind::Door => ("door", entry.room),
            DoorKind::Change => ("change", exit.room),
        };
        steps.push(Step {
            step: 0,
            kind: kind.to_owned(),
            place: door.door.to_string(),
            state: graph.rooms[layer_of].layer.as_ref().map(|(_, state)| state.clone()),
            action: door.action.value.clone(),
            hardness: door.hardness.value,
            cost: exit.cost,
            x: Some(exit.at.x),
            y: Some(exit.at.y),
            heading,
            rule: door.hardness.rule.and_then(|rule| rules.get(&rule).cloned()),
        });
    }
    if let Some(arrival) = way.last() {
        let (at, leg) = last.unwrap_or((arrival.at, 0.0));
        let heading = last.and_then(|(goal, _)| trees::heading(arrival.at, goal));
        steps.push(room_step(graph, rules, arrival.room, leg, arrival.cost + leg, at, heading));
    }
    for (number, step) in (1..).zip(&mut steps) {
        step.step = number;
    }
    steps
}

fn room_step(
    graph: &SiteGraph,
    rules: &Rules,
    room: usize,
    hardness: f64,
    cost: f64,
    at: Point,
    heading: Option<f64>,
) -> Step {
    let room = &graph.rooms[room];
    Step {
        step: 0,
        kind: "room".to_owned(),
        place: room.name.clone(),
        state: room.layer.as_ref().map(|(_, state)| state.clone()),
        action: room.action.value.clone(),
        hardness: Some(hardness),
        cost,
        x: Some(at.x),
        y: Some(at.y),
        heading,
        rule: room.action.rule.and_then(|rule| rules.get(&rule).cloned()),
    }
}
