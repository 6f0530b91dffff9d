//! What became of a task.

use crate::adapt::robot::Configuration;

#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// The path is free; the robot is at the goal.
    Found,
    /// The goal is no configuration of the robot: beyond a limit, or of another dimension.
    GoalBeyondLimits,
    /// The robot would touch this object at the goal.
    GoalInCollision(String),
    /// The robot touches this object where it is.
    StartInCollision(String),
    /// Solve found no way.
    NotFound,
}

/// Calls and what they cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub solves: u64,
    /// Those of them that found nothing.
    pub failed_solves: u64,
    pub solve_evaluations: u64,
    pub reaches: u64,
    pub reach_evaluations: u64,
    pub edges_added: u64,
    pub edges_removed: u64,
    /// Edges that were removed since they broke.
    pub edges_broken: u64,
    /// Paths that the check before execution refused.
    pub refusals: u64,
}

impl Tally {
    /// What was added since an earlier one.
    #[must_use]
    pub fn since(&self, earlier: &Self) -> Self {
        Self {
            solves: self.solves - earlier.solves,
            failed_solves: self.failed_solves - earlier.failed_solves,
            solve_evaluations: self.solve_evaluations - earlier.solve_evaluations,
            reaches: self.reaches - earlier.reaches,
            reach_evaluations: self.reach_evaluations - earlier.reach_evaluations,
            edges_added: self.edges_added - earlier.edges_added,
            edges_removed: self.edges_removed - earlier.edges_removed,
            edges_broken: self.edges_broken - earlier.edges_broken,
            refusals: self.refusals - earlier.refusals,
        }
    }

    /// The share of all edges so far that broke, 0 to 1.
    pub fn broken_share(&self) -> f64 {
        self.edges_broken as f64 / self.edges_added.max(1) as f64
    }

    /// Evaluations of a call of Solve over those of a call of Reach; 1 before both were called.
    pub fn solve_over_reach(&self) -> f64 {
        if self.solves == 0 || self.reach_evaluations == 0 {
            return 1.0;
        }
        let solve = self.solve_evaluations as f64 / self.solves as f64;
        solve / (self.reach_evaluations as f64 / self.reaches as f64)
    }
}

/// What became of a task, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The number of the task, from 1.
    pub task: u32,
    pub outcome: Outcome,
    /// From where the robot was to the goal, in straight motions; empty where no path was found.
    pub path: Vec<Configuration>,
    /// Its length, by the distance of configurations.
    pub length: f64,
    /// Evaluations of one configuration against one object, all of them.
    pub evaluations: u64,
    pub tally: Tally,
}
