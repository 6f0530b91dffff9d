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
/// What a user may set of the navigator: figures above 0.
const FIGURES: [(&str, Set); 7] = [
    ("goal_tolerance", |settings, metres| settings.goal_tolerance_m = metres),
    ("turning_resolution", |settings, degrees| settings.turning_resolution = degrees.to_radians()),
    ("highway_half_width", |settings, metres| settings.highway_half_width_m = metres),
    ("look_ahead", |settings, metres| settings.look_ahead_m = metres),
    ("speed", |settings, metres| settings.speed_m_s = metres),
    ("detour_clearance", |settings, metres| settings.detour_clearance_m = metres),
    ("room", |settings, metres| settings.detour_room_m = metres),
];
/// How many times it does a thing; 0 is never.
const TIMES: [(&str, SetTimes); 4] = [
    ("most_waits", |settings, times| settings.most_waits = times),
    ("most_detours", |settings, times| settings.most_detours = times),
    ("most_retries", |settings, times| settings.most_retries = times),
    ("most_back_offs", |settings, times| settings.most_back_offs = times),
];
/// For so long there may be a way again, seconds; 0 is not at all.
const NO_WAY_AFTER: &str = "no_way_after";

type Set = fn(&mut Settings, f64);
type SetTimes = fn(&mut Settings, u32);

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
    let network = Network::new(&plan, disc.value).map_err(|errors| {
        // what is wrong with a robot is said where it stands
        let here = |problem: Problem| fields.text.problem(problem.code, &disc.span, problem.message);
        let help = "a smaller `radius`, or another plan, is expected";
        Error::all(errors.problems.into_iter().map(|problem| here(problem).with_help(help)))
    })?;
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

fn disc(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Located<Disc>> {
    if fields.get("robot").is_none() {
        return Some(Located { value: Disc { radius: 0.25, margin: 0.0 }, span: fields.span.clone() });
    }
    let robot = fields.table("robot", "robot", problems)?;
    robot.refuse_unknown(&["radius", "margin"], problems);
    let radius = robot.positive("radius", problems);
    let margin =
        if robot.get("margin").is_none() { Some(0.0) } else { not_negative(&robot, "margin", problems) };
    let (Located { value: radius, span }, margin) = (radius?, margin?);
    Some(Located { value: Disc { radius, margin }, span })
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

fn times(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Option<u32> {
    let number = fields.number(key, problems)?;
    if number.value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number.value) {
        return Some(number.value as u32);
    }
    let message = format!("`{key}` is {} and must be a whole number from 0 on", number.value);
    problems.push(fields.text.problem(Code::NotPositive, &number.span, message));
    None
}

fn settings(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Settings {
    let mut settings = Settings::default();
    let Some(table) = fields.table("navigation", "[floor_plan.navigation]", problems) else {
        return settings;
    };
    let figures = FIGURES.iter().map(|(key, _)| *key);
    let keys: Vec<&str> = figures.chain(TIMES.iter().map(|(key, _)| *key)).chain([NO_WAY_AFTER]).collect();
    table.refuse_unknown(&keys, problems);
    for (key, set) in FIGURES {
        if table.get(key).is_some()
            && let Some(figure) = table.positive(key, problems)
        {
            set(&mut settings, figure.value);
        }
    }
    for (key, set) in TIMES {
        if table.get(key).is_some()
            && let Some(times) = times(&table, key, problems)
        {
            set(&mut settings, times);
        }
    }
    if table.get(NO_WAY_AFTER).is_some()
        && let Some(seconds) = not_negative(&table, NO_WAY_AFTER, problems)
    {
        settings.no_way_after_s = seconds;
    }
    settings
}
