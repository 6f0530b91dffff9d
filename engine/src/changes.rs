//! What an update changed: for hosts that keep copies, and for the rules that react.

use std::collections::BTreeMap;

/// What changed between two inferences, told and concluded values alike.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// By class; classes in which nothing changed are left out.
    pub classes: BTreeMap<String, ClassChanges>,
    /// Rules that were evaluated, in that order, with the number of objects of their first clause.
    pub evaluated: Vec<(String, usize)>,
    /// For each concluded property, by class, the rows for which a rule was evaluated anew, ascending: its reason
    /// may be another, though the value is the same. Among them are all rows whose reason changed.
    pub reasons: BTreeMap<String, BTreeMap<String, Vec<u32>>>,
}

/// What changed in one class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
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
    /// Whether nothing changed.
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
