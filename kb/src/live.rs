//! A site's knowledge held in memory between edits: an edit costs what depends on it, not what there is.

mod kept;
mod routes;

use std::time::Instant;

use adit_db::history::Author;
use adit_db::{Store, Tx};
use adit_engine::{Changes, KnowledgeBase as Inference, Severity};
use adit_planners::facts::Facts;

use crate::derive::{Stage, derive};
use crate::edit::{Done, Edit};
use crate::error::{Error, Result};
use crate::gauge::Gauge;
use crate::generation::{self, Basis};
use crate::grounds::Numbering;
use crate::inputs::Inputs;
use crate::knowledge::KnowledgeBase;
use crate::progress::Silent;
use crate::report::Before;
use crate::store::{LastBuild, Tables, places};
use crate::{classes, trees, weights};
use kept::{Kept, Written};
use routes::KeptRoutes;

/// A built site, ready for many edits. What it writes is what [`KnowledgeBase::edit`] would write.
///
/// Rules and map are those of the files when it was opened. Edits of other programs are seen: before the next edit
/// all is derived anew.
pub struct Live {
    site: KnowledgeBase,
    store: Store,
    memory: Memory,
}

struct Memory {
    inputs: Inputs,
    basis: Basis,
    generation: u64,
    told: Facts,
    knowledge: Inference,
    numbering: Numbering,
    kept: Kept,
    routes: KeptRoutes,
    gauge: Gauge,
}

/// What an edit did.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The edit.
    pub done: Done,
    /// Number of the knowledge base's state.
    pub generation: u64,
    /// Rooms whose row was written.
    pub rooms: usize,
    /// Doors whose row was written.
    pub doors: usize,
    /// Rows of routes that were written.
    pub tree_rows: usize,
    /// Whether the whole site was derived anew, since what planners need changed.
    pub anew: bool,
    /// What was done, and how long it took.
    pub stages: Vec<Stage>,
}

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
            return Ok(Self { site, store, memory });
        }
        site.build(&Silent)?;
        match Self::of_built(&site)? {
            Some((store, memory)) => Ok(Self { site, store, memory }),
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

    /// Edits a table and writes all that follows, in one transaction. If anything fails, database and memory are as
    /// before.
    pub fn edit(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        let Self { site, store, memory } = self;
        let mut prepared = None;
        let mut clock = Clock::new();
        let outcome = store.transaction(|tx| {
            let (done, step) = memory.follow(tx, site, (edit, author), &mut clock)?;
            prepared = Some(step);
            Ok(done)
        });
        clock.lap("commit");
        match (outcome, prepared) {
            (Ok(done), Some(step)) => Ok(memory.accept(done, step, clock.stages)),
            (Ok(_), None) => Err(Error::said("live", "the edit came to nothing", None)),
            (Err(stop), _) => {
                memory.take_back()?;
                match stop {
                    Stop::Failed(error) => Err(error),
                    Stop::Anew => self.edit_anew(edit, author),
                }
            }
        }
    }

    /// The edit by way of everything, as `adit tune` does it.
    fn edit_anew(&mut self, edit: &Edit, author: &Author) -> Result<Outcome> {
        let (done, report) = self.site.edit(edit, author, false, &Silent)?;
        let Some((store, memory)) = Self::of_built(&self.site)? else {
            let help = Some("open it again".to_owned());
            return Err(Error::said("live/stale", "the site's tables were edited meanwhile", help));
        };
        (self.store, self.memory) = (store, memory);
        Ok(Outcome {
            done,
            generation: report.generation,
            rooms: report.rooms.changed,
            doors: report.doors.changed,
            tree_rows: report.routes.rows as usize,
            anew: true,
            stages: report.stages,
        })
    }
}

