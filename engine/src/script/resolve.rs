//! Finds what the names of a rule mean.

use std::collections::BTreeSet;
use std::sync::Arc;

use rhai::{Expr, Position};

use super::names::{Names, Patterns, Use};
use super::reaction;
use super::syntax::Quantifier;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, FileScope, PropertyName, Rule};
use crate::suggest::nearest;

/// Most clauses of a rule: sets of variables are the bits of a word.
const MAX_CLAUSES: usize = 32;

/// Finds what the rule reads and sets, reports names that mean nothing, and tells whether the rule uses
/// constants or functions of its file.
pub(crate) fn resolve(rule: &mut Rule, known: &BTreeSet<String>, problems: &mut Vec<Diagnostic>) -> bool {
    let file = Arc::clone(&rule.file);
    let variables: Vec<String> = rule.clauses.iter().map(|clause| clause.variable.clone()).collect();
    problems.extend(clause_complaints(rule, &variables));
    let mut names = names(rule, &variables);
    problems.extend(hypothesis(rule, &mut names));
    let place = |(index, property): &Use| PropertyName::new(&rule.clauses[*index].class, property);
    let reads = names.reads.iter().map(|(used, position)| (place(used), *position)).collect();
    let sets = names.sets.iter().map(|(used, position)| (place(used), *position)).collect();
    (rule.reads, rule.sets) = (reads, sets);
    if let Action::React(reaction) = &mut rule.action {
        reaction.reads = names.reads.keys().cloned().collect();
        // What it tells are facts; nothing is concluded.
        rule.sets.clear();
    }
    if !names.nested.is_empty() {
        let inside = |position: &Position| {
            complaint(rule, Code::Syntax, *position, "a rule cannot stand inside another".to_owned())
        };
        problems.extend(names.nested.iter().map(inside));
        return false;
    }
    problems.extend(unused(rule, &names));
    problems.extend(variable_complaints(rule, &variables, &names));
    problems.extend(use_complaints(rule, &names));
    problems.extend(reaction::forget_complaints(rule));
    problems.extend(call_complaints(rule, &names, known));
    names.free.iter().any(|(name, _)| file.constants.contains_key(name))
        || names.calls.iter().any(|(name, count, _)| file.function_names.contains(&(name.clone(), *count)))
}

/// All names in a rule's parts, each with the variables that it may speak of.
fn names(rule: &Rule, variables: &[String]) -> Names {
    let mut names = Names::default();
    // A variable that is not in scope has no name.
    let mut scope: Vec<String> = vec![];
    for (index, clause) in rule.clauses.iter().enumerate() {
        scope.push(variables[index].clone());
        let patterns = Patterns(&scope);
        if let Some(by) = &clause.by {
            let mut of_object = Names::default();
            of_object.expression(by, &patterns, Some(index));
            of_object.reads.retain(|(_, property), place| {
                let number = number_named(rule, index, property);
                if number {
                    names.numbers.insert(property.clone(), *place);
                }
                !number && !rule.file.constants.contains_key(property)
            });
            merge(&mut names, of_object);
        }
        of_class(&mut names, clause, index);
        for condition in clause.condition.iter().chain(&clause.have) {
            names.expression(condition, &patterns, None);
        }
        numbers(rule, index, &mut names);
        if !clause.quantifier.binds() {
            scope[index].clear();
        }
    }
    let patterns = Patterns(&scope);
    match &rule.action {
        Action::Conclude { then, otherwise } => {
            names.block(then, &patterns);
            if let Some(block) = otherwise {
                names.block(block, &patterns);
            }
        }
        Action::React(reaction) => names.block(&reaction.body, &patterns),
        Action::Revise { target, amount, position, .. } => {
            names.expression(amount, &patterns, None);
            names.sets.insert(target.clone(), *position);
        }
        Action::Table(table) => {
            let outputs = table.rows.iter().flat_map(|row| &row.outputs);
            for expr in table.given.iter().map(|(input, _)| input).chain(outputs) {
                names.expression(expr, &patterns, None);
            }
            for (clause, property, position) in &table.set {
                names.sets.insert((*clause, property.clone()), *position);
            }
        }
        Action::Default { value, .. } => {
            if let Some(value) = value {
                merge(&mut names, of_object(value, 0, &rule.file));
            }
        }
    }
    numbers(rule, rule.clauses.len(), &mut names);
    names
}

