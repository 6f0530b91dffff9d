//! Routes as they are found in memory, with what is said of them.

use std::cell::OnceCell;

use adit_planners::routes::{Goal, Way};
use adit_planners::world::World;

use super::{Answer, Status, json, steps};
use crate::answer::reason;
use crate::error::{Code, Error, Result};
use crate::graph::gauge::{Gauge, Sizes};
use crate::graph::{End, Rules, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::site::Site;
use crate::words::suggest::did_you_mean;

/// What routes are found with.
pub(crate) struct Basis<'a> {
    /// The site.
    pub knowledge: &'a KnowledgeBase,
    /// Its rooms and doors.
    pub graph: &'a SiteGraph,
    /// The rules' names.
    pub rules: &'a Rules,
    pub ground: Ground<'a>,
}

/// The map, with what measures clearances in it.
pub(crate) enum Ground<'a> {
    Known(&'a World, &'a Gauge),
    /// For a single question: read where it needs the map, for robots of these sizes.
    Later(&'a Site, Sizes, OnceCell<Box<(World, Gauge)>>),
}

impl Ground<'_> {
    fn get(&self) -> Result<(&World, &Gauge)> {
        match self {
            Self::Known(world, gauge) => Ok((world, gauge)),
            Self::Later(site, sizes, read) => {
                if read.get().is_none() {
                    let world = site.world()?;
                    let gauge = Gauge::new(&world, sizes.clone());
                    read.get_or_init(|| Box::new((world, gauge)));
                }
                let (world, gauge) = &**read.get().expect("it was read just now");
                Ok((world, gauge))
            }
        }
    }
}

/// A way that was found.
struct Found {
    /// To which goal, by index.
    goal: usize,
    way: Way,
    /// Whether it leads to a point, not to anywhere in a room.
    is_to_point: bool,
}

impl Basis<'_> {
    /// The route to the one of the goals that costs least, into the answer.
    pub fn search(&self, names: &[String], mut answer: Answer) -> Result<Answer> {
        let Self { graph, rules, .. } = self;
        let Some(ends) = self.ends(names, &mut answer)? else { return Ok(answer) };
        if let Some(found) = self.find(&ends, &answer.robot) {
            answer.goal.clone_from(&names[found.goal]);
            self.along(&found.way, found.is_to_point, &mut answer)?;
        } else {
            answer.status = Status::NoRoute;
            let start = graph.start(&ends[0], Some(&answer.robot));
            let reason = reason::no_route(self.knowledge, graph, rules, &start, &ends, &answer.robot)?;
            answer.reason = Some(reason);
        }
        Ok(answer)
    }

    /// What [`search`](Self::search) finds, as JSON, in microseconds; `None` where there is no route, or the site's graph is
    /// not [prepared](SiteGraph::prepare).
    pub fn quick(&self, names: &[String], mut answer: Answer) -> Result<Option<Vec<u8>>> {
        let Some(texts) = self.graph.texts() else { return Ok(None) };
        let Some(ends) = self.ends(names, &mut answer)? else { return Ok(None) };
        let Some(found) = self.find(&ends, &answer.robot) else { return Ok(None) };
        answer.goal.clone_from(&names[found.goal]);
        let text = json::write(&answer, (self.graph, texts, self.rules), &found.way);
        text.map(Some).map_err(Error::of(Code::RouteJson))
    }

    /// What start and goals are; where one is nothing, the answer says so.
    fn ends(&self, names: &[String], answer: &mut Answer) -> Result<Option<Vec<End>>> {
        let graph = self.graph;
        let mut ends = Vec::with_capacity(names.len() + 1);
        for (index, name) in std::iter::once(&answer.start).chain(names).enumerate() {
            let Some(end) = graph.end(name) else {
                let meant =
                    did_you_mean(name, graph.names()).map_or(String::new(), |help| format!("; {help}"));
                answer.reason = Some(format!("`{name}` is no place, no room and no point `x,y`{meant}"));
                answer.status = if index == 0 { Status::UnknownStart } else { Status::UnknownGoal };
                return Ok(None);
            };
            ends.push(end);
        }
        for end in &ends {
            self.check_point(end)?;
        }
        Ok(Some(ends))
    }

    /// The way from the first end to the one of the others that costs least.
    fn find(&self, ends: &[End], robot: &str) -> Option<Found> {
        let graph = self.graph;
        let start = graph.start(&ends[0], Some(robot));
        let goals: Vec<Goal> = ends[1..].iter().map(|end| graph.goal(end, Some(robot))).collect();
        let (goal, way) = graph.graph().way(&start, &goals)?;
        Some(Found { goal, way, is_to_point: goals[goal].at.is_some() })
    }

    /// A way as an answer; where it does not lead to a point, nothing is walked in the last room.
    pub fn along(&self, way: &Way, is_to_point: bool, answer: &mut Answer) -> Result<()> {
        let Self { graph, rules, .. } = self;
        answer.steps = steps::steps(graph, rules, way, is_to_point);
        let is_measured = !graph.graph().is_on_doors();
        let gauge = if is_measured { Some(self.ground.get()?.1) } else { None };
        answer.waypoints = steps::waypoints(graph, way, gauge);
        answer.cost = Some(way.cost);
        answer.distance = is_measured.then(|| way.length());
        answer.status = Status::of(way);
        Ok(())
    }

    /// A point that is asked for must lie on the floor.
    fn check_point(&self, end: &End) -> Result<()> {
        let End::Point(point) = end else { return Ok(()) };
        let named = format!("{},{}", point.x, point.y);
        let (world, gauge) = self.ground.get()?;
        if !world.bounds.contains(*point) {
            let b = world.bounds;
            let map = format!("the map goes from {},{} to {},{}", b.x0, b.y0, b.x1, b.y1);
            return Err(Error::said(Code::RouteOutside, format!("{named} is outside of the map"), Some(map)));
        }
        if gauge.is_solid(world, *point) {
            return Err(Error::said(Code::RouteSolid, format!("{named} is inside an obstacle"), None));
        }
        Ok(())
    }
}

impl Status {
    /// What a way makes of the question.
    pub(super) fn of(way: &Way) -> Self {
        if way.legs.iter().all(|leg| leg.door.is_none()) { Self::SameRoom } else { Self::Ok }
    }
}
