//! `adit plan` on a cell: tasks of a robot that learns.

use std::sync::Arc;
use std::time::Instant;

use adit_engine::RuleBase;
use serde_json::json;

use super::args::PlanArgs;
use super::output::{json, line, remark, table};
use super::picture;
use crate::adapt::{
    Beginning, Cell, Done, Session, change_json, change_line, drawn, strategy_of, task_json, taught,
};
use crate::draw::render_cell;
use crate::error::{Code, Error, Result};
use crate::words::number::number;
use crate::words::progress::Bar;

/// Does the tasks that are asked for, one after the other; `false` where one found no path.
pub fn run(args: &PlanArgs, cell: &Cell, rules: &Arc<RuleBase>) -> Result<bool> {
    if !args.gap.is_empty() {
        return Err(Error::said(Code::PlanGap, "a cell has no gap", None));
    }
    let learning = &args.learning;
    let named: Vec<&String> = args.start.iter().chain(&args.goal).chain(&args.more).collect();
    let mut taught_paths = Vec::new();
    for path in &learning.teach {
        taught_paths.push(taught::read(path, &cell.robot)?);
    }
    let beginning = Beginning {
        db: args.db.as_deref(),
        seed: learning.seed,
        from: learning.from.as_deref().map(|from| (from, learning.from_db.as_deref())),
        strategy: learning.strategy.as_deref().and_then(strategy_of),
        taught: taught_paths,
        explains: args.explain,
        goals: named.iter().map(|text| text.as_str()).collect(),
    };
    let (mut session, changed) = Session::begin(cell, rules, beginning)?;
    let mut tasks = Vec::new();
    for text in named {
        let goal = session.cell().goal(text)?;
        tasks.push(session.go(&goal)?);
    }
    let bar = Bar::new("tasks", u64::from(learning.tasks));
    for _ in 0..learning.tasks {
        let Some(goal) = session.draw(learning.seed) else {
            return Err(Error::said(Code::PlanNoGoals, format!("{} has no goal to draw", cell.name), None));
        };
        tasks.push(session.go(&goal)?);
        bar.step();
    }
    drop(bar);
    let written = Instant::now();
    session.settle()?;
    if let Some(last) = tasks.last_mut() {
        last.took += written.elapsed();
    }
    let explained = session.explained();
    if let Some(output) = &args.output {
        picture::save(render_cell(&drawn(&session, &tasks)), output, picture::WIDTH)?;
    }
    if args.json {
        let experience = session.adapt().experience();
        let mut answer = json!({
            "cell": cell.name,
            "change": changed.as_ref().map(change_json),
            "tasks": tasks.iter().map(task_json).collect::<Vec<_>>(),
            "experience": {
                "tasks": session.adapt().progress().tasks,
                "subgoals": experience.vertices().count(),
                "edges": experience.edges().count(),
            },
        });
        if args.explain {
            answer["decisions"] = json!(explained.decisions());
        }
        json(&answer)?;
    } else {
        if let Some(changed) = &changed {
            line(&change_line(changed));
        }
        show(&tasks);
        if args.explain {
            explained.lines().iter().for_each(|text| line(text));
        }
        let experience = session.adapt().experience();
        line(&format!(
            "{} tasks so far; {} subgoals, {} edges{}",
            session.adapt().progress().tasks,
            experience.vertices().count(),
            experience.edges().count(),
            if args.db.is_none() { " (nothing is kept without --db)" } else { "" }
        ));
    }
    Ok(tasks.iter().all(|task| task.reason.is_none()))
}

fn show(tasks: &[Done]) {
    if let [only] = tasks {
        path(only);
    }
    let cells = tasks.iter().map(|done| {
        let figure = |of: fn(&adit_planners::adapt::Report) -> String| {
            done.report.as_ref().map_or_else(String::new, of)
        };
        vec![
            figure(|report| report.task.to_string()),
            done.goal.name.clone(),
            figure(|report| number(report.length)),
            figure(|report| report.evaluations.to_string()),
            figure(|report| report.tally.solves.to_string()),
            figure(|report| report.tally.reaches.to_string()),
            format!("{:.3}", done.took.as_secs_f64() * 1e3),
            done.reason.as_ref().map_or_else(String::new, |reason| format!("no path: {reason}")),
        ]
    });
    if !tasks.is_empty() {
        table(&["task", "goal", "length", "evaluations", "Solve", "Reach", "milliseconds", ""], cells);
    }
    for changed in tasks.iter().filter_map(|done| done.changed.as_ref()) {
        remark(&change_line(changed));
    }
}

fn path(done: &Done) {
    for at in done.report.iter().flat_map(|report| &report.path) {
        let numbers: Vec<String> = at.iter().map(|value| number(*value)).collect();
        line(&format!("  ({})", numbers.join(", ")));
    }
}
