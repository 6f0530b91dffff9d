//! A fork of what a site knows: edits are tried on it in memory, and nothing of them is written.

mod anew;
pub mod pairs;
mod rehearse;
mod weigh;

use std::sync::Arc;
use std::time::Duration;

use adit_engine::Severity;

use crate::answer::{self, Answer};
use crate::error::{Error, Result};
use crate::gauge::Gauge;
use crate::graph::{Rules, SiteGraph};
use crate::inputs::Inputs;
use crate::knowledge::KnowledgeBase;
use crate::live::{Base, needs_changed};
use crate::told::Told;
use crate::weights;
use pairs::Known;
pub use rehearse::Cell;
pub(crate) use rehearse::differences;
pub use weigh::Reweighed;

/// What a site knew at one moment, to try other facts on. It shares nothing that an edit of the site would change, so
/// it may be worked on while the site goes on.
pub struct Fork {
    pub(crate) site: Arc<KnowledgeBase>,
    pub(crate) inputs: Arc<Inputs>,
    pub(crate) base: Base,
    pub(crate) graph: Arc<SiteGraph>,
    pub(crate) gauge: Arc<Gauge>,
    pub(crate) rules: Arc<Rules>,
    /// The state of the knowledge base that it was forked from.
    pub generation: u64,
    /// Routes between places, of the site as it is.
    pub(crate) known: Arc<Known>,
    pub(crate) patience: Duration,
}

/// How long a preview looks for routes between places, unless told otherwise.
pub(crate) const PATIENCE: Duration = Duration::from_millis(100);

/// What became of a fork that was told other facts.
pub(crate) enum Followed {
    /// Rooms and doors stayed, and some weigh differently.
    Reweighed(Reweighed),
    /// Rooms and doors were cut anew.
    CutAnew,
}

impl Fork {
    /// Looks for routes between places for so long in a preview; what is not found by then is not compared.
    #[must_use]
    pub fn with_patience(mut self, patience: Duration) -> Self {
        self.patience = patience;
        self
    }

    /// Tells it all that is told, instead of what was, and concludes what follows. The graph follows, too.
    ///
    /// After an error the fork is of no more use.
    pub(crate) fn tell(&mut self, told: Told) -> Result<Followed> {
        let Some(reweighed) = self.conclude(told.clone())? else {
            let before = Arc::clone(&self.graph);
            self.cut_anew(told)?;
            return Ok(match Reweighed::between(&before, &self.graph) {
                Some(reweighed) => Followed::Reweighed(reweighed),
                None => Followed::CutAnew,
            });
        };
        if !reweighed.is_empty() {
            let mut graph = SiteGraph::clone(&self.graph);
            reweighed.lay_over(&mut graph);
            self.graph = Arc::new(graph);
        }
        Ok(Followed::Reweighed(reweighed))
    }

    /// Concludes what follows where all this is told; the graph stays as it is.
    ///
    /// # Returns
    /// The rooms and doors that weigh differently than the graph says; `None` where they would have to be cut anew.
    pub(crate) fn conclude(&mut self, told: Told) -> Result<Option<Reweighed>> {
        let Self { site, inputs, base, .. } = self;
        let Some(attached) = base.tell(&told, site)? else { return Ok(None) };
        let changes = base.knowledge.update(&inputs.rules);
        let failed = base.knowledge.problems(&inputs.rules);
        let failed: Vec<_> = failed.into_iter().filter(|found| found.severity == Severity::Error).collect();
        if !failed.is_empty() {
            return Err(Error::all(failed));
        }
        base.accept(told, attached);
        if site.planners().iter().any(|planner| needs_changed(&planner.signature().needs, &changes)) {
            return Ok(None);
        }
        weights::check_changes(&base.knowledge, &changes, &self.graph)?;
        Ok(Some(Reweighed::of(&base.knowledge, &inputs.rules, &changes, &self.graph)))
    }

    /// The route of least hardness, as [`Live::route`](crate::Live::route) gives it.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        let robot = answer::pick(&self.base.robots(), robot)?;
        let blank = Answer::blank(&robot, start, goals, self.generation);
        self.basis().search(goals, blank)
    }

    pub(crate) fn basis(&self) -> answer::Basis<'_> {
        answer::Basis {
            knowledge: &self.site,
            graph: &self.graph,
            rules: &self.rules,
            world: &self.inputs.world,
            gauge: &self.gauge,
        }
    }
}
