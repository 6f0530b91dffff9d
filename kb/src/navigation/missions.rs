//! Missions of a simulated robot, judged by rules.

use std::collections::BTreeMap;
use std::time::Instant;

use adit_engine::Considered;
use adit_planners::body::Body;
use adit_planners::geometry::{Point, Segment};
use adit_planners::navigation::{
    Building, Drivable, Ending, Entry, Judge, Mission, Outcome, Outfit, Pace, Trip, WayFacts, draw,
    draw_kidnapping, trip,
};
use adit_planners::pose::Pose;
use adit_planners::simulator::{Film, Simulator};
use rayon::prelude::*;
use serde::Serialize;

use super::floor::Floor;
use super::judge::{Considers, Judges, Noting};
use crate::error::{Code, Error, Result};
use crate::navigation::body::Remote;

#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Its number, from 1.
    pub mission: usize,
    /// Which robot, where several drive at once.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub robot: Option<String>,
    pub start: [f64; 2],
    pub goal: [f64; 2],
    /// `arrived`, `no_way`, `lost`, `silent` or `gave_up`.
    pub ending: &'static str,
    /// Why the robot was not heard any more, where it was not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub silence: Option<String>,
    /// Metres that the robot went; where nobody knows where it is, by the count of its wheels.
    pub length: f64,
    /// Metres in each state, of a robot that changes its shape.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub by_state: BTreeMap<String, f64>,
    /// How fast it was in each state, where it neither set off nor came to a stand.
    #[serde(skip)]
    pub paces: BTreeMap<String, Pace>,
    /// Changes of shape.
    pub changes: u32,
    /// The hardness of what the robot did, where routes lead by hardness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// Times that a way was closed and another looked for.
    pub replans: u32,
    pub detours: u32,
    /// Touches of the skirt while the robot moved.
    pub touches: usize,
    /// Seconds by the robot's clock.
    pub seconds: f64,
    /// Milliseconds that it took.
    pub milliseconds: f64,
    /// What judges know, of a robot that is simulated; of another one nobody does.
    #[serde(flatten)]
    pub truth: Option<Truth>,
}

/// What is known of a mission of a simulated robot besides what the robot knows.
#[derive(Clone, Debug, Serialize)]
pub struct Truth {
    /// From which it is drawn, and its errors.
    pub seed: u64,
    /// How many obstacles are not known to the robot.
    pub obstacles: usize,
    /// Whether a disc of the robot's radius can get there with the obstacles at rest.
    pub possible: Option<bool>,
    /// Whether a disc with room to spare can.
    pub possible_with_room: Option<bool>,
    /// Where the robot was carried off to, if it was; what is possible is so from there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kidnapped: Option<[f64; 2]>,
    /// Whether the ending is right: arrived where it must, no way where there is none, either in between; of a robot that was
    /// carried off, that it does not know where it is, too.
    pub right: Option<bool>,
    /// Of the shortest path that knows of the obstacles; where routes lead by hardness, of the best route that does.
    pub optimum: Option<f64>,
    /// The hardness of the best route that knows of the obstacles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_cost: Option<f64>,
    /// Whether anything was within the robot by more than a touch.
    pub collided: bool,
    /// Metres from the goal at the end.
    pub miss: f64,
    /// The largest error of the estimated position, metres.
    pub worst_error: f64,
}

/// What is possible for who knows of all obstacles where they come to rest.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    pub is_possible: bool,
    /// Whether it is for a robot with room to spare on either side.
    pub is_with_room: bool,
    /// The hardness of the best route, where routes lead by hardness.
    pub least_cost: Option<f64>,
    /// The length of the shortest path, or of the best route, metres.
    pub optimum_m: Option<f64>,
}

impl Judged {
    /// Whether a mission ended as it should: a robot that says that it has arrived stands over its goal.
    fn is_right(&self, outcome: &Outcome, radius: f64) -> bool {
        match outcome.trip.ending {
            Ending::Arrived => self.is_possible && outcome.miss_m <= radius,
            Ending::NoWay => !self.is_with_room,
            Ending::Lost => outcome.kidnapped.is_some(),
            Ending::Silent | Ending::OutOfPatience => false,
        }
    }
}

impl Row {
    /// How a mission went, of a robot of a radius.
    pub fn new(
        (number, mission): (usize, &Mission),
        outcome: &Outcome,
        judged: Option<Judged>,
        radius: f64,
    ) -> Self {
        let is_whole = judged.filter(|_| outcome.kidnapped.is_none());
        let truth = Truth {
            seed: mission.seed,
            obstacles: mission.obstacles.len(),
            possible: judged.map(|judged| judged.is_possible),
            possible_with_room: judged.map(|judged| judged.is_with_room),
            kidnapped: outcome.kidnapped.map(|(to, _)| [to.at.x, to.at.y]),
            right: judged.map(|judged| judged.is_right(outcome, radius)),
            // what was driven before it was carried off led elsewhere
            optimum: is_whole.and_then(|judged| judged.optimum_m),
            least_cost: is_whole.and_then(|judged| judged.least_cost),
            collided: outcome.overlap_m > TOUCH_M,
            miss: outcome.miss_m,
            worst_error: outcome.worst_error_m,
        };
        let ends = [mission.start.at, mission.goal];
        Self { truth: Some(truth), ..Self::of_trip(number, ends, &outcome.trip) }
    }

