//! A sequence of tasks with a change in the middle, over many seeds (Chen 1994, section 4, Figures 4 and 5).

use std::sync::Arc;

use rayon::prelude::*;

use super::judge::{ChangeFacts, EdgeFacts, Judge, LandmarkFacts, Strategy, Trust};
use super::object::Object;
use super::planner::{Adapt, Outcome, Plugins, Report, Settings};
use super::probe::Probe;
use super::robot::{Configuration, Robot, length};
use super::workcell::{Workcell, WorkcellError};
use crate::random::Random;

/// Tasks with goals that recur, and a change of the cell after some of them.
#[derive(Clone, Debug)]
pub struct Scenario {
    pub name: String,
    pub robot: Arc<dyn Robot>,
    /// The objects before the change.
    pub objects: Vec<Object>,
    /// The objects after it.
    pub changed: Vec<Object>,
    /// How many tasks come before it.
    pub change_after_task: u32,
    pub tasks: u32,
    /// Where the robot is at first.
    pub home: Configuration,
    /// The goals among which each task chooses.
    pub goals: Vec<Configuration>,
    /// The goals that join them after the change.
    pub added_goals: Vec<Configuration>,
}

pub struct Experiment<'e> {
    pub scenario: &'e Scenario,
    pub plugins: &'e Plugins,
    /// The parameters; the seed of each run is told from [`seed`](Self::seed).
    pub settings: &'e Settings,
    /// How near an object counts as touched, metres.
    pub touching_m: f64,
    pub runs: u32,
    /// The seed of the first run; each next run has the next one.
    pub seed: u64,
    /// A judge for a run. Which strategy follows the change is not asked: the method says it.
    pub judge: &'e (dyn Fn() -> Box<dyn Judge> + Sync),
    /// Who keeps what a run with this seed learns; making one is not timed, what it does is.
    pub keeper: &'e (dyn Fn(Method, u64) -> Box<dyn Keeper> + Sync),
    /// The seconds that went by since some time, since this crate has no clock.
    pub clock: &'e (dyn Fn() -> f64 + Sync),
    pub progress: &'e (dyn Fn() + Sync),
}

/// Takes what was learned from the planner.
pub trait Keeper {
    /// At first, before the first task, which is not timed; and when the cell changed.
    fn change(&mut self, adapt: &mut Adapt);
    /// After a task.
    fn task(&mut self, adapt: &mut Adapt, goal: &Configuration, report: &Report);
    /// After the last one, as a part of it.
    fn end(&mut self, adapt: &mut Adapt);
}

/// Keeps nothing.
#[derive(Clone, Copy, Debug)]
pub struct KeepNothing;

impl Keeper for KeepNothing {
    fn change(&mut self, adapt: &mut Adapt) {
        adapt.take_noted();
    }

    fn task(&mut self, adapt: &mut Adapt, _goal: &Configuration, _report: &Report) {
        adapt.take_noted();
    }

    fn end(&mut self, _adapt: &mut Adapt) {}
}

/// Who does the tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// Solve alone, which learns nothing.
    Solve,
    Adapt(Strategy),
}

/// A task, over all runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// Its number, from 1.
    pub task: u32,
    /// Evaluations up to its end, mean.
    pub evaluations: f64,
    /// Their standard deviation over the runs.
    pub evaluations_sd: f64,
    /// Length of the task's path, mean over the runs that found one, by the distance of configurations.
    pub path_length: f64,
    /// Seconds up to its end, mean.
    pub seconds: f64,
    /// Calls of Solve up to its end, mean.
    pub solves: f64,
    pub failures: u32,
}

/// What came out, task by task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    pub rows: Vec<Row>,
    /// Evaluations up to the end of each task, run by run: to compare methods on the same tasks.
    pub evaluations: Vec<Vec<u64>>,
    /// Calls of Solve up to the end of each task, run by run.
    pub solves: Vec<Vec<u64>>,
}

struct Sample {
    evaluations: u64,
    solves: u64,
    length: Option<f64>,
    seconds: f64,
}

