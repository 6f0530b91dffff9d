//! What is known of classes and properties before objects are looked at.

use crate::rule::PropertyName;
use crate::value::Type;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Missing,
    /// It holds this type; `None` is a type that only running tells.
    Holds(Option<Type>),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Key {
    /// Only objects will tell.
    Unsaid,
    Properties(Vec<String>),
}

pub(crate) trait Kinds {
    fn kind(&self, property: &PropertyName) -> Kind;
    /// The type that a property was declared with, whatever rules conclude of it.
    fn declared(&self, property: &PropertyName) -> Option<Type>;
    fn key(&self, class: &str) -> Key;
    /// Names to suggest for a misspelt one.
    fn properties(&self, class: &str) -> Vec<String>;
}
