//! Missions in a simulated building, and how they went.

use super::judge::{Action, Judge, StateDecision};
use super::known::{Building, shapes};
use super::router::Router;
use super::run::Run;
use super::trip::{Advance, Trip};
use super::{Ending, Event, Happening, Navigator, Settings};
use crate::body::Body;
use crate::floor_plan::{Disc, Drawn, FloorPlan, Network, Rule};
use crate::geometry::{Point, Segment};
use crate::local_model::{self, Estimate};
use crate::pose::{Pose, wrapped};
use crate::simulator::{self, Film, Frame, Obstacle, Shapes, SimulationError, Simulator};

/// Into so many directions a robot measures for which the figures of the model are meant.
const SONAR_DIRECTIONS: u16 = 120;

/// A robot's start, its goal, and what nobody told it of.
#[derive(Clone, Debug, PartialEq)]
pub struct Mission {
    /// Where the robot stands, and thinks that it stands.
    pub start: Pose,
    /// Where it is to go.
    pub goal: Point,
    /// Obstacles that are not known to it.
    pub obstacles: Vec<Obstacle>,
    /// Of the errors of wheels and sonar.
    pub seed: u64,
    /// Whether somebody carries the robot off on its way, of which it is told nothing.
    pub kidnapping: Option<Kidnapping>,
}

/// A robot is carried off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kidnapping {
    /// When it has gone so far, metres.
    pub after_m: f64,
    pub to: Pose,
}

/// How a robot and its navigator are set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outfit {
    pub robot: simulator::Settings,
    pub model: local_model::Settings,
    pub navigation: Settings,
    /// How sure it is of the place where it begins: standard deviation, metres.
    pub start_sigma_m: f64,
}

impl Default for Outfit {
    fn default() -> Self {
        Self {
            robot: simulator::Settings::default(),
            model: local_model::Settings::default(),
            navigation: Settings::default(),
            start_sigma_m: 0.01,
        }
    }
}

impl Outfit {
    /// A robot that is as good as its navigator thinks, and whose navigator is set so; drifts alone are not known to it.
    pub fn of(robot: simulator::Settings, navigation: Settings) -> Self {
        let usual = local_model::Settings::default();
        // beams that lie closer together are not joined across as wide a gap
        let closer = f64::from(SONAR_DIRECTIONS) / f64::from(robot.readings_a_turn.max(1));
        let model = local_model::Settings {
            largest_gap_m: usual.largest_gap_m * closer.min(1.0),
            sonar_range_m: robot.sonar_range_m,
            range_noise: robot.range_noise,
            distance_noise: robot.distance_noise,
            heading_noise: robot.heading_noise,
            ..usual
        };
        Self { robot, model, navigation, ..Self::default() }
    }

    /// The same for a body that measures into so many directions, and so far, metres, where it says how far.
    #[must_use]
    pub fn measuring(self, directions: usize, range_m: Option<f64>) -> Self {
        let robot = simulator::Settings {
            readings_a_turn: directions.try_into().unwrap_or(u16::MAX),
            sonar_range_m: range_m.unwrap_or(self.robot.sonar_range_m),
            ..self.robot
        };
        Self { start_sigma_m: self.start_sigma_m, ..Self::of(robot, self.navigation) }
    }

    /// Where a robot thinks that it is when it is switched on.
    pub(super) fn estimate(&self, start: Pose) -> Estimate {
        Estimate::new(start, self.start_sigma_m, 0.5_f64.to_radians())
    }
}

/// An event, with the truth beside it where that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// What the navigator told.
    pub event: Event,
    /// Where the robot really was; of a machine nobody knows it.
    pub truth: Option<Pose>,
}

/// Where missions are run.
#[derive(Clone, Copy, Debug)]
pub struct Drivable<'w> {
    /// What stands, as it is: it may be otherwise than the robot knows it.
    pub walls: &'w [Segment],
    /// The robot's shapes; `None` for one that stays as its outfit has it.
    pub shapes: Option<&'w Shapes>,
    /// The stance in which it begins, by number.
    pub stance: usize,
    /// The building as it is known to the robot, in each of its stances.
    pub buildings: &'w [Building],
}

