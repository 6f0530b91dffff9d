//! What is told to a derivation: tables as classes, and facts about single objects, by name or by a point.

pub mod attach;
pub mod closing;
pub mod kinds;
mod unfit;

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{Hash, Hasher};

use adit_db::told::{Standing, Told as Row};
use adit_db::{Cell, Tx};
use adit_engine::{KnowledgeBase as Inference, Schema, Type, Value};
use adit_planners::facts::{Column, Facts};

use crate::error::{Code, Error, Result};
use crate::knowledge::laid::Laid;
use crate::knowledge::tunings::RowKeys;
use crate::site::clock::{Clock, stored};
use crate::words::number::number;
use crate::words::suggest::did_you_mean;
pub use attach::Attached;
pub use closing::{Closable, Line, Whom};

/// Classes and facts that people, robots and tables tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Told {
    /// Whole classes, from tables.
    pub classes: Facts,
    /// The keys of their rows, as edits name them; empty for a table whose rows nobody can name.
    pub keys: RowKeys,
    /// Classes of tables whose rows SQLite numbers.
    pub numbered: BTreeSet<String>,
    /// Facts about single objects that hold now, the oldest first: of two about one property the later one counts.
    pub facts: Vec<Fact>,
    /// Facts whose values their properties cannot hold.
    pub unfit: Vec<Unfit>,
    /// Facts whose time is over, by number.
    pub expired: Vec<i64>,
    /// The next moment at which a fact ends, or opening hours begin or end; in UTC.
    pub valid_until: Option<String>,
    /// The moment that was asked about, where it is still to come; in UTC.
    pub valid_from: Option<String>,
    /// What lies over the map.
    pub laid: Laid,
    /// What the expert should know of tunings and hours.
    pub notes: Vec<String>,
}

/// A fact about one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Its number.
    pub id: i64,
    /// The class.
    pub class: String,
    /// Which object.
    pub object: Object,
    /// The property.
    pub property: String,
    /// What it is.
    pub value: Value,
    /// Whether it is kept: what an errand tells is taken back again.
    pub is_kept: bool,
}

/// A fact whose value its property cannot hold, and what it holds. Only another program can write such a one.
#[derive(Clone, Debug, PartialEq)]
pub struct Unfit {
    pub fact: Fact,
    pub holds: Type,
}

/// Who tells what is taken back again. No account is called so; one that services run under may be `nobody`.
pub const NOBODY: &str = "(nobody)";

/// What a fact is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Object {
    /// The object with this key.
    Key(String),
    /// What lies at a point; for a door, with the segment that it had.
    Point([f64; 2], Option<[f64; 4]>),
}

impl Fact {
    /// The fact of a row.
    pub fn of(row: &Row) -> Result<Self> {
        let value = match (row.kind.as_str(), &row.value) {
            ("text", Cell::Text(text)) => Some(Value::from(text.as_str())),
            ("truth", Cell::Integer(truth)) => Some(Value::Truth(*truth != 0)),
            ("number", Cell::Integer(number)) => Some(Value::Number(*number as f64)),
            ("number", Cell::Real(number)) => Some(Value::Number(*number)),
            _ => None,
        };
        let object = match (&row.key, row.at) {
            (Some(key), _) => Some(Object::Key(key.clone())),
            (None, Some(at)) => Some(Object::Point(at, row.segment)),
            (None, None) => None,
        };
        let (Some(value), Some(object)) = (value, object) else {
            let message = format!("fact {} of the table `told` has no object, or no {}", row.id, row.kind);
            return Err(Error::said(Code::TellUnreadable, message, None));
        };
        let (id, class, property) = (row.id, row.class.clone(), row.property.clone());
        let is_kept = row.who != NOBODY;
        Ok(Self { id, class, object, property, value, is_kept })
    }

    /// Its number, of one that is kept.
    pub fn number(&self) -> Option<i64> {
        self.is_kept.then_some(self.id)
    }

    /// The type of its value.
    pub fn kind(&self) -> Type {
        match self.value {
            Value::Number(_) => Type::Number,
            Value::Text(_) => Type::Text,
            Value::Truth(_) => Type::Truth,
        }
    }

