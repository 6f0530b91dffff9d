//! Where an edit changes what planners work from: everything is derived anew, in memory.

use std::sync::Arc;

use adit_planners::facts::Facts;
use adit_planners::planner::Planner;

use super::Fork;
use crate::derive::{Memory, derive};
use crate::error::Result;
use crate::gauge::Gauge;
use crate::graph::SiteGraph;
use crate::grounds::Numbering;
use crate::live::Base;
use crate::progress::Silent;
use crate::store::Tables;
use crate::told::Told;

/// Remembers nothing: a fork's planners work from what no build has seen.
struct Nothing;

impl Memory for Nothing {
    fn recall(&mut self, _: &dyn Planner, _: u64) -> Result<Option<Facts>> {
        Ok(None)
    }
}

impl Fork {
    /// Cuts rooms and doors anew from what is told.
    pub(super) fn cut_anew(&mut self, told: Told) -> Result<()> {
        let Self { site, inputs, .. } = self;
        let derived = derive(&inputs.world, &told, site.planners(), &inputs.rules, &mut Nothing, &Silent)?;
        let made = Tables::new(&derived, &inputs.rules, &mut Numbering::default())?;
        let places = self.graph.places.clone();
        self.gauge = Arc::new(Gauge::of_sizes(&inputs.world, &derived.knowledge));
        self.graph = Arc::new(SiteGraph::new(made.rooms, made.doors, places));
        self.base = Base::of(derived, told);
        Ok(())
    }
}
