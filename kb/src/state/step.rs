//! The step: what is told now, what planners give for it, what rules conclude, and what rooms and doors weigh then.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::resume_unwind;
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use adit_db::door::Door;
use adit_db::place::Place;
use adit_db::room::Room;
use adit_engine::{Changes, Diagnostic, KnowledgeBase as Inference, Severity};
use adit_planners::facts::{Column, Facts};
use adit_planners::planner::Planner;
use adit_planners::world::World;

use super::planned::{self, Planned};
pub use super::planned::{Nothing, Recall};
use super::twin::Twin;
use super::weighed::{Look, Weighed, Which, is_same_cut};
use super::{Courses, Pending, State};
use crate::error::{Code, Error, Result};
use crate::graph::SiteGraph;
use crate::graph::gauge::{Gauge, sizes};
use crate::knowledge::classes;
use crate::knowledge::told::{Attached, Told};
use crate::site::calm::both;
use crate::site::lint;
use crate::state::grounds::Reasons;
use crate::state::rows;
use crate::state::weights;
use crate::words::progress::{Progress, Stage, Stopwatch};

/// What a step changes. The state shows it once it is [accepted](State::accept).
pub struct Step {
    /// The map with what lies over it now.
    pub world: Arc<World>,
    /// What is told now.
    pub told: Told,
    /// Which objects facts are about.
    pub attached: Attached,
    /// What planners gave, and from what.
    pub planned: Planned,
    /// Whether planners gave facts anew, or places are others.
    pub is_anew: bool,
    /// All rooms and doors, where planners made them anew.
    pub cut: Option<Arc<SiteGraph>>,
    /// Whether rooms or doors are cut otherwise than before: then their numbers mean others.
    pub is_cut_anew: bool,
    /// Where they are not: those of which rules say something else.
    pub weighed: Weighed,
    /// What the inference changed.
    pub changes: Changes,
    /// The facts that rules chose for rooms and doors, by number, as far as they were looked at.
    pub facts: BTreeMap<i64, String>,
    /// What was done, in order.
    pub stages: Vec<Stage>,
    /// Routes over a map that is not cut into rooms.
    pub courses: Option<Arc<Courses>>,
    /// What rules that react told, in sentences.
    pub reacted: Vec<String>,
    /// What they could not tell, or where they came to no end.
    pub failed: Vec<Diagnostic>,
    gauge: Option<Arc<Gauge>>,
}

impl State {
    /// What follows where all this is told. It counts once it is [accepted](Self::accept); if it fails, or is
    /// [taken back](Self::take_back), the state is as before.
    ///
    /// It costs what depends on the change; planners are asked again where what they work from is another.
    pub(crate) fn step(
        &mut self,
        told: Told,
        recall: &mut dyn Recall,
        progress: &dyn Progress,
    ) -> Result<Step> {
        let step = self.follow(told, recall, progress);
        // a fork that nobody waits for is not asked again
        if step.is_err() && self.is_waited_for() {
            self.take_back()?;
        }
        step
    }

