//! Why a step of a route over a map that is not cut into rooms is as it is: what rules were told there, and which spoke.
//!
//! The answer is made of it and it of the answer's parts: a circle that stays.

use std::sync::Arc;

use adit_db::course::Course as Row;
use adit_engine::Value;
use serde_json::json;

use super::{Facts, Reasoned, Why, cell};
use crate::error::{Code, Error, Result};
use crate::plan::course::{Found, name_of};
use crate::plan::{Said, Spoke};
use crate::state::Courses;
use crate::words::number::number;

/// Of `junction 2 from dock to lift` all that rules said there, of `junction 2` by which rule each kept route passes it;
/// `None` where it is something else that is meant.
pub fn why(courses: &Courses, what: &str, generation: u64) -> Result<Option<Why>> {
    let (place, ends) = match what.trim().split_once(" from ") {
        Some((place, ends)) => (place.trim(), ends.split_once(" to ")),
        None => (what.trim(), None),
    };
    let is_meant = |said: &&Arc<Said>| said.place == place;
    let (mut conclusions, mut facts) = (Vec::new(), Vec::new());
    if let Some((start, goal)) = ends {
        for robot in courses.robots() {
            let Found { row, said, .. } = courses.find(&robot, start.trim(), goal.trim())?;
            for said in said.iter().filter(is_meant) {
                let from = on(place, &row);
                conclusions.extend(reasons(said, &from));
                facts.push(told(said, &from));
            }
        }
        if conclusions.is_empty() {
            let message = format!("rules were asked nothing about {place} on the way from {start} to {goal}");
            let help = "`adit route SITE START GOAL --steps` has what a route leads through".to_owned();
            return Err(Error::said(Code::WhyUnknown, message, Some(help)));
        }
    } else {
        for Found { row, said, .. } in courses.kept() {
            conclusions.extend(said.iter().filter(is_meant).map(|said| in_short(said, &on(place, row))));
        }
        if conclusions.is_empty() {
            return Ok(None);
        }
    }
    let (object, name) = (place.replacen(' ', "s.", 1), place.to_owned());
    Ok(Some(Why { generation, object, name, conclusions, facts, hindered: Vec::new(), easier: None }))
}

/// What the best route between two ends costs, if there is one, and in sentences why: what rules said of each thing that it
/// leads over, or of `at` alone.
pub fn why_way(
    courses: &Courses,
    (start, goal): (&str, &str),
    at: Option<&str>,
    robot: &str,
) -> Result<(Option<f64>, Vec<String>)> {
    let Found { row, said } = courses.find(robot, start, goal)?;
    let Some(cost) = row.cost.filter(|_| row.reason.is_none()) else {
        let why = row.reason.map_or(String::new(), |reason| format!(": {reason}"));
        return Ok((None, vec![format!("No route leads from {start} to {goal}{why}.")]));
    };
    let is_asked = |said: &&Arc<Said>| at.is_none_or(|at| said.place == at.trim());
    let mut sentences = vec![format!("The route from {start} to {goal} costs {}.", number(cost))];
    if at.is_none() {
        sentences.extend(pulled_tight(&said, cost));
    }
    for said in said.iter().filter(is_asked) {
        let sentence = in_short(said, &said.place).why;
        if sentences.last() != Some(&sentence) {
            sentences.push(sentence);
        }
    }
    match (sentences.len(), at) {
        (1, Some(at)) => {
            let message = format!("rules were asked nothing about {at} on the way from {start} to {goal}");
            let help = "`adit route SITE START GOAL --steps` has what a route leads through".to_owned();
            Err(Error::said(Code::WhyUnknown, message, Some(help)))
        }
        (1, None) => {
            sentences.push("Rules were asked nothing on the way; none that was found costs less.".to_owned());
            Ok((Some(cost), sentences))
        }
        _ => Ok((Some(cost), sentences)),
    }
}

/// Where, on which way.
fn on(place: &str, row: &Row) -> String {
    format!("{place}, from {} to {} ({})", row.start, row.goal, row.robot)
}

