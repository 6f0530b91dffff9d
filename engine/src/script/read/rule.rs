//! From an item's inputs to a rule.

use std::sync::Arc;

use rhai::{Expr, Position, StmtBlock};

use super::item::Item;
use super::table::table;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, FileScope, Operator, Rule};
use crate::script::names::property_of;
use crate::script::reaction::reaction;
use crate::script::syntax::{Quantifier, Slot, Word};

/// A rule, revision or reaction, before its names are looked up.
pub(super) fn rule(item: &Item, file: &Arc<FileScope>, problems: &mut Vec<Diagnostic>) -> Option<Rule> {
    let (name, position) = item.name()?;
    let clauses = clauses(item);
    let action = action(item, &clauses, file, problems)?;
    let priority = priority(item, file, problems);
    let hypothesis = hypothesis(item, &clauses, file, problems);
    Some(Rule { priority, hypothesis, ..Rule::new(name.to_owned(), position, clauses, action, file) })
}

fn priority(item: &Item, file: &FileScope, problems: &mut Vec<Diagnostic>) -> i64 {
    let given = item.inputs.iter().find(|(slot, _)| *slot == Slot::Priority);
    match given {
        None => 0,
        Some((_, Expr::IntegerConstant(priority, _))) => *priority,
        Some((_, other)) => {
            let message = "a priority is a whole number, as in `priority 10` or `priority -1`";
            problems.push(file.error(Code::Syntax, other.start_position(), message));
            0
        }
    }
}

fn hypothesis(
    item: &Item,
    clauses: &[Clause],
    file: &FileScope,
    problems: &mut Vec<Diagnostic>,
) -> Option<(usize, String, Position)> {
    let given = item.input(Slot::Hypothesis)?;
    let first = clauses.first()?;
    match property_of(given) {
        Some((variable, property, position))
            if variable == first.variable && first.quantifier == Quantifier::Each =>
        {
            Some((0, property.to_owned(), position))
        }
        _ => {
            let message = "a hypothesis is a property of the object of the rule's first `each`";
            let help = format!("as in `hypothesis {}.reachable`", first.variable);
            problems.push(file.error(Code::Hypothesis, given.start_position(), message).help(help));
            None
        }
    }
}

fn clauses(item: &Item) -> Vec<Clause> {
    let mut clauses: Vec<Clause> = vec![];
    let mut number = None;
    for (slot, input) in &item.inputs {
        match (slot, input) {
            (Slot::Variable(quantifier), Expr::Variable(variable, _, position)) => {
                let mut clause = Clause::new(*quantifier, variable.1.to_string(), *position);
                clause.number = number.take();
                clauses.push(clause);
            }
            (Slot::Number, Expr::Variable(name, _, position)) => {
                number = Some((name.1.to_string(), *position));
            }
            (Slot::Class, Expr::Variable(class, _, position)) => {
                if let Some(clause) = clauses.last_mut() {
                    clause.class = class.1.to_string();
                    clause.class_position = *position;
                }
            }
            (slot, expr) => {
                let Some(clause) = clauses.last_mut() else { continue };
                match slot {
                    Slot::By => clause.by = Some((*expr).clone()),
                    Slot::Where => clause.condition = Some((*expr).clone()),
                    Slot::Have => clause.have = Some((*expr).clone()),
                    _ => {}
                }
            }
        }
    }
    clauses
}

fn action(
    item: &Item,
    clauses: &[Clause],
    file: &FileScope,
    problems: &mut Vec<Diagnostic>,
) -> Option<Action> {
    let block = |wanted: Slot| {
        item.inputs.iter().find_map(|(slot, input)| match input {
            Expr::Stmt(block) if *slot == wanted => Some(block.clone()),
            _ => None,
        })
    };
    if item.word() == Word::Table {
        return table(item, clauses, file, problems);
    }
    if let Some(then) = block(Slot::Then) {
        if item.word() == Word::On {
            return Some(reaction(*then, clauses));
        }
        return Some(Action::Conclude { then, otherwise: block(Slot::Else) });
    }
    if item.input(Slot::Hypothesis).is_some() {
        return Some(Action::Conclude { then: Box::new(StmtBlock::NONE), otherwise: None });
    }
    let target = item.input(Slot::Target)?;
    let Some((index, property, position)) = property_of(target).and_then(|(variable, property, position)| {
        let index =
            clauses.iter().position(|clause| clause.quantifier.binds() && clause.variable == variable)?;
        Some((index, property.to_owned(), position))
    }) else {
        let message = "a revision sets one property of one of its variables, as in `set door.hardness`";
        problems.push(file.error(Code::Assignment, target.start_position(), message));
        return None;
    };
    let operator = match item.input(Slot::Operator)? {
        Expr::StringConstant(sign, _) => match sign.as_str() {
            "*" => Operator::Times,
            "+" => Operator::Plus,
            _ => Operator::Minus,
        },
        Expr::Variable(name, ..) if name.1.as_str() == "max" => Operator::Max,
        _ => Operator::Min,
    };
    let level = match item.input(Slot::Level) {
        Some(Expr::IntegerConstant(level, _)) => *level,
        _ => 0,
    };
    Some(Action::Revise {
        target: (index, property),
        operator,
        amount: item.input(Slot::Amount)?.clone(),
        level,
        position,
    })
}
