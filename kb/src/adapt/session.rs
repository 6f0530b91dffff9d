//! A robot that learns in a cell, task by task, and keeps what it learns.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use adit_db::Store;
use adit_planners::adapt::{
    Adapt, Changed, Configuration, Outcome, Plugins, Report, RrtConnect, Settings, Taught, Workcell, distance,
};
use adit_planners::random::Random;

use super::cell::{Cell, Goal};
use super::explain::Explained;
use super::judge::RuleJudge;
use super::keeping::Keeping;
use super::{keep, recall};
use crate::error::{Code, Error, Result};
use crate::site::whole::Whole;
use crate::words::number::counted;

#[derive(Clone, Debug, Default)]
pub struct Beginning<'b> {
    /// Where experience is kept; nothing is kept without.
    pub db: Option<&'b Path>,
    /// Of chance, where there is no experience yet.
    pub seed: u64,
    /// The cell whose experience a new one begins with, and the database that it lies in, where that is another one.
    pub from: Option<(&'b str, Option<&'b Path>)>,
    pub taught: Vec<Vec<Configuration>>,
    /// The goals that it will go to: one that there is not is said before anything is kept.
    pub goals: Vec<&'b str>,
}

pub struct Session {
    cell: Cell,
    /// The cell as its file has it, its change not yet due.
    described: Cell,
    adapt: Adapt,
    judge: RuleJudge,
    keeping: Option<Keeping>,
    /// What of the experience went with the robot's limits, in a sentence.
    narrowed: Option<String>,
}

/// A task that was done, or tried.
#[derive(Clone, Debug)]
pub struct Done {
    pub goal: Goal,
    /// The goal's configuration; `None` where there is none.
    pub at: Option<Configuration>,
    /// What came of it; `None` where the goal has no configuration.
    pub report: Option<Report>,
    /// Why there is no path; `None` where there is one.
    pub reason: Option<String>,
    /// What the cell's change before it did.
    pub changed: Option<Changed>,
    /// Planning and keeping.
    pub took: Duration,
}

impl Done {
    /// Of a task of which nothing came, so far.
    pub(super) const fn none(goal: Goal, reason: Option<String>) -> Self {
        Self { goal, at: None, report: None, reason, changed: None, took: Duration::ZERO }
    }
}

impl Session {
    /// Begins, with what is kept of the cell, and takes in how it changed since then.
    ///
    /// # Arguments
    /// `margin` is how near the robot may come to objects, metres.
    ///
    /// # Returns
    /// The session, and what the change did; `None` where nothing changed.
    pub fn begin(
        (described, margin): (&Cell, f64),
        judge: RuleJudge,
        beginning: Beginning<'_>,
    ) -> Result<(Self, Option<Changed>)> {
        let mut made = Whole::default();
        if let Some(db) = beginning.db {
            made.database(db);
        }
        let mut store = beginning.db.map(open).transpose()?;
        let kept = match &mut store {
            None => None,
            Some(store) => experience(store, described, beginning.from)?,
        };
        let mut plugins = Plugins::standard();
        if !beginning.taught.is_empty() {
            plugins.solve = Arc::new(Taught::new(beginning.taught, RrtConnect::default()));
        }
        let mut narrowed = None;
        let settings = Settings { seed: beginning.seed, ..described.settings.clone() };
        let (adapt, seed, copied_from) = if let Some(kept) = &kept {
            let mut adapt = recall::planner(described, kept, margin, plugins, settings)?;
            narrowed = narrow(&mut adapt, described, &kept.cell.robot);
            (adapt, kept.cell.seed.parse().unwrap_or(beginning.seed), kept.cell.copied_from.clone())
        } else {
            let now = described.after(0);
            let workcell = Workcell::new(now.robot.robot(), now.objects.clone(), margin)
                .map_err(Error::of(Code::PlanCell))?;
            (Adapt::new(workcell, plugins, settings, now.home), beginning.seed, None)
        };
        let cell = described.after(adapt.progress().tasks as usize);
        let described = described.clone();
        let keeping = store.map(|store| Keeping::new(store, seed, copied_from));
        let mut session = Self { cell, described, adapt, judge, keeping, narrowed };
        for goal in beginning.goals {
            session.cell.goal(goal)?;
        }
        let changed = session.take_in()?;
        session.keep(kept.is_none())?;
        made.keep();
        Ok((session, changed))
    }

