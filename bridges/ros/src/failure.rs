//! Why there is no plan, with the numbers that Nav2's actions have for it.

use adit_site::{Route, Trouble};

/// What went wrong, as Nav2 tells it apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Unknown,
    InvalidPlanner,
    Tf,
    StartOutside,
    GoalOutside,
    StartOccupied,
    GoalOccupied,
    Timeout,
    NoPath,
    NoGraph,
    NoNodes,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    pub kind: Kind,
    pub words: String,
}

impl Kind {
    /// The code of `ComputePathToPose`.
    pub fn to_pose(self) -> u16 {
        match self {
            Self::Unknown | Self::NoGraph | Self::NoNodes => 200,
            Self::InvalidPlanner => 201,
            Self::Tf => 202,
            Self::StartOutside => 203,
            Self::GoalOutside => 204,
            Self::StartOccupied => 205,
            Self::GoalOccupied => 206,
            Self::Timeout => 207,
            Self::NoPath => 208,
        }
    }

    /// The code of `ComputeRoute` and `ComputeAndTrackRoute`: there an end that no robot can be at is one without a node.
    pub fn of_route(self) -> u16 {
        match self {
            Self::Unknown | Self::InvalidPlanner => 400,
            Self::Tf => 401,
            Self::NoGraph => 402,
            Self::NoNodes
            | Self::StartOutside
            | Self::GoalOutside
            | Self::StartOccupied
            | Self::GoalOccupied => 403,
            Self::Timeout => 404,
            Self::NoPath => 405,
        }
    }
}

impl Failure {
    pub fn new(kind: Kind, words: impl Into<String>) -> Self {
        Self { kind, words: words.into() }
    }

    /// Why the site gives no route.
    pub fn refused(trouble: &Trouble) -> Self {
        let kind = match trouble {
            Trouble::Away(_) => Kind::Unknown,
            Trouble::Refused { code, end, .. } => {
                let is_goal = end.as_deref() == Some("goal");
                match code.as_str() {
                    "route/outside" if is_goal => Kind::GoalOutside,
                    "route/outside" => Kind::StartOutside,
                    "route/solid" if is_goal => Kind::GoalOccupied,
                    "route/solid" => Kind::StartOccupied,
                    "route/unknown-robot" | "route/which-robot" => Kind::InvalidPlanner,
                    "route/unbuilt" => Kind::NoGraph,
                    "service/late" => Kind::Timeout,
                    _ => Kind::Unknown,
                }
            }
        };
        Self::new(kind, trouble.to_string())
    }

    /// Why a route that the site answered does not lead to the goal.
    pub fn no_way(route: &Route) -> Self {
        let kind = match route.nearest.as_ref().map(|nearest| nearest.end.as_str()) {
            Some("start") => Kind::StartOccupied,
            Some("goal") => Kind::GoalOccupied,
            _ => Kind::NoPath,
        };
        Self::new(kind, route.reason.as_deref().unwrap_or("there is no way to the goal"))
    }
}