    fn follow(&mut self, mut told: Told, recall: &mut dyn Recall, progress: &dyn Progress) -> Result<Step> {
        self.tunable = Arc::default();
        let inputs = Arc::clone(&self.inputs);
        if !has_same_columns(&self.told, &told) {
            self.site.vet(&inputs.rules, &inputs.tests, &told)?;
        }
        let mut clock = Stopwatch::new();
        let mut attached = self.tell(&told)?;
        let mut changes = self.conclude()?;
        clock.lap("rules");
        let (world, notes) = if told.laid == self.told.laid {
            (Arc::clone(&self.world), Vec::new())
        } else {
            let (world, mut notes) = told.laid.over(&inputs.world);
            let known = lint::unknown_kinds(&inputs.rules, &inputs.world);
            let unknown = lint::unknown_kinds(&inputs.rules, &world).into_iter();
            notes.extend(unknown.filter(|note| !known.contains(note)));
            (Arc::new(world), notes)
        };
        told.notes.extend(notes);
        let places = self.places_of(&world);
        let over = (&world, places.as_deref());
        let given = self.ask_planners((over, &told), &mut changes, (recall, progress, &mut clock))?;
        self.go_on()?;
        if given.is_any {
            attached = Attached::default();
            told.attach(&self.knowledge, |_| true, &mut attached);
        }
        let mut reasons = Reasons::new(&self.knowledge, &inputs.rules);
        let (knowledge, rules) = (&self.knowledge, &inputs.rules);
        let before = self.twin.shown();
        let (mut cut, mut is_cut_anew, mut weighed) = (None, false, Weighed::default());
        let is_anew = given.is_any || places.is_some();
        let which = if is_anew { Which::All } else { Which::Touched(&changes) };
        let mut look = Look { knowledge, rules, which, reasons: Some(&mut reasons) };
        let building =
            look.building(|closable| told.lines(&attached, closable), &world, &before.building).map(Arc::new);
        let laying =
            given.laying.or_else(|| places.map(|places| Laying::begin(Rows::default(), before, places)));
        if let Some(laying) = laying {
            let mut graph = laying.end()?;
            weights::check((knowledge, rules), (&graph.rooms, &graph.doors), None)?;
            let building = building.as_ref().unwrap_or(&before.building);
            graph.write(look.rooms(), look.doors(), building);
            let (old, new) = ((&*before.rooms, &*before.doors), (&*graph.rooms, &*graph.doors));
            is_cut_anew = !is_same_cut(old, new);
            if !is_cut_anew {
                weighed = Weighed::between(old, new);
            }
            cut = Some(Arc::new(graph));
        } else {
            let changes = (!given.is_any).then_some(&changes);
            weights::check((knowledge, rules), (&before.rooms, &before.doors), changes)?;
            weighed = look.weighed(&before.rooms, &before.doors);
        }
        weighed.building = building;
        let facts = reasons.into_facts();
        if cut.is_none() && !weighed.is_empty() {
            self.twin.write(&weighed);
        }
        let needed = ["width", "height", "length"].map(|property| format!("ROBOTS.{property}"));
        let is_resized = needs_changed(&needed, &changes);
        let gauge = if Arc::ptr_eq(&world, &self.world) {
            is_resized.then(|| Arc::new(self.gauge.resized(sizes(&self.knowledge))))
        } else {
            Some(Arc::new(Gauge::new(&world, sizes(&self.knowledge))))
        };
        clock.lap("graph");
        let courses = self.courses_now()?.map(Arc::new);
        if courses.is_some() {
            clock.lap("routes");
        }
        let (planned, stages) = (given.planned, clock.stages);
        Ok(Step {
            world,
            told,
            attached,
            planned,
            is_anew,
            cut,
            is_cut_anew,
            weighed,
            changes,
            facts,
            stages,
            courses,
            reacted: Vec::new(),
            failed: Vec::new(),
            gauge,
        })
    }

    /// The places of a map, where they are others than now.
    fn places_of(&self, world: &Arc<World>) -> Option<Vec<Place>> {
        if Arc::ptr_eq(world, &self.world) {
            return None;
        }
        Some(rows::places(world)).filter(|places| *places != self.graph().places)
    }

    /// Makes what a step changed what is known.
    pub(crate) fn accept(&mut self, step: Step) {
        // they are numbered by robot and by place, and places come with the graph
        let is_other = step.told.robots() != self.told.robots();
        if is_other || step.cut.is_some() || step.gauge.is_some() || !step.weighed.is_empty() {
            self.known = Arc::default();
        }
        (self.world, self.told, self.attached, self.planned) =
            (step.world, step.told, step.attached, step.planned);
        if let Some(graph) = step.cut {
            self.twin = Twin::of(graph);
        } else if !step.weighed.is_empty() {
            self.twin.turn();
        }
        if let Some(gauge) = step.gauge {
            self.gauge = gauge;
        }
        self.courses = step.courses;
        self.pending = None;
    }

    /// Forgets a step that is not accepted.
    pub(crate) fn take_back(&mut self) -> Result<()> {
        let Some(Pending { attached, inference }) = self.pending.take() else { return Ok(()) };
        if self.told.classes.is_empty() {
            self.knowledge = Inference::new();
            return Ok(());
        }
        if let Some(inference) = inference {
            self.knowledge = inference;
        }
        let told = self.told.clone();
        self.tell_of_planned(&attached, &self.attached.clone(), &told)?;
        for (class, table) in &told.classes {
            classes::assert(&mut self.knowledge, class, table, told.numbered.contains(class))?;
            told.tell(&mut self.knowledge, class, &mut Attached::default())?;
        }
        self.knowledge.update(&self.inputs.rules);
        Ok(())
    }

