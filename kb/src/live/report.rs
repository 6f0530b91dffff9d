//! What a build or an edit made and changed, counted in the expert's own terms.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::sync::Arc;

use adit_db::Cell;
use adit_db::conclusion::Derivation;
use adit_db::measure::Measures;
use adit_db::room::Room;
use adit_db::schema::Row;
use adit_db::tree::{Start, TreeRow};
use adit_db::weight::Weight;
use adit_engine::{
    Conclusions, Conflict, Diagnostic, Dominated, KnowledgeBase as Inference, Misspelt, Unmet,
};
use adit_planners::read::MapReport;
use adit_planners::routes::{DoorIndex, RoomIndex};
use serde::{Serialize, Serializer};

use crate::graph::gauge::Size;
use crate::graph::itinerary::Itinerary;
use crate::graph::pairs::PlaceCosts;
use crate::graph::{End, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::told::Attached;
use crate::site::{Rooms, lint};
use crate::state::before::Before;
use crate::state::{State, Weighed};
use crate::words::number::{counted, number};
use crate::words::progress::Stage;

/// How many there are of something, and how many changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// All of them.
    pub total: usize,
    /// Those with another hardness, action or passability than before; all of them where they were cut anew.
    pub changed: usize,
}

/// A value of before and of now.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// The room's name or the door's number.
    pub what: String,
    /// Hardness of before.
    pub old: Option<f64>,
    /// Hardness of now.
    pub new: Option<f64>,
    /// Action of before.
    pub old_action: Option<String>,
    /// Action of now.
    pub new_action: Option<String>,
    /// Whether it let through before.
    pub old_passable: Option<bool>,
    /// Whether it does now.
    pub new_passable: Option<bool>,
}

/// The routes that are kept.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Routes {
    /// Names that routes start from.
    pub starts: usize,
    /// Rows written.
    pub rows: u64,
    /// Whether those to places alone are counted, as where rooms weigh metres.
    pub between_places: bool,
    /// Routes from a kept start, to places and in the paper's modes to rooms, that changed; `None` where they were made anew.
    pub changed: Option<usize>,
    /// Those that lead another way.
    pub rerouted: Option<usize>,
    /// Those that cost less.
    pub shorter: usize,
    /// Those that cost more.
    pub longer: usize,
    /// Those that are no more.
    pub lost: usize,
    /// Those that were not before.
    pub found: usize,
    /// Those between places, the ones whose cost changed most first.
    pub changes: Vec<RouteChange>,
}

/// A route between two places, before and now.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RouteChange {
    /// Whose.
    pub robot: String,
    /// Where from.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// Cost of before; `None`: there was no route.
    pub old: Option<f64>,
    /// Cost of now; `None`: there is no route.
    pub new: Option<f64>,
    /// Whether it leads another way; unknown where the rooms were cut anew.
    pub other_way: Option<bool>,
}

impl Routes {
    /// Counts a route among those that cost less or more, or that there is no more or was not before.
    pub fn weigh(&mut self, old: Option<f64>, new: Option<f64>) {
        match (old, new) {
            // what nobody reads is no change
            (Some(old), Some(new)) if number(old) == number(new) => {}
            (Some(old), Some(new)) if new < old => self.shorter += 1,
            (Some(old), Some(new)) if new > old => self.longer += 1,
            (Some(_), None) => self.lost += 1,
            (None, Some(_)) => self.found += 1,
            _ => {}
        }
    }

    /// None yet; `comparable` where routes of before can be compared.
    pub fn new(starts: usize, comparable: bool) -> Self {
        let none = comparable.then_some(0);
        Self { starts, changed: none, rerouted: none, ..Self::default() }
    }

