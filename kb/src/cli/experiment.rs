//! `adit experiment`: scenarios over many seeds, as a table, CSV and a picture.

use std::path::{Path, PathBuf};

use clap::Args;

use super::output::{json, line, remark, table};
use super::picture;
use crate::adapt::{ExperimentOutcome, Row, experiment, is_scenario, method_of, scenario, write_csv};
use crate::draw::{Curve, CurvePanel, Scale, render_curves};
use crate::error::{Code, Error, Result};
use crate::plan::rules::{self, Kind};
use crate::site::whole;
use crate::words::number::number;
use crate::words::progress::Bar;

#[derive(Args, Debug)]
pub struct ExperimentArgs {
    /// A scenario, or several (.json)
    pub scenario: PathBuf,
    /// How often each scenario is run
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub runs: u32,
    /// Of chance: the first run has this seed, each next one the next
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// What is compared, by commas
    #[arg(long, value_delimiter = ',', value_name = "STRATEGIES", default_value = "a0,a1,a2,a3,solve",
          value_parser = ["a0", "a1", "a2", "a3", "solve"])]
    pub strategy: Vec<String>,
    /// Only the scenario of this name
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
    /// The rule base: `adapt` or a folder
    #[arg(long, value_name = "RULES", default_value = "adapt")]
    pub rules: String,
    /// Write a row for each scenario, strategy and task
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Draw the curves (the paper's Figure 5): .svg or .png
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
    /// Print the rows as JSON
    #[arg(long)]
    pub json: bool,
}

/// Runs the scenarios; `false` where a task found no path.
pub fn run(args: &ExperimentArgs) -> Result<bool> {
    if let Some(output) = &args.picture {
        picture::check(output)?;
    }
    if !is_scenario(&args.scenario) {
        let message = format!("{} is no scenario; expected a .json file", args.scenario.display());
        let help = "tasks in a cell of your own (.toml) are done by `adit tasks`".to_owned();
        return Err(Error::said(Code::ExperimentFormat, message, Some(help)));
    }
    let cells = match &args.only {
        Some(name) => vec![scenario::one(&args.scenario, Some(name))?],
        None => scenario::read(&args.scenario)?,
    };
    let (rules, remarks) = rules::load(Kind::Adapt, &args.rules, Path::new(""))?;
    for text in &remarks {
        remark(text);
    }
    let mut methods: Vec<_> = args.strategy.iter().filter_map(|word| method_of(word)).collect();
    methods.sort_by_key(|method| (crate::adapt::method_word(*method) == "solve", *method));
    methods.dedup();
    // A file that cannot be written is found before the work.
    for path in args.csv.iter().chain(&args.picture) {
        whole::is_writable(path)?;
    }
    let alone = usize::from(!args.strategy.iter().any(|word| word == "solve"));
    let bar = Bar::new("runs", (cells.len() * (methods.len() + alone)) as u64 * u64::from(args.runs));
    let mut outcomes = Vec::with_capacity(cells.len());
    for cell in &cells {
        outcomes.push(experiment(cell, &rules, &methods, (args.runs, args.seed), &|| bar.step())?);
    }
    drop(bar);
    let rows: Vec<Row> = outcomes.iter().flat_map(|outcome| outcome.rows.iter().cloned()).collect();
    if let Some(path) = &args.csv {
        let mut table = Vec::new();
        write_csv(&rows, &mut table).map_err(|error| {
            Error::said(Code::ExperimentCsv, format!("{}: {error}", path.display()), None)
        })?;
        whole::write(path, &table)?;
    }
    if let Some(output) = &args.picture {
        let title = format!("{} runs of each, seed {}", args.runs, args.seed);
        let panels: Vec<Vec<CurvePanel>> = outcomes.iter().map(panels).collect();
        picture::save(render_curves(&title, &panels), output, picture::WIDTH)?;
    }
    if args.json {
        json(&rows)?;
    } else {
        outcomes.iter().for_each(show);
    }
    let failures: u64 = outcomes.iter().map(|outcome| outcome.failures).sum();
    if failures > 0 {
        let tasks = if failures == 1 { "task" } else { "tasks" };
        remark(&format!("{failures} {tasks} found no path"));
    }
    Ok(failures == 0)
}

/// What is drawn by which pen; the full line is for repair on demand.
const PENS: [&str; 5] = ["a3", "a0", "a1", "a2", "solve"];

/// The three panels of a scenario: ratio, evaluations, time.
fn panels(outcome: &ExperimentOutcome) -> Vec<CurvePanel> {
    let of = |title: &str, level, value: fn(&Row) -> f64| {
        let mut curves: Vec<Curve> = Vec::new();
        for row in &outcome.rows {
            if curves.last().is_none_or(|curve| curve.name != row.strategy) {
                let pen = PENS.iter().position(|strategy| *strategy == row.strategy).unwrap_or(PENS.len());
                curves.push(Curve { name: row.strategy.to_owned(), pen, points: Vec::new() });
            }
            if let Some(curve) = curves.last_mut() {
                curve.points.push((f64::from(row.task), value(row)));
            }
        }
        CurvePanel {
            title: format!("{}: {title}", outcome.scenario),
            across: "task".to_owned(),
            scale: Scale::Linear,
            curves,
            event: outcome.change_after.map(|after| (after as f64, "change".to_owned())),
            level,
        }
    };
    vec![
        of("evaluations over Solve alone", Some(1.0), |row| row.ratio),
        of("evaluations, cumulative", None, |row| row.evaluations),
        of("milliseconds, cumulative", None, |row| row.seconds * 1e3),
    ]
}

/// Some tasks of each strategy: the paper's 1, 16 and 40, the one after the change, some after it, the last.
fn show(outcome: &ExperimentOutcome) {
    let last = outcome.rows.iter().map(|row| row.task).max().unwrap_or(0);
    let after = outcome.change_after.map_or(0, |after| after as u32 + 1);
    let shown = |row: &&Row| [1, 16, 40, 60, 80, last, after].contains(&row.task);
    line(&outcome.scenario);
    let cells = outcome.rows.iter().filter(shown).map(|row| {
        vec![
            row.strategy.to_owned(),
            row.task.to_string(),
            format!("{:.1}", row.evaluations),
            format!("{:.1}", row.evaluations_sd),
            format!("{:.3}", row.ratio),
            number(row.path_length),
            format!("{:.3}", row.seconds * 1e3),
            format!("{:.3}", row.seconds_ratio),
        ]
    });
    let head =
        ["strategy", "task", "evaluations", "sd", "ratio", "path length", "milliseconds", "ratio of time"];
    table(&head, cells);
}
