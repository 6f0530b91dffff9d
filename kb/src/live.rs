//! A site's knowledge held in memory between edits: an edit costs what depends on it, not what there is.

mod base;
mod kept;
mod renewal;
mod routes;
mod twin;
mod view;

use std::sync::Arc;
use std::time::Instant;

use adit_db::history::Author;
use adit_db::stale::Mark;
use adit_db::{Store, Tx};
use adit_engine::{Changes, Severity};

use crate::answer::Answer;
use crate::derive::{Stage, derive};
use crate::edit::{Done, Edit};
use crate::error::{Error, Result};
use crate::fork::Fork;
use crate::fork::pairs::Known;
use crate::gauge::Gauge;
use crate::generation::{self, Basis};
use crate::graph::Rules;
use crate::grounds::Numbering;
use crate::inputs::Inputs;
use crate::knowledge::{KnowledgeBase, keep_standings};
use crate::progress::Silent;
use crate::report::{Before, Report};
use crate::store::{LastBuild, Tables, places};
use crate::told::{Attached, Tell, Told};
use crate::{classes, states, trees, weights};
pub(crate) use base::Base;
use kept::{Kept, Written};
pub use renewal::Renewal;
use routes::KeptRoutes;
pub use view::View;

/// A built site, ready for many edits. What it writes is what [`KnowledgeBase::edit`] would write.
///
/// Rules and map are those of the files when it was opened. Edits of other programs are seen: before the next edit
/// all is derived anew.
pub struct Live {
    site: Arc<KnowledgeBase>,
    store: Store,
    memory: Memory,
    /// Whether ways between any two rooms are kept ready.
    is_prepared: bool,
}

struct Memory {
    inputs: Arc<Inputs>,
    basis: Basis,
    generation: u64,
    base: Base,
    numbering: Numbering,
    kept: Kept,
    routes: KeptRoutes,
    gauge: Arc<Gauge>,
    /// The rules' names, by number.
    rules: Arc<Rules>,
    /// Names the cut of the floor.
    layout: Arc<str>,
    /// Whether the kept routes are older than rooms and doors.
    routes_due: bool,
    /// Routes between places, as far as previews asked for them.
    known: Arc<Known>,
}

/// What an edit did.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The edit; `None` where only time has passed.
    pub done: Option<Done>,
    /// Number of the knowledge base's state.
    pub generation: u64,
    /// Rooms whose row was written.
    pub rooms: usize,
    /// Doors whose row was written.
    pub doors: usize,
    /// Rows of routes that were written.
    pub tree_rows: usize,
    /// Whether the kept routes are stale until [`Live::renew_routes`]; [`Live::route`] is right at once.
    pub routes_due: bool,
    /// Whether the whole site was derived anew, since what planners need changed.
    pub anew: bool,
    /// What was done, and how long it took.
    pub stages: Vec<Stage>,
}

/// The mark of routes that have yet to follow.
const ROUTES: &str = "routes";

