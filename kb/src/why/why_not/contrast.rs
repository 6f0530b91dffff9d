//! A way contrasted with the best one, in sentences.

use std::fmt::Write;

use adit_db::door::Door;
use adit_engine::{Rejected, Rejection, Value};
use adit_planners::routes::Walking;

use super::WhyNot;
use crate::why::firm::{Path, Prober, actions, instead};
use crate::why::subject::Subject;
use crate::words::number::number;

/// So many comparisons that failed are told.
const TOLD: usize = 8;

/// Whether a way costs what the best one does; the way through a door is measured by one point of it.
pub(super) fn is_best(best: f64, cost: f64) -> bool {
    cost <= best * (1.0 + 1e-6)
}

/// In a few words.
pub(super) fn reason(
    subject: &Subject,
    door: Option<&Door>,
    (start, goal): (&str, &str),
    costs: (Option<f64>, Option<f64>),
) -> String {
    let name = &subject.name;
    match costs {
        (Some(best), Some(cost)) if is_best(best, cost) => {
            format!("the best route from {start} to {goal} leads through {name}, hardness {}", number(best))
        }
        (Some(best), Some(cost)) => format!(
            "through {name} it costs {}, {} more than the best route from {start} to {goal} ({})",
            number(cost),
            number(cost - best),
            number(best)
        ),
        (None, Some(cost)) => format!("through {name} it costs {}", number(cost)),
        (_, None) => match door.filter(|_| subject.class == "doors") {
            Some(door) if door.passable.value == Some(false) && door.passable.rule.is_none() => {
                format!("{name} is told to let nobody through")
            }
            Some(door) if door.passable.value == Some(false) => format!("{name} lets no state through"),
            Some(door) if door.passable.value.is_none() || door.hardness.value.is_none() => {
                format!("{name} has no hardness: no rule gives it one, or rules disagree")
            }
            _ => format!("no way leads from {start} through {name} to {goal}"),
        },
    }
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
        (
            weights[door],
            format!(
                "door {} at ({x:.2}, {y:.2}) alone costs {}, by {action}",
                graph[door].door,
                number(weights[door])
            ),
        )
    });
    let rooms = way.metres.iter().zip(&theirs).filter_map(|((room, metres), action)| match weights[*room] {
        Walking::PerMetre(hardness) if *metres > 0.0 => {
            let cost = hardness * metres;
            let place = format!(
                "{} m in room {} cost {}, by {action}",
                number(*metres),
                graph[*room].name,
                number(cost)
            );
            Some((cost, place))
        }
        _ => None,
    });
    let in_rooms = rooms.filter(|_| !way.metres.is_empty());
    // by metres, a door only counts where it costs something itself
    let dearest =
        doors.filter(|(cost, _)| *cost > 0.0).chain(in_rooms).max_by(|one, two| one.0.total_cmp(&two.0));
    deciding.extend(dearest.map(|(_, said)| said));
    deciding
}

/// All of it in one sentence or three.
pub(super) fn sentence(answer: &WhyNot) -> String {
    let (Some(best), Some(cost)) = (answer.best, answer.cost) else { return answer.reason.clone() };
    let mut said = format!(
        "Through {} it would cost {} more ({} instead of {})",
        answer.through,
        number(cost - best),
        number(cost),
        number(best)
    );
    for (index, deciding) in answer.deciding.iter().enumerate() {
        said.push_str(if index == 0 { ": " } else { "; " });
        said.push_str(deciding);
    }
    said.push('.');
    match &answer.would_win {
        Some(cell) => {
            let verb = if cell.wins_at < cell.value { "fell" } else { "rose" };
            let (table, key, column) = (&cell.table, &cell.key, &cell.column);
            let (to, is) = (digits(cell.wins_at), number(cell.value));
            write!(said, " It would be the best way if {table}.{key}.{column} {verb} to {to} (it is {is}).")
                .ok();
        }
        None if answer.not_looked_further => said.push_str(
            " No number of the tables that was looked at makes it the best way; not all were, to the end.",
        ),
        None => said.push_str(" No single number of the tables makes it the best way."),
    }
    said
}

/// With enough digits that the number does what is said of it.
fn digits(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// For each object that a rule did not take: which comparison failed, and by how much.
pub(super) fn failures(rejected: &[Rejected]) -> Vec<String> {
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
