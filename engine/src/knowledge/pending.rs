//! What was told of a class since the last inference.

use std::collections::BTreeMap;

use super::dirty::Dirty;
use crate::class::Table;

/// A class as it was told, and what was told since the last inference.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub(super) table: Table,
    pub(super) pending: Pending,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Pending {
    /// The class is new, or other properties than before: nothing that rests on it holds.
    pub(super) anew: bool,
    /// For each row of before its row now; `None`: no row moved.
    pub(super) moved: Option<Vec<Option<u32>>>,
    pub(super) added: Vec<u32>,
    /// Rows whose told value changed, by property.
    pub(super) changed: BTreeMap<String, Dirty>,
}

impl Pending {
    pub(super) const fn anew() -> Self {
        Self { anew: true, moved: None, added: vec![], changed: BTreeMap::new() }
    }

    pub(super) fn change(&mut self, property: &str, row: u32) {
        match self.changed.get_mut(property) {
            Some(rows) => rows.add(row),
            None => {
                self.changed.insert(property.to_owned(), Dirty::Rows(vec![row]));
            }
        }
    }

    /// Objects moved; `before` rows there were.
    pub(super) fn move_rows(&mut self, moved: &[Option<u32>]) {
        let to = |row: u32| moved.get(row as usize).copied().flatten();
        let added = std::mem::take(&mut self.added);
        let known = moved.len() - added.len();
        let mut first = self.moved.take().unwrap_or_else(|| (0..known as u32).map(Some).collect());
        for row in &mut first {
            *row = row.and_then(to);
        }
        self.moved = Some(first);
        self.added = added.into_iter().filter_map(to).collect();
        for rows in self.changed.values_mut() {
            *rows = std::mem::take(rows).moved(moved);
        }
    }

    pub(super) const fn reshaped(&self) -> bool {
        self.moved.is_some() || !self.added.is_empty()
    }

    /// Whether objects that stayed also kept their order.
    pub(super) fn keeps_order(&self) -> bool {
        self.moved.as_ref().is_none_or(|moved| moved.iter().flatten().is_sorted())
    }

    pub(super) fn is_something(&self) -> bool {
        self.anew || self.reshaped() || !self.changed.is_empty()
    }

    pub(super) fn join(&mut self, later: Self) {
        if self.anew || later.anew {
            *self = Self::anew();
            return;
        }
        if let Some(moved) = &later.moved {
            self.move_rows(moved);
        }
        self.added.extend(later.added);
        for (property, rows) in later.changed {
            self.changed.entry(property).or_default().join(&rows);
        }
    }
}
