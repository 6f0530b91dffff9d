//! A site's state with what the database keeps of it. Opened from what was built, built from nothing, edited: each is a
//! step of the state, and its change written.

use std::sync::{Arc, OnceLock};

use adit_db::Tx;
use adit_db::door::Door;
use adit_db::history::Author;
use adit_db::room::Room;
use adit_db::stale::Mark;
use adit_engine::{Rule, RuleBase};

use super::report::{Concluded, Report, Routes};
use super::routes::{KeptRoutes, Renewed};
use super::trees::{self, KeptSoFar, Plan, ToKeep};
use super::{by_hand, courses};
use crate::edit::react::{Recalled, make_tables};
use crate::edit::{Done, Edit};
use crate::error::Result;
use crate::graph::{Building, layout};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::generation::{self, Basis};
use crate::knowledge::inputs::Inputs;
use crate::state::before::Before;
use crate::state::keep::{Kept, LastBuild, Written, differing, keep_standings};
use crate::state::{State, Step, Weighed};
use crate::words::progress::{Progress, Silent, Stage, Stopwatch};

/// The mark of routes that have yet to follow.
pub const ROUTES: &str = "routes";

/// When the kept routes follow an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promptness {
    /// With it.
    AtOnce,
    /// With it where that costs milliseconds; else when somebody [renews](super::Renewal) them.
    Later,
}

/// What is known of a site, and what of it is kept.
pub struct Memory {
    pub state: State,
    kept: Kept,
    pub routes: KeptRoutes,
    basis: Basis,
    /// Names the cut of the floor; found when first asked for.
    layout: OnceLock<Arc<str>>,
    /// Whether the kept routes are older than rooms and doors.
    pub routes_due: bool,
}

/// What follows an edit: written, and to be [accepted](Memory::accept) once it is committed.
pub struct Followed {
    done: Option<Done>,
    step: Step,
    kept: KeptNow,
    routes: RoutesNow,
    generation: u64,
    clock: Stopwatch,
}

/// What is kept besides the routes.
enum KeptNow {
    Rows(Written),
    All(Kept),
}

/// What became of the kept routes.
enum RoutesNow {
    Renewed(Renewed),
    All(Plan, Routes),
}

/// What an edit changed, once it is accepted.
pub struct Accepted {
    pub done: Option<Done>,
    /// What rules say otherwise of rooms and doors; `None` where they are cut anew.
    pub weighed: Option<Weighed>,
    /// Rows of routes that were written.
    pub tree_rows: usize,
    /// What rules say otherwise of other things than rooms and doors.
    pub conclusions: Vec<Concluded>,
    /// What rules that react told, in sentences.
    pub reacted: Vec<String>,
    /// The kept routes, where all were looked at.
    pub routes: Option<Routes>,
    /// Whether planners gave facts anew.
    pub anew: bool,
    pub stages: Vec<Stage>,
}

impl Memory {
    /// What was built; `None` where it is not built as files and tables now stand.
    pub fn open(tx: &mut Tx<'_>, site: &Arc<KnowledgeBase>, inputs: &Arc<Inputs>) -> Result<Option<Self>> {
        if !tx.stale_marks()?.is_empty() {
            return Ok(None);
        }
        Self::open_due(tx, site, inputs)
    }

    /// As [`Memory::open`]; the kept routes may have yet to follow.
    pub fn open_due(
        tx: &mut Tx<'_>,
        site: &Arc<KnowledgeBase>,
        inputs: &Arc<Inputs>,
    ) -> Result<Option<Self>> {
        let texts = site.site().texts().to_string();
        let generation = generation::read(tx)?;
        let is_built = generation > 0 && tx.site_value("texts")?.as_deref() == Some(&texts);
        let marks = tx.stale_marks()?;
        if !is_built || marks.iter().any(|mark| mark.table != ROUTES) {
            return Ok(None);
        }
        let told = site.told(tx, &inputs.rules)?;
        let basis = Basis::new(site.site(), &inputs.world, &inputs.rules);
        if !generation::rests_on(tx, &basis.with(&told))? {
            return Ok(None);
        }
        let starts = tx.starts()?;
        let mut state = State::new(Arc::clone(site), Arc::clone(inputs), cut(tx)?);
        let step = state.step(told, &mut LastBuild(tx), &Silent)?;
        if step.is_cut_anew || !step.weighed.is_empty() {
            return Ok(None);
        }
        let kept = Kept::of_opened(&state, &step)?;
        state.accept(step);
        state.generation = generation;
        let floor = (&**state.graph(), &*state.gauge);
        let plan = trees::plan(floor, &site.robots(tx)?, site.site().starts_in_rooms())?;
        let before = Before { graph: state.graph(), starts: &starts, places: &state.graph().places };
        let is_same = before.same_starts(&plan.starts);
        Ok(is_same.then(|| Self { routes_due: !marks.is_empty(), ..Self::of(state, kept, plan, basis) }))
    }

