//! Where among known walls a scan was taken.
//!
//! A scan of a robot that stands is compared with what its beams would meet at a pose. At one pose that says whether the robot
//! can be there ([`Recognition`]); at all places of a building it says where it can be, whatever was thought before: views
//! from places in a raster are turned by one beam after the other, and what looks alike is drawn to where it fits best.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, RowVector3, Vector3};

use super::{Estimate, Settings};
use crate::body::Reading;
use crate::geometry::{Point, RayGrid, Rect, Segment};
use crate::pose::{Pose, wrapped};

/// Views are taken from places so far apart, metres; farther where that would be more places than so many.
const RASTER_M: f64 = 0.5;
const MOST_PLACES: f64 = 50_000.0;

/// Beams of a view.
const VIEW: usize = 120;

/// Besides its own error, an echo of a known wall is off by so much: walls are not quite where they are said to be, metres.
const WALL_M: f64 = 0.03;

/// A beam past an edge says nothing: it is taken to go as far as the farthest of those so far beside it, radians.
const BESIDE: f64 = PI / 120.0;

/// Beyond a wall by more than this, a beam has run through it, metres.
const THROUGH_M: f64 = 0.3;

/// So near to where a wall is expected, a beam ends on it, metres.
const ON_M: f64 = 0.15;

/// From one place so many headings are tried: those that are next to the best are nearly as likely.
const HEADINGS: usize = 4;

/// So many of the likeliest views are looked at closely.
const CLOSELY: usize = 150;

/// Steps in which a pose is drawn to where a scan fits best.
const STEPS: usize = 12;

/// Poses that differ by less are one: metres, radians.
const SAME_M: f64 = 0.3;
const SAME_ANGLE: f64 = 0.15;

/// A pose whose likelihood is less by a larger factor (its logarithm) is not possible beside a likelier one.
const UNLIKELY: f64 = 8.0;

/// Beams that meet one thing are off together: a scan counts as if so large a share of them said something of their own.
const CREDIT: f64 = 0.25;

/// A pose at which more beams side by side run through known walls than at another one is not possible beside it.
const CONTRADICTED: usize = 3;

/// What comes back of a beam that should meet a wall: an echo of it; one of something before it; one from anywhere.
const HIT: f64 = 0.75;
const BEFORE: f64 = 0.2;
const ANYWHERE: f64 = 0.02;

/// Logarithms of how likely no echo is where there should be one (0.03), and where there should be none (0.8).
const LN_MISSED: f64 = -3.5;
const LN_NOTHING: f64 = -0.22;

/// Of the beams of a scan every third one is compared with views: there are many.
const OF_VIEWS: usize = 3;

/// Where a smaller share of the beams ends on known walls, things that nobody knows may look like them.
const TELLING: f64 = 0.25;

/// How well a scan agrees with the known walls at a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Recognition {
    /// Share of the beams that end on the known walls.
    pub explained: f64,
    /// Share of the beams that end before the known walls, or where none is.
    pub unexplained: f64,
    /// The most beams side by side that run through known walls.
    pub contradicted: usize,
}

/// Known walls, and the places from which a robot can see them.
#[derive(Clone, Debug)]
pub struct KnownWalls {
    walls: RayGrid,
    /// Made when first asked for: places with what is seen from there, a beam each.
    views: Vec<View>,
    /// How far apart the places are, metres.
    raster_m: f64,
}

#[derive(Clone, Debug)]
struct View {
    at: Point,
    /// Metres; beyond hearing, infinite.
    ranges_m: Vec<f32>,
    /// Standard deviation of the position that a scan from there leaves, metres; infinite where it tells none.
    sigma_m: f64,
}

/// Where the robot is thought to be, with the inverse of its covariance.
struct Thought {
    pose: Pose,
    inverse: Matrix3<f64>,
}

/// A beam as the robot has it.
#[derive(Clone, Copy, Debug)]
struct Ray {
    bearing: f64,
    range_m: Option<f64>,
    sigma_m: f64,
    /// The beam of a view that goes where this one does.
    beam: usize,
    /// The logarithm of the density, by the metre, of an echo just where it should come from.
    peak: f64,
}

