//! Matches follow what changes: dropped, decided anew, searched from each object that is new or other.

use std::collections::{BTreeMap, BTreeSet};

use super::conflict_set::{Binding, ConflictSet};
use super::matching::{Halt, Matching};
use super::program::{Clause, Program};
use super::world::Difference;
use super::{Agenda, Outside, Reacting, Stopped};
use crate::machine::lane::{Frame, Lane, Rows};
use crate::script::syntax::Quantifier;

/// For each clause but `each`: bindings of the clauses before, with the numbers that those give, for which the clause
/// has to be decided anew.
type Prefixes = BTreeMap<usize, BTreeMap<Vec<u32>, Vec<f64>>>;

impl Agenda {
    pub(super) fn follow_each(
        &mut self,
        outside: &Outside,
        differences: &[Difference],
    ) -> Result<(), Stopped> {
        // What an object was before matters where it stood in the way, or was what decided.
        let mut anew: Vec<Prefixes> = vec![];
        for Reacting { rule, program, .. } in &self.rules {
            let mut prefixes = Prefixes::new();
            if let Some(program) = program.as_ref().filter(|program| program.is_touched(differences)) {
                let matching = Matching::new(outside, &self.world, *rule, program);
                let done = matter(&matching, differences, |of| &of.removed, &mut prefixes);
                matching.report(outside, *rule);
                done.map_err(|halt| Stopped { rule: *rule, halt })?;
                for (&number, prefixes) in &mut prefixes {
                    prefixes.retain(|prefix, _| program.holds_still(&prefix[..number], differences));
                }
            }
            anew.push(prefixes);
        }
        self.world.fetch(differences, outside.facts);
        for (at, mut prefixes) in anew.into_iter().enumerate() {
            let most = outside.matches.saturating_sub(self.others(at));
            let Reacting { rule, program, set, .. } = &mut self.rules[at];
            let Some(program) = program.as_ref().filter(|program| program.is_touched(differences)) else {
                continue;
            };
            drop_changed(program, set, differences);
            let matching = Matching::new(outside, &self.world, *rule, program);
            let done = matter(&matching, differences, |of| &of.added, &mut prefixes)
                .and_then(|()| decide_anew(&matching, set, &prefixes, most))
                .and_then(|()| seed(&matching, set, differences, most));
            matching.report(outside, *rule);
            done.map_err(|halt| Stopped { rule: *rule, halt })?;
        }
        Ok(())
    }
}

impl Program {
    fn is_touched(&self, differences: &[Difference]) -> bool {
        self.clauses.iter().any(|clause| {
            let Difference { added, removed, .. } = &differences[clause.class];
            !added.is_empty() || !removed.is_empty() || changed(clause, differences).next().is_some()
        })
    }

    /// Whether the objects of the first clauses are there still, with the values that they had.
    fn holds_still(&self, prefix: &[u32], differences: &[Difference]) -> bool {
        self.clauses.iter().zip(prefix).all(|(clause, id)| {
            !differences[clause.class].removed.contains(id)
                && changed(clause, differences).all(|other| other != *id)
        })
    }
}

/// The objects of a clause with other values of what the rule reads.
fn changed<'d>(clause: &'d Clause, differences: &'d [Difference]) -> impl Iterator<Item = u32> + 'd {
    let changed = differences[clause.class].changed.iter();
    changed.filter(|(_, columns)| clause.reads_any(columns)).map(|(id, _)| *id)
}

/// Drops the matches that hold an object that is gone, or has other values of what the rule reads.
pub(super) fn drop_changed(program: &Program, set: &mut ConflictSet, differences: &[Difference]) {
    for (variable, clause) in program.clauses.iter().enumerate() {
        let removed = differences[clause.class].removed.iter().copied();
        for id in removed.chain(changed(clause, differences)) {
            for binding in set.holding(variable, id) {
                set.remove(&binding);
            }
        }
    }
}

/// Adds the bindings to which a changed object matters, or one of the others.
fn matter(
    matching: &Matching,
    differences: &[Difference],
    others: impl Fn(&Difference) -> &Vec<u32>,
    prefixes: &mut Prefixes,
) -> Result<(), Halt> {
    for (number, clause) in matching.program.clauses.iter().enumerate() {
        if clause.quantifier == Quantifier::Each {
            continue;
        }
        let others = others(&differences[clause.class]).iter().copied();
        let ids: Vec<u32> = others.chain(changed(clause, differences)).collect();
        for frame in matching.with(number, &ids)? {
            for index in 0..frame.len {
                let prefix = frame.binding(index)[..number].to_vec();
                let numbers = frame.rows.iter().map(|rows| rows.number(index)).collect();
                prefixes.entry(number).or_default().insert(prefix, numbers);
            }
        }
    }
    Ok(())
}

fn decide_anew(
    matching: &Matching,
    set: &mut ConflictSet,
    prefixes: &Prefixes,
    most: usize,
) -> Result<(), Halt> {
    for (&number, of_clause) in prefixes {
        let decided = |prefix: &Vec<u32>| {
            prefixes.range(..number).any(|(&earlier, prefixes)| prefixes.contains_key(&prefix[..earlier]))
        };
        // Where an earlier clause is decided anew, so is all that follows.
        let prefixes: Vec<_> = of_clause.iter().filter(|(prefix, _)| !decided(prefix)).collect();
        if prefixes.is_empty() {
            continue;
        }
        let mut fired: BTreeSet<Binding> = BTreeSet::new();
        for (prefix, _) in &prefixes {
            for binding in set.beginning(prefix) {
                if set.remove(&binding) == Some(true) {
                    fired.insert(binding);
                }
            }
        }
        let found = matching.after(number, together(&matching.program.clauses, &prefixes))?;
        set.take_in(&found, &fired, most)?;
    }
    Ok(())
}

fn together(clauses: &[Clause], prefixes: &[(&Vec<u32>, &Vec<f64>)]) -> Frame {
    let rows = |(variable, clause): (usize, &Clause)| match prefixes.first() {
        Some((first, _)) if variable >= first.len() => Rows::Unbound,
        _ if clause.quantifier.counts() => {
            Rows::Numbers(Lane::Each(prefixes.iter().map(|(_, numbers)| numbers[variable]).collect()))
        }
        _ => Rows::each(prefixes.iter().map(|(ids, _)| ids[variable]).collect()),
    };
    Frame { len: prefixes.len(), rows: clauses.iter().enumerate().map(rows).collect() }
}

fn seed(
    matching: &Matching,
    set: &mut ConflictSet,
    differences: &[Difference],
    most: usize,
) -> Result<(), Halt> {
    for (number, clause) in matching.program.clauses.iter().enumerate() {
        if clause.quantifier == Quantifier::Each {
            let added = differences[clause.class].added.iter().copied();
            let ids: Vec<u32> = added.chain(changed(clause, differences)).collect();
            set.take_in(&matching.with(number, &ids)?, &BTreeSet::new(), most)?;
        }
    }
    Ok(())
}
