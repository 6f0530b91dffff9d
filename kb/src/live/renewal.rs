//! Kept routes that edits left stale, found anew by whoever has time while edits and questions go on.

use std::sync::Arc;

use adit_db::stale::Mark;
use adit_db::tree::TreeRow;

use super::Live;
use super::memory::ROUTES;
use crate::error::Result;
use crate::graph::SiteGraph;
use crate::graph::gauge::Gauge;
use crate::knowledge::generation;
use crate::live::trees::{self, Plan};

/// What is to be found anew, apart from the [`Live`] site that it was asked of.
pub struct Renewal {
    graph: Arc<SiteGraph>,
    gauge: Arc<Gauge>,
    plan: Plan,
    generation: u64,
    fits: bool,
}

impl Renewal {
    /// How many trees there are.
    pub fn len(&self) -> usize {
        self.plan.roots.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.plan.roots.is_empty()
    }

    /// Whether they start where the kept ones do; else all has to be built anew.
    pub fn fits(&self) -> bool {
        self.fits
    }

    /// Some of the trees, with their numbers, computed side by side.
    pub fn trees(&self, first: usize, count: usize) -> Vec<(i64, Vec<TreeRow>)> {
        let end = (first + count).min(self.len());
        let rows = trees::rows(&self.graph, &self.plan.roots[first..end], &self.gauge);
        (first as i64 + 1..).zip(rows).collect()
    }
}

impl Live {
    /// The kept routes that edits left stale; `None` where none are.
    pub fn renewal(&self) -> Result<Option<Renewal>> {
        let memory = &self.memory;
        if !memory.routes_due || !self.renews() {
            return Ok(None);
        }
        let graph = Arc::clone(memory.state.graph());
        let gauge = Arc::clone(&memory.state.gauge);
        let starts = self.site.site().starts.as_ref();
        let plan = trees::plan((&graph, &gauge), &memory.state.robots(), starts)?;
        let fits = plan.starts == memory.routes.plan().starts;
        Ok(Some(Renewal { graph, gauge, plan, generation: memory.state.generation, fits }))
    }

    /// Keeps trees of a renewal; `false` where an edit has overtaken it, so that it is void.
    ///
    /// # Arguments
    /// `last`: whether all others are kept already, so that the kept routes count again.
    pub fn keep(&mut self, renewal: &Renewal, trees: Vec<(i64, Vec<TreeRow>)>, last: bool) -> Result<bool> {
        if renewal.generation != self.memory.state.generation || !renewal.fits {
            return Ok(false);
        }
        let generation = self.memory.state.generation;
        if !self.leads_now()? {
            return Ok(false);
        }
        let kept = self.store.transaction(|tx| -> Result<bool> {
            let is_ours = |mark: &Mark| mark.table == ROUTES;
            if generation::read(tx)? != generation || !tx.stale_marks()?.iter().all(is_ours) {
                return Ok(false);
            }
            for (tree, rows) in trees {
                tx.put_tree(tree, rows)?;
            }
            if last {
                tx.mark_fresh()?;
            }
            Ok(true)
        });
        self.store.cede();
        let kept = kept?;
        self.memory.routes_due &= !(kept && last);
        Ok(kept)
    }

    /// Finds and writes the kept routes where edits left them stale; how many rows. Until then SQL says of them that
    /// they are.
    pub fn renew_routes(&mut self) -> Result<u64> {
        let Some(renewal) = self.renewal()? else { return Ok(0) };
        let trees = renewal.trees(0, renewal.len());
        let rows = trees.iter().map(|(_, rows)| rows.len() as u64).sum();
        if self.keep(&renewal, trees, true)? {
            return Ok(rows);
        }
        Ok(self.reopen()?.tree_rows as u64)
    }
}