    /// Counts what differs between a tree of before and of now.
    pub fn count(
        &mut self,
        before: Before<'_>,
        (start, old): (&Start, &[TreeRow]),
        new: &[TreeRow],
        graph: &SiteGraph,
    ) {
        let now = |row: &TreeRow| {
            row.reach + row.door.and_then(|key| graph[graph.door(key)?].hardness.value).unwrap_or(0.0)
        };
        let then = |row: &TreeRow| {
            row.reach + row.door.and_then(|key| before.door(key)?.hardness.value).unwrap_or(0.0)
        };
        let (old_rows, new_rows) = (Chains::new(old), Chains::new(new));
        let (mut old_ways, mut new_ways) =
            (Itineraries::new(&old_rows, before.graph), Itineraries::new(&new_rows, graph));
        let (mut changed, mut rerouted) = (0, 0);
        let between_places = !graph.graph().is_on_doors();
        self.between_places = between_places;
        let rooms = old_rows.nodes().chain(new_rows.nodes().filter(|node| old_rows.row(*node).is_none()));
        // where rooms weigh metres the others are points at which ways bend, and nobody's goals
        let rooms = rooms.filter(|node| !between_places && graph.place_of(*node).is_none());
        // places are numbered otherwise once one comes or goes, and of one that is new no route has changed
        let places = graph.places.iter().filter(|place| !between_places || place.place != start.name);
        let places =
            places.filter_map(|place| Some((before.node_of(&place.place)?, graph.place_node(&place.place)?)));
        for (was, node) in rooms.map(|room| (room, room)).chain(places) {
            let (old_row, new_row) = (old_rows.row(was), new_rows.row(node));
            let costs = (old_row.map(then), new_row.map(now));
            self.weigh(costs.0, costs.1);
            let other_way = old_ways.of(was) != new_ways.of(node);
            let are_both = old_row.is_some() && new_row.is_some();
            let differ = costs.0.map(f64::to_bits) != costs.1.map(f64::to_bits);
            changed += usize::from(differ || other_way);
            rerouted += usize::from(other_way && are_both);
            let is_read = other_way || costs.0.map(number) != costs.1.map(number);
            if differ
                && is_read
                && let Some(place) = graph.place_of(node)
            {
                let (robot, from) = (start.robot.clone(), start.name.clone());
                let (goal, other_way) = (place.to_owned(), Some(other_way));
                self.changes.push(RouteChange {
                    robot,
                    start: from,
                    goal,
                    old: costs.0,
                    new: costs.1,
                    other_way,
                });
            }
        }
        self.changed = self.changed.map(|count| count + changed);
        self.rerouted = self.rerouted.map(|count| count + rerouted);
    }
}

impl Routes {
    /// Compares the routes between places where the rooms were cut anew, so that trees cannot be compared.
    pub fn compare(&mut self, before: Before<'_>, old: &PlaceCosts, new: &PlaceCosts) {
        let starts: BTreeSet<_> =
            before.starts.iter().map(|start| (start.robot.as_str(), start.name.as_str())).collect();
        // of a robot or a place that is new no route has changed
        let was_there = |(robot, start, goal): &(String, String, String)| {
            starts.contains(&(robot.as_str(), start.as_str())) && before.node_of(goal).is_some()
        };
        let found = new.keys().filter(|key| !old.contains_key(*key) && was_there(key));
        for key in old.keys().chain(found) {
            let (old, new) = (old.get(key).copied(), new.get(key).copied());
            // another cut moves crossing points by a hair
            let same = matches!((old, new), (Some(old), Some(new)) if (old - new).abs() <= 1e-3 * old.abs());
            if !same {
                let (robot, start, goal) = key.clone();
                self.changes.push(RouteChange { robot, start, goal, old, new, other_way: None });
            }
        }
    }

    /// Puts the greatest changes first.
    pub fn sort(&mut self) {
        let by = |change: &RouteChange| match (change.old, change.new) {
            (Some(old), Some(new)) => (new - old).abs(),
            _ => f64::INFINITY,
        };
        self.changes.sort_by(|a, b| by(b).total_cmp(&by(a)));
    }
}

/// The rows of a tree by their node.
struct Chains<'a> {
    rows: &'a [TreeRow],
    /// Only looked up in: no order of it can reach a report.
    by_node: HashMap<i64, usize>,
}

