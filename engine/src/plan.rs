//! A rule made ready to run: typed expressions over columns, joins by index, an action in steps.

pub(crate) mod action;
pub(crate) mod call;
pub(crate) mod clause;
pub(crate) mod fragment;
pub(crate) mod link;
pub(crate) mod lower;
pub(crate) mod node;
pub(crate) mod reaction;
pub(crate) mod seeded;
mod table;
pub(crate) mod uses;

use std::cell::RefCell;

use crate::diagnostic::Diagnostic;
use crate::rule::{Action, PropertyName, Rule};
use crate::symbols::Symbols;
use crate::value::Type;
use action::ActionPlan;
use clause::ClausePlan;
use fragment::Fragment;
use lower::Lowering;
use node::Node;

/// What is known of a property before objects are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Missing,
    /// It holds this type; `None` is a type that only running tells.
    Holds(Option<Type>),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Key {
    Unsaid,
    Properties(Vec<String>),
}

pub(crate) trait Kinds {
    fn kind(&self, property: &PropertyName) -> Kind;
    /// The type that a property was declared with, whatever rules conclude of it.
    fn declared(&self, property: &PropertyName) -> Option<Type>;
    fn key(&self, class: &str) -> Key;
    /// Names to suggest for a misspelt one.
    fn properties(&self, class: &str) -> Vec<String>;
}

#[derive(Clone, Debug)]
pub(crate) enum Effect {
    Conclude {
        then: ActionPlan,
        otherwise: Option<ActionPlan>,
    },
    Revise {
        variable: usize,
        amount: Node,
    },
    /// A value of the first clause's object for where nothing else gives one.
    Default {
        name: PropertyName,
        value: Node,
        kind: Option<Type>,
    },
    /// What the interpreter runs for what the clauses bind.
    React(Option<Box<Fragment>>),
}

#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) clauses: Vec<ClausePlan>,
    pub(crate) effect: Effect,
    /// The truth value that the rule gives to each object of its first clause.
    pub(crate) hypothesis: Option<PropertyName>,
    pub(crate) columns: Vec<PropertyName>,
}

/// Compiles a rule, or tells everything that is wrong with its names and types.
pub(crate) fn plan(
    rule: &Rule,
    kinds: &dyn Kinds,
    symbols: &RefCell<Symbols>,
) -> Result<Plan, Vec<Diagnostic>> {
    let mut lowering = Lowering::new(rule, kinds, symbols);
    let clauses = clause::clauses(&mut lowering);
    lowering.enter(None);
    let effect = match &rule.action {
        Action::Conclude { then, otherwise } => Effect::Conclude {
            then: action::action(&mut lowering, then),
            otherwise: otherwise.as_ref().map(|block| action::action(&mut lowering, block)),
        },
        Action::React(reaction) => reaction::effect(&mut lowering, reaction, symbols),
        Action::Default { property, value, position } => {
            action::default(&mut lowering, property, value.as_ref(), *position)
        }
        Action::Table(table) => {
            Effect::Conclude { then: table::action(&mut lowering, table), otherwise: None }
        }
        Action::Revise { target, amount, position, .. } => {
            action::check_revised(&mut lowering, target, *position);
            Effect::Revise { variable: target.0, amount: lowering.wanted(amount, Type::Number) }
        }
    };
    let hypothesis = action::hypothesis(&mut lowering);
    let (columns, problems) = lowering.finish();
    if problems.is_empty() { Ok(Plan { clauses, effect, hypothesis, columns }) } else { Err(problems) }
}

impl Plan {
    pub(crate) fn interprets(&self) -> bool {
        let clause = |clause: &ClausePlan| {
            let nodes = clause.parts.iter().chain(&clause.by).chain(&clause.have);
            nodes.chain(clause.joins.iter().map(|join| &join.key)).any(Node::interprets)
        };
        let effect = match &self.effect {
            Effect::Conclude { then, otherwise } => {
                then.interprets() || otherwise.as_ref().is_some_and(ActionPlan::interprets)
            }
            Effect::Revise { amount, .. } => amount.interprets(),
            Effect::Default { value, .. } => value.interprets(),
            Effect::React(_) => true,
        };
        effect || self.clauses.iter().any(clause)
    }
}
