//! Adding to the experience graph, and taking from it; all of it is noted.

use super::Adapt;
use crate::adapt::experience::{TagPoint, VertexId, ends};
use crate::adapt::judge::{Judge, LandmarkFacts};
use crate::adapt::noted::{Noted, Removal};
use crate::adapt::robot::Configuration;

impl Adapt {
    /// Adds a subgoal, attached to the object that the judge chooses.
    pub(super) fn add_vertex(&mut self, at: Configuration, is_goal: bool, judge: &mut dyn Judge) -> VertexId {
        let tag = self.tag(&at, is_goal, judge);
        let vertex = self.experience.add_vertex(at, tag, self.progress.tasks).clone();
        let id = vertex.id;
        self.noted.push(Noted::VertexAdded(vertex));
        id
    }

    fn tag(&self, at: &[f64], is_goal: bool, judge: &mut dyn Judge) -> Option<TagPoint> {
        let robot = self.cell.robot();
        let (tool, branch, links) = (robot.tool(at), robot.branch(at), robot.links(at));
        let mut best: Option<(f64, TagPoint)> = None;
        for placed in self.cell.placed() {
            let name = placed.object.name.as_str();
            let facts = LandmarkFacts {
                object: name,
                distance_m: placed.object.pose.at.distance(tool.at),
                is_movable: placed.object.is_movable,
                times_moved: placed.times_moved,
                is_goal,
                placed,
                links: &links,
                experience: &self.experience,
            };
            let Some(value) = judge.landmark(&facts) else { continue };
            if best.as_ref().is_none_or(|(least, _)| value < *least) {
                let tag = TagPoint { object: name.to_owned(), tool: placed.object.pose.to(&tool), branch };
                best = Some((value, tag));
            }
        }
        best.map(|(_, tag)| tag)
    }

    /// Adds a chain of subgoals from a vertex to a last one: to `end` where that is told, else to a new vertex, the goal. Gives
    /// the last one.
    pub(super) fn augment(
        &mut self,
        from: VertexId,
        chain: Vec<Vec<Configuration>>,
        end: Option<VertexId>,
        judge: &mut dyn Judge,
    ) -> VertexId {
        let mut here = from;
        let count = chain.len();
        for (index, reached) in chain.into_iter().enumerate() {
            let is_last = index + 1 == count;
            let at = reached.last().cloned().unwrap_or_default();
            let next = match end {
                Some(end) if is_last => end,
                _ => self.add_vertex(at, is_last, judge),
            };
            self.add_edge(here, next, reached);
            here = next;
        }
        here
    }

    pub(super) fn add_edge(&mut self, from: VertexId, to: VertexId, reached: Vec<Configuration>) {
        let now = self.now();
        let edge = self.experience.add_edge(from, to, reached, now).clone();
        self.progress.tally.edges_added += 1;
        self.progress.refused.remove(&ends(from, to));
        self.noted.push(Noted::EdgeAdded(edge));
    }

    pub(super) fn remove_edge(&mut self, a: VertexId, b: VertexId, why: Removal, object: Option<String>) {
        let Some(edge) = self.experience.remove_edge(a, b) else { return };
        self.checked.remove(&edge.id);
        let (task, revision) = self.now();
        self.progress.tally.edges_removed += 1;
        self.progress.tally.edges_broken += u64::from(matches!(why, Removal::Broken | Removal::Refused));
        self.noted.push(Noted::EdgeRemoved { id: edge.id, ends: edge.ends, why, task, revision, object });
    }

    /// Takes a vertex out, its edges first.
    pub(super) fn remove_vertex(&mut self, id: VertexId, why: Removal) {
        for (a, b) in self.experience.edges_of(id) {
            let why = if why == Removal::CutOff { why } else { Removal::VertexRemoved };
            self.remove_edge(a, b, why, None);
        }
        if self.experience.remove_vertex(id).is_some() {
            self.progress.refused.retain(|ends| ends.0 != id && ends.1 != id);
            self.progress.tightened.retain(|ends| ends.0 != id && ends.1 != id);
            self.progress.vertex = self.progress.vertex.filter(|(vertex, _)| *vertex != id);
            self.noted.push(Noted::VertexRemoved { id, why, task: self.progress.tasks });
        }
    }
}
