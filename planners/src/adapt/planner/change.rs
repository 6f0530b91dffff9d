//! The cell changed: what moved goes along, and the judge says what becomes of the rest.

use super::Adapt;
use crate::adapt::experience::VertexId;
use crate::adapt::judge::{ChangeFacts, Judge, Strategy};
use crate::adapt::noted::{Noted, ObjectChange, Removal};
use crate::adapt::object::Object;
use crate::adapt::workcell::{Placed, WorkcellError, check};
use crate::geometry::tolerance::ROUNDING;
use crate::pose::wrapped;

#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    pub facts: ChangeFacts,
    pub strategy: Strategy,
    /// Evaluations that the repair took at once.
    pub evaluations: u64,
    pub solves: u64,
}

impl Adapt {
    /// Takes in the objects as they are now, known by their names; `None` where nothing changed.
    ///
    /// Subgoals go along with their objects; those that cannot are dropped, and so are those whose object went. Then the
    /// judge chooses what becomes of the experience.
    pub fn change(
        &mut self,
        objects: Vec<Object>,
        judge: &mut dyn Judge,
    ) -> Result<Option<Changed>, WorkcellError> {
        check(&objects)?;
        let (solves, evaluations) = (self.progress.tally.solves, self.cell.evaluations());
        let mut facts = ChangeFacts::default();
        let revision = self.cell.revision + 1;
        let before = std::mem::take(&mut self.cell.placed);
        let mut changes: Vec<(String, ObjectChange)> = Vec::new();
        for gone in before.iter().filter(|old| objects.iter().all(|new| new.name != old.object.name)) {
            facts.gone += 1;
            changes.push((gone.object.name.clone(), ObjectChange::Gone));
        }
        for object in objects {
            let old = before.iter().find(|old| old.object.name == object.name);
            let (placed, how) = replaced(old, object, revision, &mut facts);
            changes.extend(how.map(|how| (placed.object.name.clone(), how)));
            self.cell.placed.push(placed);
        }
        if changes.is_empty() {
            return Ok(None);
        }
        self.cell.revision = revision;
        self.progress.refused.clear();
        self.progress.tightened.clear();
        for (object, how) in changes {
            if matches!(how, ObjectChange::Gone | ObjectChange::Reshaped) {
                self.noted.push(Noted::ClearancesForgotten { object: object.clone() });
            }
            self.noted.push(Noted::ObjectChanged { object: object.clone(), how, revision });
            self.take_along(&object, how, &mut facts);
        }
        self.weigh(&mut facts);
        self.progress.tasks_before_change = self.progress.tasks;
        let strategy = judge.strategy(&facts);
        self.noted.push(Noted::StrategyChosen { facts: Box::new(facts), strategy });
        self.repair(strategy, judge);
        Ok(Some(Changed {
            facts,
            strategy,
            evaluations: self.cell.evaluations() - evaluations,
            solves: self.progress.tally.solves - solves,
        }))
    }

    /// Moves the subgoals of an object along with it, or drops them.
    fn take_along(&mut self, object: &str, how: ObjectChange, facts: &mut ChangeFacts) {
        let hung = self.experience.vertices().filter(|v| v.tag.as_ref().is_some_and(|t| t.object == object));
        let hung: Vec<VertexId> = hung.map(|vertex| vertex.id).collect();
        for id in hung {
            if how == ObjectChange::Gone {
                facts.vertices_dropped += 1;
                self.remove_vertex(id, Removal::LandmarkGone);
            } else if self.take_vertex_along(id) {
                facts.vertices_moved += 1;
            } else {
                facts.vertices_dropped += 1;
                self.remove_vertex(id, Removal::OutOfReach);
            }
        }
    }

    /// Whether the robot can still bring its tool to a tag-point.
    fn take_vertex_along(&mut self, id: VertexId) -> bool {
        let Some(vertex) = self.experience.vertex(id) else { return false };
        let Some(tag) = &vertex.tag else { return true };
        let Some(placed) = self.cell.placed.iter().find(|placed| placed.object.name == tag.object) else {
            return false;
        };
        let robot = self.cell.robot();
        let tool = placed.object.pose.then(&tag.tool);
        let Some(at) = robot.inverse(&tool, tag.branch, &vertex.at) else { return false };
        if crate::adapt::distance(&at, &vertex.at) <= ROUNDING {
            return true;
        }
        self.experience.move_vertex(id, at.clone());
        self.noted.push(Noted::VertexMoved { id, at });
        for (a, b) in self.experience.edges_of(id) {
            let (start, end) = (self.at(a), self.at(b));
            if let Some(edge) = self.experience.edge_mut(a, b) {
                edge.loosen(crate::adapt::distance(&start, &end));
                self.checked.remove(&edge.id);
                self.noted.push(Noted::EdgeLoosened(edge.clone()));
            }
        }
        true
    }

    fn weigh(&self, facts: &mut ChangeFacts) {
        let tally = &self.progress.tally;
        let vertices = self.experience.vertices().count();
        let is_unsure = |at: &[f64]| {
            let links = self.cell.links(at);
            self.cell.placed.iter().any(|placed| placed.slack(&links, 0.0) < 0.0)
        };
        let unsure = self.experience.vertices().filter(|vertex| is_unsure(&vertex.at)).count();
        facts.objects = self.cell.placed.len() as u32;
        facts.tasks = self.progress.tasks - self.progress.tasks_before_change;
        facts.vertices = vertices as u32;
        facts.unsure_vertices = unsure as f64 / vertices.max(1) as f64;
        facts.edges = self.experience.edges().count() as u32;
        facts.broken_edges = tally.broken_share();
        facts.solve_over_reach = tally.solve_over_reach();
    }
}

/// An object as it is now, with what is still known of it, and how it changed.
fn replaced(
    old: Option<&Placed>,
    object: Object,
    revision: u32,
    facts: &mut ChangeFacts,
) -> (Placed, Option<ObjectChange>) {
    let Some(old) = old else {
        facts.appeared += 1;
        return (Placed::new(object, revision), Some(ObjectChange::Appeared));
    };
    let has_moved = old.object.pose != object.pose;
    if has_moved {
        let (was, is) = (&old.object.pose, &object.pose);
        facts.moved_m = facts.moved_m.max(was.at.distance(is.at));
        facts.turned = facts.turned.max(wrapped(was.heading - is.heading).abs());
    }
    let times_moved = old.times_moved + u32::from(has_moved);
    if old.object.shape != object.shape {
        facts.reshaped += 1;
        let placed = Placed { times_moved, ..Placed::new(object, revision) };
        return (placed, Some(ObjectChange::Reshaped));
    }
    facts.moved += u32::from(has_moved);
    let since = if has_moved { revision } else { old.since };
    let placed = Placed { known: old.known.clone(), times_moved, ..Placed::new(object, since) };
    (placed, has_moved.then_some(ObjectChange::Moved))
}
