//! The rule bases of worlds, and what their rules may speak of.

use std::path::Path;
use std::sync::Arc;

use adit_engine::{Consultation, Datum, RuleBase, Schema, Severity, Type};

use crate::adapt::{CELL_CHANGES, EDGES, LANDMARKS, OF_CELL_CHANGES, OF_EDGES, OF_LANDMARKS};
use crate::error::{Error, Result};
use crate::navigation::guide::{OF_OPENINGS, OPENINGS};
use crate::navigation::judge::{OF_SEGMENTS, OF_SITUATIONS, OF_WAYS, SEGMENTS, SITUATIONS, WAYS};
use crate::site::lint;
use crate::site::rules::{self, Rules};

/// What a rule base is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Parts and corridors: the paper's tables as they are meant, and as they are printed.
    Channels,
    /// Robots on floor plans.
    Navigation,
    /// Robots that learn in cells.
    Adapt,
}

impl Kind {
    /// The shipped rule bases, the one that counts by default first.
    pub const fn shipped(self) -> &'static [&'static str] {
        match self {
            Self::Channels => &["corrected", "printed"],
            Self::Navigation => &["navigation"],
            Self::Adapt => &["adapt"],
        }
    }

    /// What is asked of the rules.
    fn asked(self) -> Vec<String> {
        let asked: &[(&str, &[&str])] = match self {
            Self::Channels => &[
                ("STEPS", &super::steps::OUTPUTS),
                ("TURNS", &super::turns::OUTPUTS),
                ("PASSAGES", &super::turns::WEIGHED),
            ],
            Self::Navigation => &[
                ("SITUATIONS", &OF_SITUATIONS),
                ("SEGMENTS", &OF_SEGMENTS),
                ("WAYS", &OF_WAYS),
                ("OPENINGS", &OF_OPENINGS),
            ],
            Self::Adapt => {
                &[("CELL_CHANGES", &OF_CELL_CHANGES), ("LANDMARKS", &OF_LANDMARKS), ("EDGES", &OF_EDGES)]
            }
        };
        let named = |(class, properties): &(&str, &[&str])| -> Vec<String> {
            properties.iter().map(|property| format!("{class}.{property}")).collect()
        };
        asked.iter().flat_map(named).collect()
    }

    fn folder(self, name: &str) -> String {
        match self {
            Self::Channels => format!("channels/{name}"),
            Self::Navigation | Self::Adapt => name.to_owned(),
        }
    }

    /// The classes and properties that rules may name.
    pub fn schema(self) -> Schema {
        match self {
            Self::Channels => {
                Schema::default().class("STEPS", STEPS).class("TURNS", TURNS).class("PASSAGES", PASSAGES)
            }
            Self::Navigation => Schema::default()
                .class("SITUATIONS", SITUATIONS)
                .class("SEGMENTS", SEGMENTS)
                .class("WAYS", WAYS)
                .class("OPENINGS", OPENINGS),
            Self::Adapt => Schema::default()
                .class("CELL_CHANGES", CELL_CHANGES)
                .class("LANDMARKS", LANDMARKS)
                .class("EDGES", EDGES),
        }
    }
}

