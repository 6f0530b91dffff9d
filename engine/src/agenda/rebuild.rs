//! Matches from scratch.

use std::collections::{BTreeMap, BTreeSet};

use super::conflict_set::{Binding, ConflictSet};
use super::follow::drop_changed;
use super::matching::Matching;
use super::program::{Clause, Program};
use super::world::World;
use super::{Agenda, MadeFor, Outside, Reacting, Stopped};
use crate::plan::plan;

/// By name and version of a rule the rows of what was carried out.
type CarriedOut = BTreeMap<(String, String), BTreeSet<Binding>>;

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
            let most = outside.matches.saturating_sub(self.others(at));
            let Reacting { rule, made_for, program, set } = &mut self.rules[at];
            let Some(program) = program else { continue };
            let fired = fired.remove(&(made_for.name.clone(), made_for.version.clone())).unwrap_or_default();
            let mut done = Ok(());
            if stopped.is_ok() {
                let matching = Matching::new(outside, &self.world, *rule, program);
                done = matching.all().and_then(|found| set.take_in(&found, &fired, most));
                matching.report(outside, *rule);
            }
            if stopped.is_err() || done.is_err() {
                // Matches are left out, but not what was carried out.
                *set = ConflictSet::of_fired(set.variables(), &fired);
            }
            stopped = stopped.and(done.map_err(|halt| Stopped { rule: *rule, halt }));
        }
        self.stale = stopped.is_err();
        stopped
    }

    fn program(&mut self, outside: &Outside, number: usize) -> Option<Program> {
        let rule = &outside.rules.rules[number];
        let action = rule.reaction()?;
        match plan(rule, &*outside.kinds, outside.symbols) {
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
        let differences = self.world.differences(outside.facts);
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
                let kept: BTreeSet<Binding> = set.fired().filter_map(by_rows).collect();
                all.insert((made_for.name.clone(), made_for.version.clone()), kept);
            }
        }
        all
    }
}