impl<'a> Chains<'a> {
    fn new(rows: &'a [TreeRow]) -> Self {
        Self { rows, by_node: rows.iter().enumerate().map(|(at, row)| (row.node, at)).collect() }
    }

    fn row(&self, node: i64) -> Option<&'a TreeRow> {
        self.by_node.get(&node).map(|at| &self.rows[*at])
    }

    fn nodes(&self) -> impl Iterator<Item = i64> {
        self.rows.iter().map(|row| row.node)
    }
}

/// The ways to the nodes of a tree, as people tell them apart.
struct Itineraries<'a> {
    rows: &'a Chains<'a>,
    graph: &'a SiteGraph,
    known: HashMap<i64, Itinerary>,
}

impl<'a> Itineraries<'a> {
    fn new(rows: &'a Chains<'a>, graph: &'a SiteGraph) -> Self {
        Self { rows, graph, known: HashMap::new() }
    }

    /// Of one node; `None` where the tree does not reach it. Each node is looked at once, however many ways lead through it.
    fn of(&mut self, node: i64) -> Option<u64> {
        let mut chain = vec![self.rows.row(node)?];
        let mut way = Itinerary::default();
        while let Some(prev) = chain[chain.len() - 1].prev {
            if let Some(known) = self.known.get(&prev) {
                way = *known;
                break;
            }
            let Some(row) = self.rows.row(prev) else { break };
            chain.push(row);
        }
        for row in chain.into_iter().rev() {
            let room = row.from_room.or(row.prev).and_then(|key| self.graph.room(key));
            if let Some(room) = room {
                let moves = row.walked.is_none_or(|metres| metres > 0.0);
                way = way.through(self.graph, room, moves, row.door.and_then(|key| self.graph.door(key)));
            }
            self.known.insert(row.node, way);
        }
        Some(way.told())
    }
}

/// What was made.
#[derive(Debug)]
pub struct Report {
    /// Number of the knowledge base's state.
    pub generation: u64,
    /// Rooms.
    pub rooms: Counts,
    /// Doors.
    pub doors: Counts,
    /// How many spaces the building has, as people see it.
    pub spaces: usize,
    /// How many doorways are between them.
    pub doorways: usize,
    /// How many robots of their own rooms there are.
    pub robots: usize,
    /// The rooms and doors that changed; none where all were cut anew.
    pub changes: Vec<Change>,
    /// Of each measure how many rooms and doors take otherwise much of it.
    pub measures: BTreeMap<String, Remeasured>,
    /// How many values rules conclude of other things than rooms and doors.
    pub concluded: usize,
    /// What rules say otherwise of them.
    pub conclusions: Vec<Concluded>,
    /// What there is of what on a map that is not cut into rooms: `6 channels, 8 junctions`.
    pub course: Option<String>,
    /// What rules that react told, in sentences.
    pub reacted: Vec<String>,
    /// What they could not tell, or where they came to no end; in the notes, too.
    pub failed: Vec<Diagnostic>,
    /// What is closed now and was not before, or no longer is, in sentences.
    pub closings: Vec<String>,
    /// Whether rooms were cut anew.
    pub cut_anew: bool,
    /// Routes.
    pub routes: Routes,
    /// What was done and how long it took.
    pub stages: Vec<Stage>,
    /// What the map's reading cost or gave of free space.
    pub map: MapReport,
    /// What the expert should know.
    pub notes: Vec<String>,
    /// Facts that no longer find what they are about.
    pub lost: Vec<String>,
    /// What routes need and no rule gave.
    pub gaps: Vec<String>,
    /// Rows of tables that no rule can ever choose.
    pub dominated: Vec<Dominated>,
    /// Texts that rules ask for and no object has, though one has nearly the same; in the notes, too.
    pub misspelt: Vec<Misspelt>,
    /// Cells that name a row of another table where there is none; the first of them in the notes, too.
    pub unmet: Vec<Unmet>,
}

/// So many cells that name nothing are noted one by one.
const NOTED: usize = 5;

/// How many rooms and doors take otherwise much of a measure than before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Remeasured {
    pub rooms: usize,
    pub doors: usize,
}

