//! A robot on a tour: it drives by its estimate, and looks around where it stops.

use std::path::Path;

use adit_planners::body::{Body, Command, Reading};
use adit_planners::geometry::{Point, Segment};
use adit_planners::local_model::{Estimate, LocalModel, SegmentFacts, Settings, Transition};
use adit_planners::pose::{Pose, wrapped};
use adit_planners::simulator::{self, Film, Simulator};

use crate::imp::plans::{self, Plan};
use crate::imp::table::{remembering, table};

/// Readings between two updates on the way: a third of a turn.
const PART: usize = 40;
const TURN: usize = 120;

struct Errors {
    place_m: Vec<f64>,
    heading: Vec<f64>,
    reckoned_m: Vec<f64>,
}

/// A robot that goes from point to point, as a navigator sees it, with the truth beside it for the judge.
struct Drive<'t> {
    robot: Simulator,
    model: LocalModel,
    known: Vec<Segment>,
    table: &'t dyn Fn(&SegmentFacts) -> Transition,
    readings: Vec<Reading>,
    start: Pose,
    errors: Errors,
    driven_m: f64,
    film: Option<Film>,
}

impl<'t> Drive<'t> {
    fn new(
        plan: &Plan,
        start: Point,
        seed: u64,
        is_known: bool,
        table: &'t dyn Fn(&SegmentFacts) -> Transition,
    ) -> Self {
        let start = Pose { at: start, heading: 0.0 };
        let robot =
            Simulator::new(&plan.walls(), Vec::new(), simulator::Settings::default(), start, seed).unwrap();
        let settings = Settings::default();
        let model = LocalModel::new(settings, Estimate::new(start, 0.01, 0.5_f64.to_radians()));
        let known = if is_known { plan.walls() } else { Vec::new() };
        let errors = Errors { place_m: Vec::new(), heading: Vec::new(), reckoned_m: Vec::new() };
        Self { robot, model, known, table, readings: Vec::new(), start, errors, driven_m: 0.0, film: None }
    }

    /// Senses until the command is done and so many readings are waiting.
    fn sense(&mut self, at_least: usize) {
        loop {
            let before = self.robot.pose();
            let sensed = self.robot.sense().unwrap();
            self.model.reckon(&sensed.odometry);
            self.readings.extend(sensed.readings);
            if self.readings.len() >= PART.max(at_least) {
                self.update(sensed.time_s);
            }
            let (truth, thought) = (self.robot.pose(), self.model.estimate().pose);
            self.driven_m += before.at.distance(truth.at);
            self.errors.place_m.push(thought.at.distance(truth.at));
            self.errors.heading.push(wrapped(thought.heading - truth.heading).abs());
            self.errors.reckoned_m.push(self.start.then(&sensed.odometry).at.distance(truth.at));
            if !sensed.is_busy && (at_least == 0 || self.readings.is_empty()) {
                return;
            }
        }
    }

    fn update(&mut self, time_s: f64) {
        self.model.recall((0..).zip(self.known.iter().copied()), self.table);
        self.model.update(&std::mem::take(&mut self.readings), time_s, self.table);
        if let Some(film) = &mut self.film {
            let mut frame = self.robot.frame();
            frame.estimate = Some(self.model.estimate().pose);
            frame.surfaces = Some(self.model.segments().iter().map(|segment| segment.line).collect());
            film.push(frame);
        }
    }

    fn go_to(&mut self, goal: Point) {
        for _ in 0..200 {
            let pose = self.model.estimate().pose;
            let (far, bearing) = (pose.at.distance(goal), pose.bearing(goal));
            if far < 0.08 {
                break;
            }
            if bearing.abs() > 3.0_f64.to_radians() {
                self.robot.command(Command::Turn { by: bearing });
            } else {
                self.robot.command(Command::Move { distance_m: far.min(1.0), bearing: 0.0, speed_m_s: 0.5 });
            }
            self.sense(0);
        }
        self.readings.clear();
        self.sense(TURN);
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn drive<'t>(
    plan: &Plan,
    seed: u64,
    is_known: bool,
    far_m: f64,
    table: &'t dyn Fn(&SegmentFacts) -> Transition,
) -> Drive<'t> {
    let tour = plan.tour();
    let mut drive = Drive::new(plan, tour[0], seed, is_known, table);
    drive.sense(TURN);
    for stop in tour.iter().cycle().skip(1) {
        drive.go_to(*stop);
        if drive.driven_m >= far_m {
            break;
        }
    }
    drive
}

fn report(plan: &Plan, what: &str, drive: &Drive<'_>) -> (f64, f64, f64) {
    let errors = &drive.errors;
    let (place, heading) = (median(&errors.place_m), median(&errors.heading).to_degrees());
    let reckoned = errors.reckoned_m.iter().fold(0.0_f64, |a, b| a.max(*b));
    let most = errors.place_m.iter().fold(0.0_f64, |a, b| a.max(*b));
    println!(
        "{} {what}: {:.0} m driven, {} touches; median error {:.1} cm, {:.2} degrees; worst {:.1} cm; dead reckoning up to {:.1} m off; {} segments",
        plan.name,
        drive.driven_m,
        drive.robot.touches().len(),
        100.0 * place,
        heading,
        100.0 * most,
        reckoned,
        drive.model.segments().len(),
    );
    (place, heading, reckoned)
}

#[test]
fn in_a_known_building_the_pose_stays_within_5_cm_and_1_degree_over_200_m() {
    let mut lost = Vec::new();
    for plan in plans::all() {
        for seed in 1..=3 {
            let drive = drive(&plan, seed, true, 200.0, &table);
            let (place, heading, reckoned) = report(&plan, "known", &drive);
            assert!(drive.driven_m >= 200.0, "it gets stuck: {} m", drive.driven_m);
            assert!(place < 0.05 && heading < 1.0, "{place} m, {heading} degrees");
            lost.push(reckoned);
        }
    }
    assert!(lost.iter().sum::<f64>() / lost.len() as f64 > 2.0, "dead reckoning is metres off: {lost:?}");
}

#[test]
fn in_an_unknown_building_the_model_made_on_the_way_keeps_the_pose() {
    for plan in plans::all() {
        for seed in 1..=3 {
            let drive = drive(&plan, seed, false, 200.0, &remembering);
            let (place, heading, reckoned) = report(&plan, "unknown", &drive);
            assert!(drive.driven_m >= 200.0, "it gets stuck: {} m", drive.driven_m);
            assert!(place < 0.15 && heading < 1.0, "{place} m, {heading} degrees");
            assert!(reckoned > 5.0 * place);
        }
    }
}

/// `FILM=folder cargo test -p adit-planners --test specification imp::tour::film -- --ignored` writes an animation for each plan.
#[test]
#[ignore = "writes files for eyes"]
fn film() {
    let Some(folder) = std::env::var_os("FILM") else { return };
    for plan in plans::all() {
        let tour = plan.tour();
        let mut drive = Drive::new(&plan, tour[0], 1, false, &remembering);
        drive.film = Some(Film::new(&drive.robot));
        drive.sense(TURN);
        for stop in tour.iter().skip(1) {
            drive.go_to(*stop);
        }
        let film = drive.film.unwrap().svg(8.0);
        std::fs::write(Path::new(&folder).join(format!("{}.svg", plan.name)), film).unwrap();
    }
}
