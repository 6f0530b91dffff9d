//! Maps of ROS `map_server`: a YAML file that says how its image is meant. Semantics as in nav2's
//! `nav2_map_server` (`map_io.cpp`).

pub(crate) mod yaml;

use std::path::Path;

use super::diagnostic::{Code, MapErrors, Problem, Text};
use super::image::read_image;
use super::occupancy::{self, Cell};
use super::report::MapReport;
use super::settings::MapSettings;
use crate::geometry::Point;
use crate::pose::Pose;
use crate::world::{Occupancy, World};

/// Reads a map of ROS: the YAML file's text and the image that it names, relative to `folder`.
///
/// Coordinates of the site are those of the image, shifted to the file's origin, x to the right and y up; its yaw
/// is not applied. With a yaw of 0 they are ROS's map frame. [`World::frame`] maps them to ROS's map frame for
/// any yaw.
///
/// # Arguments
/// `name` is how messages call the file, `text` its content.
///
/// # Returns
/// The world and what each step did to its free space (without that of grid and clearance).
pub fn read_ros_map(
    name: &str,
    text: &str,
    folder: &Path,
    settings: &MapSettings,
) -> Result<(World, MapReport), MapErrors> {
    let source = Text::new(name, text);
    let file = yaml::parse(&source, text)?;
    let image = read_image(&source, &file, folder)?;
    let cells: Vec<Cell> = image.bottom_up().map(|pixel| file.classify(pixel)).collect();
    let mut report = occupancy::count(&cells, file.resolution, settings.unknown);
    let mut walls = Occupancy {
        origin: file.origin.at,
        resolution: file.resolution,
        columns: image.columns,
        rows: image.rows,
        blocked: occupancy::walls(&cells, settings.unknown),
    };
    let (specks, salt_note) = occupancy::drop_specks(&mut walls, settings.speck_area);
    report.specks = specks;
    let note = |note: String| Problem::of_file(Code::Salt, format!("{}: {note}", file.image)).as_advice();
    report.notes.extend(salt_note.map(note));
    report.notes.extend(turned(name, file.origin));
    let mut world = World::empty(walls.bounds());
    world.frame = frame(file.origin);
    world.occupancy = Some(walls);
    Ok((world, report))
}

/// The image of a map of ROS as a PNG in grey, whose longer side has at most so many pixels.
///
/// # Arguments
/// `name` is how messages call the file, `text` its content.
pub fn read_scan(name: &str, text: &str, folder: &Path, most: usize) -> Result<Vec<u8>, MapErrors> {
    let source = Text::new(name, text);
    let file = yaml::parse(&source, text)?;
    let png = read_image(&source, &file, folder)?.png(most);
    Ok(png.map_err(|error| Problem::of_file(Code::NotAnImage, format!("{}: {error}", file.image)))?)
}

/// A word about an origin that is turned: that its yaw is not applied, which whoever says points has to know.
fn turned(name: &str, origin: Pose) -> Option<Problem> {
    let yaw = origin.heading;
    if yaw == 0.0 {
        return None;
    }
    let degrees = (yaw.to_degrees() * 100.0).round() / 100.0;
    let radians = if yaw.abs() > std::f64::consts::TAU { "; a yaw is in radians" } else { "" };
    let message = format!(
        "{name}: its origin is turned by {yaw} ({degrees} degrees{radians}): points are those of the image's own axes, and the table \
         `frames` has the pose that turns them into ROS's map frame"
    );
    Some(Problem::of_file(Code::Turned, message).as_advice())
}

/// The pose that turns site coordinates into ROS's map frame: a turn about the image's lower left corner.
pub(crate) fn frame(origin: Pose) -> Pose {
    Pose { at: origin.at - origin.at.rotated(Point::towards(origin.heading)), ..origin }
}
