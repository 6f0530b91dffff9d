//! Goes through a rule's clauses, from batch to batch, and fires.

use super::action::Slots;
use super::candidates::Candidates;
use super::lane::{Frame, Lane, NO_ROW, Rows, Values};
use super::output::{Failure, Output, Status, Verdicts};
use super::{BATCH, Machine, Stopped};
use crate::diagnostic::Code;
use crate::plan::action::{ActionPlan, Target};
use crate::plan::clause::ClausePlan;
use crate::plan::node::Node;
use crate::plan::{Effect, Plan};
use crate::script::syntax::Quantifier;
use crate::value::Truth;

pub(crate) const MAX_FIRINGS: usize = 20_000_000;

/// The objects of the first clause from which a search starts.
#[derive(Clone, Debug)]
pub(crate) enum Drivers<'d> {
    Range(u32, u32),
    Rows(&'d [u32]),
    /// The first clause binds one object, or none, of so many.
    Whole(u32),
    /// What the clauses before this one bind is given.
    Bound(usize, Frame),
}

pub(crate) struct Search<'s> {
    pub(crate) machine: &'s Machine<'s>,
    pub(crate) plan: &'s Plan,
    clauses: &'s [ClausePlan],
    /// For each of them, but for the one that drives.
    candidates: Vec<Option<&'s Candidates>>,
    /// Most firings, or bindings.
    most: usize,
    /// What the clauses bind, where that alone is wanted.
    bindings: Option<Vec<Frame>>,
    pub(super) verdicts: Verdicts,
    pub(super) output: Output,
}

/// Evaluates a rule for some of the objects of its first clause; `candidates` has an entry for each clause, of which
/// the first counts for [`Drivers::Whole`] only.
pub(crate) fn search(
    machine: &Machine,
    plan: &Plan,
    candidates: &[Option<Candidates>],
    drivers: Drivers,
) -> Output {
    let mut search =
        Search::new(machine, plan, &plan.clauses, candidates.iter().map(Option::as_ref).collect());
    search.output = Output::nothing(plan, machine.rule);
    let stopped = search.start(drivers);
    let mut output = search.output;
    output.problem = machine.trouble.take();
    output.problems = machine.troubles.get();
    if stopped.is_err() || machine.stopped.get() {
        let message = format!(
            "rule \"{}\" was stopped: it did more, or took longer, than a rule may",
            machine.rule.name
        );
        let stopped = machine.rule.file.error(Code::Deadline, machine.rule.position, message);
        output.problem = output.problem.or(Some(stopped));
        output.problems = output.problems.max(1);
        output.stopped = true;
    }
    output
}

impl<'s> Search<'s> {
    pub(crate) fn new(
        machine: &'s Machine<'s>,
        plan: &'s Plan,
        clauses: &'s [ClausePlan],
        candidates: Vec<Option<&'s Candidates>>,
    ) -> Self {
        Self {
            machine,
            plan,
            clauses,
            candidates,
            most: MAX_FIRINGS,
            bindings: None,
            verdicts: Verdicts::default(),
            output: Output::default(),
        }
    }

    /// What the clauses bind; more than `most` are too many.
    pub(crate) fn bindings(mut self, drivers: Drivers, most: usize) -> Result<Vec<Frame>, Stopped> {
        (self.most, self.bindings) = (most, Some(vec![]));
        self.start(drivers).map(|()| self.bindings.unwrap_or_default())
    }

    fn start(&mut self, drivers: Drivers) -> Result<(), Stopped> {
        let unbound = || vec![Rows::Unbound; self.machine.rule.clauses.len()];
        let first = self.clauses.first().map_or(0, |clause| clause.variable);
        match drivers {
            Drivers::Whole(objects) => {
                self.advance(0, Frame { len: 1, rows: unbound() })?;
                self.verdicts.leave_open(self.candidates(0).undecided.iter().copied());
                self.settle(0..objects)?;
            }
            Drivers::Range(from, to) => {
                for start in (from..to).step_by(BATCH) {
                    let len = (to - start).min(BATCH as u32) as usize;
                    let mut frame = Frame { len, rows: unbound() };
                    frame.rows[first] = Rows::From(start);
                    self.drive(frame)?;
                }
                self.settle(from..to)?;
            }
            Drivers::Rows(rows) => {
                for chunk in rows.chunks(BATCH) {
                    self.drive(Frame::of(self.machine.rule.clauses.len(), first, chunk))?;
                }
                self.settle(rows.iter().copied())?;
            }
            Drivers::Bound(clause, frame) => self.advance(clause, frame)?,
        }
        Ok(())
    }

