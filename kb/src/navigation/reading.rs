//! `[floor_plan]` of a world, and what it says of doorways and regions.

use std::ops::Range;
use std::path::Path;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, read_floor_plan};
use adit_planners::geometry::Point;
use adit_planners::read::{Code, Fields, Located, MapSettings, Overlay, Problem, Unknown, read_map};
use adit_planners::world::{Bridge, NamedDoor, Obstacle, Property, Shape, World};
use toml::de::DeValue;

use super::floor::Floor;
use super::told::{self, Told};
use crate::error::{Error, Result};
use crate::site::driving::{self, Driving};
use crate::site::{Site, not_negative};
use crate::words::suggest::did_you_mean;

const KEYS: [&str; 9] = [
    "file",
    "map",
    "unknown",
    "speck_area",
    "open",
    "closed",
    "robot",
    driving::NAVIGATION,
    driving::SENSORS,
];
/// What goes with a map alone.
const OF_MAPS: [&str; 4] = ["unknown", "speck_area", "open", "closed"];
/// What a world lays over its map.
const LAID: [&str; 3] = ["place", "obstacle", "bridge"];
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
    let robot = robot(fields, problems);
    let titles = ["[floor_plan.navigation]", "[floor_plan.sensors]"];
    let driving = Driving::of_floor().read(fields, titles, problems);
    let said = told::read(world, problems);
    let source = source(world, fields, problems);
    let (Some(source), Some(robot), true) = (source, robot, problems.is_empty()) else { return Ok(None) };
    let plan = match source {
        Source::Plan(file) => {
            read_floor_plan(&folder.join(file)).map_err(|error| Error::all(error.problems))?
        }
        Source::Map(file, settings) => {
            let Some(map) = map(world, fields, &folder.join(file), &settings, problems)? else {
                return Ok(None);
            };
            let Some(map) = of_height(map, &robot, fields, problems) else { return Ok(None) };
            FloorPlan::of_world(&map, robot.height).map_err(|errors| Error::all(errors.problems))?
        }
    };
    let network = Network::new(&plan, robot.disc).map_err(|errors| {
        // what is wrong with a robot is said where it stands
        let here = |problem: Problem| fields.text.problem(problem.code, &robot.span, problem.message);
        let help = "a smaller `radius`, or another plan, is expected";
        Error::all(errors.problems.into_iter().map(|problem| here(problem).with_help(help)))
    })?;
    let told = Told::new(&said, &network, world, problems);
    Ok(problems.is_empty().then_some(Floor { plan, network, driving, told }))
}

enum Source {
    /// A floor plan as JSON.
    Plan(String),
    /// A map as sites have it.
    Map(String, MapSettings),
}

