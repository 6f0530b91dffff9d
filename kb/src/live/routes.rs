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
    /// Where rooms weigh metres: the rows.
    Rows(Vec<Vec<TreeRow>>),
}

/// Trees of now, and how their rows differ from those of before.
pub struct Renewed {
    changes: Vec<TreeChange>,
    trees: Option<NewTrees>,
}

enum NewTrees {
    OnDoors(Vec<CompactTree>),
    Rows(Vec<Vec<TreeRow>>),
}

impl Renewed {
    /// How many rows differ.
    pub fn rows(&self) -> usize {
        self.changes.iter().map(TreeChange::len).sum()
    }
}

impl KeptRoutes {
    /// Takes the graph of a built site, and its trees.
    pub fn read(tx: &mut Tx<'_>, graph: SiteGraph, plan: Plan) -> Result<Self> {
        let trees = if let Some(compact) = CompactGraph::new(graph.graph()) {
            let trees = plan.roots.iter().map(|(_, start)| compact.tree(&start.rooms)).collect();
            let place = |robot: &str, index| graph.rooms_of(&End::Place(index), Some(robot)).first().copied();
            let places =
                |(robot, _): &(String, _)| (0..graph.places.len()).map(|index| place(robot, index)).collect();
            let places = plan.roots.iter().map(places).collect();
            Trees::OnDoors { graph: compact, trees, places }
        } else {
            let mut rows = Vec::new();
            for tree in 1..=plan.roots.len() as i64 {
                rows.push(tx.tree_rows(tree)?);
            }
            Trees::Rows(rows)
        };
        Ok(Self { graph, plan, trees })
    }

    /// The graph.
    pub fn graph(&self) -> &SiteGraph {
        &self.graph
    }

    /// The routes over the doors and rooms as they now weigh; `None` where others have to be kept than before.
    ///
    /// # Arguments
    /// `robots` are the robots of the site; `wanted` is what `site.toml` says of starts.
    pub fn renew(
        &mut self,
        written: &Written,
        robots: &[String],
        wanted: Option<&Starts>,
        gauge: &Gauge,
    ) -> Result<Option<Renewed>> {
        if written.doors.is_empty() && written.rooms.is_empty() {
            return Ok(Some(Renewed { changes: Vec::new(), trees: None }));
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
                Ok(Some(Renewed { changes: changes.collect(), trees: Some(NewTrees::OnDoors(now)) }))
            }
            _ => self.renew_rows(written, robots, wanted, gauge),
        }
    }

    fn renew_rows(
        &self,
        written: &Written,
        robots: &[String],
        wanted: Option<&Starts>,
        gauge: &Gauge,
    ) -> Result<Option<Renewed>> {
        let (mut rooms, mut doors) = (self.graph.rooms.clone(), self.graph.doors.clone());
        for (row, weight) in &written.rooms {
            rooms[*row].hardness = weight.hardness.clone();
            rooms[*row].passable = weight.passable.clone();
        }
        for (row, weight) in &written.doors {
            doors[*row].hardness = weight.hardness.clone();
            doors[*row].passable = weight.passable.clone();
        }
        let graph = SiteGraph::new(rooms, doors, self.graph.places.clone());
        let plan = trees::plan(&graph, robots, wanted)?;
        let Trees::Rows(before) = &self.trees else { return Ok(None) };
        if plan.starts != self.plan.starts {
            return Ok(None);
        }
        let now = trees::rows(&graph, &plan.roots, gauge);
        let changes = now.iter().zip(before).map(|(now, before)| row_differences(before, now)).collect();
        Ok(Some(Renewed { changes, trees: Some(NewTrees::Rows(now)) }))
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
        match (renewed.trees, &mut self.trees) {
            (Some(NewTrees::OnDoors(now)), Trees::OnDoors { trees, .. }) => *trees = now,
            (Some(NewTrees::Rows(now)), Trees::Rows(rows)) => *rows = now,
            _ => {}
        }
    }

    /// Gives the doors the weights of before an edit that was not committed.
    pub fn take_back(&mut self) {
        if let Trees::OnDoors { graph, .. } = &mut self.trees {
            for (row, door) in self.graph.doors.iter().enumerate() {
                graph.reweigh(row, weight_of(door.hardness.value, door.passable.value));
            }
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

/// The rows that differ between two lists, both by node.
fn row_differences(before: &[TreeRow], now: &[TreeRow]) -> TreeChange {
    let mut change = TreeChange::default();
    let (mut old, mut new) = (before.iter().peekable(), now.iter().peekable());
    loop {
        let (left, right) = (old.peek().map(|row| row.node), new.peek().map(|row| row.node));
        let Some(node) = left.into_iter().chain(right).min() else { return change };
        let before = old.next_if(|row| row.node == node).copied();
        let now = new.next_if(|row| row.node == node).copied();
        note(&mut change, node, before, now);
    }
}