/// A value that rules conclude otherwise than before.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Concluded {
    /// The class in small letters, and the key.
    pub what: String,
    pub property: String,
    /// `null`: nothing was concluded.
    #[serde(serialize_with = "as_concluded")]
    #[schema(value_type = Value)]
    pub old: Cell,
    /// `null`: nothing is concluded any more.
    #[serde(serialize_with = "as_concluded")]
    #[schema(value_type = Value)]
    pub new: Cell,
}

/// Of what rules conclude truth values alone are kept as whole numbers.
fn as_concluded<S: Serializer>(value: &Cell, to: S) -> Result<S::Ok, S::Error> {
    match value {
        Cell::Integer(truth) => to.serialize_bool(*truth != 0),
        other => other.serialize(to),
    }
}

impl Concluded {
    /// What differs between the derivations that went and those that came, in the order of the latter.
    pub(crate) fn between(gone: &[Derivation], new: &[Derivation]) -> Vec<Self> {
        let name = |of: &Derivation| (format!("{} {}", of.class, of.key), of.property.clone());
        let mut before: BTreeMap<(String, String), &Cell> =
            gone.iter().map(|of| (name(of), &of.value)).collect();
        let mut found = Vec::new();
        for of in new {
            let (what, property) = name(of);
            let old = before.remove(&(what.clone(), property.clone())).cloned().unwrap_or(Cell::Null);
            if old != of.value {
                found.push(Self { what, property, old, new: of.value.clone() });
            }
        }
        let lost = |((what, property), old): ((String, String), &Cell)| Self {
            what,
            property,
            old: old.clone(),
            new: Cell::Null,
        };
        found.extend(before.into_iter().map(lost));
        found
    }

    /// Whether rules said it before and say it now, or nobody told anything in their place.
    pub(crate) fn is_of_rules_alone(&self, knowledge: &Inference, told: [&Attached; 2]) -> bool {
        if self.old != Cell::Null && self.new != Cell::Null {
            return true;
        }
        let Some((class, key)) = self.what.split_once(' ') else { return true };
        let class = class.to_uppercase();
        let Some(row) = knowledge.row(&class, key) else { return true };
        let cell = (class, row, self.property.clone());
        !told.iter().any(|told| told.cells().contains_key(&cell))
    }
}

impl Report {
    /// Of a step that was kept.
    ///
    /// # Arguments
    /// `weighed` is what rules say otherwise of rooms and doors than before; `None` where they are cut anew.
    pub(crate) fn new(
        before: Before<'_>,
        weighed: Option<&Weighed>,
        state: &mut State,
        (routes, stages): (Routes, Vec<Stage>),
    ) -> Self {
        let inputs = Arc::clone(&state.inputs);
        let mut notes = notes(state);
        let conclusions = state.knowledge.conclude(&inputs.rules);
        let dominated = state.knowledge.dominated(&inputs.rules);
        let misspelt = state.knowledge.misspelt(&inputs.rules);
        let unmet = state.knowledge.unmet(&inputs.rules);
        let graph = state.graph();
        let (mut rooms, mut doors) = (Counts::all(graph.rooms.len()), Counts::all(graph.doors.len()));
        let mut changes = Vec::new();
        let mut measures: BTreeMap<String, Remeasured> = BTreeMap::new();
        if let Some(weighed) = weighed {
            let room = |(room, weight): &(RoomIndex, Weight)| {
                let old = &before.graph.rooms[room.index()];
                Change::between(format!("room {}", old.name), old.weight(), weight)
            };
            let door = |(door, weight): &(DoorIndex, Weight)| {
                let old = &before.graph.doors[door.index()];
                Change::between(format!("door {}", old.door), old.weight(), weight)
            };
            changes.extend(weighed.rooms.iter().filter_map(room));
            rooms.changed = changes.len();
            changes.extend(weighed.doors.iter().filter_map(door));
            doors.changed = changes.len() - rooms.changed;
            let old = |room: &RoomIndex| before.graph.rooms[room.index()].weight();
            let rooms = weighed.rooms.iter().flat_map(|(room, weight)| remeasured(&old(room), weight));
            rooms.for_each(|measure| measures.entry(measure).or_default().rooms += 1);
            let old = |door: &DoorIndex| before.graph.doors[door.index()].weight();
            let doors = weighed.doors.iter().flat_map(|(door, weight)| remeasured(&old(door), weight));
            doors.for_each(|measure| measures.entry(measure).or_default().doors += 1);
        }
        let lost = state.told.lost(&state.attached);
        if graph.rooms.is_empty() && state.site.site().has_rooms() {
            notes.push("there is no room: no state of a robot fits anywhere on this map".to_owned());
        } else if weighed.is_none() || graph.places != before.graph.places {
            notes.extend(unfit_states(state));
            notes.extend(unfit_places(state));
        }
        Self {
            generation: state.generation,
            spaces: graph.building.spaces.len(),
            doorways: graph.building.doorways.len(),
            robots: graph.robots().len(),
            rooms,
            doors,
            changes,
            measures,
            concluded: 0,
            course: state.courses.as_ref().map(|courses| courses.summary()),
            conclusions: Vec::new(),
            reacted: Vec::new(),
            failed: Vec::new(),
            closings: graph.building.turned(&before.graph.building),
            cut_anew: weighed.is_none(),
            routes,
            stages,
            map: inputs.map_report.clone(),
            notes,
            lost,
            gaps: gaps(&conclusions, graph, &state.site),
            dominated,
            misspelt,
            unmet,
        }
    }

