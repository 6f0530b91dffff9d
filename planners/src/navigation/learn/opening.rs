//! Where what was seen free ends without a wall, and what is asked about that.

use crate::navigation::Judge;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpeningFacts {
    /// Metres from one end to the other.
    pub width_m: f64,
    /// Metres that the robot has to go until it looks into it.
    pub distance_m: f64,
    /// Angle between the way to it and the direction that the user asked for, radians from 0 to PI; `None` where none was
    /// asked for.
    pub off_asked: Option<f64>,
    /// Whether nothing stands between it and the robot.
    pub is_in_sight: bool,
    /// How often the robot went there in vain.
    pub times_tried: u32,
    /// Seconds since the exploration began.
    pub time_s: f64,
    /// Metres that the wheels have counted since then.
    pub driven_m: f64,
    pub radius_m: f64,
}

/// A judge that says what is explored next, too.
pub trait Guide: Judge {
    /// What it is worth to look into an opening, any number; `None` leaves it alone. The one that is worth most is next,
    /// and when all are left alone the building is learned.
    fn opening(&mut self, facts: &OpeningFacts) -> Option<f64>;
}