    /// Derives everything from files and tables as they stand, and writes it.
    pub fn build(
        tx: &mut Tx<'_>,
        site: &Arc<KnowledgeBase>,
        inputs: &Arc<Inputs>,
        progress: &dyn Progress,
    ) -> Result<(Self, Report)> {
        let by_hand = by_hand::remarks(tx, site, &inputs.rules)?;
        let concluded = if generation::read(tx)? > 0 { Some(tx.derivations()?) } else { None };
        let starts = tx.starts()?;
        make_tables(tx, &inputs.rules)?;
        let told = site.told(tx, &inputs.rules)?;
        let mut state = State::new(Arc::clone(site), Arc::clone(inputs), cut(tx)?);
        let graph = Arc::clone(state.graph());
        let places = tx.places()?;
        let before = Before { graph: &graph, starts: &starts, places: &places };
        let mut step = state.step_and_react(tx, told, Recalled::OfLastBuild, progress)?;
        let (reacted, failed) = (std::mem::take(&mut step.reacted), std::mem::take(&mut step.failed));
        let mut clock = Stopwatch::new();
        let basis = Basis::new(site.site(), &inputs.world, &inputs.rules);
        let (kept, plan, routes, generation) =
            write_all(tx, &state, &step, (before, &basis), progress, &mut clock)?;
        let weighed = (!step.is_cut_anew).then(|| step.weighed.clone());
        let mut stages = vec![inputs.stage.clone()];
        stages.extend(step.stages.iter().cloned().chain(clock.stages));
        let mut conclusions = concluded.map_or_else(Vec::new, |before| {
            let (gone, new) = differing(&before, kept.derivations());
            Concluded::between(&gone, &new)
        });
        conclusions.retain(|of| of.is_of_rules_alone(&state.knowledge, [&step.attached; 2]));
        state.accept(step);
        state.generation = generation;
        let mut report = Report::new(before, weighed.as_ref(), &mut state, (routes, stages));
        report.concluded = kept.derivations().len();
        (report.conclusions, report.reacted, report.failed) = (conclusions, reacted, failed);
        report.notes.extend(by_hand);
        report.notes.extend(state.courses.iter().flat_map(|courses| courses.notes()));
        Ok((Self::of(state, kept, plan, basis), report))
    }

    /// Edits a table, and writes all that follows, the kept routes too.
    pub fn edit(
        tx: &mut Tx<'_>,
        site: &Arc<KnowledgeBase>,
        inputs: &Arc<Inputs>,
        (edit, author): (&Edit, &Author),
        progress: &dyn Progress,
    ) -> Result<(Done, Report)> {
        // an edit may mend what keeps it from being opened, and a build says what is still wrong
        let mut opened = Self::open(tx, site, inputs).unwrap_or_default();
        let (mut first, mut is_by_others) = (None, false);
        if opened.is_none() {
            site.refuse_anothers(tx)?;
            let marks = tx.stale_marks()?;
            is_by_others = marks.iter().any(|mark| mark.table != ROUTES);
            if !marks.is_empty() && is_built_by(tx, &inputs.rules)? {
                // what others did is no part of what this edit changes
                if let Ok((memory, report)) = Self::build(tx, site, inputs, progress) {
                    opened = Some(memory);
                    first = Some(report);
                }
            }
        }
        make_tables(tx, &inputs.rules)?;
        let done = edit.apply(tx, site, &inputs.rules, author)?;
        let Some(mut memory) = opened else {
            let mut report = Self::build(tx, site, inputs, progress)?.1;
            report.notes.extend((is_by_others && report.generation > 1).then(|| LISTED_TOO.to_owned()));
            return Ok((done, report));
        };
        let graph = Arc::clone(memory.state.graph());
        let starts = memory.routes.plan().starts.clone();
        let followed = memory.follow(tx, Some(done.clone()), Promptness::AtOnce, progress)?;
        let Accepted { weighed, conclusions, reacted, routes, mut stages, .. } = memory.accept(followed);
        stages.insert(0, inputs.stage.clone());
        let before = Before { graph: &graph, starts: &starts, places: &graph.places };
        let routes = routes.unwrap_or_default();
        let mut report = Report::new(before, weighed.as_ref(), &mut memory.state, (routes, stages));
        (report.conclusions, report.reacted) = (conclusions, reacted);
        report.concluded = memory.kept.derivations().len();
        if let Some(first) = first {
            report.reacted.splice(0..0, first.reacted);
            let notes: Vec<String> =
                first.notes.into_iter().filter(|note| !report.notes.contains(note)).collect();
            report.notes.extend(notes);
            report.notes.extend(is_by_others.then(|| TAKEN_IN.to_owned()));
        }
        // nobody waits until all of it is given back
        rayon::spawn(|| drop((memory, graph)));
        Ok((done, report))
    }

