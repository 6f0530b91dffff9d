//! `[floor_plan]` of a world, and what it says of doorways and regions.

use std::path::Path;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, read_floor_plan};
use adit_planners::navigation::Settings;
use adit_planners::read::{Code, Fields, Located, MapSettings, Overlay, Problem, Unknown, read_map};

use super::floor::Floor;
use super::told::{self, Told};
use crate::error::{Error, Result};

const KEYS: [&str; 6] = ["file", "map", "unknown", "speck_area", "robot", "navigation"];
/// What a world lays over its map.
const LAID: [&str; 2] = ["place", "obstacle"];
/// What a user may set of the navigator.
const FIGURES: [(&str, Set); 12] = [
    ("goal_tolerance", |settings, metres| settings.goal_tolerance_m = metres),
    ("turning_resolution", |settings, degrees| settings.turning_resolution = degrees.to_radians()),
    ("highway_half_width", |settings, metres| settings.highway_half_width_m = metres),
    ("look_ahead", |settings, metres| settings.look_ahead_m = metres),
    ("speed", |settings, metres| settings.speed_m_s = metres),
    ("detour_clearance", |settings, metres| settings.detour_clearance_m = metres),
    ("room", |settings, metres| settings.detour_room_m = metres),
    ("most_waits", |settings, times| settings.most_waits = times as u32),
    ("most_detours", |settings, times| settings.most_detours = times as u32),
    ("most_retries", |settings, times| settings.most_retries = times as u32),
    ("most_back_offs", |settings, times| settings.most_back_offs = times as u32),
    ("no_way_after", |settings, seconds| settings.no_way_after_s = seconds),
];

type Set = fn(&mut Settings, f64);

/// The keys that a world may have beside `[floor_plan]`.
pub fn keys() -> impl Iterator<Item = &'static str> {
    told::KEYS.into_iter().chain(LAID)
}

/// Reads `[floor_plan]` of a world; its plan, or its map, lies beside the world's file.
pub fn read(
    world: &Fields<'_, '_>,
    fields: &Fields<'_, '_>,
    folder: &Path,
    problems: &mut Vec<Problem>,
) -> Result<Option<Floor>> {
    fields.refuse_unknown(&KEYS, problems);
    let disc = disc(fields, problems);
    let settings = settings(fields, problems);
    let said = told::read(world, problems);
    let source = source(world, fields, problems);
    let (Some(source), Some(disc), true) = (source, disc, problems.is_empty()) else { return Ok(None) };
    let plan = match source {
        Source::Plan(file) => {
            read_floor_plan(&folder.join(file)).map_err(|error| Error::all(error.problems))?
        }
        Source::Map(file, settings) => of_map(world, &folder.join(file), &settings, problems)?,
    };
    let network = Network::new(&plan, disc).map_err(|error| Error::all(error.problems))?;
    let told = Told::new(&said, &network, world, problems);
    Ok(problems.is_empty().then_some(Floor { plan, network, settings, told }))
}

/// Where walls stand.
enum Source {
    /// A floor plan as JSON.
    Plan(String),
    /// A map as sites have it.
    Map(String, MapSettings),
}

fn source(world: &Fields<'_, '_>, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Source> {
    if fields.get("map").is_none() {
        let of_maps = LAID
            .iter()
            .map(|key| (world, key))
            .chain(["unknown", "speck_area"].iter().map(|key| (fields, key)));
        for (table, key) in of_maps {
            if let Some(value) = table.get(key) {
                let message = format!("`{key}` goes with `map`; a floor plan by `file` says it there");
                problems.push(fields.text.problem(Code::UnknownKey, &value.span(), message));
            }
        }
        return fields.string("file", problems).map(|file| Source::Plan(file.value));
    }
    if let Some(file) = fields.get("file") {
        let message = "[floor_plan] has a `file` and a `map`; it has one of them";
        problems.push(fields.text.problem(Code::UnknownKey, &file.span(), message));
    }
    let mut settings = MapSettings::default();
    if fields.get("unknown").is_some() {
        let word = fields.string("unknown", problems)?;
        settings.unknown = match word.value.as_str() {
            "wall" => Unknown::Wall,
            "free" => Unknown::Free,
            other => {
                let message = format!("`unknown` is \"{other}\" and must be \"wall\" or \"free\"");
                problems.push(fields.text.problem(Code::WrongType, &word.span, message));
                return None;
            }
        };
    }
    if fields.get("speck_area").is_some() {
        settings.speck_area = not_negative(fields, "speck_area", problems)?;
    }
    fields.string("map", problems).map(|file| Source::Map(file.value, settings))
}

fn of_map(
    world: &Fields<'_, '_>,
    file: &Path,
    settings: &MapSettings,
    problems: &mut Vec<Problem>,
) -> Result<FloorPlan> {
    let overlay = Overlay::from_fields(world, problems);
    let (mut map, _) = read_map(file, settings).map_err(|errors| Error::all(errors.problems))?;
    overlay.lay_over(&mut map).map_err(|errors| Error::all(errors.problems))?;
    FloorPlan::of_world(&map).map_err(|errors| Error::all(errors.problems))
}

fn disc(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Disc> {
    if fields.get("robot").is_none() {
        return Some(Disc { radius: 0.25, margin: 0.0 });
    }
    let robot = fields.table("robot", "robot", problems)?;
    robot.refuse_unknown(&["radius", "margin"], problems);
    let radius = robot.positive("radius", problems).map(|Located { value, .. }| value);
    let margin =
        if robot.get("margin").is_none() { Some(0.0) } else { not_negative(&robot, "margin", problems) };
    Some(Disc { radius: radius?, margin: margin? })
}

fn not_negative(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Option<f64> {
    let number = fields.number(key, problems)?;
    if number.value >= 0.0 {
        return Some(number.value);
    }
    let message = format!("`{key}` is {} and must not be negative", number.value);
    problems.push(fields.text.problem(Code::NotPositive, &number.span, message));
    None
}

fn settings(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Settings {
    let mut settings = Settings::default();
    let Some(table) = fields.table("navigation", "[floor_plan.navigation]", problems) else {
        return settings;
    };
    table.refuse_unknown(&FIGURES.map(|(key, _)| key), problems);
    for (key, set) in FIGURES {
        if table.get(key).is_some()
            && let Some(figure) = table.positive(key, problems)
        {
            set(&mut settings, figure.value);
        }
    }
    settings
}
