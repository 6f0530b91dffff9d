//! What the site's tables say of vehicles: which there are, where they are to go, and what their errors mean.

use std::collections::BTreeMap;

use serde_json::Value;

/// The site's table of vehicles.
pub const VEHICLES: &str = "vehicles";

/// The site's table of what errors of vehicles mean; without it the one below counts.
const ERRORS: &str = "vehicle_errors";

/// What errors mean where the site does not say.
const MEANINGS: &str = include_str!("../../tables/vehicle_errors.csv");

/// The site's table of what zones areas are, by their kind; without it the one below counts.
const ZONES: &str = "zones";

/// What areas are where the site does not say.
const KINDS: &str = include_str!("../../tables/zones.csv");

/// All that tables say of vehicles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fleet {
    pub vehicles: Vec<Vehicle>,
    /// The states of each robot.
    pub states: BTreeMap<String, Vec<State>>,
    /// By the error's type, or by its level.
    pub meanings: BTreeMap<String, Meaning>,
    /// What zone areas of a kind are.
    pub zones: BTreeMap<String, String>,
    /// Columns of the table of vehicles: what it has no column for is not written.
    pub columns: Vec<String>,
}

/// A row of the table of vehicles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vehicle {
    /// Its key.
    pub name: String,
    pub manufacturer: String,
    pub serial: String,
    /// Whose routes it drives.
    pub robot: Option<String>,
    /// As it says itself where this is empty.
    pub version: Option<String>,
    /// How it calls the map.
    pub map: Option<String>,
    /// Where it is to go.
    pub goal: Option<String>,
    /// How many edits of this program had been answered when the table was asked for.
    pub answers: u64,
    /// What is written in it now.
    pub written: BTreeMap<String, Value>,
}

/// A state of a robot, and what rules say of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    pub state: String,
    pub width: f64,
    pub length: Option<f64>,
    pub height: f64,
    /// Metres per second.
    pub speed: Option<f64>,
    /// The vehicle's action by which it comes into this state.
    pub action: Option<String>,
    pub blocking: Option<String>,
}

/// What follows of an error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Meaning {
    /// For how many seconds the way ahead is closed.
    pub closes_for: Option<u32>,
    /// Whether it is closed for all robots, or for the vehicle's own kind alone.
    pub for_all: bool,
    /// Whether nothing more is released while it lasts.
    pub stops: bool,
}

/// A table as the service answers it: for each row its key and its cells, with what rules conclude of it.
struct Table {
    columns: Vec<String>,
    rows: Vec<(String, BTreeMap<String, Value>)>,
}

impl Fleet {
    /// Reads what `/api/tables` answers; a sentence where the site has no vehicles.
    pub fn read(answer: &Value) -> Result<Self, String> {
        let vehicles = table(answer, VEHICLES).ok_or(
            "the site has no table `vehicles`: put `tables/vehicles.csv` into it, with a line `vehicle,manufacturer,robot,goal` and \
             a line a vehicle, and build it",
        )?;
        let meanings = table(answer, ERRORS).map_or_else(|| read_csv(MEANINGS), |table| table.rows);
        let mut states: BTreeMap<String, Vec<State>> = BTreeMap::new();
        for (_, row) in table(answer, "robots").map(|table| table.rows).unwrap_or_default() {
            states.entry(text(&row, "robot").unwrap_or_default()).or_default().push(State {
                state: text(&row, "state").unwrap_or_default(),
                width: number(&row, "width").unwrap_or_default(),
                length: number(&row, "length"),
                height: number(&row, "height").unwrap_or_default(),
                speed: number(&row, "speed").filter(|speed| *speed > 0.0),
                action: text(&row, "vehicle_action"),
                blocking: text(&row, "vehicle_blocking"),
            });
        }
        let mut found = Vec::new();
        for (key, row) in vehicles.rows {
            // MQTT has its own meaning for these
            let usable = |name: &String| !name.is_empty() && !name.contains(['/', '+', '#', '\0']);
            let serial = text(&row, "serial").unwrap_or_else(|| key.clone());
            let manufacturer = text(&row, "manufacturer").unwrap_or_default();
            if !usable(&serial) || !usable(&manufacturer) {
                return Err(format!(
                    "table `vehicles`, row `{key}`: manufacturer `{manufacturer}` and serial number `{serial}` stand in topics, and must be \
                     there, without `/`, `+` and `#`"
                ));
            }
            found.push(Vehicle {
                serial,
                manufacturer,
                robot: text(&row, "robot"),
                version: text(&row, "version"),
                map: text(&row, "map"),
                goal: text(&row, "goal"),
                name: key,
                answers: 0,
                written: row,
            });
        }
        let meanings = meanings.into_iter().map(|(key, row)| (key, meaning(&row))).collect();
        let zones = table(answer, ZONES).map_or_else(|| read_csv(KINDS), |table| table.rows);
        let zone = |(_, row): (_, BTreeMap<_, _>)| Some((text(&row, "kind")?, text(&row, "zone")?));
        let zones = zones.into_iter().filter_map(zone).collect();
        Ok(Self { vehicles: found, states, meanings, zones, columns: vehicles.columns })
    }

