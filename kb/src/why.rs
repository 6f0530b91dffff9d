//! Why something is as it is: the rule behind each conclusion, what it chose, and the values that it read there.

pub mod ask;
mod contrast;
mod course;
mod facts;
pub mod firm;
pub mod hindered;
mod made_test;
mod meant;
mod probe;
mod said;
pub(crate) mod subject;
mod told;
pub mod way;
pub mod why_not;

use adit_db::Cell;
use adit_engine::{Conflict, Origin, Support, Value};
use adit_planners::geometry::Segment;
use adit_planners::routes::Walking;
use serde::Serialize;

use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::live::report::{HIGHER, ONE_OBJECT};
use crate::state::State;
use crate::why::hindered::{Driven, Hindered, Kind, by_ease};
use crate::why::subject::Subject;
use crate::why::told::Telling;
use crate::words::suggest::did_you_mean;
pub use facts::Facts;
pub use made_test::MadeTest;
pub(crate) use said::roughly;

/// What is concluded about an object, and why.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Why {
    /// The state of the knowledge base that the answer rests on.
    pub generation: u64,
    /// The object, as `doors.7`.
    pub object: String,
    /// As people call it.
    pub name: String,
    /// Each property that rules conclude.
    pub conclusions: Vec<Reasoned>,
    /// The objects that the conclusions rest on, each with the properties that their rules read.
    pub facts: Vec<Facts>,
    /// Of a room in another state than the easiest, the easier ones, and what keeps each of them out in its middle.
    pub hindered: Vec<Hindered>,
    /// That in one sentence; `null`: nothing is easier there.
    pub easier: Option<String>,
}

/// A value that was concluded, or told in place of what rules conclude.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Reasoned {
    /// The property.
    pub property: String,
    /// Its value.
    #[schema(value_type = serde_json::Value)]
    pub value: Cell,
    /// The rule; `null`: the value was told.
    pub rule: Option<String>,
    /// Its version.
    pub version: Option<String>,
    /// Its file.
    pub file: Option<String>,
    /// Its line.
    pub line: Option<i64>,
    /// What the rule chose, by its variables; under `revised by` the rules that changed the value after it.
    #[schema(value_type = Option<serde_json::Value>)]
    pub witness: Option<serde_json::Value>,
    /// All of it in one sentence.
    pub why: String,
}

impl Live {
    /// Why an object (`door 7`, `room d`, `doors.7`), or one property of it (`doors.7.hardness`), is as it is.
    pub fn why(&self, what: &str) -> Result<Why> {
        self.fork().why(what)
    }
}

impl State {
    /// As [`Live::why`].
    pub fn why(&self, what: &str) -> Result<Why> {
        if let Some(courses) = &self.courses
            && let Some(why) = course::why(courses, what, self.generation)?
        {
            return Ok(why);
        }
        let subject = Subject::find(self, what)?;
        let told = told::told(self, &subject)?;
        let (mut conclusions, mut facts) = match self.conclusions(&subject) {
            Ok(found) => found,
            Err(_) if !told.is_empty() => (Vec::new(), Vec::new()),
            Err(error) => return Err(error),
        };
        // what is told stands before what is concluded, and says who told it
        conclusions
            .retain(|known| known.rule.is_some() || told.iter().all(|of| of.property != known.property));
        let (rule, version, file, line, witness) = (None, None, None, None, None);
        let none = Reasoned {
            property: String::new(),
            value: Cell::Null,
            rule,
            version,
            file,
            line,
            witness,
            why: String::new(),
        };
        conclusions.extend(told.into_iter().map(|Telling { property, value, why }| Reasoned {
            property,
            value,
            why,
            ..none.clone()
        }));
        if let Some(doorway) = self.doorway_called(&subject) {
            let (more, read) = self.conclusions(&doorway)?;
            conclusions.extend(more);
            facts.extend(read);
        }
        let object = format!("{}.{}", subject.class, subject.key);
        let (hindered, easier) = self.easier_there(&subject);
        let (generation, name) = (self.generation, subject.name);
        Ok(Why { generation, object, name, conclusions, facts, hindered, easier })
    }

