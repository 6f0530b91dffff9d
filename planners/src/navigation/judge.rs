//! What is asked from outside, and what is answered: the navigator itself decides nothing.

use super::Settings;
use crate::floor_plan::Way;
use crate::local_model::{SegmentFacts, Transition};

/// Who drives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The user does: commands are passed through, and the position is kept.
    #[default]
    Manual,
    /// The navigator does, to a goal in a known building.
    Automatic,
    /// The navigator does, a little way through a building that is being learned.
    Learn,
    /// The navigator does, along a way that somebody else finds, and finds anew.
    Route,
}

/// States of straight-line movement (Crowley 1985, Figure 5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// There is no goal point.
    #[default]
    Hold,
    /// What is to be done next is found out.
    Decide,
    /// The robot turns towards its goal point.
    Turn,
    /// It goes straight towards it.
    Move,
    /// It stands until a whole scan is taken.
    Wait,
    Blocked,
}

/// What is done on the way to the next state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Action {
    #[default]
    None,
    /// To withdraw from what was touched.
    BackOff,
    /// To take the detour on the left.
    Left,
    /// To take the detour on the right.
    Right,
    /// To report the way closed, and to look for another one over the whole building.
    Close,
    /// To forget what was seen of obstacles, and to begin anew from here.
    Retry,
    /// To find out where within what the estimate allows the last whole scan was taken.
    Match,
    /// To find that out over the whole building, whatever the estimate is.
    Search,
    /// To go first where known walls tell where the robot is.
    Seek,
    /// To go on to the goal after that.
    Resume,
    NoWay,
    /// To give up, not knowing where the robot is.
    Lost,
}

/// What the next state depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own, for rules to ask")]
pub struct StateFacts {
    pub mode: Mode,
    pub state: State,
    pub has_goal: bool,
    /// Metres to the goal point; 0 without one.
    pub distance_m: f64,
    /// Whether the distance has not grown since the robot went off.
    pub is_falling: bool,
    /// By how much the robot looks past its goal point, radians from 0 to PI.
    pub heading_error: f64,
    /// Metres beside the line to the goal point.
    pub off_line_m: f64,
    /// Metres that are free ahead in the local model, on the way to the goal point; no more than the distance.
    pub free_m: f64,
    /// Metres that are free ahead by raw readings since the last update of the model; no more than the distance.
    pub echo_m: f64,
    /// Whether what is in the way is moving.
    pub is_obstacle_moving: bool,
    /// Whether the skirt touched something since the robot last withdrew.
    pub is_contact: bool,
    /// How often it withdrew since it last waited.
    pub back_offs: u32,
    pub is_busy: bool,
    /// Whether the robot has to be in another shape before it goes on.
    pub is_changing: bool,
    /// Whether there is room for that shape beside what was met.
    pub has_room: bool,
    /// Whether a whole scan was taken since the robot stands here.
    pub is_scan_complete: bool,
    /// Whole scans since the goal was given, or everything was forgotten.
    pub scans: u32,
    /// Metres of the detour on the left of the obstacle; `None` where none is free. Known in Blocked, after a scan.
    pub left_m: Option<f64>,
    /// The same on the right.
    pub right_m: Option<f64>,
    /// How many detours were taken from this spot.
    pub detours_here: u32,
    /// How many ways were reported closed at this spot.
    pub closed_here: u32,
    /// How often it waited at this spot.
    pub waits: u32,
    pub has_way: bool,
    /// Whether there was no way when nothing that was met stood in it: by what is known of the building, and by what the judge
    /// closes.
    pub is_shut: bool,
    /// How often everything was begun anew.
    pub retries: u32,
    /// Standard deviation of the estimated position in the direction in which it is least certain, metres.
    pub sigma_m: f64,
    /// Standard deviation of the estimated heading, radians.
    pub sigma_heading: f64,
    /// Whether walls are known by which the robot could tell where it is.
    pub has_walls: bool,
    /// Share of the beams of the last whole scan that ended before the known walls, or where none is.
    pub unexplained: f64,
    /// The most of those beams side by side that ran through known walls.
    pub contradicted: u32,
    /// Whether it was looked for where that scan may have been taken, within what the estimate allows.
    pub is_matched: bool,
    /// The same over the whole building.
    pub is_searched: bool,
    /// How often that was looked for over the whole building since the goal was given.
    pub searches: u32,
    /// Whether the robot is on its way to where known walls tell where it is.
    pub is_aside: bool,
    /// How often it set out to such a place since the goal was given.
    pub seeks: u32,
    /// Whether the goal point is the end of the path.
    pub is_last: bool,
    /// Seconds since the goal was given.
    pub time_s: f64,
    pub settings: Settings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateDecision {
    /// The next state; it may be the same.
    pub state: State,
    /// What is done on the way there.
    pub action: Action,
}

/// What the weight of a way depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayFacts<'w> {
    pub way: &'w Way,
    /// Whether what was seen of obstacles leaves no free path between its ends.
    pub is_cut: bool,
    /// How often its doorway, or its region, was reported closed.
    pub times_blocked: u32,
}

/// Whatever is a choice. In the knowledge base these are rules.
pub trait Judge {
    /// What the robot does next.
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision;

    /// What becomes of a segment of the local model.
    fn segment(&mut self, facts: &SegmentFacts) -> Transition;

    /// What a way weighs; `None` closes it.
    fn weigh(&mut self, facts: &WayFacts) -> Option<f64>;
}
