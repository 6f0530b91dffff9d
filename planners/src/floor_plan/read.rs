//! Floor plans as JSON: `name`, `units`, `walls` as `[[x0, y0], [x1, y1]]`, `solids` as lists of corners, and
//! `places` with `name` and `at`. Other keys are left alone.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_saphyr::Spanned;

use super::check::Source;
use super::plan::{Drawn, FloorPlan};
use crate::geometry::Point;
use crate::read::{Code, MapErrors, Problem, Text, in_words, nearest, span_of};
use crate::world::Place;

const KEYS: [&str; 5] = ["name", "units", "walls", "solids", "places"];

#[derive(Deserialize)]
struct Written {
    #[serde(default)]
    name: String,
    units: Option<Spanned<String>>,
    walls: Vec<Spanned<[[f64; 2]; 2]>>,
    #[serde(default)]
    solids: Vec<Spanned<Vec<[f64; 2]>>>,
    #[serde(default)]
    places: Vec<Spanned<WrittenPlace>>,
}

#[derive(Deserialize)]
struct WrittenPlace {
    name: String,
    at: [f64; 2],
}

/// Reads and checks the floor plan of a file.
pub fn read_floor_plan(path: &Path) -> Result<FloorPlan, MapErrors> {
    let name = path.display().to_string();
    if path.exists() && !path.is_file() {
        return Err(Problem::of_file(Code::Unreadable, format!("the floor plan `{name}` is no file")).into());
    }
    let text = std::fs::read_to_string(path).map_err(|error| {
        Problem::of_file(Code::Unreadable, format!("the floor plan `{name}` cannot be read: {error}"))
    })?;
    parse_floor_plan(&name, &text)
}

/// Reads and checks the text of a floor plan.
///
/// # Arguments
/// `name` is how messages call the file, `text` its content.
pub fn parse_floor_plan(name: &str, text: &str) -> Result<FloorPlan, MapErrors> {
    let source = Text::new(name, text);
    let written: Written = serde_saphyr::from_str(text).map_err(|error| explain(&source, &error))?;
    let mut problems = misspelt(&source, text);
    if let Some(units) = written.units.filter(|units| units.value != "m") {
        let message = format!("`units` is `{}`, and floor plans are in `m`", units.value);
        problems.push(source.problem(Code::WrongType, &span_of(units.referenced), message));
    }
    if !problems.is_empty() {
        return Err(MapErrors { problems });
    }
    let point = |[x, y]: [f64; 2]| Point::new(x, y);
    let place =
        |place: &Spanned<WrittenPlace>| Place { name: place.value.name.clone(), at: point(place.value.at) };
    // what is kept of several plans in one database is told apart by their names
    let stem =
        || Path::new(name).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let drawn = Drawn {
        name: if written.name.is_empty() { stem() } else { written.name },
        walls: written.walls.iter().map(|wall| wall.value.map(point)).collect(),
        solids: written.solids.iter().map(|solid| solid.value.iter().map(|&p| point(p)).collect()).collect(),
        places: written.places.iter().map(place).collect(),
    };
    let source = Source {
        text: Some(source),
        walls: written.walls.iter().map(|wall| span_of(wall.referenced)).collect(),
        solids: written.solids.iter().map(|solid| span_of(solid.referenced)).collect(),
        places: written.places.iter().map(|place| span_of(place.referenced)).collect(),
    };
    FloorPlan::from_source(drawn, source)
}

/// Keys that mean nothing here, but nearly what another one means.
fn misspelt(source: &Text, text: &str) -> Vec<Problem> {
    let all: BTreeMap<String, Option<IgnoredAny>> = serde_saphyr::from_str(text).unwrap_or_default();
    let unknown = all.keys().filter(|key| !KEYS.contains(&key.as_str()));
    let problem = |key: &String| {
        let meant = nearest(key, &KEYS)?;
        let start = text.find(&format!("\"{key}\"")).unwrap_or(0);
        let message = format!("`{key}` is not a key of a floor plan");
        let problem = source.problem(Code::UnknownKey, &(start..start + key.len() + 2), message);
        Some(problem.with_help(format!("did you mean `{meant}`?")))
    };
    unknown.filter_map(problem).collect()
}

fn explain(source: &Text, error: &serde_saphyr::Error) -> Problem {
    let error = error.without_snippet();
    let span = error.location().map_or(0..0, span_of);
    match error {
        serde_saphyr::Error::SerdeMissingField { field, .. } => {
            source.problem(Code::MissingKey, &span, format!("a floor plan needs `{field}` here"))
        }
        other => {
            source.problem(Code::Syntax, &span, format!("not a floor plan: {}", in_words(other))).with_help(
                "a wall is [[x0, y0], [x1, y1]], a place {\"name\": \"…\", \"at\": [x, y]}, in metres",
            )
        }
    }
}
