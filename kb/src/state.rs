//! What a site knows at one moment, in memory: what is told, what planners gave, what rules concluded, and the graph of
//! routes. [`State::step`] is all that follows an edit, whoever made it: a build is a step from the empty state, a preview
//! a step of a fork, an edit a step whose change is kept in the database.

pub(crate) mod before;
mod courses;
pub(crate) mod grounds;
pub(crate) mod keep;
mod planned;
pub(crate) mod rows;
mod spaces;
mod step;
pub(crate) mod tunable;
mod twin;
pub mod weighed;
pub(crate) mod weights;

use std::sync::{Arc, Weak};
use std::time::Duration;

use adit_db::door::Door;
use adit_db::room::Room;
use adit_engine::KnowledgeBase as Inference;
use adit_planners::world::World;

use crate::error::{Code, Error, Result};
use crate::graph::gauge::{Gauge, Sizes};
use crate::graph::pairs::{self, Known, PlaceCosts};
use crate::graph::{Building, SiteGraph};
use crate::knowledge::inputs::Inputs;
use crate::knowledge::told::{Attached, Told};
use crate::knowledge::{KnowledgeBase, tolerance};
pub(crate) use courses::Courses;
pub(crate) use planned::Ahead;
use planned::Planned;
pub(crate) use step::{Nothing, Recall, Step, needs_changed};
use twin::Twin;
pub(crate) use weighed::{Look, Weighed, Which, truth};

/// How long a preview looks for routes between places, unless told otherwise.
const PATIENCE: Duration = Duration::from_millis(100);

/// What has to be undone where a step is not accepted.
pub struct Pending {
    attached: Attached,
    /// The inference before planners gave it other classes.
    inference: Option<Inference>,
}

/// What a site knows at one moment. A [fork](State::fork) of it shares nothing that a step of the one or the other would
/// change.
pub struct State {
    pub(crate) site: Arc<KnowledgeBase>,
    pub(crate) inputs: Arc<Inputs>,
    /// The map with what lies over it.
    pub(crate) world: Arc<World>,
    /// What people, robots and tables tell.
    pub(crate) told: Told,
    /// Which objects facts are about.
    pub(crate) attached: Attached,
    planned: Planned,
    /// What rules concluded.
    pub(crate) knowledge: Inference,
    twin: Twin,
    /// Routes over a map that is not cut into rooms.
    pub(crate) courses: Option<Arc<Courses>>,
    pub(crate) gauge: Arc<Gauge>,
    /// What has to be undone where a step is not accepted.
    pending: Option<Pending>,
    /// Number of the knowledge base's state.
    pub generation: u64,
    /// Routes between places, as far as anybody asked for them.
    pub(crate) known: Arc<Known>,
    /// What cells of tables weigh, as far as anybody asked for reasons.
    pub(crate) tunable: Arc<tunable::Effects>,
    pub(crate) patience: Duration,
    /// How far ends of routes may be moved to where something fits, metres; `None`: not at all.
    pub(crate) within: Option<f64>,
    /// Who waits for what is tried on this fork.
    pub(crate) waits: Waits,
}

/// Who waits for an answer; by default it is found whoever waits.
#[derive(Clone, Default)]
pub(crate) struct Waits(Option<Weak<()>>);

impl Waits {
    pub(crate) fn is_anybody(&self) -> bool {
        self.0.as_ref().is_none_or(|waits| waits.strong_count() > 0)
    }
}

impl State {
    /// Of a site of which nothing is known yet but its files, and the rooms and doors that the last build made.
    pub(crate) fn new(
        site: Arc<KnowledgeBase>,
        inputs: Arc<Inputs>,
        (rooms, doors, building): (Vec<Room>, Vec<Door>, Building),
    ) -> Self {
        let graph = SiteGraph::new(rooms, doors, rows::places(&inputs.world), Arc::new(building));
        let knowledge = Inference::new();
        let gauge = Arc::new(Gauge::new(&inputs.world, Sizes::new()));
        Self {
            site,
            world: Arc::clone(&inputs.world),
            inputs,
            told: Told::default(),
            attached: Attached::default(),
            planned: Planned::default(),
            knowledge,
            twin: Twin::new(graph),
            courses: None,
            gauge,
            pending: None,
            generation: 0,
            known: Arc::default(),
            tunable: Arc::default(),
            patience: PATIENCE,
            within: None,
            waits: Waits::default(),
        }
    }

    /// A copy to try things on, in memory only; the inference goes on from what was concluded.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self {
            site: Arc::clone(&self.site),
            inputs: Arc::clone(&self.inputs),
            world: Arc::clone(&self.world),
            told: self.told.clone(),
            attached: self.attached.clone(),
            planned: self.planned.clone(),
            knowledge: self.knowledge.fork(),
            twin: self.twin.fork(),
            courses: self.courses.clone(),
            gauge: Arc::clone(&self.gauge),
            pending: None,
            generation: self.generation,
            known: Arc::clone(&self.known),
            tunable: Arc::clone(&self.tunable),
            patience: self.patience,
            within: self.within,
            waits: self.waits.clone(),
        }
    }

    /// What is tried on it is given up once nobody holds this any more.
    #[must_use]
    pub fn waited_for_by(mut self, waits: Weak<()>) -> Self {
        self.waits = Waits(Some(waits));
        self
    }

    /// Whether anybody waits for what is tried on it.
    pub(crate) fn is_waited_for(&self) -> bool {
        self.waits.is_anybody()
    }

    /// The failure of what nobody waits for.
    pub(crate) fn go_on(&self) -> Result<()> {
        let message = "nobody waits for this any more, and nothing was changed";
        if self.is_waited_for() { Ok(()) } else { Err(Error::said(Code::ServiceLate, message, None)) }
    }

    /// Looks for routes between places for so long in a preview, or for as long as all before that took; what is not found by
    /// then is not compared. With none, none is.
    #[must_use]
    pub fn with_patience(mut self, patience: Duration) -> Self {
        self.patience = patience;
        self
    }

    /// Moves a start or goal at which nothing fits by up to so many metres, to the nearest point.
    pub fn within(mut self, metres: Option<f64>) -> Result<Self> {
        self.within = tolerance(metres)?;
        Ok(self)
    }

    /// Rooms, doors and places, with what rules say of them.
    pub(crate) fn graph(&self) -> &Arc<SiteGraph> {
        self.twin.shown()
    }

    /// Keeps ways between any two rooms ready.
    pub(crate) fn prepare(&mut self) {
        self.twin.prepare();
    }

    /// What routes between places cost once a step is accepted.
    pub(crate) fn place_costs(&self, step: &Step) -> PlaceCosts {
        if let Some(courses) = &step.courses {
            return courses.place_costs();
        }
        let (graph, robots) = (self.graph_after(step), step.told.robots());
        let all = pairs::starts(graph, &robots);
        let rows = pairs::rows((graph, self.gauge_after(step)), &robots, &all, || true);
        pairs::costs(graph, &robots, &rows)
    }

    /// What planners keep and may not have made yet.
    pub(crate) fn to_make_ahead(&self) -> Ahead {
        Ahead::of(self.site.planners(), &self.world, &self.knowledge)
    }

    /// The robots, in the order of their names.
    pub(crate) fn robots(&self) -> Vec<String> {
        self.courses.as_ref().map_or_else(|| self.told.robots(), |courses| courses.robots())
    }
}
