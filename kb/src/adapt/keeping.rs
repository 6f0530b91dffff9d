//! Writing to the store what is learned, several tasks at a time.

use std::time::{Duration, Instant};

use adit_db::Store;
use adit_db::experience::Task;
use adit_engine::Considered;
use adit_planners::adapt::Adapt;

use super::cell::Cell;
use super::keep;
use crate::error::Result;

/// Tasks are written together: as many as these at most, or those of so long a time.
const MOST_TASKS: usize = 100;
const LATEST: Duration = Duration::from_millis(100);

/// A store, and the tasks that are not yet written to it.
pub(super) struct Keeping {
    store: Store,
    seed: u64,
    copied_from: Option<String>,
    tasks: Vec<Task>,
    /// When the first of them was done.
    since: Option<Instant>,
}

impl Keeping {
    pub const fn new(store: Store, seed: u64, copied_from: Option<String>) -> Self {
        Self { store, seed, copied_from, tasks: Vec::new(), since: None }
    }

    pub fn into_store(self) -> Store {
        self.store
    }

    /// Takes a task down, and writes it with those before it when it is time to.
    pub fn task(&mut self, cell: &Cell, adapt: &mut Adapt, task: Task) -> Result<()> {
        self.tasks.push(task);
        let is_late = self.since.get_or_insert_with(Instant::now).elapsed() >= LATEST;
        if is_late || self.tasks.len() >= MOST_TASKS { self.settle(cell, adapt) } else { Ok(()) }
    }

    /// Writes the tasks that are not yet written.
    pub fn settle(&mut self, cell: &Cell, adapt: &mut Adapt) -> Result<()> {
        if self.tasks.is_empty() { Ok(()) } else { self.write(cell, adapt, &[], false) }
    }

    /// Writes all that happened since this was last done, in one transaction; `is_new` where nothing is kept of the cell.
    pub fn write(
        &mut self,
        cell: &Cell,
        adapt: &mut Adapt,
        considered: &[Considered],
        is_new: bool,
    ) -> Result<()> {
        let mut step = keep::step(cell, self.seed, self.copied_from.as_deref(), adapt, considered);
        if is_new {
            step.objects = Some(keep::objects(adapt));
        }
        self.since = None;
        step.tasks = std::mem::take(&mut self.tasks);
        let is_less = !step.subgoals_removed.is_empty() || !step.edges_removed.is_empty();
        if is_new || is_less || !step.tasks.is_empty() || !step.object_changes.is_empty() {
            self.store.transaction(|tx| tx.keep_step(&step)).map_err(|error| cell.not_kept(error))?;
        }
        Ok(())
    }
}
