//! The navigator: it drives a body from state to state as the judge decides.
//!
//! What it knows of its whereabouts is a part of it, and is found out by it: this file and `locating` are a circle.

mod acting;
mod locating;
mod loose;
mod planning;
mod route;
mod sensing;
mod watching;

use std::collections::VecDeque;

use super::Settings;
use super::cuts::Blocked;
use super::detour::Detours;
use super::event::{Ending, Event, Happening};
use super::judge::{Action, Judge, Mode, State};
use super::known::{Building, Memory};
use super::learn::Seen;
use super::stretch::Stretch;
use crate::body::{Body, Command, Contact, Reading, Sensed};
use crate::geometry::{Point, Segment};
use crate::local_model::{Estimate, LocalModel};
use crate::pose::Pose;
use crate::rim::Rim;
use locating::Whereabouts;

/// A touch is ahead of a course if the cosine of its bearing is larger.
const SIDEWAYS: f64 = 0.05;

/// The track has a point each so many metres, and so many points.
const TRACK_M: f64 = 0.2;
const TRACK_POINTS: usize = 16;

/// A touch is aside if the cosine of its bearing is smaller.
const ASIDE: f64 = 0.5;

/// A course that ends before so much of it is done was held by what is touched, metres.
const SHORT_M: f64 = 0.01;

/// Drives a body through a known building, with obstacles that are not known.
#[derive(Clone, Debug)]
pub struct Navigator<'b> {
    /// The building as it is for the robot in each of its stances, by number.
    stances: &'b [Building],
    /// As it is for the robot in the stance in which it is.
    building: &'b Building,
    settings: Settings,
    model: LocalModel,
    memory: Memory,
    whereabouts: Whereabouts,
    blocked: Blocked,
    /// Doorways that the judge closes whatever is seen, by index.
    forbidden: Vec<usize>,
    /// Walls, what is overhead, doorways that are forbidden, then obstacles; from which index on.
    barriers: Vec<Segment>,
    obstacles_from: usize,
    moving: Vec<Segment>,
    mode: Mode,
    state: State,
    goal: Option<Point>,
    legs: VecDeque<Point>,
    /// From where the way says that the robot comes to the first of these.
    came_from: Point,
    /// What of a way that somebody else found comes after these legs.
    stretches: VecDeque<Stretch>,
    /// The stance that these legs ask for, by number.
    needed: usize,
    /// Whether somebody else is to find another way.
    wants_way: bool,
    line: Line,
    has_way: bool,
    is_shut: bool,
    spot: Spot,
    track: VecDeque<Point>,
    retries: u32,
    /// Times that a path with hardly any room was taken for want of another one.
    squeezes: u32,
    replans: u32,
    /// Of the body, as it stands.
    rim: Rim,
    /// Into how many directions the body measures.
    directions: usize,
    sensed: Option<Sensed>,
    contact: Option<Contact>,
    /// The straight course that was commanded last; `None` where the wheels turn or stand.
    course: Option<Course>,
    /// The straight course that follows the turn, metres.
    then_m: Option<f64>,
    part: Vec<Reading>,
    readings_standing: usize,
    /// Since when the robot stands, seconds.
    standing_s: f64,
    /// When it had looked around since then, and what it saw was in the model, seconds.
    looked_s: Option<f64>,
    /// Times that the robot withdrew since it last waited.
    back_offs: u32,
    /// When the goal was given, seconds.
    begun_s: f64,
    /// Whole scans since the goal was given, or everything was forgotten.
    scans: u32,
    /// What was touched, and when; the model may have it elsewhere.
    felt: Vec<(f64, Segment)>,
    /// When the model was updated last, seconds.
    updated_s: f64,
    /// Short surfaces through echoes that no surface of the model explains, and the readings since each was heard.
    loose: Vec<(usize, Segment)>,
    detours: Option<Detours>,
    /// What was seen free, in learn mode.
    seen: Option<Seen>,
    events: Vec<Event>,
}

/// The line to a goal point, from where the robot went off.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    from: Point,
    nearest_m: f64,
}

/// A straight course by the wheels' count.
#[derive(Clone, Copy, Debug)]
struct Course {
    from: Pose,
    distance_m: f64,
    /// Where that is, radians from the heading.
    bearing: f64,
}

impl Course {
    fn leads_to(&self, contact: Contact) -> bool {
        self.distance_m.signum() * (contact.bearing - self.bearing).cos() > SIDEWAYS
    }

