//! `[[area]]` and `[[door]]` as values, checked in themselves.

use geo::Centroid;
use toml::de::DeValue;

use super::super::diagnostic::{Code, Problem};
use super::super::fields::{Fields, Located};
use super::super::suggest::nearest;
use super::names::Names;
use super::outline;
use crate::geometry::Point;
use crate::overlays::{self, AREAS, NAMED_DOORS, own_kind};
use crate::world::{Area, NamedDoor, Property, Shape};

/// A property that an item gives: its class, its name and the kind of its values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Given {
    pub(super) class: &'static str,
    pub(super) property: String,
    pub(super) kind: &'static str,
}

pub(super) fn areas(
    document: &Fields<'_, '_>,
    names: &mut Names,
    given: &mut Vec<Located<Given>>,
    problems: &mut Vec<Problem>,
) -> Vec<Located<Area>> {
    let mut found = Vec::new();
    for item in document.tables("area", "[[area]]", problems) {
        let name = names.take(&item, "area", problems);
        let kind = kind(&item, problems);
        let further = further(&item, AREAS, &["name", "kind", "rect", "polygon"], given, problems);
        let outline = if item.get("rect").is_none() && item.get("polygon").is_none() {
            problems.push(without(&item, "`rect` or a `polygon`", &["rect", "polygon"]));
            None
        } else {
            outline::shape(&item, problems)
        };
        if let (Some(name), Some(shape)) = (name, outline) {
            let centre = centre(&shape);
            let value = Area { name: name.value, kind, shape, centre, further };
            found.push(Located { value, span: name.span });
        }
    }
    found
}

pub(super) fn doors(
    document: &Fields<'_, '_>,
    names: &mut Names,
    given: &mut Vec<Located<Given>>,
    problems: &mut Vec<Problem>,
) -> Vec<Located<NamedDoor>> {
    let mut found = Vec::new();
    for item in document.tables("door", "[[door]]", problems) {
        let name = names.take(&item, "door", problems);
        let kind = kind(&item, problems);
        let further = further(&item, NAMED_DOORS, &["name", "kind", "from", "to"], given, problems);
        let (from, to) = (item.numbers::<2>("from", problems), item.numbers::<2>("to", problems));
        let (Some(from), Some(to)) = (from, to) else { continue };
        let point = |[x, y]: [f64; 2]| Point::new(x, y);
        let (start, end) = (point(from.value), point(to.value));
        if start == end {
            let message = format!("this door has no width: it begins and ends at ({}, {})", end.x, end.y);
            let problem = item.text.problem(Code::Degenerate, &to.span, message);
            problems.push(problem.with_help("`from` and `to` are the two posts of the door"));
            continue;
        }
        if let Some(name) = name {
            let value = NamedDoor { name: name.value, kind, from: start, to: end, further };
            found.push(Located { value, span: name.span });
        }
    }
    found
}

pub(crate) fn centre(shape: &Shape) -> Point {
    let middle = shape.to_geo().centroid().map(|p| Point::new(p.x(), p.y()));
    middle.unwrap_or_else(|| shape.enclosing_rect().centre())
}

fn kind(item: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Option<String> {
    item.get("kind")?;
    item.string("kind", problems).map(|kind| kind.value)
}

/// An item without its outline: perhaps its key is misspelt, and was taken for a property.
fn without(item: &Fields<'_, '_>, wanted: &str, keys: &[&str]) -> Problem {
    let message = format!("{} needs a {wanted}", item.what);
    let problem = item.text.problem(Code::MissingKey, &item.span, message);
    let meant = item.table.keys().find_map(|key| Some((key.get_ref(), nearest(key.get_ref(), keys)?)));
    match meant {
        Some((key, meant)) => problem.with_help(format!("is `{key}` meant to be `{meant}`?")),
        None => problem,
    }
}

/// The values of all keys but the `known` ones, by name.
fn further(
    item: &Fields<'_, '_>,
    class: &'static str,
    known: &[&str],
    given: &mut Vec<Located<Given>>,
    problems: &mut Vec<Problem>,
) -> Vec<(String, Property)> {
    let mut found: Vec<(String, Property)> = Vec::new();
    for (key, value) in item.table.iter().filter(|(key, _)| !known.contains(&&**key.get_ref())) {
        let name = key.get_ref().to_string();
        if let Some(problem) = unfit(item, class, &name, &key.span()) {
            problems.push(problem);
            continue;
        }
        let value = match value.get_ref() {
            DeValue::String(text) => Some(Property::Text(text.to_string())),
            DeValue::Boolean(truth) => Some(Property::Truth(*truth)),
            _ => item.number_or(&name, "a number, a text in quotes, true or false", problems),
        };
        let Some(value) = value else { continue };
        let located = Located {
            value: Given { class, property: name.clone(), kind: value.kind() },
            span: key.span().start..item.get(&name).map_or(key.span().end, |value| value.span().end),
        };
        if let Some(problem) = other_kind(item, &located, given) {
            problems.push(problem);
            continue;
        }
        if let Some((wanted, help)) = overlays::wanted(class, &name, &value) {
            let message = format!("`{name}` of {} must be {wanted}, not {value}", item.what);
            let problem = item.text.problem(Code::Impossible, &located.span, message);
            problems.push(help.into_iter().fold(problem, Problem::with_help));
            continue;
        }
        given.push(located);
        found.push((name, value));
    }
    found.sort_by(|a, b| a.0.cmp(&b.0));
    found
}

/// What is wrong with the name of a property: rules and tables must be able to use it.
fn unfit(item: &Fields<'_, '_>, class: &str, name: &str, span: &std::ops::Range<usize>) -> Option<Problem> {
    let is_letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    if !name.starts_with(|c: char| c.is_ascii_lowercase()) || !name.chars().all(is_letter) {
        let message = format!("`{name}` cannot name a property of {}", item.what);
        let help = "a property is named by small letters, digits and `_`, so that rules and SQL can name it";
        return Some(item.text.problem(Code::UnknownKey, span, message).with_help(help));
    }
    let made: &[&str] = if class == AREAS { &["area", "x", "y"] } else { &["door", "x", "y", "width"] };
    made.contains(&name).then(|| {
        let message =
            format!("`{name}` of {} follows from its name and its place, and is not said", item.what);
        item.text.problem(Code::UnknownKey, span, message)
    })
}

/// The complaint where a property has values of another kind than before.
fn other_kind(item: &Fields<'_, '_>, new: &Located<Given>, given: &[Located<Given>]) -> Option<Problem> {
    let Given { class, property, kind } = &new.value;
    if let Some(own) = own_kind(class, property).filter(|own| own != kind) {
        let message = format!("`{property}` of {} must be a {own}, not a {kind}", item.what);
        return Some(item.text.problem(Code::WrongType, &new.span, message));
    }
    let same = |old: &&Located<Given>| old.value.class == *class && old.value.property == *property;
    let old = given.iter().find(same).filter(|old| old.value.kind != *kind)?;
    let message = format!(
        "`{property}` is a {kind} here and a {} on line {}: a property holds values of one kind",
        old.value.kind,
        item.text.line(old.span.start)
    );
    Some(item.text.problem(Code::WrongType, &new.span, message).and_at(&old.span, "the first one"))
}
