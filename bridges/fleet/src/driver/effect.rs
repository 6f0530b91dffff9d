//! What is to be done.

use serde_json::Value;

use crate::wire::Addressee;

/// Now: seconds that only grow, and the time of day as messages have it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clock {
    pub seconds: f64,
    pub words: String,
}

/// Something to be done for a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Say this to the vehicle.
    Send { to: Addressee, topic: &'static str, message: Value },
    /// Ask for the way from there, and hear of others; routes are handed in with the epoch.
    Follow { epoch: u64, start: [f64; 2], goal: String, robot: Option<String> },
    /// Ask once more which way is the best from there now: more is released of it.
    Ask { epoch: u64, start: [f64; 2], goal: String, robot: Option<String> },
    /// What is followed goes on from there.
    Moved { at: [f64; 2] },
    /// No way is asked for any more.
    Unfollow,
    /// Look whether there is still a way along what is released.
    Check {
        order: String,
        update: u32,
        from: [f64; 2],
        to: [f64; 2],
        metres: f64,
        doorways: Vec<String>,
        robot: Option<String>,
    },
    /// Tell the site that the way ahead is blocked.
    Block { at: [f64; 2], heading: f64, seconds: u32, only: Option<String>, why: String },
    /// Write into the vehicle's row.
    Write { column: &'static str, value: Value },
    /// Its goal is reached: take it out of its row.
    Arrived { goal: String },
    /// Into the log.
    Say(String),
}
