//! Missions along ways that a knowledge base finds: for robots that change their shape, among walls, what hangs low, and what
//! nobody told them of.

use super::judge::Judge;
use super::known::Building;
use super::mission::{Entry, Mission, Outfit, film_event};
use super::stretch::{Stretch, with_room};
use super::{Ending, Happening, Navigator};
use crate::geometry::{Point, Segment};
use crate::pose::Pose;
use crate::simulator::{Film, Shapes, SimulationError, Simulator};

/// Where the robot found its way closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Met {
    /// Where what it met stands, as it thinks.
    pub at: Point,
    /// Where it was heading: radians, counter-clockwise from the x axis.
    pub heading: f64,
    /// What it saw there, and did not know of. Where there is nothing, the way that is known is too narrow for it.
    pub seen: Vec<Segment>,
}

/// Finds ways for a robot.
pub trait Router {
    /// The best way from where a robot is, in a shape, to its goal; `None` where there is none.
    ///
    /// # Arguments
    /// `met` is where the robot found its way closed, the latest last; none of it any more after it has begun anew.
    fn way(&mut self, from: Point, shape: usize, met: &[Met]) -> Option<Vec<Stretch>>;
}

/// Where such missions are driven.
#[derive(Clone, Copy, Debug)]
pub struct Drivable<'w> {
    /// What stands, as it is.
    pub walls: &'w [Segment],
    /// The robot's shapes.
    pub shapes: &'w Shapes,
    /// The shape in which it begins.
    pub shape: usize,
    /// The building as it is known to the robot, in each of its shapes.
    pub buildings: &'w [Building],
}

/// How a mission went.
#[derive(Clone, Debug, PartialEq)]
pub struct Routed {
    pub ending: Ending,
    /// The shape in which it ended.
    pub shape: usize,
    /// Metres that the robot really went, by shape.
    pub metres: Vec<f64>,
    /// Changes of shape, in order: from which into which.
    pub changes: Vec<(usize, usize)>,
    /// Times that a way was looked for, but the first.
    pub replans: u32,
    pub detours: u32,
    /// Seconds by the body's clock.
    pub simulated_s: f64,
    /// Touches by the robot: it went there, and stopped.
    pub touches: usize,
    /// The deepest that anything was within the robot, or hung in it, metres; below 0 where there was always a gap.
    pub overlap_m: f64,
    /// Metres from where the robot really was at the end to the goal.
    pub miss_m: f64,
    /// The largest error of the estimated position, metres.
    pub worst_error_m: f64,
    /// Where the robot really was, in which shape, whenever it had gone on a little.
    pub track: Vec<(Point, usize)>,
}

/// The track has a point each so many metres.
const TRACK_M: f64 = 0.25;

impl Mission {
    /// Runs the mission by ways that a router finds.
    ///
    /// # Arguments
    /// `journal` gets every event; `film` gets a frame for each scan and for each event worth a caption.
    pub fn run_routed(
        &self,
        on: &Drivable<'_>,
        outfit: &Outfit,
        router: &mut impl Router,
        judge: &mut impl Judge,
        mut journal: impl FnMut(Entry),
        mut film: Option<&mut Option<Film>>,
    ) -> Result<Routed, SimulationError> {
        let body = Simulator::new(on.walls, self.obstacles.clone(), outfit.robot, self.start, self.seed)?;
        let mut body = body.in_shape(on.shapes.clone(), on.shape)?;
        let start = outfit.estimate(self.start);
        let mut navigator =
            Navigator::of_shapes((on.buildings, on.shape), outfit.model, outfit.navigation, start);
        if let Some(film) = &mut film {
            **film = Some(Film::new(&body).to(self.goal));
        }
        navigator.go_by_route(self.goal);
        let mut met: Vec<Met> = Vec::new();
        let mut went = Routed {
            ending: Ending::OutOfPatience,
            shape: on.shape,
            metres: vec![0.0; on.shapes.all.len()],
            changes: Vec::new(),
            replans: 0,
            detours: 0,
            simulated_s: 0.0,
            touches: 0,
            overlap_m: f64::NEG_INFINITY,
            miss_m: 0.0,
            worst_error_m: 0.0,
            track: vec![(self.start.at, on.shape)],
        };
        let mut asked = 0;
        loop {
            if navigator.wants_way() {
                let way = router.way(navigator.estimate().pose.at, body.shape(), &met);
                let way = way.map(|way| with_room(way, on.buildings, navigator.settings()));
                navigator.take_way(way, met.is_empty());
                asked += 1;
            }
            let (before, shape) = (body.pose(), body.shape());
            let ending = navigator.step(&mut body, judge);
            let truth = body.pose();
            went.note(&body, (before, shape), &navigator);
            for event in navigator.take_events() {
                match &event.what {
                    Happening::Detour { .. } => went.detours += 1,
                    Happening::WayClosed { at, seen, .. } => {
                        let heading = heading(event.pose, *at);
                        met.push(Met { at: *at, heading, seen: seen.clone() });
                    }
                    Happening::Retried => met.clear(),
                    _ => {}
                }
                if let Some(Some(film)) = film.as_deref_mut() {
                    film_event(film, &body, &navigator, &event);
                }
                journal(Entry { event, truth });
            }
            if let Some(ending) = ending {
                return Ok(Routed {
                    ending,
                    shape: body.shape(),
                    replans: asked - 1,
                    simulated_s: body.time_s(),
                    touches: body.touches_by_robot(),
                    miss_m: truth.at.distance(self.goal),
                    ..went
                });
            }
        }
    }
}

impl Routed {
    /// Takes note of a step from a pose, in a shape.
    fn note(&mut self, body: &Simulator, (before, shape): (Pose, usize), navigator: &Navigator<'_>) {
        let (now, truth) = (body.shape(), body.pose());
        self.metres[shape] += before.at.distance(truth.at);
        if now != shape {
            self.changes.push((shape, now));
        }
        let is_far = self.track.last().is_none_or(|(last, _)| last.distance(truth.at) >= TRACK_M);
        if is_far || now != shape {
            self.track.push((truth.at, now));
        }
        let thought = navigator.estimate().pose;
        self.worst_error_m = self.worst_error_m.max(thought.at.distance(truth.at));
        self.overlap_m = self.overlap_m.max(body.overlap_m());
    }
}

/// Towards what is in the way; where the robot looks, if it stands in it.
fn heading(pose: Pose, at: Point) -> f64 {
    let towards = at - pose.at;
    if towards.length() > 0.0 { towards.y.atan2(towards.x) } else { pose.heading }
}
