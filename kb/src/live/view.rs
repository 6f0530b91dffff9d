//! What questions are answered from: the site as it was after some edit, which no later edit changes.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use adit_planners::routes::Goal;

use super::Live;
use crate::answer::{self, Answer};
use crate::error::Result;
use crate::graph::gauge::Gauge;
use crate::graph::{End, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::report::PlaceCosts;
use crate::state::inputs::Inputs;

/// The site at one moment. A copy costs nothing, and may be asked from any thread while edits go on.
#[derive(Clone)]
pub struct View {
    site: Arc<KnowledgeBase>,
    inputs: Arc<Inputs>,
    graph: Arc<SiteGraph>,
    gauge: Arc<Gauge>,
    robots: Arc<[String]>,
    layout: Arc<str>,
    generation: u64,
    routes_due: bool,
}

impl Live {
    /// The site as it is after the last edit.
    pub fn view(&self) -> View {
        let memory = &self.memory;
        View {
            site: Arc::clone(&self.site),
            inputs: Arc::clone(&memory.state.inputs),
            graph: Arc::clone(memory.state.graph()),
            gauge: Arc::clone(&memory.state.gauge),
            robots: memory.state.robots().into(),
            layout: Arc::clone(&memory.layout),
            generation: memory.state.generation,
            routes_due: memory.routes_due,
        }
    }
}

impl View {
    /// The route of least hardness to the one of several goals that costs least. Nothing is read but memory.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        let robot = answer::pick(&self.robots, robot)?;
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().search(goals, blank)
    }

    /// What [`route`](Self::route) answers, as JSON, in microseconds; `None` where there is no route, or rooms weigh metres.
    pub(crate) fn quick_route(
        &self,
        start: &str,
        goals: &[String],
        robot: Option<&str>,
    ) -> Result<Option<Vec<u8>>> {
        let robot = answer::pick(&self.robots, robot)?;
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().quick(goals, blank)
    }

    fn basis(&self) -> answer::Basis<'_> {
        answer::Basis {
            knowledge: &self.site,
            graph: &self.graph,
            rules: &self.inputs.rule_names,
            world: &self.inputs.world,
            gauge: &self.gauge,
        }
    }

    /// What routes between places cost, by robot, start and goal; those that there are.
    pub fn place_costs(&self) -> PlaceCosts {
        let graph = &self.graph;
        let place = |index| End::Place(index);
        let all = 0..graph.places.len();
        let mut costs = PlaceCosts::new();
        for robot in self.robots.iter() {
            let goals: Vec<Goal> =
                all.clone().map(|index| graph.goal(&place(index), Some(robot.as_str()))).collect();
            for from in all.clone() {
                let start = graph.start(&place(from), Some(robot.as_str()));
                let ways = graph.graph().ways(&start, &goals, false).goals;
                for (to, way) in ways.into_iter().enumerate() {
                    if let Some(way) = way {
                        let [start, goal] = [from, to].map(|index| graph.places[index].place.clone());
                        costs.insert((robot.clone(), start, goal), way.cost);
                    }
                }
            }
        }
        costs
    }

    /// The site's files.
    pub fn site(&self) -> &KnowledgeBase {
        &self.site
    }

    /// The map and the rules.
    pub(crate) fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Rooms, doors and places.
    pub(crate) fn graph(&self) -> &SiteGraph {
        &self.graph
    }

    /// The robots, in the order of their names.
    pub fn robots(&self) -> &[String] {
        &self.robots
    }

    /// Number of the knowledge base's state.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Names the cut of the floor: while it is the same, numbers of rooms and doors mean what they meant.
    pub fn layout(&self) -> &str {
        &self.layout
    }

    /// Whether kept routes have yet to follow the last edits.
    pub fn routes_due(&self) -> bool {
        self.routes_due
    }
}

/// A name of the cut of a floor: rooms, doors and places by their geometry.
pub fn layout(graph: &SiteGraph) -> Arc<str> {
    let mut hasher = DefaultHasher::new();
    for room in &graph.rooms {
        (room.room, &room.name, room.rect.map(f64::to_bits), &room.layer).hash(&mut hasher);
    }
    for door in &graph.doors {
        (door.door, door.side1.room, door.side2.room, door.segment.map(f64::to_bits)).hash(&mut hasher);
    }
    for place in &graph.places {
        (&place.place, place.x.to_bits(), place.y.to_bits()).hash(&mut hasher);
    }
    format!("{:016x}", hasher.finish()).into()
}