/// What is accepted once it is committed.
struct Step {
    told: Facts,
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
        let routes = KeptRoutes::read(tx, graph, plan)?;
        let gauge = Gauge::new(&inputs.world, &tx.states()?);
        let knowledge = derived.knowledge;
        Ok(Some(Self { inputs, basis, generation, told, knowledge, numbering, kept, routes, gauge }))
    }

    /// Edits, and writes what follows.
    fn follow(
        &mut self,
        tx: &mut Tx<'_>,
        site: &KnowledgeBase,
        (edit, author): (&Edit, &Author),
        clock: &mut Clock,
    ) -> std::result::Result<(Done, Step), Stop> {
        if generation::read(tx)? != self.generation || !tx.stale_marks()?.is_empty() {
            return Err(Stop::Anew);
        }
        let done = edit.apply(tx, author)?;
        let told = site.told(tx, &self.inputs.rules)?;
        clock.lap("edit");
        self.tell(&told)?;
        let changes = self.knowledge.update(&self.inputs.rules);
        let failed = self.knowledge.problems(&self.inputs.rules);
        if failed.iter().any(|problem| problem.severity == Severity::Error) {
            let failed = failed.into_iter().filter(|problem| problem.severity == Severity::Error);
            return Err(Stop::Failed(Error::all(failed)));
        }
        if site.planners().iter().any(|planner| needs_changed(&planner.signature().needs, &changes)) {
            return Err(Stop::Anew);
        }
        self.check(&changes)?;
        clock.lap("rules");
        let mut numbering = self.numbering.clone();
        let written = self.kept.differences(
            &self.knowledge,
            &self.inputs.rules,
            &changes,
            &mut numbering,
            &self.routes,
        );
        written.write(tx, &numbering)?;
        clock.lap("rows of rooms and doors");
        let robots = site.robots(tx)?;
        let wanted = site.site().starts.as_ref();
        let Some(routes) = self.routes.renew(&written, &robots, wanted, &self.gauge)? else {
            return Err(Stop::Anew);
        };
        clock.lap("search");
        KeptRoutes::write(tx, &routes)?;
        let same = written.rooms.is_empty() && written.doors.is_empty();
        let generation = generation::renew(tx, same, &self.basis.with(&told))?;
        tx.mark_fresh()?;
        clock.lap("rows of routes");
        Ok((done, Step { told, generation, numbering, written, routes }))
    }

    /// Tells the classes that differ. Other columns than before have to be looked at as a build does.
    fn tell(&mut self, told: &Facts) -> std::result::Result<(), Stop> {
        if told.len() != self.told.len() {
            return Err(Stop::Anew);
        }
        for (class, table) in told {
            let Some(before) = self.told.get(class) else { return Err(Stop::Anew) };
            if before == table {
                continue;
            }
            let kinds = |table: &adit_planners::facts::Table| -> Vec<_> {
                let kind = |(name, column): &(String, adit_planners::facts::Column)| {
                    (name.clone(), std::mem::discriminant(column))
                };
                table.columns.iter().map(kind).collect()
            };
            if kinds(before) != kinds(table) {
                return Err(Stop::Anew);
            }
            classes::assert(&mut self.knowledge, class, table)?;
        }
        Ok(())
    }

    fn check(&self, changes: &Changes) -> Result<()> {
        let graph = self.routes.graph();
        let (rooms, doors) = (changes.rows("ROOMS", "hardness"), changes.rows("DOORS", "hardness"));
        let name = |row: usize| format!("room {}", graph.rooms[row].name);
        weights::check_rows(&self.knowledge, "ROOMS", rooms, name)?;
        let name = |row: usize| format!("door {}", graph.doors[row].door);
        weights::check_rows(&self.knowledge, "DOORS", doors, name)
    }

    /// Makes a committed edit part of what is known.
    fn accept(&mut self, done: Done, step: Step, stages: Vec<Stage>) -> Outcome {
        let (rooms, doors) = (step.written.rooms.len(), step.written.doors.len());
        let tree_rows = step.routes.rows();
        (self.told, self.generation, self.numbering) = (step.told, step.generation, step.numbering);
        self.routes.accept(&step.written, step.routes);
        self.kept.accept(step.written, &mut self.numbering);
        Outcome { done, generation: step.generation, rooms, doors, tree_rows, anew: false, stages }
    }

    /// Makes an edit undone that was not committed.
    fn take_back(&mut self) -> Result<()> {
        for (class, table) in &self.told {
            classes::assert(&mut self.knowledge, class, table)?;
        }
        self.knowledge.update(&self.inputs.rules);
        self.routes.take_back();
        Ok(())
    }
}

/// Whether something changed that a planner works from.
fn needs_changed(needs: &[String], changes: &Changes) -> bool {
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
