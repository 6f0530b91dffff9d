//! Why a step of a route over a map that is not cut into rooms is as it is: what rules were told there, and which spoke.
//!
//! The answer is made of it and it of the answer's parts: a circle that stays.

use serde_json::json;

use super::{Facts, Reasoned, Why, cell};
use crate::error::{Code, Error, Result};
use crate::plan::course::{Found, name_of};
use crate::plan::{Said, Spoke};
use crate::state::Courses;

/// Of `junction 2`, on every kept route that leads through it, or of `junction 2 from start to goal`; `None` where it is
/// something else that is meant.
pub fn why(courses: &Courses, what: &str, generation: u64) -> Result<Option<Why>> {
    let (place, ends) = match what.trim().split_once(" from ") {
        Some((place, ends)) => (place, ends.split_once(" to ")),
        None => (what.trim(), None),
    };
    let Some(junction) = place.strip_prefix("junction ") else {
        return Ok(None);
    };
    let Ok(junction) = junction.trim().parse::<usize>() else { return Ok(None) };
    let (mut conclusions, mut facts) = (Vec::new(), Vec::new());
    for Found { row, said, .. } in courses.kept() {
        if ends.is_some_and(|(start, goal)| {
            (row.start.as_str(), row.goal.as_str()) != (start.trim(), goal.trim())
        }) {
            continue;
        }
        let from = format!("junction {junction}, from {} to {} ({})", row.start, row.goal, row.robot);
        for said in said.iter().filter(|said| said.junction == junction) {
            conclusions.extend(reasons(said, &from));
            facts.push(told(said, &from));
        }
    }
    if conclusions.is_empty() {
        let message =
            format!("no kept route turns at {place}{}", if ends.is_some() { " on that way" } else { "" });
        let help = "`adit route SITE START GOAL --steps` has the junctions of a route".to_owned();
        return Err(Error::said(Code::WhyUnknown, message, Some(help)));
    }
    let (object, name) = (format!("junctions.{junction}"), format!("junction {junction}"));
    Ok(Some(Why { generation, object, name, conclusions, facts }))
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
        let by =
            spoke.map_or_else(|| format!("rule \"{rule}\""), |spoke| format!("rule \"{}\"", name_of(spoke)));
        let place = spoke.map_or(String::new(), |spoke| format!(" ({}, line {})", spoke.file, spoke.line));
        Some(Reasoned {
            property: fact.property.to_owned(),
            value: cell(&fact.value),
            rule: Some(rule.clone()),
            version: Some(version.clone()),
            file: spoke.map(|spoke| spoke.file.clone()),
            line: spoke.map(|spoke| spoke.line as i64),
            witness: None,
            why: format!("{from}: {} is {}, by {by}{place}", fact.property, fact.value),
        })
    });
    let silent = said.considered.iter().filter(|spoke| !spoke.spoke).map(move |spoke: &Spoke| Reasoned {
        property: "corner".to_owned(),
        value: adit_db::Cell::Null,
        rule: None,
        version: None,
        file: Some(spoke.file.clone()),
        line: Some(spoke.line as i64),
        witness: None,
        why: format!(
            "{from}: {} did not speak: {}",
            name_of(spoke),
            spoke.because.clone().unwrap_or_default()
        ),
    });
    concluded.chain(silent)
}