/// By which rule a route passes there.
/// That the stretches of a path over a floor plan weigh more in all than the path: each leads to the middle of a doorway.
fn pulled_tight(said: &[Arc<Said>], cost: f64) -> Option<String> {
    let weight = |said: &Arc<Said>| {
        let fact = said.facts.iter().find(|fact| fact.property == "weight")?;
        if let Value::Number(weight) = fact.value { Some(weight) } else { None }
    };
    let sum: f64 = said.iter().filter_map(weight).sum();
    let is_over_adits = said.iter().any(|said| said.place.starts_with("region "));
    (is_over_adits && sum - cost > 1e-3).then(|| {
        let (sum, saved) = (number(sum), number(sum - cost));
        format!("Its stretches lead to the middle of each doorway and weigh {sum} in all; pulled tight, it is {saved} shorter.")
    })
}

fn in_short(said: &Said, from: &str) -> Reasoned {
    let decided = ["corner_x", "margin_x", "weight"].into_iter().find_map(|property| {
        let fact = said.facts.iter().find(|fact| fact.property == property)?;
        Some((fact, said.rule_of(property)?))
    });
    let (property, value, rule) = match &decided {
        Some((fact, rule)) => (fact.property.to_owned(), cell(&fact.value), Some(rule.clone())),
        None => (String::new(), adit_db::Cell::Null, None),
    };
    let by = rule.as_ref().map_or("no rule spoke".to_owned(), |rule| format!("by rule \"{rule}\""));
    let weight = decided.as_ref().map_or(String::new(), |(fact, _)| match fact.property {
        "weight" => format!("weighs {}, ", written(&fact.value)),
        _ => "how it is passed is said ".to_owned(),
    });
    Reasoned {
        property,
        value,
        rule,
        version: None,
        file: None,
        line: None,
        witness: None,
        why: format!("{from}: {weight}{by}"),
    }
}

fn written(value: &adit_engine::Value) -> String {
    match value {
        adit_engine::Value::Number(value) => number(*value),
        other => other.to_string(),
    }
}

/// What rules were told there.
fn told(said: &Said, from: &str) -> Facts {
    let told = said.facts.iter().filter(|fact| fact.rule.is_none());
    let properties = told.map(|fact| (fact.property.to_owned(), json!(cell(&fact.value)))).collect();
    Facts { class: "told at".to_owned(), key: from.to_owned(), properties }
}

/// What rules concluded there; and why the others did not speak.
fn reasons<'s>(said: &'s Said, from: &'s str) -> impl Iterator<Item = Reasoned> + 's {
    let concluded = said.facts.iter().filter_map(move |fact| {
        let (rule, version) = fact.rule.as_ref()?;
        let spoke = said.considered.iter().find(|spoke| spoke.spoke && spoke.rule == *rule);
        let by = said.rule_of(fact.property).unwrap_or_else(|| rule.clone());
        let place = spoke.map_or(String::new(), |spoke| format!(" ({}, line {})", spoke.file, spoke.line));
        Some(Reasoned {
            property: fact.property.to_owned(),
            value: cell(&fact.value),
            rule: Some(rule.clone()),
            version: Some(version.clone()),
            file: spoke.map(|spoke| spoke.file.clone()),
            line: spoke.map(|spoke| spoke.line as i64),
            witness: None,
            why: format!("{from}: {} is {}, by rule \"{by}\"{place}", fact.property, written(&fact.value)),
        })
    });
    let silent = said.considered.iter().filter(|spoke| !spoke.spoke).map(move |spoke: &Spoke| {
        let because = spoke.because.clone().unwrap_or_default();
        Reasoned {
            property: name_of(spoke),
            value: adit_db::Cell::from(because.as_str()),
            rule: None,
            version: None,
            file: Some(spoke.file.clone()),
            line: Some(spoke.line as i64),
            witness: None,
            why: format!("{} did not speak: {because}", name_of(spoke)),
        }
    });
    concluded.chain(silent)
}
