//! What a search need not look at: what costs too much at least, and what is reached at less cost already. None of it changes which
//! ways are found.

use super::super::cone::Segment;
use super::super::cost::hardly_more;
use super::super::parts::{Goal, RoomIndex};
use super::{Node, SLACK, Search, Wanted};
use crate::geometry::Rect;

impl Search<'_> {
    /// What a way may cost before it is pulled tight and still come to cost no more than another one of this cost.
    pub(super) fn slack(cost: f64, saved_by_arcs: f64) -> f64 {
        hardly_more(cost * (1.0 + SLACK) + saved_by_arcs)
    }

    /// Whether a way that costs so much at least need not be looked for.
    pub(super) fn is_too_dear(&mut self, least: f64) -> bool {
        let is_too_dear = least > self.most;
        self.outcome.is_cut |= is_too_dear;
        is_too_dear
    }

    /// Whether what costs so much at least can be left out unseen: it is known that ways were left out, or one was found.
    pub(super) fn is_left_out(&self, least: f64) -> bool {
        least > self.most && (self.outcome.is_cut || !self.found.is_empty())
    }

    /// A lower limit of what remains in a room from what is seen of a segment.
    pub(super) fn remaining(&self, room: RoomIndex, seen: Segment) -> f64 {
        if self.wanted != Wanted::One || self.least_per_m <= 0.0 {
            return 0.0;
        }
        let through = self.through.as_ref().filter(|(before, _)| before.contains(room.index()));
        let to = |goal: &Goal| {
            let Some(at) = goal.at else { return 0.0 };
            let by = through.map_or(0.0, |(_, by)| seen.bounds().gap(by) + by.nearest_to(at).distance(at));
            seen.distance(at).max(by)
        };
        self.goals.iter().map(to).fold(f64::INFINITY, f64::min) * self.least_per_m
    }

    /// Whether each point of a rectangle is reached in a room at less cost than by a change there from a node; `least` is what that
    /// change costs at least.
    pub(super) fn is_vain_about(&self, node: &Node, (room, about): (RoomIndex, &Rect), least: f64) -> bool {
        let (here, there) = (self.graph.per_m(node.room), self.graph.per_m(room));
        let way = about.nearest_to(node.root).distance(node.root);
        let limit = hardly_more(node.cost + way * here + least);
        let known = [&self.reached[room.index()], &self.offered[room.index()]];
        known.into_iter().flatten().any(|&(q, cost)| {
            cost < limit && {
                let dx = (q.x - about.x0).abs().max((q.x - about.x1).abs());
                let dy = (q.y - about.y0).abs().max((q.y - about.y1).abs());
                cost + there * (dx * dx + dy * dy).sqrt() < limit
            }
        })
    }

    /// Whether a change into a room on what a node sees of a segment, which costs so much at least, need not be looked for.
    pub(super) fn is_change_too_dear(
        &self,
        node: &Node,
        (room, seen): (RoomIndex, Segment),
        least: f64,
    ) -> bool {
        if self.most.is_infinite() {
            return false;
        }
        let way = seen.distance(node.root) * self.graph.per_m(node.room);
        self.is_left_out(node.cost + way + least + self.remaining(room, seen))
    }
}
