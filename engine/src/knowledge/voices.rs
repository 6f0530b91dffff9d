//! What is said of a property, object by object: by whoever told it, and by the rules that give it.

use super::KnowledgeBase;
use super::derived::{Derived, Writer};
use super::memory::Memory;
use crate::column::Column;
use crate::rule::PropertyName;
use crate::value::{Cell, Type};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    Nobody,
    Told,
    /// A rule, by number, in one of its firings. What it gives may be unknown.
    Rule {
        rule: usize,
        firing: usize,
    },
    /// Rules of one priority that disagree.
    Dispute,
}

/// A rule as far as it gives one property, by one of its variables.
#[derive(Clone, Copy)]
pub(super) struct Voice<'k> {
    pub(super) rule: usize,
    pub(super) priority: i64,
    pub(super) memory: &'k Memory,
    /// The place among what the rule gives.
    pub(super) at: usize,
    /// Whether each object is set by the firing of its own number.
    pub(super) is_own: bool,
}

impl Voice<'_> {
    /// What is said of an object, with the firings, ascending.
    pub(super) fn claims(&self, row: u32) -> impl Iterator<Item = (Cell, usize)> {
        let Self { memory, at, is_own, .. } = *self;
        let own = is_own.then_some(row);
        let others = if is_own { &[] } else { memory.firings_of(at, row) };
        let firings = own.into_iter().chain(others.iter().copied());
        firings.filter_map(move |firing| Some((memory.claim(at, firing as usize)?, firing as usize)))
    }
}

/// All that is said of a property.
pub(super) struct Voices<'k> {
    told: Option<&'k Column>,
    pub(super) rules: Vec<Voice<'k>>,
    /// Whether what rules conclude stands before what was told.
    rules_first: bool,
    hypothesis: bool,
}

impl KnowledgeBase {
    /// The rules that conclude a property, or revise it, as far as they have run.
    pub(super) fn rules_of(
        &self,
        name: &PropertyName,
        writers: impl IntoIterator<Item = Writer>,
    ) -> Vec<Voice<'_>> {
        let mut voices = Vec::new();
        for Writer { rule, priority } in writers {
            let Some(memory) = self.network.nodes[rule].memory.as_deref() else { continue };
            for (at, given) in memory.given.iter().enumerate().filter(|(_, given)| given.name == *name) {
                voices.push(Voice { rule, priority, memory, at, is_own: memory.sets_own(given) });
            }
        }
        voices
    }

    /// All that is said of a property.
    pub(super) fn voices(&self, name: &PropertyName, derived: &Derived) -> Voices<'_> {
        Voices {
            told: self.told_column(name),
            rules: self.rules_of(name, derived.writers.iter().copied()),
            rules_first: derived.rules_first,
            hypothesis: derived.hypothesis,
        }
    }
}

impl Voices<'_> {
    /// What comes of it for an object, as a value of a type, and who said so.
    pub(super) fn resolve(&self, row: u32, kind: Type) -> (Cell, Source) {
        let told = self.told.map_or(Cell::Unknown, |column| column.cell(row as usize));
        if told != Cell::Unknown && !self.rules_first {
            return (told, Source::Told);
        }
        if self.hypothesis {
            return self.proved(row);
        }
        let concluded = self.concluded(row, kind);
        if concluded.0 == Cell::Unknown && concluded.1 != Source::Dispute && told != Cell::Unknown {
            return (told, Source::Told);
        }
        concluded
    }

    fn concluded(&self, row: u32, kind: Type) -> (Cell, Source) {
        let mut chosen = (Cell::Unknown, Source::Nobody);
        let mut priority = None;
        for voice in &self.rules {
            if chosen.0 != Cell::Unknown && priority.is_some_and(|priority| voice.priority < priority) {
                break;
            }
            for (cell, firing) in voice.claims(row) {
                let source = Source::Rule { rule: voice.rule, firing };
                if cell == Cell::Unknown || cell.kind() != Some(kind) {
                    // It says nothing, but the rule did apply: that explains the gap.
                    if chosen.1 == Source::Nobody && cell == Cell::Unknown {
                        chosen.1 = source;
                    }
                } else if chosen.0 == Cell::Unknown {
                    chosen = (cell, source);
                    priority = Some(voice.priority);
                } else if chosen.0 != cell {
                    return (Cell::Unknown, Source::Dispute);
                }
            }
        }
        chosen
    }

    /// A hypothesis: true if one rule proves it, false if all refute it.
    fn proved(&self, row: u32) -> (Cell, Source) {
        let mut chosen = (Cell::Unknown, Source::Nobody);
        for voice in &self.rules {
            for (cell, firing) in voice.claims(row) {
                let source = Source::Rule { rule: voice.rule, firing };
                match (cell, chosen) {
                    (Cell::Truth(true), _) => return (cell, source),
                    (_, (_, Source::Nobody)) | (Cell::Unknown, (Cell::Truth(false), _)) => {
                        chosen = (cell, source);
                    }
                    _ => {}
                }
            }
        }
        chosen
    }
}