    fn drive(&mut self, frame: Frame) -> Result<(), Stopped> {
        self.machine.tick()?;
        let Some(own) = &self.clauses[0].own else { return self.advance(1, frame) };
        let truths = self.machine.values(own, &frame).truths();
        let truths = match truths {
            Lane::Same(Truth::True) => return self.advance(1, frame),
            truths => truths.into_static(),
        };
        let passing = self.passing(&truths, frame.len);
        for index in (0..frame.len).filter(|&index| truths.at(index) == Truth::Unknown) {
            let row = frame.rows[self.clauses[0].variable].at(index);
            self.output.left_out.push(row);
            self.verdicts.leave_open(std::iter::once(row));
        }
        if passing.is_empty() {
            return Ok(());
        }
        self.advance(1, frame.kept(&passing))
    }

    #[allow(clippy::unused_self)] // it reads as a step of the search
    fn passing(&self, truths: &Lane<Truth>, len: usize) -> Vec<u32> {
        (0..len as u32).filter(|&index| truths.at(index as usize) == Truth::True).collect()
    }

    fn advance(&mut self, number: usize, frame: Frame) -> Result<(), Stopped> {
        self.machine.tick()?;
        let Some(clause) = self.clauses.get(number) else { return self.fire(frame) };
        if clause.quantifier == Quantifier::Each {
            self.each(number, clause, &frame)?;
            return self.doubt(number, clause, &frame);
        }
        if clause.quantifier.counts() {
            let numbers = self.tally(number, clause, &frame)?.numbers(clause.quantifier);
            let mut next = frame;
            next.rows[clause.variable] = Rows::Numbers(Lane::Each(numbers.into()));
            return self.filtered(number, clause.after.as_ref(), next);
        }
        if clause.quantifier == Quantifier::Link {
            let rows = match self.candidates(number).index {
                Some(_) => self.groups(number, clause, &frame),
                None => vec![&[][..]; frame.len],
            };
            let first = rows.into_iter().map(|rows| rows.first().copied().unwrap_or(NO_ROW)).collect();
            let mut next = frame;
            next.rows[clause.variable] = Rows::each(first);
            return self.filtered(number, clause.after.as_ref(), next);
        }
        if clause.quantifier == Quantifier::All {
            return self.all(number, clause, frame);
        }
        let found = self.witnesses(number, clause, &frame)?;
        let wanted = clause.quantifier != Quantifier::None;
        if wanted && !found.rows.contains(&NO_ROW) {
            let mut next = frame;
            next.rows[clause.variable] = Rows::each(found.rows);
            return self.filtered(number, clause.after.as_ref(), next);
        }
        let met = |index: &u32| (found.rows[*index as usize] != NO_ROW) == wanted;
        let (passing, failing): (Vec<u32>, Vec<u32>) = (0..frame.len as u32).partition(met);
        if !failing.is_empty() {
            let of = |index: &u32| (found.rows[*index as usize], found.unknown[*index as usize]);
            let found: Vec<(u32, u32)> = failing.iter().map(of).collect();
            let failed = frame.select(&failing);
            if wanted {
                self.doubt(number, clause, &failed)?;
            }
            self.fail(number, failed, &found)?;
        }
        if passing.is_empty() {
            return Ok(());
        }
        let mut next = frame.kept(&passing);
        next.rows[clause.variable] = if wanted {
            Rows::each(passing.iter().map(|&index| found.rows[index as usize]).collect())
        } else {
            Rows::Unbound
        };
        self.filtered(number, clause.after.as_ref(), next)
    }

