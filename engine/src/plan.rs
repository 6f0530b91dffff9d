//! A rule made ready to run: typed expressions over columns, joins by index, an action in steps.

pub(crate) mod action;
pub(crate) mod call;
pub(crate) mod clause;
mod effect;
pub(crate) mod fragment;
pub(crate) mod kinds;
pub(crate) mod link;
pub(crate) mod lower;
pub(crate) mod node;
pub(crate) mod reaction;
pub(crate) mod seeded;
mod table;
pub(crate) mod uses;

use crate::diagnostic::Diagnostic;
use crate::rule::{PropertyName, Rule};
use crate::symbols::Lexicon;
use crate::value::Type;
use clause::ClausePlan;
pub(crate) use effect::Effect;
pub(crate) use kinds::{Key, Kind, Kinds};
use lower::Lowering;
use node::Node;

#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) clauses: Vec<ClausePlan>,
    pub(crate) effect: Effect,
    /// The truth value that the rule gives to each object of its first clause.
    pub(crate) hypothesis: Option<PropertyName>,
    pub(crate) columns: Vec<PropertyName>,
}

/// Compiles a rule, or tells everything that is wrong with its names and types.
pub(crate) fn plan(rule: &Rule, kinds: &dyn Kinds, symbols: &Lexicon) -> Result<Plan, Vec<Diagnostic>> {
    let mut lowering = Lowering::new(rule, kinds, symbols);
    let clauses = clause::clauses(&mut lowering);
    lowering.enter(None);
    let effect = effect::effect(&mut lowering);
    let hypothesis = effect::hypothesis(&mut lowering);
    let (columns, problems) = lowering.finish();
    if problems.is_empty() { Ok(Plan { clauses, effect, hypothesis, columns }) } else { Err(problems) }
}

impl Plan {
    /// For each clause whether a property of the first clause's object names its object, directly or by way of others,
    /// by the key of its class: then nothing was chosen.
    ///
    /// # Arguments
    /// `key` is the one property that tells objects of a class apart.
    pub(crate) fn named<'k>(&self, key: impl Fn(&str) -> Option<&'k str>) -> Vec<bool> {
        let mut named = vec![false; self.clauses.len()];
        for (index, clause) in self.clauses.iter().enumerate() {
            named[index] = clause.joins.iter().any(|join| {
                let PropertyName { class, property } = &self.columns[join.column];
                key(class) == Some(property)
                    && matches!(join.key, Node::Property { variable, .. } if variable == 0 || named[variable])
            });
        }
        named
    }

    /// Whether running it calls the interpreter.
    pub(crate) fn interprets(&self) -> bool {
        let clause = |clause: &ClausePlan| {
            let nodes = clause.parts.iter().chain(&clause.by).chain(&clause.have);
            nodes.chain(clause.joins.iter().map(|join| &join.key)).any(Node::interprets)
        };
        self.effect.interprets() || self.clauses.iter().any(clause)
    }

    /// What the rule sets: each property with its variable and, where it is known before running, its type.
    pub(crate) fn targets<'p>(&'p self, rule: &'p Rule) -> Vec<(&'p PropertyName, usize, Option<Type>)> {
        let mut out: Vec<(&PropertyName, usize, Option<Type>)> = vec![];
        for target in self.effect.actions().flat_map(|action| &action.targets) {
            let same = out.iter_mut().find(|(name, of, _)| (*name, *of) == (&target.name, target.variable));
            match same {
                Some((_, _, kind)) => *kind = kind.or(target.kind),
                None => out.push((&target.name, target.variable, target.kind)),
            }
        }
        out.extend(self.hypothesis.iter().map(|name| (name, 0, Some(Type::Truth))));
        match &self.effect {
            Effect::Default { name, kind, .. } => out.push((name, 0, *kind)),
            Effect::Revise { variable, .. } => {
                out.extend(rule.sets.keys().map(|name| (name, *variable, Some(Type::Number))));
            }
            Effect::Conclude { .. } | Effect::React(_) => {}
        }
        out
    }
}
