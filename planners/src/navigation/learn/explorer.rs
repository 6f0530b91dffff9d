//! Explores with a body: from opening to opening, until none is left that is worth a look.

use super::grid::Cells;
use super::ground::{Frontier, Ground, LookOut};
use super::joints::joined;
use super::learned::Learned;
use super::opening::{Guide, OpeningFacts};
use super::pieces::pieces;
use super::seen::Seen;
use crate::body::Body;
use crate::geometry::{Point, Segment};
use crate::local_model::{self, Estimate};
use crate::navigation::{Building, Ending, Event, Navigator, Settings};
use crate::pose::{Pose, wrapped};

/// The robot goes so far before it looks around and thinks again, metres.
const STEP_M: f64 = 1.5;

/// A grid does not know its distances better, metres.
const GRID_M: f64 = 0.02;

/// From so near it looks into an opening at first, and after it was there in vain, metres.
const LOOK_M: [f64; 2] = [1.5, 0.8];

/// Openings so near to one another are the same one, metres.
const SAME_M: f64 = 0.4;

/// So near to a look-out it is there, metres.
const THERE_M: f64 = 0.15;

/// After so long an exploration is given up, seconds.
const PATIENCE_S: f64 = 6.0 * 3600.0;

/// An opening that the robot is on its way to.
#[derive(Clone, Copy, Debug)]
struct Target {
    at: Point,
    look_out: Point,
    /// Where the robot went off.
    from: Point,
}

#[derive(Clone, Debug)]
pub struct Explorer<'b> {
    navigator: Navigator<'b>,
    start: Point,
    reach_m: f64,
    radius_m: f64,
    /// The direction that the user asked for, radians.
    towards: Option<f64>,
    target: Option<Target>,
    tried: Vec<(Point, u32)>,
    odometer_m: f64,
    last: Option<Pose>,
    /// The middles of the openings when they were last looked for.
    openings: Vec<Point>,
}

impl<'b> Explorer<'b> {
    /// An explorer for a body that was just switched on.
    ///
    /// # Arguments
    /// `nothing` is the building as it is known: [`Building::unknown`].
    pub fn new(
        nothing: &'b Building,
        model: local_model::Settings,
        settings: Settings,
        start: Estimate,
    ) -> Self {
        let radius_m = nothing.network.disc.radius;
        let reach_m = radius_m + settings.detour_clearance_m + GRID_M;
        let model = local_model::Settings { is_learning: true, ..model };
        let mut navigator = Navigator::new(nothing, model, settings, start);
        navigator.learn();
        // The first scan is taken where the robot stands.
        navigator.go_along(vec![start.pose.at]);
        Self {
            navigator,
            start: start.pose.at,
            reach_m,
            radius_m,
            towards: None,
            target: None,
            tried: Vec::new(),
            odometer_m: 0.0,
            last: None,
            openings: Vec::new(),
        }
    }

    /// Points out the direction in which to go on: towards a point as seen from where the robot is. `None` takes it back.
    pub fn point_out(&mut self, towards: Option<Point>) {
        let at = self.navigator.estimate().pose.at;
        self.towards = towards.map(|towards| (towards - at).angle());
        self.target = None;
    }