/// A scan of a robot that stands.
#[derive(Clone, Debug)]
pub struct Scan {
    rays: Vec<Ray>,
    reach_m: f64,
    /// Logarithms of densities by the metre: of an echo from before where it should come from, and of one from anywhere.
    before: f64,
    anywhere: f64,
}

/// A pose at which a scan may have been taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The pose that fits best, and how sure the scan alone makes of it.
    pub estimate: Estimate,
    /// The logarithm of its likelihood, up to what all have in common.
    pub likelihood: f64,
}

impl Scan {
    pub fn new(readings: &[Reading], settings: &Settings) -> Self {
        let ray = |reading: &Reading| {
            let range_m = reading.range_m.unwrap_or(settings.sonar_range_m);
            Ray::new(reading.bearing, reading.range_m, sigma_m(range_m, settings))
        };
        let reach_m = settings.sonar_range_m;
        let (before, anywhere) = (((BEFORE + ANYWHERE) / reach_m).ln(), (ANYWHERE / reach_m).ln());
        Self { rays: readings.iter().map(ray).collect(), reach_m, before, anywhere }
    }

    /// Some of its beams, for comparison with what would be seen up to so many metres away.
    fn blurred(&self, blur_m: f64) -> Self {
        let some = self.rays.iter().step_by(OF_VIEWS);
        let blurred = some.map(|ray| Ray::new(ray.bearing, ray.range_m, ray.sigma_m.hypot(blur_m)));
        Self { rays: blurred.collect(), ..*self }
    }

    /// The logarithm of how likely it is where its beams should go so far.
    fn likelihood(&self, expected_m: impl Fn(&Ray) -> f64) -> f64 {
        let elsewhere = [self.before, self.anywhere];
        CREDIT * self.rays.iter().map(|ray| ray.likelihood(expected_m(ray), elsewhere)).sum::<f64>()
    }
}

/// Standard deviation of an echo of a known wall, metres.
fn sigma_m(range_m: f64, settings: &Settings) -> f64 {
    (settings.range_noise * range_m).hypot(settings.range_noise_m).hypot(WALL_M)
}

impl Ray {
    fn new(bearing: f64, range_m: Option<f64>, sigma_m: f64) -> Self {
        let beam = (bearing / TAU * VIEW as f64).round().rem_euclid(VIEW as f64) as usize;
        let peak = (HIT / (sigma_m * TAU.sqrt())).ln();
        Self { bearing, range_m, sigma_m, beam, peak }
    }

    /// The logarithm of how likely this is of a beam that should go so far, infinitely where it should meet nothing. Of an
    /// echo the likelier cause counts alone, which saves an exponential in the innermost loop.
    fn likelihood(&self, expected_m: f64, [before, anywhere]: [f64; 2]) -> f64 {
        let Some(range_m) = self.range_m else {
            return if expected_m.is_finite() { LN_MISSED } else { LN_NOTHING };
        };
        let off = (range_m - expected_m) / self.sigma_m;
        let other = if range_m < expected_m { before } else { anywhere };
        (self.peak - 0.5 * off * off).max(other)
    }
}

impl KnownWalls {
    pub fn new(walls: Vec<Segment>) -> Self {
        let bounds = Rect::around(walls.iter().flat_map(|wall| [wall.a, wall.b]));
        let raster_m = (bounds.dx() * bounds.dy() / MOST_PLACES).sqrt().max(RASTER_M);
        Self { walls: RayGrid::new(walls), views: Vec::new(), raster_m }
    }

    pub fn is_empty(&self) -> bool {
        self.walls.segments().is_empty()
    }

    /// Takes the views from all places that are free, if they were not taken yet.
    ///
    /// # Arguments
    /// `is_free` says whether a robot may stand somewhere, walls aside; `radius_m` is kept from them.
    pub fn look_from(&mut self, is_free: impl Fn(Point) -> bool, radius_m: f64, settings: &Settings) {
        if !self.views.is_empty() || self.is_empty() {
            return;
        }
        let bounds = Rect::around(self.walls.segments().iter().flat_map(|wall| [wall.a, wall.b]));
        let count = |length: f64| (length / self.raster_m) as usize;
        for row in 0..=count(bounds.dy()) {
            for column in 0..=count(bounds.dx()) {
                let step = Point::new(column as f64 + 0.5, row as f64 + 0.5) * self.raster_m;
                let at = Point::new(bounds.x0, bounds.y0) + step;
                let is_clear = !self.walls.around(at, radius_m).any(|wall| wall.distance(at) < radius_m);
                if is_clear && is_free(at) {
                    let view = self.view(at, settings);
                    self.views.push(view);
                }
            }
        }
    }

