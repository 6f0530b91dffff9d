//! What a search missed though doors lead there: gates are where a change of shape pays, and it may be the only way, too.

use fixedbitset::FixedBitSet;
use petgraph::Direction::Incoming;
use petgraph::visit::{IntoNeighborsDirected, Visitable};

use super::super::graph::RouteGraph;
use super::super::parts::{Goal, RoomIndex, Start};
use super::{NO_NODE, Outcome, Search, Wanted};

impl Outcome {
    /// Looks again for the goals, and the rooms where ways to all are asked for, that were not found though doors join them
    /// with the start: with changes of shape anywhere on the way into them and, where that is not enough, everywhere.
    pub(super) fn look_for_missed(
        &mut self,
        graph: &RouteGraph,
        start: &Start,
        goals: &[Goal],
        wanted: Wanted,
        limit: f64,
    ) {
        let mut joined = None;
        for is_everywhere in [false, true] {
            if self.is_cut || self.has(wanted) {
                return;
            }
            let joined = joined.get_or_insert_with(|| graph.joined_with(&start.rooms));
            let missed = Missed::of(self, goals, joined);
            let goals = missed.as_goals(goals);
            if goals.is_empty() {
                return;
            }
            let mut freely = FixedBitSet::with_capacity(graph.rooms().len());
            if is_everywhere {
                freely.insert_range(..);
            } else {
                self.lead_to(graph, &goals, &mut freely);
            }
            let wanted = if wanted == Wanted::One { Wanted::One } else { Wanted::Goals };
            self.add(Search::new(graph, &goals, (wanted, limit), freely).run(start), missed);
        }
    }

    /// Whether all that was asked for is found.
    fn has(&self, wanted: Wanted) -> bool {
        let mut goals = self.goals.iter().map(|found| !found.is_empty());
        match wanted {
            Wanted::One => goals.any(|is_found| is_found),
            Wanted::Goals | Wanted::Rooms => {
                goals.all(|is_found| is_found) && self.rooms.iter().all(|found| !found.is_empty())
            }
        }
    }

    /// The rooms of goals, and those from which doors lead into them through rooms that were never gone on from.
    fn lead_to(&self, graph: &RouteGraph, goals: &[Goal], found: &mut FixedBitSet) {
        let mut is_gone_on_from = graph.visit_map();
        let mut passed_over = FixedBitSet::with_capacity(self.nodes.len());
        passed_over.extend(self.passed_over.iter().map(|&node| node as usize));
        let gone_on_from = self.nodes.iter().enumerate().filter(|(node, _)| !passed_over.contains(*node));
        is_gone_on_from.extend(gone_on_from.map(|(_, node)| node.room.index()));
        let mut next: Vec<RoomIndex> =
            goals.iter().flat_map(|goal| &goal.rooms).map(|entry| entry.room).collect();
        while let Some(room) = next.pop() {
            if !found.put(room.index()) && !is_gone_on_from.contains(room.index()) {
                next.extend(graph.neighbors_directed(room, Incoming));
            }
        }
    }

    /// Takes over what another search found of what was missed.
    fn add(&mut self, mut other: Self, missed: Missed) {
        let known = self.nodes.len() as u32;
        for node in other.nodes.iter_mut().filter(|node| node.before != NO_NODE) {
            node.before += known;
        }
        for found in other.goals.iter_mut().flatten() {
            found.node += known;
        }
        self.nodes.append(&mut other.nodes);
        self.passed_over.extend(other.passed_over.iter().map(|node| node + known));
        let mut found = other.goals.into_iter();
        for (goal, found) in missed.goals.into_iter().zip(found.by_ref()) {
            self.goals[goal] = found;
        }
        for (room, found) in missed.rooms.into_iter().zip(found) {
            self.rooms[room] = found;
        }
        self.is_cut |= other.is_cut;
    }
}

/// Goals and rooms that are joined with the start and were not found, by index.
struct Missed {
    goals: Vec<usize>,
    rooms: Vec<usize>,
}

impl Missed {
    fn of(outcome: &Outcome, goals: &[Goal], joined: &FixedBitSet) -> Self {
        let is_joined = |goal: &Goal| goal.rooms.iter().any(|entry| joined[entry.room.index()]);
        let is_missed = |goal: &usize| outcome.goals[*goal].is_empty() && is_joined(&goals[*goal]);
        let is_room_missed = |room: &usize| outcome.rooms[*room].is_empty() && joined[*room];
        Self {
            goals: (0..goals.len()).filter(is_missed).collect(),
            rooms: (0..outcome.rooms.len()).filter(is_room_missed).collect(),
        }
    }

    /// The goals, then the rooms, to anywhere in them.
    fn as_goals(&self, goals: &[Goal]) -> Vec<Goal> {
        let rooms = self.rooms.iter().map(|&room| Goal::within([RoomIndex::new(room)], None));
        self.goals.iter().map(|&goal| goals[goal].clone()).chain(rooms).collect()
    }
}
