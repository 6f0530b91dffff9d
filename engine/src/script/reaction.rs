//! The action of an `on` rule: what it tells, as far as that can be seen without running it.

use std::collections::BTreeSet;

use rhai::{AST, ASTNode, Expr, FnCallExpr, Module, Position, Shared, Stmt, StmtBlock};

use super::names::{property_of, walk};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, FileScope, Reaction, Rule, Setting, Telling};
use crate::suggest::nearest;

pub(super) fn reaction(body: StmtBlock, clauses: &[Clause]) -> Action {
    let (mut tells, mut sets) = (vec![], vec![]);
    walk(&body, &mut |path| match path.last() {
        Some(ASTNode::Stmt(Stmt::Assignment(assignment))) => {
            let sides = &assignment.1;
            if let Some((variable, property, position)) = property_of(&sides.lhs)
                && let Some(variable) =
                    clauses.iter().position(|clause| clause.quantifier.binds() && clause.variable == variable)
            {
                let value = (!assignment.0.is_op_assignment()).then(|| lasting(&sides.rhs).clone());
                sets.push(Setting { variable, property: property.to_owned(), position, value });
            }
        }
        _ => tells.extend(call(path).and_then(telling)),
    });
    Action::React(Box::new(Reaction { body, reads: BTreeSet::new(), tells, sets }))
}

/// The value of `lasting(value, seconds)`; anything else is the value itself.
fn lasting(value: &Expr) -> &Expr {
    match value {
        Expr::FnCall(call, _) if call.name == "lasting" && call.args.len() == 2 => &call.args[0],
        value => value,
    }
}

pub(super) fn told_by_functions(functions: &Shared<Module>) -> Vec<Telling> {
    let mut tells = vec![];
    AST::new(Vec::<Stmt>::new(), Shared::clone(functions)).walk(&mut |path| {
        tells.extend(call(path).and_then(telling));
        true
    });
    tells
}

fn call<'a>(path: &[ASTNode<'a>]) -> Option<&'a FnCallExpr> {
    match path.last() {
        Some(ASTNode::Stmt(Stmt::FnCall(call, _)) | ASTNode::Expr(Expr::FnCall(call, _))) => Some(call),
        _ => None,
    }
}

fn telling(call: &FnCallExpr) -> Option<Telling> {
    let (Expr::StringConstant(class, position), rest) = call.args.split_first()? else { return None };
    if call.name != "tell" {
        return None;
    }
    let properties = match rest {
        [Expr::Map(map, _)] => {
            map.0.iter().map(|(name, value)| (name.name.to_string(), name.pos, value.clone())).collect()
        }
        _ => vec![],
    };
    Some(Telling { class: class.to_string(), position: *position, properties })
}

/// What is wrong with a call of `tell`, `forget` or `lasting`: the rule only concludes, or the number of arguments.
pub(super) fn call_complaint(
    rule: &Rule,
    (name, arguments, position): (&str, usize, Position),
) -> Option<Diagnostic> {
    let place = || rule.file.source.place(position);
    if !matches!(rule.action, Action::React(_)) {
        let message = format!("`{name}` belongs to `on`: rules conclude, and `on` tells");
        let help = "a rule sets a property, as in `door.closed = true`, and takes it back by itself";
        return Some(Diagnostic::error(Code::Assignment, &place(), message).help(help));
    }
    let (wanted, what) = match name {
        "tell" => (2, "a class and what the new object is like, as in `tell(\"CLOSURES\", #{ door: 3 })`"),
        "lasting" => {
            (2, "a value and for how many seconds it holds, as in `door.closed = lasting(true, 3600)`")
        }
        _ => (1, "one object, as in `forget(report)`"),
    };
    let message = || format!("`{name}` takes {what}");
    (arguments != wanted).then(|| Diagnostic::error(Code::Syntax, &place(), message()))
}

pub(super) fn is_own(name: &str) -> bool {
    matches!(name, "tell" | "forget" | "lasting")
}

/// What is wrong with the objects that are forgotten: only what a clause binds can be.
pub(super) fn forget_complaints(rule: &Rule) -> Vec<Diagnostic> {
    let Action::React(reaction) = &rule.action else { return vec![] };
    let mut problems = vec![];
    let mut look = |call: &FnCallExpr| {
        if call.name != "forget" || call.args.len() != 1 {
            return;
        }
        let object = &call.args[0];
        let message = "`forget` takes one of the rule's objects by its variable, as in `forget(report)`";
        let problem = rule.file.error(Code::Assignment, object.start_position(), message);
        let Expr::Variable(variable, ..) = object else { return problems.push(problem) };
        let name = variable.1.as_str();
        let bound = || rule.clauses.iter().filter(|clause| clause.quantifier.binds());
        if bound().all(|clause| clause.variable != name) {
            let variables = bound().map(|clause| clause.variable.as_str());
            let unbound = rule.clauses.iter().find(|clause| clause.variable == name);
            problems.push(match unbound {
                Some(clause) => {
                    problem.help(format!("`{} {name}` binds no object", clause.quantifier.word()))
                }
                None => problem.did_you_mean(nearest(name, variables)),
            });
        }
    };
    walk(&reaction.body, &mut |path| call(path).into_iter().for_each(&mut look));
    problems
}

/// `tell`, `forget` and `lasting` are the engine's own.
pub(super) fn taken_names(file: &FileScope, position: Position) -> Option<Diagnostic> {
    let taken = file.function_names.iter().find(|(name, _)| is_own(name))?;
    let message = format!("this file has a function `{}` of its own, which hides the engine's", taken.0);
    Some(file.error(Code::DuplicateName, position, message).help("rename it"))
}
