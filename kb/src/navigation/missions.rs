//! Missions of a simulated robot, judged by rules.

use std::sync::Arc;
use std::time::Instant;

use adit_engine::RuleBase;
use adit_planners::navigation::{Building, Ending, Entry, Mission, Outcome, Outfit, Possible, draw};
use adit_planners::simulator::Film;
use rayon::prelude::*;
use serde::Serialize;

use super::floor::Floor;
use super::judge::RuleJudge;
use crate::error::{Error, Result};

/// How a mission went.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Its number, from 1.
    pub mission: usize,
    /// From which it is drawn, and its errors.
    pub seed: u64,
    /// Where it begins.
    pub start: [f64; 2],
    /// Where it leads.
    pub goal: [f64; 2],
    /// How many obstacles are not known to the robot.
    pub obstacles: usize,
    /// `arrived`, `no_way` or `gave_up`.
    pub ending: &'static str,
    /// Whether a disc of the robot's radius can get there with the obstacles at rest.
    pub possible: Option<bool>,
    /// Whether a disc with room to spare can.
    pub possible_with_room: Option<bool>,
    /// Whether the ending is right: arrived where it must, no way where there is none, either in between.
    pub right: Option<bool>,
    /// Metres that the robot went.
    pub length: f64,
    /// Of the shortest path that knows of the obstacles.
    pub optimum: Option<f64>,
    /// Times that a way was closed and another looked for.
    pub replans: u32,
    /// Detours.
    pub detours: u32,
    /// Touches of the skirt while the robot moved.
    pub touches: usize,
    /// Whether anything was within the robot by more than a touch.
    pub collided: bool,
    /// Metres from the goal at the end.
    pub miss: f64,
    /// The largest error of the estimated position, metres.
    pub worst_error: f64,
    /// Seconds by the robot's clock.
    pub seconds: f64,
    /// Milliseconds that the simulation took.
    pub milliseconds: f64,
    /// What the rules did not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trouble: Option<String>,
}

/// Deeper than that is a collision, metres.
const TOUCH_M: f64 = 1e-6;

/// The missions of a seed.
pub fn drawn(floor: &Floor, missions: usize, seed: u64) -> Result<Vec<Mission>> {
    let of = |number: usize| {
        // Far apart, so that seeds that lie together give different missions.
        let seed = seed.wrapping_add((number as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        draw(&floor.plan, &floor.network, floor.network.disc.radius, seed).ok_or_else(|| {
            let message = "the plan has no room for missions: start and goal need some metres between them";
            Error::said("simulate/no-room", message, None)
        })
    };
    (0..missions).map(of).collect()
}

/// Runs missions on all cores; `done` is told of each.
pub fn run(
    floor: &Floor,
    rules: &Arc<RuleBase>,
    missions: &[Mission],
    done: impl Fn() + Sync,
) -> Result<Vec<Row>> {
    let building = Building::new(&floor.plan, floor.network.clone());
    let one = |(index, mission): (usize, &Mission)| {
        let row = watched(floor, &building, rules, index + 1, mission, |_| {}, None).map(|(row, _)| row);
        done();
        row
    };
    missions.par_iter().enumerate().map(one).collect()
}

/// Runs a mission; every event goes to `journal`, and where a film is wanted it is made.
pub fn watched(
    floor: &Floor,
    building: &Building,
    rules: &Arc<RuleBase>,
    number: usize,
    mission: &Mission,
    journal: impl FnMut(Entry),
    film: Option<&mut Option<Film>>,
) -> Result<(Row, Outcome)> {
    let mut judge =
        RuleJudge::new(rules).map_err(|error| Error::said("simulate/rules", error.to_string(), None))?;
    let radius = floor.network.disc.radius;
    let mut outfit = Outfit { navigation: floor.settings, ..Outfit::default() };
    outfit.robot.radius_m = radius;
    let before = Instant::now();
    let outcome = mission
        .run(building, &outfit, &mut judge, journal, film)
        .map_err(|error| Error::said("simulate/impossible", error.to_string(), None))?;
    let milliseconds = before.elapsed().as_secs_f64() * 1e3;
    let possible = mission.possible(&floor.plan, radius);
    let row = Row {
        mission: number,
        seed: mission.seed,
        start: [mission.start.at.x, mission.start.at.y],
        goal: [mission.goal.x, mission.goal.y],
        obstacles: mission.obstacles.len(),
        ending: ending(outcome.ending),
        possible: possible.map(|possible| possible.is_for_radius),
        possible_with_room: possible.map(|possible| possible.is_with_room),
        right: possible.map(|possible| is_right(outcome.ending, &possible)),
        length: outcome.path_m,
        optimum: possible.and_then(|possible| possible.optimum_m),
        replans: outcome.replans,
        detours: outcome.detours,
        touches: outcome.touches,
        collided: outcome.overlap_m > TOUCH_M,
        miss: outcome.miss_m,
        worst_error: outcome.worst_error_m,
        seconds: outcome.simulated_s,
        milliseconds,
        trouble: judge.trouble().map(str::to_owned),
    };
    Ok((row, outcome))
}

const fn ending(ending: Ending) -> &'static str {
    match ending {
        Ending::Arrived => "arrived",
        Ending::NoWay => "no_way",
        Ending::OutOfPatience => "gave_up",
    }
}

const fn is_right(ending: Ending, possible: &Possible) -> bool {
    match ending {
        Ending::Arrived => possible.is_for_radius,
        Ending::NoWay => !possible.is_with_room,
        Ending::OutOfPatience => false,
    }
}
