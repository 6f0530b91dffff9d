//! Where the robot is: whether what it sees can be seen from there, where else it may be, and where it can be told.

use std::cmp::Ordering;

use super::Navigator;
use crate::body::Reading;
use crate::geometry::{Point, path_length, polygon};
use crate::local_model::{Candidate, Estimate, KnownWalls, LocalModel, Recognition, Scan};
use crate::navigation::cuts::Blocked;
use crate::navigation::event::Happening;
use crate::navigation::judge::{Judge, Mode};
use crate::navigation::known::{Building, Memory};
use crate::navigation::route::over_network;
use crate::pose::{Pose, wrapped};

/// A place from which the robot can tell where it is leaves a standard deviation of the position of at most so much, metres.
const TELLING_M: f64 = 0.03;

/// To so many of the nearest of these places a path is looked for.
const NEAREST: usize = 6;

/// Places nearer to one that did not help do not help either, metres.
const ELSEWHERE_M: f64 = 2.0;

/// A pose that is thought possible is still so where it is found again so near: metres, radians.
const AGAIN_M: f64 = 1.0;
const AGAIN_ANGLE: f64 = 0.35;

/// Poses whose likelihoods (their logarithms) differ by less are alike.
const ALIKE: f64 = 2.0;

/// By less the surfaces of the local model are not misplaced: metres, radians.
const KEPT_M: f64 = 0.1;
const KEPT_ANGLE: f64 = 0.05;

/// What is known of where the robot is, besides the estimate.
#[derive(Clone, Debug)]
pub(super) struct Whereabouts {
    walls: KnownWalls,
    /// The last whole scan, and the wheels' count where it was taken.
    scan: Option<(Scan, Pose)>,
    pub recognition: Recognition,
    /// Whether the poses were looked for at which the last whole scan may have been taken: as the estimate has it, anywhere.
    pub is_matched: bool,
    pub is_searched: bool,
    /// Where it may have been when last looked for, and the wheels' count there.
    poses: (Pose, Vec<Pose>),
    /// Times that it was looked for over the whole building since the goal was given.
    pub searches: u32,
    /// Where the robot goes before its goal, to find out where it is.
    pub aside: Option<Point>,
    /// Where it went for that since the goal was given.
    pub sought: Vec<Point>,
}

impl Whereabouts {
    pub fn new(building: &Building) -> Self {
        Self {
            walls: KnownWalls::new(building.walls.clone()),
            scan: None,
            recognition: Recognition::default(),
            is_matched: false,
            is_searched: false,
            poses: (Pose::default(), Vec::new()),
            searches: 0,
            aside: None,
            sought: Vec::new(),
        }
    }

    /// A goal was given.
    pub fn begin(&mut self) {
        (self.searches, self.aside) = (0, None);
        self.sought.clear();
    }

    pub fn has_walls(&self) -> bool {
        !self.walls.is_empty()
    }
}

