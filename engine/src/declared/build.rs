//! From the declarations of all files to one picture of them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rhai::{ASTNode, Expr, Position};

use super::{Declaration, Declarations, Link, Source, Subclass};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, Condition, FileScope, PropertyName, Rule};
use crate::script::resolve::resolve;
use crate::script::syntax::Quantifier;
use crate::suggest::nearest;

/// `class NAME of PARENT where CONDITION`
#[derive(Debug)]
pub(crate) struct ClassItem {
    pub(crate) name: String,
    pub(crate) position: Position,
    pub(crate) parent: String,
    pub(crate) parent_position: Position,
    pub(crate) condition: Expr,
    pub(crate) text: String,
    pub(crate) file: Arc<FileScope>,
}

/// `property CLASS.NAME names ... from ...`
#[derive(Debug)]
pub(crate) struct PropertyItem {
    pub(crate) class: String,
    pub(crate) class_position: Position,
    pub(crate) property: String,
    pub(crate) position: Position,
    pub(crate) link: Option<Link>,
    pub(crate) sources: Vec<Source>,
    pub(crate) default: Option<Expr>,
    pub(crate) file: Arc<FileScope>,
}

pub(crate) fn declarations(
    classes: Vec<ClassItem>,
    properties: Vec<PropertyItem>,
    known: &BTreeSet<String>,
    problems: &mut Vec<Diagnostic>,
) -> Declarations {
    let mut declared = Declarations::default();
    self::classes(classes, known, &mut declared, problems);
    for item in properties {
        property(item, known, &mut declared, problems);
    }
    let depth = |classes: &BTreeMap<String, Subclass>, class: &str| {
        classes.get(class).map_or(0, |subclass| subclass.conditions.len())
    };
    for declarations in declared.properties.values_mut() {
        // Stable: of two classes neither of which is of the other, the first declared counts.
        declarations
            .sort_by_key(|declaration| std::cmp::Reverse(depth(&declared.classes, &declaration.class)));
    }
    declared
}

fn classes(
    items: Vec<ClassItem>,
    known: &BTreeSet<String>,
    declared: &mut Declarations,
    problems: &mut Vec<Diagnostic>,
) {
    let mut named: BTreeMap<String, ClassItem> = BTreeMap::new();
    for item in items {
        let place = item.file.source.place(item.position);
        if let Some(first) = named.get(&item.name) {
            let message = format!("two classes are called {}", item.name);
            let line = first.file.source.place(first.position).line;
            let problem = Diagnostic::error(Code::DuplicateName, &place, message);
            let help = format!("the first is in {}, line {line}", first.file.source.name());
            problems.push(problem.label("the second").help(help));
            continue;
        }
        problems.extend(complaints(&item.condition, &item.file, known));
        named.insert(item.name.clone(), item);
    }
    for item in named.values() {
        let mut chain = vec![item];
        while let Some(parent) = chain.last().and_then(|last| named.get(&last.parent)) {
            if chain.iter().any(|class| class.name == parent.name) {
                let names: Vec<&str> = chain.iter().map(|class| class.name.as_str()).collect();
                let message = format!(
                    "these classes are made of each other: {} -> {}",
                    names.join(" -> "),
                    parent.name
                );
                // Said once, of the first of them.
                if parent.name == item.name && names.iter().all(|name| **name >= *item.name) {
                    problems.push(item.file.error(Code::Cycle, item.position, message));
                }
                break;
            }
            chain.push(parent);
        }
        let Some(last) = chain.last() else { continue };
        let conditions = chain
            .iter()
            .rev()
            .map(|class| Condition { expr: class.condition.clone(), file: Arc::clone(&class.file) });
        let subclass = Subclass {
            parent: item.parent.clone(),
            parent_position: item.parent_position,
            root: last.parent.clone(),
            position: item.position,
            conditions: conditions.collect(),
            signature: chain.iter().map(|class| class.text.as_str()).collect(),
            file: Arc::clone(&item.file),
        };
        declared.classes.insert(item.name.clone(), subclass);
    }
}