    /// Whether it ended where it began.
    fn is_held(&self, sensed: &Sensed) -> bool {
        sensed.odometry.at.distance(self.from.at) < SHORT_M.min(self.distance_m.abs() / 2.0)
    }
}

/// Where the robot was blocked, and what it did there.
#[derive(Clone, Copy, Debug, Default)]
struct Spot {
    at: Point,
    detours: u32,
    waits: u32,
    closed: u32,
}

impl<'b> Navigator<'b> {
    /// A navigator for a body that was just switched on at an estimated pose.
    pub fn new(
        building: &'b Building,
        model: crate::local_model::Settings,
        settings: Settings,
        start: Estimate,
    ) -> Self {
        Self::of_stances((std::slice::from_ref(building), 0), model, settings, start)
    }

    /// As [`Self::new`], for a body that changes its shape, or keeps a facing.
    ///
    /// # Arguments
    /// The building as it is for the robot in each stance, and the stance in which it is.
    ///
    /// # Panics
    /// Where there is no such stance.
    pub fn of_stances(
        (stances, stance): (&'b [Building], usize),
        model: crate::local_model::Settings,
        settings: Settings,
        start: Estimate,
    ) -> Self {
        let building = &stances[stance];
        Self {
            stances,
            building,
            settings,
            model: LocalModel::new(model, start),
            memory: Memory::default(),
            whereabouts: Whereabouts::new(building),
            blocked: Blocked::new(&building.network),
            forbidden: Vec::new(),
            barriers: [&building.walls[..], &building.overhead].concat(),
            obstacles_from: building.walls.len() + building.overhead.len(),
            moving: Vec::new(),
            mode: Mode::Manual,
            state: State::Hold,
            goal: None,
            legs: VecDeque::new(),
            came_from: start.pose.at,
            stretches: VecDeque::new(),
            needed: stance,
            wants_way: false,
            line: Line::default(),
            has_way: true,
            is_shut: false,
            spot: Spot::default(),
            track: VecDeque::new(),
            retries: 0,
            squeezes: 0,
            replans: 0,
            rim: building.rim,
            directions: 1,
            sensed: None,
            contact: None,
            course: None,
            then_m: None,
            part: Vec::new(),
            readings_standing: 0,
            standing_s: 0.0,
            looked_s: None,
            back_offs: 0,
            begun_s: 0.0,
            scans: 0,
            felt: Vec::new(),
            updated_s: f64::NEG_INFINITY,
            loose: Vec::new(),
            detours: None,
            seen: None,
            events: Vec::new(),
        }
    }

    pub fn estimate(&self) -> &Estimate {
        self.model.estimate()
    }

    pub fn model(&self) -> &LocalModel {
        &self.model
    }

    pub fn state(&self) -> State {
        self.state
    }

    /// The shape in which the body is, by number.
    pub fn shape(&self) -> usize {
        self.sensed.as_ref().map_or(self.building.shape, |sensed| sensed.shape)
    }

    /// The stance in which it is, by number.
    pub fn stance(&self) -> usize {
        let is_own = |stance: &Building| std::ptr::eq(stance, self.building);
        self.stances.iter().position(is_own).unwrap_or(self.needed)
    }

    /// The building as it is for the robot in each of its stances.
    pub(super) fn stances(&self) -> &'b [Building] {
        self.stances
    }

