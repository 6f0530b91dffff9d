//! A way contrasted with the best one, in sentences.

use std::fmt::Write;

use adit_engine::{Rejected, Rejection, Value};
use adit_planners::routes::{Entry, Goal, Start, Walking};

use super::{WhyNot, WouldWin};
use crate::knowledge::told::Line;
use crate::state::State;
use crate::why::contrast::through::Via;
use crate::why::contrast::{Path, Routes, actions, instead, is_best};
use crate::why::meant::Meant;
use crate::why::probe::Prober;
use crate::why::said::{capital, cell, roughly};
use crate::words::number::number;

/// So many comparisons that failed are told.
const TOLD: usize = 8;

/// A number that changes by no more, as a share, is the same to people.
const HAIR: f64 = 1e-3;

/// In a few words.
pub(super) fn reason(
    fork: &State,
    meant: &Meant,
    routes: &Routes,
    (start, goal): (&str, &str),
    costs: (Option<f64>, Option<f64>, bool),
) -> String {
    let through = meant.words();
    match costs {
        (Some(best), Some(cost), false) if is_best(best, cost) => {
            format!("{through} it costs as much as the best route from {start} to {goal}, {}", number(best))
        }
        (Some(best), Some(cost), _) if is_best(best, cost) => {
            format!("the best route from {start} to {goal} leads {through}, hardness {}", number(best))
        }
        (Some(best), Some(cost), _) => format!(
            "{through} it costs {}, {} more than the best route from {start} to {goal} ({})",
            number(cost),
            number(cost - best),
            number(best)
        ),
        (None, Some(cost), _) => format!("{through} it costs {}", number(cost)),
        (_, None, _) => shut(fork, meant, routes)
            .unwrap_or_else(|| format!("no way leads from {start} {through} to {goal}")),
    }
}

/// That the doorway is closed to a robot, both ways. A way that only comes up to it is none through it.
pub(super) fn closed(fork: &State, meant: &Meant, robot: &str) -> Option<String> {
    let building = &fork.graph().building;
    let doorway = building.doorways.iter().find(|doorway| Some(doorway.doorway) == meant.doorway)?;
    if doorway.closed == Some(true) {
        return Some(building.why_closed(doorway.doorway));
    }
    let is_here = |line: &&Line| {
        line.whom.holds_for(robot)
            && building.doorway_at(line.segment).is_some_and(|at| at.doorway == doorway.doorway)
    };
    building.lines.iter().find(is_here).map(|line| building.why_told_closed(line))
}

/// What keeps all ways out, where that is known.
fn shut(fork: &State, meant: &Meant, routes: &Routes) -> Option<String> {
    let (graph, name) = (fork.graph(), &meant.name);
    if let Via::Doors(doors) = &meant.via
        && let (Some(_), Some(&door)) = (&meant.subject, doors.first())
    {
        let door = &graph[door];
        if door.passable.value == Some(false) && door.passable.rule.is_none() {
            return Some(format!("{name} is told to let nobody through"));
        }
        if door.passable.value == Some(false) {
            return Some(format!("{name} lets no state through"));
        }
        if door.passable.value.is_none() || door.hardness.value.is_none() {
            return Some(format!("{name} has no hardness: no rule gives it one, or rules disagree"));
        }
    }
    let (entries, at): (Vec<Entry>, _) = match &meant.via {
        Via::Rooms(rooms) => (rooms.iter().copied().map(Entry::from).collect(), None),
        Via::Doors(doors) => {
            let sides = doors.iter().flat_map(|&door| [graph.graph()[door].room1, graph.graph()[door].room2]);
            (sides.map(Entry::from).collect(), None)
        }
        Via::Point(at, entries) => (entries.clone(), Some(*at)),
    };
    if entries.is_empty() {
        return Some(format!(
            "no state of the robot fits {}",
            if meant.is_point { format!("at {name}") } else { format!("in {name}") }
        ));
    }
    let there = Goal { rooms: entries.clone(), at };
    let point = at.unwrap_or_else(|| graph.outline(entries[0].room).centre());
    let on = Start { rooms: entries, at: point };
    let basis = fork.basis();
    let to = basis.why_shut(&routes.start, &there).map(|why| format!("no way leads there: {why}"));
    to.or_else(|| basis.why_shut(&on, &routes.goal).map(|why| format!("no way leads on from there: {why}")))
}