    pub const fn cell(&self) -> &Cell {
        &self.cell
    }

    /// What of the experience went since the robot's limits are others than when it learned, in a sentence.
    pub fn narrowed(&self) -> Option<&str> {
        self.narrowed.as_deref()
    }

    pub const fn adapt(&self) -> &Adapt {
        &self.adapt
    }

    /// What rules decided since this was last asked; nothing unless it was wanted from the beginning.
    pub fn explained(&mut self) -> Explained {
        self.judge.take_explained()
    }

    /// Compares the cell with what the planner knows of it.
    fn take_in(&mut self) -> Result<Option<Changed>> {
        self.adapt.change(self.cell.objects.clone(), &mut self.judge).map_err(Error::of(Code::PlanCell))
    }

    /// Goes to a goal. Of the configurations in which the tool is there, the one nearest to home is tried first.
    pub fn go(&mut self, goal: &Goal) -> Result<Done> {
        let began = Instant::now();
        let tasks = self.adapt.progress().tasks as usize;
        let mut changed = None;
        if self.described.change.as_ref().is_some_and(|change| change.after_task == tasks) {
            self.settle()?;
            self.cell = self.described.after(tasks);
            changed = self.take_in()?;
            self.keep(false)?;
        }
        let mut done = Done { changed, ..Done::none(goal.clone(), Some(out_of_reach(&goal.name))) };
        for at in self.cell.configurations(goal) {
            let report = self.adapt.task(&at, &mut self.judge);
            let reason = reason(&goal.name, &report);
            let is_elsewhere = matches!(report.outcome, Outcome::GoalInCollision(_));
            self.trust_rules()?;
            let task = keep::task(&goal.name, Some(&at), &report, reason.clone());
            match &mut self.keeping {
                Some(keeping) => keeping.task(&self.cell, &mut self.adapt, task)?,
                None => drop(self.adapt.take_noted()),
            }
            (done.at, done.report, done.reason) = (Some(at), Some(report), reason);
            if !is_elsewhere {
                break;
            }
        }
        done.took = began.elapsed();
        Ok(done)
    }

    /// A goal by chance, none at which the robot is, and none out of its reach; the same seed and number of tasks give the same.
    pub fn draw(&self, seed: u64) -> Option<Goal> {
        const FAR_APART: u64 = 0x9E37_79B9_7F4A_7C15;
        let progress = self.adapt.progress();
        let cell = self.described.after(progress.tasks as usize);
        let is_elsewhere = |goal: &&Goal| {
            let all = self.cell.configurations(goal);
            !all.is_empty() && all.iter().all(|at| distance(at, &progress.here) > 1e-9)
        };
        let goals: Vec<&Goal> = cell.goals.iter().filter(is_elsewhere).collect();
        let drawn = seed.wrapping_add(u64::from(progress.tasks).wrapping_mul(FAR_APART));
        goals.get(Random::new(drawn).below(goals.len())).map(|goal| (*goal).clone())
    }

    /// Writes the tasks that are not yet written. One that is done is written within a tenth of a second of further
    /// planning, or now.
    pub fn settle(&mut self) -> Result<()> {
        self.keeping.as_mut().map_or(Ok(()), |keeping| keeping.settle(&self.cell, &mut self.adapt))
    }

    /// Keeps a change of the cell; `is_new` where nothing was kept before.
    fn keep(&mut self, is_new: bool) -> Result<()> {
        self.trust_rules()?;
        let considered = self.judge.take_considered();
        let Some(keeping) = &mut self.keeping else {
            self.adapt.take_noted();
            return Ok(());
        };
        keeping.write(&self.cell, &mut self.adapt, &considered, is_new)
    }

