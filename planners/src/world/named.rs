//! What people call by a name: areas and doors that a site lays over its map.

use std::fmt;
use std::hash::{Hash, Hasher};

use super::Shape;
use crate::geometry::Point;

/// A part of the floor with a name: a ward, a wet spot, a crossing of fork lifts. It is no wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Its name; no place, area or door of the world has the same.
    pub name: String,
    /// What it is, where that is said.
    pub kind: Option<String>,
    /// Its outline; of a polygon some may lie outside of the environment.
    pub shape: Shape,
    /// The middle of what of it lies in the environment.
    pub centre: Point,
    /// What else is said of it, by property, in the order of their names.
    pub further: Vec<(String, Property)>,
}

/// A door with a name: whoever crosses the segment passes it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedDoor {
    /// Its name; no place, area or door of the world has the same.
    pub name: String,
    /// What it is, where that is said.
    pub kind: Option<String>,
    pub from: Point,
    /// The other end; not the same point.
    pub to: Point,
    /// What else is said of it, by property, in the order of their names.
    pub further: Vec<(String, Property)>,
}

/// A value that a site gives to an area or a door, for its rules.
#[derive(Clone, Debug, PartialEq)]
pub enum Property {
    Number(f64),
    Text(String),
    Truth(bool),
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => write!(f, "`{text}`"),
            Self::Truth(truth) => truth.fmt(f),
        }
    }
}

impl Property {
    /// What sort of value it is, as signatures of planners and messages call it.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "number",
            Self::Text(_) => "text",
            Self::Truth(_) => "truth",
        }
    }

    pub fn into_number(self) -> Option<f64> {
        if let Self::Number(number) = self { Some(number) } else { None }
    }

    pub fn into_text(self) -> Option<String> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    pub fn into_truth(self) -> Option<bool> {
        if let Self::Truth(truth) = self { Some(truth) } else { None }
    }
}

impl Hash for Property {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.kind().hash(state);
        match self {
            Self::Number(number) => number.to_bits().hash(state),
            Self::Text(text) => text.hash(state),
            Self::Truth(truth) => truth.hash(state),
        }
    }
}