    fn of(state: State, kept: Kept, plan: Plan, basis: Basis) -> Self {
        let (routes, layout) = (KeptRoutes::later(plan), OnceLock::new());
        Self { state, kept, routes, basis, layout, routes_due: false }
    }

    /// Names the cut of the floor.
    pub fn layout(&self) -> Arc<str> {
        Arc::clone(self.layout.get_or_init(|| layout(self.state.graph())))
    }

    /// Whether the database is as it was left: nobody else has edited or built it since.
    pub fn is_of(&self, tx: &mut Tx<'_>) -> Result<bool> {
        let is_ours = |mark: &Mark| self.routes_due && mark.table == ROUTES;
        Ok(generation::read(tx)? == self.state.generation && tx.stale_marks()?.iter().all(is_ours))
    }

    /// Writes what follows from the tables as they now are.
    pub fn follow(
        &mut self,
        tx: &mut Tx<'_>,
        done: Option<Done>,
        promptness: Promptness,
        progress: &dyn Progress,
    ) -> Result<Followed> {
        let mut clock = Stopwatch::new();
        let site = Arc::clone(&self.state.site);
        let told = site.told(tx, &self.state.inputs.rules)?;
        if site.course().is_some() {
            // what tables hold there says what rules may speak of
            site.spoken(&self.state.inputs.rules, &told)?;
        }
        clock.lap("edit");
        let mut step = self.state.step_and_react(tx, told, Recalled::Nothing, progress)?;
        if let (Some(before), Some(now)) = (&self.state.courses, &step.courses) {
            step.told.notes.extend(now.renumbered(before));
        }
        clock.skip();
        clock.stages.extend(step.stages.iter().cloned());
        let (state, graph) = (&self.state, Arc::clone(self.state.graph_after(&step)));
        let renewed = match (step.is_anew, promptness) {
            (false, Promptness::Later) if step.courses.is_none() => self.routes.renew(&graph, &step.weighed),
            _ => None,
        };
        let old = state.graph();
        let before = Before { graph: old, starts: &self.routes.plan().starts, places: &old.places };
        if step.is_anew {
            let (kept, plan, routes, generation) =
                write_all(tx, state, &step, (before, &self.basis), progress, &mut clock)?;
            let (kept, routes) = (KeptNow::All(kept), RoutesNow::All(plan, routes));
            return Ok(Followed { done, step, kept, routes, generation, clock });
        }
        let written = self.kept.differences(state, &step);
        written.write(tx, &graph, &step)?;
        clock.lap("rows of rooms and doors");
        let routes = if let Some(renewed) = renewed {
            KeptRoutes::write(tx, &renewed)?;
            RoutesNow::Renewed(renewed)
        } else {
            let so_far = if self.routes_due {
                KeptSoFar::Stored
            } else {
                KeptSoFar::Of(state.graph(), self.routes.plan())
            };
            let to_keep = ToKeep::look(tx, (state, &step), (before, so_far))?;
            let (plan, mut routes) = trees::keep(tx, (state, &step), to_keep, progress)?;
            if let Some(now) = &step.courses {
                routes = courses::keep(tx, state.courses.as_deref(), now)?;
            }
            RoutesNow::All(plan, routes)
        };
        let generation = generation::renew(tx, step.weighed.is_empty(), &self.basis.with(&step.told))?;
        keep_standings(tx, &step.told, &step.attached)?;
        step.told.sign(tx)?;
        tx.mark_fresh()?;
        let is_due = match &routes {
            RoutesNow::Renewed(renewed) => self.routes_due || renewed.is_due,
            RoutesNow::All(..) => false,
        };
        if is_due {
            tx.mark_stale(ROUTES)?;
        }
        clock.lap("rows of routes");
        Ok(Followed { done, step, kept: KeptNow::Rows(written), routes, generation, clock })
    }