impl<'w> Drivable<'w> {
    /// Walls, and a building that the robot knows.
    pub const fn of(walls: &'w [Segment], building: &'w Building) -> Self {
        Self { walls, shapes: None, stance: 0, buildings: std::slice::from_ref(building) }
    }
}

/// How a mission of a simulated robot went.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// As it really was.
    pub trip: Trip,
    /// The deepest that anything was within the robot, or hung in it, metres; below 0 where there was always a gap. More than
    /// a hair is a collision.
    pub overlap_m: f64,
    /// Metres from where the robot really was at the end to the goal.
    pub miss_m: f64,
    /// Where it was carried off to, in which shape, if it was.
    pub kidnapped: Option<(Pose, usize)>,
    /// The largest error of the estimated position, metres.
    pub worst_error_m: f64,
    /// The largest error of the estimated heading, radians.
    pub worst_heading_error: f64,
}

/// What can be, with the obstacles where they come to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Possible {
    /// Whether a disc of the robot's radius can get there.
    pub is_for_radius: bool,
    /// Whether a disc with room to spare can.
    pub is_with_room: bool,
    /// The length of the shortest path for the robot's radius, metres.
    pub optimum_m: Option<f64>,
}

/// What is kept free of a robot that has room, metres.
pub const ROOM_M: f64 = 0.10;

impl Mission {
    /// A mission with nothing in the way.
    pub const fn between(start: Pose, goal: Point, seed: u64) -> Self {
        Self { start, goal, obstacles: Vec::new(), seed, kidnapping: None }
    }

    /// The robot that would run the mission, where it begins.
    pub fn body(&self, on: &Drivable<'_>, outfit: &Outfit) -> Result<Simulator, SimulationError> {
        let body = Simulator::new(on.walls, self.obstacles.clone(), outfit.robot, self.start, self.seed)?;
        match on.shapes {
            Some(shapes) => body.in_shape(shapes.clone(), on.buildings[on.stance].shape),
            None => Ok(body),
        }
    }

    /// Sets the robot on its way.
    ///
    /// # Arguments
    /// `by_route` is whether somebody else than the navigator finds the ways.
    pub fn begin<'b>(
        &self,
        on: &Drivable<'b>,
        outfit: &Outfit,
        by_route: bool,
        judge: &mut impl Judge,
    ) -> Result<Underway<'b>, SimulationError> {
        let body = self.body(on, outfit)?;
        let start = outfit.estimate(self.start);
        let mut navigator =
            Navigator::of_stances((on.buildings, on.stance), outfit.model, outfit.navigation, start);
        let run = Run::begin(&mut navigator, self.goal, by_route, judge);
        let outcome = Outcome::begun(&body, shapes(on.buildings));
        Ok(Underway {
            body,
            navigator,
            run,
            goal: self.goal,
            by_route,
            kidnapping: self.kidnapping,
            begun_s: 0.0,
            before: Before::default(),
            outcome,
        })
    }

    /// Runs the mission.
    ///
    /// # Arguments
    /// `router` finds the ways, where somebody else than the navigator does. `journal` gets every event; `film` gets a frame
    /// for each scan and for each event worth a caption.
    pub fn run(
        &self,
        on: &Drivable<'_>,
        outfit: &Outfit,
        mut router: Option<&mut dyn Router>,
        judge: &mut impl Judge,
        mut journal: impl FnMut(Entry),
        mut film: Option<&mut Option<Film>>,
    ) -> Result<Outcome, SimulationError> {
        let mut underway = self.begin(on, outfit, router.is_some(), judge)?;
        if let Some(film) = &mut film {
            **film = Some(Film::new(&underway.body).to(self.goal));
        }
        loop {
            let router = router.as_mut().map(|router| &mut **router as &mut dyn Router);
            let (ending, entries) = underway.step(router, judge);
            for entry in entries {
                if let Some(Some(film)) = film.as_deref_mut() {
                    film_event(film, &underway.body, &underway.navigator, &entry.event);
                }
                journal(entry);
            }
            if let Some(ending) = ending {
                return Ok(underway.outcome(ending));
            }
        }
    }

    /// Whether the mission can be done, by an exact search that knows of every obstacle where it comes to rest.
    ///
    /// # Arguments
    /// `from` is where the robot begins, or where it was carried off to.
    ///
    /// # Returns
    /// `None` where obstacles and walls together make no floor plan.
    pub fn possible(&self, from: Point, plan: &FloorPlan, radius_m: f64) -> Option<Possible> {
        let mut solids = plan.solids().to_vec();
        solids.extend(self.obstacles.iter().map(Obstacle::at_rest));
        let drawn = Drawn { name: String::new(), walls: plan.walls().to_vec(), solids, places: Vec::new() };
        let plan = FloorPlan::new(drawn).ok()?;
        let path = |radius: f64, margin: f64| {
            let network = Network::new(&plan, Disc { radius, margin }).ok()?;
            network.path(from, self.goal, Rule::Tight, |way| Some(way.length)).ok()
        };
        let optimum_m = path(radius_m, 0.0).map(|path| path.length);
        let is_with_room = path(radius_m, ROOM_M).is_some();
        Some(Possible { is_for_radius: optimum_m.is_some() || is_with_room, is_with_room, optimum_m })
    }
}