    /// The graph as it is once a step is accepted.
    pub(crate) fn graph_after<'s>(&'s self, step: &'s Step) -> &'s Arc<SiteGraph> {
        match &step.cut {
            Some(graph) => graph,
            None if step.weighed.is_empty() => self.twin.shown(),
            None => self.twin.written(),
        }
    }

    /// What is solid, for robots of the sizes that they have once a step is accepted.
    pub(crate) fn gauge_after<'s>(&'s self, step: &'s Step) -> &'s Gauge {
        step.gauge.as_ref().unwrap_or(&self.gauge)
    }

    /// Tells the classes and facts that differ; which objects facts are now about.
    fn tell(&mut self, told: &Told) -> Result<Attached> {
        let mut attached = Attached::default();
        told.attach(&self.knowledge, |class| !told.classes.contains_key(class), &mut attached);
        self.pending = Some(Pending { attached: attached.clone(), inference: None });
        self.tell_of_planned(&self.attached.clone(), &attached, told)?;
        for gone in self.told.classes.keys().filter(|class| !told.classes.contains_key(*class)) {
            self.knowledge.retract(gone);
        }
        for (class, table) in &told.classes {
            let is_same = self.told.classes.get(class) == Some(table);
            if !is_same || !self.told.facts_of(class).eq(told.facts_of(class)) {
                classes::assert(&mut self.knowledge, class, table, told.numbered.contains(class))?;
            }
            told.tell(&mut self.knowledge, class, &mut attached)?;
        }
        Ok(attached)
    }

    /// Tells of each object of a planner's class what counts now instead of before.
    fn tell_of_planned(&mut self, before: &Attached, now: &Attached, told: &Told) -> Result<()> {
        self.retract_properties(before, now, told)?;
        let is_planned = |class: &str| !told.classes.contains_key(class);
        for ((class, row, property), fact) in now.cells().iter().filter(|(cell, _)| is_planned(&cell.0)) {
            fact.tell_row(&mut self.knowledge, class, *row, property)?;
        }
        let is_over =
            |cell: &&(String, usize, String)| is_planned(&cell.0) && !now.cells().contains_key(*cell);
        for (class, row, property) in before.cells().keys().filter(is_over) {
            let value = self.planned.value(self.twin.shown(), (class, *row, property));
            let told = self.knowledge.tell_row(class, *row, property, value);
            told.map_err(Error::of(Code::TellRefused))?;
        }
        Ok(())
    }

    /// Takes away the properties of planners' classes that only facts gave, and none does any more: whoever needs one
    /// waits again. One that rules give stays there unknown, which is the same to all, and spares making it anew.
    fn retract_properties(&mut self, before: &Attached, now: &Attached, told: &Told) -> Result<()> {
        for (class, property, _) in before.properties().difference(&now.properties()) {
            let is_given = self.planned.gives(class, property) || self.inputs.rules.gives(class, property);
            if !is_given && !told.classes.contains_key(*class) {
                let gone = self.knowledge.retract_property(class, property);
                gone.map_err(Error::of(Code::TellRefused))?;
            }
        }
        Ok(())
    }

    /// Concludes what follows, as far as it depends on what changed.
    fn conclude(&mut self) -> Result<Changes> {
        let changes = self.knowledge.update(&self.inputs.rules);
        let failed = self.knowledge.problems(&self.inputs.rules);
        // a rule that is planned for each of its outputs says of each what is wrong with all
        let mut said = BTreeSet::new();
        let mut is_new =
            |found: &Diagnostic| said.insert((found.file.clone(), found.span, found.message.clone()));
        let failed: Vec<Diagnostic> =
            failed.into_iter().filter(|found| found.severity == Severity::Error && is_new(found)).collect();
        if failed.is_empty() { Ok(changes) } else { Err(Error::all(failed)) }
    }

