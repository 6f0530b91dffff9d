//! Which objects of its first clause a rule has to look at again after a change: never too few, and as few as can be
//! told without evaluating it.

use std::cmp::Ordering;

use super::KnowledgeBase;
use super::conclude::Run;
use super::dirty::Dirty;
use super::evaluate::below;
use super::memory::{Memory, Shape};
use super::network::Planned;
use crate::machine::candidates::Candidates;
use crate::machine::index::Index;
use crate::machine::lane::{Frame, NO_ROW, Rows};
use crate::machine::output::Status;
use crate::machine::{BATCH, Machine};
use crate::plan::clause::ClausePlan;
use crate::plan::node::Node;
use crate::rule::Rule;
use crate::script::syntax::Quantifier;
use crate::value::Truth;

/// Up to so many changed candidates are tried one by one; of more, all bindings that came as far are looked at again.
const TRIED: usize = 16;

/// What changed in a clause's class, as far as the rule looks at it.
struct Change {
    /// Rows with a value that the rule reads, new ones not counted.
    read: Dirty,
    /// Rows with a value that decides whether they are bound, and new ones.
    matching: Dirty,
    /// Rows with a value that decides whether they pass, whatever they are compared by, and new ones.
    passing: Dirty,
    /// Whether links may lead elsewhere: an object is gone, moved, or has another value by which they find it.
    is_led_anew: bool,
    /// The candidates before the change: the best first.
    before: Option<Candidates>,
}

impl Change {
    fn is_nothing(&self) -> bool {
        self.read.is_none() && self.matching.is_none() && !self.is_led_anew
    }
}

impl KnowledgeBase {
    pub(super) fn affected(&self, run: &Run, rule: &Rule, planned: &Planned, memory: &mut Memory) -> Dirty {
        let mut changes: Vec<Change> =
            (0..rule.clauses.len()).map(|number| self.change(run, rule, planned, number)).collect();
        for (number, change) in changes.iter_mut().enumerate() {
            if !change.matching.is_none() {
                change.before = memory.candidates[number].take();
            }
        }
        let mut dirty = Dirty::Rows(std::mem::take(&mut memory.lost));
        if memory.unasked == memory.statuses.len() {
            return Dirty::None;
        }
        let nothing = changes.iter().all(Change::is_nothing);
        if nothing && dirty == Dirty::Rows(vec![]) {
            return Dirty::None;
        }
        if memory.shape == Shape::Whole || memory.problem.is_some() {
            // What failed is counted as a whole.
            return Dirty::All;
        }
        dirty.join(&changes[0].read);
        dirty.join(&changes[0].matching);
        let machine = self.machine(rule, &planned.plan, run.until);
        for (number, change) in changes.iter().enumerate().skip(1) {
            if dirty == Dirty::All {
                break;
            }
            let found = self.through(&machine, planned, memory, rule, number, change);
            dirty.join(&found);
        }
        match dirty {
            Dirty::Rows(mut rows) => {
                rows.retain(|&row| {
                    memory.statuses.get(row as usize).is_some_and(|&status| status != Status::UNASKED)
                });
                Dirty::Rows(rows)
            }
            Dirty::All if memory.unasked > 0 => {
                let asked = memory.statuses.iter().zip(0..).filter(|(status, _)| **status != Status::UNASKED);
                Dirty::Rows(asked.map(|(_, row)| row).collect())
            }
            other => other,
        }
    }

    fn change(&self, run: &Run, rule: &Rule, planned: &Planned, number: usize) -> Change {
        let class = &rule.clauses[number].class;
        let mut change = Change {
            read: Dirty::None,
            matching: Dirty::None,
            passing: Dirty::None,
            is_led_anew: false,
            before: None,
        };
        if !run.touched.contains(class) {
            return change;
        }
        let mut is_moved = false;
        if let Some(told) = run.told.get(class) {
            if told.anew {
                let [read, matching, passing] = [Dirty::All, Dirty::All, Dirty::All];
                return Change { read, matching, passing, is_led_anew: true, before: None };
            }
            is_moved = told.moved.is_some();
            change.matching.extend(told.added.iter().copied());
            change.passing.extend(told.added.iter().copied());
        }
        let delta = |column: usize| {
            let name = &planned.plan.columns[column];
            let stage = self.derived.get(name).map_or(0, |derived| derived.stage(below(rule, name)));
            run.delta(name, stage)
        };
        for &column in &planned.uses.anywhere[number] {
            change.read.join(delta(column));
        }
        for &column in &planned.uses.matching[number] {
            change.matching.join(delta(column));
        }
        for &column in &planned.uses.passing[number] {
            change.passing.join(delta(column));
        }
        let clause = &planned.plan.clauses[number];
        change.is_led_anew = clause.quantifier == Quantifier::Link
            && (is_moved || clause.joins.iter().any(|join| !delta(join.column).is_none()));
        change
    }