    /// Goes on with the bindings of which it is known that all objects have what is asked.
    fn all(&mut self, number: usize, clause: &'s ClausePlan, frame: Frame) -> Result<(), Stopped> {
        let tally = self.tally(number, clause, &frame)?;
        let met = |index: &u32| tally.holds(*index as usize) == Truth::True;
        let (passing, failing): (Vec<u32>, Vec<u32>) = (0..frame.len as u32).partition(met);
        if !failing.is_empty() {
            let found: Vec<(u32, u32)> =
                failing.iter().map(|&index| (NO_ROW, tally.undecided(index as usize))).collect();
            self.fail(number, frame.select(&failing), &found)?;
        }
        if passing.is_empty() {
            return Ok(());
        }
        self.filtered(number, clause.after.as_ref(), frame.kept(&passing))
    }

    fn each(&mut self, number: usize, clause: &'s ClausePlan, frame: &Frame) -> Result<(), Stopped> {
        let candidates = self.candidates(number);
        if candidates.index.is_some() {
            let groups = self.groups(number, clause, frame);
            let unknown_key = if clause.perhaps { self.unknown_keys(clause, frame) } else { vec![] };
            let perhaps = |binding: usize| unknown_key.get(binding).map(|&key| candidates.perhaps(key));
            let rows = |binding: usize| groups[binding].iter().chain(perhaps(binding).into_iter().flatten());
            for batch in batches(pairs(frame, rows)) {
                self.filtered(number, clause.test.as_ref(), frame.paired(clause.variable, &batch))?;
            }
            return Ok(());
        }
        for binding in 0..frame.len {
            for (_, next) in candidates.batches(clause.variable, frame, binding) {
                self.filtered(number, clause.test.as_ref(), next)?;
            }
        }
        Ok(())
    }

    /// Bindings with the rows that may be bound to a clause's variable, so many at a time.
    pub(super) fn in_batches(
        &self,
        clause: &ClausePlan,
        frame: &Frame,
        pairs: impl Iterator<Item = (u32, u32)>,
        mut look: impl FnMut(&Frame, &[(u32, u32)]),
    ) -> Result<(), Stopped> {
        for batch in batches(pairs) {
            self.machine.tick()?;
            look(&frame.paired(clause.variable, &batch), &batch);
        }
        Ok(())
    }

    fn filtered(&mut self, number: usize, test: Option<&Node>, frame: Frame) -> Result<(), Stopped> {
        let Some(test) = test else { return self.advance(number + 1, frame) };
        // where nothing passes nobody else looks at the clock
        self.machine.tick()?;
        let truths = self.machine.values(test, &frame).truths().into_static();
        if self.plan.hypothesis.is_some() {
            let unknown = (0..frame.len).filter(|&index| truths.at(index) == Truth::Unknown);
            self.verdicts.leave_open(unknown.map(|index| frame.rows[0].at(index)));
        }
        let passing = match &truths {
            Lane::Same(Truth::True) => return self.advance(number + 1, frame),
            Lane::Same(_) => return Ok(()),
            Lane::Each(_) => self.passing(&truths, frame.len),
        };
        if passing.is_empty() {
            return Ok(());
        }
        self.advance(number + 1, frame.kept(&passing))
    }