    /// As people say it: `fact 3 (DOORS 5,2 passable = false)`.
    pub fn name(&self) -> String {
        let object = match &self.object {
            Object::Key(key) => key.clone(),
            Object::Point([x, y], _) => format!("{},{}", number(*x), number(*y)),
        };
        format!("fact {} ({} {object} {} = {})", self.id, self.class, self.property, self.value)
    }
}

impl Fact {
    /// Tells it of one object.
    pub fn tell_row(&self, knowledge: &mut Inference, class: &str, row: usize, property: &str) -> Result<()> {
        let told = knowledge.tell_row(class, row, property, Some(self.value.clone()));
        told.map_err(|error| {
            let help = "take it back with `adit tell SITE --retract ID`".to_owned();
            Error::said(Code::TellRefused, format!("{}: {error}", self.name()), Some(help))
        })
    }

    /// That it no longer finds what it is about.
    pub fn lost(&self) -> String {
        let why = match &self.object {
            Object::Key(key) => format!("{} has no `{key}`", self.class),
            Object::Point([x, y], _) => {
                format!("nothing of {} is at {},{} as it was", self.class, number(*x), number(*y))
            }
        };
        format!("{} is lost: {why}; it is kept, and counts for nothing until its place is back", self.name())
    }
}

impl Told {
    /// Adds what facts are about to the classes that rules may name.
    pub fn declare(&self, schema: &mut Schema) {
        let for_rules = |fact: &&Fact| schema.has(&fact.class) && !fact.is_for_some();
        for fact in self.facts.iter().filter(for_rules).collect::<Vec<_>>() {
            if schema.kind(&fact.class, &fact.property).is_none() {
                schema.add(&fact.class, &fact.property, fact.kind());
            }
        }
    }

    /// The robots, in the order of their names.
    pub fn robots(&self) -> Vec<String> {
        let states = self.classes.get("ROBOTS").and_then(|table| table.texts("robot").ok());
        let mut robots: Vec<String> = states.into_iter().flatten().flatten().cloned().collect();
        robots.dedup();
        robots
    }

    /// Whether the same counts: classes and facts, whatever the clock says of the time after.
    pub fn counts_as(&self, other: &Self) -> bool {
        self.classes == other.classes
            && self.facts == other.facts
            && self.unfit == other.unfit
            && self.laid == other.laid
    }

    /// What ended, opened or closed by itself since then, in sentences.
    pub fn ended_since(&self, before: &Self) -> Vec<String> {
        let is_new = |fact: &&Fact| self.expired.contains(&fact.id);
        let facts = before.facts.iter().filter(is_new).map(|fact| format!("{} has ended", fact.name()));
        let laid = self.laid.ended_since(&before.laid);
        let hours = |told: &Self| -> BTreeMap<String, bool> {
            let hours = told.classes.get("HOURS");
            match hours.map(|hours| (hours.column("name"), hours.column("open"))) {
                Some((Some(Column::Text(names)), Some(Column::Truth(open)))) => {
                    let rows = names.iter().cloned().zip(open.iter().copied());
                    rows.filter_map(|(name, open)| Some((name?, open?))).collect()
                }
                _ => BTreeMap::new(),
            }
        };
        let known = hours(before);
        let now = hours(self);
        let turned = now.iter().filter(|(name, open)| known.get(*name).is_some_and(|known| known != *open));
        let turned = turned.map(|(name, open)| {
            format!("`{name}` is {} by its hours", if *open { "open" } else { "closed" })
        });
        facts.chain(laid).chain(turned).collect()
    }

    /// The facts about a class.
    pub fn facts_of<'t>(&'t self, class: &'t str) -> impl Iterator<Item = &'t Fact> {
        self.facts.iter().filter(move |fact| fact.class == class)
    }

    /// Adds to `attached` which objects the facts about some classes are about.
    pub fn attach(&self, knowledge: &Inference, is_meant: impl Fn(&str) -> bool, attached: &mut Attached) {
        for fact in self.facts.iter().filter(|fact| is_meant(&fact.class)) {
            for row in fact.rows(knowledge) {
                attached.add(fact, row, knowledge.key(&fact.class, row));
            }
        }
    }

