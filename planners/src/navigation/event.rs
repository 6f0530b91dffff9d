//! What happens on a mission, to be written down.

use super::{Settings, State, StateDecision, StateFacts};
use crate::geometry::{Point, Segment};
use crate::local_model::{Estimate, SegmentId};
use crate::pose::Pose;

#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When, by the body's clock, seconds.
    pub time_s: f64,
    /// Where the robot thought that it was.
    pub pose: Pose,
    pub what: Happening,
}

#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Happening {
    /// The judge was asked, and the state changed or something was done.
    State {
        facts: Box<StateFacts>,
        decision: StateDecision,
    },
    /// A whole scan was taken, and the estimated position set.
    SetEstimatedPosition(Estimate),
    /// Segments came into the local model or left it.
    Segments {
        entered: Vec<SegmentId>,
        removed: Vec<SegmentId>,
    },
    /// The skirt touched something.
    Contact {
        /// Radians from the heading, counter-clockwise.
        bearing: f64,
    },
    /// A path to the goal was planned; the first one or another one.
    Planned {
        /// From where the robot is to the goal.
        points: Vec<Point>,
        length_m: f64,
        /// Whether it was found through free space as it is known, the network having none.
        is_off_network: bool,
    },
    Detour {
        /// From where the robot is back to its path.
        points: Vec<Point>,
        length_m: f64,
        /// Metres of the other one; `None` where it is not free.
        other_m: Option<f64>,
    },
    WayClosed {
        at: Point,
        /// The doorway in which that is, by index.
        doorway: Option<usize>,
        /// The region in which that is, by index, where it is in no doorway.
        region: Option<usize>,
        /// Whether what stands there is known: the way is too narrow for where the robot thinks that it is.
        is_known: bool,
        /// What was seen to stand there, and is no part of the building that is known.
        seen: Vec<Segment>,
    },
    /// The judge closes other doorways than before, whatever is seen.
    Forbidden {
        /// All of them, by index.
        doorways: Vec<usize>,
    },
    /// The robot is in another shape, by number.
    Shape(usize),
    /// What was seen of obstacles was forgotten.
    Retried,
    /// It was looked for where the last whole scan may have been taken.
    Located {
        /// All that are possible; the first one is taken.
        poses: Vec<Pose>,
        /// Whether it was looked for over the whole building.
        is_anywhere: bool,
    },
    /// The robot sets out to where known walls tell where it is.
    Sought(Point),
    /// What was met was passed on to everybody, or taken back.
    Told {
        /// So many things were passed on.
        laid: usize,
        /// So many were taken back.
        lifted: usize,
    },
    /// Others changed what ways there are.
    Heard {
        /// Whether the best way is another one than the robot was on.
        is_other: bool,
    },
    /// The body is not heard any more: why.
    Silent(String),
    /// A goal point on the path was reached.
    Reached(Point),
    Ended(Ending),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Arrived,
    NoWay,
    /// The robot does not know where it is.
    Lost,
    /// The robot is not heard any more.
    Silent,
    /// It took longer than [`Settings::patience_s`].
    OutOfPatience,
}

impl Happening {
    /// The state that follows, where this is a change of state.
    pub fn state(&self) -> Option<State> {
        match self {
            Self::State { facts, decision } if facts.state != decision.state => Some(decision.state),
            _ => None,
        }
    }
}

impl Ending {
    /// Whether a mission has been under way for too long.
    pub(super) fn of_patience(time_s: f64, settings: &Settings) -> Option<Self> {
        (time_s > settings.patience_s).then_some(Self::OutOfPatience)
    }
}
