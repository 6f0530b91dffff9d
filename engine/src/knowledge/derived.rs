//! One property that rules conclude or revise.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::dirty::Dirty;
use crate::column::Column;
use crate::value::Cell;

/// A rule among those that give values to a property: its number, and the priority of what it says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Writer {
    pub(crate) rule: usize,
    pub(crate) priority: i64,
}

/// A property with what rules make of it, stage by stage: concluded first, then revised level by level.
#[derive(Clone, Debug)]
#[allow(clippy::struct_excessive_bools)] // each is a fact by itself, none excludes another
pub(crate) struct Derived {
    /// The rules that conclude it: the greatest priority first, then in the order of the rule base.
    pub(crate) writers: Vec<Writer>,
    /// Levels of revision, ascending, each with its rules in the order of their names.
    pub(crate) levels: Vec<(i64, Vec<usize>)>,
    /// Whether rules prove it: then it is true if one of them says so.
    pub(crate) hypothesis: bool,
    /// Whether what rules conclude stands before what was told, as its sources declare.
    pub(crate) rules_first: bool,
    /// The told or concluded values, then those after each level.
    pub(crate) stages: Vec<Arc<Column>>,
    /// What has to be brought together anew, for each stage.
    pub(crate) pending: Vec<Dirty>,
    /// Whether the stages hold nothing yet, so that whatever comes counts as changed.
    pub(crate) fresh: bool,
    pub(crate) disputes: BTreeSet<u32>,
    /// For each stage whether every rule up to it was evaluated.
    pub(crate) complete: Vec<bool>,
}

impl Derived {
    pub(crate) fn rules(&self) -> Vec<usize> {
        self.writers.iter().map(|writer| writer.rule).collect()
    }

    /// The stage that a rule sees which revises at this level; without a level, the last.
    pub(crate) fn stage(&self, below: Option<i64>) -> usize {
        below
            .map_or(self.levels.len(), |below| self.levels.iter().filter(|(level, _)| *level < below).count())
    }
}

/// What comes of what rules say of one object.
pub(crate) enum Heard {
    Nothing,
    Value(Cell),
    Dispute,
}

/// The greatest priority with a value is heard; where its rules disagree, nobody is. The greatest comes first.
pub(crate) fn heard(said: impl Iterator<Item = (i64, Option<Cell>)>) -> Heard {
    let mut chosen: Option<(i64, Cell)> = None;
    for (priority, cell) in said {
        match (chosen, cell) {
            (Some((heard, _)), _) if priority < heard => break,
            (Some((_, value)), Some(other)) if value != other => return Heard::Dispute,
            (None, Some(cell)) => chosen = Some((priority, cell)),
            _ => {}
        }
    }
    chosen.map_or(Heard::Nothing, |(_, cell)| Heard::Value(cell))
}