    /// Tells the facts about a class that was just asserted; which objects each is about is added to `attached`.
    pub fn tell(&self, knowledge: &mut Inference, class: &str, attached: &mut Attached) -> Result<()> {
        let mut here = Attached::default();
        self.attach(knowledge, |of| of == class, &mut here);
        for ((class, row, property), fact) in here.cells() {
            fact.tell_row(knowledge, class, *row, property)?;
        }
        attached.join(here);
        Ok(())
    }

    /// What became of each fact.
    pub fn standings(&self, attached: &Attached) -> Vec<Standing> {
        let mut standings: Vec<Standing> = self
            .facts
            .iter()
            .map(|fact| {
                let keys = attached.keys(fact.id);
                let state = if keys.is_empty() && fact.closes().is_none() { "lost" } else { "attached" };
                Standing { told: fact.id, state: state.to_owned(), keys }
            })
            .collect();
        let over = |id: &i64| Standing { told: *id, state: "expired".to_owned(), keys: Vec::new() };
        standings.extend(self.expired.iter().map(over));
        let lost = |of: &Unfit| Standing { told: of.fact.id, state: "lost".to_owned(), keys: Vec::new() };
        standings.extend(self.unfit.iter().map(lost));
        standings.sort_by_key(|standing| standing.told);
        standings
    }

    /// Facts that count for nothing, since they no longer find what they are about or cannot be, in sentences.
    pub fn lost(&self, attached: &Attached) -> Vec<String> {
        let lost =
            self.facts.iter().filter(|fact| attached.keys(fact.id).is_empty() && fact.closes().is_none());
        lost.map(Fact::lost).chain(self.unfit.iter().map(Unfit::said)).collect()
    }

    /// What facts close where that is not for rules to say.
    pub fn lines(&self, attached: &Attached, closable: Closable<'_>) -> Vec<Line> {
        self.facts.iter().flat_map(|fact| fact.lines(&attached.keys(fact.id), closable)).collect()
    }

    /// Hours of what is no named area or door, in sentences: mostly a slip of the pen.
    pub fn idle_hours(&self, knowledge: &Inference) -> Vec<String> {
        let Some(Column::Text(names)) = self.classes.get("HOURS").and_then(|hours| hours.column("name"))
        else {
            return Vec::new();
        };
        let known: Vec<String> = ["AREAS", "NAMED_DOORS"]
            .iter()
            .flat_map(|class| {
                (0..knowledge.len(class).unwrap_or(0)).filter_map(|row| knowledge.key(class, row))
            })
            .collect();
        let idle = names.iter().flatten().filter(|name| !known.contains(name));
        idle.map(|name| {
            let meant = did_you_mean(name, known.iter().map(String::as_str));
            let meant = meant.map_or_else(String::new, |meant| format!("; {meant}"));
            format!("`{name}` has opening hours, and is no named area or door{meant}")
        })
        .collect()
    }

    /// Says in the database from when and until when what was derived holds.
    pub fn sign(&self, tx: &mut Tx<'_>) -> Result<()> {
        for (key, value) in [("valid_from", &self.valid_from), ("valid_until", &self.valid_until)] {
            tx.set_site_value(key, value.as_deref())?;
        }
        Ok(())
    }

    /// Whether the time up to which all of it holds is over.
    pub fn is_over(&self, clock: &Clock) -> bool {
        self.valid_until.as_ref().is_some_and(|until| *until <= stored(clock.now()))
    }

    /// A number that stands for the facts, and what lies over the map.
    pub fn hash(&self, hasher: &mut impl Hasher) {
        self.laid.hash(hasher);
        for fact in &self.facts {
            (&fact.class, &fact.property, fact.value.to_string()).hash(hasher);
            match &fact.object {
                Object::Key(key) => key.hash(hasher),
                Object::Point(at, segment) => {
                    (at.map(f64::to_bits), segment.map(|ends| ends.map(f64::to_bits))).hash(hasher);
                }
            }
        }
    }
}
