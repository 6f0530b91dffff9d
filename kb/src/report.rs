//! What a build or an edit made and changed, counted in the expert's own terms.

use std::collections::BTreeMap;

use adit_db::Tx;
use adit_db::conclusion::Witness;
use adit_db::door::Door;
use adit_db::room::Room;
use adit_db::tree::{Start, TreeRow};
use adit_engine::{Conclusions, Dominated};
use adit_planners::read::MapReport;
use serde::Serialize;

use crate::derive::{Derived, Stage};
use crate::error::Result;
use crate::graph::SiteGraph;
use crate::inputs::Inputs;

/// The site as it was.
#[derive(Default)]
pub struct Before {
    /// The rooms, by number.
    pub rooms: Vec<Room>,
    /// The doors, by number.
    pub doors: Vec<Door>,
    /// The starts that routes were kept from.
    pub starts: Vec<Start>,
    /// What rules chose.
    pub witnesses: Vec<Witness>,
}

impl Before {
    /// Reads it.
    pub fn read(tx: &mut Tx<'_>) -> Result<Self> {
        let (rooms, doors) = (tx.rooms()?, tx.doors()?);
        Ok(Self { rooms, doors, starts: tx.starts()?, witnesses: tx.witnesses()? })
    }

    fn door(&self, key: i64) -> Option<&Door> {
        self.doors.binary_search_by_key(&key, |door| door.door).ok().map(|index| &self.doors[index])
    }

    /// Whether routes were kept from these starts, in whatever order, each as the same tree.
    pub fn same_starts(&self, starts: &[Start]) -> bool {
        let sorted = |starts: &[Start]| {
            let mut starts = starts.to_vec();
            starts.sort_unstable_by(|a, b| (&a.name, &a.robot, a.tree).cmp(&(&b.name, &b.robot, b.tree)));
            starts
        };
        sorted(&self.starts) == sorted(starts)
    }

    /// Whether the rooms are the same rectangles of the same states, so that numbers mean what they meant.
    pub fn same_rooms(&self, graph: &SiteGraph) -> bool {
        let same = |(old, new): (&Room, &Room)| {
            old.rect.map(f64::to_bits) == new.rect.map(f64::to_bits)
                && old.layer == new.layer
                && old.facing == new.facing
        };
        self.rooms.len() == graph.rooms.len() && self.rooms.iter().zip(&graph.rooms).all(same)
    }
}

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
}

/// The routes that are kept.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Routes {
    /// Names that routes start from.
    pub starts: usize,
    /// Rows written.
    pub rows: u64,
    /// Routes from a kept start whose cost changed; `None` where they were made anew.
    pub changed: Option<usize>,
    /// Those of them that lead another way.
    pub rerouted: Option<usize>,
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

/// Costs of the routes between places, by robot, start and goal.
pub type PlaceCosts = BTreeMap<(String, String, String), f64>;

impl Routes {
    /// None yet; `comparable` where routes of before can be compared.
    pub fn new(starts: usize, comparable: bool) -> Self {
        let none = comparable.then_some(0);
        Self { starts, changed: none, rerouted: none, ..Self::default() }
    }