    /// The objects of the first clause that a change in a later clause's class concerns.
    fn through(
        &self,
        machine: &Machine,
        planned: &Planned,
        memory: &Memory,
        rule: &Rule,
        number: usize,
        change: &Change,
    ) -> Dirty {
        if change.is_nothing() {
            return Dirty::None;
        }
        let clause = &planned.plan.clauses[number];
        let many = [&change.read, &change.matching].contains(&&Dirty::All);
        // A hypothesis hangs on all that is unknown, too.
        let proves = planned.plan.hypothesis.is_some();
        if memory.shape != Shape::Single || !clause.quantifier.names() || proves || many || change.is_led_anew
        {
            return Dirty::All;
        }
        let size = self.len(&rule.clauses[number].class).unwrap_or(0);
        let look = Look { machine, memory, clause, number, size };
        let mut dirty = look.resting_on(&change.read.rows(size));
        let mut matching = change.matching.clone();
        if clause.quantifier == Quantifier::Link {
            // of an object that came no further it is not kept where its links led
            matching.join(&change.read);
        }
        let matching = matching.settle(usize::MAX).rows(size);
        if matching.is_empty() {
            return dirty;
        }
        // One of those that were unknown may be decided now.
        dirty.extend(memory.undecided.keys().copied());
        let reached = look.reached(&matching, change);
        if clause.joins.is_empty() {
            look.tried(&matching, &reached, &mut dirty);
        } else {
            look.joined(&matching, &reached, &mut dirty);
        }
        dirty
    }
}

/// Looks for the objects of the first clause that changed candidates of a later one concern.
struct Look<'l> {
    machine: &'l Machine<'l>,
    memory: &'l Memory,
    clause: &'l ClausePlan,
    number: usize,
    /// How many objects its class has.
    size: usize,
}

