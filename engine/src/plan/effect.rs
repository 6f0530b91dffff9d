//! What a rule does for each binding.

use rhai::{Expr, Position};

use super::action::{self, ActionPlan};
use super::fragment::Fragment;
use super::lower::Lowering;
use super::node::Node;
use super::{reaction, table};
use crate::diagnostic::Code;
use crate::rule::{Action, PropertyName};
use crate::value::Type;

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

impl Effect {
    pub(crate) fn actions(&self) -> impl Iterator<Item = &ActionPlan> {
        let (then, otherwise) = match self {
            Self::Conclude { then, otherwise } => (Some(then), otherwise.as_ref()),
            _ => (None, None),
        };
        then.into_iter().chain(otherwise)
    }

    pub(crate) fn interprets(&self) -> bool {
        match self {
            Self::Conclude { .. } => self.actions().any(ActionPlan::interprets),
            Self::Revise { amount: node, .. } | Self::Default { value: node, .. } => node.interprets(),
            Self::React(_) => true,
        }
    }
}

pub(super) fn effect(lowering: &mut Lowering) -> Effect {
    let rule = lowering.rule;
    match &rule.action {
        Action::Conclude { then, otherwise } => Effect::Conclude {
            then: action::action(lowering, then),
            otherwise: otherwise.as_ref().map(|block| action::action(lowering, block)),
        },
        Action::React(reaction) => Effect::React(reaction::body(lowering, reaction).map(Box::new)),
        Action::Default { property, value, position } => {
            default(lowering, property, value.as_ref(), *position)
        }
        Action::Table(table) => Effect::Conclude { then: table::action(lowering, table), otherwise: None },
        Action::Revise { target, amount, position, .. } => {
            check_revised(lowering, target, *position);
            Effect::Revise { variable: target.0, amount: lowering.wanted(amount, Type::Number) }
        }
    }
}

/// A revision needs a property that holds numbers.
fn check_revised(lowering: &mut Lowering, (variable, property): &(usize, String), position: Position) {
    let name = lowering.rule.clauses[*variable].variable.clone();
    if let Ok((_, Some(kind))) = lowering.property(&name, property, position)
        && kind != Type::Number
    {
        let message = format!("a revision changes numbers; `{name}.{property}` holds {}", kind.plural());
        lowering.problem(Code::Type, position, message);
    }
}

fn default(lowering: &mut Lowering, property: &str, value: Option<&Expr>, position: Position) -> Effect {
    let name = PropertyName::new(&lowering.rule.clauses[0].class, property);
    let wanted = lowering.kinds.declared(&name);
    lowering.own = Some(0);
    let lowered = value.map_or(Ok((Node::Unknown, None)), |value| lowering.lower(value));
    lowering.own = None;
    let lowered = lowered.and_then(|value| lowering.given("its default", &name, wanted, value, position));
    let (value, kind) = lowered.unwrap_or((Node::Unknown, None));
    Effect::Default { name, value, kind }
}

/// A hypothesis needs a property that holds truth values.
pub(super) fn hypothesis(lowering: &mut Lowering) -> Option<PropertyName> {
    let name = lowering.rule.hypothesis()?;
    let (_, _, position) = lowering.rule.hypothesis.as_ref()?;
    match lowering.kinds.declared(&name) {
        Some(kind) if kind != Type::Truth => {
            let message = format!("a hypothesis is true or false; {name} holds {}", kind.plural());
            lowering.problem(Code::Type, *position, message);
            None
        }
        _ => Some(name),
    }
}
