//! The planner's counts, as a text of JSON in the row of a cell.

use adit_planners::adapt::{Progress, Tally};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
pub(super) struct Figures {
    pub tasks_before_change: u32,
    /// The state of the cell in which the robot's subgoal was reached.
    pub stands_since_revision: Option<u32>,
    #[serde(flatten, with = "Counts")]
    pub tally: Tally,
}

/// The fields of [`Tally`], which knows nothing of JSON.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Tally")]
struct Counts {
    solves: u64,
    failed_solves: u64,
    solve_evaluations: u64,
    reaches: u64,
    reach_evaluations: u64,
    edges_added: u64,
    edges_removed: u64,
    edges_broken: u64,
    refusals: u64,
}

pub(super) fn text(progress: &Progress) -> String {
    let figures = Figures {
        tasks_before_change: progress.tasks_before_change,
        stands_since_revision: progress.vertex.map(|(_, revision)| revision),
        tally: progress.tally,
    };
    serde_json::to_string(&figures).unwrap_or_default()
}
