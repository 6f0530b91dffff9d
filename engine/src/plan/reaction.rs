//! An `on` rule made ready: clauses as in every rule, and a body for the interpreter.

use std::cell::RefCell;

use rhai::{Expr, Position, Stmt};

use super::Kinds;
use super::clause::{self, ClausePlan};
use super::fragment::Fragment;
use super::lower::{Lowering, Stop};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{PropertyName, Reaction, Rule};
use crate::script::names::{Names, Patterns};
use crate::symbols::Symbols;
use crate::value::Type;

/// An `on` rule ready to run.
#[derive(Debug)]
pub(crate) struct ReactionPlan {
    pub(crate) clauses: Vec<ClausePlan>,
    pub(crate) body: Fragment,
    /// The columns that the nodes name by number.
    pub(crate) columns: Vec<PropertyName>,
}

/// Compiles an `on` rule, or tells everything that is wrong with its names and types.
pub(crate) fn reaction(
    rule: &Rule,
    reaction: &Reaction,
    kinds: &dyn Kinds,
    symbols: &RefCell<Symbols>,
) -> Result<ReactionPlan, Vec<Diagnostic>> {
    let mut lowering = Lowering::new(rule, kinds, symbols);
    let clauses = clause::clauses(&mut lowering);
    lowering.enter(None);
    for (name, kind, position) in told(rule, reaction, kinds, symbols) {
        if let (Some(holds), Some(kind)) = (kinds.declared(&name), kind)
            && holds != kind
        {
            let message = format!("{name} holds {}, and this gives {}", holds.plural(), kind.plural());
            lowering.problem(Code::Type, position, message);
        }
    }
    let mut names = Names::default();
    names.block(&reaction.body, &Patterns(&lowering.variables()));
    let statements = vec![Stmt::Block(Box::new(reaction.body.clone()))];
    let body = lowering.fragment(statements, &names, reaction.body.position());
    let (columns, problems) = lowering.finish();
    match body {
        Ok(body) if problems.is_empty() => Ok(ReactionPlan { clauses, body, columns }),
        Ok(_) | Err(Stop::Interpret | Stop::Wrong) => Err(problems),
    }
}

/// The properties that the body tells, as far as they are named in it, with the types that can be seen.
pub(crate) fn told(
    rule: &Rule,
    reaction: &Reaction,
    kinds: &dyn Kinds,
    symbols: &RefCell<Symbols>,
) -> Vec<(PropertyName, Option<Type>, Position)> {
    let kind = |value: &Expr| {
        // What cannot be typed here, since a `let` is in it, is no mistake.
        let mut lowering = Lowering::new(rule, kinds, symbols);
        lowering.enter(None);
        let lowered = lowering.lower(value);
        lowering.finish().1.is_empty().then_some(lowered).and_then(|lowered| lowered.ok()?.1)
    };
    let mut told = vec![];
    for telling in &reaction.tells {
        for (property, position, value) in &telling.properties {
            told.push((PropertyName::new(&telling.class, property), kind(value), *position));
        }
    }
    for setting in &reaction.sets {
        let name = PropertyName::new(&rule.clauses[setting.variable].class, &setting.property);
        told.push((name, setting.value.as_ref().and_then(kind), setting.position));
    }
    told
}
