//! Map readers: from a file to a [`World`], with every problem of the file said at its place.

pub mod diagnostic;
mod fields;
pub mod image;
mod occupancy;
pub mod overlay;
mod report;
pub mod ros_map;
mod suggest;
pub mod toml_map;

use std::path::Path;

use crate::world::World;

pub use diagnostic::{Code, MapErrors, Problem, Text};
pub(crate) use fields::span_of;
pub use fields::{Document, Fields, Located};
pub use overlay::Overlay;
pub use report::MapReport;
pub use suggest::nearest;

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
    /// Blobs of wall cells with a smaller area are dropped, square metres; 0 drops none.
    pub speck_area: f64,
    /// Side of a cell of the layers, metres; `None`: the image's resolution, or chosen by the planner.
    pub grid: Option<f64>,
    /// Kept free around every state besides its own width, metres.
    pub clearance: f64,
}

/// Reads a map by its extension: `.toml` a vector map, `.yaml` or `.yml` a map of ROS with its image.
///
/// # Returns
/// The world, and a report of the free space that each step cost or gave, with notes.
pub fn read_map(path: &Path, settings: &MapSettings) -> Result<(World, MapReport), MapErrors> {
    check(settings)?;
    let name = path.display().to_string();
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    // a pipe or a device may never end
    if path.exists() && !path.is_file() {
        return Err(Problem::of_file(Code::Unreadable, format!("the map `{name}` is no file")).into());
    }
    let text = || {
        std::fs::read_to_string(path).map_err(|error| {
            Problem::of_file(Code::Unreadable, format!("the map `{name}` cannot be read: {error}"))
        })
    };
    let (mut world, mut report) = match extension.as_str() {
        "toml" => {
            let (world, notes) = toml_map::read_toml_map(&name, &text()?)?;
            let free_in_file = report::drawn_free_area(&world);
            (world, MapReport { free_in_file, notes, ..MapReport::default() })
        }
        "yaml" | "yml" => {
            let folder = path.parent().unwrap_or(Path::new(""));
            ros_map::read_ros_map(&name, &text()?, folder, settings)?
        }
        _ => {
            let message = format!("the map `{name}` is of no known format");
            let help = "known: .toml (vector map), .yaml and .yml (ROS map with its image)";
            return Err(Problem::of_file(Code::UnknownFormat, message).with_help(help).into());
        }
    };
    world.grid = settings.grid;
    world.clearance = settings.clearance;
    report.add_grid_and_clearance(&world)?;
    Ok((world, report))
}

fn check(settings: &MapSettings) -> Result<(), MapErrors> {
    let MapSettings { speck_area, grid, clearance, .. } = *settings;
    let mut problems = Vec::new();
    let mut refuse = |code, message: String| problems.push(Problem::of_file(code, message));
    for (key, value) in [("speck_area", speck_area), ("clearance", clearance)] {
        if !value.is_finite() || value < 0.0 {
            refuse(Code::NotPositive, format!("`{key}` is {value} and must be a finite number from 0 on"));
        }
    }
    if let Some(grid) = grid.filter(|grid| !grid.is_finite() || *grid <= 0.0) {
        refuse(Code::NotPositive, format!("`grid` is {grid} and must be a finite number of metres above 0"));
    }
    if problems.is_empty() { Ok(()) } else { Err(MapErrors { problems }) }
}