/// A simulated robot on its way.
#[derive(Clone, Debug)]
pub struct Underway<'b> {
    body: Simulator,
    navigator: Navigator<'b>,
    run: Run,
    goal: Point,
    /// Whether somebody else than the navigator finds the ways.
    by_route: bool,
    kidnapping: Option<Kidnapping>,
    /// When it set out, by its clock, seconds.
    begun_s: f64,
    before: Before,
    outcome: Outcome,
}

/// What a robot had done before it set out.
#[derive(Clone, Copy, Debug, Default)]
struct Before {
    touches: usize,
    replans: u32,
}

impl<'b> Underway<'b> {
    pub const fn body(&self) -> &Simulator {
        &self.body
    }

    pub const fn navigator(&self) -> &Navigator<'b> {
        &self.navigator
    }

    pub const fn goal(&self) -> Point {
        self.goal
    }

    /// Puts other things in its way than there were, by their corners.
    pub fn place(&mut self, things: Vec<Vec<Point>>) {
        self.body.place(things);
    }

    /// One reading, one question to the judge, one step.
    pub fn step(
        &mut self,
        router: Option<&mut dyn Router>,
        judge: &mut impl Judge,
    ) -> (Option<Ending>, Vec<Entry>) {
        self.kidnap();
        let (before, since_s) = (self.body.pose().at, self.body.time_s());
        let (ending, events) = self.run.step(&mut self.body, &mut self.navigator, router, judge);
        let truth = self.body.pose();
        let step = Advance {
            metres: before.distance(truth.at),
            seconds: self.body.time_s() - since_s,
            is_under_way: self.navigator.is_busy(),
        };
        let stance = Some(self.navigator.stance());
        self.outcome.trip.note(&step, (truth.at, self.body.shape()), stance, &events);
        self.outcome.note(&self.body, &self.navigator);
        (ending, events.into_iter().map(|event| Entry { event, truth: Some(truth) }).collect())
    }

    /// Carries the robot off when it is time; where something is in the way there, as soon as that is gone.
    fn kidnap(&mut self) {
        let Some(Kidnapping { after_m, to }) = self.kidnapping else { return };
        if self.outcome.trip.path_m() >= after_m && self.body.put(to).is_ok() {
            self.outcome.kidnapped = Some((to, self.body.shape()));
            self.kidnapping = None;
        }
    }

    /// Lets time pass for a robot that stands, without an errand, for one reading.
    pub fn rest(&mut self) {
        // of what it senses, the time alone is for anybody
        if let Ok(sensed) = self.body.sense() {
            self.navigator.rests_until(sensed.time_s);
        }
    }

    /// How it went, since it set out for its goal.
    pub fn outcome(&self, ending: Ending) -> Outcome {
        let trip = self.outcome.trip.clone().ended(ending, &self.navigator);
        let trip = Trip {
            touches: self.body.touches_by_robot() - self.before.touches,
            replans: trip.replans - self.before.replans,
            seconds: trip.seconds - self.begun_s,
            ..trip
        };
        Outcome { trip, miss_m: self.body.pose().at.distance(self.goal), ..self.outcome.clone() }
    }

    /// Sets out for another goal from where it is.
    pub fn go_on(&mut self, goal: Point, judge: &mut impl Judge) {
        let shapes = self.outcome.trip.metres.len();
        self.run = Run::begin(&mut self.navigator, goal, self.by_route, judge);
        (self.goal, self.begun_s) = (goal, self.navigator.time_s());
        let (touches, replans) = (self.body.touches_by_robot(), self.navigator.replans());
        (self.before, self.outcome) = (Before { touches, replans }, Outcome::begun(&self.body, shapes));
    }
}

