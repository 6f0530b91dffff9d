//! How well a robot knows where it is: long drives with the walls known, and with a model that is built on the way.

use adit_planners::geometry::Point;
use adit_planners::navigation::{Building, Drivable, Mission, Tour, Wrong, stops};
use adit_planners::pose::Pose;
use rayon::prelude::*;
use serde::Serialize;

use super::floor::Floor;
use super::judge::{Judges, RuleJudge};
use super::routed::Missions;
use crate::draw::{Curve, CurvePanel, Scale, render_curves};
use crate::error::{Code, Error, Result};

const STOPS: usize = 12;
/// The errors that are to be kept, in the median.
const KEPT_M: f64 = 0.05;
const KEPT_DEGREES: f64 = 1.0;

/// How a drive went: errors are medians over the readings, unless they are called worst.
#[derive(Clone, Debug, Serialize)]
pub struct Driven {
    /// From which stops and errors are drawn.
    pub seed: u64,
    pub is_known: bool,
    /// Metres driven.
    pub length: f64,
    /// Metres between where the robot was and where it thought it was.
    pub error: f64,
    /// Degrees.
    pub heading_error: f64,
    /// Metres.
    pub worst_error: f64,
    /// Metres by the wheels alone.
    pub reckoned_error: f64,
    /// The largest error by the wheels alone, metres.
    pub worst_reckoned_error: f64,
    /// Degrees by the wheels alone.
    pub reckoned_heading_error: f64,
    #[serde(skip)]
    wrong: Vec<Wrong>,
}

/// Drives so far with each of so many seeds, with walls known and unknown.
pub fn drive(floor: &Floor, judges: &Judges, far_m: f64, seeds: u64, first: u64) -> Result<Vec<Driven>> {
    let known = floor.building();
    let unknown = Building::of_walls(known.network.clone(), Vec::new());
    let drives: Vec<(bool, u64)> = [true, false]
        .into_iter()
        .flat_map(|is_known| (0..seeds).map(move |n| (is_known, first.wrapping_add(n))))
        .collect();
    let one = |&(is_known, seed): &(bool, u64)| -> Result<Driven> {
        let radius = floor.network.disc.radius;
        let stops = stops(&floor.plan, &known.network, radius, STOPS, seed);
        let [start, _, ..] = stops[..] else {
            let message = "the plan has no room for a drive: stops need some metres between them";
            return Err(Error::said(Code::SimulateNoRoom, message, None));
        };
        let stops = [&stops[1..], &stops[..1]].concat();
        let tour = Tour { start: Pose { at: start, heading: 0.0 }, stops, far_m, seed };
        let outfit = floor.driving.outfit(radius);
        let of_robot = if is_known { &known } else { &unknown };
        let drive = |judge: &mut RuleJudge| {
            let on = Drivable::of(&known.walls, of_robot);
            tour.run(&on, &outfit, None, judge).map_err(Error::of(Code::SimulateImpossible))
        };
        let wrong = judges.ask(drive)?;
        Ok(Driven::new(seed, is_known, wrong))
    };
    drives.par_iter().map(one).collect()
}

impl Missions<'_> {
    /// Drives so far with each of so many seeds, by the site's routes, in the robot's shapes.
    pub fn tours(&mut self, far_m: f64, seeds: u64, first: u64) -> Result<Vec<Driven>> {
        (0..seeds).map(|n| self.tour(far_m, first.wrapping_add(n))).collect()
    }

    fn tour(&mut self, far_m: f64, seed: u64) -> Result<Driven> {
        let drawn = self.drawn(STOPS, (seed, false))?;
        let start = drawn[0].start;
        let stops: Vec<Point> = drawn.iter().map(|mission| mission.goal).collect();
        let mission = Mission::between(start, stops[0], seed);
        let stance = self.stance_of(&mission)?;
        let start = self.placed(&mission, stance).start;
        let (on, outfit) = self.ground.stage(stance);
        let tour = Tour { start, stops, far_m, seed };
        let (wrong, _, _) = self.along(1, |site, judge, _| {
            tour.run(&on, &outfit, Some(site), judge).map_err(Error::of(Code::SimulateImpossible))
        })?;
        Ok(Driven::new(seed, true, wrong))
    }
}

impl Driven {
    fn new(seed: u64, is_known: bool, wrong: Vec<Wrong>) -> Self {
        let median = |of: fn(&Wrong) -> f64| median(&wrong, &of);
        let worst = |of: fn(&Wrong) -> f64| wrong.iter().map(of).fold(0.0, f64::max);
        Self {
            seed,
            is_known,
            length: wrong.last().map_or(0.0, |last| last.driven_m),
            error: median(|wrong| wrong.place_m),
            heading_error: median(|wrong| wrong.heading).to_degrees(),
            worst_error: worst(|wrong| wrong.place_m),
            reckoned_error: median(|wrong| wrong.reckoned_m),
            worst_reckoned_error: worst(|wrong| wrong.reckoned_m),
            reckoned_heading_error: median(|wrong| wrong.reckoned_heading).to_degrees(),
            wrong,
        }
    }

    /// The median of each metre.
    fn curve(&self, of: impl Fn(&Wrong) -> f64) -> Vec<(f64, f64)> {
        let metre = |wrong: &Wrong| wrong.driven_m as u64;
        self.wrong
            .chunk_by(|one, next| metre(one) == metre(next))
            .map(|chunk| (metre(&chunk[0]) as f64, median(chunk, &of)))
            .collect()
    }
}

fn median(wrong: &[Wrong], of: &impl Fn(&Wrong) -> f64) -> f64 {
    let mut values: Vec<f64> = wrong.iter().map(of).collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// The errors of drives over the distance, as a standalone SVG text.
pub fn draw(world: &str, drives: &[Driven]) -> String {
    let panel = |what: &str, scale, level, (is_known, said): (bool, &str), curves: [fn(&Wrong) -> f64; 2]| {
        let of = || drives.iter().filter(move |driven| driven.is_known == is_known);
        let named = |name: &str, pen, error: fn(&Wrong) -> f64| -> Vec<Curve> {
            of().map(|driven| Curve { name: name.to_owned(), pen, points: driven.curve(error) }).collect()
        };
        CurvePanel {
            title: format!("{what}, {said}"),
            across: "metres driven".to_owned(),
            scale,
            curves: [named("dead reckoning", 1, curves[0]), named("estimated pose", 0, curves[1])].concat(),
            event: None,
            level: Some(level),
        }
    };
    let row = |walls: (bool, &str)| {
        let (metres, degrees) = (Scale::Decades(0.001, 10.0, "m"), Scale::Decades(0.01, 100.0, "°"));
        vec![
            panel("position", metres, KEPT_M, walls, [|wrong| wrong.reckoned_m, |wrong| wrong.place_m]),
            panel(
                "heading",
                degrees,
                KEPT_DEGREES,
                walls,
                [|wrong| wrong.reckoned_heading.to_degrees(), |wrong| wrong.heading.to_degrees()],
            ),
        ]
    };
    let rows: Vec<Vec<CurvePanel>> = [(true, "walls known"), (false, "model built on the way")]
        .into_iter()
        .filter(|(is_known, _)| drives.iter().any(|driven| driven.is_known == *is_known))
        .map(row)
        .collect();
    render_curves(&format!("{world}: errors of the estimated pose, the median of each metre"), &rows)
}
