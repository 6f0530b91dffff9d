//! The learning planner Adapt (Chen 1994, Figure 1).

mod abstracted;
mod augment;
mod change;
mod corners;
mod find;
mod repair;
mod report;
mod settings;
mod task;
mod tighten;
mod trace;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub use change::Changed;
pub use report::{Outcome, Report, Tally};
pub use settings::{Heuristic, Settings};

use super::execution::Outlines;
use super::experience::{Edge, EdgeId, Experience, Vertex, VertexId};
use super::noted::{Noted, Removal};
use super::probe::Probe;
use super::reach::{Reach, Straight};
use super::robot::Configuration;
use super::solve::{RrtConnect, Solve};
use super::workcell::{Revision, Workcell};

/// The two planners that Adapt joins.
#[derive(Clone, Debug)]
pub struct Plugins {
    /// The fast local one.
    pub reach: Arc<dyn Reach>,
    /// The slow global one.
    pub solve: Arc<dyn Solve>,
}

impl Plugins {
    /// A Reach that goes straight, and RRT-Connect as Solve.
    pub fn standard() -> Self {
        Self { reach: Arc::new(Straight), solve: Arc::new(RrtConnect::default()) }
    }
}

/// Where a planner is in its life; with the cell, its clearances and the experience that is all there is to keep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Progress {
    pub tasks: u32,
    pub tasks_before_change: u32,
    pub here: Configuration,
    /// The vertex that Reach connected with it, and in which state of the cell (the paper's u with a hat).
    pub vertex: Option<(VertexId, Revision)>,
    pub tally: Tally,
    /// Shortcuts that are not free in the present state of the cell; the lower number first.
    pub refused: BTreeSet<(VertexId, VertexId)>,
    /// Pairs of vertices the path between which was tightened in the present state of the cell; the lower number first.
    pub tightened: BTreeSet<(VertexId, VertexId)>,
}

/// A planner that learns: a cell, the experience with it, and where the robot is.
#[derive(Clone, Debug)]
pub struct Adapt {
    cell: Workcell,
    experience: Experience,
    plugins: Plugins,
    settings: Settings,
    progress: Progress,
    noted: Vec<Noted>,
    /// The edges whose paths passed the check before execution, and the state of the cell in which they did.
    checked: BTreeMap<EdgeId, Revision>,
    /// What that check reads of the objects, and in which state of the cell.
    outlines: Option<(Revision, Outlines)>,
}

impl Adapt {
    /// A planner without experience, its robot at a configuration; that is its first vertex.
    pub fn new(cell: Workcell, plugins: Plugins, settings: Settings, start: Configuration) -> Self {
        let progress = Progress { here: start, ..Progress::default() };
        let mut adapt = Self::resume(cell, Experience::default(), plugins, settings, progress);
        adapt.begin_at_here();
        adapt
    }

    /// A planner that goes on where another one was.
    pub fn resume(
        cell: Workcell,
        experience: Experience,
        plugins: Plugins,
        settings: Settings,
        progress: Progress,
    ) -> Self {
        Self {
            cell,
            experience,
            plugins,
            settings,
            progress,
            noted: Vec::new(),
            checked: BTreeMap::new(),
            outlines: None,
        }
    }

    pub fn cell(&self) -> &Workcell {
        &self.cell
    }

    pub fn experience(&self) -> &Experience {
        &self.experience
    }

    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// What changed since this was last asked, in order.
    pub fn take_noted(&mut self) -> Vec<Noted> {
        let learned = self.cell.take_learned().into_iter();
        let mut noted: Vec<Noted> = std::mem::take(&mut self.noted);
        noted.extend(learned.map(|(object, clearance)| Noted::Learned { object, clearance }));
        noted
    }

    /// Takes out what the limits of the robot no longer admit: subgoals, and connections that lead out of them.
    ///
    /// # Returns
    /// How many subgoals and connections went.
    pub fn keep_within_limits(&mut self) -> (usize, usize) {
        let before = (self.experience.vertices().count(), self.experience.edges().count());
        let robot = Arc::clone(self.cell.robot());
        let admits = |at: &Configuration| robot.admits(at);
        let out = |edge: &&Edge| !edge.via.iter().all(admits);
        let edges: Vec<_> = self.experience.edges().filter(out).map(|edge| edge.ends).collect();
        for (a, b) in edges {
            self.remove_edge(a, b, Removal::BeyondLimits, None);
        }
        let out = |vertex: &&Vertex| !admits(&vertex.at);
        let vertices: Vec<_> = self.experience.vertices().filter(out).map(|vertex| vertex.id).collect();
        for id in vertices {
            self.remove_vertex(id, Removal::BeyondLimits);
        }
        let (vertices, edges) = (self.experience.vertices().count(), self.experience.edges().count());
        (before.0 - vertices, before.1 - edges)
    }

    /// Says that the robot was brought somewhere else, not by a task.
    pub fn put(&mut self, at: Configuration) {
        self.stand(at, None);
    }

    fn stand(&mut self, at: Configuration, vertex: Option<VertexId>) {
        self.progress.here = at;
        self.progress.vertex = vertex.map(|id| (id, self.cell.revision()));
        self.noted.push(Noted::Stands { at: self.progress.here.clone(), vertex });
    }

    /// Adds the first vertex, where the robot is; nothing serves as its landmark.
    fn begin_at_here(&mut self) {
        let here = self.progress.here.clone();
        let vertex = self.experience.add_vertex(here.clone(), None, self.progress.tasks).clone();
        let id = vertex.id;
        self.noted.push(Noted::VertexAdded(vertex));
        self.stand(here, Some(id));
    }

    /// Calls Reach, and counts it.
    fn reach(&mut self, from: &[f64], to: &[f64]) -> Option<Vec<Configuration>> {
        let before = self.cell.evaluations();
        let path = self.plugins.reach.reach(&mut Probe::new(&mut self.cell), from, to);
        self.progress.tally.reaches += 1;
        self.progress.tally.reach_evaluations += self.cell.evaluations() - before;
        path
    }

    fn at(&self, id: VertexId) -> Configuration {
        self.experience.vertex(id).map_or_else(Vec::new, |vertex| vertex.at.clone())
    }

    /// The task, and the state of the cell, that are written to what is made or verified now.
    fn now(&self) -> (u32, Revision) {
        (self.progress.tasks, self.cell.revision())
    }
}
