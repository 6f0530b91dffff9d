//! The kept routes, and what of them an edit changes.

use adit_db::Tx;
use adit_db::room::RoomWeight;
use adit_db::tree::{TreeChange, TreeRow};
use adit_planners::geometry::Point;
use adit_planners::routes::{CompactGraph, CompactTree, NONE};

use super::kept::Written;
use crate::error::Result;
use crate::gauge::Gauge;
use crate::graph::{End, SiteGraph};
use crate::site::Starts;
use crate::trees::{self, Plan};

/// The graph of the site, and the trees of its kept starts.
pub struct KeptRoutes {
    graph: SiteGraph,
    plan: Plan,
    trees: Trees,
}

/// Trees as they are kept between edits.
enum Trees {
    /// Where all hardness lies on the doors: arrays, and for each tree the rooms that hold the places.
    OnDoors { graph: CompactGraph, trees: Vec<CompactTree>, places: Vec<Vec<Option<usize>>> },
    /// Where rooms weigh metres: they are found when they are asked for, and kept ones follow later.
    Measured,
}

/// Trees of now, and how their rows differ from those of before.
pub struct Renewed {
    changes: Vec<TreeChange>,
    trees: Option<Vec<CompactTree>>,
    /// Whether the kept routes have yet to follow.
    pub is_due: bool,
}

impl Renewed {
    /// How many rows differ.
    pub fn rows(&self) -> usize {
        self.changes.iter().map(TreeChange::len).sum()
    }
}

impl KeptRoutes {
    /// Takes the graph of a built site, and its trees.
    pub fn new(graph: SiteGraph, plan: Plan) -> Self {
        let trees = if let Some(compact) = CompactGraph::new(graph.graph()) {
            let trees = plan.roots.iter().map(|(_, start)| compact.tree(&start.rooms)).collect();
            let place = |robot: &str, index| graph.rooms_of(&End::Place(index), Some(robot)).first().copied();
            let places =
                |(robot, _): &(String, _)| (0..graph.places.len()).map(|index| place(robot, index)).collect();
            let places = plan.roots.iter().map(places).collect();
            Trees::OnDoors { graph: compact, trees, places }
        } else {
            Trees::Measured
        };
        Self { graph, plan, trees }
    }

    /// The graph.
    pub fn graph(&self) -> &SiteGraph {
        &self.graph
    }

    /// The routes over the doors and rooms as they now weigh; `None` where ways are measured from now on, or no longer.
    ///
    /// Where they are, what is asked from now on is found with the new weights; the kept routes are due.
    pub fn renew(&mut self, written: &Written) -> Option<Renewed> {
        if written.doors.is_empty() && written.rooms.is_empty() {
            return Some(Renewed { changes: Vec::new(), trees: None, is_due: false });
        }
        let is_on_doors = |(_, room): &(usize, RoomWeight)| {
            room.hardness.value.is_none() && room.passable.value == Some(true)
        };
        match &mut self.trees {
            Trees::OnDoors { graph, trees, places } if written.rooms.iter().all(is_on_doors) => {
                for (door, weight) in &written.doors {
                    graph.reweigh(*door, weight_of(weight.hardness.value, weight.passable.value));
                }
                let roots = &self.plan.roots;
                let now: Vec<_> = roots.iter().map(|(_, start)| graph.tree(&start.rooms)).collect();
                let site = &self.graph;
                let changes = now.iter().zip(trees.iter()).zip(roots.iter().zip(places));
                let changes = changes.map(|((now, before), ((_, start), places))| {
                    differences(site, (before, now), start.at, places)
                });
                Some(Renewed { changes: changes.collect(), trees: Some(now), is_due: false })
            }
            Trees::OnDoors { .. } => None,
            Trees::Measured => {
                let rooms = written.rooms.iter().map(|(row, of)| (*row, &of.hardness, &of.passable));
                let doors = written.doors.iter().map(|(row, of)| (*row, &of.hardness, &of.passable));
                self.graph.reweigh(rooms, doors);
                Some(Renewed { changes: Vec::new(), trees: None, is_due: true })
            }
        }
    }

    /// Writes the kept routes as they now are, where ways are measured; how many rows. `None` where others have to be
    /// kept than before.
    pub fn follow(
        &self,
        tx: &mut Tx<'_>,
        robots: &[String],
        wanted: Option<&Starts>,
        gauge: &Gauge,
    ) -> Result<Option<u64>> {
        let plan = trees::plan(&self.graph, robots, wanted)?;
        if plan.starts != self.plan.starts {
            return Ok(None);
        }
        let mut written = 0;
        for (tree, rows) in (1..).zip(trees::rows(&self.graph, &plan.roots, gauge)) {
            written += tx.put_tree(tree, rows)?;
        }
        Ok(Some(written))
    }

    /// Writes the rows that differ.
    pub fn write(tx: &mut Tx<'_>, renewed: &Renewed) -> Result<()> {
        for (tree, change) in (1..).zip(&renewed.changes) {
            if !change.is_empty() {
                tx.change_tree(tree, change)?;
            }
        }
        Ok(())
    }

