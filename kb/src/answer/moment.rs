//! What questions are answered from: a site at one moment, which may be asked from any thread while edits go on.

use std::sync::Arc;

use adit_planners::world::World;

use super::{Answer, Basis, Ground, pick};
use crate::error::Result;
use crate::graph::SiteGraph;
use crate::graph::gauge::Gauge;
use crate::knowledge::inputs::Inputs;
use crate::knowledge::{KnowledgeBase, tolerance};
use crate::state::{Courses, State};

/// The site at one moment. A copy costs nothing.
#[derive(Clone)]
pub(crate) struct Moment {
    pub site: Arc<KnowledgeBase>,
    pub inputs: Arc<Inputs>,
    pub world: Arc<World>,
    pub graph: Arc<SiteGraph>,
    pub courses: Option<Arc<Courses>>,
    pub gauge: Arc<Gauge>,
    pub robots: Arc<[String]>,
    /// Number of the knowledge base's state.
    pub generation: u64,
    within: Option<f64>,
}

impl State {
    /// What questions are now answered from.
    pub(crate) fn moment(&self) -> Moment {
        Moment {
            site: Arc::clone(&self.site),
            inputs: Arc::clone(&self.inputs),
            world: Arc::clone(&self.world),
            graph: Arc::clone(self.graph()),
            courses: self.courses.clone(),
            gauge: Arc::clone(&self.gauge),
            robots: self.robots().into(),
            generation: self.generation,
            within: self.within,
        }
    }

    /// The route of least hardness, as [`Live::route`](crate::Live::route) gives it.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        self.moment().route(start, goals, robot)
    }

    pub(crate) fn basis(&self) -> Basis<'_> {
        basis((self.graph(), &self.inputs), (&self.world, &self.gauge), self.within)
    }
}

impl Moment {
    /// Moves a start or goal at which nothing fits by up to so many metres, to the nearest point.
    pub fn within(mut self, metres: Option<f64>) -> Result<Self> {
        self.within = tolerance(metres)?;
        Ok(self)
    }

    /// The route of least hardness to the one of several goals that costs least. Nothing is read but memory.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        let robot = pick(&self.robots, robot)?;
        if let Some(courses) = &self.courses {
            self.site.site().moves_ends(self.within)?;
            return Ok(Answer::by(courses, (start, goals), &robot, self.generation));
        }
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().search(goals, blank)
    }

    /// What [`route`](Self::route) answers, as JSON, in microseconds; `None` where there is no route, or rooms weigh metres.
    pub fn quick_route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Option<Vec<u8>>> {
        if self.courses.is_some() {
            return Ok(None);
        }
        let robot = pick(&self.robots, robot)?;
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().quick(goals, blank)
    }

    fn basis(&self) -> Basis<'_> {
        basis((&self.graph, &self.inputs), (&self.world, &self.gauge), self.within)
    }
}

/// For whoever starts and arrives in whichever state is cheapest.
fn basis<'a>(
    (graph, inputs): (&'a SiteGraph, &'a Inputs),
    (world, gauge): (&'a World, &'a Gauge),
    within: Option<f64>,
) -> Basis<'a> {
    let ground = Ground::Known(world, gauge);
    Basis { graph, rules: &inputs.rule_names, ground, within, ends_in: [None; 2], start_facing: None }
}