    /// Has planners give facts anew, as far as what they work from is another, in the order in which it is there.
    fn ask_planners(
        &mut self,
        ((world, places), told): ((&Arc<World>, Option<&[Place]>), &Told),
        changes: &mut Changes,
        (recall, progress, clock): (&mut dyn Recall, &dyn Progress, &mut Stopwatch),
    ) -> Result<Given> {
        let site = Arc::clone(&self.site);
        let is_laid_anew = !Arc::ptr_eq(world, &self.world);
        let planners = site.planners();
        let mut given = Given { planned: self.planned.clone(), laying: None, is_any: false };
        let is_new = |planner: &dyn Planner| !self.planned.fingerprints.contains_key(planner.name());
        let mut waiting: Vec<usize> = (0..planners.len())
            .filter(|&at| {
                let planner = planners[at].as_ref();
                is_laid_anew || is_new(planner) || needs_changed(&planner.signature().needs, changes)
            })
            .collect();
        let mut runs = 0;
        while let Some(ready) = waiting.iter().position(|&at| self.missing(planners[at].as_ref()).is_empty())
        {
            self.go_on()?;
            let at = waiting.remove(ready);
            let planner = planners[at].as_ref();
            let name = planner.name();
            progress.stage(name);
            let known = classes::known(&self.knowledge, &planner.signature().needs);
            let fingerprint = planned::fingerprint(world, &known);
            if given.planned.fingerprints.insert(name.to_owned(), fingerprint) == Some(fingerprint) {
                clock.kept(name);
                continue;
            }
            runs += 1;
            if runs > planners.len() * planners.len() {
                return Err(circle(planner));
            }
            let recalled = recall.recall(planner, fingerprint)?;
            let is_kept = recalled.is_some();
            self.save_inference();
            let facts = if let Some(facts) = recalled {
                self.tell_graph(told)?;
                facts
            } else {
                planned::facts(planner, world, &known)?
            };
            let (rows, asserted) = both(
                || Rows::of(&facts),
                || -> Result<()> {
                    for (class, table) in &facts {
                        classes::assert(&mut self.knowledge, class, table, false)?;
                        told.tell(&mut self.knowledge, class, &mut Attached::default())?;
                    }
                    Ok(())
                },
            );
            asserted?;
            given.take(facts, rows?, self.twin.shown(), places);
            self.go_on()?;
            given.is_any = true;
            clock.lap_of(name, is_kept);
            progress.stage("rules");
            let more = self.conclude()?;
            let is_due = |other: &usize| needs_changed(&planners[*other].signature().needs, &more);
            let due: Vec<usize> = (0..planners.len())
                .filter(|other| *other != at && !waiting.contains(other) && is_due(other))
                .collect();
            waiting.extend(due);
            waiting.sort_unstable();
            changes.absorb(more);
            clock.lap("rules");
        }
        match waiting.first() {
            Some(&at) => Err(stuck(planners[at].as_ref(), &self.missing(planners[at].as_ref()))),
            None => Ok(given),
        }
    }

    /// Tells of the rooms and doors that there are.
    fn tell_graph(&mut self, told: &Told) -> Result<()> {
        let graph = self.twin.shown();
        let classes =
            [("ROOMS", rows::class("ROOMS", &graph.rooms)), ("DOORS", rows::class("DOORS", &graph.doors))];
        for (name, class) in classes {
            classes::hold(&mut self.knowledge, name, class, |_| true)?;
            told.tell(&mut self.knowledge, name, &mut Attached::default())?;
        }
        Ok(())
    }

    fn save_inference(&mut self) {
        let is_empty = self.told.classes.is_empty();
        if let Some(pending) = &mut self.pending
            && pending.inference.is_none()
            && !is_empty
        {
            pending.inference = Some(self.knowledge.fork());
        }
    }

    /// What a planner needs and nobody has given yet.
    fn missing(&self, planner: &dyn Planner) -> Vec<String> {
        let is_known = |need: &String| {
            let (class, property) = classes::split(need);
            need.ends_with('?') || classes::column(&self.knowledge, class, property).is_some()
        };
        planner.signature().needs.into_iter().filter(|need| !is_known(need)).collect()
    }
}

/// What planners gave in a step.
struct Given {
    planned: Planned,
    /// Rooms and doors, where any gave them.
    laying: Option<Laying>,
    /// Whether any planner gave anything.
    is_any: bool,
}

