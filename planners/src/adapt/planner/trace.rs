//! T: on-demand verification and repair (Chen 1994, section 2.4).

use super::Adapt;
use crate::adapt::experience::{Edge, VertexId};
use crate::adapt::judge::{EdgeFacts, Judge, Trust};
use crate::adapt::noted::{Noted, Removal};
use crate::adapt::probe::Probe;
use crate::adapt::robot::{Configuration, length};
use crate::adapt::ways;
use crate::adapt::workcell::Placed;

impl Adapt {
    /// A sequence of vertices from one to another whose edges hold. Edges that do not are removed (step 1); where no sequence
    /// is left, Solve connects the two anew (step 2); where it cannot, all that hangs on the second is removed (step 3).
    pub(super) fn trace(
        &mut self,
        from: VertexId,
        to: VertexId,
        judge: &mut dyn Judge,
    ) -> Option<Vec<VertexId>> {
        loop {
            while let Some(sequence) = ways::sequence(&self.experience, from, to) {
                if sequence.windows(2).all(|pair| self.holds(pair[0], pair[1], judge)) {
                    return Some(sequence);
                }
            }
            let (start, end) = (self.at(from), self.at(to));
            let chain = self.solved(&start, &end);
            if let Some(chain) = chain {
                self.augment(from, chain, Some(to), judge);
            } else {
                self.remove_component(to);
                return None;
            }
        }
    }

    /// Whether an edge holds; one that does not is removed.
    pub(super) fn holds(&mut self, from: VertexId, to: VertexId, judge: &mut dyn Judge) -> bool {
        let Some(edge) = self.experience.edge(from, to) else { return false };
        if self.is_verified(edge) {
            return true;
        }
        match judge.trust(&self.facts(edge)) {
            Trust::AsItIs => true,
            Trust::Verify => self.verify(from, to),
            Trust::GiveUp => {
                self.remove_edge(from, to, Removal::GivenUp, None);
                false
            }
        }
    }

    /// Whether an edge was verified against all objects as they are now.
    pub(super) fn is_verified(&self, edge: &Edge) -> bool {
        let is_since = |placed: &Placed| placed.since <= edge.verified_revision;
        let is_latest = edge.verified_revision >= self.cell.revision();
        !edge.is_loose && (is_latest || self.cell.placed().iter().all(is_since))
    }

    fn facts(&self, edge: &Edge) -> EdgeFacts {
        let is_unverified = |placed: &&Placed| edge.is_loose || placed.since > edge.verified_revision;
        EdgeFacts {
            age_tasks: self.progress.tasks.saturating_sub(edge.verified_task),
            age_changes: self.cell.revision().saturating_sub(edge.verified_revision),
            times_verified: edge.times_verified,
            unverified_objects: self.cell.placed().iter().filter(is_unverified).count() as u32,
            broken_edges: self.progress.tally.broken_share(),
            length: edge.length,
        }
    }

    /// Whether Reach can follow an edge, along the path that it had or along another one; if not, the edge is removed.
    pub(super) fn verify(&mut self, from: VertexId, to: VertexId) -> bool {
        let Some(known) = self.experience.path(from, to) else { return false };
        let path = self.follow(known);
        let now = self.now();
        let Some(path) = path else {
            self.remove_edge(from, to, Removal::Broken, self.cell.last_touched().map(str::to_owned));
            return false;
        };
        if let Some(edge) = self.experience.edge_mut(from, to) {
            let mut via = path;
            edge.length = length(&via);
            if edge.ends.0 != from {
                via.reverse();
            }
            let via = via[1..via.len() - 1].to_vec();
            if edge.via != via {
                edge.via = via;
                self.checked.remove(&edge.id);
            }
            (edge.verified_task, edge.verified_revision) = now;
            edge.times_verified += 1;
            edge.is_loose = false;
            self.noted.push(Noted::EdgeVerified(edge.clone()));
        }
        true
    }

    /// The path itself where it is free, else what Reach finds between its ends.
    fn follow(&mut self, known: Vec<Configuration>) -> Option<Vec<Configuration>> {
        if known.len() > 2 {
            let before = self.cell.evaluations();
            let mut probe = Probe::new(&mut self.cell);
            let is_free = known.windows(2).all(|motion| probe.is_motion_free(&motion[0], &motion[1]));
            self.progress.tally.reach_evaluations += self.cell.evaluations() - before;
            if is_free {
                self.progress.tally.reaches += 1;
                return Some(known);
            }
        }
        self.reach(&known[0], &known[known.len() - 1])
    }

    fn remove_component(&mut self, of: VertexId) {
        for id in ways::component(&self.experience, of) {
            self.remove_vertex(id, Removal::CutOff);
        }
    }
}