impl Outcome {
    /// Of a robot of so many shapes, of which nothing was driven yet.
    fn begun(body: &Simulator, shapes: usize) -> Self {
        Self {
            trip: Trip::begun(body.pose().at, body.shape(), shapes),
            overlap_m: f64::NEG_INFINITY,
            miss_m: 0.0,
            kidnapped: None,
            worst_error_m: 0.0,
            worst_heading_error: 0.0,
        }
    }

    /// Takes note of a step.
    fn note(&mut self, body: &Simulator, navigator: &Navigator<'_>) {
        let (truth, thought) = (body.pose(), navigator.estimate().pose);
        self.worst_error_m = self.worst_error_m.max(thought.at.distance(truth.at));
        let turned = wrapped(thought.heading - truth.heading).abs();
        self.worst_heading_error = self.worst_heading_error.max(turned);
        self.overlap_m = self.overlap_m.max(body.overlap_m());
    }
}

/// A state and an action, as films say them.
pub(super) fn state_caption(decision: StateDecision) -> String {
    let state = format!("{:?}", decision.state).to_lowercase();
    match decision.action {
        Action::None => state,
        Action::BackOff => format!("{state}, withdraws"),
        Action::Left => format!("{state}, to the left"),
        Action::Right => format!("{state}, to the right"),
        Action::Close => format!("{state}, another way"),
        Action::Retry => format!("{state}, begins anew"),
        Action::Match | Action::Search => format!("{state}, where is it"),
        Action::Seek => format!("{state}, goes where it can tell"),
        Action::Resume => format!("{state}, goes on"),
        Action::NoWay => format!("{state}, no way"),
        Action::Lost => format!("{state}, lost"),
    }
}

fn film_event(film: &mut Film, body: &Simulator, navigator: &Navigator, event: &Event) {
    let caption = match &event.what {
        Happening::State { decision, .. } => state_caption(*decision),
        Happening::Detour { length_m, .. } => format!("detour of {length_m:.1} m"),
        Happening::WayClosed { doorway: Some(doorway), .. } => format!("doorway {doorway} closed"),
        Happening::WayClosed { region: Some(region), .. } => format!("region {region} closed"),
        Happening::WayClosed { .. } => "way closed".to_owned(),
        Happening::Planned { length_m, is_off_network, .. } => {
            format!("planned: {length_m:.1} m{}", if *is_off_network { " off the network" } else { "" })
        }
        Happening::Contact { .. } => "contact".to_owned(),
        Happening::Shape(_) => "another shape".to_owned(),
        Happening::Heard { is_other: true } => "hears of another way".to_owned(),
        Happening::Ended(Ending::Arrived) => "arrived".to_owned(),
        Happening::Ended(Ending::NoWay) => "no way".to_owned(),
        Happening::Ended(Ending::Lost) => "lost".to_owned(),
        Happening::Ended(Ending::Silent) => "not heard any more".to_owned(),
        Happening::Ended(Ending::OutOfPatience) => "given up".to_owned(),
        _ => return,
    };
    film.push(frame(body, navigator, event.pose, caption));
}

/// What there is to see of a simulation, with what the robot thinks.
pub(super) fn frame(body: &Simulator, navigator: &Navigator, estimate: Pose, caption: String) -> Frame {
    let surfaces = navigator.model().segments().iter().map(|segment| segment.line).collect();
    Frame { estimate: Some(estimate), surfaces: Some(surfaces), caption: Some(caption), ..body.frame() }
}
