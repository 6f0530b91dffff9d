//! What a navigator knows of the robot that it drives. Whether that is a machine or a simulation is not told.

use std::fmt;

use crate::pose::Pose;
use crate::rim::Rim;

/// A robot with something that measures how far it is to what stands about it (a sonar that turns, a ring of them, a planar lidar),
/// wheels or legs that are counted, and perhaps a skirt that feels contact. It is round, or a rectangle that keeps its facing and
/// moves any way in it; one that can change its shape is one of them in each.
pub trait Body {
    /// In the shape in which it is; where it is longer than wide, along its heading.
    fn rim(&self) -> Rim;

    /// Into how many directions it measures, all around: so many readings are a whole scan.
    fn directions(&self) -> usize;

    /// What it is to do from now on; what it was doing ends.
    fn command(&mut self, command: Command);

    /// Waits for the next readings, and tells what was sensed until then.
    ///
    /// # Errors
    /// Where the body is not heard any more. It stays so.
    fn sense(&mut self) -> Result<Sensed, Silence>;
}

/// One thing for the wheels to do. Wheels go by their own count: how far it really was is not told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Command {
    #[default]
    Stop,
    /// To turn on the spot: radians, counter-clockwise above 0.
    Turn { by: f64 },
    /// To go straight: ahead, or back where the distance is below 0. It ends early where the skirt touches something.
    Move {
        distance_m: f64,
        /// Where that is: radians from the heading, counter-clockwise. A body that is round goes where it looks: 0.
        bearing: f64,
        /// How fast, metres a second. The body's own greatest speed is not exceeded.
        speed_m_s: f64,
    },
    /// To change its shape where it stands: into which, by the number that body and navigator have agreed on.
    Change { to: usize },
}

/// Why a body is not heard any more, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Silence(pub String);

impl fmt::Display for Silence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Sensed {
    /// Seconds since the body was switched on.
    pub time_s: f64,
    /// Where the wheels' count puts the robot, beginning from the pose 0, 0, 0 when it was switched on.
    pub odometry: Pose,
    /// What was measured since the last time, in the order of time: one reading of a sonar that turns, a whole scan of a lidar.
    pub readings: Vec<Reading>,
    /// What the skirt feels, if there is one; nothing is felt any more once the robot has moved off.
    pub contact: Option<Contact>,
    /// Whether the command is still being carried out.
    pub is_busy: bool,
    /// The shape in which the body is; while it changes, the one that it had.
    pub shape: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Where the beam went: radians from the heading, counter-clockwise.
    pub bearing: f64,
    /// How far away the echo came from, metres from the robot's middle; `None` where none was heard.
    pub range_m: Option<f64>,
    /// Where the wheels' count put the robot at that time.
    pub odometry: Pose,
}

/// A touch of the skirt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where on the skirt: radians from the heading, counter-clockwise.
    pub bearing: f64,
}
