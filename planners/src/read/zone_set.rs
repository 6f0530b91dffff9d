//! Zone sets of VDA 5050 3.0, as areas: other programs draw them, and vehicles are told them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

use geo::Area as _;

use super::diagnostic::{Code, MapErrors, Problem, Text};
use super::fields::{Fields, Located};
use super::overlay::{Overlay, centre, ring};
use super::source::Source;
use super::suggest::nearest;
use super::value::{At, Read};
use crate::geometry::Point;
use crate::world::{Area, Property, World};

/// What the file calls a zone, among its properties.
pub const ZONE_ID: &str = "zone_id";

const KEYS: [&str; 2] = ["file", "map"];

/// What a zone may be. Vehicles ask before they enter those of the last two, and the site answers nobody.
const TYPES: [&str; 10] = [
    "BLOCKED",
    "SPEED_LIMIT",
    "PENALTY",
    "PRIORITY",
    "DIRECTED",
    "BIDIRECTED",
    "LINE_GUIDED",
    "ACTION",
    "RELEASE",
    "COORDINATED_REPLANNING",
];

/// An entry `[[zone_set]]` of `site.toml`.
#[derive(Clone, Debug)]
pub struct ZoneSet {
    file: PathBuf,
    /// Which map's zones these are, where the file has those of several.
    map: Option<String>,
    text: Text,
    span: Range<usize>,
}

impl ZoneSet {
    /// Reads the entries `[[zone_set]]`; files are relative to `folder`.
    pub(super) fn from_fields(
        fields: &Fields<'_, '_>,
        folder: &Path,
        problems: &mut Vec<Problem>,
    ) -> Vec<Self> {
        let mut sets = Vec::new();
        for item in fields.tables("zone_set", "[[zone_set]]", problems) {
            item.refuse_unknown(&KEYS, problems);
            let Some(file) = item.string("file", problems) else { continue };
            let map = item.get("map").and_then(|_| item.string("map", problems)).map(|map| map.value);
            sets.push(Self { file: folder.join(&file.value), map, text: item.text.clone(), span: file.span });
        }
        sets
    }

    pub(super) fn file(&self) -> &Path {
        &self.file
    }

    /// Lays its zones over a world as areas, and gives notes.
    pub(super) fn lay_over(&self, world: &mut World) -> Result<Vec<Problem>, MapErrors> {
        let name = self.file.display().to_string();
        let text = super::text_of(&self.file).map_err(|error| {
            let message = format!("the zone set `{name}` cannot be read: {error}");
            self.text.problem(Code::Unreadable, &self.span, message)
        })?;
        let source = Source::read(&name, &text)?;
        let sets = self.of_the_map(sets(&source.top())?)?;
        let mut found = Vec::new();
        let (mut areas, mut notes) = (Vec::new(), Vec::new());
        let mut zones = Vec::new();
        for set in &sets {
            let list = set.need("zones")?;
            zones.extend(
                list.items()?.into_iter().zip(list.item_spans()).map(|(zone, span)| (set, zone, span)),
            );
        }
        let called = names(&zones, world)?;
        for ((_, zone, span), name) in zones.iter().zip(called) {
            match area(source.named(), zone, name, span.clone(), &mut notes) {
                Ok(area) => areas.push(area),
                Err(problem) => found.push(problem),
            }
        }
        if !found.is_empty() {
            return Err(MapErrors { problems: found });
        }
        let on_map = |area: &Located<Area>| area.value.shape.part_in(world.bounds).unsigned_area() > 0.0;
        // where all lie off it, the file is of another map, or measured from elsewhere
        if areas.iter().any(on_map) {
            let (on, off): (Vec<_>, Vec<_>) = areas.into_iter().partition(on_map);
            areas = on;
            notes.extend(off_the_map(source.named(), &off));
        }
        notes.extend(Overlay::of_areas(source.named(), areas).lay_over(world)?);
        Ok(notes)
    }

