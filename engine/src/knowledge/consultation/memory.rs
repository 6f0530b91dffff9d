//! What rules said of objects, kept for those that look the same to them.
//!
//! Rules tell objects apart by what they look at alone: two distances on the same side of every number that a distance is
//! compared with are one to them. So a robot that is asked about hundreds of walls after each scan runs the rules for the
//! few that differ.

use std::collections::HashMap;

use crate::plan::action::Step;
use crate::plan::node::Node;
use crate::plan::{Effect, Plan};
use crate::value::Cell;

/// After so many objects it is looked whether it was worth it.
const TRIAL: u32 = 256;

/// No more answers are kept than that; then it begins anew.
const MOST: usize = 4096;

/// Stands for an unknown value: no number that is one has these bits.
const UNKNOWN: u64 = u64::MAX;

/// What of an input rules can tell apart.
#[derive(Clone, Debug)]
enum Grain {
    /// On which side of these numbers, in ascending order, it is.
    Between(Vec<f64>),
    Whole,
}

#[derive(Debug)]
pub(super) struct Memory {
    /// The inputs that rules look at, and how closely.
    grains: Vec<(usize, Grain)>,
    answers: HashMap<Box<[u64]>, Box<[Cell]>>,
    key: Vec<u64>,
    asked: u32,
    known: u32,
}

/// How rules look at properties: how often, and how often only to compare with a number, and with which.
#[derive(Debug, Default)]
pub(super) struct Looks(HashMap<usize, (usize, Vec<f64>)>);

impl Looks {
    /// Notes how a plan looks at the properties that its columns stand for.
    pub(super) fn note(&mut self, plan: &Plan, columns: &[usize]) {
        plan.clauses.iter().filter_map(|clause| clause.own.as_ref()).for_each(|own| self.node(own, columns));
        plan.effect.actions().for_each(|action| self.steps(&action.steps, columns));
        if let Effect::Revise { amount: node, .. } | Effect::Default { value: node, .. } = &plan.effect {
            self.node(node, columns);
        }
    }

    /// Notes that all of a property counts.
    pub(super) fn whole(&mut self, property: usize) {
        self.0.entry(property).or_default().0 += 1;
    }

    fn steps(&mut self, steps: &[Step], columns: &[usize]) {
        for step in steps {
            match step {
                Step::Put { value, .. } => self.node(value, columns),
                Step::If { condition, then, otherwise, .. } => {
                    self.node(condition, columns);
                    self.steps(then, columns);
                    self.steps(otherwise, columns);
                }
                Step::Interpret(_) => {}
            }
        }
    }

    fn node(&mut self, node: &Node, columns: &[usize]) {
        node.walk(&mut |node| match node {
            Node::Property { column, .. } => self.0.entry(columns[*column]).or_default().0 += 1,
            Node::Compare(_, a, b) => {
                if let (Node::Property { column, .. }, Node::Number(number))
                | (Node::Number(number), Node::Property { column, .. }) = (&**a, &**b)
                    && !number.is_nan()
                {
                    self.0.entry(columns[*column]).or_default().1.push(*number);
                }
            }
            _ => {}
        });
    }
}

impl Memory {
    /// Remembers by the first `inputs` of the properties.
    pub(super) fn new(looks: Looks, inputs: usize) -> Self {
        let of_inputs = looks.0.into_iter().filter(|(property, _)| *property < inputs);
        let mut grains: Vec<(usize, Grain)> = of_inputs
            .map(|(property, (times, mut numbers))| {
                if times > numbers.len() {
                    return (property, Grain::Whole);
                }
                numbers.sort_by(f64::total_cmp);
                numbers.dedup();
                (property, Grain::Between(numbers))
            })
            .collect();
        grains.sort_by_key(|(property, _)| *property);
        Self { grains, answers: HashMap::new(), key: Vec::new(), asked: 0, known: 0 }
    }

    /// What was said of an object that looked like this one.
    pub(super) fn recall(&mut self, inputs: &[Cell]) -> Option<&[Cell]> {
        self.asked += 1;
        self.key.clear();
        self.key.extend(self.grains.iter().map(|(input, grain)| grain.of(inputs[*input])));
        let known = self.answers.get(self.key.as_slice())?;
        self.known += 1;
        Some(known)
    }

    /// Keeps what was said of the object that was asked about last.
    pub(super) fn keep(&mut self, answers: &[Cell]) {
        if self.answers.len() >= MOST {
            self.answers.clear();
        }
        self.answers.insert(self.key.as_slice().into(), answers.into());
    }

    /// Whether it would take less time without: fewer than half of the objects looked like one before.
    pub(super) const fn is_idle(&mut self) -> bool {
        if self.asked < TRIAL {
            return false;
        }
        let is_idle = self.known < self.asked / 2;
        (self.asked, self.known) = (0, 0);
        is_idle
    }
}

impl Grain {
    fn of(&self, cell: Cell) -> u64 {
        match (self, cell) {
            (Self::Between(numbers), Cell::Number(number)) => {
                let below = numbers.partition_point(|known| *known < number);
                let is_one = numbers.get(below).is_some_and(|known| *known <= number);
                2 * below as u64 + u64::from(is_one)
            }
            // to the bit: one divided by minus zero is not what it is by zero
            (_, Cell::Number(number)) => number.to_bits(),
            (_, cell) => cell.bits().unwrap_or(UNKNOWN),
        }
    }
}