/// Asks rules about an object. A rule that fails says nothing of it, and the one below it would count in its stead: its
/// failure becomes the `trouble`, where there is none yet.
pub fn consult(consultation: &mut Consultation, object: &[Datum<'_>], trouble: &mut Option<String>) {
    consultation.consult(object);
    if trouble.is_none() {
        *trouble = consultation.failure();
    }
}

/// What rules are told of a step of a part: it is about to enter a junction.
pub const STEPS: &[(&str, Type)] = &[
    ("dimensions", Type::Number),
    ("junction", Type::Number),
    ("next", Type::Number),
    ("entering", Type::Text),
    ("leaving", Type::Text),
    ("junction_min_x", Type::Number),
    ("junction_min_y", Type::Number),
    ("junction_min_z", Type::Number),
    ("junction_max_x", Type::Number),
    ("junction_max_y", Type::Number),
    ("junction_max_z", Type::Number),
    ("part_min_x", Type::Number),
    ("part_min_y", Type::Number),
    ("part_min_z", Type::Number),
    ("part_max_x", Type::Number),
    ("part_max_y", Type::Number),
    ("part_max_z", Type::Number),
    ("next_min_x", Type::Number),
    ("next_min_y", Type::Number),
    ("next_min_z", Type::Number),
    ("next_max_x", Type::Number),
    ("next_max_y", Type::Number),
    ("next_max_z", Type::Number),
    ("bound_x", Type::Number),
    ("bound_y", Type::Number),
    ("bound_z", Type::Number),
    ("room", Type::Number),
    ("asked", Type::Text),
    ("asked_x", Type::Number),
    ("asked_y", Type::Number),
    ("asked_z", Type::Number),
    ("fragile", Type::Truth),
    ("hurry", Type::Truth),
];

/// What rules are told of a turn of a robot: it is about to enter a junction.
pub const TURNS: &[(&str, Type)] = &[
    ("junction", Type::Number),
    ("entering", Type::Text),
    ("junction_x", Type::Number),
    ("junction_y", Type::Number),
    ("robot_x", Type::Number),
    ("robot_y", Type::Number),
    ("next_x", Type::Number),
    ("next_y", Type::Number),
    ("corridor", Type::Number),
    ("bound", Type::Number),
    ("width", Type::Number),
    ("length", Type::Number),
    ("asked", Type::Text),
    ("asked_gap", Type::Number),
    ("fragile", Type::Truth),
    ("hurry", Type::Truth),
];

/// What rules are told of a passage: a stretch of one corridor, between two junctions, the start or the goal.
pub const PASSAGES: &[(&str, Type)] = &[
    ("channel", Type::Number),
    ("length", Type::Number),
    ("corridor", Type::Number),
    ("room", Type::Number),
    ("width", Type::Number),
    ("asked_gap", Type::Number),
    ("fragile", Type::Truth),
    ("hurry", Type::Truth),
];

/// Where a property stands in one of these lists; asked when compiled.
pub(crate) const fn place(list: &[(&str, Type)], name: &str) -> usize {
    let mut at = 0;
    while !same(list[at].0.as_bytes(), name.as_bytes()) {
        at += 1;
    }
    at
}

pub(crate) const fn same(one: &[u8], other: &[u8]) -> bool {
    if one.len() != other.len() {
        return false;
    }
    let mut at = 0;
    while at < one.len() {
        if one[at] != other[at] {
            return false;
        }
        at += 1;
    }
    true
}

/// Reads a rule base: a shipped one by its name, else a folder. One that cannot be right, or fails a test beside it, is
/// refused.
///
/// # Returns
/// The rules, and what is not wrong but worth a look, as text.
pub fn load(kind: Kind, name: &str, beside: &Path) -> Result<(Arc<RuleBase>, Vec<String>)> {
    load_by(kind, name, beside, &kind.schema())
}

/// As [`load`], where rules may speak of what a schema has.
pub fn load_by(
    kind: Kind,
    name: &str,
    beside: &Path,
    schema: &Schema,
) -> Result<(Arc<RuleBase>, Vec<String>)> {
    let Rules { base, tests } = found(kind, name, beside)?;
    let (errors, warnings): (Vec<_>, Vec<_>) =
        base.check(schema).into_iter().partition(|found| found.severity == Severity::Error);
    if !errors.is_empty() {
        return Err(Error::all(errors));
    }
    let idle = lint::not_carried_out(&base, "worlds", miette::Severity::Error);
    if !idle.is_empty() {
        return Err(Error::all(idle));
    }
    let outcomes = tests.run(&base, schema).map_err(|wrong| Error::all(wrong.0))?;
    let failures: Vec<_> =
        outcomes.into_iter().flat_map(|outcome| outcome.failures).map(|failure| failure.diagnostic).collect();
    if !failures.is_empty() {
        return Err(Error::all(failures));
    }
    // the shipped ones are as they are meant
    let remarks = if kind.shipped().contains(&name) {
        Vec::new()
    } else {
        let ignored = lint::not_read(Some(&beside.join(name)));
        let unread = lint::unread_but(&base, kind.asked());
        let said = warnings.iter().map(ToString::to_string).chain(unread.iter().map(ToString::to_string));
        said.chain(ignored.iter().map(ToString::to_string)).collect()
    };
    Ok((Arc::new(base), remarks))
}

/// Reads a rule base that was in use already, whatever it speaks of.
pub(crate) fn found(kind: Kind, name: &str, beside: &Path) -> Result<Rules> {
    if kind.shipped().contains(&name) {
        return rules::shipped(&kind.folder(name));
    }
    let folder = beside.join(name);
    if folder.is_dir() {
        return rules::from_folder(&folder);
    }
    let message = format!("there is no rule base `{name}`: {} is no folder", folder.display());
    let help =
        format!("the shipped ones are `{}`; anything else is a folder", kind.shipped().join("` and `"));
    Err(Error::said("plan/no-rules", message, Some(help)))
}