    /// Counts what differs between a tree of before and of now; whether its rows must be written.
    pub fn differs(
        &mut self,
        before: &Before,
        (start, old): (&Start, &[TreeRow]),
        new: &[TreeRow],
        graph: &SiteGraph,
    ) -> bool {
        let now = |row: &TreeRow| {
            row.reach + row.door.and_then(|key| graph.door(key)?.hardness.value).unwrap_or(0.0)
        };
        let then = |row: &TreeRow| {
            row.reach + row.door.and_then(|key| before.door(key)?.hardness.value).unwrap_or(0.0)
        };
        let (old_rows, new_rows) = (by_node(old), by_node(new));
        let (mut changed, mut rerouted) = (0, 0);
        for node in old_rows.keys().chain(new_rows.keys().filter(|node| !old_rows.contains_key(node))) {
            let (old_row, new_row) = (old_rows.get(node), new_rows.get(node));
            let costs = (old_row.map(|row| then(row)), new_row.map(|row| now(row)));
            let other_way = old_row.map(|row| row.prev) != new_row.map(|row| row.prev)
                || way(&old_rows, *node) != way(&new_rows, *node);
            let differ = costs.0.map(f64::to_bits) != costs.1.map(f64::to_bits);
            changed += usize::from(differ || other_way);
            rerouted += usize::from(other_way);
            if differ && let Some(place) = graph.place_of(*node) {
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
        old != new
    }
}

impl Routes {
    /// Compares the routes between places where the rooms were cut anew, so that trees cannot be compared.
    pub fn compare(&mut self, old: &PlaceCosts, new: &PlaceCosts) {
        for key in old.keys().chain(new.keys().filter(|key| !old.contains_key(*key))) {
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

fn by_node(rows: &[TreeRow]) -> BTreeMap<i64, &TreeRow> {
    rows.iter().map(|row| (row.node, row)).collect()
}

/// The doors of a route, from its goal back.
fn way(rows: &BTreeMap<i64, &TreeRow>, node: i64) -> Vec<Option<i64>> {
    let mut doors = Vec::new();
    let mut at = rows.get(&node);
    while let Some(row) = at {
        doors.push(row.door);
        at = row.prev.and_then(|prev| rows.get(&prev));
    }
    doors
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
    /// The rooms and doors that changed; none where all were cut anew.
    pub changes: Vec<Change>,
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
    /// What routes need and no rule gave.
    pub gaps: Vec<String>,
    /// Rows of tables that no rule can ever choose.
    pub dominated: Vec<Dominated>,
}

impl Report {
    pub(crate) fn new(
        before: &Before,
        graph: &SiteGraph,
        routes: Routes,
        mut derived: Derived,
        inputs: &Inputs,
        generation: u64,
    ) -> Self {
        let cut_anew = !before.same_rooms(graph);
        let mut changes = Vec::new();
        if !cut_anew {
            changes
                .extend(before.rooms.iter().zip(&graph.rooms).filter_map(|(old, new)| room_change(old, new)));
        }
        let changed_rooms = if cut_anew { graph.rooms.len() } else { changes.len() };
        let mut changed_doors = graph.doors.len();
        if !cut_anew {
            let doors: Vec<Change> =
                graph.doors.iter().filter_map(|new| door_change(before.door(new.door), new)).collect();
            changed_doors = doors.len();
            changes.extend(doors);
        }
        Self {
            generation,
            rooms: Counts { total: graph.rooms.len(), changed: changed_rooms },
            doors: Counts { total: graph.doors.len(), changed: changed_doors },
            changes,
            cut_anew,
            routes,
            stages: derived.stages,
            map: inputs.map_report.clone(),
            notes: inputs.notes.clone(),
            gaps: gaps(&derived.conclusions, graph),
            dominated: derived.knowledge.dominated(&inputs.rules),
        }
    }

    /// The report as JSON.
    pub fn json(&self) -> serde_json::Value {
        let stage = |stage: &Stage| serde_json::json!({"stage": stage.name, "seconds": stage.took.as_secs_f64(), "kept": stage.kept});
        serde_json::json!({
            "generation": self.generation,
            "rooms": self.rooms,
            "doors": self.doors,
            "cut_anew": self.cut_anew,
            "changes": self.changes,
            "routes": self.routes,
            "stages": self.stages.iter().map(stage).collect::<Vec<_>>(),
            "free_space_m2": {
                "in_file": self.map.free_in_file,
                "unknown_in_file": self.map.unknown_in_file,
                "unknown": self.map.unknown,
                "specks": self.map.specks,
                "grid": self.map.grid,
                "clearance": self.map.clearance,
                "free": self.map.free,
            },
            "notes": self.notes,
            "gaps": self.gaps,
        })
    }
}

fn room_change(old: &Room, new: &Room) -> Option<Change> {
    let differs = old.hardness.value != new.hardness.value
        || old.action.value != new.action.value
        || old.passable.value != new.passable.value;
    differs.then(|| Change {
        what: format!("room {}", new.name),
        old: old.hardness.value,
        new: new.hardness.value,
        old_action: old.action.value.clone(),
        new_action: new.action.value.clone(),
    })
}

fn door_change(old: Option<&Door>, new: &Door) -> Option<Change> {
    let same = old.is_some_and(|old| {
        old.hardness.value == new.hardness.value
            && old.action.value == new.action.value
            && old.passable.value == new.passable.value
    });
    (!same).then(|| Change {
        what: format!("door {}", new.door),
        old: old.and_then(|door| door.hardness.value),
        new: new.hardness.value,
        old_action: old.and_then(|door| door.action.value.clone()),
        new_action: new.action.value.clone(),
    })
}

/// What routes need and no rule gave, in sentences.
fn gaps(conclusions: &Conclusions, graph: &SiteGraph) -> Vec<String> {
    let mut notes = Vec::new();
    for waiting in &conclusions.waiting {
        notes.push(format!(
            "rule \"{}\" waits for {}, which nothing gives",
            waiting.rule,
            waiting.needs.join(", ")
        ));
    }
    notes.extend(conflicts(conclusions));
    let unweighed =
        graph.rooms.iter().filter(|room| room.hardness.value.is_none() && room.layer.is_some()).count();
    if unweighed > 0 {
        notes.push(format!("{unweighed} rooms have no ROOMS.hardness, so no route enters them"));
    }
    let undecided = graph.rooms.iter().filter(|room| room.passable.value.is_none()).count();
    if undecided > 0 {
        notes.push(format!("{undecided} rooms have no ROOMS.passable, so no route enters them"));
    }
    let missing = |what: &str, count: usize| {
        (count > 0).then(|| format!("{count} doors have no DOORS.{what}, so no route passes them"))
    };
    let unweighed =
        graph.doors.iter().filter(|door| door.hardness.value.is_none() && door.passable.value != Some(false));
    let undecided = graph.doors.iter().filter(|door| door.passable.value.is_none());
    notes.extend(missing("hardness", unweighed.count()));
    notes.extend(missing("passable", undecided.count()));
    notes
}

/// Objects on which the same rules disagree, in one sentence.
fn conflicts(conclusions: &Conclusions) -> Vec<String> {
    let mut groups: BTreeMap<(String, Vec<String>), Vec<&str>> = BTreeMap::new();
    for conflict in &conclusions.conflicts {
        let said = conflict.values.iter().map(|(rule, value)| format!("\"{rule}\" says {value}")).collect();
        groups.entry((conflict.property.to_string(), said)).or_default().push(&conflict.key);
    }
    let sentence = |((property, said), keys): ((String, Vec<String>), Vec<&str>)| {
        let more = if keys.len() > 5 { ", ..." } else { "" };
        let named = keys.iter().take(5).copied().collect::<Vec<_>>().join(", ");
        format!(
            "{property} of {} ({named}{more}) is unknown, since rules disagree: {}",
            keys.len(),
            said.join(", ")
        )
    };
    groups.into_iter().map(sentence).collect()
}