    fn view(&self, at: Point, settings: &Settings) -> View {
        let mut information = nalgebra::Matrix2::zeros();
        let ranges_m = (0..VIEW).map(|beam| {
            let towards = Point::towards(TAU * beam as f64 / VIEW as f64);
            let Some(echo) = self.walls.cast(at, towards, settings.sonar_range_m) else {
                return f32::INFINITY;
            };
            let across = self.walls.segments()[echo.segment].direction().perpendicular();
            let row = nalgebra::RowVector2::new(across.x, across.y);
            let deviation = (sigma_m(echo.distance, settings) * across.dot(towards)).abs().max(WALL_M);
            let variance = deviation.powi(2) / CREDIT;
            information += row.transpose() * row / variance;
            echo.distance as f32
        });
        let ranges_m = ranges_m.collect();
        let (mean, half) = (
            f64::midpoint(information[(0, 0)], information[(1, 1)]),
            f64::midpoint(information[(0, 0)], -information[(1, 1)]).hypot(information[(0, 1)]),
        );
        View { at, ranges_m, sigma_m: (mean - half).max(0.0).powf(-0.5) }
    }

    /// Places from which a scan leaves a standard deviation of the position of at most so many metres.
    pub fn telling(&self, sigma_m: f64) -> impl Iterator<Item = Point> {
        self.views.iter().filter(move |view| view.sigma_m <= sigma_m).map(|view| view.at)
    }

    /// How far a beam goes; infinitely where it meets nothing within hearing.
    fn range_m(&self, pose: &Pose, bearing: f64, reach_m: f64) -> f64 {
        let echo = self.walls.cast(pose.at, pose.direction(bearing), reach_m);
        echo.map_or(f64::INFINITY, |echo| echo.distance)
    }

    /// How well a scan agrees with the known walls at a pose.
    pub fn recognise(&self, scan: &Scan, pose: &Pose) -> Recognition {
        let (mut run, mut contradicted, mut explained, mut unexplained) = (0, 0, 0, 0);
        for ray in &scan.rays {
            let range_m = ray.range_m.unwrap_or(f64::INFINITY);
            let (mut near, mut far) = (f64::INFINITY, 0.0_f64);
            // whatever else is beside it, where it ends is explained once something is there
            let is_on = [0.0, -BESIDE, BESIDE].into_iter().any(|by| {
                let expected_m = self.range_m(pose, ray.bearing + by, scan.reach_m);
                (near, far) = (near.min(expected_m), far.max(expected_m));
                near < scan.reach_m && range_m > near - ON_M && range_m < far + ON_M
            });
            explained += usize::from(is_on);
            run = if far < scan.reach_m && range_m > far + THROUGH_M { run + 1 } else { 0 };
            contradicted = contradicted.max(run);
            unexplained += usize::from(ray.range_m.is_some() && range_m < near - THROUGH_M);
        }
        let share = |of: usize, all: usize| of as f64 / all.max(1) as f64;
        let [explained, unexplained] = [explained, unexplained].map(|of| share(of, scan.rays.len()));
        Recognition { explained, unexplained, contradicted }
    }

