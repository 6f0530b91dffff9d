//! Matches follow what changes: dropped, decided anew, searched from each object that is new or other.

use std::collections::{BTreeMap, BTreeSet};

use super::conflict_set::ConflictSet;
use super::evaluate::Bound;
use super::program::Program;
use super::search::{Halt, Search};
use super::world::Difference;
use super::{Agenda, Outside, Reacting, Stopped, scripts, searching, within};
use crate::machine::lane::NO_ROW;
use crate::script::syntax::Quantifier;

impl Agenda {
    pub(super) fn follow_each(
        &mut self,
        outside: &Outside,
        differences: &[Difference],
    ) -> Result<(), Stopped> {
        if differences.iter().all(Difference::is_empty) {
            return Ok(());
        }
        for at in 0..self.rules.len() {
            let others = self.others(at);
            let Reacting { rule, program, set, .. } = &mut self.rules[at];
            let Some(program) = program else { continue };
            drop_changed(program, set, differences);
            let scripts = scripts(outside, *rule);
            let mut search = searching(outside, &self.world, program, &scripts);
            let done = decide_anew(&mut search, set, differences, outside, others)
                .and_then(|()| seed(&mut search, set, differences, outside, others));
            let rule = *rule;
            if let Some(problem) = scripts.trouble.take() {
                outside.trouble(rule, problem);
            }
            done.map_err(|halt| Stopped { rule, halt })?;
        }
        Ok(())
    }
}

/// Drops the matches that hold an object that is gone, or has other values of what the rule reads.
pub(super) fn drop_changed(program: &Program, set: &mut ConflictSet, differences: &[Difference]) {
    for (variable, clause) in program.clauses.iter().enumerate() {
        let difference = &differences[clause.class];
        let removed = difference.removed.iter().map(|(id, _)| *id);
        let changed = difference.changed.iter().filter(|(_, columns, _)| clause.reads_any(columns));
        for id in removed.chain(changed.map(|(id, ..)| *id)) {
            for binding in set.holding(variable, id) {
                set.remove(&binding);
            }
        }
    }
}

/// Decides clauses other than `each` anew for the matches that a new, changed or removed object matters to, as it
/// is and as it was.
fn decide_anew(
    search: &mut Search,
    set: &mut ConflictSet,
    differences: &[Difference],
    outside: &Outside,
    others: usize,
) -> Result<(), Halt> {
    let program = search.program;
    for (number, clause) in program.clauses.iter().enumerate() {
        if clause.quantifier == Quantifier::Each {
            continue;
        }
        let difference = &differences[clause.class];
        let changed = difference.changed.iter().filter(|(_, columns, _)| clause.reads_any(columns));
        let mut matter: Vec<u32> = difference.added.clone();
        matter.extend(changed.flat_map(|(id, _, before)| std::iter::once(*id).chain(*before)));
        matter.extend(difference.removed.iter().filter_map(|(_, before)| *before));
        let mut prefixes: BTreeMap<Vec<u32>, Bound> = BTreeMap::new();
        for id in matter {
            search.with(number, id, &mut |bound| {
                prefixes.entry(bound.ids[..number].to_vec()).or_insert_with(|| bound.clone());
                Ok(())
            })?;
        }
        for (prefix, mut bound) in prefixes {
            bound.ids[number] = NO_ROW;
            let mut fired = BTreeSet::new();
            for binding in set.beginning(&prefix) {
                if set.remove(&binding) == Some(true) {
                    fired.insert(binding);
                }
            }
            search.after(number, bound, &mut |bound| {
                set.insert(&bound.ids, fired.contains(bound.ids.as_slice()));
                within(outside, set, others)
            })?;
        }
    }
    Ok(())
}

/// Searches from each object that is new or has other values.
fn seed(
    search: &mut Search,
    set: &mut ConflictSet,
    differences: &[Difference],
    outside: &Outside,
    others: usize,
) -> Result<(), Halt> {
    let program = search.program;
    for (number, clause) in program.clauses.iter().enumerate() {
        if clause.quantifier != Quantifier::Each {
            continue;
        }
        let difference = &differences[clause.class];
        let changed = difference.changed.iter().filter(|(_, columns, _)| clause.reads_any(columns));
        for id in difference.added.iter().copied().chain(changed.map(|(id, ..)| *id)) {
            search.with(number, id, &mut |bound| {
                set.insert(&bound.ids, false);
                within(outside, set, others)
            })?;
        }
    }
    Ok(())
}
