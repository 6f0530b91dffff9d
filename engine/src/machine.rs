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
use crate::script::interpreter::runner;
use crate::symbols::Lexicon;

/// Bindings that are looked at together: small enough that a batch stays in the cache.
pub(crate) const BATCH: usize = 1024;

/// Of so many small steps one looks at the clock, which takes as long as a step.
const BETWEEN_LOOKS: u32 = 16;

/// A rule was stopped; the reason is among the machine's troubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stopped;

pub(crate) struct Machine<'a> {
    pub(crate) rule: &'a Rule,
    pub(crate) columns: Vec<&'a Column>,
    pub(crate) symbols: &'a Lexicon,
    pub(crate) runner: &'a Engine,
    pub(crate) deadline: Instant,
    /// The first failure of an interpreted part, and how many there were.
    pub(crate) trouble: RefCell<Option<Diagnostic>>,
    pub(crate) troubles: Cell<usize>,
    /// Whether a limit was reached: nothing is interpreted any more.
    pub(crate) stopped: Cell<bool>,
    /// Whether matching goes on without the interpreter, what it would have said being unknown.
    pub(crate) goes_on: bool,
    ticks: Cell<u32>,
}

impl<'a> Machine<'a> {
    pub(crate) fn new(
        rule: &'a Rule,
        columns: Vec<&'a Column>,
        symbols: &'a Lexicon,
        deadline: Instant,
        goes_on: bool,
    ) -> Self {
        let (trouble, troubles, stopped, ticks) = Default::default();
        let runner = runner();
        Self { rule, columns, symbols, runner, deadline, trouble, troubles, stopped, goes_on, ticks }
    }
}

impl Machine<'_> {
    pub(crate) fn tick(&self) -> Result<(), Stopped> {
        if self.stopped.get() && !self.goes_on {
            return Err(Stopped);
        }
        let ticks = self.ticks.get();
        self.ticks.set(ticks.wrapping_add(1));
        if ticks.is_multiple_of(BETWEEN_LOOKS) && Instant::now() > self.deadline {
            self.stopped.set(true);
            return Err(Stopped);
        }
        Ok(())
    }
}
