//! Trees where rooms weigh their metres: ways that were pulled tight, with what they have in common kept once.

use std::collections::BTreeMap;

use adit_db::tree::TreeRow;
use adit_planners::routes::{DoorIndex, Goal, Leg, RoomIndex, Start, Way};

use super::ends::keeps_rooms;
use crate::graph::gauge::{Gauge, bends, headings};
use crate::graph::{End, SiteGraph, place_node};

pub(super) fn rows(graph: &SiteGraph, (robot, start): &(String, Start), gauge: &Gauge) -> Vec<TreeRow> {
    let goal = |index: usize| graph.goal(Some(gauge), &End::Place(index), Some(robot));
    let goals: Vec<Goal> = (0..graph.places.len()).map(goal).collect();
    let ways = graph.graph().ways(start, &goals, keeps_rooms(graph));
    let mut chains = Chains::new(graph, place_node(graph.places.len()));
    // the cheapest first: a way leads through rooms that are reached at less cost
    let mut rooms: Vec<(i64, &Way)> = graph
        .rooms
        .iter()
        .zip(&ways.rooms)
        .filter_map(|(room, way)| Some((room.room, way.as_ref()?)))
        .collect();
    rooms.sort_by(|(_, one), (_, two)| one.cost.total_cmp(&two.cost));
    for (room, way) in rooms {
        chains.add(way, Some(room), None);
    }
    for (index, way) in ways.goals.iter().enumerate() {
        let Some(way) = way else { continue };
        chains.add(way, None, Some(gauge));
        chains.arrive(place_node(index), way);
    }
    chains.rows.into_values().collect()
}

/// A node by what leads there: the node before, the room walked, the door passed and where.
type Step = (i64, RoomIndex, Option<DoorIndex>, [u64; 2]);

/// Ways from one start, with equal beginnings told once.
struct Chains<'g> {
    graph: &'g SiteGraph,
    nodes: BTreeMap<Step, i64>,
    rows: BTreeMap<i64, TreeRow>,
    /// The number of the next node that is no room and no place.
    next: i64,
    /// The end of the way added last.
    last: Last,
}

/// The node before a way's last leg, and what is known of that leg.
struct Last {
    node: i64,
    clearance: Option<f64>,
    heading: Option<f64>,
    bend: bool,
    walked: Walked,
}

/// How far a way has come.
#[derive(Clone, Copy, Default)]
struct Walked {
    /// Doors passed.
    doors: i64,
    /// Hardness in the room since its door: a way may bend in it.
    hardness: f64,
    /// Metres in it since then.
    metres: f64,
}

/// No node is before the first.
const NOTHING: i64 = 0;

impl<'g> Chains<'g> {
    fn new(graph: &'g SiteGraph, next: i64) -> Self {
        let (nodes, rows) = (BTreeMap::new(), BTreeMap::new());
        Self {
            graph,
            nodes,
            rows,
            next,
            last: Last {
                node: NOTHING,
                clearance: None,
                heading: None,
                bend: true,
                walked: Walked::default(),
            },
        }
    }

    /// Adds a way up to its last door; `node` is the number of the node behind it, where that is free.
    fn add(&mut self, way: &Way, node: Option<i64>, gauge: Option<&Gauge>) {
        let bends = bends(self.graph, way);
        let headings = headings(way, &bends);
        let clearances = match gauge {
            Some(gauge) => gauge.clearances(self.graph, way, &bends),
            None => vec![None; way.legs.len()],
        };
        let doors = way.legs.len() - 1;
        let first = &way.legs[0];
        let start = TreeRow { distance: Some(0.0), bend: true, ..self.row(first, None, Walked::default()) };
        let start = TreeRow { at: Some([first.from.x, first.from.y]), ..start };
        let step = (NOTHING, first.room, None, [first.from.x.to_bits(), first.from.y.to_bits()]);
        let mut before = self.node(step, first.room, node.filter(|_| doors == 0), start);
        let (mut distance, mut walked) = (0.0, Walked::default());
        for (index, leg) in way.legs[..doors].iter().enumerate() {
            distance += leg.length();
            walked.hardness += leg.hardness;
            walked.metres += leg.length();
            walked.doors += i64::from(leg.door.is_some());
            let row = TreeRow {
                distance: Some(distance),
                clearance: clearances[index],
                bend: bends[index],
                heading: headings[index],
                ..self.row(leg, Some(before), walked)
            };
            if leg.door.is_some() {
                (walked.hardness, walked.metres) = (0.0, 0.0);
            }
            let room = way.legs[index + 1].room;
            let step = (before, leg.room, leg.door, [leg.to.x.to_bits(), leg.to.y.to_bits()]);
            before = self.node(step, room, node.filter(|_| index + 1 == doors), row);
        }
        walked.hardness += way.legs[doors].hardness;
        walked.metres += way.legs[doors].length();
        let (clearance, heading) = (clearances[doors], headings[doors]);
        self.last = Last { node: before, clearance, heading, bend: bends[doors], walked };
    }

    /// Adds the last leg of the way added last, to a place.
    fn arrive(&mut self, node: i64, way: &Way) {
        let Last { node: before, clearance, heading, bend, walked } = self.last;
        let Some(leg) = way.legs.last() else { return };
        let row = TreeRow {
            distance: Some(way.length()),
            clearance,
            heading,
            bend,
            node,
            ..self.row(leg, Some(before), walked)
        };
        self.rows.insert(node, row);
    }

    fn row(&self, leg: &Leg, before: Option<i64>, walked: Walked) -> TreeRow {
        let room = self.graph[leg.room].room;
        let weight = leg.door.and_then(|door| self.graph.graph()[door].weight()).unwrap_or(0.0);
        let is_start = before.is_none();
        TreeRow {
            node: NOTHING,
            prev: before,
            from_room: (before != Some(room)).then_some(room),
            door: leg.door.filter(|_| !is_start).map(|door| self.graph[door].door),
            hops: walked.doors,
            reach: if is_start { 0.0 } else { leg.cost - weight },
            leg: if is_start { 0.0 } else { walked.hardness },
            walked: (!is_start).then_some(walked.metres),
            at: Some([leg.to.x, leg.to.y]),
            heading: None,
            distance: None,
            clearance: None,
            bend: false,
        }
    }

    /// The number of a node, which is made if there is none yet.
    ///
    /// # Arguments
    /// `room` is the room in which it lies; `wanted` the number that it gets, if no other node has it.
    fn node(&mut self, step: Step, room: RoomIndex, wanted: Option<i64>, row: TreeRow) -> i64 {
        let wanted = wanted.filter(|node| !self.rows.contains_key(node));
        if let Some(&node) = self.nodes.get(&step) {
            let Some(known) = self.rows.get_mut(&node) else { return node };
            known.clearance = known.clearance.or(row.clearance);
            if let Some(wanted) = wanted {
                // a way that costs no more leads through the room
                let from_room = known.from_room.filter(|_| known.prev.is_some());
                let row = TreeRow { node: wanted, from_room, ..*known };
                self.rows.insert(wanted, row);
            }
            return node;
        }
        let node = wanted.unwrap_or_else(|| {
            self.next -= 1;
            self.next + 1
        });
        let key = self.graph[room].room;
        // at the start the room that it lies in is told unless the node is that room's
        let from_room = if row.prev.is_none() { (node != key).then_some(key) } else { row.from_room };
        self.nodes.insert(step, node);
        self.rows.insert(node, TreeRow { node, from_room, ..row });
        node
    }
}
