//! What a world says of its doorways and regions besides their shape, for the rules that weigh ways.

use std::collections::BTreeMap;

use adit_engine::{Datum, Type};
use adit_planners::floor_plan::{Network, Way};
use adit_planners::geometry::Point;
use adit_planners::navigation::WayFacts;
use adit_planners::read::{Code, Fields, Located, Problem};
use adit_planners::world::Property;
use toml::de::DeValue;

use crate::plan::consult::Of::{Number, Perhaps, Truth};
use crate::plan::consult::{self, typed};

/// What rules are told of a way between adits, as it follows from the floor plan and from what was seen.
pub(super) const fn measured<'w>() -> [consult::Property<WayFacts<'w>>; 6] {
    [
        ("length", Number(|of| of.way.length)),
        ("clearance", Number(|of| of.way.clearance)),
        ("doorway", Perhaps(|of| of.way.doorway.map(|number| number as f64))),
        ("region", Perhaps(|of| of.way.region.map(|number| number as f64))),
        ("is_cut", Truth(|of| of.is_cut)),
        ("times_blocked", Number(|of| of.times_blocked.into())),
    ]
}

/// What rules may know of every way: what is measured, and what shipped rules read of what worlds tell.
pub(super) fn ways() -> Vec<(&'static str, Type)> {
    [typed(measured()), vec![("squeaks", Type::Truth), ("closed", Type::Truth)]].concat()
}

/// The tables that say it.
pub const KEYS: [&str; 2] = ["doorway", "region"];

/// A point of `[[doorway]]` may be so far beside the doorway, metres.
const BESIDE_M: f64 = 0.5;

/// What is said of doorways and regions, as properties of the ways through them.
#[derive(Clone, Debug, Default)]
pub struct Told {
    /// The properties that are told, with the type of their values: those of [`ways`] as well as others.
    properties: Vec<(String, Type)>,
    doorways: BTreeMap<usize, Vec<(usize, Property)>>,
    regions: BTreeMap<usize, Vec<(usize, Property)>>,
    /// As it was said.
    marks: Vec<Mark>,
}

/// What is said of the doorway or region at a point: a property, and its value as text.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// `doorway` or `region`.
    pub what: String,
    pub at: Point,
    pub property: String,
    pub value: String,
}

/// What a value is that is written as text: a number, `true` or `false`, else a text.
fn value_of(text: &str) -> Property {
    match (text, text.parse::<f64>()) {
        ("true", _) => Property::Truth(true),
        ("false", _) => Property::Truth(false),
        (_, Ok(number)) if number.is_finite() => Property::Number(number),
        _ => Property::Text(text.to_owned()),
    }
}

/// The type of a value that is written as text.
pub fn kind_of(text: &str) -> Type {
    kind(&value_of(text))
}

/// What is said of whatever is at a point.
#[derive(Clone, Debug)]
pub struct Said {
    key: &'static str,
    at: Located<Point>,
    values: Vec<(String, Located<Property>)>,
}