fn property(
    item: PropertyItem,
    known: &BTreeSet<String>,
    declared: &mut Declarations,
    problems: &mut Vec<Diagnostic>,
) {
    let written = PropertyName::new(&item.class, &item.property);
    let name = PropertyName::new(declared.root(&item.class), &item.property);
    let place = item.file.source.place(item.position);
    let twice = |what: &str| {
        Diagnostic::error(
            Code::DuplicateName,
            &place,
            format!("{what} of {written} {} declared twice", if what.ends_with('s') { "are" } else { "is" }),
        )
    };
    if let Some(link) = item.link {
        if declared.classes.contains_key(&link.class) {
            let message = format!(
                "a link leads to a class of objects, and {} is a part of one, by a condition",
                link.class
            );
            let root = declared.root(&link.class).to_owned();
            problems.push(
                link.file.error(Code::Declaration, link.class_position, message).did_you_mean(Some(&root)),
            );
        } else if declared.links.insert(name.clone(), link).is_some() {
            problems.push(twice("the link"));
        }
    }
    if item.sources.is_empty() {
        return;
    }
    if declared.sources.insert(written.clone(), item.sources.clone()).is_some() {
        problems.push(twice("the sources"));
        return;
    }
    if let Some(default) = &item.default {
        problems.extend(complaints(default, &item.file, known));
    }
    let mut rule = object_rule(&item.class, item.class_position, declared, &item.file);
    rule.name = format!("property {written}");
    rule.position = item.position;
    rule.line = place.line;
    rule.action = Action::Default { property: item.property, value: item.default, position: item.position };
    resolve(&mut rule, known, &mut vec![]);
    let declaration = Declaration {
        class: item.class,
        class_position: item.class_position,
        position: item.position,
        sources: item.sources,
        rule,
    };
    declared.properties.entry(name).or_default().push(declaration);
}

/// A rule over the objects of a class that does nothing yet.
pub(super) fn object_rule(
    class: &str,
    position: Position,
    declared: &Declarations,
    file: &Arc<FileScope>,
) -> Rule {
    let mut clause = Clause::new(Quantifier::Each, "object".to_owned(), position);
    clause.class_position = position;
    declared.root(class).clone_into(&mut clause.class);
    if let Some(subclass) = declared.classes.get(class) {
        clause.conditions.clone_from(&subclass.conditions);
    }
    let action = Action::Default { property: String::new(), value: None, position };
    Rule::new(format!("class {class}"), position, vec![clause], action, file)
}

/// A condition or default speaks of the object's own properties by their bare names.
fn complaints(expr: &Expr, file: &FileScope, known: &BTreeSet<String>) -> Vec<Diagnostic> {
    let mut problems = vec![];
    let complain = |code, position, message: String| file.error(code, position, message);
    expr.walk(&mut vec![], &mut |path| {
        match path.last() {
            Some(ASTNode::Expr(Expr::Dot(dot, ..))) => {
                if let (Expr::Variable(of, _, position), Expr::Property(property, _)) = (&dot.lhs, &dot.rhs) {
                    let property = &property.2;
                    let message = "here only the object's own properties may stand, by their bare names";
                    let problem = complain(Code::Declaration, *position, message.to_owned());
                    problems.push(problem.help(format!("`{property}` instead of `{}.{property}`?", of.1)));
                }
            }
            Some(ASTNode::Expr(Expr::FnCall(call, position))) if !call.is_operator_call() => {
                let own = file.function_names.contains(&(call.name.to_string(), call.args.len()));
                if !own && !known.contains(call.name.as_str()) {
                    let names = file.function_names.iter().map(|(name, _)| name).chain(known);
                    let problem = complain(
                        Code::UnknownFunction,
                        *position,
                        format!("there is no function `{}`", call.name),
                    );
                    problems.push(problem.did_you_mean(nearest(&call.name, names.map(String::as_str))));
                }
            }
            Some(ASTNode::Expr(Expr::Custom(_, position))) => {
                problems.push(complain(
                    Code::Syntax,
                    *position,
                    "a declaration cannot stand inside another".to_owned(),
                ));
            }
            _ => {}
        }
        true
    });
    problems
}

pub(crate) fn against_rules(declared: &Declarations, rules: &[Rule]) -> Vec<Diagnostic> {
    let mut problems = vec![];
    for rule in rules {
        if !matches!(rule.action, Action::Conclude { .. } | Action::Table(_)) {
            continue;
        }
        for (name, position) in &rule.sets {
            let Some(declarations) = declared.properties.get(name) else { continue };
            if declarations.iter().any(|declaration| declaration.sources.contains(&Source::Rule)) {
                continue;
            }
            let message = format!("{name} is declared to come from elsewhere, not from a rule");
            let help = "add `rule` to its sources where it should be heard";
            problems.push(rule.file.error(Code::Declaration, *position, message).help(help));
        }
    }
    let concluded: BTreeSet<&PropertyName> = rules.iter().flat_map(|rule| rule.sets.keys()).collect();
    let supplied: BTreeSet<&PropertyName> = declared.supplied().collect();
    for declaration in declared.properties.values().flatten() {
        let Action::Default { value: Some(_), .. } = declaration.rule.action else { continue };
        let derived = |name: &&PropertyName| concluded.contains(name) || supplied.contains(name);
        let Some(derived) = declaration.rule.reads.keys().find(derived) else { continue };
        let how = if concluded.contains(derived) { "rules conclude" } else { "has a default itself" };
        let message = format!("this default depends on {derived}, which {how}");
        let help = "a default and the condition of its class may look at told properties only; a `rule` with a low \
                    priority may look at all";
        problems
            .push(declaration.rule.file.error(Code::Declaration, declaration.position, message).help(help));
    }
    problems
}
