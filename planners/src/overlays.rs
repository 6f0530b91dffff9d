//! Named areas and doors as facts, and which rooms lie in them.

mod coverage;
mod members;

use std::collections::BTreeMap;

use crate::facts::{Column, Facts, Table};
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::{Property, World};

pub use coverage::RoomsInOverlays;
pub(crate) use members::{GIVES as MEMBERS_GIVE, member_facts};

pub const AREAS: &str = "AREAS";
pub const NAMED_DOORS: &str = "NAMED_DOORS";

/// Properties that every object of these classes has, known or not, so that rules may speak of them.
const OWN: [(&str, &str, &str); 13] = [
    (AREAS, "closed", "truth"),
    (AREAS, "hardness_factor", "number"),
    (AREAS, "heading", "number"),
    (AREAS, "speed_limit", "number"),
    (AREAS, "speed_percent", "number"),
    (AREAS, "whole_body", "truth"),
    (AREAS, "zone", "text"),
    (AREAS, "zone_direction", "number"),
    (AREAS, "zone_factor", "number"),
    (AREAS, "zone_limitation", "text"),
    (NAMED_DOORS, "closed", "truth"),
    (NAMED_DOORS, "closed_from", "text"),
    (NAMED_DOORS, "hardness", "number"),
];

/// What kind of values one of [`OWN`] holds; `None` for a property that only a site gives.
pub(crate) fn own_kind(class: &str, property: &str) -> Option<&'static str> {
    OWN.iter().find(|own| own.0 == class && own.1 == property).map(|own| own.2)
}

/// Properties that every object of a class has, known or not.
pub fn own(class: &str) -> impl Iterator<Item = &'static str> {
    OWN.iter().filter(move |own| own.0 == class).map(|own| own.1)
}

/// Properties, by class, that a site alone gives its named areas and doors, with the names of those that have them.
pub fn only_of_site(world: &World) -> BTreeMap<(&'static str, &str), Vec<&str>> {
    let areas = world.areas.iter().map(|area| (AREAS, &area.name, &area.further));
    let doors = world.named_doors.iter().map(|door| (NAMED_DOORS, &door.name, &door.further));
    let mut found: BTreeMap<(&'static str, &str), Vec<&str>> = BTreeMap::new();
    for (class, name, further) in areas.chain(doors) {
        for (property, _) in further.iter().filter(|(property, _)| own_kind(class, property).is_none()) {
            found.entry((class, property)).or_default().push(name);
        }
    }
    found
}

/// Zones of VDA 5050 that an area may say that it is; the two others are said otherwise.
const ZONES: [&str; 8] = [
    "RELEASE",
    "COORDINATED_REPLANNING",
    "ACTION",
    "LINE_GUIDED",
    "PRIORITY",
    "PENALTY",
    "DIRECTED",
    "BIDIRECTED",
];

/// What the value of one of [`OWN`] has to be, and where it is meant otherwise, how that is said; `None` where it can be.
pub(crate) fn wanted(
    class: &str,
    property: &str,
    value: &Property,
) -> Option<(String, Option<&'static str>)> {
    let number = |is_right: fn(f64) -> bool, wanted: &str| match value {
        Property::Number(number) if !is_right(*number) => Some((wanted.to_owned(), None)),
        _ => None,
    };
    match (class, property, value) {
        (AREAS, "speed_limit", _) => number(|of| of > 0.0, "more than 0, metres a second"),
        (AREAS, "speed_percent", _) => number(|of| of > 0.0 && of <= 100.0, "more than 0 and at most 100"),
        (AREAS, "zone_factor", _) => number(|of| (0.0..=1.0).contains(&of), "from 0 to 1"),
        (AREAS, "zone", Property::Text(zone)) if !ZONES.contains(&zone.as_str()) => {
            let help = match zone.as_str() {
                "BLOCKED" => Some("an area of the kind `keep-out` is not entered"),
                "SPEED_LIMIT" => Some("`speed_limit` says how fast one may be there, metres a second"),
                _ => None,
            };
            Some((format!("one of {}", ZONES.join(", ")), help))
        }
        _ => None,
    }
}

/// Gives the named areas and doors of the world.
///
/// AREAS by name: `area` (the name), `kind`, `x` and `y` (its middle), `closed`, `hardness_factor`,
/// `heading` (in which one goes through it, degrees counterclockwise from x), `speed_limit` (m/s), `speed_percent`, `whole_body`,
/// `zone`, `zone_direction`, `zone_factor`, `zone_limitation`. `NAMED_DOORS` by name: `door`
/// (the name), `kind`, `x` and `y` (its middle), `width`, `closed`, `hardness`. Both with whatever else is said of one
/// of them; what is not said of an object is unknown.
#[derive(Clone, Debug, Default)]
pub struct Overlays {
    further: Vec<String>,
}

impl Overlays {
    /// A planner for a world, and for all of which no more is said.
    pub fn of(world: &World) -> Self {
        let write = |(class, (property, value)): (_, &(String, Property))| {
            format!("{class}.{property}: {}", value.kind())
        };
        let mut further: Vec<String> = further(world).map(write).collect();
        further.sort_unstable();
        further.dedup();
        Self { further }
    }
}

/// What is said of areas and doors besides what every one has, by class.
pub(crate) fn further(world: &World) -> impl Iterator<Item = (&'static str, &(String, Property))> {
    let areas = world.areas.iter().map(|area| (AREAS, &area.further));
    let doors = world.named_doors.iter().map(|door| (NAMED_DOORS, &door.further));
    areas.chain(doors).flat_map(|(class, further)| further.iter().map(move |one| (class, one)))
}

impl Planner for Overlays {
    fn name(&self) -> &'static str {
        "overlays"
    }

    fn signature(&self) -> Signature {
        let mut gives: Vec<String> =
            ["area: text", "kind: text", "x", "y"].map(|p| format!("{AREAS}.{p}")).into();
        gives.extend(["door: text", "kind: text", "x", "y", "width"].map(|p| format!("{NAMED_DOORS}.{p}")));
        gives.extend(OWN.map(|(class, property, kind)| format!("{class}.{property}: {kind}")));
        let known = gives.clone();
        gives.extend(self.further.iter().filter(|further| !known.contains(further)).cloned());
        Signature { needs: Vec::new(), gives }
    }

    fn facts(&self, world: &World, _known: &Facts) -> Result<Facts, PlannerError> {
        Ok(Facts::from([
            (AREAS.to_owned(), areas(world, &self.signature().gives)),
            (NAMED_DOORS.to_owned(), named_doors(world, &self.signature().gives)),
        ]))
    }
}