impl Given {
    /// # Arguments
    /// `before` has the rooms, doors and places that are kept where nobody gives others.
    fn take(&mut self, facts: Facts, rows: Rows, before: &SiteGraph, places: Option<&[Place]>) {
        let of_others = facts.into_iter().filter(|(class, _)| !matches!(class.as_str(), "ROOMS" | "DOORS"));
        self.planned.facts.extend(of_others);
        if rows.rooms.is_none() && rows.doors.is_none() {
            return;
        }
        let places = places.unwrap_or(&before.places).to_vec();
        self.laying = Some(match self.laying.take() {
            Some(laying) => Laying::begin(rows, &laying.made(), places),
            None => Laying::begin(rows, before, places),
        });
    }
}

/// The rooms and doors that a planner gave.
#[derive(Default)]
struct Rows {
    rooms: Option<Vec<Room>>,
    doors: Option<Vec<Door>>,
}

impl Rows {
    fn of(facts: &Facts) -> Result<Self> {
        let (rooms, doors) = (facts.get("ROOMS"), facts.get("DOORS"));
        Ok(Self {
            rooms: rooms.map(rows::rooms).transpose()?,
            doors: doors.map(|table| rows::of_table("DOORS", table)).transpose()?,
        })
    }
}

/// A graph that is made while rules conclude what its rooms and doors weigh.
struct Laying {
    graph: JoinHandle<SiteGraph>,
    doors: usize,
}

impl Laying {
    /// # Arguments
    /// `before` has the rooms and doors that are kept where no others are given.
    fn begin(rows: Rows, before: &SiteGraph, places: Vec<Place>) -> Self {
        let rooms = rows.rooms.unwrap_or_else(|| before.rooms.clone());
        let doors = rows.doors.unwrap_or_else(|| before.doors.clone());
        let building = Arc::clone(&before.building);
        let count = doors.len();
        let graph = || {
            let is_measured = rooms.iter().any(|room| room.layer.is_some());
            let graph = SiteGraph::new(rooms, doors, places, building);
            if is_measured {
                graph.graph().prepare_mesh();
            }
            graph
        };
        Self { doors: count, graph: thread::spawn(graph) }
    }

    fn made(self) -> SiteGraph {
        self.graph.join().unwrap_or_else(|panic| resume_unwind(panic))
    }

    /// The graph, each of whose doors joins two rooms.
    fn end(self) -> Result<SiteGraph> {
        let doors = self.doors;
        let graph = self.made();
        let lost = doors - graph.doors.len();
        if lost > 0 {
            let lost = if lost == 1 {
                "an object leads to a room that is not there".to_owned()
            } else {
                format!("{lost} objects lead to rooms that are not there")
            };
            return Err(Error::said(Code::FactsProperty, format!("class DOORS: {lost}"), None));
        }
        Ok(graph)
    }
}

/// Whether both tell classes of the same columns, so that rules that were right for the one are for the other.
fn has_same_columns(one: &Told, other: &Told) -> bool {
    let kinds = |facts: &Facts| -> Vec<_> {
        let kind = |(name, column): &(String, Column)| (name.clone(), std::mem::discriminant(column));
        facts
            .iter()
            .map(|(class, table)| (class.clone(), table.columns.iter().map(kind).collect::<Vec<_>>()))
            .collect()
    };
    kinds(&one.classes) == kinds(&other.classes)
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

/// The complaint that a planner lacks what nobody gives.
fn stuck(planner: &dyn Planner, missing: &[String]) -> Error {
    Error::said(
        Code::RulesMissing,
        format!("{} cannot be made: no rule, table or planner gives {}", planner.name(), missing.join(", ")),
        Some("the shipped rule bases have such rules: copy the missing one from there".to_owned()),
    )
}

/// The complaint that what a planner gives changes what it works from, again and again.
fn circle(planner: &dyn Planner) -> Error {
    let message =
        format!("{} never comes to an end: what it gives changes what it is made from", planner.name());
    let help =
        "from what this planner gives, a rule concludes something that the planner works from".to_owned();
    Error::said(Code::RulesCircle, message, Some(help))
}