    /// How a mission went of which nobody knows more than the robot.
    pub fn of_trip(number: usize, [start, goal]: [Point; 2], trip: &Trip) -> Self {
        Self {
            mission: number,
            robot: None,
            start: [start.x, start.y],
            goal: [goal.x, goal.y],
            ending: ending(trip.ending),
            silence: None,
            length: trip.path_m(),
            by_state: BTreeMap::new(),
            paces: BTreeMap::new(),
            changes: trip.changes.len() as u32,
            cost: None,
            replans: trip.replans,
            detours: trip.detours,
            touches: trip.touches,
            seconds: trip.seconds,
            milliseconds: 0.0,
            truth: None,
        }
    }

    /// Whether it ended as it should, where that is judged.
    pub fn right(&self) -> Option<bool> {
        self.truth.as_ref().and_then(|truth| truth.right)
    }

    /// Whether it is known to have collided.
    pub fn has_collided(&self) -> bool {
        self.truth.as_ref().is_some_and(|truth| truth.collided)
    }

    /// How many times as far as the shortest path the robot went, or as hard as the best route; `None` where there is none, or
    /// where the robot began at its goal, or did not come there.
    pub fn over_optimum(&self) -> Option<f64> {
        let truth = self.truth.as_ref().filter(|_| self.ending == "arrived")?;
        if let (Some(cost), Some(least)) = (self.cost, truth.least_cost) {
            return (least > 0.0).then(|| cost / least);
        }
        truth.optimum.filter(|optimum| *optimum > 0.0).map(|optimum| self.length / optimum)
    }
}

/// Deeper than that is a collision, metres.
const TOUCH_M: f64 = 1e-6;