    /// What drives the robot, with its local model and the estimated pose.
    pub fn navigator(&self) -> &Navigator<'b> {
        &self.navigator
    }

    /// The middles of the openings when they were last looked for.
    pub fn openings(&self) -> &[Point] {
        &self.openings
    }

    /// What happened since this was last asked.
    pub fn take_events(&mut self) -> Vec<Event> {
        self.navigator.take_events()
    }

    /// Waits for the next reading, and does what is next.
    ///
    /// # Returns
    /// [`Ending::Arrived`] when no opening is left that is worth a look.
    pub fn step(&mut self, body: &mut impl Body, guide: &mut impl Guide) -> Option<Ending> {
        let ending = self.navigator.step(body, guide);
        let odometry = self.navigator.odometry();
        self.odometer_m += self.last.map_or(0.0, |last| last.at.distance(odometry.at));
        self.last = Some(odometry);
        if self.navigator.time_s() > PATIENCE_S {
            self.navigator.manual(body);
            return Some(Ending::OutOfPatience);
        }
        let ending = ending?;
        self.note(ending);
        let legs = self.next(guide);
        if legs.is_empty() {
            return Some(Ending::Arrived);
        }
        self.navigator.go_along(legs);
        None
    }

    /// The global model so far, with what is free of it.
    pub fn learned(&self) -> Learned {
        let walls = pieces(&joined(&self.navigator.surfaces()));
        Learned::new(self.start, self.radius_m, &self.ground(&walls), &walls)
    }

    fn ground(&self, walls: &[Segment]) -> Ground {
        let nothing = Cells::default();
        let seen = self.navigator.seen().map_or(&nothing, Seen::free);
        Ground::new(seen, walls, self.navigator.estimate().pose.at, self.reach_m)
    }

    /// Counts an attempt: the robot cannot get there, or it was there.
    fn note(&mut self, ending: Ending) {
        let at = self.navigator.estimate().pose.at;
        let Some(target) = self.target else { return };
        let is_near = at.distance(target.look_out) <= THERE_M;
        let is_stuck = ending != Ending::Arrived && at.distance(target.from) <= THERE_M;
        if is_near || is_stuck {
            match self.tried.iter_mut().find(|(known, _)| known.distance(target.at) <= SAME_M) {
                Some((_, times)) => *times += 1,
                None => self.tried.push((target.at, 1)),
            }
            self.target = None;
        }
    }

    /// The next points to go to; none where nothing is worth a look.
    fn next(&mut self, guide: &mut impl Guide) -> Vec<Point> {
        let walls = joined(&self.navigator.surfaces());
        let ground = self.ground(&walls);
        let frontiers = ground.frontiers();
        self.openings = frontiers.iter().map(|frontier| frontier.middle).collect();
        if let Some(target) = self.target {
            // It goes on to where it was going for as long as there is something to see.
            let same = frontiers.iter().find(|frontier| frontier.middle.distance(target.at) <= SAME_M);
            if let Some((frontier, look_out)) =
                same.and_then(|frontier| Some((frontier, self.look_out(&ground, frontier)?)))
            {
                return self.set_off(&ground, &walls, frontier, look_out);
            }
        }
        let mut best: Option<(f64, &Frontier, LookOut)> = None;
        for frontier in &frontiers {
            let Some(look_out) = self.look_out(&ground, frontier) else { continue };
            if let Some(worth) = guide.opening(&self.facts(&ground, frontier, look_out))
                && best.is_none_or(|(most, ..)| worth > most)
            {
                best = Some((worth, frontier, look_out));
            }
        }
        best.map_or_else(Vec::new, |(_, frontier, look_out)| {
            self.set_off(&ground, &walls, frontier, look_out)
        })
    }

    fn look_out(&self, ground: &Ground, frontier: &Frontier) -> Option<LookOut> {
        ground.look_out(frontier, LOOK_M[usize::from(self.times_tried(frontier) > 0)])
    }

    fn times_tried(&self, frontier: &Frontier) -> u32 {
        let same = self.tried.iter().find(|(known, _)| known.distance(frontier.middle) <= SAME_M);
        same.map_or(0, |(_, times)| *times)
    }

    fn facts(&self, ground: &Ground, frontier: &Frontier, look_out: LookOut) -> OpeningFacts {
        let at = self.navigator.estimate().pose.at;
        let direction = (frontier.middle - at).angle();
        OpeningFacts {
            width_m: frontier.width_m,
            distance_m: look_out.distance_m,
            off_asked: self.towards.map(|towards| wrapped(direction - towards).abs()),
            is_in_sight: ground.is_open(at, frontier.middle),
            times_tried: self.times_tried(frontier),
            time_s: self.navigator.time_s(),
            driven_m: self.odometer_m,
            radius_m: self.radius_m,
        }
    }

    /// The first part of the way to a look-out.
    fn set_off(
        &mut self,
        ground: &Ground,
        walls: &[Segment],
        frontier: &Frontier,
        look_out: LookOut,
    ) -> Vec<Point> {
        let at = self.navigator.estimate().pose.at;
        let way = ground.way(at, look_out, walls, self.reach_m - GRID_M);
        self.target = way.last().map(|last| Target { at: frontier.middle, look_out: *last, from: at });
        let (mut legs, mut from, mut left) = (Vec::new(), at, STEP_M);
        for point in way {
            let far = from.distance(point);
            if far > left {
                let share = left / far;
                legs.push(from.lerp(point, share));
                break;
            }
            legs.push(point);
            (from, left) = (point, left - far);
        }
        legs
    }
}