/// What is done instead of what, and where most of the difference lies.
pub(super) fn deciding(prober: &Prober, best: &Path, way: &Path) -> Vec<String> {
    let (graph, weights) = (prober.fork.graph(), &prober.present);
    let (theirs, mine) = (actions(prober, way), actions(prober, best));
    let (instead, _) = instead(graph, (best, &mine), (way, &theirs));
    let mut deciding = vec![instead];
    let by_doors = actions(prober, &Path { metres: Vec::new(), doors: way.doors.clone() });
    let doors = way.doors.iter().zip(&by_doors).filter(|(door, _)| !best.doors.contains(door));
    let doors = doors.map(|(&door, action)| {
        let [x, y] = graph[door].at;
        let name = graph.doorway(&graph[door]).unwrap_or_else(|| format!("door {}", graph[door].door));
        let cost = weights[door];
        (cost, format!("{name} at ({x:.2}, {y:.2}) alone costs {}, by {action}", number(cost)))
    });
    // what is walked in a space by one action stands together
    let mut walked: Vec<(String, &String, f64, f64)> = Vec::new();
    for ((room, metres), action) in way.metres.iter().zip(&theirs) {
        let Walking::PerMetre(hardness) = weights[*room] else { continue };
        let space = graph[*room].space.and_then(|space| graph.building.space(space));
        let space = space.unwrap_or_else(|| format!("room {}", graph[*room].name));
        match walked.iter_mut().find(|(of, how, ..)| *of == space && *how == action) {
            Some((.., sum, cost)) => (*sum, *cost) = (*sum + metres, *cost + hardness * metres),
            None => walked.push((space, action, *metres, hardness * metres)),
        }
    }
    let in_spaces =
        walked.into_iter().filter(|(_, _, metres, _)| *metres > 0.0).map(|(space, action, metres, cost)| {
            (cost, format!("{} m in {space} cost {}, by {action}", number(metres), number(cost)))
        });
    // by metres, a door only counts where it costs something itself
    let dearest =
        doors.filter(|(cost, _)| *cost > 0.0).chain(in_spaces).max_by(|one, two| one.0.total_cmp(&two.0));
    deciding.extend(dearest.map(|(_, said)| said));
    deciding
}

/// All of it in one sentence or three.
pub(super) fn sentence(answer: &WhyNot, meant: &Meant) -> String {
    let (Some(best), Some(cost)) = (answer.best, answer.cost) else { return answer.reason.clone() };
    let mut said = format!(
        "{} it would cost {} more ({} instead of {})",
        capital(&meant.words()),
        number(cost - best),
        number(cost),
        number(best)
    );
    for (index, deciding) in answer.deciding.iter().enumerate() {
        said.push_str(if index == 0 { ": " } else { "; " });
        said.push_str(deciding);
    }
    said.push('.');
    if let Some([best, cost]) = answer.driven {
        write!(
            said,
            " Ways are chosen by what they cost close to walls; driven farther off, this one costs {} and the best route {}.",
            number(cost),
            number(best)
        )
        .ok();
    }
    match &answer.would_win {
        Some(cell) if (cell.wins_at - cell.value).abs() <= HAIR * cell.value.abs().max(0.1) => {
            let (name, is) = (cell_name(cell, &answer.robot), number(cell.value));
            let verb = if cell.wins_at < cell.value { "fell" } else { "rose" };
            write!(said, " It would be the best way if {name} {verb} by a thousandth (it is {is}).").ok();
        }
        Some(cell) => {
            let (verb, to) = if cell.wins_at < cell.value {
                ("fell", roughly(cell.wins_at, f64::floor))
            } else {
                ("rose", roughly(cell.wins_at, f64::ceil))
            };
            let (name, is) = (cell_name(cell, &answer.robot), number(cell.value));
            write!(said, " It would be the best way if {name} {verb} to {to} (it is {is}).").ok();
        }
        None if answer.not_looked_further => said.push_str(
            " No number of the tables that was looked at makes it the best way; not all were looked at to the end.",
        ),
        None => said.push_str(" No single number of the tables that says how hard something is makes it the best way."),
    }
    said
}

fn cell_name(of: &WouldWin, robot: &str) -> String {
    cell(&of.table, &of.key, &of.column, robot)
}

/// For each object that a rule did not take: which comparison failed, and by how much.
pub fn failures(rejected: &[Rejected]) -> Vec<String> {
    let mut said: Vec<String> = Vec::new();
    for one in rejected {
        let (Some(key), Rejection::Failed { test, left, right }) = (&one.key, &one.reason) else { continue };
        let by = match (left, right) {
            (Some(Value::Number(left)), Some(Value::Number(right))) => {
                let (short, one, two) = (number((left - right).abs()), number(*left), number(*right));
                if left.total_cmp(right).is_eq() {
                    format!(": both are {one}")
                } else {
                    format!(": {one} against {two}, {short} apart")
                }
            }
            _ => String::new(),
        };
        let class = one.class.as_deref().unwrap_or_default().to_lowercase();
        let sentence = format!("{class} {key} fails {test}{by}");
        if !said.contains(&sentence) && said.len() < TOLD {
            said.push(sentence);
        }
    }
    said
}
