//! What edits would change, before any of them is made.

pub(crate) mod compare;
mod drafts;
mod routes;

use std::sync::Arc;
use std::time::Instant;

use adit_db::door::Door;
use adit_db::room::Room;
use serde::Serialize;

use crate::answer::{Answer, Moment};
use crate::edit::Edit;
use crate::edit::rehearse::{Cell, differences};
use crate::error::Result;
use crate::graph::SiteGraph;
use crate::graph::gauge::Gauge;
use crate::graph::pairs::Known;
use crate::live::Live;
use crate::live::report::{Concluded, notes, unfit_places};
use crate::site::calm::both;
use crate::state::{Courses, Nothing, State, Step, Weighed, keep};
use crate::words::progress::Silent;
pub use drafts::{Decides, RulesTried};
use routes::LISTED;
pub use routes::{PlaceRoute, PlaceRoutes};

/// A route that is asked for beside a preview.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted<'a> {
    /// From where: a place, a space, a room or `x,y`.
    pub start: &'a str,
    /// Where to.
    pub goal: &'a str,
    /// Whose; may be left out where there is one robot.
    pub robot: Option<&'a str>,
}

impl Wanted<'_> {
    fn of(self, moment: &Moment) -> Result<Answer> {
        moment.route(self.start, &[self.goal.to_owned()], self.robot)
    }
}

/// What would change.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Preview {
    /// The state of the knowledge base that it rests on.
    pub generation: u64,
    /// Cells that would count differently: with named tunings, and facts. None where a tuning that is on says otherwise.
    pub cells: Vec<Cell>,
    /// Whether rooms and doors would be cut anew; then all of them count as changed, and none is listed.
    pub layout_changed: bool,
    /// Rooms with another hardness, action or passability.
    pub rooms: Changed<RoomChange>,
    /// Doors with another hardness, action or passability.
    pub doors: Changed<DoorChange>,
    /// What rules would say otherwise of other things than rooms and doors, on a site without a map.
    pub conclusions: Vec<Concluded>,
    /// What would be worth a look and is not now, in sentences: of cells that name nothing, of places at which no robot fits, of
    /// what no rule speaks of.
    pub notes: Vec<String>,
    /// What would be closed and is not now, or no longer be, in sentences.
    pub closings: Vec<String>,
    /// Routes between places.
    pub routes: PlaceRoutes,
    /// What would become of the rules, where edits are of their files.
    pub rules: Option<RulesTried>,
    /// The route that was asked for, with the edits.
    pub route: Option<Answer>,
    /// The same without them.
    pub before: Option<Answer>,
}

/// How many changed, and the first of them.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Changed<T> {
    /// How many changed.
    pub changed: usize,
    /// How many there are.
    pub total: usize,
    /// What changed, at most 5,000.
    pub list: Vec<T>,
}

/// What rules say of a room or a door.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Weight {
    /// Its hardness; `null` is unknown.
    pub hardness: Option<f64>,
    /// Its action.
    pub action: Option<String>,
    /// Whether it is passed.
    pub passable: Option<bool>,
}

/// A room that would change.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct RoomChange {
    /// Its number.
    pub room: i64,
    /// Its name.
    pub name: String,
    /// As it is.
    pub old: Weight,
    /// As it would be.
    pub new: Weight,
}

/// A door that would change.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct DoorChange {
    /// Its number.
    pub door: i64,
    /// As it is.
    pub old: Weight,
    /// As it would be.
    pub new: Weight,
}

impl Live {
    /// What the edits would change, one after the other, in rooms, doors and routes; nothing is written. They are
    /// checked as [`Live::edit`] checks them, and one that would be refused is an error here, too.
    pub fn preview(&self, edits: &[Edit], route: Option<Wanted<'_>>) -> Result<Preview> {
        self.fork().preview(edits, route)
    }
}

impl State {
    /// As [`Live::preview`], of the state that was forked; the site is not held up meanwhile.
    pub fn preview(mut self, edits: &[Edit], route: Option<Wanted<'_>>) -> Result<Preview> {
        let files = self.files_of(edits)?;
        if !files.is_empty() {
            return self.preview_of_drafts(edits, files, route);
        }
        let rehearsed = self.rehearse(edits)?;
        let cells = differences(&rehearsed.before, &rehearsed.after);
        if !self.told.counts_as(&rehearsed.before) {
            // others edited the tables meanwhile, or the clock went on: what they did is no part of the preview
            let step = self.step(rehearsed.before, &mut Nothing, &Silent)?;
            self.accept(step);
        }
        self.generation = rehearsed.generation;
        let before = Before::of(&self);
        let concluded = (!self.site.site().has_rooms()).then(|| self.knowledge.fork());
        let moment = self.moment();
        let step = || self.step(rehearsed.after, &mut Nothing, &Silent);
        let (of_before, step) = both(|| route.map(|wanted| wanted.of(&moment)).transpose(), step);
        let (before, step) = (Before { route: of_before?, ..before }, step?);
        let of = |knowledge: &adit_engine::KnowledgeBase| {
            keep::touched(knowledge, &self.inputs.rules, &step.changes)
        };
        let conclusions = concluded.map(|before| Concluded::between(&of(&before), &of(&self.knowledge)));
        before.compared(
            self,
            step,
            route,
            Otherwise { cells, conclusions: conclusions.unwrap_or_default(), rules: None },
        )
    }
}