    /// The sets of the map that is meant; of one alone, where none is said.
    fn of_the_map<'v>(&self, sets: Vec<At<'v>>) -> Read<Vec<At<'v>>> {
        let mut maps: Vec<String> = Vec::new();
        for set in &sets {
            let map = set.need("mapId")?.text()?;
            if !maps.contains(&map) {
                maps.push(map);
            }
        }
        let refused = |message: String| {
            let problem = self.text.problem(Code::Impossible, &self.span, message);
            problem.with_help(format!("say `map = \"{}\"`", maps.first().map_or("…", |map| map)))
        };
        let file = self.file.display();
        let of = match &self.map {
            Some(map) if !maps.contains(map) => {
                return Err(refused(format!(
                    "`{file}` has no zones of the map `{map}`, but of {}",
                    maps.join(", ")
                )));
            }
            None if maps.len() > 1 => {
                return Err(refused(format!("`{file}` has zones of several maps: {}", maps.join(", "))));
            }
            of => of,
        };
        let mut meant = Vec::new();
        for set in sets {
            if of.as_ref().is_none_or(|map| set.value["mapId"] == **map) {
                meant.push(set);
            }
        }
        Ok(meant)
    }
}

/// The zone sets of a file: messages as vehicles get them, or what they carry, one or a list.
fn sets<'v>(top: &At<'v>) -> Read<Vec<At<'v>>> {
    let all = if top.value.is_array() { top.items()? } else { vec![top.clone()] };
    all.into_iter().map(|one| Ok(one.get("zoneSet").unwrap_or(one))).collect()
}

/// What zones are called: by their words, where those are no other zone's words or id; else by their ids, and by their set besides
/// where something is called so already, since ids are of one set.
fn names(zones: &[(&At<'_>, At<'_>, Range<usize>)], world: &World) -> Read<Vec<String>> {
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    let words = zones.iter().map(|(_, zone, _)| zone.name("zoneDescriptor")).collect::<Read<Vec<_>>>()?;
    for words in words.iter().flatten() {
        *count.entry(words.clone()).or_default() += 1;
    }
    let ids = zones.iter().map(|(_, zone, _)| zone.need("zoneId")?.id()).collect::<Read<Vec<_>>>()?;
    let is_own = |words: &String, id: &String| count[words] == 1 && (words == id || !ids.contains(words));
    let (mut names, mut called) = (Vec::new(), BTreeSet::new());
    for ((id, words), (set, ..)) in ids.iter().zip(words).zip(zones) {
        let name = words.filter(|words| is_own(words, id)).unwrap_or_else(|| id.clone());
        let is_taken = world.kind_of_named(&name).is_some() || called.contains(&name);
        let name = match set.get("zoneSetId").filter(|_| is_taken) {
            Some(set) => format!("{name} ({})", set.id()?),
            None => name,
        };
        called.insert(name.clone());
        names.push(name);
    }
    Ok(names)
}

/// Says which zones lie off the map, and so mean nothing here.
fn off_the_map(text: &Text, off: &[Located<Area>]) -> Option<Problem> {
    let first = off.first()?;
    let said: Vec<String> = off.iter().take(5).map(|area| format!("`{}`", area.value.name)).collect();
    let more = if off.len() > said.len() { ", ..." } else { "" };
    let message = match off.len() {
        1 => format!("the zone {} lies off the map, and is left out", said[0]),
        count => format!("{count} zones lie off the map, and are left out: {}{more}", said.join(", ")),
    };
    Some(text.problem(Code::Outside, &first.span, message).as_advice())
}

