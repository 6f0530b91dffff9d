//! What classes and properties there are, before there are objects.

use std::collections::BTreeMap;

use crate::value::{Type, Value};

/// The classes that rules may name, with the types of their properties; for tests also their keys and what NULL means.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Schema {
    classes: BTreeMap<String, BTreeMap<String, Type>>,
    keys: BTreeMap<String, Vec<String>>,
    nulls: BTreeMap<String, BTreeMap<String, Value>>,
}

impl Schema {
    /// Adds a class, or properties to it.
    #[must_use]
    pub fn class(mut self, name: &str, properties: &[(&str, Type)]) -> Self {
        let class = self.classes.entry(name.to_owned()).or_default();
        class.extend(properties.iter().map(|&(property, kind)| (property.to_owned(), kind)));
        self
    }

    /// Says what tells the objects of a class apart.
    pub fn set_key(&mut self, class: &str, key: &[&str]) {
        self.keys.insert(class.to_owned(), key.iter().map(ToString::to_string).collect());
    }

    /// What tells the objects of a class apart, if that was said.
    pub fn key_of(&self, class: &str) -> Option<&[String]> {
        self.keys.get(class).map(Vec::as_slice)
    }

    pub fn add(&mut self, class: &str, property: &str, kind: Type) {
        self.classes.entry(class.to_owned()).or_default().insert(property.to_owned(), kind);
    }

    /// Says that `None` of a property is not unknown but this value, as [`Class::null_means`](crate::Class::null_means).
    pub fn set_null(&mut self, class: &str, property: &str, means: impl Into<Value>) {
        self.nulls.entry(class.to_owned()).or_default().insert(property.to_owned(), means.into());
    }

    /// The properties of a class whose `None` is a value, with that value, sorted.
    pub fn nulls(&self, class: &str) -> impl Iterator<Item = (&str, &Value)> {
        self.nulls.get(class).into_iter().flatten().map(|(property, means)| (property.as_str(), means))
    }

    pub fn has(&self, class: &str) -> bool {
        self.classes.contains_key(class)
    }

    pub fn kind(&self, class: &str, property: &str) -> Option<Type> {
        self.classes.get(class)?.get(property).copied()
    }

    /// The names of all classes, sorted.
    pub fn classes(&self) -> impl Iterator<Item = &str> {
        self.classes.keys().map(String::as_str)
    }

    /// The names of a class's properties, sorted.
    pub fn properties(&self, class: &str) -> impl Iterator<Item = &str> {
        self.classes.get(class).into_iter().flat_map(|properties| properties.keys().map(String::as_str))
    }
}