    /// The doorway that is drawn where a named door is: what is concluded of it is so of the door.
    fn doorway_called(&self, subject: &Subject) -> Option<Subject> {
        let building = &self.graph().building;
        let name = Some(subject.key.as_str())
            .filter(|_| subject.class == "named_doors" && subject.property.is_none())?;
        let doorway = building.doorways.iter().find(|of| of.called.as_deref() == Some(name))?;
        let (class, key) = ("doorways".to_owned(), doorway.doorway.to_string());
        Some(Subject { class, key, property: None, name: name.to_owned() })
    }

    /// What keeps easier states out in the middle of a room.
    fn easier_there(&self, subject: &Subject) -> (Vec<Hindered>, Option<String>) {
        let graph = self.graph();
        let key = (subject.class == "rooms").then(|| subject.key.parse().ok()).flatten();
        let Some(room) = key.and_then(|key| graph.room(key)) else { return (Vec::new(), None) };
        let (Some(of), Walking::PerMetre(per_m)) = (&graph[room].layer, graph.graph()[room].walking) else {
            return (Vec::new(), None);
        };
        let centre = graph.outline(room).centre();
        let driven = Driven { legs: &[Segment::new(centre, centre)], per_m };
        let states = by_ease(graph, &of.0);
        let easier = states.iter().filter(|(other, least)| other != of && *least < per_m);
        let hindered = easier.filter_map(|(other, _)| self.hindered(other, &driven));
        let hindered: Vec<Hindered> = hindered.filter(|one| one.kind != Kind::Change).collect();
        let said = hindered::sentence(&hindered);
        (hindered, (!said.is_empty()).then_some(said))
    }

    /// What is concluded about the subject, with the facts behind it; a property that is named must be among it.
    pub(crate) fn conclusions(&self, subject: &Subject) -> Result<(Vec<Reasoned>, Vec<Facts>)> {
        let class = subject.class.to_uppercase();
        let mut properties: Vec<&str> = self
            .inputs
            .rules
            .concluded()
            .into_iter()
            .filter(|name| name.class == class)
            .map(|name| name.property.as_str())
            .collect();
        // what a route is made of first
        let rank = |name: &&str| {
            ["hardness", "action", "passable"].iter().position(|first| first == name).unwrap_or(3)
        };
        properties.sort_by_key(rank);
        let (mut found, mut facts) = (Vec::new(), Vec::new());
        for property in &properties {
            if subject.property.as_deref().is_none_or(|wanted| wanted == *property) {
                found.extend(self.reasoned(subject, &class, property, &mut facts));
            }
        }
        match &subject.property {
            Some(property) if found.is_empty() => {
                let message = format!(
                    "no rule gives {} a `{property}`: it is unknown, was told, or is no property",
                    subject.name
                );
                let is_known = properties.contains(&property.as_str());
                let help = did_you_mean(property, properties.iter().copied()).or_else(|| {
                    (!is_known && !properties.is_empty())
                        .then(|| format!("concluded are {}", properties.join(", ")))
                });
                Err(Error::said(Code::WhyNotConcluded, message, help))
            }
            _ => Ok((found, facts)),
        }
    }

