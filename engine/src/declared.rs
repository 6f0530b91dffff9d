//! What rule files declare: classes by condition, links between objects, and where properties come from.

pub(crate) mod build;
pub(crate) mod check;

use std::collections::BTreeMap;
use std::sync::Arc;

use rhai::Position;

use crate::rule::{Condition, FileScope, PropertyName, Rule};

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    Table,
    Planner,
    Rule,
    /// A value where nothing before gives one; the expression as it is written.
    Default(String),
    /// The user is asked; `{...}` in the text are properties of the object.
    Ask(String),
}

#[derive(Clone, Debug, Default)]
pub struct Declarations {
    /// The order of sources of each property, by the class that the declaration names.
    pub sources: BTreeMap<PropertyName, Vec<Source>>,
    pub(crate) classes: BTreeMap<String, Subclass>,
    pub(crate) links: BTreeMap<PropertyName, Link>,
    /// By the property of the class of objects: what is declared of it, first what counts for the most special
    /// class.
    pub(crate) properties: BTreeMap<PropertyName, Vec<Declaration>>,
}

impl Declarations {
    /// The classes declared by a condition, each with the class that it is of.
    pub fn subclasses(&self) -> impl Iterator<Item = (&str, &str)> {
        self.classes.iter().map(|(name, class)| (name.as_str(), class.parent.as_str()))
    }

    /// The class of objects that a class is of in the end; itself unless it is declared by a condition.
    pub fn root<'c>(&'c self, class: &'c str) -> &'c str {
        self.classes.get(class).map_or(class, |subclass| &subclass.root)
    }

    /// Whether rules are heard before the table, as no declaration means otherwise.
    pub(crate) fn rules_first(&self, property: &PropertyName) -> bool {
        let place = |declaration: &Declaration, of: &Source| {
            declaration.sources.iter().position(|source| source == of).unwrap_or(usize::MAX)
        };
        self.properties.get(property).is_some_and(|declared| {
            declared
                .iter()
                .any(|declaration| place(declaration, &Source::Rule) < place(declaration, &Source::Table))
        })
    }

    /// The properties that may have a value though nobody tells or concludes it.
    pub(crate) fn supplied(&self) -> impl Iterator<Item = &PropertyName> {
        let supplies = |source: &Source| matches!(source, Source::Default(_) | Source::Ask(_));
        let supplied = move |declared: &[Declaration]| {
            declared.iter().any(|declaration| declaration.sources.iter().any(supplies))
        };
        self.properties.iter().filter(move |(_, declared)| supplied(declared)).map(|(name, _)| name)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Subclass {
    pub(crate) parent: String,
    pub(crate) parent_position: Position,
    pub(crate) root: String,
    pub(crate) position: Position,
    /// Its own condition last.
    pub(crate) conditions: Vec<Condition>,
    /// What rules that use it rest on.
    pub(crate) signature: String,
    pub(crate) file: Arc<FileScope>,
}

#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) class: String,
    pub(crate) class_position: Position,
    /// The property that it names the object by; the class's key if it is not given.
    pub(crate) key: Option<(String, Position)>,
    pub(crate) position: Position,
    pub(crate) signature: String,
    pub(crate) file: Arc<FileScope>,
}

/// What is declared of a property, for the objects of one class.
#[derive(Clone, Debug)]
pub(crate) struct Declaration {
    pub(crate) class: String,
    pub(crate) class_position: Position,
    pub(crate) position: Position,
    pub(crate) sources: Vec<Source>,
    /// A rule over the objects of the class, whose action is the default. Its plan has one clause with the
    /// class's condition, and [`Effect::Default`](crate::plan::Effect::Default).
    pub(crate) rule: Rule,
}
