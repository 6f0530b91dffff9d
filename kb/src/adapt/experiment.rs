//! Experiments (Chen 1994, section 4): scenarios over many seeds, and what came out as a table.

use std::io::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use adit_engine::RuleBase;
use adit_planners::adapt::{
    ChangeFacts, Curve, EdgeFacts, Experiment, Judge, LandmarkFacts, Method, Plugins, Settings, Strategy,
    TOUCHING_M, Trust,
};
use serde::Serialize;

use super::cell::Cell;
use super::judge::{RuleJudge, strategy_of, strategy_word};
use super::kept::{Databases, Kept};
use crate::error::{Code, Error, Result};

/// A row of the table: a task of a method, over all runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub scenario: String,
    /// `a0` to `a3`, or `solve`.
    pub strategy: &'static str,
    /// The task, from 1.
    pub task: u32,
    /// Evaluations up to its end, mean over the runs.
    pub evaluations: f64,
    /// Their standard deviation.
    pub evaluations_sd: f64,
    /// Over those of Solve alone.
    pub ratio: f64,
    /// Length of the task's path, mean.
    pub path_length: f64,
    /// Seconds up to its end, mean: planning, checking, and keeping in SQLite what was learned.
    pub seconds: f64,
    /// Over those of Solve alone, which neither checks nor keeps anything.
    pub seconds_ratio: f64,
}

pub fn method_word(method: Method) -> &'static str {
    match method {
        Method::Solve => "solve",
        Method::Adapt(strategy) => strategy_word(strategy),
    }
}

pub fn method_of(word: &str) -> Option<Method> {
    if word == "solve" { Some(Method::Solve) } else { strategy_of(word).map(Method::Adapt) }
}

#[derive(Clone, Debug)]
pub struct Outcome {
    pub scenario: String,
    /// After how many tasks it changed; `None` where it did not.
    pub change_after: Option<usize>,
    /// The rows of the methods that were asked for, in their order.
    pub rows: Vec<Row>,
    /// Tasks without a path, of all methods and runs.
    pub failures: u64,
}

/// Runs a scenario with each method, all of them on the same tasks; `done` is told of each run. Solve alone is run in any
/// case, since ratios are to it.
pub fn run(
    cell: &Cell,
    rules: &Arc<RuleBase>,
    methods: &[Method],
    (runs, seed): (u32, u64),
    done: &(dyn Fn() + Sync),
) -> Result<Outcome> {
    let scenario = cell.scenario();
    let wrong = |error: &dyn std::fmt::Display| Error::said(Code::ExperimentRules, error.to_string(), None);
    // Rules that cannot be asked are found here, so that a judge can be made for each run.
    RuleJudge::new(rules, None, false).map_err(|error| wrong(&error))?;
    let trouble: Trouble = Arc::default();
    let judge = || -> Box<dyn Judge> {
        let rules = RuleJudge::new(rules, None, false).expect("another one was made of these rules");
        Box::new(Watched { rules, trouble: Arc::clone(&trouble) })
    };
    let databases = Databases::new()?;
    let began = Instant::now();
    let (plugins, settings) = (Plugins::standard(), Settings::default());
    let experiment = Experiment {
        scenario: &scenario,
        plugins: &plugins,
        settings: &settings,
        touching_m: TOUCHING_M,
        runs,
        seed,
        judge: &judge,
        keeper: &|method, seed| Box::new(Kept::new(&databases, cell, (method, seed), &trouble)),
        clock: &|| began.elapsed().as_secs_f64(),
        progress: done,
    };
    let curve = |method| {
        let curve = experiment.run(method).map_err(|error| wrong(&error))?;
        let trouble = trouble.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.as_ref().map_or(Ok(curve), |trouble| Err(wrong(trouble)))
    };
    let alone = curve(Method::Solve)?;
    let mut outcome = Outcome {
        scenario: cell.name.clone(),
        change_after: cell.change.as_ref().map(|change| change.after_task),
        rows: Vec::new(),
        failures: 0,
    };
    for &method in methods {
        let of_method = if method == Method::Solve { alone.clone() } else { curve(method)? };
        outcome.failures += of_method.rows.iter().map(|row| u64::from(row.failures)).sum::<u64>();
        outcome.rows.extend(rows(&cell.name, method, &of_method, &alone));
    }
    Ok(outcome)
}

/// The first thing that rules did not say, or that was not kept, in any of the runs.
type Trouble = Arc<Mutex<Option<String>>>;

/// Rules as a judge of one of many runs; what they do not say is known to all.
struct Watched {
    rules: RuleJudge,
    trouble: Trouble,
}

impl Watched {
    fn ask<T>(&mut self, what: impl FnOnce(&mut RuleJudge) -> T) -> T {
        let answer = what(&mut self.rules);
        if let Some(trouble) = self.rules.trouble() {
            let mut first = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert_with(|| trouble.to_owned());
        }
        answer
    }
}

impl Judge for Watched {
    fn strategy(&mut self, facts: &ChangeFacts) -> Strategy {
        self.ask(|rules| rules.strategy(facts))
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        self.ask(|rules| rules.landmark(facts))
    }

    fn trust(&mut self, facts: &EdgeFacts) -> Trust {
        self.ask(|rules| rules.trust(facts))
    }
}

fn rows(scenario: &str, method: Method, curve: &Curve, alone: &Curve) -> Vec<Row> {
    let row = |(row, alone): (&adit_planners::adapt::Row, &adit_planners::adapt::Row)| Row {
        scenario: scenario.to_owned(),
        strategy: method_word(method),
        task: row.task,
        evaluations: row.evaluations,
        evaluations_sd: row.evaluations_sd,
        ratio: row.evaluations / alone.evaluations.max(1.0),
        path_length: row.path_length,
        seconds: row.seconds,
        seconds_ratio: row.seconds / alone.seconds.max(f64::MIN_POSITIVE),
    };
    curve.rows.iter().zip(&alone.rows).map(row).collect()
}

/// Writes the rows as CSV with a head.
pub fn write_csv(rows: &[Row], to: impl Write) -> std::result::Result<(), csv::Error> {
    let mut writer = csv::Writer::from_writer(to);
    for row in rows {
        writer.serialize(row)?;
    }
    writer.flush()?;
    Ok(())
}