    /// The report as JSON.
    pub fn json(&self) -> serde_json::Value {
        let stage = |stage: &Stage| serde_json::json!({"stage": stage.name, "seconds": stage.took.as_secs_f64(), "kept": stage.kept});
        serde_json::json!({
            "generation": self.generation,
            "spaces": self.spaces,
            "doorways": self.doorways,
            "rooms": self.rooms,
            "doors": self.doors,
            "cut_anew": self.cut_anew,
            "changes": self.changes,
            "measures": self.measures,
            "concluded": self.concluded,
            "map": self.course,
            "conclusions": self.conclusions,
            "reacted": self.reacted,
            "closings": self.closings,
            "routes": self.routes,
            "stages": self.stages.iter().map(stage).collect::<Vec<_>>(),
            "free_space_m2": {
                "in_file": self.map.free_in_file,
                "unknown_in_file": self.map.unknown_in_file,
                "unknown": self.map.unknown,
                "specks": self.map.specks,
                "straightened": self.map.straightened,
                "clearance": self.map.clearance,
                "free": self.map.free,
            },
            "notes": self.notes,
            "lost": self.lost,
            "gaps": self.gaps,
        })
    }
}

impl Counts {
    /// All of them count as changed.
    fn all(total: usize) -> Self {
        Self { total, changed: total }
    }
}

impl Change {
    /// What is said otherwise than before; `None` where only somebody else says it.
    fn between(what: String, old: Weight, new: &Weight) -> Option<Self> {
        (!old.is_same(new)).then(|| Self {
            what,
            old: old.hardness.value,
            new: new.hardness.value,
            old_action: old.action.value,
            new_action: new.action.value.clone(),
            old_passable: old.passable.value,
            new_passable: new.passable.value,
        })
    }
}

/// The measures of which otherwise much is taken.
fn remeasured(old: &Weight, new: &Weight) -> Vec<String> {
    if old.measures == new.measures {
        return Vec::new();
    }
    let [old, new] = [old, new].map(|weight| Measures::of(weight.measures.as_deref()).0);
    let names = old.keys().chain(new.keys().filter(|name| !old.contains_key(*name)));
    names.filter(|name| old.get(*name) != new.get(*name)).cloned().collect()
}