    /// Where a scan may have been taken, the likeliest first: all poses that are not much less likely than that one; none
    /// where the scan shows too little of the known walls to tell.
    ///
    /// # Arguments
    /// `prior` is where the robot is thought to be; without it, it may be anywhere. `also` are poses worth a close look.
    pub fn locate(
        &self,
        scan: &Scan,
        prior: Option<&Estimate>,
        also: &[Pose],
        settings: &Settings,
    ) -> Vec<Candidate> {
        let thought = prior.and_then(Thought::new);
        let blurred = scan.blurred(self.raster_m / 2.0);
        let mut begun: Vec<(f64, Pose)> = Vec::new();
        for view in &self.views {
            if prior.is_some_and(|prior| !prior.may_be_at(view.at, settings.match_sigmas, self.raster_m)) {
                continue;
            }
            let turned = (0..VIEW).map(|turn| {
                let pose = Pose { at: view.at, heading: wrapped(TAU * turn as f64 / VIEW as f64) };
                let thought = thought.as_ref().map_or(0.0, |thought| thought.likelihood(&pose));
                (view.likelihood(&blurred, turn) + thought, pose)
            });
            let mut turned: Vec<(f64, Pose)> = turned.collect();
            turned.select_nth_unstable_by(HEADINGS, |a, b| b.0.total_cmp(&a.0));
            begun.extend(&turned[..HEADINGS]);
        }
        begun.sort_by(|a, b| b.0.total_cmp(&a.0));
        // Where much looks alike, some of it from everywhere stands for what is not among the likeliest.
        let best = begun.first().map_or(0.0, |best| best.0);
        let alike = begun.partition_point(|(likelihood, _)| *likelihood > best - UNLIKELY);
        let (likeliest, others) = begun.split_at(CLOSELY.min(begun.len()));
        let others = others.iter().step_by(alike.div_ceil(CLOSELY).max(1)).take(CLOSELY);
        let begun = likeliest.iter().chain(others).map(|(_, pose)| *pose);
        let poses = also.iter().copied().chain(begun);
        self.possible(scan, poses, thought.as_ref())
    }

    /// Which of some poses a scan may have been taken at, as [`Self::locate`] has them.
    pub fn among(&self, scan: &Scan, poses: &[Pose]) -> Vec<Candidate> {
        self.possible(scan, poses.iter().copied(), None)
    }

    fn possible(
        &self,
        scan: &Scan,
        poses: impl Iterator<Item = Pose>,
        thought: Option<&Thought>,
    ) -> Vec<Candidate> {
        let mut found: Vec<Candidate> = Vec::new();
        let mut drawn: Vec<Candidate> = poses.map(|pose| self.drawn(scan, pose, thought)).collect();
        drawn.sort_by(|a, b| b.likelihood.total_cmp(&a.likelihood));
        for one in drawn {
            let best = found.first().map_or(one.likelihood, |best| best.likelihood);
            let is_same = |other: &Candidate| {
                let (a, b) = (&one.estimate.pose, &other.estimate.pose);
                a.at.distance(b.at) < SAME_M && wrapped(a.heading - b.heading).abs() < SAME_ANGLE
            };
            if one.likelihood >= best - UNLIKELY && !found.iter().any(is_same) {
                found.push(one);
            }
        }
        let recognised: Vec<Recognition> =
            found.iter().map(|one| self.recognise(scan, &one.estimate.pose)).collect();
        let least = recognised.iter().map(|one| one.contradicted).min().unwrap_or(0);
        let is_possible = |one: &Recognition| one.contradicted <= least + CONTRADICTED;
        let mut possible = recognised.iter().map(is_possible);
        found.retain(|_| possible.next().unwrap_or(true));
        if recognised.first().is_none_or(|best| best.explained < TELLING) {
            found.clear();
        }
        found
    }

    /// The pose to which a scan draws another one (Gauss-Newton over the beams), with its covariance.
    fn drawn(&self, scan: &Scan, pose: Pose, thought: Option<&Thought>) -> Candidate {
        let mut pose = pose;
        let mut information = Matrix3::zeros();
        for step in 0..STEPS {
            // from far off at first, then by what is near alone
            let gate_m = (self.raster_m / (step + 1) as f64).max(4.0 * WALL_M);
            let mut weighted = Vector3::zeros();
            information = Matrix3::zeros();
            if let Some(thought) = thought {
                information += thought.inverse;
                weighted += thought.inverse * thought.off(&pose);
            }
            for ray in &scan.rays {
                let (Some(range_m), towards) = (ray.range_m, pose.direction(ray.bearing)) else { continue };
                let Some(echo) = self.walls.cast(pose.at, towards, scan.reach_m + gate_m) else { continue };
                let across = self.walls.segments()[echo.segment].direction().perpendicular();
                let approach = towards.dot(across);
                let difference = (echo.distance - range_m) * approach;
                if difference.abs() > gate_m || approach.abs() < 0.1 {
                    continue;
                }
                let hit = towards * range_m;
                let row = RowVector3::new(across.x, across.y, hit.cross(across));
                let variance = (ray.sigma_m * approach).abs().max(WALL_M).powi(2) / CREDIT;
                information += row.transpose() * row / variance;
                weighted += row.transpose() * (difference / variance);
            }
            let damped = information + Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1.0));
            let Some(by) = damped.try_inverse().map(|inverse| inverse * weighted) else { break };
            pose = Pose { at: pose.at + Point::new(by.x, by.y), heading: wrapped(pose.heading + by.z) };
        }
        let likelihood = scan.likelihood(|ray| self.range_m(&pose, ray.bearing, scan.reach_m))
            + thought.map_or(0.0, |thought| thought.likelihood(&pose));
        let vague = Matrix3::from_diagonal(&Vector3::new(1e-4, 1e-4, 1e-4));
        let covariance = (information + vague).try_inverse().unwrap_or_else(Matrix3::identity);
        Candidate { estimate: Estimate::placed(pose, covariance), likelihood }
    }
}

