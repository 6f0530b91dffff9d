//! What an inference changed.

use std::collections::{BTreeMap, BTreeSet};

use super::KnowledgeBase;
use crate::changes::{Changes, ClassChanges};
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::value::Value;

/// All values of a class: keys, and for each property its values.
type Values = (Vec<String>, BTreeMap<String, Vec<Option<Value>>>);

/// What was there after the last update.
pub(super) type Snapshot = BTreeMap<String, Values>;

impl KnowledgeBase {
    /// Makes everything right that follows from what was told since, and tells what changed since the last update.
    pub fn update(&mut self, rules: &RuleBase) -> Changes {
        self.follow(rules);
        std::mem::take(&mut self.unreported)
    }

    /// Makes everything right, and passes on what changed: to the agenda, and to the host's next question.
    pub(super) fn follow(&mut self, rules: &RuleBase) {
        let changes = self.renew(rules);
        self.agenda.note(&changes);
        self.unreported.absorb(changes);
    }

    /// What changed since it was last called.
    pub(super) fn renew(&mut self, rules: &RuleBase) -> Changes {
        let conclusions = self.conclude(rules);
        let now = self.snapshot(rules);
        let before = std::mem::replace(&mut self.last, now);
        let evaluated = conclusions.evaluated.into_iter().map(|rule| (rule, 0)).collect();
        let mut changes = Changes { evaluated, ..Changes::default() };
        let classes: BTreeSet<&String> = before.keys().chain(self.last.keys()).collect();
        for class in classes {
            let none = Values::default();
            let (old, new) = (before.get(class).unwrap_or(&none), self.last.get(class).unwrap_or(&none));
            let difference = difference(old, new);
            if difference != ClassChanges::default() {
                changes.classes.insert(class.clone(), difference);
            }
        }
        changes
    }

    fn snapshot(&self, rules: &RuleBase) -> Snapshot {
        let mut snapshot = Snapshot::new();
        for (class, held) in &self.held {
            let keys = (0..held.table.len).filter_map(|row| self.key(class, row)).collect();
            let mut names: BTreeSet<String> = held.table.names.iter().cloned().collect();
            let concluded = rules.concluded();
            names.extend(
                concluded.iter().filter(|name| name.class == *class).map(|name| name.property.clone()),
            );
            let values = |name: String| {
                let column = self.column(&PropertyName::new(class, &name))?;
                let values = (0..held.table.len).map(|row| self.host_value(column.cell(row))).collect();
                Some((name, values))
            };
            snapshot.insert(class.clone(), (keys, names.into_iter().filter_map(values).collect()));
        }
        snapshot
    }
}

fn difference((old_keys, old): &Values, (new_keys, new): &Values) -> ClassChanges {
    let places: BTreeMap<&String, u32> = new_keys.iter().zip(0..).collect();
    let moved: Vec<Option<u32>> = old_keys.iter().map(|key| places.get(key).copied()).collect();
    let kept: BTreeSet<u32> = moved.iter().flatten().copied().collect();
    let still = moved.iter().zip(0..).all(|(to, from)| *to == Some(from));
    let mut changed = BTreeMap::new();
    for (name, values) in new {
        let before = old.get(name);
        let rows: BTreeSet<u32> = moved
            .iter()
            .enumerate()
            .filter_map(|(from, to)| {
                let to = (*to)?;
                (before.and_then(|before| before[from].as_ref()) != values[to as usize].as_ref())
                    .then_some(to)
            })
            .collect();
        if !rows.is_empty() {
            changed.insert(name.clone(), rows.into_iter().collect());
        }
    }
    let added = (0..new_keys.len() as u32).filter(|row| !kept.contains(row)).collect();
    ClassChanges { moved: (!still).then_some(moved), added, changed }
}
