//! A long drive through a building from stop to stop, with the truth beside what the robot thinks.

use super::judge::Judge;
use super::known::Building;
use super::mission::Outfit;
use super::{Ending, Navigator};
use crate::geometry::{Point, Segment};
use crate::local_model::Estimate;
use crate::pose::{Pose, wrapped};
use crate::simulator::{SimulationError, Simulator};

/// Where a robot goes, and what it begins with.
#[derive(Clone, Debug, PartialEq)]
pub struct Tour {
    /// Where the robot stands, and thinks that it stands.
    pub start: Pose,
    /// Where it goes, one after the other, and from the last to the first again.
    pub stops: Vec<Point>,
    pub far_m: f64,
    /// Of the errors of wheels and sonar.
    pub seed: u64,
}

/// How wrong the robot was at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrong {
    /// Metres that it had really gone.
    pub driven_m: f64,
    /// From where it was to where it thought it was, metres.
    pub place_m: f64,
    /// Between its heading and what it thought, radians from 0 to PI.
    pub heading: f64,
    /// From where it was to where its wheels alone would have it, metres.
    pub reckoned_m: f64,
    /// Between its heading and that by its wheels alone, radians from 0 to PI.
    pub reckoned_heading: f64,
}

impl Tour {
    /// Drives.
    ///
    /// # Arguments
    /// `walls` are those of the building, `known` is what the robot knows of it: surfaces that are not known are built on
    /// the way.
    ///
    /// # Returns
    /// Each moment at which the sonar was read. The drive is shorter than it should be where none of the stops can be
    /// reached any more.
    pub fn run(
        &self,
        walls: &[Segment],
        known: &Building,
        outfit: &Outfit,
        judge: &mut impl Judge,
    ) -> Result<Vec<Wrong>, SimulationError> {
        let mut body = Simulator::new(walls, Vec::new(), outfit.robot, self.start, self.seed)?;
        let start = Estimate::new(self.start, 0.01, 0.5_f64.to_radians());
        let mut navigator = Navigator::new(known, outfit.model, outfit.navigation, start);
        let mut all: Vec<Wrong> = Vec::new();
        let (mut driven_m, mut in_vain) = (0.0, 0);
        for stop in self.stops.iter().cycle() {
            navigator.go(*stop, judge);
            let ending = loop {
                let before = body.pose();
                let ending = navigator.step(&mut body, judge);
                navigator.take_events();
                driven_m += before.at.distance(body.pose().at);
                let reckoned = self.start.then(&body.odometry());
                all.push(Wrong::new(driven_m, &body.pose(), &navigator.estimate().pose, &reckoned));
                if driven_m >= self.far_m {
                    return Ok(all);
                }
                if let Some(ending) = ending {
                    break ending;
                }
            };
            in_vain = if ending == Ending::Arrived { 0 } else { in_vain + 1 };
            if in_vain > self.stops.len() {
                break;
            }
        }
        Ok(all)
    }
}

impl Wrong {
    fn new(driven_m: f64, truth: &Pose, thought: &Pose, reckoned: &Pose) -> Self {
        let turned = |pose: &Pose| wrapped(pose.heading - truth.heading).abs();
        Self {
            driven_m,
            place_m: truth.at.distance(thought.at),
            heading: turned(thought),
            reckoned_m: truth.at.distance(reckoned.at),
            reckoned_heading: turned(reckoned),
        }
    }
}