/// What the expert should know of files, tables and rules as a state has them, in sentences.
pub fn notes(state: &State) -> Vec<String> {
    let (inputs, knowledge) = (&state.inputs, &state.knowledge);
    let idle = state.told.idle_hours(knowledge);
    let mut notes: Vec<String> =
        inputs.notes.iter().cloned().chain(state.told.notes.iter().cloned()).chain(idle).collect();
    notes.extend(lint::unread_marks(&inputs.rules, &state.told.classes));
    notes.extend(knowledge.misspelt(&inputs.rules).iter().map(ToString::to_string));
    let unmet = knowledge.unmet(&inputs.rules);
    notes.extend(unmet.iter().take(NOTED).map(ToString::to_string));
    let more = unmet.len().saturating_sub(NOTED);
    notes.extend(match more {
        0 => None,
        1 => Some("and one more cell names a row that is not there".to_owned()),
        more => Some(format!("and {more} more cells name rows that are not there")),
    });
    notes
}

/// So many places are named.
const NAMED: usize = 5;

/// The states that move, and fit nowhere on the map, in sentences.
fn unfit_states(state: &State) -> Vec<String> {
    if state.site.site().rooms != Rooms::ByState {
        return Vec::new();
    }
    let graph = state.graph();
    let cut: HashSet<&(String, String)> = graph.rooms.iter().filter_map(|room| room.layer.as_ref()).collect();
    let robots = graph.robots().len();
    let unfit = state.gauge.sizes().iter().filter(|(of, size)| size.width > 0.0 && !cut.contains(of));
    let sentence = |((robot, name), size): (&(String, String), &Size)| {
        let whose = if robots > 1 { format!(" of robot {robot}") } else { String::new() };
        let length = size.length.map_or_else(String::new, |length| format!(", {} m long", number(length)));
        format!("state `{name}`{whose} fits nowhere on this map: it is {} m wide{length}", number(size.width))
    };
    unfit.map(sentence).collect()
}

/// The places at which no state of a robot fits, in sentences.
pub(crate) fn unfit_places(state: &State) -> Vec<String> {
    let graph = state.graph();
    if graph.rooms.is_empty() {
        return Vec::new();
    }
    let robots = graph.robots();
    let fits = |robot: &str, place: usize| {
        let end = End::Place(place);
        let is_in_room = !graph.entries(None, &end, Some(robot)).is_empty();
        is_in_room || !graph.states_at(&state.gauge, graph.point(&end), Some(robot)).is_empty()
    };
    let sentence = |robot: &String| {
        let unfit = (0..graph.places.len()).filter(|&place| !fits(robot, place));
        let names: Vec<String> = unfit.map(|place| format!("`{}`", graph.places[place].place)).collect();
        let whose = if robots.len() > 1 { format!("robot {robot}") } else { "the robot".to_owned() };
        (!names.is_empty()).then(|| {
            let more = if names.len() > NAMED {
                format!(" and {}", counted(names.len() - NAMED, "more place"))
            } else {
                String::new()
            };
            let named = names[..names.len().min(NAMED)].join(", ");
            format!("no state of {whose} fits at {named}{more}: none of its routes leads there")
        })
    };
    robots.iter().filter_map(sentence).collect()
}

/// What routes need and no rule gave, in sentences.
fn gaps(conclusions: &Conclusions, graph: &SiteGraph, site: &KnowledgeBase) -> Vec<String> {
    let mut notes = Vec::new();
    // what a planner asks about comes when it asks
    let asked: Vec<&str> = site.asks().iter().map(|class| class.name).collect();
    let is_asked = |need: &String| asked.contains(&need.split('.').next().unwrap_or_default());
    for waiting in conclusions.waiting.iter().filter(|waiting| !waiting.needs.iter().any(is_asked)) {
        notes.push(format!(
            "rule \"{}\" waits for {}, which nothing gives",
            waiting.rule,
            waiting.needs.join(", ")
        ));
    }
    notes.extend(conflicts(conclusions));
    // those that rules disagree about are said already
    let disputed = |property: &str, key: &str| {
        let is_it = |conflict: &Conflict| conflict.property.to_string() == property && conflict.key == key;
        conclusions.conflicts.iter().any(is_it)
    };
    let is_gap = |room: &&Room| !disputed("ROOMS.hardness", &room.room.to_string());
    let unweighed = graph.rooms.iter().filter(|room| room.hardness.value.is_none() && room.layer.is_some());
    let unweighed = unweighed.filter(is_gap).count();
    if unweighed > 0 {
        notes.push(lacking((unweighed, "room"), "ROOMS.hardness", "enters"));
    }
    let undecided = graph.rooms.iter().filter(|room| room.passable.value.is_none()).count();
    if undecided > 0 {
        notes.push(lacking((undecided, "room"), "ROOMS.passable", "enters"));
    }
    let missing = |what: &str, count: usize| {
        (count > 0).then(|| lacking((count, "door"), &format!("DOORS.{what}"), "passes"))
    };
    let unweighed =
        graph.doors.iter().filter(|door| door.hardness.value.is_none() && door.passable.value != Some(false));
    let undecided = graph.doors.iter().filter(|door| door.passable.value.is_none());
    notes.extend(missing("hardness", unweighed.count()));
    notes.extend(missing("passable", undecided.count()));
    notes
}

