//! What a planner is set to.

/// The order in which the vertices are tried from which a goal may be reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heuristic {
    /// By distance to the goal (the paper's h1).
    #[default]
    NearestToGoal,
    /// By the length of the way to the goal through the graph and straight on, so that the first that is reached gives the shortest path.
    ShortestWay,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// From which all numbers of chance come.
    pub seed: u64,
    /// How a goal looks for its vertex.
    pub heuristic: Heuristic,
    /// Vertices that are tried in the order of the heuristic; `usize::MAX` tries all, as the paper does.
    pub tries: usize,
    /// The bound of the size of a chain of subgoals; a solution that needs a longer one counts as none.
    pub max_chain: usize,
    /// How finely a solution is cut to be abstracted, by the distance of configurations.
    pub chain_step: f64,
    /// Whether corners are cut (section 2.6).
    pub cuts_corners: bool,
    /// Whether paths are tightened between their corners, too.
    pub tightens: bool,
    /// Whether a goal that was reached without Solve becomes a vertex, too.
    pub keeps_goals: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            heuristic: Heuristic::NearestToGoal,
            tries: usize::MAX,
            max_chain: 64,
            chain_step: 0.1,
            cuts_corners: true,
            tightens: true,
            keeps_goals: true,
        }
    }
}
