//! What a search need not look at: what costs too much at least, and what is reached at less cost already. None of it changes which
//! ways are found.

use super::super::cone::Segment;
use super::super::cost::hardly_more;
use super::super::parts::{Goal, RoomIndex};
use super::{FEW, Node, SLACK, Search, View, Wanted};
use crate::geometry::Rect;

impl Search<'_> {
    /// What a way may cost before it is pulled tight and still come to cost no more than another one of this cost.
    pub(super) fn slack(cost: f64, saved_by_arcs: f64) -> f64 {
        hardly_more(cost * (1.0 + SLACK) + saved_by_arcs)
    }

    /// Whether what is known of where goals lie decides what is looked at first.
    pub(super) fn is_led(&self) -> bool {
        let is_wanted = match self.wanted {
            Wanted::One => true,
            Wanted::Goals => self.goals.len() <= FEW,
            Wanted::Rooms => false,
        };
        is_wanted && self.least_per_m > 0.0
    }

    /// What a way by a node costs at least; `None` where that is too much for each goal.
    pub(super) fn least_by(&self, node: &Node) -> Option<f64> {
        let seen = match &node.view {
            View::Through(gap) => gap.segment(),
            _ => Segment::new(node.root, node.root),
        };
        let cost = node.cost + seen.distance(node.root) * self.graph.per_m(node.room);
        self.least_from(cost, (node.room, seen))
    }

    /// What a way costs at least that has come to a segment in a room at some cost; `None` where that is too much for each goal.
    fn least_from(&self, cost: f64, (room, seen): (RoomIndex, Segment)) -> Option<f64> {
        if !self.is_led() {
            return (cost <= self.most).then_some(cost);
        }
        let through = self.through.as_ref().filter(|(before, _)| before.contains(room.index()));
        let by = |(goal, most): (&Goal, &f64)| {
            let remaining = goal.at.map_or(0.0, |at| {
                let by =
                    through.map_or(0.0, |(_, by)| seen.bounds().gap(by) + by.nearest_to(at).distance(at));
                seen.distance(at).max(by)
            });
            let least = cost + remaining * self.least_per_m;
            (least <= most.min(self.most)).then_some(least)
        };
        self.goals.iter().zip(&self.most_to).filter_map(by).min_by(f64::total_cmp)
    }

    /// Whether a way that has come to a segment in a room at some cost can be left out unseen: it is known that ways were left
    /// out, or one was found.
    pub(super) fn is_left_out(&self, cost: f64, at: (RoomIndex, Segment)) -> bool {
        (self.outcome.is_cut || !self.found.is_empty()) && self.least_from(cost, at).is_none()
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
        let way = seen.distance(node.root) * self.graph.per_m(node.room);
        self.is_left_out(node.cost + way + least, (room, seen))
    }
}