    /// The goal points that are left, in order.
    pub fn legs(&self) -> impl Iterator<Item = Point> + '_ {
        self.legs.iter().copied()
    }

    /// How often another path over the whole building was looked for.
    pub fn replans(&self) -> u32 {
        self.replans
    }

    /// What happened since this was last asked.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Lets the user drive: the goal is dropped, and the body stops.
    pub fn manual(&mut self, body: &mut impl Body) {
        (self.mode, self.state, self.goal, self.then_m) = (Mode::Manual, State::Hold, None, None);
        self.legs.clear();
        self.stretches.clear();
        body.command(Command::Stop);
    }

    /// Passes a command of the user on to the body.
    ///
    /// # Returns
    /// Whether it was: in other modes than manual it is not.
    pub fn drive(&mut self, body: &mut impl Body, command: Command) -> bool {
        let is_manual = self.mode == Mode::Manual;
        if is_manual {
            self.readings_standing = 0;
            body.command(command);
            if let Some(sensed) = &mut self.sensed {
                sensed.is_busy = true;
            }
        }
        is_manual
    }

    pub fn is_busy(&self) -> bool {
        self.sensed.as_ref().is_none_or(|sensed| sensed.is_busy)
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Plans a path to a goal, and goes there from now on.
    pub fn go(&mut self, goal: Point, judge: &mut impl Judge) {
        (self.mode, self.goal, self.retries, self.scans) = (Mode::Automatic, Some(goal), 0, 0);
        (self.begun_s, self.squeezes) = (self.time_s(), 0);
        self.whereabouts.begin();
        self.blocked = Blocked::new(&self.building.network);
        self.ask_for_doorways(judge);
        self.gather();
        self.plan(judge, false);
    }

    /// Keeps what is seen free from now on.
    pub(super) fn learn(&mut self) {
        self.seen = Some(Seen::default());
    }

    /// What was seen free since [`Self::learn`], cell by cell.
    pub(super) fn seen(&self) -> Option<&Seen> {
        self.seen.as_ref()
    }

    /// Goes from point to point of a way through what is known; it is over when the last is reached, or where the way is
    /// blocked and the judge gives it up.
    pub(super) fn go_along(&mut self, points: Vec<Point>) {
        (self.mode, self.goal, self.retries, self.scans) = (Mode::Learn, points.last().copied(), 0, 0);
        (self.begun_s, self.has_way, self.spot) = (self.time_s(), !points.is_empty(), Spot::default());
        self.legs = points.into();
        self.gather();
    }

    /// Waits for the next reading, asks the judge, and does what it says.
    ///
    /// # Returns
    /// How the mission ended, if it did.
    pub fn step(&mut self, body: &mut impl Body, judge: &mut impl Judge) -> Option<Ending> {
        if let Err(silence) = self.sense(body, judge) {
            self.tell(Happening::Silent(silence.0));
            self.tell(Happening::Ended(Ending::Silent));
            self.manual(body);
            return Some(Ending::Silent);
        }
        if self.mode == Mode::Manual {
            return None;
        }
        if self.sensed.as_ref().is_some_and(|sensed| !sensed.is_busy)
            && let Some(then_m) = self.then_m.take()
        {
            self.drive_straight(body, then_m, 0.0);
            return None;
        }
        self.look_for_detours();
        let facts = self.facts();
        let decision = judge.next_state(&facts);
        if decision.state != facts.state || decision.action != Action::None {
            self.tell(Happening::State { facts: Box::new(facts), decision });
        }
        let ending = self.follow(&facts, decision, body, judge);
        let ending = ending.or_else(|| Ending::of_patience(facts.time_s, &self.settings));
        if let Some(ending) = ending {
            self.tell(Happening::Ended(ending));
            self.manual(body);
        }
        ending
    }

    pub(super) fn is_scan_complete(&self) -> bool {
        self.looked_s.is_some()
    }

    /// Readings that make a whole scan: all around, and no fewer than the figure for a body that measures into few directions.
    pub(super) fn scan_readings(&self) -> usize {
        self.settings.scan_readings.max(self.directions)
    }

    /// Readings after which the model is updated on the way, as large a share of a whole scan as by the figures.
    fn part_readings(&self) -> usize {
        self.settings.part_readings * self.scan_readings() / self.settings.scan_readings
    }

    /// Where the wheels' count puts the robot.
    pub(super) fn odometry(&self) -> Pose {
        self.sensed.as_ref().map_or_else(Pose::default, |sensed| sensed.odometry)
    }

    /// The surfaces that stand, however new they are.
    pub(super) fn surfaces(&self) -> Vec<Segment> {
        self.obstacles(1)
    }

    fn pose(&self) -> Pose {
        self.model.estimate().pose
    }

    /// Takes note that time passed while nothing was asked of the robot, so that what comes next begins then.
    pub(super) fn rests_until(&mut self, time_s: f64) {
        if let Some(sensed) = &mut self.sensed {
            sensed.time_s = time_s;
        }
    }

    /// Seconds by the body's clock.
    pub(super) fn time_s(&self) -> f64 {
        self.sensed.as_ref().map_or(0.0, |sensed| sensed.time_s)
    }

    fn tell(&mut self, what: Happening) {
        let (time_s, pose) = (self.time_s(), self.pose());
        self.events.push(Event { time_s, pose, what });
    }
}
