//! The planners R and S (Chen 1994, section 2.2).

use super::{Adapt, Heuristic};
use crate::adapt::experience::VertexId;
use crate::adapt::judge::Judge;
use crate::adapt::probe::Probe;
use crate::adapt::robot::{Configuration, distance};
use crate::adapt::ways;
use crate::random::Random;

impl Adapt {
    /// The vertices in the order in which a goal tries them; `from` is the vertex where the robot is.
    fn in_order(&self, goal: &[f64], from: Option<VertexId>) -> Vec<VertexId> {
        let by_distance = self.experience.by_distance(goal);
        match (self.settings.heuristic, from) {
            (Heuristic::ShortestWay, Some(from)) => {
                let lengths = ways::lengths(&self.experience, from);
                let way = |id: &VertexId| {
                    lengths.get(id).map_or(f64::INFINITY, |length| length + distance(&self.at(*id), goal))
                };
                let mut by_way: Vec<(f64, VertexId)> =
                    by_distance.into_iter().map(|id| (way(&id), id)).collect();
                // A stable sort: those that do not hang together with the robot stay in order of their distance.
                by_way.sort_by(|a, b| a.0.total_cmp(&b.0));
                by_way.into_iter().map(|(_, id)| id).collect()
            }
            _ => by_distance,
        }
    }

    /// R: the first vertex in order from which Reach gets to the goal, and how.
    pub(super) fn reachable(
        &mut self,
        goal: &[f64],
        from: Option<VertexId>,
    ) -> Option<(VertexId, Vec<Configuration>)> {
        let order = self.in_order(goal, from);
        order.into_iter().take(self.settings.tries).find_map(|id| {
            let at = self.at(id);
            if at == goal {
                return Some((id, vec![at]));
            }
            self.reach(&at, goal).map(|path| (id, path))
        })
    }

    /// S: Solve from the best vertex in order to the goal, abstracted and added to the graph; the vertex of the goal.
    pub(super) fn solve_to(
        &mut self,
        goal: &[f64],
        from: Option<VertexId>,
        judge: &mut dyn Judge,
    ) -> Option<VertexId> {
        let order = self.in_order(goal, from);
        let best = order.into_iter().find(|id| {
            let at = self.at(*id);
            Probe::new(&mut self.cell).is_free(&at)
        });
        // The best vertex may be cut off from the goal, and from the robot; then it is tried from the robot.
        let tried = [best, from.filter(|from| best != Some(*from))];
        tried.into_iter().flatten().find_map(|id| {
            let start = self.at(id);
            let chain = self.solved(&start, goal)?;
            Some(self.augment(id, chain, None, judge))
        })
    }

    /// Calls Solve, counts it, and abstracts what it found.
    pub(super) fn solved(&mut self, from: &[f64], to: &[f64]) -> Option<Vec<Vec<Configuration>>> {
        let before = self.cell.evaluations();
        let tally = &mut self.progress.tally;
        let mut random = Random::new(self.settings.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ tally.solves);
        tally.solves += 1;
        let path = self.plugins.solve.solve(&mut Probe::new(&mut self.cell), from, to, &mut random);
        self.progress.tally.solve_evaluations += self.cell.evaluations() - before;
        self.progress.tally.failed_solves += u64::from(path.is_none());
        self.abstracted(&path?)
    }
}
