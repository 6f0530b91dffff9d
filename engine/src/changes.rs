//! What an update changed: for hosts that keep copies, and for the rules that react.

use std::collections::BTreeMap;

/// What changed between two inferences, told and concluded values alike.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Changes {
    /// By class; classes in which nothing changed are left out.
    pub classes: BTreeMap<String, ClassChanges>,
    /// Rules that were evaluated, in that order, with the number of objects of their first clause.
    pub evaluated: Vec<(String, usize)>,
    /// For each concluded property, by class, the rows for which a rule was evaluated anew, ascending: its reason
    /// may be another, though the value is the same. Among them are all rows whose reason changed.
    pub reasons: BTreeMap<String, BTreeMap<String, Vec<u32>>>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct ClassChanges {
    /// Where objects went: for each row of before its row now, `None` if it was removed. `None` as a whole: no
    /// row moved (new ones stand at the end).
    pub moved: Option<Vec<Option<u32>>>,
    /// Rows of objects that were added, ascending.
    pub added: Vec<u32>,
    /// For each property the rows, as they are now, of the other objects whose value changed, ascending.
    pub changed: BTreeMap<String, Vec<u32>>,
}

impl Changes {
    pub fn is_empty(&self) -> bool {
        self.classes.is_empty()
    }

    /// Rows of the objects whose reason for a property may be another than before.
    pub fn reasons(&self, class: &str, property: &str) -> &[u32] {
        self.reasons.get(class).and_then(|class| class.get(property)).map_or(&[], Vec::as_slice)
    }

    /// Rows of the objects whose value of a property changed; those of new objects are not among them.
    pub fn rows(&self, class: &str, property: &str) -> &[u32] {
        self.classes.get(class).and_then(|class| class.changed.get(property)).map_or(&[], Vec::as_slice)
    }
}

impl Changes {
    /// What changed over both steps, this one and the next.
    pub fn absorb(&mut self, next: Self) {
        for (class, reasons) in &mut self.reasons {
            let Some(moved) = next.classes.get(class).and_then(|changes| changes.moved.as_ref()) else {
                continue;
            };
            for rows in reasons.values_mut() {
                *rows = rows.iter().filter_map(|&row| moved.get(row as usize).copied().flatten()).collect();
                rows.sort_unstable();
            }
        }
        for (class, reasons) in next.reasons {
            let own = self.reasons.entry(class).or_default();
            for (property, rows) in reasons {
                merge(own.entry(property).or_default(), rows);
            }
        }
        for (class, changes) in next.classes {
            self.classes.entry(class).or_default().absorb(changes);
        }
        self.classes.retain(|_, changes| *changes != ClassChanges::default());
        self.evaluated.extend(next.evaluated);
    }
}

impl ClassChanges {
    fn absorb(&mut self, next: Self) {
        if *self == Self::default() {
            *self = next;
            return;
        }
        if next.moved.is_none() && next.added.first() == Some(&0) {
            // The class was empty, or is another.
            self.moved.iter_mut().flatten().for_each(|row| *row = None);
            (self.added, self.changed) = (next.added, next.changed);
            return;
        }
        if let Some(moved) = next.moved {
            let to = |row: u32| moved.get(row as usize).copied().flatten();
            let follow = |rows: &mut Vec<u32>| {
                *rows = rows.iter().filter_map(|&row| to(row)).collect();
                if !rows.is_sorted() {
                    rows.sort_unstable();
                }
            };
            match &mut self.moved {
                Some(earlier) => earlier.iter_mut().for_each(|row| *row = row.and_then(to)),
                None => self.moved = Some(moved[..moved.len().saturating_sub(self.added.len())].to_vec()),
            }
            follow(&mut self.added);
            self.changed.values_mut().for_each(follow);
            self.changed.retain(|_, rows| !rows.is_empty());
        }
        merge(&mut self.added, next.added);
        for (property, mut rows) in next.changed {
            rows.retain(|row| self.added.binary_search(row).is_err());
            if !rows.is_empty() {
                merge(self.changed.entry(property).or_default(), rows);
            }
        }
    }
}

fn merge(into: &mut Vec<u32>, from: Vec<u32>) {
    let ascends = into.last().zip(from.first()).is_none_or(|(last, first)| last < first);
    into.extend(from);
    if !ascends {
        into.sort_unstable();
        into.dedup();
    }
}
