//! How a map is to be read.

use super::diagnostic::{Code, MapErrors, Problem};

/// What the unknown cells of an image count as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Unknown {
    /// Solid: a robot does not go where nobody has looked.
    #[default]
    Wall,
    Free,
}

/// How a site wants its map to be read.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct MapSettings {
    pub unknown: Unknown,
    /// Blobs of wall cells with a smaller area are dropped, square metres; 0 drops none. `None`: those that are salt.
    pub speck_area: Option<f64>,
    /// Steps in which the narrowest place of a way is looked for, metres; `None`: the image's resolution, or chosen.
    pub grid: Option<f64>,
    /// Kept free around every state besides its own width, metres.
    pub clearance: f64,
}

impl MapSettings {
    pub(super) fn check(&self) -> Result<(), MapErrors> {
        let Self { speck_area, grid, clearance, .. } = *self;
        let mut problems = Vec::new();
        let mut refuse = |code, message: String| problems.push(Problem::of_file(code, message));
        for (key, value) in [("speck_area", speck_area.unwrap_or(0.0)), ("clearance", clearance)] {
            if !value.is_finite() || value < 0.0 {
                refuse(
                    Code::NotPositive,
                    format!("`{key}` is {value} and must be a finite number from 0 on"),
                );
            }
        }
        if let Some(grid) = grid.filter(|grid| !grid.is_finite() || *grid <= 0.0) {
            refuse(
                Code::NotPositive,
                format!("`grid` is {grid} and must be a finite number of metres above 0"),
            );
        }
        if problems.is_empty() { Ok(()) } else { Err(MapErrors { problems }) }
    }
}
