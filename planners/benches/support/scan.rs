//! A step of a navigator with the last reading of a scan, whoever decides.

use adit_planners::body::{Body, Command, Sensed, Silence};
use adit_planners::floor_plan::{Disc, Drawn, FloorPlan, Network};
use adit_planners::geometry::{Point, Segment};
use adit_planners::local_model::{self, Estimate};
use adit_planners::navigation::{Building, Happening, Judge, Navigator, Settings};
use adit_planners::pose::Pose;
use adit_planners::rim::Rim;
use adit_planners::simulator::{self, Simulator};
use divan::Bencher;

const GOAL: Point = Point::new(2.6, 2.9);

/// All walls are in the model, whether they can be heard or not.
const MODEL: fn() -> local_model::Settings =
    || local_model::Settings { recall_m: 1000.0, ..local_model::Settings::default() };

/// Walls with a network that has nothing to do with them: it is not asked here.
fn known(walls: Vec<Segment>) -> Building {
    let corner = |x, y| Point::new(x, y);
    let corners =
        [corner(-200.0, -200.0), corner(200.0, -200.0), corner(200.0, 200.0), corner(-200.0, 200.0)];
    let side = |i: usize| [corners[i], corners[(i + 1) % 4]];
    let drawn = Drawn {
        name: "hall".to_owned(),
        walls: (0..4).map(side).collect(),
        solids: Vec::new(),
        places: Vec::new(),
    };
    let plan = FloorPlan::new(drawn).expect("a hall");
    let network = Network::new(&plan, Disc { radius: 0.25, margin: 0.0 }).expect("a network");
    Building::of_walls(network, walls)
}

/// A body of which all that matters is what it senses next.
struct Once(Sensed, usize);

impl Body for Once {
    fn rim(&self) -> Rim {
        Rim::disc(0.25)
    }

    fn directions(&self) -> usize {
        self.1
    }

    fn command(&mut self, _: Command) {}

    fn sense(&mut self) -> Result<Sensed, Silence> {
        Ok(self.0.clone())
    }
}

/// A navigator that lacks one reading of its second scan, and that reading.
fn before_a_scan<'b>(building: &'b Building, judge: &mut impl Judge) -> (Navigator<'b>, Sensed) {
    let start = Pose::new(1.5, 1.7, 0.2);
    let settings = simulator::Settings::default();
    let mut body = Simulator::new(&building.walls, Vec::new(), settings, start, 3).expect("a free place");
    let thought = Estimate::new(Pose::new(1.52, 1.69, 0.21), 0.03, 0.02);
    let mut navigator = Navigator::new(building, MODEL(), Settings::default(), thought);
    navigator.go(GOAL, judge);
    let mut scans = 0;
    loop {
        let before = (navigator.clone(), body.clone());
        assert_eq!(navigator.step(&mut body, judge), None, "it is on its way");
        let happened = navigator.take_events();
        scans +=
            happened.iter().filter(|event| matches!(event.what, Happening::SetEstimatedPosition(_))).count();
        if scans == 2 {
            let (navigator, mut body) = before;
            return (navigator, body.sense().expect("a simulated body answers"));
        }
    }
}

/// The last reading of a scan among walls: the model is updated, and what is done next is decided.
pub fn measure(bencher: Bencher<'_, '_>, walls: Vec<Segment>, mut judge: impl Judge) {
    let building = known(walls);
    let (navigator, sensed) = before_a_scan(&building, &mut judge);
    let once = || Once(sensed.clone(), usize::from(simulator::Settings::default().readings_a_turn));
    bencher.with_inputs(|| (navigator.clone(), once())).bench_local_values(|(mut navigator, mut once)| {
        navigator.step(&mut once, &mut judge);
        navigator
    });
}
