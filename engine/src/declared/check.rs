//! Declarations against the classes that there are.

use rhai::Position;

use super::build::object_rule;
use super::{Declarations, Source};
use crate::diagnostic::{Code, Diagnostic};
use crate::plan::{Effect, Kind, Kinds, plan};
use crate::rule::{FileScope, PropertyName};
use crate::schema::Schema;
use crate::symbols::Lexicon;
use crate::value::Type;

pub(crate) fn check(
    declared: &Declarations,
    schema: &Schema,
    kinds: &dyn Kinds,
) -> (Vec<(PropertyName, Type)>, Vec<Diagnostic>) {
    let symbols = Lexicon::default();
    let (mut types, mut problems) = (vec![], vec![]);
    for (name, class) in &declared.classes {
        if schema.has(name) {
            let message = format!("there is a class {name} already");
            problems.push(class.file.error(Code::DuplicateName, class.position, message));
        }
        if !schema.has(&class.root) {
            // Said where the missing class is named.
            if class.root == class.parent {
                problems.push(unknown_class(
                    &class.parent,
                    class.parent_position,
                    &class.file,
                    declared,
                    schema,
                ));
            }
            continue;
        }
        let mut rule = object_rule(name, class.position, declared, &class.file);
        // Said of the class whose condition it is, not of those under it.
        if let Some(clause) = rule.clauses.first_mut() {
            clause.conditions.drain(..clause.conditions.len().saturating_sub(1));
        }
        problems.extend(plan(&rule, kinds, &symbols).err().into_iter().flatten());
    }
    for (name, declarations) in &declared.properties {
        for declaration in declarations {
            let file = &declaration.rule.file;
            if !schema.has(&name.class) {
                if name.class == declaration.class {
                    problems.push(unknown_class(
                        &name.class,
                        declaration.class_position,
                        file,
                        declared,
                        schema,
                    ));
                }
                continue;
            }
            problems.extend(unknown_property(name, declaration.position, file, kinds));
            problems.extend(questions(declaration, name, kinds));
            let mut rule = declaration.rule.clone();
            rule.clauses.iter_mut().for_each(|clause| clause.conditions.clear());
            match plan(&rule, kinds, &symbols) {
                Ok(plan) => {
                    if let Effect::Default { kind: Some(kind), .. } = plan.effect {
                        types.push((name.clone(), kind));
                    }
                }
                Err(wrong) => problems.extend(wrong),
            }
        }
    }
    for (name, link) in &declared.links {
        if schema.has(&name.class) {
            problems.extend(unknown_property(name, link.position, &link.file, kinds));
        }
        if !schema.has(&link.class) {
            problems.push(unknown_class(&link.class, link.class_position, &link.file, declared, schema));
        } else if let Some((key, position)) = &link.key {
            let key = PropertyName::new(&link.class, key);
            problems.extend(unknown_property(&key, *position, &link.file, kinds));
        }
    }
    (types, problems)
}

fn questions(declaration: &super::Declaration, name: &PropertyName, kinds: &dyn Kinds) -> Vec<Diagnostic> {
    let asked = declaration.sources.iter().filter_map(|source| match source {
        Source::Ask(text) => Some(text),
        _ => None,
    });
    asked
        .flat_map(|text| text.split('{').skip(1).filter_map(|part| part.split_once('}')))
        .map(|(property, _)| PropertyName::new(&name.class, property.trim()))
        .filter_map(|property| {
            unknown_property(&property, declaration.position, &declaration.rule.file, kinds)
        })
        .collect()
}

fn unknown_class(
    class: &str,
    position: Position,
    file: &FileScope,
    declared: &Declarations,
    schema: &Schema,
) -> Diagnostic {
    let names = schema.classes().chain(declared.classes.keys().map(String::as_str));
    file.unknown_class(position, class, names)
}

fn unknown_property(
    name: &PropertyName,
    position: Position,
    file: &FileScope,
    kinds: &dyn Kinds,
) -> Option<Diagnostic> {
    if kinds.kind(name) != Kind::Missing {
        return None;
    }
    let there = kinds.properties(&name.class);
    Some(file.unknown_property(position, name, there.iter().map(String::as_str)))
}