impl Look<'_> {
    /// Objects whose firing, or failure, rests on one of these rows.
    fn resting_on(&self, rows: &[u32]) -> Dirty {
        let mut dirty = Dirty::None;
        let witnesses = self.memory.witnesses[self.number].iter().zip(0..);
        match rows {
            [] => {}
            [row] => dirty.extend(witnesses.filter(|(witness, _)| *witness == row).map(|(_, driver)| driver)),
            rows => {
                let mut among = vec![false; self.size];
                for &row in rows {
                    among[row as usize] = true;
                }
                let hit = |witness: u32| among.get(witness as usize) == Some(&true);
                dirty.extend(witnesses.filter(|(witness, _)| hit(**witness)).map(|(_, driver)| driver));
            }
        }
        dirty
    }

    /// Objects whose search came as far as this clause, and for which one of the candidates could win.
    fn reached(&self, matching: &[u32], change: &Change) -> Vec<u32> {
        let Self { memory, clause, number, size, .. } = *self;
        let came = memory.statuses.iter().zip(0_u32..).filter(|(status, _)| status.reached(number));
        let came = came.map(|(_, driver)| driver);
        if clause.quantifier == Quantifier::Link {
            // what is asked of the object before may be asked through the link, and have kept it from coming further
            let silent = |status: &Status| status.reached(number) || *status == Status::SILENT;
            let all = memory.statuses.iter().zip(0_u32..).filter(|(status, _)| silent(status));
            return all.map(|(_, driver)| driver).collect();
        }
        if !clause.joins.is_empty() {
            return came.collect();
        }
        let better = Better::of(change, size);
        let beaten: Vec<bool> = match (&clause.by, clause.quantifier) {
            // A `none` that found one finds one still, unless that one changed.
            (_, Quantifier::None) => vec![false; size],
            (Some(by), quantifier) if clause.by_own => {
                let all: Vec<u32> = (0..size as u32).collect();
                let frame = Frame::of(memory.witnesses.len(), number, &all);
                let values = self.machine.values(by, &frame).numbers();
                let value = |row: u32| values.at(row as usize) + 0.0;
                let before = |a: u32, b: u32| match (quantifier, value(a).partial_cmp(&value(b))) {
                    (Quantifier::Most, Some(Ordering::Greater))
                    | (Quantifier::Least, Some(Ordering::Less)) => true,
                    (_, Some(Ordering::Equal)) => a <= b,
                    _ => false,
                };
                // Unknown values are no candidates, but are counted as such.
                let wins = |a: u32, b: u32| before(a, b) || value(a).is_nan() || value(b).is_nan();
                let beats = |candidate: u32, row: u32| wins(candidate, row) && !better.lost(candidate, row);
                all.iter().map(|&row| matching.iter().any(|&candidate| beats(candidate, row))).collect()
            }
            (None, Quantifier::Some) => {
                (0..size as u32).map(|row| matching.iter().any(|&candidate| candidate <= row)).collect()
            }
            _ => vec![true; size],
        };
        let ranked = clause.by.is_some() && clause.by_own;
        let unmet = !ranked || matching.iter().any(|&candidate| better.rank(candidate).is_none());
        if !unmet && !beaten.contains(&true) {
            return vec![];
        }
        came.filter(|&driver| {
            let witness = memory.witnesses[number][driver as usize];
            if witness == NO_ROW { unmet } else { beaten.get(witness as usize) != Some(&false) }
        })
        .collect()
    }

    /// Objects for which one of the candidates passes now, or may.
    fn tried(&self, matching: &[u32], reached: &[u32], dirty: &mut Dirty) {
        if matching.len() > TRIED {
            dirty.extend(reached.iter().copied());
            return;
        }
        let own = Frame::of(self.memory.witnesses.len(), self.number, matching);
        let passing = self.may_pass(self.clause.own.as_ref(), &own, matching);
        for chunk in reached.chunks(BATCH) {
            let mut frame = self.bound(chunk);
            for &row in &passing {
                frame.rows[self.number] = Rows::Same(row);
                dirty.extend(self.may_pass(self.clause.test.as_ref(), &frame, chunk));
                if self.clause.test.is_none() {
                    break;
                }
            }
        }
    }

    /// Of these rows, one for each binding, those for which the test is not false.
    fn may_pass(&self, test: Option<&Node>, frame: &Frame, rows: &[u32]) -> Vec<u32> {
        let Some(test) = test else { return rows.to_vec() };
        let truths = self.machine.values(test, frame).truths();
        let open = rows.iter().enumerate().filter(|&(at, _)| truths.at(at) != Truth::False);
        open.map(|(_, &row)| row).collect()
    }

    /// Objects whose key is that of one of the candidates.
    fn joined(&self, matching: &[u32], reached: &[u32], dirty: &mut Dirty) {
        let joins = self.clause.joins.iter();
        let hangs_on_links = joins.clone().any(|join| join.key.variables() & !1 != 0);
        if self.clause.quantifier == Quantifier::Link && hangs_on_links {
            // whom the links before lead to is not kept of an object that came no further
            dirty.extend(reached.iter().copied());
            return;
        }
        let columns: Vec<_> = joins.map(|join| self.machine.columns[join.column]).collect();
        let index = Index::new(&columns, matching);
        for chunk in reached.chunks(BATCH) {
            let frame = self.bound(chunk);
            let keys = self.machine.keys(self.clause, &frame);
            // An unknown key finds nothing, now as before.
            let found = |&at: &usize| !index.rows(keys.iter().map(|key| key.cell(at))).is_empty();
            dirty.extend((0..chunk.len()).filter(found).map(|at| chunk[at]));
        }
    }

    /// These objects of the first clause, with what the clauses before this one are bound to.
    fn bound(&self, drivers: &[u32]) -> Frame {
        let mut rows = vec![Rows::Unbound; self.memory.witnesses.len()];
        rows[0] = Rows::Each(drivers.to_vec());
        for (rows, column) in rows.iter_mut().zip(&self.memory.witnesses).take(self.number).skip(1) {
            *rows = Rows::Each(drivers.iter().map(|&driver| column[driver as usize]).collect());
        }
        Frame { len: drivers.len(), rows }
    }
}

/// The order of the candidates before a change, as far as what they have to pass is as it was: one that stood before
/// the witness did not pass, and does not now.
struct Better {
    ranks: Vec<Option<u32>>,
}

impl Better {
    fn of(change: &Change, size: usize) -> Self {
        let mut ranks = vec![None; size];
        if let Some(before) = &change.before {
            for (&row, rank) in before.rows.iter().zip(0..) {
                if let Some(place) = ranks.get_mut(row as usize) {
                    *place = Some(rank);
                }
            }
        }
        for row in change.passing.rows(size) {
            if let Some(place) = ranks.get_mut(row as usize) {
                *place = None;
            }
        }
        Self { ranks }
    }

    /// Where it stood, if it passes what it passed.
    fn rank(&self, row: u32) -> Option<u32> {
        self.ranks.get(row as usize).copied().flatten()
    }

    /// Whether a candidate stood before one that was chosen; what rests on itself is found by itself.
    fn lost(&self, candidate: u32, chosen: u32) -> bool {
        matches!((self.rank(candidate), self.rank(chosen)), (Some(candidate), Some(chosen)) if candidate <= chosen)
    }
}