/// Why an edit ends before it is committed.
enum Stop {
    /// All has to be derived anew.
    Anew,
    Failed(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

impl From<adit_db::Error> for Stop {
    fn from(error: adit_db::Error) -> Self {
        Self::Failed(error.into())
    }
}

impl Live {
    /// Takes a site's knowledge into memory; builds the site where it is not built, or its tables were edited since.
    pub fn open(site: KnowledgeBase) -> Result<Self> {
        if let Some(live) = Self::of_built(&site)? {
            let (store, memory) = live;
            return Ok(Self { site: Arc::new(site), store, memory, is_prepared: false });
        }
        site.build(&Silent)?;
        match Self::of_built(&site)? {
            Some((store, memory)) => Ok(Self { site: Arc::new(site), store, memory, is_prepared: false }),
            None => Err(Error::said(
                "live/stale",
                "the site's tables were edited while it was opened",
                Some("open it again".to_owned()),
            )),
        }
    }

    fn of_built(site: &KnowledgeBase) -> Result<Option<(Store, Memory)>> {
        if !site.database().exists() {
            return Ok(None);
        }
        let mut store = Store::open(site.database())?;
        let inputs = site.inputs(&Silent)?;
        let memory = store.snapshot(|tx| Memory::read(tx, site, inputs))?;
        Ok(memory.map(|memory| (store, memory)))
    }

    /// The site.
    pub fn site(&self) -> &KnowledgeBase {
        &self.site
    }

    /// What the expert should know: facts that are lost, tunings that count for nothing, what no rule reads.
    pub fn notes(&self) -> Vec<String> {
        let memory = &self.memory;
        let lost = memory.base.told.lost(&memory.base.attached);
        memory.inputs.notes.iter().chain(&memory.base.told.notes).cloned().chain(lost).collect()
    }

    /// Keeps ways between any two rooms ready, from now on: an answer then takes microseconds where all hardness lies on the
    /// doors, and each edit a little longer.
    pub fn prepare(&mut self) {
        self.is_prepared = true;
        self.memory.routes.prepare();
    }

    /// Lets others read the database while edits are written.
    pub fn share(&mut self) -> Result<()> {
        Ok(self.store.share()?)
    }

    /// Leaves the database as one file. Where others still read it, two files stay beside it; `false` where the file lacks
    /// then what is in those.
    pub fn unshare(mut self) -> Result<bool> {
        Ok(self.store.unshare()?)
    }

    /// Keeps a query of somebody's under a name, or takes it away; whether there is, or was, one.
    pub fn keep_query(&mut self, name: &str, query: Option<(&str, &str)>) -> Result<bool> {
        self.store.transaction(|tx| match query {
            Some((query, who)) => Ok(tx.save_query(name, query, who).map(|()| true)?),
            None => Ok(tx.remove_query(name)?),
        })
    }

    /// Forgets what is in memory, and reads it from the database; built anew where it does not hold.
    pub fn reopen(&mut self) -> Result<Outcome> {
        self.build_anew()
    }

    /// Edits a table and writes all that follows, in one transaction. If anything fails, database and memory are as
    /// before.
    pub fn edit(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        match self.follow(Some((edit, author))) {
            Ok(outcome) => Ok(outcome),
            Err(Stop::Failed(error)) => Err(error),
            Err(Stop::Anew) => self.edit_anew(edit, author),
        }
    }

    /// Writes what follows from an edit, or from the clock alone, in one transaction.
    fn follow(&mut self, edit: Option<(&Edit, &Author)>) -> std::result::Result<Outcome, Stop> {
        let Self { site, store, memory, .. } = self;
        let mut prepared = None;
        let mut clock = Clock::new();
        let outcome = store.transaction(|tx| -> std::result::Result<(), Stop> {
            prepared = Some(memory.follow(tx, site, edit, &mut clock)?);
            Ok(())
        });
        clock.lap("commit");
        match (outcome, prepared) {
            (Ok(()), Some((done, step))) => Ok(memory.accept(done, step, clock.stages)),
            (Ok(()), None) => Err(Error::said("live", "the edit came to nothing", None).into()),
            (Err(stop), _) => {
                memory.take_back()?;
                Err(stop)
            }
        }
    }

    /// Follows what happened without this program: edits of other programs, facts that ended, hours that began or
    /// ended. `None` where nothing did.
    pub fn catch_up(&mut self) -> Result<Option<Outcome>> {
        let memory = &self.memory;
        let is_ours = |mark: &Mark| memory.routes_due && mark.table == ROUTES;
        let (generation, is_edited) = self.store.snapshot(|tx| -> Result<_> {
            Ok((generation::read(tx)?, !tx.stale_marks()?.iter().all(is_ours)))
        })?;
        if generation == memory.generation && !is_edited {
            if !memory.base.told.is_over(&self.site.clock()) {
                return Ok(None);
            }
            match self.follow(None) {
                Ok(outcome) => return Ok(Some(outcome)),
                Err(Stop::Failed(error)) => return Err(error),
                Err(Stop::Anew) => {}
            }
        }
        self.build_anew().map(Some)
    }

    /// Takes the site as its files now are. Where they cannot be used, all stays as it was.
    pub fn open_again(&mut self, site: KnowledgeBase) -> Result<Outcome> {
        let report = site.build(&Silent)?;
        let before = std::mem::replace(&mut self.site, Arc::new(site));
        if let Err(error) = self.read_again() {
            self.site = before;
            return Err(error);
        }
        Ok(anew(None, report))
    }

    /// Tells a fact about one object, as [`Live::edit`] does.
    pub fn tell(&mut self, fact: Tell, author: &Author) -> Result<Outcome> {
        self.edit(&Edit::Tell(fact), author)
    }

    /// Takes a fact back, by its number.
    pub fn retract(&mut self, fact: i64, author: &Author) -> Result<Outcome> {
        self.edit(&Edit::Retract(fact), author)
    }

    /// The route of least hardness to the one of several goals that costs least, with everything that was edited so far.
    /// Nothing is read but memory.
    pub fn route(&self, start: &str, goals: &[String], robot: Option<&str>) -> Result<Answer> {
        self.view().route(start, goals, robot)
    }

    /// A copy of what is known, in memory only, to try edits on.
    pub fn fork(&self) -> Fork {
        let memory = &self.memory;
        Fork {
            site: Arc::clone(&self.site),
            inputs: Arc::clone(&memory.inputs),
            base: memory.base.fork(),
            graph: Arc::clone(memory.routes.graph()),
            gauge: Arc::clone(&memory.gauge),
            rules: Arc::clone(&memory.rules),
            generation: memory.generation,
            known: Arc::clone(&memory.known),
            patience: crate::fork::PATIENCE,
        }
    }

    /// Builds the site and takes what came of it into memory.
    fn build_anew(&mut self) -> Result<Outcome> {
        let report = self.site.build(&Silent)?;
        self.read_again()?;
        Ok(anew(None, report))
    }

    /// Takes the built site into memory.
    fn read_again(&mut self) -> Result<()> {
        let Some((store, memory)) = Self::of_built(&self.site)? else {
            let help = Some("open it again".to_owned());
            return Err(Error::said("live/stale", "the site's tables were edited meanwhile", help));
        };
        (self.store, self.memory) = (store, memory);
        if self.is_prepared {
            self.memory.routes.prepare();
        }
        Ok(())
    }

    /// The edit by way of everything, as `adit tune` does it.
    fn edit_anew(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        let (done, report) = self.site.edit(edit, author, false, &Silent)?;
        self.read_again()?;
        Ok(anew(Some(done), report))
    }
}

/// What came of deriving everything anew.
fn anew(done: Option<Done>, report: Report) -> Outcome {
    Outcome {
        done,
        generation: report.generation,
        rooms: report.rooms.changed,
        doors: report.doors.changed,
        tree_rows: report.routes.rows as usize,
        routes_due: false,
        anew: true,
        stages: report.stages,
    }
}

/// What is accepted once it is committed.
struct Step {
    told: Told,
    attached: Attached,
    generation: u64,
    numbering: Numbering,
    written: Written,
    routes: routes::Renewed,
}

impl Memory {
    /// What was built; `None` where it is not built as the tables now stand.
    fn read(tx: &mut Tx<'_>, site: &KnowledgeBase, inputs: Inputs) -> Result<Option<Self>> {
        let texts = site.site().texts().to_string();
        let generation = generation::read(tx)?;
        let is_built = generation > 0 && tx.site_value("texts")?.as_deref() == Some(&texts);
        if !is_built || !tx.stale_marks()?.is_empty() {
            return Ok(None);
        }
        let before = Before::read(tx)?;
        let told = site.told(tx, &inputs.rules)?;
        let basis = Basis::new(site.site(), &inputs.world, &inputs.rules);
        if tx.site_value("basis")?.as_deref() != Some(&basis.with(&told)) {
            return Ok(None);
        }
        let mut memory = LastBuild::new(tx, &before);
        let derived = derive(&inputs.world, &told, site.planners(), &inputs.rules, &mut memory, &Silent)?;
        let mut numbering = Numbering::new(&before.witnesses);
        let made = Tables::new(&derived, &inputs.rules, &mut numbering)?;
        if made.rooms != before.rooms || made.doors != before.doors {
            return Ok(None);
        }
        let robots = site.robots(tx)?;
        let uses = made.uses();
        let graph = crate::graph::SiteGraph::new(made.rooms, made.doors, places(&inputs.world));
        let plan = trees::plan(&graph, &robots, site.site().starts.as_ref())?;
        if !before.same_starts(&plan.starts) {
            return Ok(None);
        }
        let kept = Kept::new(made.areas, made.derivations, uses);
        let routes = KeptRoutes::new(graph, plan);
        let gauge = Gauge::new(&inputs.world, &states::in_force(tx)?);
        let layout = view::layout(routes.graph());
        let rules = tx.rules()?.into_iter().map(|rule| (rule.rule, rule.name)).collect();
        Ok(Some(Self {
            inputs: Arc::new(inputs),
            basis,
            generation,
            base: Base::of(derived, told),
            numbering,
            kept,
            routes,
            gauge: Arc::new(gauge),
            rules: Arc::new(rules),
            layout,
            routes_due: false,
            known: Arc::default(),
        }))
    }

    /// Edits, and writes what follows.
    fn follow(
        &mut self,
        tx: &mut Tx<'_>,
        site: &KnowledgeBase,
        edit: Option<(&Edit, &Author)>,
        clock: &mut Clock,
    ) -> std::result::Result<(Option<Done>, Step), Stop> {
        let is_ours = |mark: &Mark| self.routes_due && mark.table == ROUTES;
        if generation::read(tx)? != self.generation || !tx.stale_marks()?.iter().all(is_ours) {
            return Err(Stop::Anew);
        }
        let done = match edit {
            Some((edit, author)) => Some(edit.apply(tx, site, &self.inputs.rules, author)?),
            None => None,
        };
        let told = site.told(tx, &self.inputs.rules)?;
        clock.lap("edit");
        let Some(attached) = self.base.tell(&told, site)? else { return Err(Stop::Anew) };
        let changes = self.base.knowledge.update(&self.inputs.rules);
        let failed = self.base.knowledge.problems(&self.inputs.rules);
        if failed.iter().any(|problem| problem.severity == Severity::Error) {
            let failed = failed.into_iter().filter(|problem| problem.severity == Severity::Error);
            return Err(Stop::Failed(Error::all(failed)));
        }
        if site.planners().iter().any(|planner| needs_changed(&planner.signature().needs, &changes)) {
            return Err(Stop::Anew);
        }
        weights::check_changes(&self.base.knowledge, &changes, self.routes.graph())?;
        clock.lap("rules");
        let mut numbering = self.numbering.clone();
        let written = self.kept.differences(
            &self.base.knowledge,
            &self.inputs.rules,
            &changes,
            &mut numbering,
            &self.routes,
        );
        written.write(tx, &numbering)?;
        clock.lap("rows of rooms and doors");
        let Some(routes) = self.routes.renew(&written) else { return Err(Stop::Anew) };
        clock.lap("search");
        KeptRoutes::write(tx, &routes)?;
        let same = written.rooms.is_empty() && written.doors.is_empty();
        let generation = generation::renew(tx, same, &self.basis.with(&told))?;
        keep_standings(tx, &told, &attached)?;
        told.sign(tx)?;
        tx.mark_fresh()?;
        if self.routes_due || routes.is_due {
            tx.mark_stale(ROUTES)?;
        }
        clock.lap("rows of routes");
        Ok((done, Step { told, attached, generation, numbering, written, routes }))
    }

    /// Makes a committed edit part of what is known.
    fn accept(&mut self, done: Option<Done>, step: Step, stages: Vec<Stage>) -> Outcome {
        let (rooms, doors) = (step.written.rooms.len(), step.written.doors.len());
        let tree_rows = step.routes.rows();
        self.routes_due |= step.routes.is_due;
        let routes_due = self.routes_due;
        (self.generation, self.numbering) = (step.generation, step.numbering);
        self.base.accept(step.told, step.attached);
        self.known = Arc::default();
        self.routes.accept(&step.written, step.routes);
        self.kept.accept(step.written, &mut self.numbering);
        Outcome {
            done,
            generation: step.generation,
            rooms,
            doors,
            tree_rows,
            routes_due,
            anew: false,
            stages,
        }
    }

    /// Makes an edit undone that was not committed.
    fn take_back(&mut self) -> Result<()> {
        self.base.take_back()?;
        self.base.knowledge.update(&self.inputs.rules);
        self.routes.take_back();
        Ok(())
    }
}

/// Whether something changed that a planner works from.
pub(crate) fn needs_changed(needs: &[String], changes: &Changes) -> bool {
    needs.iter().any(|need| {
        let (class, property) = classes::split(need);
        changes.classes.get(class).is_some_and(|class| {
            class.moved.is_some() || !class.added.is_empty() || class.changed.contains_key(property)
        })
    })
}

/// Times stages.
struct Clock {
    began: Instant,
    stages: Vec<Stage>,
}

impl Clock {
    fn new() -> Self {
        Self { began: Instant::now(), stages: Vec::new() }
    }

    fn lap(&mut self, name: &str) {
        self.stages.push(Stage { name: name.to_owned(), took: self.began.elapsed(), kept: false });
        self.began = Instant::now();
    }
}
