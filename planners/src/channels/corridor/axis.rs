//! The two axes that corridors lie along.

use std::fmt;

use crate::geometry::{Point, Rect};

/// An axis of the map's frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// To the right: what lies along it is lying.
    X,
    /// Up: what lies along it is upright.
    Y,
}

impl Axis {
    /// Its letter, `"x"` or `"y"`.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
        }
    }

    #[must_use]
    pub fn across(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::X,
        }
    }

    pub(super) fn of(self, point: Point) -> f64 {
        match self {
            Self::X => point.x,
            Self::Y => point.y,
        }
    }

    pub(super) fn extent(self, rect: &Rect) -> f64 {
        match self {
            Self::X => rect.dx(),
            Self::Y => rect.dy(),
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
