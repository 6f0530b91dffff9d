//! `adit tasks`: tasks of a robot that learns in a cell.

use std::any::Any;
use std::path::{Path, PathBuf};
use std::time::Instant;

use adit_planners::adapt::{Strategy, TOUCHING_M};
use clap::Args;
use serde_json::json;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, remark, table};
use super::picture;
use crate::adapt::{
    Beginning, Cell, CellOf, Done, RuleJudge, Session, change_json, change_line, drawn, is_scenario,
    scenario, strategy_of, task_json, taught,
};
use crate::draw::render_cell;
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::plan::rules::{self, Kind};
use crate::words::number::number;
use crate::words::progress::Bar;

#[derive(Args, Debug)]
pub struct TasksArgs {
    /// Folder of a site whose map is a cell, such a map alone (a TOML file with `[cell]`), or a scenario (.json)
    pub site: PathBuf,
    /// The goals, one after the other: by name, or as a configuration `a,b`
    #[arg(value_name = "GOAL", allow_hyphen_values = true)]
    pub first: Option<String>,
    /// The second one
    #[arg(value_name = "GOAL", allow_hyphen_values = true, hide = true)]
    pub second: Option<String>,
    /// Those after that
    #[arg(value_name = "GOAL", hide = true)]
    pub more: Vec<String>,
    /// After the goals, so many tasks with goals by chance
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub tasks: u32,
    /// Of chance; experience goes on with the seed that it was begun with
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// A path that is tried before any other is looked for, `[[a, b], ...]`
    #[arg(long, value_name = "PATH.json")]
    pub teach: Vec<PathBuf>,
    /// Begin with a copy of the experience of another cell
    #[arg(long, value_name = "CELL")]
    pub from: Option<String>,
    /// The database of that other cell, if not the same
    #[arg(long, value_name = "FILE", requires = "from")]
    pub from_db: Option<PathBuf>,
    /// What becomes of experience after a change, whatever rules say
    #[arg(long, value_parser = ["a0", "a1", "a2", "a3"])]
    pub strategy: Option<String>,
    /// Which scenario of a file with several
    #[arg(long, value_name = "NAME")]
    pub scenario: Option<String>,
    /// Folder of *.rhai files, instead of the site's own or the shipped ones
    #[arg(long, value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Say which rules decided what
    #[arg(long)]
    pub explain: bool,
    /// Keep the experience in this database; a site keeps it in its own without this, and a map alone nowhere
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// Draw it: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// A cell, how near the robot may come to objects, who judges, and where its site keeps experience.
type Begun = ((Cell, f64), RuleJudge, Option<PathBuf>);

fn of_scenario(args: &TasksArgs) -> Result<Begun> {
    let cell = scenario::one(&args.site, args.scenario.as_deref())?;
    let shipped = Kind::Adapt.shipped()[0].to_owned();
    let name = args.rules.as_ref().map_or(shipped, |folder| folder.display().to_string());
    let (rules, remarks) = rules::load(Kind::Adapt, &name, Path::new(""))?;
    for text in &remarks {
        remark(text);
    }
    let judge = RuleJudge::new(&rules, strategy(args), args.explain).map_err(Error::of(Code::PlanRules))?;
    Ok(((cell, TOUCHING_M), judge, None))
}

fn of_site(args: &TasksArgs) -> Result<Begun> {
    if args.scenario.is_some() {
        let message = format!("{} has no scenarios to choose from: it is no .json", args.site.display());
        return Err(Error::said(Code::PlanScenario, message, None));
    }
    let site = SiteArgs { site: args.site.clone(), db: None, rules: args.rules.clone(), json: args.json };
    let live = Live::open(open(&site)?)?;
    let course = live.site().course().map(|course| &**course as &dyn Any);
    let Some(map) = course.and_then(|course| course.downcast_ref::<CellOf>()) else {
        let message = format!("the map of {} is no cell: there are no tasks to do", live.site().site().name);
        return Err(Error::said(Code::PlanNoCell, message, None));
    };
    let asked = live.asked();
    let judge = RuleJudge::of_site(&asked, strategy(args), args.explain)?;
    let database = (!live.site().is_map_alone()).then(|| live.site().database().to_owned());
    Ok((map.cell_now(&asked)?, judge, database))
}

fn strategy(args: &TasksArgs) -> Option<Strategy> {
    args.strategy.as_deref().and_then(strategy_of)
}

/// Does the tasks that are asked for, one after the other; `false` where one found no path.
pub fn run(args: &TasksArgs) -> Result<bool> {
    if let Some(output) = &args.output {
        picture::check(output)?;
    }
    let begun = if is_scenario(&args.site) { of_scenario(args) } else { of_site(args) };
    let ((cell, margin), judge, database) = begun?;
    let db = args.db.as_ref().or(database.as_ref());
    if args.from.is_some() && db.is_none() {
        let message = "--from begins with a copy of experience, and nothing is kept here without --db";
        return Err(Error::said(Code::PlanNoExperience, message, None));
    }
    let goals: Vec<&str> =
        args.first.iter().chain(&args.second).chain(&args.more).map(String::as_str).collect();
    let mut taught_paths = Vec::new();
    for path in &args.teach {
        taught_paths.push(taught::read(path, &cell.robot)?);
    }
    let beginning = Beginning {
        db: db.map(PathBuf::as_path),
        seed: args.seed,
        from: args.from.as_deref().map(|from| (from, args.from_db.as_deref())),
        taught: taught_paths,
        goals: goals.clone(),
    };
    let (mut session, changed) = Session::begin((&cell, margin), judge, beginning)?;
    if let Some(narrowed) = session.narrowed() {
        remark(narrowed);
    }
    let mut tasks = Vec::new();
    for text in goals {
        let goal = session.cell().goal(text)?;
        tasks.push(session.go(&goal)?);
    }
    let bar = Bar::new("tasks", u64::from(args.tasks));
    for _ in 0..args.tasks {
        let Some(goal) = session.draw(args.seed) else {
            return Err(Error::said(Code::PlanNoGoals, format!("{} has no goal to draw", cell.name), None));
        };
        tasks.push(session.go(&goal)?);
        bar.step();
    }
    drop(bar);
    if tasks.is_empty() {
        remark("no task was asked for: name goals, or say how many with --tasks");
    }
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
            if db.is_none() { " (nothing is kept without --db)" } else { "" }
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
