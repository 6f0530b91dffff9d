//! Asks the machine for the matches of one rule.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::time::Instant;

use super::program::{Path, Program};
use super::world::{Facts, World};
use crate::diagnostic::Diagnostic;
use crate::machine::lane::{Frame, Lane, Rows};
use crate::machine::search::{Drivers, Search};
use crate::machine::{Machine, Stopped};
use crate::plan::Kinds;
use crate::rule_base::RuleBase;
use crate::script::syntax::Quantifier;
use crate::symbols::Lexicon;

pub(crate) struct Outside<'o> {
    pub(crate) rules: &'o RuleBase,
    pub(crate) facts: &'o dyn Facts,
    pub(crate) kinds: Box<dyn Kinds + 'o>,
    pub(crate) symbols: &'o Lexicon,
    pub(crate) deadline: Instant,
    pub(crate) matches: usize,
    /// By rule: what is wrong with it, or failed in a condition.
    pub(crate) troubles: RefCell<BTreeMap<usize, Vec<Diagnostic>>>,
}

impl Outside<'_> {
    pub(super) fn trouble(&self, rule: usize, problem: Diagnostic) {
        let mut troubles = self.troubles.borrow_mut();
        let known = troubles.entry(rule).or_default();
        if known.iter().all(|other| (other.code, other.span) != (problem.code, problem.span)) {
            known.push(problem);
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Halt {
    Late,
    /// There are more matches than may be kept.
    Full,
}

pub(crate) struct Matching<'m> {
    pub(crate) program: &'m Program,
    world: &'m World,
    machine: Machine<'m>,
    most: usize,
}

impl<'m> Matching<'m> {
    pub(crate) fn new(outside: &'m Outside<'_>, world: &'m World, rule: usize, program: &'m Program) -> Self {
        let columns = program.columns.iter().map(|&column| &world.columns[column]).collect();
        let rule = &outside.rules.rules[rule];
        let machine = Machine::new(rule, columns, outside.symbols, outside.deadline, true);
        Self { program, world, machine, most: outside.matches }
    }

    pub(crate) fn report(self, outside: &Outside, rule: usize) {
        if let Some(problem) = self.machine.trouble.take() {
            outside.trouble(rule, problem);
        }
    }

    pub(crate) fn all(&self) -> Result<Vec<Frame>, Halt> {
        let class = &self.world.classes[self.program.clauses[0].class];
        self.run(
            &self.program.full,
            match self.program.clauses[0].quantifier {
                Quantifier::Each => Drivers::Rows(&class.ids),
                _ => Drivers::Whole(0),
            },
        )
    }

    /// All matches in which an `each` has one of these objects; of another clause, all bindings of the clauses before
    /// it to which one of them matters.
    pub(crate) fn with(&self, clause: usize, ids: &[u32]) -> Result<Vec<Frame>, Halt> {
        if ids.is_empty() {
            return Ok(vec![]);
        }
        self.run(&self.program.from[clause], Drivers::Rows(ids))
    }

    /// All matches that go on from what the clauses before this one bind.
    pub(crate) fn after(&self, clause: usize, frame: Frame) -> Result<Vec<Frame>, Halt> {
        self.run(&self.program.full, Drivers::Bound(clause, frame))
    }

    fn search<'p>(&'p self, path: &'p Path) -> Search<'p> {
        let candidates =
            path.candidates.iter().map(|&number| Some(&self.world.candidates[number].candidates));
        Search::new(&self.machine, &self.program.plan, &path.clauses, candidates.collect())
    }

    fn run(&self, path: &Path, drivers: Drivers) -> Result<Vec<Frame>, Halt> {
        let late = |_| if Instant::now() > self.machine.deadline { Halt::Late } else { Halt::Full };
        self.search(path).bindings(drivers, self.most).map_err(late)
    }

    /// The numbers that clauses of `count` and `sum` give in a match, by clause.
    pub(crate) fn numbers(&self, binding: &[u32]) -> Result<Vec<f64>, Stopped> {
        let path = &self.program.full;
        let search = self.search(path);
        let mut frame = Frame { len: 1, rows: binding.iter().map(|&id| Rows::Same(id)).collect() };
        let counting = path.clauses.iter().enumerate().filter(|(_, clause)| clause.quantifier.counts());
        for (number, clause) in counting {
            let numbers = search.tally(number, clause, &frame)?.numbers(clause.quantifier);
            frame.rows[number] = Rows::Numbers(Lane::Each(numbers.into()));
        }
        Ok(frame.rows.iter().map(|rows| rows.number(0)).collect())
    }
}
