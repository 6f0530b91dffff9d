//! Map readers: from a file to a [`World`], with every problem of the file said at its place.

mod area_file;
pub mod diagnostic;
mod fields;
pub mod image;
mod mask;
mod occupancy;
pub mod overlay;
mod report;
pub mod ros_map;
mod salt;
mod settings;
mod source;
mod suggest;
pub mod toml_map;
mod unique;
mod value;
mod yaml;
mod zone_set;

use std::io;
use std::path::Path;

use crate::world::World;

pub use area_file::AreaFile;
pub use diagnostic::{Code, MapErrors, Problem, Text};
pub(crate) use fields::span_of;
pub use fields::{Document, Fields, Located, in_words};
pub use overlay::Overlay;
pub use report::MapReport;
pub use settings::{MapSettings, Unknown};
pub(crate) use source::Source;
pub use suggest::nearest;
pub(crate) use value::{At, Read};
pub use zone_set::ZONE_ID;

/// Reads a map by its extension: `.toml` a vector map, `.yaml` or `.yml` a map of ROS with its image.
///
/// # Returns
/// The world, and a report of the free space that each step cost or gave, with notes.
pub fn read_map(path: &Path, settings: &MapSettings) -> Result<(World, MapReport), MapErrors> {
    let (world, mut report) = read(path, settings)?;
    report.measure(&world)?;
    Ok((world, report))
}

/// As [`read_map`], for whom nothing but the world and the notes matters: the free space is not measured.
pub fn read_world(path: &Path, settings: &MapSettings) -> Result<(World, Vec<Problem>), MapErrors> {
    read(path, settings).map(|(world, report)| (world, report.notes))
}

/// What a file of text holds.
pub(crate) fn text_of(path: &Path) -> io::Result<String> {
    std::fs::read_to_string(path).map_err(|error| match error.kind() {
        io::ErrorKind::InvalidData => {
            io::Error::new(error.kind(), "it is not UTF-8 text; save it as plain text in UTF-8")
        }
        _ => error,
    })
}

/// What a scanner saw, where the map is an image: a PNG in grey whose longer side has at most so many pixels. It covers the
/// map from edge to edge. `None`: the map is drawn.
pub fn read_scan(path: &Path, most: usize) -> Result<Option<Vec<u8>>, MapErrors> {
    if !matches!(extension(path).as_str(), "yaml" | "yml") {
        return Ok(None);
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    ros_map::read_scan(&path.display().to_string(), &map_text(path)?, folder, most).map(Some)
}

fn extension(path: &Path) -> String {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_lowercase()
}

/// A pipe or a device may never end, and a folder is of no format.
fn must_be_a_file(path: &Path) -> Result<(), MapErrors> {
    if path.exists() && !path.is_file() {
        let message = format!("the map `{}` is no file", path.display());
        return Err(Problem::of_file(Code::Unreadable, message).into());
    }
    Ok(())
}

fn map_text(path: &Path) -> Result<String, MapErrors> {
    must_be_a_file(path)?;
    let unreadable = |error| {
        let message = format!("the map `{}` cannot be read: {error}", path.display());
        Problem::of_file(Code::Unreadable, message)
    };
    Ok(text_of(path).map_err(unreadable)?)
}

fn read(path: &Path, settings: &MapSettings) -> Result<(World, MapReport), MapErrors> {
    settings.check()?;
    let name = path.display().to_string();
    let (mut world, report) = match extension(path).as_str() {
        "toml" => {
            let (world, notes) = toml_map::read_toml_map(&name, &map_text(path)?)?;
            (world, MapReport { notes, ..MapReport::default() })
        }
        "yaml" | "yml" => {
            let folder = path.parent().unwrap_or(Path::new(""));
            ros_map::read_ros_map(&name, &map_text(path)?, folder, settings)?
        }
        _ => {
            must_be_a_file(path)?;
            let message = format!("the map `{name}` is of no known format");
            let help = "known: .toml (vector map), .yaml and .yml (ROS map with its image, or a lane graph), .json, .geojson and .tmap2 (lane graphs)";
            return Err(Problem::of_file(Code::UnknownFormat, message).with_help(help).into());
        }
    };
    world.grid = settings.grid;
    world.clearance = settings.clearance;
    Ok((world, report))
}