/// The names of an expression in which the properties of a clause's object stand bare.
fn of_object(expr: &Expr, clause: usize, file: &FileScope) -> Names {
    let mut names = Names::default();
    names.expression(expr, &Patterns(&[]), Some(clause));
    names.reads.retain(|(_, property), _| !file.constants.contains_key(property));
    names
}

/// What is read to find the object, and to see that it is of the class that the rule names.
fn of_class(names: &mut Names, clause: &Clause, index: usize) {
    for condition in &clause.conditions {
        for (used, _) in of_object(&condition.expr, index, &condition.file).reads {
            names.reads.entry(used).or_insert(clause.class_position);
        }
    }
    if let Some(link) = &clause.link {
        names.reads.entry((link.clause, link.property.clone())).or_insert(link.position);
        if let Some(key) = &link.key {
            names.reads.entry((index, key.clone())).or_insert(link.position);
        }
    }
}

/// Variables and numbers that are bound and never looked at.
fn unused(rule: &Rule, names: &Names) -> Vec<Diagnostic> {
    let used = |index: usize, clause: &Clause| {
        let properties = || names.reads.keys().chain(names.sets.keys());
        properties().any(|(of, _)| *of == index)
            || names.whole.iter().any(|(name, _)| *name == clause.variable)
    };
    let mut found = vec![];
    for (index, clause) in rule.clauses.iter().enumerate() {
        let (name, position) = match &clause.number {
            Some((number, position)) if !names.numbers.contains_key(number) => (number, *position),
            // That there is one may be all that counts: for `some`, and for rules that react.
            None if clause.quantifier.binds()
                && clause.quantifier != Quantifier::Some
                && clause.link.is_none()
                && !rule.reacts()
                && !used(index, clause) =>
            {
                (&clause.variable, clause.position)
            }
            _ => continue,
        };
        let message = format!("`{name}` is never used in this rule");
        found.push(complaint(rule, Code::Unused, position, message).warning());
    }
    found
}

/// A hypothesis is set too, and by nothing else in its rule.
fn hypothesis(rule: &Rule, names: &mut Names) -> Option<Diagnostic> {
    let (clause, property, position) = rule.hypothesis.as_ref()?;
    let twice = names.sets.insert((*clause, property.clone()), *position)?;
    let message = format!("the hypothesis `{property}` cannot be set by the action too");
    Some(complaint(rule, Code::Hypothesis, twice, message))
}

/// Whether one of the first clauses gives a number of this name.
fn number_named(rule: &Rule, clauses: usize, name: &str) -> bool {
    let named = |clause: &Clause| clause.number.as_ref().is_some_and(|(number, _)| number == name);
    rule.clauses[..clauses].iter().any(named)
}

/// Takes the numbers that the first clauses give from the free names.
fn numbers(rule: &Rule, clauses: usize, names: &mut Names) {
    let (given, free) =
        std::mem::take(&mut names.free).into_iter().partition(|(name, _)| number_named(rule, clauses, name));
    names.free = free;
    names.numbers.extend::<Vec<_>>(given);
}

fn merge(into: &mut Names, from: Names) {
    for (used, position) in from.reads {
        into.reads.entry(used).or_insert(position);
    }
    into.free.extend(from.free);
    into.whole.extend(from.whole);
    into.calls.extend(from.calls);
    into.nested.extend(from.nested);
}

fn complaint(rule: &Rule, code: Code, position: Position, message: String) -> Diagnostic {
    rule.file.error(code, position, message)
}

