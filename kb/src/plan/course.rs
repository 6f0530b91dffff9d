//! Routes over maps that are not cut into rooms: what the planner of such a map is asked, and what it asks rules.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use adit_db::course::Course as Row;
use adit_db::load::Load;
use adit_db::place::Place;
use adit_engine::{
    Class as Objects, Consultation, KnowledgeBase as Inference, RuleBase, Schema, Type, Value,
};
use adit_planners::facts::Facts;
use adit_planners::geometry::Point;
use adit_planners::planner::Planner;

use super::consult::Class;
use super::said::Said;
pub use super::said::name_of;
use crate::error::{Code, Error, Result};
use crate::site::tables::TableFile;

/// A map that is not cut into rooms: which tables it is kept in, and who finds routes over it.
///
/// Its file fills the tables once; from then on they are the map, and what they say is told to the rules.
pub trait Course: Any + fmt::Debug + Send + Sync {
    /// What it is: `corridors`.
    fn name(&self) -> &'static str;

    /// The tables that its file fills.
    fn tables(&self) -> Vec<TableFile>;

    /// The places that its file names.
    fn places(&self) -> Vec<Place>;

    /// What vehicles can carry on it, as its file says.
    fn loads(&self) -> Vec<Load> {
        Vec::new()
    }

    /// What is worth a look of how its file was read, in sentences.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// What of it is given to rules as facts, besides its tables.
    fn planner(&self) -> Option<Arc<dyn Planner>>;

    /// The classes of objects that rules are asked about one at a time.
    fn asks(&self) -> Vec<Class>;

    /// Adds to what rules may speak of what tables say besides; `told` are the classes that are told.
    fn declare(&self, _schema: &mut Schema, _told: &Facts) {}

    /// The map as its tables, facts and rules have it now.
    fn pathfinder(&self, asked: &Asked<'_>) -> Result<Box<dyn Pathfinder>>;
}

/// Finds routes over a map as it is at one moment, and asks rules on its way.
pub trait Pathfinder: Send + Sync {
    /// Those that move, in the order of their names.
    fn robots(&self) -> Vec<String>;

    /// Between what routes lead, by name.
    fn ends(&self) -> Vec<Place>;

    /// What lies outermost on the map: the ends, unless it has more.
    fn outermost(&self) -> Vec<Point> {
        self.ends().iter().map(|end| Point::new(end.x, end.y)).collect()
    }

    /// The route of least weight of a robot from an end to another one, or to a point where points are ends.
    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd>;

    /// The route of least weight of those that lead through something: `channel 5`, `junction 2`. An error says what is no end,
    /// or that nothing is called so.
    fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found>;

    /// The map, with a route where one is asked for that there is: an SVG text that stands alone.
    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd>;

    /// The first rule that failed while it was asked, with its file and line: then nothing that was found counts.
    fn trouble(&self) -> Option<String>;

    /// What there is of what, in words: `6 channels, 8 junctions`.
    fn summary(&self) -> String;

    /// The junctions of which something is told by their number, with what else they are called: `channels 3 and 4`.
    fn told_by_number(&self) -> BTreeMap<usize, String> {
        BTreeMap::new()
    }

    /// What of the map as tables have it now counts for nothing, in sentences.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
}

/// A route, or why there is none, with what rules said on the way.
#[derive(Clone, Debug)]
pub struct Found {
    pub row: Row,
    /// Junction by junction, as far as rules were asked.
    pub said: Vec<Arc<Said>>,
}

/// A start or goal that is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoEnd {
    pub is_start: bool,
    /// In a sentence.
    pub reason: String,
}

impl From<NoEnd> for Error {
    fn from(end: NoEnd) -> Self {
        let code = if end.is_start { Code::RouteUnknownStart } else { Code::RouteUnknownGoal };
        Self::said(code, end.reason, None)
    }
}

/// The number in `channel 5`, where `kind` is `channel`.
pub fn numbered(text: &str, kind: &str) -> Option<usize> {
    text.trim().strip_prefix(kind)?.strip_prefix(' ')?.trim().parse().ok()
}

/// Nothing of this name can be led through.
pub fn no_through(through: &str, known: &str) -> Error {
    let message = format!("nothing that routes lead through is called `{through}`");
    Error::said(Code::WhyThrough, message, Some(format!("say {known}")))
}

/// The rules, to be asked about one object at a time, with all that is known besides.
pub struct Asked<'k> {
    pub rules: &'k Arc<RuleBase>,
    pub known: &'k Inference,
}