impl Navigator<'_> {
    /// Takes note of a whole scan.
    pub(super) fn recognise(&mut self, readings: &[Reading]) {
        let (pose, odometry) = (self.pose(), self.odometry());
        let of = &mut self.whereabouts;
        let scan = Scan::new(readings, self.model.settings());
        of.recognition = of.walls.recognise(&scan, &pose);
        (of.scan, of.is_matched, of.is_searched) = (Some((scan, odometry)), false, false);
    }

    /// Looks for the poses at which the last whole scan may have been taken: over the whole building, or as the estimate has it.
    pub(super) fn locate(&mut self, is_anywhere: bool, judge: &mut impl Judge) {
        self.take_views();
        let (odometry, now) = (self.odometry(), *self.model.estimate());
        let of = &mut self.whereabouts;
        of.is_matched = true;
        of.is_searched |= is_anywhere;
        of.searches += u32::from(is_anywhere);
        let Some((scan, taken)) = &of.scan else { return };
        let taken = *taken;
        let estimate = Estimate { pose: now.pose.then(&odometry.to(&taken)), ..now };
        let step = of.poses.0.to(&taken);
        let before: Vec<Pose> = of.poses.1.iter().map(|pose| pose.then(&step)).collect();
        let also: Vec<Pose> = before.iter().chain([&estimate.pose]).copied().collect();
        let prior = (!is_anywhere).then_some(&estimate);
        let mut found = if before.len() > 1 && !is_anywhere {
            // no covariance is that of several poses
            of.walls.among(scan, &before)
        } else {
            of.walls.locate(scan, prior, &also, self.model.settings())
        };
        let is_again = |candidate: &Candidate| {
            before.iter().any(|pose| is_near(pose, &candidate.estimate.pose, AGAIN_M, AGAIN_ANGLE))
        };
        if before.len() > 1 && found.iter().any(is_again) {
            found.retain(is_again);
        }
        // Of poses that are alike the one is taken for which the robot has been displaced least.
        let best = found.first().map_or(0.0, |best| best.likelihood);
        let far = |candidate: &Candidate| {
            let is_alike = candidate.likelihood > best - ALIKE;
            (!is_alike, candidate.estimate.pose.at.distance(estimate.pose.at))
        };
        found.sort_by(|a, b| far(a).partial_cmp(&far(b)).unwrap_or(Ordering::Equal));
        let Some(nearest) = found.first() else { return };
        let located = nearest.estimate.among(found.iter().map(|candidate| &candidate.estimate.pose));
        of.recognition = of.walls.recognise(scan, &located.pose);
        let poses: Vec<Pose> = found.iter().map(|candidate| candidate.estimate.pose).collect();
        self.tell(Happening::Located { poses: poses.clone(), is_anywhere });
        self.whereabouts.poses = (taken, poses);
        // the robot may have gone on since it was there
        let mut since = LocalModel::new(*self.model.settings(), located);
        since.reckon(&taken);
        since.set_estimate(located);
        since.reckon(&odometry);
        let located = *since.estimate();
        self.place(located, judge);
    }

    /// Goes on from another pose. What was met is forgotten where it was put by a pose that was wrong.
    fn place(&mut self, located: Estimate, judge: &mut impl Judge) {
        let is_kept = is_near(&self.pose(), &located.pose, KEPT_M, KEPT_ANGLE);
        if is_kept {
            let relative = self.model.estimate().relative;
            self.model.set_estimate(Estimate { relative, ..located });
            return;
        }
        self.model = LocalModel::new(*self.model.settings(), located);
        if let Some(sensed) = &self.sensed {
            self.model.reckon(&sensed.odometry);
            self.model.set_estimate(located);
        }
        self.memory = Memory::default();
        self.blocked = Blocked::new(&self.building.network);
        self.felt.clear();
        self.track.clear();
        self.gather();
        self.plan(judge, false);
    }

    /// Goes where known walls tell where it is, before it goes on to its goal.
    pub(super) fn seek(&mut self, judge: &mut impl Judge) {
        self.take_views();
        let at = self.pose().at;
        let of = &self.whereabouts;
        let is_new = |place: &Point| of.sought.iter().all(|tried| tried.distance(*place) >= ELSEWHERE_M);
        let mut places: Vec<Point> = of.walls.telling(TELLING_M).filter(is_new).collect();
        places.sort_by(|a, b| a.distance(at).total_cmp(&b.distance(at)));
        let barriers = &self.barriers[..self.obstacles_from];
        let route = |place: &Point| {
            over_network(self.building, self.ground(barriers), &self.blocked, [at, *place], judge)
                .map(|route| (path_length(&route.points), *place))
        };
        let nearest = if self.mode == Mode::Route {
            // the way there is somebody else's to find
            places.first().copied()
        } else {
            let ways = places.iter().take(NEAREST).filter_map(route);
            ways.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
        };
        self.whereabouts.sought.push(nearest.unwrap_or(at));
        if let Some(place) = nearest {
            self.whereabouts.aside = nearest;
            self.tell(Happening::Sought(place));
            self.plan(judge, false);
        }
    }

    /// Goes on to its goal.
    pub(super) fn resume(&mut self, judge: &mut impl Judge) {
        self.whereabouts.aside = None;
        self.plan(judge, false);
    }

    fn take_views(&mut self) {
        let regions = &self.building.network.regions.regions;
        let floor = &self.building.floor;
        let is_free = |at: Point| {
            regions.iter().any(|region| region.contains(at))
                || floor.iter().any(|piece| polygon::is_in_convex(piece, at, 0.0))
        };
        self.whereabouts.walls.look_from(is_free, self.rim.inner_m(), self.model.settings());
    }
}

fn is_near(a: &Pose, b: &Pose, far_m: f64, turned: f64) -> bool {
    a.at.distance(b.at) <= far_m && wrapped(a.heading - b.heading).abs() <= turned
}