    /// What an error means, by its type or else by its level.
    pub fn meaning(&self, kind: &str, level: &str) -> Meaning {
        self.meanings.get(kind).or_else(|| self.meanings.get(level)).copied().unwrap_or_default()
    }

    /// The robot where there is but one.
    pub fn only_robot(&self) -> String {
        self.states.keys().next().cloned().unwrap_or_default()
    }

    /// How large a robot is in its largest state, metres.
    pub fn breadth(&self, robot: &str) -> Option<f64> {
        let states = self.states.get(robot)?.iter();
        states.map(|state| state.width.max(state.length.unwrap_or(0.0))).max_by(f64::total_cmp)
    }

    /// A state of a robot.
    pub fn state(&self, robot: &str, state: &str) -> Option<&State> {
        self.states.get(robot)?.iter().find(|known| known.state == state)
    }
}

fn meaning(row: &BTreeMap<String, Value>) -> Meaning {
    let truth = |column: &str| row.get(column).is_some_and(is_true);
    let closes_for =
        number(row, "closes_for").filter(|seconds| *seconds >= 1.0).map(|seconds| seconds as u32);
    Meaning { closes_for, for_all: truth("for_all"), stops: truth("stops") }
}

pub(super) fn is_true(value: &Value) -> bool {
    match value {
        Value::Bool(truth) => *truth,
        Value::Number(number) => number.as_f64().is_some_and(|number| number > 0.0),
        Value::String(text) => text == "true",
        _ => false,
    }
}

fn table(answer: &Value, name: &str) -> Option<Table> {
    let found = answer["tables"].as_array()?.iter().find(|table| table["table"] == name)?;
    let names = |of: &Value, key: &str| -> Vec<String> {
        let all = of.as_array().into_iter().flatten();
        all.map(|entry| {
            if key.is_empty() { entry } else { &entry[key] }.as_str().unwrap_or_default().to_owned()
        })
        .collect()
    };
    let (columns, keys) = (names(&found["columns"], "name"), names(&found["keys"], ""));
    let cells = |row: usize| {
        let table = columns
            .iter()
            .enumerate()
            .map(|(column, name)| (name.clone(), found["rows"][row][column].clone()));
        let concluded = found["concluded"].as_array().into_iter().flatten();
        let concluded = concluded
            .map(|of| (of["property"].as_str().unwrap_or_default().to_owned(), of["values"][row].clone()));
        table.chain(concluded.filter(|(_, value)| !value.is_null())).collect()
    };
    let rows = keys.into_iter().enumerate().map(|(row, key)| (key, cells(row))).collect();
    Some(Table { columns, rows })
}

/// A table of ours: a line of names, then a line a row; the first column is its key.
fn read_csv(text: &str) -> Vec<(String, BTreeMap<String, Value>)> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let cell = |text: &str| text.parse::<f64>().map_or_else(|_| Value::from(text), Value::from);
    let row = |line: &str| {
        let key = line.split(',').next().unwrap_or_default().to_owned();
        let cells = names.iter().zip(line.split(',')).map(|(name, value)| ((*name).to_owned(), cell(value)));
        (key, cells.collect())
    };
    lines.map(row).collect()
}

pub(super) fn text(row: &BTreeMap<String, Value>, column: &str) -> Option<String> {
    match row.get(column)? {
        Value::String(text) if !text.is_empty() => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}

pub(super) fn number(row: &BTreeMap<String, Value>, column: &str) -> Option<f64> {
    row.get(column)?.as_f64()
}