    fn reasoned(
        &self,
        subject: &Subject,
        class: &str,
        property: &str,
        facts: &mut Vec<Facts>,
    ) -> Option<Reasoned> {
        let (knowledge, rules) = (&self.knowledge, &self.inputs.rules);
        let found = knowledge.why(rules, class, &subject.key, property)?;
        if let Some(conflict) = knowledge.conflict(rules, class, &subject.key, property) {
            return Some(disputed(subject, property, &conflict));
        }
        let mut witness = serde_json::Map::new();
        let mut chosen = Vec::new();
        let support = match &found.origin {
            Origin::Rule(support) => Some(support),
            Origin::Told => found.revisions.last().map(|revision| &revision.support),
        };
        if let Origin::Rule(support) = &found.origin {
            for one in support.witnesses.iter().filter(|one| one.class != class || one.key != subject.key) {
                let read = Facts::of(self, support, one);
                let values = read.as_ref().map_or_else(String::new, Facts::in_brackets);
                chosen.push(format!("{} = {} {}{values}", one.variable, one.class, one.key));
                witness.insert(one.variable.clone(), format!("{} {}", one.class, one.key).into());
            }
        }
        let supports = support.into_iter().chain(found.revisions.iter().map(|revision| &revision.support));
        for support in supports {
            for one in &support.witnesses {
                Facts::add(facts, Facts::of(self, support, one));
            }
        }
        let mut revised: Vec<&str> = found.revisions.iter().map(|revision| &*revision.support.rule).collect();
        revised.dedup();
        if !revised.is_empty() {
            witness.insert("revised by".to_owned(), serde_json::json!(revised));
        }
        let by = support.map_or_else(|| self.told_by(subject, class, property), by_rule);
        let quoted: Vec<String> = revised.iter().map(|rule| format!("\"{rule}\"")).collect();
        let part = |word: &str, of: &[String]| {
            if of.is_empty() { String::new() } else { format!("{word} {}", of.join(", ")) }
        };
        let value = found.value.as_ref().map_or("unknown".to_owned(), Value::to_string);
        let is_missing = support.filter(|_| found.value.is_none());
        let missing: Vec<String> = is_missing.map_or_else(Vec::new, |support| {
            let read = support.witnesses.iter().filter_map(|one| Facts::of(self, support, one));
            read.flat_map(|facts| facts.unknown(subject)).collect()
        });
        let why = format!(
            "{} {property} is {value}{by}{}{}{}",
            subject.name,
            part(" with", &chosen),
            part("; revised by", &quoted),
            part("; nothing says", &missing)
        );
        Some(Reasoned {
            property: property.to_owned(),
            value: found.value.as_ref().map_or(Cell::Null, cell),
            rule: support.map(|support| support.rule.clone()),
            version: support.map(|support| support.version.clone()),
            file: support.map(|support| support.file.clone()),
            line: support.map(|support| support.line as i64),
            witness: (!witness.is_empty()).then_some(serde_json::Value::Object(witness)),
            why,
        })
    }

    /// Which fact says so.
    fn told_by(&self, subject: &Subject, class: &str, property: &str) -> String {
        let row = self.knowledge.row(class, &subject.key);
        let cell = row.map(|row| (class.to_owned(), row, property.to_owned()));
        let fact = cell.and_then(|cell| self.attached.cells().get(&cell));
        fact.map_or_else(|| ", as told".to_owned(), |fact| format!(", as fact {} tells", fact.id))
    }
}

fn by_rule(support: &Support) -> String {
    let Support { rule, file, line, version, .. } = support;
    format!(", by rule \"{rule}\" ({file}, line {line}, version {version})")
}

/// A value as SQL holds it.
fn cell(value: &Value) -> Cell {
    match value {
        Value::Number(number) => Cell::Real(*number),
        Value::Text(text) => Cell::Text(text.to_string()),
        Value::Truth(truth) => Cell::Integer((*truth).into()),
    }
}

/// That rules disagree, and what each of them says.
fn disputed(subject: &Subject, property: &str, conflict: &Conflict) -> Reasoned {
    let said: Vec<String> =
        conflict.values.iter().map(|(rule, value)| format!("\"{rule}\" says {value}")).collect();
    let is_one_rule = conflict.values.iter().all(|(rule, _)| *rule == conflict.values[0].0);
    let (disagree, advice) =
        if is_one_rule { ("one rule says several things", ONE_OBJECT) } else { ("rules disagree", HIGHER) };
    let why =
        format!("{} {property} is unknown, since {disagree}: {}; {advice}", subject.name, said.join(", "));
    Reasoned {
        property: property.to_owned(),
        value: Cell::Null,
        rule: None,
        version: None,
        file: None,
        line: None,
        witness: None,
        why,
    }
}
