//! How closely rules look at the inputs of a consultation.

use std::collections::HashMap;

use crate::plan::action::Step;
use crate::plan::node::Node;
use crate::plan::{Effect, Plan};

/// What rules can tell apart of an input: two objects that are alike in all of them are judged alike.
#[derive(Clone, Debug, PartialEq)]
pub enum Grain {
    /// Rules do not look at it.
    Nothing,
    /// A number that is compared alone: with these, in ascending order.
    Among(Vec<f64>),
    /// Every value may be another thing to them.
    Whole,
}

/// How rules look at properties, by number: how often, and the numbers with which they are only compared.
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

    /// How closely rules look at the first so many properties.
    pub(super) fn grains(mut self, inputs: usize) -> Vec<Grain> {
        let grain = |input| match self.0.remove(&input) {
            None => Grain::Nothing,
            Some((times, numbers)) if times > numbers.len() => Grain::Whole,
            Some((_, mut numbers)) => {
                numbers.sort_by(f64::total_cmp);
                numbers.dedup();
                Grain::Among(numbers)
            }
        };
        (0..inputs).map(grain).collect()
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
