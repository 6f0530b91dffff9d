//! Another way in words: what is done on it instead of what, and where it begins to differ.

use adit_planners::routes::DoorIndex;

use super::Path;
use crate::graph::SiteGraph;
use crate::why::probe::Prober;
use crate::why::said::listed;
use crate::words::number::number;

/// So many doors are named.
const NAMED: usize = 3;

/// The action of each door of a way, or of each of its rooms where these weigh metres; as the knowledge says now.
pub fn actions(prober: &Prober, path: &Path) -> Vec<String> {
    let text = |class: &str, row: usize| match prober.fork.knowledge.value_at(class, row, "action") {
        Some(adit_engine::Value::Text(text)) => text.to_lowercase(),
        _ => "move".to_owned(),
    };
    if path.metres.is_empty() {
        return path.doors.iter().map(|door| text("DOORS", door.index())).collect();
    }
    path.metres.iter().map(|(room, _)| text("ROOMS", room.index())).collect()
}

/// What is done on the other way instead of on the present one, and where it leaves it.
pub fn instead(
    graph: &SiteGraph,
    present: (&Path, &[String]),
    other: (&Path, &[String]),
) -> (String, Option<String>) {
    let (mine, theirs) = (&present.0.doors, &other.0.doors);
    let shared = mine.iter().zip(theirs).take_while(|(one, two)| one == two).count();
    let rest = mine.len().min(theirs.len()) - shared;
    let ending =
        mine.iter().rev().zip(theirs.iter().rev()).take(rest).take_while(|(one, two)| one == two).count();
    let first = theirs.get(shared).filter(|_| shared < theirs.len() - ending).or(mine.get(shared));
    let at = first.map(|&door| {
        let [x, y] = graph[door].at;
        format!("door {} at ({x:.2}, {y:.2})", graph[door].door)
    });
    if !present.0.metres.is_empty() || !other.0.metres.is_empty() {
        let (theirs, mine) = (by_metres(other), by_metres(present));
        if theirs == mine {
            return (format!("{theirs} {}", elsewhere(graph, present.0, other.0)), at);
        }
        return (format!("{theirs} instead of {mine}"), at);
    }
    let stretch = |(path, actions): (&Path, &[String])| {
        let within = shared..path.doors.len() - ending;
        by_doors(graph, &path.doors[within.clone()], &actions[within])
    };
    (format!("{} instead of {}", stretch(other), stretch(present)), at)
}

/// By what another way on which as much of the same is done differs: `through laundry instead of corridor 15`.
fn elsewhere(graph: &SiteGraph, present: &Path, other: &Path) -> String {
    let spaces = |path: &Path| {
        let mut names: Vec<String> = Vec::new();
        for (room, _) in path.metres.iter().filter(|(_, metres)| *metres > 0.0) {
            let name = graph[*room].space.and_then(|space| graph.building.space(space));
            names.extend(name.filter(|name| !names.contains(name)));
        }
        names
    };
    let (mine, theirs) = (spaces(present), spaces(other));
    let only = |of: &[String], others: &[String]| {
        let only: Vec<String> =
            of.iter().filter(|name| !others.contains(name)).take(NAMED).cloned().collect();
        if only.is_empty() { String::new() } else { listed(&only) }
    };
    let (new, gone) = (only(&theirs, &mine), only(&mine, &theirs));
    if !new.is_empty() {
        let instead = if gone.is_empty() { String::new() } else { format!(" instead of {gone}") };
        return format!("through {new}{instead}");
    }
    let metres = |path: &Path| number(path.metres.iter().map(|(_, metres)| metres).sum());
    let (mine, theirs) = (metres(present), metres(other));
    if mine == theirs {
        return "by another way, as long".to_owned();
    }
    format!("by another way, {theirs} m in all instead of {mine}")
}

/// `walk 12.3 m and walk-on-knee 1 m`: metres by action, in the order in which each is done first.
fn by_metres((path, actions): (&Path, &[String])) -> String {
    let mut runs: Vec<(&str, f64)> = Vec::new();
    for ((_, metres), action) in path.metres.iter().zip(actions) {
        match runs.iter_mut().find(|(known, _)| known == action) {
            Some((_, sum)) => *sum += metres,
            None => runs.push((action, *metres)),
        }
    }
    let tenths = |metres: f64| number((metres * 10.0).round() / 10.0);
    let parts: Vec<String> = runs
        .into_iter()
        .filter(|(_, sum)| *sum > 0.05)
        .map(|(action, sum)| format!("{action} {} m", tenths(sum)))
        .collect();
    listed(&parts)
}

/// `side-walk through door 12, then walk through doors 3 and 4`.
fn by_doors(graph: &SiteGraph, doors: &[DoorIndex], actions: &[String]) -> String {
    let mut runs: Vec<(&str, Vec<String>)> = Vec::new();
    for (&door, action) in doors.iter().zip(actions) {
        let name = graph[door].door.to_string();
        match runs.last_mut() {
            Some((known, names)) if known == action => names.push(name),
            _ => runs.push((action, vec![name])),
        }
    }
    if runs.is_empty() {
        return "no further door".to_owned();
    }
    let run = |(action, names): &(&str, Vec<String>)| {
        let more = names.len().saturating_sub(NAMED);
        let mut named: Vec<String> = names.iter().take(NAMED).cloned().collect();
        if more > 0 {
            named.push(format!("{more} more"));
        }
        format!("{action} through door{} {}", if names.len() == 1 { "" } else { "s" }, listed(&named))
    };
    let more = runs.len().saturating_sub(NAMED);
    let mut parts: Vec<String> = runs.iter().take(NAMED).map(run).collect();
    if more > 0 {
        parts.push("so on".to_owned());
    }
    parts.join(", then ")
}
