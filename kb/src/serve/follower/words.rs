//! What became of a route, and why, in words.

use adit_db::route::Step;

use super::held::Held;
use crate::answer::Answer;
use crate::serve::event::Changed;
use crate::words::number::number;

/// Spaces, doorways and the like that one sentence names.
const NAMED: usize = 3;

/// Of the route that a follower begins with.
pub fn first(answer: &Answer) -> String {
    match answer.cost {
        Some(cost) => format!("the way costs {}", number(cost)),
        None => format!("there is no way: {}", reason(answer)),
    }
}

/// Of a route that is another one than before, with what was done meanwhile.
pub fn changed(before: &Held, now: &Held, changes: &[Changed]) -> String {
    let mut said = vec![news(&before.answer, &now.answer)];
    // why there is no way names what shuts it
    let shut = differing(before, now, before).filter(|shut| !said[0].contains(shut));
    let shut: Vec<String> = shut.map(str::to_owned).collect();
    said.extend(shut);
    said.extend(differing(now, before, now).map(|shut| format!("no longer: {shut}")));
    said.extend(changes.iter().map(because));
    said.join("; ")
}

fn news(before: &Answer, now: &Answer) -> String {
    let (from, to) = match (before.cost, now.cost) {
        (None, None) => return format!("there is still no way: {}", reason(now)),
        (Some(_), None) => return format!("there is no way any more: {}", reason(now)),
        (None, Some(cost)) => return format!("there is a way again: it costs {}", number(cost)),
        (Some(from), Some(to)) => (number(from), number(to)),
    };
    let key = |step: &Step| (step.kind.clone(), step.place.clone(), step.state.clone(), step.action.clone());
    let is_same = before.steps.iter().map(key).eq(now.steps.iter().map(key));
    // rooms that are cut anew have other numbers where the robot goes as before
    let is_renamed = !is_same && before.waypoints == now.waypoints && !now.waypoints.is_empty();
    let way = if is_same || is_renamed { "the same way" } else { "another way" };
    let cost =
        if from == to { format!("costs {to} as before") } else { format!("costs {to} instead of {from}") };
    let renamed = if is_renamed { ", by rooms and doors that have other numbers" } else { "" };
    format!("{way} {cost}{renamed}{}", by(before, now))
}

/// By which spaces and doorways a way leads now, and no longer.
fn by(before: &Answer, now: &Answer) -> String {
    let [gone, new] = [(before, now), (now, before)].map(|(of, other)| {
        let known = names(other);
        let mut names = names(of);
        names.retain(|name| !known.contains(name));
        let more = names.len() > NAMED;
        names.truncate(NAMED);
        let listed = names.join(", ");
        if more { format!("{listed} and more") } else { listed }
    });
    match (new.as_str(), gone.as_str()) {
        ("", "") => String::new(),
        (new, "") => format!(", by {new}"),
        ("", gone) => format!(", no longer by {gone}"),
        (new, gone) => format!(", by {new} instead of {gone}"),
    }
}

fn names(answer: &Answer) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for name in answer.steps.iter().flat_map(|step| [&step.space, &step.doorway]).flatten() {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names
}

/// What is closed here and not there, and on a way: elsewhere it changes no route.
fn differing<'h>(open: &'h Held, closed: &'h Held, way: &'h Held) -> impl Iterator<Item = &'h str> {
    let is_new = |(_, shut): &&(_, String)| !open.closed.iter().any(|(_, known)| known == shut);
    let all = closed.closed.iter().filter(is_new).filter(|(segment, _)| way.passes(segment));
    all.map(|(_, shut)| shut.as_str()).take(NAMED)
}

fn because(Changed { who, what, why, .. }: &Changed) -> String {
    let why = if why.is_empty() { String::new() } else { format!(" ({why})") };
    format!("{who}: {what}{why}")
}

fn reason(answer: &Answer) -> &str {
    answer.reason.as_deref().unwrap_or_default()
}