fn source(world: &Fields<'_, '_>, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Source> {
    if fields.get("map").is_none() {
        let of_maps = LAID.iter().map(|key| (world, key)).chain(OF_MAPS.iter().map(|key| (fields, key)));
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
        settings.speck_area = Some(not_negative(fields, "speck_area", problems)?);
    }
    fields.string("map", problems).map(|file| Source::Map(file.value, settings))
}

/// The map with what its site and the world lay over it.
fn map(
    world: &Fields<'_, '_>,
    fields: &Fields<'_, '_>,
    file: &Path,
    settings: &MapSettings,
    problems: &mut Vec<Problem>,
) -> Result<Option<World>> {
    let overlay = Overlay::from_fields(world, problems);
    let (mut map, _) = read_map(file, settings).map_err(|errors| Error::all(errors.problems))?;
    if let Some(site) = Site::of_map(file)? {
        site.lay_over(&mut map)?;
    }
    overlay.lay_over(&mut map).map_err(|errors| Error::all(errors.problems))?;
    shut(&mut map, fields, problems);
    Ok(problems.is_empty().then_some(map))
}

/// The map, unless it has bridges and nothing says whether the robot passes under them.
fn of_height(
    map: World,
    robot: &Robot,
    fields: &Fields<'_, '_>,
    problems: &mut Vec<Problem>,
) -> Option<World> {
    let lowest = map.bridges.iter().min_by(|a, b| a.height.total_cmp(&b.height));
    if let (Some(Bridge { rect, height }), None) = (lowest, robot.height) {
        let message = format!(
            "the map has a bridge of {height} m at ({}, {}) to ({}, {}), and `robot` has no `height`",
            rect.x0, rect.y0, rect.x1, rect.y1
        );
        let help = "say how high the robot is, as in `robot = { radius = 0.25, height = 1.0 }`: it passes under \
                    bridges that are higher, and the others are solid";
        problems.push(fields.text.problem(Code::MissingKey, &robot.span, message).with_help(help));
        return None;
    }
    Some(map)
}

/// Makes solid what `closed` names of the map's areas and doors. Whether a robot may enter an area or pass a door of which
/// the map says more than its name, the world must say: rules of floor plans know neither.
fn shut(map: &mut World, fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) {
    let (open, closed) = (names(fields, "open", problems), names(fields, "closed", problems));
    let areas = map.areas.iter().map(|area| {
        let says = said(area.kind.as_deref(), &area.further);
        (area.name.clone(), format!("area `{}`{says}", area.name), !says.is_empty(), area.shape.clone())
    });
    let doors = map.named_doors.iter().map(|door| {
        let says = said(door.kind.as_deref(), &door.further);
        (door.name.clone(), format!("door `{}`{says}", door.name), !says.is_empty(), leaf(door))
    });
    let known: Vec<_> = areas.chain(doors).collect();
    for named in open.iter().chain(&closed) {
        if known.iter().all(|(name, ..)| *name != named.value) {
            let message = format!("the map has no area or door `{}`", named.value);
            let help = did_you_mean(&named.value, known.iter().map(|(name, ..)| name.as_str()));
            let problem = fields.text.problem(Code::Impossible, &named.span, message);
            problems.push(
                problem.with_help(help.unwrap_or_else(|| "names of `[[area]]` and `[[door]]`".to_owned())),
            );
        }
    }
    for (name, what, says_more, shape) in known {
        if closed.iter().any(|closed| closed.value == name) {
            map.obstacles.push(Obstacle { shape });
        } else if says_more && open.iter().all(|open| open.value != name) {
            let message = format!("the map has the {what}, and nothing says whether the robot may go there");
            let help =
                format!("add \"{name}\" to `open` or to `closed` of [floor_plan]: what is closed is solid");
            problems.push(fields.text.problem(Code::MissingKey, &fields.span, message).with_help(help));
        }
    }
}

/// What is said of an area or a door besides its name.
fn said(kind: Option<&str>, further: &[(String, Property)]) -> String {
    let further = further.iter().map(|(property, value)| match value {
        Property::Number(number) => format!("{property} {number}"),
        Property::Text(text) => format!("{property} {text}"),
        Property::Truth(truth) => format!("{property} {truth}"),
    });
    let said: Vec<String> = kind.map(|kind| format!("kind {kind}")).into_iter().chain(further).collect();
    if said.is_empty() { String::new() } else { format!(" ({})", said.join(", ")) }
}

/// A shut door: its segment, as thick as a leaf.
fn leaf(door: &NamedDoor) -> Shape {
    const THICK_M: f64 = 0.04;
    let (from, to) = (door.from, door.to);
    let half = THICK_M / 2.0 / from.distance(to);
    let aside = Point::new((from.y - to.y) * half, (to.x - from.x) * half);
    let corner = |at: Point, side: f64| Point::new(at.x + side * aside.x, at.y + side * aside.y);
    Shape::Polygon(vec![corner(from, 1.0), corner(from, -1.0), corner(to, -1.0), corner(to, 1.0)])
}

/// A list of names under a key; empty where the key is missing.
fn names(fields: &Fields<'_, '_>, key: &str, problems: &mut Vec<Problem>) -> Vec<Located<String>> {
    let Some(value) = fields.get(key) else { return Vec::new() };
    let name = |entry: &toml::Spanned<DeValue<'_>>| match entry.get_ref() {
        DeValue::String(name) => Some(Located { value: name.to_string(), span: entry.span() }),
        _ => None,
    };
    let found = match value.get_ref() {
        DeValue::Array(entries) => entries.iter().map(name).collect(),
        _ => None,
    };
    found.unwrap_or_else(|| {
        problems.push(fields.wrong_type(
            key,
            "a list of names of areas and doors",
            value.get_ref(),
            value.span(),
        ));
        Vec::new()
    })
}

/// What a world says of its robot.
struct Robot {
    disc: Disc,
    /// Metres.
    height: Option<f64>,
    span: Range<usize>,
}

fn robot(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<Robot> {
    if fields.get("robot").is_none() {
        let disc = Disc { radius: 0.25, margin: 0.0 };
        return Some(Robot { disc, height: None, span: fields.span.clone() });
    }
    let robot = fields.table("robot", "robot", problems)?;
    robot.refuse_unknown(&["radius", "margin", "height"], problems);
    let radius = robot.positive("radius", problems);
    let margin =
        if robot.get("margin").is_none() { Some(0.0) } else { not_negative(&robot, "margin", problems) };
    let height = robot.get("height").and_then(|_| robot.positive("height", problems));
    let (Located { value: radius, span }, margin) = (radius?, margin?);
    Some(Robot { disc: Disc { radius, margin }, height: height.map(|height| height.value), span })
}
