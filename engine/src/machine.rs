//! Runs plans over batches of bindings: one pass over a batch for each node, no dispatch for each row.

pub(crate) mod action;
pub(crate) mod candidates;
pub(crate) mod evaluate;
mod hypothesis;
pub(crate) mod index;
pub(crate) mod interpret;
pub(crate) mod lane;
pub(crate) mod matching;
pub(crate) mod output;
pub(crate) mod scalar;
pub(crate) mod search;
mod tally;

use std::cell::{Cell, RefCell};
use std::time::Instant;

use rhai::Engine;

use crate::column::Column;
use crate::diagnostic::Diagnostic;
use crate::rule::Rule;
use crate::symbols::Symbols;

/// Bindings that are looked at together: small enough that a batch stays in the cache.
pub(crate) const BATCH: usize = 1024;

/// A rule was stopped; the reason is among the machine's troubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopped;

/// What the evaluation of one rule shares.
pub(crate) struct Machine<'a> {
    pub(crate) rule: &'a Rule,
    pub(crate) columns: Vec<&'a Column>,
    pub(crate) symbols: &'a RefCell<Symbols>,
    pub(crate) runner: &'a Engine,
    pub(crate) deadline: Instant,
    /// The first failure of an interpreted part, and how many there were.
    pub(crate) trouble: RefCell<Option<Diagnostic>>,
    pub(crate) troubles: Cell<usize>,
    pub(crate) stopped: Cell<bool>,
}

impl Machine<'_> {
    /// Looks at the clock.
    pub(crate) fn tick(&self) -> Result<(), Stopped> {
        if self.stopped.get() || Instant::now() > self.deadline {
            self.stopped.set(true);
            return Err(Stopped);
        }
        Ok(())
    }
}