impl Asked<'_> {
    /// Makes the rules ready to be asked about objects of a class; those that look at other classes as well find them as they
    /// are.
    pub fn consultation(&self, class: &Class) -> Result<Consultation> {
        self.about(class.name, &class.told, class.asked)
    }

    /// As [`consultation`](Self::consultation), about objects of a class with these properties, of which those are asked.
    pub fn about(&self, class: &str, told: &[(&str, Type)], asked: &[&str]) -> Result<Consultation> {
        let mut consultation = Consultation::new(Arc::clone(self.rules), class, told, asked)
            .map_err(Error::of(Code::PlanRules))?;
        let schema = self.known.schema();
        let mut joined: Vec<&str> = self
            .rules
            .rules()
            .iter()
            .filter(|rule| rule.classes().any(|name| name == class))
            .flat_map(|rule| rule.classes())
            .filter(|name| *name != class && schema.has(name))
            .collect();
        joined.sort_unstable();
        joined.dedup();
        for name in joined {
            let key: Vec<&str> =
                schema.key_of(name).map_or_else(Vec::new, |key| key.iter().map(String::as_str).collect());
            let mut objects = Objects::new(name, &key);
            for property in schema.properties(name) {
                objects = match self.known.kind_of(name, property) {
                    Some(Type::Number) => {
                        objects.numbers(property, self.known.numbers(name, property).unwrap_or_default())
                    }
                    Some(Type::Text) => {
                        let texts = self.known.texts(name, property).unwrap_or_default();
                        objects
                            .texts(property, texts.into_iter().map(|text| text.map(|text| text.to_string())))
                    }
                    Some(Type::Truth) => {
                        objects.truths(property, self.known.truths(name, property).unwrap_or_default())
                    }
                    None => objects,
                };
            }
            consultation.assert(objects).map_err(Error::of(Code::FactsClass))?;
        }
        Ok(consultation)
    }

    /// The objects of a class, as they now are.
    pub const fn objects(&self, class: &'static str) -> ObjectsOf<'_> {
        ObjectsOf { known: self.known, class }
    }
}

/// The objects of a class, by row.
#[derive(Clone, Copy)]
pub struct ObjectsOf<'k> {
    known: &'k Inference,
    class: &'static str,
}

impl ObjectsOf<'_> {
    pub fn rows(&self) -> std::ops::Range<usize> {
        0..self.known.len(self.class).unwrap_or(0)
    }

    pub fn number(&self, row: usize, property: &str) -> Option<f64> {
        match self.known.value_at(self.class, row, property) {
            Some(Value::Number(number)) => Some(number),
            _ => None,
        }
    }

    pub fn text(&self, row: usize, property: &str) -> Option<String> {
        match self.known.value_at(self.class, row, property) {
            Some(Value::Text(text)) => Some(text.to_string()),
            _ => None,
        }
    }

    /// A truth value; what is unknown is false.
    pub fn truth(&self, row: usize, property: &str) -> bool {
        self.known_truth(row, property) == Some(true)
    }

    /// A truth value, where it is known.
    pub fn known_truth(&self, row: usize, property: &str) -> Option<bool> {
        match self.known.value_at(self.class, row, property) {
            Some(Value::Truth(truth)) => Some(truth),
            _ => None,
        }
    }

    /// A number that has to be there.
    pub fn needed(&self, row: usize, property: &str) -> Result<f64> {
        self.number(row, property).ok_or_else(|| self.wrong(row, property, "a number", None))
    }

    /// What is wrong with a cell.
    pub fn wrong(&self, row: usize, property: &str, expected: &str, found: Option<&str>) -> Error {
        let key = self.known.key(self.class, row).unwrap_or_default();
        let (table, found) = (self.class.to_lowercase(), found.map_or("nothing".to_owned(), quoted));
        let message = format!("{table} {key}: {property} is {found}, expected {expected}");
        Error::said(Code::CourseTable, message, None)
    }
}

fn quoted(text: &str) -> String {
    format!("`{text}`")
}

/// Refuses tables of which no map can be made.
pub fn no_map(reason: impl fmt::Display) -> Error {
    Error::said(Code::CourseTable, reason.to_string(), None)
}

/// The number of an object among others: they are numbered 1, 2, ...
pub fn refuse_gaps(objects: ObjectsOf<'_>, key: &str) -> Result<()> {
    let expected = objects.rows().map(|row| (row + 1) as f64);
    let found = objects.rows().map(|row| objects.number(row, key).unwrap_or_default());
    match expected.zip(found).find(|(expected, found)| (expected - found).abs() > 0.0) {
        None => Ok(()),
        Some((expected, found)) => {
            let table = objects.class.to_lowercase();
            let message = format!(
                "{table} are numbered 1, 2, ... without a gap: after {} comes {found}",
                expected - 1.0
            );
            let help = "close one instead of removing it: `closed` of its row is true".to_owned();
            Err(Error::said(Code::CourseTable, message, Some(help)))
        }
    }
}
