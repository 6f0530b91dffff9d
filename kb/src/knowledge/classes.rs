//! Facts on their way between planners, the rule engine and the database: the same columns, three owners.

use adit_engine::{Class, KnowledgeBase as Inference, Schema, Type, Value};
use adit_planners::facts::{Column, Facts, Table};

use crate::error::{Code, Error, Result};

/// Where NULL is not unknown: a height that nothing limits.
const UNLIMITED: [(&str, &str); 3] = [("ROOMS", "height"), ("DOORS", "height1"), ("DOORS", "height2")];

/// Classes whose key is not their first property alone.
const KEYS: [(&str, &[&str]); 9] = [
    ("ROBOTS", &["robot", "state"]),
    ("CHANGES", &["robot", "from_state", "to_state"]),
    ("LOADS", &["robot", "load"]),
    ("LANE_VEHICLES", &["lane", "vehicle_type"]),
    ("MEASURES", &["measure"]),
    ("STRIPS", &["axis", "strip"]),
    ("AREA_ROOMS", &["room", "area"]),
    ("DOOR_ROOMS", &["room", "door"]),
    (ROUTES, &["robot", "start", "goal"]),
];

/// Routes between places, which only rules that react may read.
pub const ROUTES: &str = "ROUTES";

/// What is known of them.
pub const ROUTES_GIVE: [&str; 4] =
    ["ROUTES.robot: text", "ROUTES.start: text", "ROUTES.goal: text", "ROUTES.cost"];

/// The properties that tell objects of a class with a longer key apart; none of other classes.
pub fn key_of(class: &str) -> &'static [&'static str] {
    KEYS.iter().find(|(name, _)| *name == class).map_or(&[], |(_, key)| key)
}

/// Asserts a class; its key is its first property, where that tells the objects apart. New objects of one that is numbered get
/// the next number.
pub fn assert(knowledge: &mut Inference, name: &str, table: &Table, is_numbered: bool) -> Result<()> {
    let composite = KEYS.iter().find(|(class, _)| *class == name).map(|(_, key)| key.to_vec());
    let key = composite.unwrap_or_else(|| first_if_unique(table));
    let mut class = Class::new(name, &key);
    if is_numbered {
        class = class.numbered();
    }
    for (property, column) in &table.columns {
        class = match column {
            Column::Number(values) => class.numbers(property, values.iter().copied()),
            Column::Text(values) => class.texts(property, values.iter().cloned()),
            Column::Truth(values) => class.truths(property, values.iter().copied()),
        };
    }
    hold(knowledge, name, class, |property| table.column(property).is_some())
}

/// Asserts a class that is made ready, but for what NULL means in it.
pub fn hold(
    knowledge: &mut Inference,
    name: &str,
    mut class: Class,
    has: impl Fn(&str) -> bool,
) -> Result<()> {
    for (_, property) in UNLIMITED.iter().filter(|(class, property)| *class == name && has(property)) {
        class = class.null_means(*property, Value::Number(f64::INFINITY));
    }
    knowledge.assert(class).map_err(Error::of(Code::FactsClass))
}

fn first_if_unique(table: &Table) -> Vec<&str> {
    let Some((name, column)) = table.columns.first() else { return Vec::new() };
    let is_key = match column {
        Column::Number(values) => are_different(values, |number| (number + 0.0).to_bits()),
        Column::Text(values) => are_different(values, |text| text),
        Column::Truth(_) => false,
    };
    if is_key { vec![name] } else { Vec::new() }
}

/// Whether all values are known, and no two are the same.
fn are_different<'v, T, K: Ord>(values: &'v [Option<T>], key: impl Fn(&'v T) -> K) -> bool {
    let mut keys: Vec<K> = values.iter().flatten().map(key).collect();
    keys.sort_unstable();
    keys.dedup();
    keys.len() == values.len()
}

/// The keys of a table's rows as people write them: the values of these columns, joined by `/`.
pub fn keys(table: &Table, parts: &[String]) -> Vec<String> {
    let part = |name: &String, row: usize| {
        let text = |cell: Option<String>| cell.unwrap_or_default();
        match table.column(name) {
            Some(Column::Text(values)) => text(values[row].clone()),
            Some(Column::Number(values)) => text(values[row].map(|number| number.to_string())),
            Some(Column::Truth(values)) => text(values[row].map(|truth| truth.to_string())),
            None => String::new(),
        }
    };
    let key = |row: usize| parts.iter().map(|name| part(name, row)).collect::<Vec<_>>().join("/");
    (0..table.len()).map(key).collect()
}

/// A property as `CLASS.property`, or `CLASS.property?` where it need not be there, split.
pub fn split(name: &str) -> (&str, &str) {
    let (class, property) = name.split_once('.').unwrap_or((name, ""));
    (class, property.trim_end_matches('?'))
}

/// What a planner may know: the properties that it needs, as they stand.
pub fn known(knowledge: &Inference, needs: &[String]) -> Facts {
    let mut facts = Facts::new();
    for need in needs {
        let (class, property) = split(need);
        if let Some(column) = column(knowledge, class, property) {
            let table = facts.entry(class.to_owned()).or_default();
            table.columns.push((property.to_owned(), column));
        }
    }
    facts
}

/// One property of all objects of a class, told or concluded; `None` where there is no such property.
pub fn column(knowledge: &Inference, class: &str, property: &str) -> Option<Column> {
    if let Some(values) = knowledge.numbers(class, property) {
        let unlimited = UNLIMITED.contains(&(class, property));
        let values = values.into_iter().map(|v| v.filter(|v| !(unlimited && v.is_infinite())));
        return Some(values.collect());
    }
    if let Some(values) = knowledge.texts(class, property) {
        return Some(values.into_iter().map(|text| text.map(|text| text.to_string())).collect());
    }
    knowledge.truths(class, property).map(Column::Truth)
}

/// Adds what a planner gives to the classes that rules may name. A property's type stands behind a colon
/// (`ROOMS.name: text`); without one it holds numbers.
pub fn declare(schema: &mut Schema, gives: &[String]) {
    for given in gives {
        let (name, kind) =
            given.split_once(':').map_or((given.as_str(), "number"), |(name, kind)| (name, kind.trim()));
        let kind = match kind {
            "text" => Type::Text,
            "truth" => Type::Truth,
            _ => Type::Number,
        };
        let (class, property) = split(name.trim());
        if !schema.has(class) {
            declare_key(schema, class, Some(property));
        }
        schema.add(class, property, kind);
    }
}

/// Adds the key of a class, and what NULL means in it; `first` is its first property.
pub fn declare_key(schema: &mut Schema, class: &str, first: Option<&str>) {
    let composite = KEYS.iter().find(|(name, _)| *name == class).map(|(_, key)| key.to_vec());
    schema.set_key(class, &composite.unwrap_or_else(|| first.into_iter().collect()));
    for (_, property) in UNLIMITED.iter().filter(|(name, _)| *name == class) {
        schema.set_null(class, property, f64::INFINITY);
    }
}