/// Missions drawn by chance; on each the robot is carried off once where `is_kidnapped`.
pub fn drawn(floor: &Floor, missions: usize, (seed, is_kidnapped): (u64, bool)) -> Result<Vec<Mission>> {
    let radius = floor.network.disc.radius;
    let of = |number: usize| {
        // Far apart, so that seeds that lie together give different missions.
        let seed = seed.wrapping_add((number as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let mut mission = draw(&floor.plan, &floor.network, radius, seed).ok_or_else(|| {
            let message = "the plan has no room for missions: start and goal need some metres between them";
            Error::said(Code::SimulateNoRoom, message, None)
        })?;
        if is_kidnapped {
            mission.kidnapping = draw_kidnapping(&floor.plan, radius, &mission);
        }
        Ok(mission)
    };
    (0..missions).map(of).collect()
}

/// Where missions are run: the world as it is, and as the robot knows it.
#[derive(Debug)]
pub struct Stage<'f> {
    truth: &'f Floor,
    walls: Vec<Segment>,
    building: Building,
    outfit: Outfit,
    /// Whether rules let the robot wherever there is room: who judges its missions knows of room alone.
    is_open: bool,
}

impl<'f> Stage<'f> {
    /// A world that the robot knows.
    pub fn new(floor: &'f Floor, judges: &Judges) -> Result<Self> {
        Self::learned(floor, floor, Outfit::default().start_sigma_m, judges)
    }

    /// A world of which the robot knows what was learned of it.
    ///
    /// # Arguments
    /// `start_sigma_m` is how sure it is of where it begins: the model is a little off.
    pub fn learned(truth: &'f Floor, known: &'f Floor, start_sigma_m: f64, judges: &Judges) -> Result<Self> {
        let outfit = Outfit { start_sigma_m, ..truth.driving.outfit(truth.network.disc.radius) };
        let walls = truth.plan.barriers().into_iter().map(Segment::from).collect();
        let is_open = judges.ask(|judge| {
            let mut weigh = |way| judge.weigh(&WayFacts { way, is_cut: false, times_blocked: 0 });
            Ok(known.network.ways.iter().all(|way| weigh(way).is_some()))
        })?;
        Ok(Self { truth, walls, building: known.building(), outfit, is_open })
    }
}

/// Runs missions on all cores; `done` is told of each. Rules that fail end it with an error.
pub fn run(
    stage: &Stage<'_>,
    judges: &Judges,
    missions: &[Mission],
    done: impl Fn() + Sync,
) -> Result<Vec<Row>> {
    let run = |(index, mission): (usize, &Mission)| {
        let row = judges.ask(|judge| judged(stage, judge, index + 1, mission, |_| {}, None));
        done();
        row
    };
    missions.par_iter().enumerate().map(run).collect()
}

/// Refuses what came of rules that failed, or did not say what they were asked.
pub fn refuse(trouble: Option<&str>) -> Result<()> {
    trouble.map_or(Ok(()), |trouble| Err(Error::said(Code::SimulateRules, trouble.to_owned(), None)))
}

/// Runs a mission and keeps all that happened, with the rule that decided it; `film` is made where it is wanted.
pub fn journalled(
    stage: &Stage<'_>,
    judges: &Judges,
    mission: (usize, &Mission),
    film: Option<&mut Option<Film>>,
) -> Result<Journal> {
    judges.ask(|judge| noted(stage, judge, mission, |_| {}, film))
}

/// A mission, all that happened, and for each decision the rule that spoke.
pub type Journal = (Row, Vec<Entry>, Vec<Option<Considered>>);

/// As [`journalled`], by one judge; `hear` is told what happens when it does.
pub fn noted<J: Considers>(
    stage: &Stage<'_>,
    judge: &mut J,
    (number, mission): (usize, &Mission),
    mut hear: impl FnMut(&Entry),
    film: Option<&mut Option<Film>>,
) -> Result<Journal> {
    let mut noting = Noting::new(judge);
    let mut entries = Vec::new();
    let journal = |entry: Entry| {
        hear(&entry);
        entries.push(entry);
    };
    let row = judged(stage, &mut noting, number, mission, journal, film)?;
    let decided = noting.decided;
    Ok((row, entries, decided))
}

fn judged(
    stage: &Stage<'_>,
    judge: &mut impl Judge,
    number: usize,
    mission: &Mission,
    journal: impl FnMut(Entry),
    film: Option<&mut Option<Film>>,
) -> Result<Row> {
    let before = Instant::now();
    let outcome = mission
        .run(&Drivable::of(&stage.walls, &stage.building), &stage.outfit, None, judge, journal, film)
        .map_err(Error::of(Code::SimulateImpossible))?;
    let milliseconds = before.elapsed().as_secs_f64() * 1e3;
    let radius = stage.truth.network.disc.radius;
    let from = outcome.kidnapped.map_or(mission.start, |(to, _)| to).at;
    let possible = mission.possible(from, &stage.truth.plan, radius).filter(|_| stage.is_open);
    let judged = possible.map(|possible| Judged {
        is_possible: possible.is_for_radius,
        is_with_room: possible.is_with_room,
        least_cost: None,
        optimum_m: possible.optimum_m,
    });
    Ok(Row { milliseconds, ..Row::new((number, mission), &outcome, judged, radius) })
}

impl Stage<'_> {
    /// The robot that would run a mission, where it begins.
    pub fn body(&self, mission: &Mission) -> Result<Simulator> {
        let on = Drivable::of(&self.walls, &self.building);
        mission.body(&on, &self.outfit).map_err(Error::of(Code::SimulateImpossible))
    }

    /// How far the sonar of that robot hears, and whether it has a skirt.
    pub const fn senses(&self) -> (f64, bool) {
        (self.outfit.robot.sonar_range_m, self.outfit.robot.has_skirt)
    }

    /// Has a robot drive to a goal of which nobody knows where it really is; `hear` is told what happens when it does.
    pub fn drive<J: Considers>(
        &self,
        judge: &mut J,
        number: usize,
        (start, goal): (Pose, Point),
        body: &mut Remote,
        mut hear: impl FnMut(&Entry),
    ) -> Journal {
        let before = Instant::now();
        let outfit = self.outfit.measuring(body.directions(), body.range_m());
        let mut noting = Noting::new(judge);
        let mut entries = Vec::new();
        let on = (std::slice::from_ref(&self.building), body.shape());
        let trip = trip(body, on, (start, goal), &outfit, None, &mut noting, |entry| {
            hear(&entry);
            entries.push(entry);
        });
        let row = Row {
            silence: body.silence().map(str::to_owned),
            milliseconds: before.elapsed().as_secs_f64() * 1e3,
            ..Row::of_trip(number, [start.at, goal], &trip)
        };
        (row, entries, noting.decided)
    }
}

/// What a robot did at the end, in words: after "it".
pub fn ended(ending: &str) -> &str {
    match ending {
        "no_way" => "found no way",
        "lost" => "did not know where it was",
        "silent" => "was not heard any more",
        "gave_up" => "gave up",
        other => other,
    }
}

/// The word for an ending, as rows and the journal have it.
pub const fn ending(ending: Ending) -> &'static str {
    match ending {
        Ending::Arrived => "arrived",
        Ending::NoWay => "no_way",
        Ending::Lost => "lost",
        Ending::Silent => "silent",
        Ending::OutOfPatience => "gave_up",
    }
}
