//! What a planner is set to.

use crate::figures::settings;

/// The order in which the vertices are tried from which a goal may be reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heuristic {
    /// By distance to the goal (the paper's h1).
    #[default]
    NearestToGoal,
    /// By the length of the way to the goal through the graph and straight on, so that the first that is reached gives the shortest path.
    ShortestWay,
}

settings! {
    #[derive(Clone, Debug, PartialEq)]
    pub struct Settings {
        others {
            /// From which all numbers of chance come.
            seed: u64 = 1;
            /// How a goal looks for its vertex.
            heuristic: Heuristic = Heuristic::NearestToGoal;
            /// Vertices that are tried in the order of the heuristic; `usize::MAX` tries all, as the paper does.
            tries: usize = usize::MAX;
        }
        figures {
            max_chain: usize = 64, "max_chain", "", Count, "The bound of the size of a chain of subgoals: a solution that needs a longer one counts as none.";
            chain_step: f64 = 0.1, "chain_step", "", Grain, "How finely a solution is cut to be abstracted, by the distance of configurations.";
            most_refusals: u32 = 8, "most_refusals", "", Count, "After so many paths that were refused a task is given up.";
            cuts_corners: bool = true, "cuts_corners", "yes or no", YesOrNo, "Whether corners are cut (section 2.6).";
            tightens: bool = true, "tightens", "yes or no", YesOrNo, "Whether paths are tightened between their corners, too.";
            keeps_goals: bool = true, "keeps_goals", "yes or no", YesOrNo, "Whether a goal that was reached without Solve becomes a subgoal, too.";
        }
    }
}