    /// Makes a committed edit part of what is known.
    pub fn accept(&mut self, followed: Followed) -> Accepted {
        let Followed { done, step, kept, routes, generation, clock } = followed;
        let (anew, reacted) = (step.is_anew, step.reacted.clone());
        let weighed = (!step.is_cut_anew).then(|| step.weighed.clone());
        let mut conclusions = match kept {
            KeptNow::Rows(written) => {
                let conclusions = Concluded::between(written.gone(), written.added());
                self.kept.accept(written);
                conclusions
            }
            KeptNow::All(kept) => {
                let (gone, new) = differing(self.kept.derivations(), kept.derivations());
                self.kept = kept;
                Concluded::between(&gone, &new)
            }
        };
        // that somebody told something instead, or no longer does, the edit itself says
        let told = [&self.state.attached, &step.attached];
        conclusions.retain(|of| of.is_of_rules_alone(&self.state.knowledge, told));
        self.state.accept(step);
        self.state.generation = generation;
        let (tree_rows, routes) = match routes {
            RoutesNow::Renewed(renewed) => {
                let rows = renewed.rows();
                self.routes_due |= renewed.is_due;
                self.routes.accept(renewed);
                (rows, None)
            }
            RoutesNow::All(plan, routes) => {
                self.routes_due = false;
                self.routes.restart(self.state.graph(), plan);
                (routes.rows as usize, Some(routes))
            }
        };
        if anew {
            self.layout = OnceLock::new();
        }
        Accepted { done, weighed, tree_rows, conclusions, reacted, routes, anew, stages: clock.stages }
    }

    /// Forgets what was written and not committed.
    pub fn take_back(&mut self) -> Result<()> {
        self.state.take_back()?;
        self.routes.take_back(self.state.graph());
        Ok(())
    }
}

/// What others did is taken in before an edit.
const TAKEN_IN: &str =
    "tables were edited by others since the last build: that was taken in first, and is not listed here";

/// What others did is listed with an edit, where rules are other ones as well.
const LISTED_TOO: &str =
    "tables were edited by others since the last build: what follows from that is listed, too";

/// Whether the last build was by these rules.
fn is_built_by(tx: &mut Tx<'_>, rules: &RuleBase) -> Result<bool> {
    let built = tx.rules()?;
    let is_in = |rule: &Rule| built.iter().any(|of| of.name == rule.name() && of.version == rule.version());
    Ok(generation::read(tx)? > 0 && built.len() == rules.rules().len() && rules.rules().iter().all(is_in))
}

/// Rooms, doors, spaces and doorways of the last build.
fn cut(tx: &mut Tx<'_>) -> Result<(Vec<Room>, Vec<Door>, Building)> {
    Ok((tx.rooms()?, tx.doors()?, Building::read(tx)?))
}

/// Writes everything that there is of a state once a step is accepted, and all kept routes.
fn write_all(
    tx: &mut Tx<'_>,
    state: &State,
    step: &Step,
    (before, basis): (Before<'_>, &Basis),
    progress: &dyn Progress,
    clock: &mut Stopwatch,
) -> Result<(Kept, Plan, Routes, u64)> {
    let site = &state.site;
    progress.stage("database");
    let so_far = if step.is_cut_anew { KeptSoFar::OfAnotherCut } else { KeptSoFar::Stored };
    let to_keep = ToKeep::look(tx, (state, step), (before, so_far))?;
    let kept = Kept::write_all(tx, state, step)?;
    tx.replace_site_hours(&site.site().hours)?;
    keep_standings(tx, &step.told, &step.attached)?;
    clock.lap("database");
    progress.stage("routes");
    let (plan, mut routes) = trees::keep(tx, (state, step), to_keep, progress)?;
    if let Some(now) = &step.courses {
        routes = courses::keep(tx, state.courses.as_deref(), now)?;
    }
    clock.lap("routes");
    let is_same = !step.is_cut_anew && step.weighed.is_empty() && routes.changed == Some(0);
    let generation = generation::renew(tx, is_same, &basis.with(&step.told))?;
    site.sign(tx, &state.inputs.rules)?;
    step.told.sign(tx)?;
    Ok((kept, plan, routes, generation))
}
