//! What becomes of experience after a change (Chen 1994, section 2.5).

use super::Adapt;
use crate::adapt::experience::{Experience, VertexId};
use crate::adapt::judge::{Judge, Strategy};
use crate::adapt::noted::{Noted, Removal};
use crate::adapt::ways;

impl Adapt {
    pub(super) fn repair(&mut self, strategy: Strategy, judge: &mut dyn Judge) {
        match strategy {
            Strategy::Forget => self.forget(),
            Strategy::VerifyAll => self.keep_home(judge),
            Strategy::RepairAll => self.repair_all(judge),
            Strategy::OnDemand => {}
        }
    }

    /// A0. What evaluations taught is experience, too.
    fn forget(&mut self) {
        let next = self.experience.next_numbers();
        self.experience = Experience::from_rows(Vec::new(), Vec::new(), next).unwrap_or_default();
        self.checked.clear();
        self.cell.forget_clearances();
        self.progress.refused.clear();
        self.progress.tightened.clear();
        self.noted.push(Noted::Forgotten);
        self.begin_at_here();
    }

    /// A1: verifies all edges, and keeps the component of the vertex where the robot is.
    fn keep_home(&mut self, judge: &mut dyn Judge) {
        let edges: Vec<(VertexId, VertexId)> = self.experience.edges().map(|edge| edge.ends).collect();
        for (a, b) in edges {
            let is_verified = self.experience.edge(a, b).is_some_and(|edge| self.is_verified(edge));
            if !is_verified {
                self.verify(a, b);
            }
        }
        let here = self.progress.here.clone();
        let (home, _) = self.stand_in(&here, judge);
        self.stand(here, Some(home));
        let kept = ways::component(&self.experience, home);
        let all: Vec<VertexId> = self.experience.vertices().map(|vertex| vertex.id).collect();
        for id in all {
            if !kept.contains(&id) {
                self.remove_vertex(id, Removal::CutOff);
            }
        }
    }

    /// A2: applies T from the vertex where the robot is to every other one.
    fn repair_all(&mut self, judge: &mut dyn Judge) {
        let here = self.progress.here.clone();
        let (home, _) = self.stand_in(&here, judge);
        self.stand(here, Some(home));
        let all: Vec<VertexId> = self.experience.vertices().map(|vertex| vertex.id).collect();
        for id in all {
            if self.experience.vertex(id).is_some() {
                let _ = self.trace(home, id, judge);
            }
        }
    }
}
