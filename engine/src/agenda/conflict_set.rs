//! The activations of one rule: what its clauses bind now, and which of it was carried out already.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Bound;
use std::sync::Arc;

use super::matching::Halt;
use crate::machine::lane::{Frame, NO_ROW};

/// Numbers of the objects that the clauses bind, in their order; [`NO_ROW`] for clauses that bind none.
pub(crate) type Binding = Arc<[u32]>;

/// All bindings for which a rule's clauses are met, in the order of the rows.
#[derive(Debug, Default)]
pub(crate) struct ConflictSet {
    all: BTreeMap<Binding, bool>,
    open: BTreeSet<Binding>,
    /// For each variable but the first: objects, with the bindings that hold them.
    holders: Vec<BTreeSet<(u32, Binding)>>,
    /// What was carried out before each change to that, newest last.
    journal: Vec<(Binding, bool)>,
}

impl ConflictSet {
    pub(crate) fn new(variables: usize) -> Self {
        Self { holders: vec![BTreeSet::new(); variables], ..Self::default() }
    }

    pub(crate) fn variables(&self) -> usize {
        self.holders.len()
    }

    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// Adds a binding; one that is there stays as it is.
    pub(crate) fn insert(&mut self, binding: &[u32], fired: bool) {
        if self.all.contains_key(binding) {
            return;
        }
        let binding: Binding = binding.into();
        for (holders, &id) in self.holders.iter_mut().zip(binding.iter()).skip(1) {
            if id != NO_ROW {
                holders.insert((id, Arc::clone(&binding)));
            }
        }
        if fired {
            self.journal.push((Arc::clone(&binding), false));
        } else {
            self.open.insert(Arc::clone(&binding));
        }
        self.all.insert(binding, fired);
    }

    /// Adds what a search found, up to so many bindings in all; `fired` are those that were carried out.
    pub(crate) fn take_in(
        &mut self,
        found: &[Frame],
        fired: &BTreeSet<Binding>,
        most: usize,
    ) -> Result<(), Halt> {
        for frame in found {
            for index in 0..frame.len {
                let binding = frame.binding(index);
                self.insert(&binding, fired.contains(binding.as_slice()));
            }
            if self.all.len() > most {
                return Err(Halt::Full);
            }
        }
        Ok(())
    }

    pub(crate) fn of_fired(variables: usize, fired: &BTreeSet<Binding>) -> Self {
        let mut set = Self::new(variables);
        for binding in fired {
            set.insert(binding, true);
        }
        set
    }

    /// Takes a binding out; whether it was carried out, if it was there.
    pub(crate) fn remove(&mut self, binding: &Binding) -> Option<bool> {
        let fired = self.all.remove(binding)?;
        for (holders, &id) in self.holders.iter_mut().zip(binding.iter()).skip(1) {
            holders.remove(&(id, Arc::clone(binding)));
        }
        if fired {
            self.journal.push((Arc::clone(binding), true));
        } else {
            self.open.remove(binding);
        }
        Some(fired)
    }

    pub(crate) fn beginning(&self, prefix: &[u32]) -> Vec<Binding> {
        self.all
            .range::<[u32], _>((Bound::Included(prefix), Bound::Unbounded))
            .map(|(binding, _)| binding)
            .take_while(|binding| binding.starts_with(prefix))
            .cloned()
            .collect()
    }

    /// The bindings in which a variable stands for an object.
    pub(crate) fn holding(&self, variable: usize, id: u32) -> Vec<Binding> {
        if variable == 0 {
            return self.beginning(&[id]);
        }
        let none: Binding = Arc::new([]);
        self.holders[variable]
            .range((id, none)..)
            .take_while(|(holds, _)| *holds == id)
            .map(|(_, binding)| Arc::clone(binding))
            .collect()
    }

    /// The bindings that wait to be carried out, in order.
    pub(crate) fn open(&self) -> impl Iterator<Item = &Binding> {
        self.open.iter()
    }

    pub(crate) fn fired(&self) -> impl Iterator<Item = &Binding> {
        self.all.iter().filter(|(_, fired)| **fired).map(|(binding, _)| binding)
    }

    #[cfg(test)]
    pub(crate) fn all(&self) -> &BTreeMap<Binding, bool> {
        &self.all
    }

    pub(crate) fn carry_out(&mut self, binding: &Binding) {
        if let Some(fired) = self.all.get_mut(binding)
            && !*fired
        {
            *fired = true;
            self.open.remove(binding);
            self.journal.push((Arc::clone(binding), false));
        }
    }

    pub(crate) fn checkpoint(&mut self) {
        self.journal.clear();
    }

    pub(crate) fn fired_before(&self) -> BTreeSet<Binding> {
        let mut fired: BTreeSet<Binding> = self.fired().cloned().collect();
        for (binding, was) in self.journal.iter().rev() {
            if *was {
                fired.insert(Arc::clone(binding));
            } else {
                fired.remove(binding);
            }
        }
        fired
    }
}
