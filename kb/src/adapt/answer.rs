//! What a task and a change gave, for programs and for people.

use adit_planners::adapt::Changed;
use serde_json::{Value, json};

use super::judge::{strategy_word, told};
use super::session::Done;
use crate::words::number::number;

pub fn task_json(done: &Done) -> Value {
    let mut answer = json!({
        "status": if done.reason.is_none() { "ok" } else { "no_path" },
        "goal": done.goal.name,
    });
    if let Some(reason) = &done.reason {
        answer["reason"] = json!(reason);
    }
    if let Some(at) = &done.at {
        answer["configuration"] = json!(at);
    }
    if let Some(report) = &done.report {
        answer["task"] = json!(report.task);
        if done.reason.is_none() {
            answer["path"] = json!(report.path);
            answer["length"] = json!(report.length);
        }
        answer["evaluations"] = json!(report.evaluations);
        answer["solve_calls"] = json!(report.tally.solves);
        answer["reach_calls"] = json!(report.tally.reaches);
        answer["edges_added"] = json!(report.tally.edges_added);
        answer["edges_removed"] = json!(report.tally.edges_removed);
    }
    answer["seconds"] = json!(done.took.as_secs_f64());
    if let Some(changed) = &done.changed {
        answer["change"] = change_json(changed);
    }
    answer
}

/// A change of the cell as JSON.
pub fn change_json(changed: &Changed) -> Value {
    json!({
        "strategy": strategy_word(changed.strategy),
        "facts": told(&changed.facts),
        "evaluations": changed.evaluations,
        "solve_calls": changed.solves,
    })
}

/// A change of the cell in a sentence.
pub fn change_line(changed: &Changed) -> String {
    let facts = &changed.facts;
    let kinds = [
        (facts.appeared, "came"),
        (facts.gone, "went"),
        (facts.moved, "moved"),
        (facts.reshaped, "changed shape"),
    ];
    let said: Vec<String> = kinds
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {} {what}", if *count == 1 { "object" } else { "objects" }))
        .collect();
    let by = [(facts.moved_m, "m"), (facts.turned.to_degrees(), "degrees")];
    let by = by.iter().filter(|(far, _)| *far > 0.0).map(|(far, unit)| format!("{} {unit}", number(*far)));
    let far = match by.collect::<Vec<String>>() {
        far if far.is_empty() => String::new(),
        far => format!(" (by up to {})", far.join(" and ")),
    };
    let mut parts = vec![format!("the cell changed: {}{far}", said.join(", "))];
    if facts.vertices_moved > 0 {
        parts.push(format!("{} subgoals went along", facts.vertices_moved));
    }
    if facts.vertices_dropped > 0 {
        let dropped = facts.vertices_dropped;
        parts.push(format!("{dropped} subgoals are dropped, as their object went or they are out of reach"));
    }
    parts.push(format!("repair {}", strategy_word(changed.strategy)));
    parts.join("; ")
}