impl Experiment<'_> {
    /// Runs a method over all seeds, in parallel. Equal arguments give equal curves, but for the seconds.
    pub fn run(&self, method: Method) -> Result<Curve, WorkcellError> {
        let runs: Result<Vec<Vec<Sample>>, WorkcellError> = (0..self.runs)
            .into_par_iter()
            .map(|run| {
                let samples = self.one_run(method, self.seed + u64::from(run));
                (self.progress)();
                samples
            })
            .collect();
        Ok(curve(&runs?))
    }

    /// The goals of a run: each differs from the one before.
    fn goals(&self, seed: u64) -> Vec<&Configuration> {
        let scenario = self.scenario;
        let mut random = Random::new(seed);
        let all: Vec<&Configuration> = scenario.goals.iter().chain(&scenario.added_goals).collect();
        let mut here = &scenario.home;
        let mut goals = Vec::new();
        for task in 0..scenario.tasks {
            let has_changed = task >= scenario.change_after_task;
            let known = if has_changed { &all[..] } else { &all[..scenario.goals.len()] };
            let others: Vec<&Configuration> = known.iter().copied().filter(|goal| *goal != here).collect();
            let Some(goal) = others.get(random.below(others.len())) else { break };
            here = goal;
            goals.push(here);
        }
        goals
    }

    fn one_run(&self, method: Method, seed: u64) -> Result<Vec<Sample>, WorkcellError> {
        match method {
            Method::Solve => self.solve_alone(seed),
            Method::Adapt(strategy) => self.learn(strategy, seed),
        }
    }

    fn learn(&self, strategy: Strategy, seed: u64) -> Result<Vec<Sample>, WorkcellError> {
        let scenario = self.scenario;
        let mut judge = Fixed { strategy, judge: (self.judge)() };
        let cell = Workcell::new(scenario.robot.clone(), scenario.objects.clone(), self.touching_m)?;
        let settings = Settings { seed, ..self.settings.clone() };
        let mut adapt = Adapt::new(cell, self.plugins.clone(), settings, scenario.home.clone());
        let mut keeper = (self.keeper)(Method::Adapt(strategy), seed);
        keeper.change(&mut adapt);
        let goals = self.goals(seed);
        let began = (self.clock)();
        let mut samples = Vec::new();
        for (task, goal) in (0..).zip(&goals) {
            if task == scenario.change_after_task {
                adapt.change(scenario.changed.clone(), &mut judge)?;
                keeper.change(&mut adapt);
            }
            let report = adapt.task(goal, &mut judge);
            if report.outcome != Outcome::Found {
                adapt.put((*goal).clone());
            }
            keeper.task(&mut adapt, goal, &report);
            if samples.len() + 1 == goals.len() {
                keeper.end(&mut adapt);
            }
            samples.push(Sample {
                evaluations: adapt.cell().evaluations(),
                solves: adapt.progress().tally.solves,
                length: (report.outcome == Outcome::Found).then_some(report.length),
                seconds: (self.clock)() - began,
            });
        }
        Ok(samples)
    }

    fn solve_alone(&self, seed: u64) -> Result<Vec<Sample>, WorkcellError> {
        let scenario = self.scenario;
        let goals = self.goals(seed);
        let began = (self.clock)();
        let mut random = Random::new(seed ^ 0x5eed);
        let mut here = &scenario.home;
        let (mut evaluations, mut samples) = (0, Vec::new());
        for (task, goal) in (0..).zip(goals) {
            let objects =
                if task < scenario.change_after_task { &scenario.objects } else { &scenario.changed };
            let mut cell = Workcell::new(scenario.robot.clone(), objects.clone(), self.touching_m)?;
            let path = self.plugins.solve.solve(&mut Probe::new(&mut cell), here, goal, &mut random);
            evaluations += cell.evaluations();
            here = goal;
            samples.push(Sample {
                evaluations,
                solves: u64::from(task) + 1,
                length: path.map(|path| length(&path)),
                seconds: (self.clock)() - began,
            });
        }
        Ok(samples)
    }
}

fn curve(runs: &[Vec<Sample>]) -> Curve {
    let tasks = runs.iter().map(Vec::len).min().unwrap_or(0);
    let row = |task: usize| {
        let samples = || runs.iter().map(|run| &run[task]);
        let mean = |of: &dyn Fn(&Sample) -> f64| samples().map(of).sum::<f64>() / runs.len() as f64;
        let evaluations = mean(&|sample| sample.evaluations as f64);
        let squares: f64 = samples().map(|s| (s.evaluations as f64 - evaluations).powi(2)).sum();
        let lengths: Vec<f64> = samples().filter_map(|sample| sample.length).collect();
        Row {
            task: task as u32 + 1,
            evaluations,
            evaluations_sd: (squares / (runs.len().max(2) - 1) as f64).sqrt(),
            path_length: lengths.iter().sum::<f64>() / lengths.len().max(1) as f64,
            seconds: mean(&|sample| sample.seconds),
            solves: mean(&|sample| sample.solves as f64),
            failures: (runs.len() - lengths.len()) as u32,
        }
    };
    let of_runs = |of: &dyn Fn(&Sample) -> u64| runs.iter().map(|run| run.iter().map(of).collect()).collect();
    Curve {
        rows: (0..tasks).map(row).collect(),
        evaluations: of_runs(&|sample| sample.evaluations),
        solves: of_runs(&|sample| sample.solves),
    }
}

struct Fixed {
    strategy: Strategy,
    judge: Box<dyn Judge>,
}

impl Judge for Fixed {
    fn strategy(&mut self, _facts: &ChangeFacts) -> Strategy {
        self.strategy
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        self.judge.landmark(facts)
    }

    fn trust(&mut self, facts: &EdgeFacts) -> Trust {
        self.judge.trust(facts)
    }
}
