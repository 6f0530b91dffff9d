//! The rules of a base with what is kept of each between inferences.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::memory::Memory;
use crate::diagnostic::Diagnostic;
use crate::plan::Plan;
use crate::plan::uses::Uses;
use crate::rule::PropertyName;
use crate::value::Type;

/// A rule as it stands between two inferences.
#[derive(Clone, Debug, Default)]
pub(super) struct Node {
    pub(super) name: String,
    pub(super) version: String,
    pub(super) needs: Vec<String>,
    pub(super) planned: Option<Planned>,
    pub(super) problems: Vec<Diagnostic>,
    /// Copies share it until one of them changes it.
    pub(super) memory: Option<Arc<Memory>>,
}

#[derive(Clone, Debug)]
pub(super) struct Planned {
    pub(super) plan: Plan,
    pub(super) uses: Uses,
    /// Of the columns that it names, and the told types of what it sets.
    pub(super) kinds: Vec<Option<Type>>,
    pub(super) interprets: bool,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Network {
    /// The rule base that it was made for.
    pub(super) base: Option<u64>,
    pub(super) nodes: Vec<Node>,
    /// Whether classes or properties came or went: then it is found out anew which rules wait.
    pub(super) recheck: bool,
    pub(super) retracted: BTreeSet<String>,
    /// Values, by property and key, of which the user has said that they are not known.
    pub(super) not_known: BTreeSet<(PropertyName, String)>,
}
