//! Learn mode: a simulated robot explores a world of which it knows nothing, and what it has learned is kept.

use adit_db::learned::Learned as Record;
use adit_planners::floor_plan::Network;
use adit_planners::geometry::{Point, Segment};
use adit_planners::navigation::Ending;
use adit_planners::navigation::learn::{Exploration, Learned, score};
use adit_planners::simulator::Film;
use adit_planners::world::Place;
use serde::Serialize;

use super::floor::Floor;
use super::judge::RuleJudge;
use super::missions::refuse;
use super::told::Told;
use crate::error::{Code, Error, Result};

/// How sure a robot is of where it begins in a building that it has learned: the model is so much off, metres.
pub const START_SIGMA_M: f64 = 0.05;

/// Deeper than that is a collision, metres.
const TOUCH_M: f64 = 1e-6;

#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Of its errors.
    pub seed: u64,
    /// `learned` or `gave_up`.
    pub ending: &'static str,
    /// Metres that the robot went.
    pub length: f64,
    /// Seconds by the robot's clock.
    pub seconds: f64,
    /// Whole scans.
    pub looks: u32,
    /// Touches of the skirt while the robot moved.
    pub touches: usize,
    /// Whether anything was within the robot by more than a touch.
    pub collided: bool,
    /// The largest error of the estimated position, metres.
    pub worst_error: f64,
    /// The share of the true free space that was learned.
    pub share: f64,
    /// What was learned to be free and is not, square metres.
    pub outside_area: f64,
    /// How far beyond the nearest wall that reaches, metres.
    pub outside: f64,
    /// From learned walls to the nearest true one, metres: median, 95 %, worst.
    pub walls_off: [f64; 3],
    /// From true walls to the nearest learned one, metres: median, 95 %, worst.
    pub walls_missed: [f64; 3],
    /// Surfaces of the global model.
    pub walls: usize,
    pub regions: usize,
}

impl Row {
    /// Whether it ended as it should.
    pub fn is_right(&self) -> bool {
        self.ending == "learned" && !self.collided
    }
}

/// Explores a world.
///
/// # Arguments
/// `world` and `rules_name` are the names under which it is kept. `film` is made where it is wanted.
pub fn explore(
    (world, rules_name): (&str, &str),
    floor: &Floor,
    guide: &mut RuleJudge,
    exploration: &Exploration,
    film: Option<&mut Option<Film>>,
) -> Result<(Row, Record)> {
    let outfit = floor.driving.outfit(floor.network.disc.radius);
    let explored = exploration
        .run(&floor.plan, &outfit, guide, |_| {}, film)
        .map_err(Error::of(Code::SimulateImpossible))?;
    refuse(guide.trouble())?;
    let learned = &explored.learned;
    let score = score(learned, &floor.plan).map_err(|error| Error::all(error.problems))?;
    let row = Row {
        seed: exploration.seed,
        ending: if explored.ending == Ending::Arrived { "learned" } else { "gave_up" },
        length: explored.path_m,
        seconds: explored.simulated_s,
        looks: explored.looks,
        touches: explored.touches,
        collided: explored.overlap_m > TOUCH_M,
        worst_error: explored.worst_error_m,
        share: score.share,
        outside_area: score.outside_m2,
        outside: score.outside_m,
        walls_off: score.walls_off_m,
        walls_missed: score.walls_missed_m,
        walls: learned.walls.len(),
        regions: score.regions,
    };
    let record = Record {
        world: world.to_owned(),
        learned: format!("{world} (learned)"),
        rules: rules_name.to_owned(),
        seed: exploration.seed.to_string(),
        radius: learned.radius_m,
        start: [learned.start.x, learned.start.y],
        length: explored.path_m,
        seconds: explored.simulated_s,
        walls: learned.walls.iter().map(|wall| [wall.a.x, wall.a.y, wall.b.x, wall.b.y]).collect(),
        unseen: learned.unseen.iter().map(|corners| extent(corners)).collect(),
        places: Vec::new(),
    };
    Ok((row, record))
}

/// Least x, y, greatest x, y of a box.
fn extent(corners: &[Point]) -> [f64; 4] {
    corners
        .iter()
        .fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |[x0, y0, x1, y1], p| {
            [x0.min(p.x), y0.min(p.y), x1.max(p.x), y1.max(p.y)]
        })
}

/// A world as a robot knows it that has learned it.
pub fn known(stored: &Record, truth: &Floor) -> Result<Floor> {
    let at = |[x, y]: [f64; 2]| Point::new(x, y);
    let learned = Learned {
        start: at(stored.start),
        radius_m: stored.radius,
        walls: stored
            .walls
            .iter()
            .map(|&[x0, y0, x1, y1]| Segment::new(at([x0, y0]), at([x1, y1])))
            .collect(),
        unseen: stored
            .unseen
            .iter()
            .map(|&[x0, y0, x1, y1]| [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(at).to_vec())
            .collect(),
        places: stored
            .places
            .iter()
            .map(|(name, point)| Place { name: name.clone(), at: at(*point) })
            .collect(),
    };
    let plan = learned.plan(&stored.learned).map_err(|error| Error::all(error.problems))?;
    let network = Network::new(&plan, truth.network.disc).map_err(|error| Error::all(error.problems))?;
    Ok(Floor { plan, network, driving: truth.driving, told: Told::default() })
}