/// That objects lack what routes need: `1 room has no ROOMS.hardness, so no route enters it`.
fn lacking((count, noun): (usize, &str), property: &str, enters: &str) -> String {
    let (has, it) = if count == 1 { ("has", "it") } else { ("have", "them") };
    format!("{} {has} no {property}, so no route {enters} {it}", counted(count, noun))
}

/// What two rules or more disagree about, with what they say of it, and the objects.
#[derive(Default)]
struct Disagreement<'c> {
    keys: Vec<&'c str>,
    /// Of each rule all that it says.
    said: BTreeMap<&'c str, Vec<String>>,
}

/// What a room needs to be entered.
const NEEDED: [&str; 2] = ["ROOMS.hardness", "ROOMS.passable"];

/// What to do where rules disagree; where one rule does with itself, since it takes the value from several objects.
pub(crate) const HIGHER: &str = "the one that shall count needs a higher `priority`";
pub(crate) const ONE_OBJECT: &str =
    "let it take them from one object alone: by `least` or `most` in place of `each`, or by a `where`";

/// Objects on which the same rules disagree, in one sentence.
fn conflicts(conclusions: &Conclusions) -> Vec<String> {
    let mut groups: BTreeMap<(String, Vec<&str>), Disagreement<'_>> = BTreeMap::new();
    for conflict in &conclusions.conflicts {
        let rules = conflict.values.iter().map(|(rule, _)| rule.as_str()).collect();
        let group = groups.entry((conflict.property.to_string(), rules)).or_default();
        group.keys.push(&conflict.key);
        for (rule, value) in &conflict.values {
            let (said, value) = (group.said.entry(rule.as_str()).or_default(), value.to_string());
            if !said.contains(&value) {
                said.push(value);
            }
        }
    }
    let sentence = |((property, _), Disagreement { keys, said }): ((String, _), Disagreement<'_>)| {
        let more = if keys.len() > 5 { ", ..." } else { "" };
        let named = keys.iter().take(5).copied().collect::<Vec<_>>().join(", ");
        let is_one_rule = said.len() == 1;
        let said: Vec<String> =
            said.iter().map(|(rule, values)| format!("\"{rule}\" says {}", any_of(values))).collect();
        let advice = if is_one_rule { ONE_OBJECT } else { HIGHER };
        let closed = if NEEDED.contains(&&*property) { ", and until then no route enters them" } else { "" };
        format!(
            "{property} of {} ({named}{more}) is unknown, since {}: {}; {advice}{closed}",
            keys.len(),
            if is_one_rule { "a rule says several things of one object" } else { "rules disagree" },
            said.join(", ")
        )
    };
    groups.into_iter().map(sentence).collect()
}

/// `1, 2 or 4`, of many the first few.
fn any_of(values: &[String]) -> String {
    match values {
        [one] => one.clone(),
        [first @ .., last] if values.len() <= 4 => format!("{} or {last}", first.join(", ")),
        many => format!("{}, ...", many[..4.min(many.len())].join(", ")),
    }
}
