//! Changes of shape: where the search makes them to go on, and where it ends with one.

use std::rc::Rc;

use super::super::cone::Segment;
use super::super::cost::{hardly_less, hardly_more};
use super::super::mesh::Exit;
use super::super::parts::{Goal, RoomIndex};
use super::super::turning::Gate;
use super::{CLOSE_M, Found, NEAR_M, NO_NODE, Node, Search, View, Wanted, is_cheaper_from};
use crate::geometry::Point;
use crate::geometry::tolerance::SNAP_M;

impl Search<'_> {
    /// Into another state, to go on from there.
    pub(super) fn change(&mut self, index: u32, node: &Node, exit: Exit) {
        let Exit { door, to: room } = exit;
        let graph = self.graph;
        let is_in_steps = graph.is_sequence_cheaper(node.room, room);
        if graph.passage(door).is_none() && !is_in_steps || !graph.is_entered(room) {
            return;
        }
        let (here, there) = (graph.per_m(node.room), graph.per_m(room));
        let at_once = graph.passage(door).filter(|_| !is_in_steps);
        let least = at_once.unwrap_or_else(|| graph.least_of_sequence(node.room, room));
        let reach = |search: &mut Self, p: Point| {
            let cost = node.cost + node.root.distance(p) * here;
            let is_vain = |search: &Self, weight: f64| {
                let limit = hardly_more(cost + weight);
                search.is_cheaper_in(room, p, limit, there)
                    || is_cheaper_from(&search.offered[room.index()], p, limit, there)
            };
            // too dear, or reached at less cost otherwise
            if search.is_left_out(cost + least, (room, Segment::new(p, p)))
                || is_vain(search, least)
                || search.is_cheaper_in(node.room, p, hardly_less(cost), here)
                || graph.is_on_wall(room, p)
            {
                return;
            }
            let changes = search.changes_at(p, node.room, exit);
            let Some(weight) = changes.last().map(|(_, weight)| *weight) else { return };
            if at_once.is_some() || !is_vain(search, weight) {
                search.offered[room.index()].push((p, cost + weight));
                let last = search.all_but_the_last(index, (p, cost), &changes);
                search.push(last);
            }
        };
        // at the start, and where the body goes on turning
        let is_turning = || graph[node.door].is_change() && here.to_bits() == there.to_bits();
        let is_at_once = node.before == NO_NODE || is_turning();
        let Some(area) = graph[door].crossing.area() else { return };
        let about = area.bounds().grown(SNAP_M);
        if self.is_vain_about(node, (room, &about), least) {
            return;
        }
        if is_at_once && area.contains(node.root) {
            reach(self, node.root);
        }
        // who starts or ends in a strip too thin for gates changes at its edge
        let is_anywhere = self.freely.contains(room.index()) || node.before == NO_NODE;
        if is_anywhere || self.targets_in(room).next().is_some() {
            for side in graph.sides(door, room) {
                if !is_anywhere && !self.is_near_a_goal_in(room, &side) {
                    continue;
                }
                let Some(seen) = node.view.of(node.root, side) else { continue };
                if self.is_change_too_dear(node, (room, seen), least) {
                    continue;
                }
                for p in self.points(room, seen, node.root) {
                    reach(self, p);
                }
            }
        }
        if self.freely.contains(room.index()) {
            return;
        }
        if is_in_steps {
            let ends = self.ends_of_sequences.entry((door, node.room));
            let ends =
                Rc::clone(ends.or_insert_with(|| graph.ends_of_sequences(door, node.room, room).into()));
            for end in ends.iter() {
                if let Some(seen) = node.view.of_gate(node.root, *end)
                    && !self.is_change_too_dear(node, (room, seen), least)
                {
                    for p in self.points(room, seen, node.root) {
                        reach(self, p);
                    }
                }
            }
        }
        let mut is_step_on_a_way = None;
        for Gate { segment: gate, is_deep, is_step } in graph.gates(door, node.room) {
            if !is_deep && !self.is_near_a_goal(gate)
                || self.is_vain_about(node, (room, &gate.bounds()), least)
                || *is_step
                    && !*is_step_on_a_way.get_or_insert_with(|| graph.is_step_on_a_way(door, node.room))
            {
                continue;
            }
            if let Some(seen) = node.view.of_gate(node.root, *gate)
                && !self.is_change_too_dear(node, (room, seen), least)
            {
                for p in self.points(room, seen, node.root) {
                    reach(self, p);
                }
            }
        }
    }

    /// Into a room anywhere in which a way may end: where that is possible first, not where it pays to go on.
    pub(super) fn arrive_by_change(&mut self, index: u32, node: &Node, exit: Exit) {
        let Exit { to: room, .. } = exit;
        let graph = self.graph;
        let goals: Vec<usize> =
            self.targets_in(room).filter(|target| target.at.is_none()).map(|target| target.goal).collect();
        if goals.is_empty() && self.wanted != Wanted::Rooms || !graph.is_entered(room) {
            return;
        }
        let Some(p) = self.first_seen(node, exit) else { return };
        let cost = node.cost + node.root.distance(p) * graph.per_m(node.room);
        let changes = self.changes_at(p, node.room, exit);
        let Some(&(last, weight)) = changes.last() else { return };
        if goals.is_empty() && !self.is_news(room, last.door, cost + weight) {
            return;
        }
        let node = self.all_but_the_last(index, (p, cost), &changes).before;
        let found = Found { node, at: p, cost: cost + weight, change: Some(last) };
        self.arrive_in(room, found);
        for goal in goals {
            self.arrive_at(goal, found);
        }
    }

    /// The point of an area nearest to where a node comes from, of those that it sees and that lie off walls of a room.
    fn first_seen(&self, node: &Node, exit: Exit) -> Option<Point> {
        let Exit { door, to: room } = exit;
        let area = self.graph[door].crossing.area()?;
        let own = Self::samples(node).0[0];
        let own = (area.contains(own) && !self.graph.is_on_wall(room, own)).then_some(own);
        let sides = self.graph.sides(door, room);
        let on_sides = sides.filter_map(|side| Some(node.view.of(node.root, side)?.nearest_to(node.root)));
        own.into_iter()
            .chain(on_sides)
            .min_by(|one, two| node.root.distance(*one).total_cmp(&node.root.distance(*two)))
    }

    /// The changes of shape at a point that together lead where one does, each with what they cost up to it; empty where nothing
    /// leads there.
    fn changes_at(&self, p: Point, from: RoomIndex, exit: Exit) -> Vec<(Exit, f64)> {
        if self.graph.is_sequence_cheaper(from, exit.to) {
            self.graph.cheapest_changes(from, exit.to, p).unwrap_or_default()
        } else {
            self.graph.passage(exit.door).map(|weight| (exit, weight)).into_iter().collect()
        }
    }

    /// Makes changes at a point that is reached at some cost, all but the last: the node of that.
    fn all_but_the_last(&mut self, index: u32, (p, cost): (Point, f64), changes: &[(Exit, f64)]) -> Node {
        let mut node = Node { before: index, ..self.nodes[index as usize] };
        for (place, (exit, weight)) in changes.iter().enumerate() {
            if place > 0 {
                self.nodes.push(node);
                node.before = self.nodes.len() as u32 - 1;
            }
            node = Node {
                root: p,
                cost: cost + weight,
                room: exit.to,
                door: exit.door,
                stop: exit.door,
                bent: false,
                view: View::All,
                ..node
            };
        }
        node
    }

    fn is_near_a_goal(&self, gate: &Segment) -> bool {
        let is_near = |goal: &Goal| goal.at.is_none_or(|at| gate.nearest_to(at).distance(at) <= NEAR_M);
        self.wanted == Wanted::Rooms || self.goals.iter().any(is_near)
    }

    fn is_near_a_goal_in(&self, room: RoomIndex, side: &Segment) -> bool {
        let is_near = |at: Point| side.nearest_to(at).distance(at) <= CLOSE_M;
        self.targets_in(room).any(|target| target.at.is_some_and(is_near))
    }
}
