//! Databases to which the runs of an experiment write what they learn, as a robot does: what that takes is a part of their time.

use std::sync::{Arc, Mutex, PoisonError};

use adit_db::Store;
use adit_planners::adapt::{Adapt, Configuration, Keeper, Method, Report};
use tempfile::TempDir;

use super::cell::Cell;
use super::keeping::Keeping;
use super::{keep, session};
use crate::error::{Error, Result};

/// As many databases as runs go on at a time, in a folder that goes with them.
pub(super) struct Databases {
    folder: TempDir,
    idle: Mutex<Vec<Store>>,
}

impl Databases {
    pub fn new() -> Result<Arc<Self>> {
        let folder =
            tempfile::tempdir().map_err(|error| Error::io("write to", &std::env::temp_dir(), &error))?;
        Ok(Arc::new(Self { folder, idle: Mutex::default() }))
    }

    fn take(&self) -> Result<Store> {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        if let Some(store) = idle {
            return Ok(store);
        }
        let file = tempfile::Builder::new().suffix(".db").tempfile_in(self.folder.path());
        let file = file.and_then(|file| file.into_temp_path().keep().map_err(|error| error.error));
        session::open(&file.map_err(|error| Error::io("write to", self.folder.path(), &error))?)
    }
}

/// Keeps a run under a name of its own, and forgets it at its end.
pub(super) struct Kept {
    databases: Arc<Databases>,
    keeping: Option<Keeping>,
    cell: Cell,
    is_new: bool,
    /// The first thing that went wrong, of all runs.
    trouble: Arc<Mutex<Option<String>>>,
}

impl Kept {
    pub fn new(
        databases: &Arc<Databases>,
        cell: &Cell,
        (method, seed): (Method, u64),
        trouble: &Arc<Mutex<Option<String>>>,
    ) -> Self {
        let mut cell = cell.clone();
        cell.name = format!("{} {method:?} {seed}", cell.name);
        let (databases, trouble) = (Arc::clone(databases), Arc::clone(trouble));
        let mut kept = Self { databases, keeping: None, cell, is_new: true, trouble };
        let store = kept.databases.take();
        kept.keeping = kept.known(store).map(|store| Keeping::new(store, seed, None));
        kept
    }

    /// What there is, where nothing went wrong.
    fn known<T>(&self, result: Result<T>) -> Option<T> {
        let error = match result {
            Ok(value) => return Some(value),
            Err(error) => error,
        };
        let mut first = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert_with(|| error.to_string());
        None
    }
}

impl Keeper for Kept {
    fn change(&mut self, adapt: &mut Adapt) {
        let is_new = std::mem::take(&mut self.is_new);
        let done = self.keeping.as_mut().map(|keeping| keeping.write(&self.cell, adapt, &[], is_new));
        done.and_then(|done| self.known(done));
    }

    fn task(&mut self, adapt: &mut Adapt, goal: &Configuration, report: &Report) {
        const GOAL: &str = "of the run";
        let task = keep::task(GOAL, Some(goal), report, session::reason(GOAL, report));
        let done = self.keeping.as_mut().map(|keeping| keeping.task(&self.cell, adapt, task));
        done.and_then(|done| self.known(done));
    }

    fn end(&mut self, adapt: &mut Adapt) {
        let done = self.keeping.as_mut().map(|keeping| keeping.settle(&self.cell, adapt));
        done.and_then(|done| self.known(done));
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        let Some(mut store) = self.keeping.take().map(Keeping::into_store) else { return };
        let name = self.cell.name.as_str();
        // One that cannot even forget is not used again.
        if store.transaction(|tx| tx.forget_cell(name)).is_ok() {
            self.databases.idle.lock().unwrap_or_else(PoisonError::into_inner).push(store);
        }
    }
}