fn areas(world: &World, gives: &[String]) -> Table {
    let mut areas: Vec<_> = world.areas.iter().collect();
    areas.sort_by(|a, b| a.name.cmp(&b.name));
    let table = Table::default()
        .with("area", areas.iter().map(|area| area.name.clone()).collect::<Column>())
        .with("kind", areas.iter().map(|area| area.kind.clone()).collect::<Column>())
        .with("x", areas.iter().map(|area| area.centre.x).collect::<Column>())
        .with("y", areas.iter().map(|area| area.centre.y).collect::<Column>());
    let further: Vec<_> = areas.iter().map(|area| area.further.as_slice()).collect();
    with_further(table, AREAS, &further, gives)
}

fn named_doors(world: &World, gives: &[String]) -> Table {
    let mut doors: Vec<_> = world.named_doors.iter().collect();
    doors.sort_by(|a, b| a.name.cmp(&b.name));
    let table = Table::default()
        .with("door", doors.iter().map(|door| door.name.clone()).collect::<Column>())
        .with("kind", doors.iter().map(|door| door.kind.clone()).collect::<Column>())
        .with("x", doors.iter().map(|door| f64::midpoint(door.from.x, door.to.x)).collect::<Column>())
        .with("y", doors.iter().map(|door| f64::midpoint(door.from.y, door.to.y)).collect::<Column>())
        .with("width", doors.iter().map(|door| door.from.distance(door.to)).collect::<Column>());
    let further: Vec<_> = doors.iter().map(|door| door.further.as_slice()).collect();
    with_further(table, NAMED_DOORS, &further, gives)
}

/// Adds a column for each property that is given of the class and not there yet, or said of one of its objects.
fn with_further(mut table: Table, class: &str, further: &[&[(String, Property)]], gives: &[String]) -> Table {
    let declared = gives.iter().filter_map(|given| {
        let (name, kind) = given.split_once(": ").unwrap_or((given, "number"));
        Some((name.strip_prefix(class)?.strip_prefix('.')?, kind))
    });
    let said = further.iter().flat_map(|of| of.iter().map(|(name, value)| (name.as_str(), value.kind())));
    let properties: Vec<(&str, &str)> = declared.chain(said).collect();
    for (property, kind) in properties {
        if table.column(property).is_some() {
            continue;
        }
        let value = |of: &&[(String, Property)]| {
            of.iter().find(|(name, _)| name == property).map(|(_, value)| value.clone())
        };
        let values = further.iter().map(value);
        table = table.with(property, column(kind, values));
    }
    table
}

fn column(kind: &str, values: impl Iterator<Item = Option<Property>>) -> Column {
    match kind {
        "text" => Column::Text(values.map(|value| value.and_then(Property::into_text)).collect()),
        "truth" => Column::Truth(values.map(|value| value.and_then(Property::into_truth)).collect()),
        _ => Column::Number(values.map(|value| value.and_then(Property::into_number)).collect()),
    }
}
