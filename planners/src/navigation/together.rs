//! Several simulated robots in one building: what each of them finds in its way besides walls.

use super::mission::Underway;
use crate::geometry::{Point, Segment, polygon};

/// A leaf is so thick, metres.
const LEAF_M: f64 = 0.04;

/// A doorway with a door that people open and shut.
#[derive(Clone, Debug)]
pub struct Door {
    leaf: Vec<Point>,
    /// From when to when it is to be shut, seconds, in the order of time.
    times_s: Vec<[f64; 2]>,
    is_shut: bool,
}

impl Door {
    /// A door that is open at first.
    pub fn new(doorway: &Segment, times_s: Vec<[f64; 2]>) -> Self {
        let aside = doorway.direction().perpendicular() * (LEAF_M / 2.0);
        let (a, b) = (doorway.a, doorway.b);
        Self { leaf: vec![a - aside, b - aside, b + aside, a + aside], times_s, is_shut: false }
    }

    pub const fn is_shut(&self) -> bool {
        self.is_shut
    }

    /// Opens and shuts it as it is time. It is not shut while a robot stands in it.
    pub fn follow(&mut self, time_s: f64, robots: &[Underway<'_>]) {
        let is_to_be_shut = self.times_s.iter().any(|[from, to]| (*from..*to).contains(&time_s));
        let stands_in_it = |robot: &Underway<'_>| {
            let (at, rim) = (robot.body().pose().at, robot.body().widest());
            polygon::sides(&self.leaf).any(|side| rim.distance(at, &side) <= rim.radius_m() + LEAF_M)
        };
        self.is_shut = is_to_be_shut && (self.is_shut || !robots.iter().any(stands_in_it));
    }
}

/// What stands about one of several robots: the others, and the doors that are shut, by their corners.
pub fn things_about(which: usize, robots: &[Underway<'_>], doors: &[Door]) -> Vec<Vec<Point>> {
    let others = robots.iter().enumerate().filter(|(number, _)| *number != which);
    let outlines = others.map(|(_, robot)| robot.body().widest().outline(robot.body().pose().at));
    let shut = doors.iter().filter(|door| door.is_shut).map(|door| door.leaf.clone());
    outlines.chain(shut).collect()
}