/// What a preview says that is not seen from the state after it.
struct Otherwise {
    cells: Vec<Cell>,
    conclusions: Vec<Concluded>,
    rules: Option<RulesTried>,
}

/// A state before edits.
struct Before {
    /// When it was begun to try them.
    began: Instant,
    graph: Arc<SiteGraph>,
    known: Arc<Known>,
    gauge: Arc<Gauge>,
    courses: Option<Arc<Courses>>,
    route: Option<Answer>,
    notes: Vec<String>,
}

impl Before {
    /// All but the route that is wanted.
    fn of(state: &State) -> Self {
        Self {
            began: Instant::now(),
            graph: Arc::clone(state.graph()),
            known: Arc::clone(&state.known),
            gauge: Arc::clone(&state.gauge),
            courses: state.courses.clone(),
            route: None,
            notes: notes(state),
        }
    }

    /// What a step changes that follows from edits.
    fn compared(
        self,
        mut state: State,
        step: Step,
        route: Option<Wanted<'_>>,
        said: Otherwise,
    ) -> Result<Preview> {
        let Self { began, graph: before, known, gauge, courses, route: before_route, notes: known_notes } =
            self;
        let (layout_changed, weighed) = (step.is_cut_anew, step.weighed.clone());
        state.accept(step);
        state.go_on()?;
        let (after, robots) = (Arc::clone(state.graph()), state.robots());
        let same = !layout_changed && weighed.is_empty() && before.places == after.places;
        let moment = state.moment();
        let compared = || {
            if let (Some(before), Some(after)) = (&courses, &state.courses) {
                routes::between(before, after)
            } else if same {
                PlaceRoutes::none(robots.len(), before.places.len())
            } else {
                let (before, after) = ((&*before, &*gauge), (&*after, &*state.gauge));
                // who has waited long for a floor to be cut is not sent away to ask for the same once more
                let patience = if state.patience.is_zero() {
                    state.patience
                } else {
                    state.patience.max(began.elapsed())
                };
                let began = Instant::now();
                let is_time = |share| began.elapsed() < patience / share && state.is_waited_for();
                routes::compare((before, &known), after, &robots, layout_changed, &is_time)
            }
        };
        let (route, routes) = both(|| route.map(|wanted| wanted.of(&moment)).transpose(), compared);
        let mut notes = notes(&state);
        if layout_changed || before.places != after.places {
            notes.extend(unfit_places(&state));
        }
        notes.retain(|note| !known_notes.contains(note));
        notes.extend(gone_places(&before, &after));
        let Otherwise { cells, conclusions, rules } = said;
        let preview = Preview {
            generation: state.generation,
            cells,
            conclusions,
            notes,
            closings: after.building.turned(&before.building),
            layout_changed,
            rooms: rooms_of(&before, &after, &weighed, layout_changed),
            doors: doors_of(&before, &after, &weighed, layout_changed),
            routes,
            rules,
            route: route?,
            before: before_route,
        };
        // nobody waits until all of it is given back
        rayon::spawn(|| drop((state, moment, before, after)));
        Ok(preview)
    }
}

/// A word about places that would be no more: routes from and to them are none that change.
fn gone_places(before: &SiteGraph, after: &SiteGraph) -> Option<String> {
    let stays = |name: &str| after.places.iter().any(|place| place.place == name);
    let gone: Vec<String> = before
        .places
        .iter()
        .filter(|place| !stays(&place.place))
        .map(|place| format!("`{}`", place.place))
        .collect();
    match gone.as_slice() {
        [] => None,
        [only] => Some(format!("the place {only} would be gone, and with it the routes from and to it")),
        [all @ .., last] => {
            let all = all.join(", ");
            Some(format!(
                "the places {all} and {last} would be gone, and with them the routes from and to them"
            ))
        }
    }
}

fn rooms_of(before: &SiteGraph, after: &SiteGraph, to: &Weighed, anew: bool) -> Changed<RoomChange> {
    let total = after.rooms.len();
    if anew {
        return Changed { changed: total, total, list: Vec::new() };
    }
    let of = |room: &Room| Weight {
        hardness: room.hardness.value,
        action: room.action.value.clone(),
        passable: room.passable.value,
    };
    let list = to.rooms.iter().map(|(row, _)| (&before[*row], &after[*row])).map(|(old, new)| RoomChange {
        room: old.room,
        name: old.name.clone(),
        old: of(old),
        new: of(new),
    });
    listed(total, list.filter(|change| change.old != change.new))
}

fn doors_of(before: &SiteGraph, after: &SiteGraph, to: &Weighed, anew: bool) -> Changed<DoorChange> {
    let total = after.doors.len();
    if anew {
        return Changed { changed: total, total, list: Vec::new() };
    }
    let of = |door: &Door| Weight {
        hardness: door.hardness.value,
        action: door.action.value.clone(),
        passable: door.passable.value,
    };
    let list = to.doors.iter().map(|(row, _)| (&before[*row], &after[*row]));
    let list = list.map(|(old, new)| DoorChange { door: old.door, old: of(old), new: of(new) });
    listed(total, list.filter(|change| change.old != change.new))
}

fn listed<T>(total: usize, all: impl Iterator<Item = T>) -> Changed<T> {
    let (mut changed, mut list) = (0, Vec::new());
    for one in all {
        changed += 1;
        if list.len() < LISTED {
            list.push(one);
        }
    }
    Changed { changed, total, list }
}
