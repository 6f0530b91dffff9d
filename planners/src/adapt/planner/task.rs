//! A task: from where the robot is to a goal (Chen 1994, Figure 1).

use std::sync::Arc;

use super::{Adapt, Outcome, Report};
use crate::adapt::execution::{Outline, Outlines, hit_of};
use crate::adapt::experience::VertexId;
use crate::adapt::judge::Judge;
use crate::adapt::noted::Removal;
use crate::adapt::probe::Probe;
use crate::adapt::robot::{Configuration, length};
use crate::adapt::workcell::{Placed, Revision};

/// A part of a path, and the edge that it follows, if it follows one.
struct Part {
    path: Vec<Configuration>,
    edge: Option<(VertexId, VertexId)>,
}

impl Adapt {
    /// Plans a path from where the robot is to a goal, checks it, and takes the robot there.
    ///
    /// Where T finds no way to the vertex that reaches the goal, what hangs on that vertex is gone, and other vertices are tried.
    pub fn task(&mut self, goal: &[f64], judge: &mut dyn Judge) -> Report {
        let (tally, evaluations) = (self.progress.tally, self.cell.evaluations());
        self.progress.tasks += 1;
        let (outcome, path) = match self.path_to(goal, judge) {
            Ok(path) => (Outcome::Found, path),
            Err(no) => (no, Vec::new()),
        };
        Report {
            task: self.progress.tasks,
            outcome,
            length: length(&path),
            path,
            evaluations: self.cell.evaluations() - evaluations,
            tally: self.progress.tally.since(&tally),
        }
    }

    fn path_to(&mut self, goal: &[f64], judge: &mut dyn Judge) -> Result<Vec<Configuration>, Outcome> {
        if !self.cell.robot().admits(goal) {
            return Err(Outcome::GoalBeyondLimits);
        }
        let here = self.progress.here.clone();
        if let Some(object) = self.touched(&here) {
            return Err(Outcome::StartInCollision(object));
        }
        if let Some(object) = self.touched(goal) {
            return Err(Outcome::GoalInCollision(object));
        }
        let refusals = self.progress.tally.refusals;
        while self.progress.tally.refusals < refusals + u64::from(self.settings.most_refusals) {
            let (from, out) = self.stand_in(&here, judge);
            let (to, home) = self.goal_vertex(goal, from, judge).ok_or(Outcome::NotFound)?;
            let Some(mut sequence) = self.trace(from, to, judge) else { continue };
            if self.settings.cuts_corners {
                sequence = self.cut_corners(&sequence);
            }
            if self.settings.tightens {
                sequence = self.tighten(&sequence, judge);
            }
            // The ends of edges need no part of their own.
            let is_part = |path: &Vec<Configuration>| path.len() > 1 || sequence.len() < 2;
            let free = |path| Some(path).filter(is_part).map(|path| Part { path, edge: None });
            let mut parts: Vec<Part> = free(out).into_iter().collect();
            for pair in sequence.windows(2) {
                let path = self.experience.path(pair[0], pair[1]).unwrap_or_default();
                parts.push(Part { path, edge: Some((pair[0], pair[1])) });
            }
            parts.extend(free(home));
            if self.is_executable(&parts) {
                self.stand(goal.to_vec(), Some(to));
                return Ok(joined(parts));
            }
        }
        Err(Outcome::NotFound)
    }

    /// Whether the robot touches nothing at a configuration.
    pub fn is_free(&mut self, at: &[f64]) -> bool {
        self.touched(at).is_none()
    }

    /// The name of an object that the robot touches at a configuration.
    fn touched(&mut self, at: &[f64]) -> Option<String> {
        let is_free = Probe::new(&mut self.cell).is_free(at);
        if is_free { None } else { self.cell.last_touched().map(str::to_owned) }
    }

    /// The vertex that stands for the robot, and the path of Reach to it; a new one where none is reached.
    pub(super) fn stand_in(&mut self, here: &[f64], judge: &mut dyn Judge) -> (VertexId, Vec<Configuration>) {
        let known = self.progress.vertex.map(|(id, _)| id);
        if let Some(id) = known {
            let at = self.at(id);
            if at == here {
                return (id, vec![at]);
            }
            if let Some(path) = self.reach(here, &at) {
                return (id, path);
            }
        }
        if let Some((id, mut path)) = self.reachable(here, None) {
            path.reverse();
            return (id, path);
        }
        (self.add_vertex(here.to_vec(), false, judge), vec![here.to_vec()])
    }

    /// The vertex from which the goal is reached, and the path of Reach from there; by R, else by S.
    fn goal_vertex(
        &mut self,
        goal: &[f64],
        from: VertexId,
        judge: &mut dyn Judge,
    ) -> Option<(VertexId, Vec<Configuration>)> {
        let Some((id, path)) = self.reachable(goal, Some(from)) else {
            return self.solve_to(goal, Some(from), judge).map(|id| (id, vec![goal.to_vec()]));
        };
        if self.settings.keeps_goals && self.at(id) != goal {
            let vertex = self.add_vertex(goal.to_vec(), true, judge);
            self.add_edge(id, vertex, path);
            return Some((vertex, vec![goal.to_vec()]));
        }
        Some((id, path))
    }

    /// The check before execution. What it refuses is known to be broken from then on; an edge that passed it is looked at
    /// again only against objects that changed since.
    fn is_executable(&mut self, parts: &[Part]) -> bool {
        for part in parts {
            let edge = part.edge.and_then(|(a, b)| self.experience.edge(a, b)).map(|edge| edge.id);
            let checked = edge.and_then(|id| self.checked.get(&id).copied());
            if checked == Some(self.cell.revision()) {
                continue;
            }
            let outlines = self.outlines();
            let is_new = |(since, _): &&(Revision, Outline)| checked.is_none_or(|revision| *since > revision);
            let new = outlines.iter().filter(is_new).map(|(_, outline)| outline);
            let Some(hit) = hit_of(self.cell.robot().as_ref(), new, &part.path) else {
                self.checked.extend(edge.map(|id| (id, self.cell.revision())));
                continue;
            };
            self.progress.tally.refusals += 1;
            match part.edge {
                Some((a, b)) => self.remove_edge(a, b, Removal::Refused, Some(hit.object)),
                None => self.progress.vertex = None,
            }
            return false;
        }
        true
    }

    /// The outlines of the objects as they are now.
    fn outlines(&mut self) -> Outlines {
        let now = self.cell.revision();
        if let Some((of, outlines)) = &self.outlines
            && *of == now
        {
            return Arc::clone(outlines);
        }
        let ready = |placed: &Placed| (placed.since, Outline::of(&placed.object));
        let outlines: Outlines = self.cell.placed().iter().map(ready).collect();
        self.outlines = Some((now, Arc::clone(&outlines)));
        outlines
    }
}

fn joined(parts: Vec<Part>) -> Vec<Configuration> {
    let mut path: Vec<Configuration> = parts.into_iter().flat_map(|part| part.path).collect();
    path.dedup();
    path
}
