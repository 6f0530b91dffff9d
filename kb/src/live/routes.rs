//! The kept routes, and what of them an edit changes.

use adit_db::Tx;
use adit_db::tree::{TreeChange, TreeRow};
use adit_db::weight::Weight;
use adit_planners::geometry::Point;
use adit_planners::routes::{CompactGraph, CompactTree, RoomIndex};

use crate::error::Result;
use crate::graph::{End, SiteGraph, heading, place_node};
use crate::live::trees::Plan;
use crate::state::Weighed;

/// The trees of the kept starts.
pub struct KeptRoutes {
    plan: Plan,
    trees: Trees,
}

/// Up to so many rooms of trees are searched anew by each edit, in a few milliseconds.
const AT_ONCE: usize = 400_000;

/// Trees as they are kept between edits.
enum Trees {
    /// Where all hardness lies on the doors, and trees are few: each edit brings them up to date. Arrays, and for each
    /// tree the rooms that hold the places.
    Now { graph: CompactGraph, trees: Vec<CompactTree>, places: Vec<Vec<Option<RoomIndex>>> },
    /// They follow later: see [`Renewal`](super::Renewal).
    Later,
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
    /// The trees of these starts, which follow edits later.
    pub fn later(plan: Plan) -> Self {
        Self { plan, trees: Trees::Later }
    }

    /// Begins with other starts, or on another graph; trees that followed edits at once still do.
    pub fn restart(&mut self, graph: &SiteGraph, plan: Plan) {
        let follows = matches!(self.trees, Trees::Now { .. });
        self.plan = plan;
        self.trees = Trees::Later;
        if follows {
            self.follow_at_once(graph);
        }
    }

    /// Has the trees follow each edit at once, where all hardness lies on the doors and trees are few.
    pub fn follow_at_once(&mut self, graph: &SiteGraph) {
        let plan = &self.plan;
        let is_small = plan.roots.len() * graph.rooms.len() <= AT_ONCE;
        let compact = if is_small { CompactGraph::new(graph.graph()) } else { None };
        if let Some(compact) = compact {
            let trees = plan.roots.iter().map(|(_, start)| compact.tree(start)).collect();
            let place = |robot: &str, index| {
                let rooms = graph.entries(None, &End::Place(index), Some(robot));
                rooms.first().map(|entry| entry.room)
            };
            let places =
                |(robot, _): &(String, _)| (0..graph.places.len()).map(|index| place(robot, index)).collect();
            let places = plan.roots.iter().map(places).collect();
            self.trees = Trees::Now { graph: compact, trees, places };
        }
    }

    /// The trees that are kept.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The routes over the doors and rooms as they now weigh; `None` where ways are measured from now on, or no longer.
    ///
    /// Where they are, what is asked from now on is found with the new weights; the kept routes are due.
    pub fn renew(&mut self, graph_now: &SiteGraph, weighed: &Weighed) -> Option<Renewed> {
        if weighed.is_empty() {
            return Some(Renewed { changes: Vec::new(), trees: None, is_due: false });
        }
        let is_on_doors = |(_, room): &(RoomIndex, Weight)| {
            room.hardness.value.is_none() && room.passable.value == Some(true)
        };
        match &mut self.trees {
            Trees::Now { graph, trees, places } if weighed.rooms.iter().all(is_on_doors) => {
                for (door, weight) in &weighed.doors {
                    graph.reweigh(*door, weight_of(weight.hardness.value, weight.passable.value));
                }
                let roots = &self.plan.roots;
                let now: Vec<_> = roots.iter().map(|(_, start)| graph.tree(start)).collect();
                let changes = now.iter().zip(trees.iter()).zip(roots.iter().zip(places));
                let changes = changes.map(|((now, before), ((_, start), places))| {
                    differences(graph_now, (before, now), start.at, places)
                });
                Some(Renewed { changes: changes.collect(), trees: Some(now), is_due: false })
            }
            Trees::Now { .. } => None,
            Trees::Later => Some(Renewed { changes: Vec::new(), trees: None, is_due: true }),
        }
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
    pub fn accept(&mut self, renewed: Renewed) {
        if let (Some(now), Trees::Now { trees, .. }) = (renewed.trees, &mut self.trees) {
            *trees = now;
        }
    }

    /// Forgets an edit that was not committed, over the graph that still counts.
    pub fn take_back(&mut self, shown: &SiteGraph) {
        if let Trees::Now { graph, .. } = &mut self.trees {
            for (index, door) in shown.graph().door_indices().zip(&shown.doors) {
                graph.reweigh(index, weight_of(door.hardness.value, door.passable.value));
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
    places: &[Option<RoomIndex>],
) -> TreeChange {
    let mut change = TreeChange::default();
    for (index, room) in places.iter().enumerate().rev() {
        let Some(room) = *room else { continue };
        let row = |tree: &CompactTree| {
            let goal = graph.point(&End::Place(index));
            tree.cost(room).is_finite().then(|| TreeRow {
                node: place_node(index),
                prev: Some(graph[room].room),
                from_room: None,
                door: None,
                hops: i64::from(tree.hops(room)),
                reach: tree.cost(room),
                leg: 0.0,
                walked: None,
                at: Some([goal.x, goal.y]),
                heading: heading(arrival(graph, tree, room, start), goal),
                distance: None,
                clearance: None,
                bend: true,
            })
        };
        change.note(row(before).as_ref(), row(now).as_ref());
    }
    for room in graph.graph().room_indices() {
        let last = before.before(room);
        let entered_by = |tree: &CompactTree, room| tree.before(room).map(|(_, door)| door);
        let is_same = last == now.before(room)
            && before.hops(room) == now.hops(room)
            && before.cost(room).is_finite() == now.cost(room).is_finite()
            && last.is_none_or(|(last, _)| entered_by(before, last) == entered_by(now, last));
        if !is_same {
            let row = |tree: &CompactTree| room_row(graph, tree, room, start);
            change.note(row(before).as_ref(), row(now).as_ref());
        } else if let Some((last, _)) = last {
            let (old, new) = (before.cost(last), now.cost(last));
            if old.to_bits() != new.to_bits() {
                change.further.push((graph[room].room, new));
            }
        }
    }
    change
}

/// Where a room is entered.
fn arrival(graph: &SiteGraph, tree: &CompactTree, room: RoomIndex, start: Point) -> Point {
    tree.before(room).map_or(start, |(_, door)| graph.graph()[door].at)
}

fn room_row(graph: &SiteGraph, tree: &CompactTree, room: RoomIndex, start: Point) -> Option<TreeRow> {
    if !tree.cost(room).is_finite() {
        return None;
    }
    let node = graph[room].room;
    let at = arrival(graph, tree, room, start);
    let row = TreeRow {
        node,
        prev: None,
        from_room: None,
        door: None,
        hops: i64::from(tree.hops(room)),
        reach: 0.0,
        leg: 0.0,
        walked: None,
        at: None,
        heading: None,
        distance: None,
        clearance: None,
        bend: true,
    };
    let Some((last, door)) = tree.before(room) else {
        return Some(TreeRow { at: Some([at.x, at.y]), ..row });
    };
    Some(TreeRow {
        prev: Some(graph[last].room),
        door: Some(graph[door].door),
        reach: tree.cost(last),
        heading: heading(arrival(graph, tree, last, start), at),
        ..row
    })
}