    pub(crate) fn groups(&self, number: usize, clause: &ClausePlan, frame: &Frame) -> Vec<&'s [u32]> {
        let Some(index) = &self.candidates(number).index else { return vec![] };
        let keys = self.machine.keys(clause, frame);
        (0..frame.len).map(|binding| index.rows(keys.iter().map(|key| key.cell(binding)))).collect()
    }

    pub(crate) fn candidates(&self, number: usize) -> &'s Candidates {
        static NONE: Candidates = Candidates::NONE;
        self.candidates.get(number).copied().flatten().unwrap_or(&NONE)
    }

    /// `found` is for each binding what a `none` found, and how many candidates an unknown kept out.
    fn fail(&mut self, number: usize, mut frame: Frame, found: &[(u32, u32)]) -> Result<(), Stopped> {
        let plan = self.plan;
        if self.bindings.is_some() {
            return Ok(());
        }
        // A `none` that found one is decided, whatever else is unknown.
        let undecided = |(row, unknown): &(u32, u32)| *row == NO_ROW && *unknown > 0;
        for (index, &(_, unknown)) in found.iter().enumerate().filter(|(_, found)| undecided(found)) {
            let row = frame.rows[0].at(index);
            self.output.undecided.push((row, unknown));
            self.verdicts.leave_open(std::iter::once(row));
        }
        if plan.clauses[number].quantifier == Quantifier::None {
            frame.rows[number] = Rows::Each(found.iter().map(|&(row, _)| row).collect());
        }
        if let Effect::Conclude { otherwise: Some(action), .. } = &plan.effect {
            return self.conclude(action, &frame, Status::otherwise(number));
        }
        let failure = |index| Failure { row: frame.rows[0].at(index), clause: number as u32 };
        self.output.failures.extend((0..frame.len).map(failure));
        for (column, rows) in self.output.failed.iter_mut().zip(&frame.rows) {
            rows.extend(column, frame.len);
        }
        Ok(())
    }

    fn fire(&mut self, frame: Frame) -> Result<(), Stopped> {
        if let Some(bindings) = &mut self.bindings {
            self.output.firings += frame.len;
            bindings.push(frame);
            return if self.output.firings > self.most { Err(Stopped) } else { Ok(()) };
        }
        let (plan, frame) = (self.plan, &frame);
        match &plan.effect {
            Effect::Conclude { then, .. } => {
                self.prove(frame);
                self.conclude(then, frame, Status::THEN)
            }
            Effect::Default { value: node, .. } | Effect::Revise { amount: node, .. } => {
                self.record(frame, Status::THEN)?;
                let values = self.machine.values(node, frame);
                self.output.given.iter_mut().for_each(|given| given.say(&values, frame.len));
                Ok(())
            }
            Effect::React(_) => Ok(()),
        }
    }

    fn conclude(&mut self, action: &ActionPlan, frame: &Frame, status: Status) -> Result<(), Stopped> {
        self.record(frame, status)?;
        let Slots { values, written } = self.machine.act(action, frame);
        let proves = (status == Status::THEN).then_some(self.plan.hypothesis.as_ref()).flatten();
        for given in &mut self.output.given {
            if Some(&given.name) == proves && given.variable == 0 {
                given.say(&Values::Truths(Lane::Same(Truth::True)), frame.len);
                continue;
            }
            let of = |target: &&Target| target.variable == given.variable && target.name == given.name;
            if let Some(target) = action.targets.iter().find(of) {
                given.values.extend(&values[target.slot], frame.len);
                written[target.slot].extend(&mut given.written, frame.len);
            } else {
                given.say_nothing(frame.len);
            }
        }
        Ok(())
    }

    pub(super) fn record(&mut self, frame: &Frame, status: Status) -> Result<(), Stopped> {
        if self.output.firings > self.most {
            return Err(Stopped);
        }
        for (column, rows) in self.output.witnesses.iter_mut().zip(&frame.rows) {
            rows.extend(column, frame.len);
        }
        self.output.statuses.resize(self.output.firings + frame.len, status);
        self.output.firings += frame.len;
        Ok(())
    }
}

pub(super) fn pairs<'r, I: Iterator<Item = &'r u32>>(
    frame: &Frame,
    rows: impl Fn(usize) -> I,
) -> impl Iterator<Item = (u32, u32)> {
    (0..frame.len).flat_map(move |binding| rows(binding).map(move |&row| (binding as u32, row)))
}

fn batches(mut pairs: impl Iterator<Item = (u32, u32)>) -> impl Iterator<Item = Vec<(u32, u32)>> {
    let next = move || Some(pairs.by_ref().take(BATCH).collect());
    std::iter::from_fn(next).take_while(|batch: &Vec<_>| !batch.is_empty())
}
