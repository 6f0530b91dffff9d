//! A long drive through a building from stop to stop, with the truth beside what the robot thinks.

use super::Ending;
use super::judge::Judge;
use super::mission::{Drivable, Mission, Outfit};
use super::router::Router;
use crate::geometry::Point;
use crate::pose::{Pose, wrapped};
use crate::simulator::SimulationError;

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
    /// Surfaces of the walls that `on` does not let the robot know are built on the way. `router` finds the ways, where
    /// somebody else than the navigator does.
    ///
    /// # Returns
    /// Each moment at which the sensors were read. The drive is shorter than it should be where none of the stops can be
    /// reached any more.
    pub fn run(
        &self,
        on: &Drivable<'_>,
        outfit: &Outfit,
        mut router: Option<&mut dyn Router>,
        judge: &mut impl Judge,
    ) -> Result<Vec<Wrong>, SimulationError> {
        let mut stops = self.stops.iter().copied().cycle();
        let first = Mission::between(self.start, stops.next().unwrap_or(self.start.at), self.seed);
        let mut underway = first.begin(on, outfit, router.is_some(), judge)?;
        let mut all: Vec<Wrong> = Vec::new();
        let (mut driven_m, mut in_vain) = (0.0, 0);
        while in_vain <= self.stops.len() {
            let before = underway.body().pose();
            let router = router.as_mut().map(|router| &mut **router as &mut dyn Router);
            let (ending, _) = underway.step(router, judge);
            let body = underway.body();
            driven_m += before.at.distance(body.pose().at);
            let reckoned = self.start.then(&body.odometry());
            all.push(Wrong::new(driven_m, &body.pose(), &underway.navigator().estimate().pose, &reckoned));
            if driven_m >= self.far_m {
                break;
            }
            if let Some(ending) = ending {
                in_vain = if ending == Ending::Arrived { 0 } else { in_vain + 1 };
                underway.go_on(stops.next().unwrap_or(self.start.at), judge);
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