fn clause_complaints(rule: &Rule, variables: &[String]) -> Vec<Diagnostic> {
    let mut problems = vec![];
    for (index, clause) in rule.clauses.iter().enumerate() {
        let numbers = || rule.clauses[..index].iter().filter_map(|clause| clause.number.as_ref());
        let bound = |clause: &Clause, name: &String| clause.quantifier.binds() && clause.variable == *name;
        let taken = |name: &String| {
            rule.clauses[..index].iter().any(|clause| bound(clause, name))
                || numbers().any(|(number, _)| number == name)
        };
        let own = clause.number.as_ref().filter(|(number, _)| taken(number) || *number == clause.variable);
        let twice = own
            .or(Some(&(clause.variable.clone(), clause.position)).filter(|(name, _)| taken(name)))
            .cloned();
        if let Some((name, position)) = twice {
            let message = format!("the variable `{name}` is bound twice");
            problems.push(complaint(rule, Code::Syntax, position, message));
        }
    }
    if variables.len() > MAX_CLAUSES {
        let message = format!("a rule has at most {MAX_CLAUSES} clauses");
        problems.push(complaint(rule, Code::Syntax, rule.position, message));
    }
    problems
}

fn variable_complaints(rule: &Rule, variables: &[String], names: &Names) -> Vec<Diagnostic> {
    let constants = &rule.file.constants;
    let unbound = |name: &str| {
        let clause = rule.clauses.iter().find(|clause| clause.variable == *name)?;
        match clause.quantifier {
            Quantifier::None => Some(format!("`none {name}` binds nothing: there is no such object")),
            Quantifier::All => Some(format!("`all {name}` binds nothing: it speaks of all of them")),
            Quantifier::Count | Quantifier::Sum => {
                let (number, _) = clause.number.as_ref()?;
                let word = clause.quantifier.word();
                Some(format!("`{word} {number} of {name}` gives the number `{number}`, not an object"))
            }
            _ => None,
        }
    };
    let mut problems = vec![];
    for (name, position) in names.free.iter().filter(|(name, _)| !constants.contains_key(name)) {
        let numbers = rule.clauses.iter().filter_map(|clause| clause.number.as_ref()).map(|(name, _)| name);
        let candidates = variables.iter().chain(numbers).chain(constants.keys()).map(String::as_str);
        let message = format!("nothing here is called `{name}`");
        let problem = complaint(rule, Code::UnknownVariable, *position, message);
        problems.push(match unbound(name) {
            Some(help) => problem.help(help),
            None => problem.did_you_mean(nearest(name, candidates)),
        });
    }
    problems
}

fn use_complaints(rule: &Rule, names: &Names) -> Vec<Diagnostic> {
    let mut problems = vec![];
    for (name, position) in &names.whole {
        let message = format!("`{name}` is an object; name one of its properties, as in `{name}.width`");
        problems.push(complaint(rule, Code::Type, *position, message));
    }
    let concludes = !matches!(rule.action, Action::React(_));
    for (name, position) in names.updates.iter().filter(|_| concludes) {
        let message = format!("`{name}` is concluded once, with `=`");
        let problem = complaint(rule, Code::Assignment, *position, message);
        problems.push(problem.help("a `revise` changes what others concluded"));
    }
    for position in &names.misplaced {
        let message = "only a property of an object can be set, as in `door.hardness = 1.0`".to_owned();
        problems.push(complaint(rule, Code::Assignment, *position, message));
    }
    problems
}

fn call_complaints(rule: &Rule, names: &Names, known: &BTreeSet<String>) -> Vec<Diagnostic> {
    let own = &rule.file.function_names;
    let mut problems = vec![];
    if matches!(rule.action, Action::React(_)) {
        problems.extend(reaction::taken_names(&rule.file, rule.position));
    }
    for (name, count, position) in &names.calls {
        if own.contains(&(name.clone(), *count)) || known.contains(name) {
            continue;
        }
        if reaction::is_own(name) {
            problems.extend(reaction::call_complaint(rule, (name, *count, *position)));
            continue;
        }
        let candidates = own.iter().map(|(name, _)| name).chain(known).map(String::as_str);
        let message = format!("there is no function `{name}`");
        let problem = complaint(rule, Code::UnknownFunction, *position, message);
        problems.push(problem.did_you_mean(nearest(name, candidates)));
    }
    problems
}
