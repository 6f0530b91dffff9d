//! Manual mode (Crowley 1985, section 4.1): the user drives a simulated robot, and names places where it stands.

use super::judge::Judge;
use super::known::Building;
use super::{Ending, Entry, Navigator, Outfit};
use crate::body::Command;
use crate::geometry::{Point, Segment};
use crate::pose::Pose;
use crate::simulator::{SimulationError, Simulator};
use crate::world::Place;

/// What the user tells the robot.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// To go straight ahead; back where it is below 0. A touch ends it. Metres.
    Forward(f64),
    /// To turn on the spot: radians, counter-clockwise above 0.
    Turn(f64),
    Look,
    /// To call the place where it stands by a name.
    Name(String),
    /// To go somewhere by itself: automatic mode.
    Go(Point),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Driven {
    /// The places that were named, where the robot thought that they are.
    pub places: Vec<Place>,
    /// Where the robot thinks that it is.
    pub estimate: Pose,
    pub truth: Pose,
    /// Metres that it really went.
    pub path_m: f64,
    /// Touches of the skirt by the robot.
    pub touches: usize,
    /// The deepest that anything was within the robot, metres; below 0 where there was always a gap.
    pub overlap_m: f64,
    /// The order to go somewhere that ended otherwise than there, by index; those after it were not followed.
    pub in_vain: Option<(usize, Ending)>,
}

/// Drives a simulated robot from order to order, up to the first one to go somewhere that does not end there.
///
/// # Arguments
/// `walls` are those of the building, `known` is what the robot knows of it. `journal` gets every event.
pub fn drive(
    orders: &[Order],
    (start, seed): (Pose, u64),
    walls: &[Segment],
    known: &Building,
    outfit: &Outfit,
    judge: &mut impl Judge,
    journal: impl FnMut(Entry),
) -> Result<Driven, SimulationError> {
    let body = Simulator::new(walls, Vec::new(), outfit.robot, start, seed)?;
    let navigator = Navigator::new(known, outfit.model, outfit.navigation, outfit.estimate(start));
    let driven = Driven { overlap_m: f64::NEG_INFINITY, ..Driven::default() };
    let mut drive = Drive { body, navigator, judge, journal, driven };
    for (index, order) in orders.iter().enumerate() {
        drive.follow(index, order);
        // What comes next is meant for a robot that is there.
        if drive.driven.in_vain.is_some() {
            break;
        }
    }
    let Drive { body, navigator, driven, .. } = drive;
    let (estimate, truth) = (navigator.estimate().pose, body.pose());
    Ok(Driven { estimate, truth, touches: body.touches_by_robot(), ..driven })
}

struct Drive<'d, J, W> {
    body: Simulator,
    navigator: Navigator<'d>,
    judge: &'d mut J,
    journal: W,
    driven: Driven,
}

impl<J: Judge, W: FnMut(Entry)> Drive<'_, J, W> {
    fn follow(&mut self, index: usize, order: &Order) {
        match order {
            Order::Forward(distance_m) => {
                let speed_m_s = self.navigator.settings().speed_m_s;
                self.command(Command::Move { distance_m: *distance_m, bearing: 0.0, speed_m_s });
            }
            Order::Turn(by) => self.command(Command::Turn { by: *by }),
            Order::Look => self.look(),
            Order::Name(name) => {
                let at = self.navigator.estimate().pose.at;
                self.driven.places.retain(|place| place.name != *name);
                self.driven.places.push(Place { name: name.clone(), at });
            }
            Order::Go(goal) => {
                self.navigator.go(*goal, self.judge);
                let ending = loop {
                    if let Some(ending) = self.step() {
                        break ending;
                    }
                };
                if ending != Ending::Arrived {
                    self.driven.in_vain = Some((index, ending));
                }
            }
        }
    }

    /// Has a command carried out; then the robot looks around, so that it knows where it is.
    fn command(&mut self, command: Command) {
        self.navigator.drive(&mut self.body, command);
        while self.navigator.is_busy() {
            self.step();
        }
        self.look();
    }

    fn look(&mut self) {
        for _ in 0..self.navigator.scan_readings() {
            self.step();
            if self.navigator.is_scan_complete() {
                break;
            }
        }
        self.step();
    }

    fn step(&mut self) -> Option<Ending> {
        let before = self.body.pose();
        let ending = self.navigator.step(&mut self.body, self.judge);
        let truth = self.body.pose();
        self.driven.path_m += before.at.distance(truth.at);
        self.driven.overlap_m = self.driven.overlap_m.max(self.body.overlap_m());
        for event in self.navigator.take_events() {
            (self.journal)(Entry { event, truth: Some(truth) });
        }
        ending
    }
}