    /// What the planner did after rules failed rests on no rule.
    fn trust_rules(&self) -> Result<()> {
        match self.judge.trouble() {
            Some(trouble) => Err(Error::said(Code::PlanRules, trouble.to_owned(), None)),
            None => Ok(()),
        }
    }
}

/// Takes out of the experience what the robot's limits no longer admit, where they are others than when it learned.
fn narrow(adapt: &mut Adapt, cell: &Cell, learned_by: &str) -> Option<String> {
    if cell.robot.text() == learned_by {
        return None;
    }
    let (subgoals, edges) = adapt.keep_within_limits();
    let is_beyond = !cell.robot.robot().admits(&adapt.progress().here);
    if subgoals + edges == 0 && !is_beyond {
        return None;
    }
    let mut said = format!(
        "the robot's limits are others than when it learned: {} and {} lie beyond them and are forgotten",
        counted(subgoals, "subgoal"),
        counted(edges, "edge")
    );
    if is_beyond {
        adapt.put(cell.home.clone());
        said.push_str("; so does where it was, and it is taken to be at home");
    }
    Some(said)
}

/// A database to which tasks are written: others may read meanwhile, and no task waits for the disk.
pub(super) fn open(db: &Path) -> Result<Store> {
    let mut store = Store::open_for_worlds(db)?;
    store.share()?;
    store.sync_each(false)?;
    Ok(store)
}

/// What is kept of a cell, or what it begins with.
fn experience(
    store: &mut Store,
    cell: &Cell,
    from: Option<(&str, Option<&Path>)>,
) -> Result<Option<adit_db::experience::Experience>> {
    let name = cell.name.as_str();
    let kept = store.snapshot(|tx| tx.experience(name))?;
    let Some((other, file)) = from else { return Ok(kept) };
    if let Some(kept) = kept {
        let message = format!(
            "there is experience of {name} already, of {} tasks; --from is for a cell that has none",
            kept.cell.tasks
        );
        let help = format!("`DELETE FROM cells WHERE cell = '{name}'` forgets it");
        return Err(Error::said(Code::PlanHasExperience, message, Some(help)));
    }
    let read = |store: &mut Store| store.snapshot(|tx| Ok::<_, Error>((tx.experience(other)?, tx.cells()?)));
    let (copy, cells) = match file {
        None => read(store)?,
        Some(file) => read(&mut Store::open_read_only(file)?)?,
    };
    let Some(mut copy) = copy else {
        let message = format!("there is no experience of {other}");
        let help = if cells.is_empty() {
            "there is none of any cell".to_owned()
        } else {
            format!("there is of: {}", cells.join(", "))
        };
        return Err(Error::said(Code::PlanNoExperience, message, Some(help)));
    };
    // Before anything is written: what is of another robot would stand in the way of this cell's own.
    recall::of_robot(cell, &copy)?;
    copy.cell.copied_from = Some(match file {
        None => other.to_owned(),
        Some(file) => format!("{other} in {}", file.display()),
    });
    name.clone_into(&mut copy.cell.cell);
    store.transaction(|tx| tx.keep_experience(&copy))?;
    Ok(Some(copy))
}

/// Why there is no task at all.
pub(super) fn out_of_reach(name: &str) -> String {
    format!("the tool cannot get to goal {name}: it is out of reach, or beyond the joints' limits")
}

/// Why a task ended without a path.
pub(super) fn reason(name: &str, report: &Report) -> Option<String> {
    match &report.outcome {
        Outcome::Found => None,
        Outcome::GoalBeyondLimits => Some(format!("goal {name} is beyond the limits of the joints")),
        Outcome::GoalInCollision(object) => Some(format!("the robot would touch {object} at goal {name}")),
        Outcome::StartInCollision(object) => Some(format!("the robot touches {object} where it is")),
        Outcome::NotFound => Some(format!("no path to goal {name} was found from where the robot is")),
        other => Some(format!("{other:?}")),
    }
}