impl Thought {
    fn new(estimate: &Estimate) -> Option<Self> {
        Some(Self { pose: estimate.pose, inverse: estimate.covariance.try_inverse()? })
    }

    /// What has to be added to a pose to come to this one.
    fn off(&self, pose: &Pose) -> Vector3<f64> {
        let off = self.pose.at - pose.at;
        Vector3::new(off.x, off.y, wrapped(self.pose.heading - pose.heading))
    }

    /// The logarithm of the density of a pose, less that of the most likely one.
    fn likelihood(&self, pose: &Pose) -> f64 {
        let off = self.off(pose);
        -0.5 * off.dot(&(self.inverse * off))
    }
}

impl View {
    /// As [`Scan::likelihood`] for a robot here that is turned by so many beams.
    fn likelihood(&self, scan: &Scan, turn: usize) -> f64 {
        scan.likelihood(|ray| f64::from(self.ranges_m[(ray.beam + turn) % VIEW]))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The same with all beams beside a beam, whatever lies ahead.
    fn recognised(walls: &KnownWalls, scan: &Scan, pose: &Pose) -> Recognition {
        let (mut run, mut contradicted, mut explained, mut unexplained) = (0, 0, 0, 0);
        for ray in &scan.rays {
            let beside = [-BESIDE, 0.0, BESIDE].map(|by| walls.range_m(pose, ray.bearing + by, scan.reach_m));
            let (near, far) =
                beside.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), p| (a.min(*p), b.max(*p)));
            let range_m = ray.range_m.unwrap_or(f64::INFINITY);
            run = if far < scan.reach_m && range_m > far + THROUGH_M { run + 1 } else { 0 };
            contradicted = contradicted.max(run);
            unexplained += usize::from(ray.range_m.is_some() && range_m < near - THROUGH_M);
            let is_on = near < scan.reach_m && range_m > near - ON_M && range_m < far + ON_M;
            explained += usize::from(is_on);
        }
        let [explained, unexplained] = [explained, unexplained].map(|of| of as f64 / scan.rays.len() as f64);
        Recognition { explained, unexplained, contradicted }
    }

    proptest! {
        #[test]
        fn what_a_beam_meets_tells_what_those_beside_it_would(
            ends in prop::collection::vec((-4.0..4.0, -4.0..4.0, -4.0..4.0, -4.0..4.0), 1..12),
            off_m in prop::collection::vec(prop::option::of(-0.6..0.6), 120),
        ) {
            let wall = |(x0, y0, x1, y1)| Segment::new(Point::new(x0, y0), Point::new(x1, y1));
            let walls = KnownWalls::new(ends.into_iter().map(wall).collect());
            let (pose, settings) = (Pose::default(), Settings::default());
            let reading = |(i, off_m): (usize, Option<f64>)| {
                let bearing = TAU * i as f64 / VIEW as f64;
                let range_m = off_m.map(|off_m| walls.range_m(&pose, bearing, 5.0).min(5.0) + off_m);
                Reading { bearing, range_m, odometry: pose }
            };
            let readings: Vec<Reading> = off_m.into_iter().enumerate().map(reading).collect();
            let scan = Scan::new(&readings, &settings);
            prop_assert_eq!(walls.recognise(&scan, &pose), recognised(&walls, &scan, &pose));
        }
    }
}