fn area(
    text: &Text,
    zone: &At<'_>,
    name: String,
    span: Range<usize>,
    notes: &mut Vec<Problem>,
) -> Read<Located<Area>> {
    let kind = zone.need("zoneType")?;
    let zone_type = kind.text()?;
    let mut further = vec![(ZONE_ID.to_owned(), Property::Text(zone.need("zoneId")?.id()?))];
    let mut says = |property: &str, value| further.push((property.to_owned(), value));
    let share = |key: &str| {
        let factor = zone.need(key)?;
        match factor.number()? {
            number if (0.0..=1.0).contains(&number) => Ok(Property::Number(number)),
            _ => Err(factor.wrong("a number from 0 to 1")),
        }
    };
    let mut is_zone = true;
    match zone_type.as_str() {
        "BLOCKED" => is_zone = false,
        "SPEED_LIMIT" => {
            is_zone = false;
            says("speed_limit", Property::Number(zone.need("maximumSpeed")?.positive()?));
        }
        "PENALTY" => says("zone_factor", share("penaltyFactor")?),
        "PRIORITY" => says("zone_factor", share("priorityFactor")?),
        "DIRECTED" | "BIDIRECTED" => {
            let key = if zone_type == "DIRECTED" { "directedLimitation" } else { "bidirectedLimitation" };
            let known: &[&str] = &["SOFT", "RESTRICTED", "STRICT"];
            let known = if zone_type == "DIRECTED" { known } else { &known[..2] };
            says("zone_direction", Property::Number(zone.need("direction")?.number()?.to_degrees()));
            says("zone_limitation", Property::Text(one_of(&zone.need(key)?, known)?));
        }
        "ACTION" => {
            let entry = zone.list("entryActions")?;
            if let Some(action) = entry.first() {
                says("zone_action", Property::Text(action.need("actionType")?.text()?));
                if let Some(blocking) = action.get("blockingType") {
                    let known = ["NONE", "SOFT", "SINGLE", "HARD"];
                    says("zone_blocking", Property::Text(one_of(&blocking, &known)?));
                }
            }
            notes.extend(further_actions(text, zone, &name, &span)?);
        }
        "LINE_GUIDED" => {}
        "RELEASE" | "COORDINATED_REPLANNING" => {
            let message = format!(
                "the zone `{name}` is of type {zone_type}: vehicles ask before they enter it, and Adit grants nothing; rules may say what \
                 the area means"
            );
            notes.push(text.problem(Code::Impossible, &span, message).as_advice());
        }
        _ => return Err(unknown(&kind, &zone_type)),
    }
    if is_zone {
        says("zone", Property::Text(zone_type.clone()));
    }
    further.sort_by(|one, other| one.0.cmp(&other.0));
    let vertices = zone.need("vertices")?;
    let corner = |vertex: &At<'_>| {
        let value = Point::new(vertex.need("x")?.number()?, vertex.need("y")?.number()?);
        Ok(Located { value, span: 0..0 })
    };
    let corners = vertices.items()?.iter().map(corner).collect::<Read<Vec<_>>>()?;
    let shape = ring(text, "area", &span, corners).map_err(|mut problem| {
        problem.message = format!("the zone `{name}`: {}", problem.message);
        problem
    })?;
    let kind = match zone_type.as_str() {
        "BLOCKED" => "keep-out".to_owned(),
        _ => zone_type.to_lowercase().replace('_', "-"),
    };
    let centre = centre(&shape);
    Ok(Located { value: Area { name, kind: Some(kind), shape, centre, further }, span })
}

/// Says that a zone has more actions than an area holds, which is one on the way in.
fn further_actions(text: &Text, zone: &At<'_>, name: &str, span: &Range<usize>) -> Read<Option<Problem>> {
    let [entry, during, exit] =
        ["entryActions", "duringActions", "exitActions"].map(|key| zone.list(key).map(|list| list.len()));
    let (entry, during, exit) = (entry?, during?, exit?);
    if entry < 2 && during + exit == 0 {
        return Ok(None);
    }
    let message = format!(
        "the zone `{name}` has {entry} actions on the way in, {during} inside and {exit} on the way out; its area holds the first on \
         the way in"
    );
    Ok(Some(text.problem(Code::Impossible, span, message).as_advice()))
}

fn one_of(value: &At<'_>, known: &[&str]) -> Read<String> {
    let text = value.text()?;
    if known.contains(&text.as_str()) {
        Ok(text)
    } else {
        Err(value.wrong(&format!("one of {}", known.join(", "))))
    }
}

fn unknown(kind: &At<'_>, found: &str) -> Problem {
    let problem = kind.wrong("a type of zones");
    match nearest(found, &TYPES) {
        Some(meant) => problem.with_help(format!("did you mean \"{meant}\"?")),
        None => problem.with_help(format!("known: {}", TYPES.join(", "))),
    }
}