/// Reads `[[doorway]]` and `[[region]]`.
pub fn read(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<Said> {
    let mut said = Vec::new();
    for (key, what) in [("doorway", "[[doorway]]"), ("region", "[[region]]")] {
        for item in fields.tables(key, what, problems) {
            let at = item.numbers::<2>("at", problems);
            let values = values(&item, problems);
            if let Some(Located { value: [x, y], span }) = at {
                said.push(Said { key, at: Located { value: Point::new(x, y), span }, values });
            }
        }
    }
    said
}

/// The values of all keys but `at`.
fn values(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Vec<(String, Located<Property>)> {
    let mut found = Vec::new();
    for (key, value) in item.table.iter().filter(|(key, _)| &**key.get_ref() != "at") {
        let name = key.get_ref().to_string();
        let property = match value.get_ref() {
            DeValue::Boolean(truth) => Some(Property::Truth(*truth)),
            DeValue::String(text) => Some(Property::Text(text.to_string())),
            DeValue::Integer(_) | DeValue::Float(_) => {
                item.finite(&name, value, problems).map(Property::Number)
            }
            other => {
                let wanted = "a number, a text in quotes, true or false";
                problems.push(item.wrong_type(&name, wanted, other, value.span()));
                None
            }
        };
        if let Some(value) = property {
            found.push((name, Located { value, span: key.span() }));
        }
    }
    found
}

const fn kind(value: &Property) -> Type {
    match value {
        Property::Number(_) => Type::Number,
        Property::Text(_) => Type::Text,
        Property::Truth(_) => Type::Truth,
    }
}

impl Told {
    /// What is said of doorways and regions, and which doorways are closed.
    pub fn by(marks: &[Mark], closed: &[usize], network: &Network) -> Result<Self, String> {
        let mut told = Self { marks: marks.to_vec(), ..Self::default() };
        for mark in marks {
            let value = value_of(&mark.value);
            let place =
                if mark.what == "doorway" { doorway(network, mark.at) } else { region(network, mark.at) }?;
            let property = told.property(&mark.property, kind(&value))?;
            let of = if mark.what == "doorway" { &mut told.doorways } else { &mut told.regions };
            of.entry(place).or_default().push((property, value));
        }
        if !closed.is_empty() {
            let property = told.property("closed", Type::Truth)?;
            for place in closed {
                told.doorways.entry(*place).or_default().push((property, Property::Truth(true)));
            }
        }
        Ok(told)
    }

    /// Whether a doorway is told to be closed.
    pub fn is_closed(&self, doorway: usize) -> bool {
        let told = self.doorways.get(&doorway).into_iter().flatten();
        told.into_iter().any(|(property, value)| {
            self.properties[*property].0 == "closed" && *value == Property::Truth(true)
        })
    }

    /// As it was said.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// Finds the doorways and regions that were spoken of.
    pub fn new(
        said: &[Said],
        network: &Network,
        fields: &Fields<'_, '_>,
        problems: &mut Vec<Problem>,
    ) -> Self {
        let mut told = Self::default();
        for one in said {
            let place = if one.key == "doorway" {
                doorway(network, one.at.value)
            } else {
                region(network, one.at.value)
            };
            let place = match place {
                Ok(place) => place,
                Err(message) => {
                    problems.push(fields.text.problem(Code::Outside, &one.at.span, message));
                    continue;
                }
            };
            for (name, value) in &one.values {
                match told.property(name, kind(&value.value)) {
                    Ok(property) => {
                        told.marks.push(Mark {
                            what: one.key.to_owned(),
                            at: one.at.value,
                            property: name.clone(),
                            value: match &value.value {
                                Property::Number(number) => number.to_string(),
                                Property::Text(text) => text.clone(),
                                Property::Truth(truth) => truth.to_string(),
                            },
                        });
                        let of = if one.key == "doorway" { &mut told.doorways } else { &mut told.regions };
                        of.entry(place).or_default().push((property, value.value.clone()));
                    }
                    Err(message) => problems.push(fields.text.problem(Code::WrongType, &value.span, message)),
                }
            }
        }
        told
    }

    /// The properties that are told and that no way has otherwise.
    pub fn further(&self) -> impl Iterator<Item = (&str, Type)> {
        let ways = ways();
        let is_further = move |name: &str| ways.iter().all(|(known, _)| *known != name);
        self.properties
            .iter()
            .map(|(name, kind)| (name.as_str(), *kind))
            .filter(move |(name, _)| is_further(name))
    }

    /// Puts down what is told of a way; `place` says where a property stands in the object.
    pub fn of<'s>(&'s self, way: &Way, object: &mut [Datum<'s>], place: impl Fn(&str) -> Option<usize>) {
        let doorway = way.doorway.and_then(|doorway| self.doorways.get(&doorway));
        let region = way.region.and_then(|region| self.regions.get(&region));
        for (property, value) in doorway.into_iter().chain(region).flatten() {
            if let Some(place) = place(&self.properties[*property].0) {
                object[place] = match value {
                    Property::Number(number) => Datum::Number(*number),
                    Property::Text(text) => Datum::Text(text),
                    Property::Truth(truth) => Datum::Truth(*truth),
                };
            }
        }
    }

    /// The number of a property; it has values of one type.
    fn property(&mut self, name: &str, kind: Type) -> Result<usize, String> {
        let word = |kind| match kind {
            Type::Number => "a number",
            Type::Text => "a text",
            Type::Truth => "true or false",
        };
        if measured().iter().any(|(known, _)| *known == name) {
            return Err(format!("`{name}` of a way follows from the floor plan, and is not said"));
        }
        let known = self.properties.iter().position(|(known, _)| known == name);
        let of_all = || ways().into_iter().find(|(known, _)| *known == name);
        let before = known.map(|known| self.properties[known].1).or_else(|| of_all().map(|(_, kind)| kind));
        if let Some(before) = before.filter(|before| *before != kind) {
            return Err(format!("`{name}` is {} here, and {} elsewhere", word(kind), word(before)));
        }
        Ok(known.unwrap_or_else(|| {
            self.properties.push((name.to_owned(), kind));
            self.properties.len() - 1
        }))
    }
}

fn doorway(network: &Network, at: Point) -> Result<usize, String> {
    let doorways = network.regions.doorways.iter().enumerate();
    let far =
        doorways.map(|(number, doorway)| (at.distance(at.nearest_on(doorway.from, doorway.to)), number));
    let Some((far, number)) = far.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Err("the floor plan has no doorways".to_owned());
    };
    if far <= BESIDE_M {
        return Ok(number);
    }
    let middle = network.regions.doorways[number].middle();
    Err(format!(
        "no doorway is within {BESIDE_M} m of ({}, {}); the nearest one is about ({:.2}, {:.2}), {far:.2} m away",
        at.x, at.y, middle.x, middle.y
    ))
}

fn region(network: &Network, at: Point) -> Result<usize, String> {
    let found = network.regions.regions.iter().position(|region| region.contains(at));
    found.ok_or_else(|| format!("({}, {}) lies in no region: it is in a wall, or outside", at.x, at.y))
}
