//! What rules gave to one property, and what it was made from.

use std::collections::BTreeMap;

use crate::column::Column;
use crate::diagnostic::Diagnostic;
use crate::machine::output::Output;
use crate::value::Cell;

/// What something was made from: names of rules, classes and properties, with the stamps they had.
pub(super) type Made = Vec<(String, u64)>;

/// Stands where no rule gave the value.
pub(super) const NO_RULE: u32 = u32::MAX;

/// A value that a rule gives: number of the rule among the writers, its firing, the value.
pub(super) type Claim = (u32, u32, Cell);

/// One property that rules conclude or revise.
#[derive(Debug)]
pub(super) struct Derived {
    /// The rules that conclude it, in the order of the rule base.
    pub(super) writers: Vec<String>,
    pub(super) made_from: Made,
    pub(super) stamp: u64,
    /// Told values, and concluded ones where nothing is told.
    pub(super) merged: Column,
    /// For each row the writer and its firing.
    pub(super) origin: Vec<(u32, u32)>,
    /// Rows on which rules disagree, with all that was claimed.
    pub(super) disputes: BTreeMap<u32, Vec<Claim>>,
    pub(super) problems: Vec<Diagnostic>,
    /// Levels of revision, ascending.
    pub(super) layers: Vec<Layer>,
}

/// The property after one level of revision.
#[derive(Debug)]
pub(super) struct Layer {
    pub(super) level: i64,
    pub(super) made_from: Made,
    pub(super) stamp: u64,
    pub(super) column: Column,
}

impl Derived {
    pub(super) fn view(&self, below: Option<i64>) -> (&Column, u64) {
        let layer = self.layers.iter().rev().find(|layer| below.is_none_or(|level| layer.level < level));
        layer.map_or((&self.merged, self.stamp), |layer| (&layer.column, layer.stamp))
    }
}

/// A rule that was evaluated.
#[derive(Debug)]
pub(super) struct Done {
    pub(super) version: String,
    pub(super) made_from: Made,
    pub(super) stamp: u64,
    pub(super) output: Output,
    pub(super) problems: Vec<Diagnostic>,
}
