//! The planner's counts, as a text of JSON in the row of a cell.

use adit_planners::adapt::{Progress, Tally};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct Figures {
    tasks_before_change: u32,
    stands_since_revision: Option<u32>,
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

/// The counts of a planner.
pub(super) fn text(progress: &Progress) -> String {
    let tally = &progress.tally;
    let figures = Figures {
        tasks_before_change: progress.tasks_before_change,
        stands_since_revision: progress.vertex.map(|(_, revision)| revision),
        solves: tally.solves,
        failed_solves: tally.failed_solves,
        solve_evaluations: tally.solve_evaluations,
        reaches: tally.reaches,
        reach_evaluations: tally.reach_evaluations,
        edges_added: tally.edges_added,
        edges_removed: tally.edges_removed,
        edges_broken: tally.edges_broken,
        refusals: tally.refusals,
    };
    serde_json::to_string(&figures).unwrap_or_default()
}

/// Tasks before the last change, the state of the cell in which the robot's subgoal was reached, and the counts; `None`
/// where the text says something else.
pub(super) fn read(text: &str) -> Option<(u32, Option<u32>, Tally)> {
    let figures: Figures = serde_json::from_str(text).ok()?;
    let tally = Tally {
        solves: figures.solves,
        failed_solves: figures.failed_solves,
        solve_evaluations: figures.solve_evaluations,
        reaches: figures.reaches,
        reach_evaluations: figures.reach_evaluations,
        edges_added: figures.edges_added,
        edges_removed: figures.edges_removed,
        edges_broken: figures.edges_broken,
        refusals: figures.refusals,
    };
    Some((figures.tasks_before_change, figures.stands_since_revision, tally))
}