    /// Makes renewed routes the kept ones.
    pub fn accept(&mut self, written: &Written, renewed: Renewed) {
        for (row, weight) in &written.rooms {
            let room = &mut self.graph.rooms[*row];
            (room.hardness, room.action) = (weight.hardness.clone(), weight.action.clone());
            room.passable = weight.passable.clone();
        }
        for (row, weight) in &written.doors {
            let door = &mut self.graph.doors[*row];
            (door.hardness, door.action) = (weight.hardness.clone(), weight.action.clone());
            door.passable = weight.passable.clone();
        }
        if let (Some(now), Trees::OnDoors { trees, .. }) = (renewed.trees, &mut self.trees) {
            *trees = now;
        }
    }

    /// Gives rooms and doors the weights of before an edit that was not committed.
    pub fn take_back(&mut self) {
        match &mut self.trees {
            Trees::OnDoors { graph, .. } => {
                for (row, door) in self.graph.doors.iter().enumerate() {
                    graph.reweigh(row, weight_of(door.hardness.value, door.passable.value));
                }
            }
            Trees::Measured => self.graph.reweigh_as_rows_say(),
        }
    }
}

/// What passing a door weighs, where it can be passed.
fn weight_of(hardness: Option<f64>, passable: Option<bool>) -> Option<f64> {
    hardness.filter(|hardness| passable == Some(true) && !hardness.is_nan())
}

/// The rows that differ between two trees, places first, as their nodes are ordered.
fn differences(
    graph: &SiteGraph,
    (before, now): (&CompactTree, &CompactTree),
    start: Point,
    places: &[Option<usize>],
) -> TreeChange {
    let mut change = TreeChange::default();
    for (index, room) in places.iter().enumerate().rev() {
        let Some(room) = *room else { continue };
        let node = trees::place_node(index);
        let row = |tree: &CompactTree| {
            let goal = graph.point(&End::Place(index));
            tree.costs[room].is_finite().then(|| TreeRow {
                node,
                prev: Some(graph.rooms[room].room),
                from_room: None,
                door: None,
                hops: i64::from(tree.hops[room]),
                reach: tree.costs[room],
                leg: 0.0,
                at: Some([goal.x, goal.y]),
                heading: trees::heading(arrival(graph, tree, room, start), goal),
                distance: None,
                clearance: None,
                bend: true,
            })
        };
        note(&mut change, node, row(before), row(now));
    }
    for room in 0..graph.rooms.len() {
        let last = before.before[room];
        let is_same = last == now.before[room]
            && before.doors[room] == now.doors[room]
            && before.hops[room] == now.hops[room]
            && before.costs[room].is_finite() == now.costs[room].is_finite()
            && (last == NONE || before.doors[last as usize] == now.doors[last as usize]);
        if !is_same {
            let row = |tree: &CompactTree| room_row(graph, tree, room, start);
            note(&mut change, graph.rooms[room].room, row(before), row(now));
        } else if last != NONE {
            let (old, new) = (before.costs[last as usize], now.costs[last as usize]);
            if old.to_bits() != new.to_bits() {
                change.further.push((graph.rooms[room].room, new));
            }
        }
    }
    change
}

fn note(change: &mut TreeChange, node: i64, before: Option<TreeRow>, now: Option<TreeRow>) {
    match (before, now) {
        (Some(_), None) => change.gone.push(node),
        (None, Some(row)) => change.new.push(row),
        (Some(old), Some(new)) if old != new => {
            if old == (TreeRow { reach: old.reach, ..new }) {
                change.further.push((node, new.reach));
            } else {
                change.changed.push(new);
            }
        }
        _ => {}
    }
}

/// Where a room is entered.
fn arrival(graph: &SiteGraph, tree: &CompactTree, room: usize, start: Point) -> Point {
    match tree.doors[room] {
        NONE => start,
        door => graph.graph().doors()[door as usize].at,
    }
}

fn room_row(graph: &SiteGraph, tree: &CompactTree, room: usize, start: Point) -> Option<TreeRow> {
    if !tree.costs[room].is_finite() {
        return None;
    }
    let node = graph.rooms[room].room;
    let at = arrival(graph, tree, room, start);
    let row = TreeRow {
        node,
        prev: None,
        from_room: None,
        door: None,
        hops: i64::from(tree.hops[room]),
        reach: 0.0,
        leg: 0.0,
        at: None,
        heading: None,
        distance: None,
        clearance: None,
        bend: true,
    };
    if tree.before[room] == NONE {
        return Some(TreeRow { at: Some([at.x, at.y]), ..row });
    }
    let last = tree.before[room] as usize;
    Some(TreeRow {
        prev: Some(graph.rooms[last].room),
        door: Some(i64::from(graph.graph().doors()[tree.doors[room] as usize].door)),
        reach: tree.costs[last],
        heading: trees::heading(arrival(graph, tree, last, start), at),
        ..row
    })
}
