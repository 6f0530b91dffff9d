//! Matches from scratch.

use std::collections::{BTreeMap, BTreeSet};

use super::conflict_set::{Binding, ConflictSet};
use super::follow::drop_changed;
use super::program::{Clause, Program};
use super::world::World;
use super::{Agenda, MadeFor, Outside, Reacting, Stopped, scripts, searching, within};
use crate::plan::reaction::reaction;

/// By name and version of a rule the rows of what was carried out.
type CarriedOut = BTreeMap<(String, String), BTreeSet<Vec<u32>>>;

impl Agenda {
    /// All matches from scratch. What was carried out stays carried out, if nothing that it rests on has changed.
    pub(super) fn rebuild(
        &mut self,
        outside: &Outside,
        wanted: Vec<(usize, MadeFor)>,
    ) -> Result<(), Stopped> {
        let mut fired = self.carried_out(outside);
        self.world = World::default();
        self.rules.clear();
        self.stale = true;
        for (rule, made_for) in wanted {
            let program = made_for.kinds.is_some().then(|| self.program(outside, rule)).flatten();
            let set = ConflictSet::new(program.as_ref().map_or(0, |program| program.clauses.len()));
            self.rules.push(Reacting { rule, made_for, program, set });
        }
        let mut stopped = Ok(());
        for at in 0..self.rules.len() {
            let others = self.others(at);
            let Reacting { rule, made_for, program, set } = &mut self.rules[at];
            let Some(program) = program else { continue };
            let fired = fired.remove(&(made_for.name.clone(), made_for.version.clone())).unwrap_or_default();
            if stopped.is_err() {
                // Matches are left out, but not what was carried out.
                set.restore(&fired);
                continue;
            }
            let scripts = scripts(outside, *rule);
            let mut search = searching(outside, &self.world, program, &scripts);
            let done = search.all(&mut |bound| {
                set.insert(&bound.ids, fired.contains(&bound.ids));
                within(outside, set, others)
            });
            let rule = *rule;
            if let Some(problem) = scripts.trouble.take() {
                outside.trouble(rule, problem);
            }
            if let Err(halt) = done {
                stopped = Err(Stopped { rule, halt });
                *set = ConflictSet::new(set.variables());
                set.restore(&fired);
            }
        }
        self.stale = stopped.is_err();
        stopped
    }

    fn program(&mut self, outside: &Outside, number: usize) -> Option<Program> {
        let rule = &outside.rules.rules[number];
        let action = rule.reaction()?;
        match reaction(rule, action, &*outside.kinds, outside.symbols) {
            Ok(plan) => Some(Program::new(rule, action, plan, &mut self.world, outside.facts)),
            Err(problems) => {
                for problem in problems {
                    outside.trouble(number, problem);
                }
                None
            }
        }
    }

    /// What was carried out and still holds, by rule and rows.
    fn carried_out(&mut self, outside: &Outside) -> CarriedOut {
        let differences = self.world.fetch(outside.facts);
        self.world.settle();
        let mut rows: Vec<BTreeMap<u32, u32>> = vec![];
        for objects in &self.world.classes {
            rows.push(objects.ids.iter().copied().zip(0..).collect());
        }
        let mut all = CarriedOut::new();
        for Reacting { made_for, program, set, .. } in &mut self.rules {
            if let Some(program) = program {
                drop_changed(program, set, &differences);
                let row = |(clause, id): (&Clause, &u32)| {
                    if clause.quantifier.binds() { rows[clause.class].get(id).copied() } else { Some(*id) }
                };
                let by_rows =
                    |binding: &Binding| program.clauses.iter().zip(binding.iter()).map(row).collect();
                let kept: BTreeSet<Vec<u32>> = set.fired().filter_map(by_rows).collect();
                all.insert((made_for.name.clone(), made_for.version.clone()), kept);
            }
        }
        all
    }
}
