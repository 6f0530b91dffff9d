//! What could be taken instead of an end of a route at which nothing fits.

use std::fmt;

use adit_planners::geometry::Point;
use serde::Serialize;
use utoipa::ToSchema;

use crate::words::number::number;

/// The nearest point from which ways lead on.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
pub struct Nearest {
    /// Of which end: `start` or `goal`.
    pub end: &'static str,
    pub x: f64,
    pub y: f64,
    /// From the point that was asked for.
    pub metres: f64,
    /// The state that fits there; there is none in the paper's modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
}

impl Nearest {
    pub fn at(&self) -> Point {
        Point::new(self.x, self.y)
    }
}

impl fmt::Display for Nearest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = [self.x, self.y].map(number);
        write!(f, "({x}, {y}), {} m away", number(self.metres.max(0.001)))?;
        match &self.state {
            Some(state) => write!(f, " (state {state})"),
            None => Ok(()),
        }
    }
}
