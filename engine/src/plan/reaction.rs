//! The body of an `on` rule, made ready for the interpreter.

use rhai::{Expr, Position, Stmt};

use super::fragment::Fragment;
use super::kinds::Kinds;
use super::lower::Lowering;
use super::node::Node;
use crate::rule::{PropertyName, Reaction, Rule};
use crate::script::names::{Names, Patterns};
use crate::symbols::Lexicon;
use crate::value::Type;

/// What an `on` rule runs; `None` where it cannot be run, which is on the list of problems.
pub(super) fn body(lowering: &mut Lowering, reaction: &Reaction) -> Option<Fragment> {
    for (name, kind, position) in told(lowering.rule, reaction, lowering.kinds, lowering.symbols) {
        let holds = lowering.kinds.declared(&name);
        // What is wrong is on the list.
        lowering.given("this", &name, holds, (Node::Unknown, kind), position).ok();
    }
    let mut names = Names::default();
    names.block(&reaction.body, &Patterns(&lowering.variables()));
    let statements = vec![Stmt::Block(Box::new(reaction.body.clone()))];
    lowering.fragment(statements, &names, reaction.body.position()).ok()
}

/// The properties that the body tells, as far as they are named in it, with the types that can be seen.
pub(crate) fn told(
    rule: &Rule,
    reaction: &Reaction,
    kinds: &dyn Kinds,
    symbols: &Lexicon,
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
