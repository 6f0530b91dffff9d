//! The navigator: it drives a body from state to state as the judge decides.

use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;

use super::Settings;
use super::cuts::{Blocked, forbidden};
use super::detour::{Detours, Ground, length};
use super::event::{Ending, Event, Happening};
use super::highway::free_ahead;
use super::judge::{Action, Judge, Mode, State, StateDecision, StateFacts};
use super::known::{Building, Memory, moving};
use super::route::{Route, off_network, over_network};
use crate::body::{Body, Command, Contact, Reading, Sensed};
use crate::geometry::Point;
use crate::local_model::{Estimate, LocalModel};
use crate::pose::Pose;
use crate::segment::Segment;

/// So much farther than it was counts as farther away, metres.
const FALLING_M: f64 = 0.05;

/// A touch is ahead of a course if the cosine of its bearing is larger.
const SIDEWAYS: f64 = 0.05;

/// A course that ends so much earlier than it should was cut short, metres.
const SHORT_M: f64 = 0.002;

/// So many raw echoes in the way count, one may be false.
const ECHOES: usize = 2;

/// Drives a body through a known building, with obstacles that are not known.
#[derive(Clone, Debug)]
pub struct Navigator<'b> {
    building: &'b Building,
    settings: Settings,
    model: LocalModel,
    memory: Memory,
    blocked: Blocked,
    /// Doorways that the judge closes whatever is seen.
    forbidden: Vec<Segment>,
    /// Walls, doorways that are forbidden, then obstacles; from which index on.
    barriers: Vec<Segment>,
    obstacles_from: usize,
    moving: Vec<Segment>,
    mode: Mode,
    state: State,
    goal: Option<Point>,
    legs: VecDeque<Point>,
    line: Line,
    has_way: bool,
    spot: Spot,
    retries: u32,
    replans: u32,
    radius_m: f64,
    sensed: Option<Sensed>,
    contact: Option<Contact>,
    /// The straight course that was commanded last; `None` where the wheels turn or stand.
    course: Option<Course>,
    part: Vec<Reading>,
    readings_standing: usize,
    /// Times that the robot withdrew since it last waited.
    back_offs: u32,
    /// When the goal was given, seconds.
    begun_s: f64,
    /// Whole scans since the goal was given, or everything was forgotten.
    scans: u32,
    /// What was touched, and when; the model may have it elsewhere.
    felt: Vec<(f64, Segment)>,
    detours: Option<Detours>,
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
}

impl Course {
    fn leads_to(&self, contact: Contact) -> bool {
        self.distance_m.signum() * contact.bearing.cos() > SIDEWAYS
    }

    fn is_cut_short(&self, sensed: &Sensed) -> bool {
        sensed.odometry.at.distance(self.from.at) < self.distance_m.abs() - SHORT_M
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
        Self {
            building,
            settings,
            model: LocalModel::new(model, start),
            memory: Memory::default(),
            blocked: Blocked::new(&building.network),
            forbidden: Vec::new(),
            barriers: building.walls.clone(),
            obstacles_from: building.walls.len(),
            moving: Vec::new(),
            mode: Mode::Manual,
            state: State::Hold,
            goal: None,
            legs: VecDeque::new(),
            line: Line::default(),
            has_way: true,
            spot: Spot::default(),
            retries: 0,
            replans: 0,
            radius_m: building.network.disc.radius,
            sensed: None,
            contact: None,
            course: None,
            part: Vec::new(),
            readings_standing: 0,
            back_offs: 0,
            begun_s: 0.0,
            scans: 0,
            felt: Vec::new(),
            detours: None,
            events: Vec::new(),
        }
    }

    /// Where the robot is thought to be.
    pub fn estimate(&self) -> &Estimate {
        self.model.estimate()
    }

    /// The local model.
    pub fn model(&self) -> &LocalModel {
        &self.model
    }

    /// The state now.
    pub fn state(&self) -> State {
        self.state
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
        (self.mode, self.state, self.goal) = (Mode::Manual, State::Hold, None);
        self.legs.clear();
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
        }
        is_manual
    }

    /// Plans a path to a goal, and goes there from now on.
    pub fn go(&mut self, goal: Point, judge: &mut impl Judge) {
        (self.mode, self.goal, self.retries, self.scans) = (Mode::Automatic, Some(goal), 0, 0);
        self.begun_s = self.time_s();
        self.blocked = Blocked::new(&self.building.network);
        self.forbidden = forbidden(&self.building.network, |facts| judge.weigh(facts));
        self.gather();
        self.plan(judge, false);
    }

    /// Goes on until a mission is over. Only for a goal that was given.
    pub fn run(&mut self, body: &mut impl Body, judge: &mut impl Judge) -> Ending {
        loop {
            if let Some(ending) = self.step(body, judge) {
                return ending;
            }
        }
    }

    /// Waits for the next reading, asks the judge, and does what it says.
    ///
    /// # Returns
    /// How the mission ended, if it did.
    pub fn step(&mut self, body: &mut impl Body, judge: &mut impl Judge) -> Option<Ending> {
        self.sense(body, judge);
        if self.mode == Mode::Manual {
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

    fn sense(&mut self, body: &mut impl Body, judge: &mut impl Judge) {
        let before = self.sensed.and_then(|sensed| sensed.contact);
        let sensed = body.sense();
        self.radius_m = body.radius_m();
        self.model.reckon(&sensed.odometry);
        let is_stopped = !sensed.is_busy && self.course.is_some_and(|course| course.is_cut_short(&sensed));
        let touch = sensed.contact.filter(|_| before.is_none() || is_stopped);
        self.sensed = Some(sensed);
        self.part.push(sensed.reading);
        self.readings_standing = if sensed.is_busy { 0 } else { self.readings_standing + 1 };
        if let Some(contact) = touch {
            // What runs into a robot that stands, or goes elsewhere, is in the model then, and no reason to stop.
            let is_ahead = self.course.is_some_and(|course| course.leads_to(contact));
            if is_stopped || is_ahead || self.state == State::Turn {
                self.contact = self.contact.or(Some(contact));
                self.felt.push((sensed.time_s, self.surface_at(contact)));
            }
            self.model.touched(&contact, self.radius_m, |facts| judge.segment(facts));
            self.gather();
            self.tell(Happening::Contact { bearing: contact.bearing });
        }
        let is_standing = self.readings_standing > 0;
        let most = if is_standing { self.settings.scan_readings } else { self.settings.part_readings };
        if self.part.len() >= most {
            self.update(judge);
        }
    }

    /// A short surface across a touch.
    fn surface_at(&self, contact: Contact) -> Segment {
        let pose = self.pose();
        let (towards, across) =
            (pose.direction(contact.bearing), pose.direction(contact.bearing + FRAC_PI_2));
        let half = self.model.settings().contact_length_m / 2.0;
        let end = |side: f64| {
            Point::new(
                pose.at.x + self.radius_m * towards.x + side * across.x,
                pose.at.y + self.radius_m * towards.y + side * across.y,
            )
        };
        Segment::new(end(-half), end(half))
    }

    /// Takes the readings into the model.
    fn update(&mut self, judge: &mut impl Judge) {
        let part = std::mem::take(&mut self.part);
        let walls = (0..).zip(self.building.walls.iter().copied());
        self.model.recall(walls, |facts| judge.segment(facts));
        let update = self.model.update(&part, self.time_s(), |facts| judge.segment(facts));
        self.memory.note(&self.model, &self.building.walls, &self.settings);
        self.gather();
        if !(update.entered.is_empty() && update.removed.is_empty()) {
            self.tell(Happening::Segments { entered: update.entered, removed: update.removed });
        }
        if self.is_scan_complete() {
            self.scans += 1;
            self.tell(Happening::SetEstimatedPosition(*self.model.estimate()));
        }
    }

    /// Brings what is in the way up to date.
    fn gather(&mut self) {
        self.barriers.truncate(self.building.walls.len());
        self.barriers.extend(&self.forbidden);
        self.obstacles_from = self.barriers.len();
        let (now, patience) = (self.time_s(), self.settings.felt_s);
        self.felt.retain(|(time_s, _)| now - time_s <= patience);
        self.barriers.extend(self.obstacles(1));
        self.moving = moving(&self.model, &self.settings).collect();
        self.detours = None;
    }

    fn obstacles(&self, confidence: u8) -> Vec<Segment> {
        let mut obstacles = self.memory.obstacles(&self.model, confidence, &self.settings);
        obstacles.extend(self.felt.iter().map(|(_, surface)| *surface));
        obstacles
    }

    fn facts(&self) -> StateFacts {
        let pose = self.pose();
        let target = self.legs.front().copied();
        let distance_m = target.map_or(0.0, |target| pose.at.distance(target));
        let (free_m, is_obstacle_moving) = self.free_m(target);
        let length_of = |path: &Option<Vec<Point>>| path.as_ref().map(|points| length(points));
        let detours = self.detours.as_ref();
        StateFacts {
            mode: self.mode,
            state: self.state,
            has_goal: target.is_some(),
            distance_m,
            is_falling: distance_m <= self.line.nearest_m + FALLING_M,
            heading_error: target.map_or(0.0, |target| pose.bearing(target).abs()),
            off_line_m: target
                .map_or(0.0, |target| pose.at.distance(pose.at.nearest_on(self.line.from, target))),
            free_m,
            echo_m: self.echo_m(target),
            is_obstacle_moving,
            is_contact: self.contact.is_some(),
            back_offs: self.back_offs,
            is_busy: self.sensed.is_some_and(|sensed| sensed.is_busy),
            is_scan_complete: self.is_scan_complete(),
            scans: self.scans,
            left_m: detours.and_then(|detours| length_of(&detours.left)),
            right_m: detours.and_then(|detours| length_of(&detours.right)),
            detours_here: self.spot.detours,
            waits: self.spot.waits,
            has_way: self.has_way,
            retries: self.retries,
            time_s: self.time_s() - self.begun_s,
            settings: self.settings,
        }
    }

    /// Metres ahead that are free in the model, and whether what is there moves.
    fn free_m(&self, target: Option<Point>) -> (f64, bool) {
        let Some(target) = target else { return (0.0, false) };
        let reach = self.radius_m + self.settings.highway_clearance_m;
        let standing = free_ahead(self.pose().at, target, reach, &self.barriers);
        let moving = free_ahead(self.pose().at, target, reach, &self.moving);
        (standing.metres.min(moving.metres), moving.by.is_some() && moving.metres <= standing.metres)
    }

    /// Metres ahead that are free by readings that are not in the model yet.
    fn echo_m(&self, target: Option<Point>) -> f64 {
        let (Some(target), Some(sensed)) = (target, self.sensed) else { return 0.0 };
        let pose = self.pose();
        let distance = pose.at.distance(target);
        let heading = pose.bearing(target);
        let half = self.radius_m + self.settings.highway_clearance_m;
        let ahead = self.part.iter().filter_map(|reading| {
            let from = sensed.odometry.to(&reading.odometry);
            let towards = from.direction(reading.bearing);
            let range = reading.range_m?;
            let at = Point::new(from.at.x + range * towards.x, from.at.y + range * towards.y);
            let (sin, cos) = heading.sin_cos();
            let (ahead, aside) = (at.x * cos + at.y * sin, at.y * cos - at.x * sin);
            let free = ahead - (half.powi(2) - aside.powi(2)).max(0.0).sqrt();
            (aside.abs() < half && ahead > 0.0 && free < distance).then_some(free.max(0.0))
        });
        let mut near: Vec<f64> = ahead.collect();
        near.sort_by(f64::total_cmp);
        near.get(ECHOES - 1).copied().unwrap_or(distance)
    }

    fn look_for_detours(&mut self) {
        let is_asked = self.state == State::Blocked && self.is_scan_complete() && self.has_way;
        if !is_asked || self.detours.is_some() {
            return;
        }
        let at = self.pose().at;
        let mut found = Detours::default();
        while let Some(&target) = self.legs.front() {
            found = self.detours(at, target);
            // A point on the path may be covered by the obstacle: then the next one is gone to.
            if found != Detours::default() || self.legs.len() == 1 {
                break;
            }
            let next = self.detours(at, self.legs[1]);
            if next == Detours::default() {
                break;
            }
            self.legs.pop_front();
        }
        self.detours = Some(found);
    }

    /// Detours with room on either side, unless they are much longer than those with little.
    fn detours(&self, from: Point, to: Point) -> Detours {
        let narrow = self.ground(&self.barriers);
        let wide = Ground { reach: self.radius_m + self.settings.detour_room_m, ..narrow };
        let found = narrow.detours(from, to);
        let Some(shortest) = found.shortest_m() else { return found };
        let with_room = wide.detours(from, to);
        let is_worth = |length: f64| length <= self.settings.room_worth * shortest;
        if with_room.shortest_m().is_some_and(is_worth) { with_room } else { found }
    }

    fn ground<'a>(&self, barriers: &'a [Segment]) -> Ground<'a> {
        Ground {
            barriers,
            obstacles_from: self.obstacles_from,
            reach: self.radius_m + self.settings.detour_clearance_m,
            least: self.radius_m,
            aside: self.settings.detour_reach_m,
            grain: self.settings.grain_m,
        }
    }

    fn follow(
        &mut self,
        facts: &StateFacts,
        decision: StateDecision,
        body: &mut impl Body,
        judge: &mut impl Judge,
    ) -> Option<Ending> {
        match decision.action {
            Action::None => {}
            Action::BackOff => self.back_off(body),
            Action::Left => self.take_detour(|detours| (detours.left, detours.right)),
            Action::Right => self.take_detour(|detours| (detours.right, detours.left)),
            Action::Close => self.close(judge),
            Action::Retry => self.retry(judge),
            Action::NoWay => return Some(Ending::NoWay),
        }
        let is_entered = decision.state != self.state;
        self.state = decision.state;
        match self.state {
            State::Hold if is_entered => {
                self.stop(body);
                return self.reached(facts);
            }
            State::Turn if is_entered || !facts.is_busy => self.turn(body),
            State::Move if is_entered || !facts.is_busy => self.set_off(body, is_entered),
            State::Wait if is_entered => {
                self.stop(body);
                (self.readings_standing, self.spot.waits) = (0, self.spot.waits + 1);
                (self.contact, self.back_offs) = (None, 0);
                self.part.clear();
            }
            State::Blocked if is_entered => {
                self.stop(body);
                self.come_to_spot();
            }
            _ => {}
        }
        None
    }

    fn stop(&mut self, body: &mut impl Body) {
        self.course = None;
        body.command(Command::Stop);
    }

    fn turn(&mut self, body: &mut impl Body) {
        if let Some(&target) = self.legs.front() {
            body.command(Command::Turn { by: self.pose().bearing(target) });
            (self.course, self.readings_standing) = (None, 0);
        }
    }

    fn set_off(&mut self, body: &mut impl Body, is_entered: bool) {
        let Some(&target) = self.legs.front() else { return };
        let at = self.pose().at;
        if is_entered {
            self.line = Line { from: at, nearest_m: at.distance(target) };
            self.contact = None;
        }
        self.drive_straight(body, at.distance(target).min(self.settings.stride_m));
    }

    fn back_off(&mut self, body: &mut impl Body) {
        self.back_offs += 1;
        let is_ahead = self.contact.take().is_none_or(|contact| contact.bearing.cos() >= 0.0);
        let distance_m = if is_ahead { -self.settings.back_off_m } else { self.settings.back_off_m };
        self.drive_straight(body, distance_m);
    }

    fn drive_straight(&mut self, body: &mut impl Body, distance_m: f64) {
        body.command(Command::Move { distance_m, speed_m_s: self.settings.speed_m_s });
        self.course = self.sensed.map(|sensed| Course { from: sensed.odometry, distance_m });
        self.readings_standing = 0;
    }

    fn come_to_spot(&mut self) {
        let at = self.pose().at;
        if at.distance(self.spot.at) > self.settings.same_spot_m {
            self.spot = Spot { at, ..Spot::default() };
        }
    }

    fn reached(&mut self, facts: &StateFacts) -> Option<Ending> {
        if facts.has_goal && facts.distance_m <= self.settings.goal_tolerance_m {
            let reached = self.legs.pop_front()?;
            self.tell(Happening::Reached(reached));
            return self.legs.is_empty().then_some(Ending::Arrived);
        }
        None
    }

    fn take_detour(&mut self, pick: impl Fn(Detours) -> (Option<Vec<Point>>, Option<Vec<Point>>)) {
        let (taken, other) = pick(self.detours.take().unwrap_or_default());
        let Some(points) = taken else { return };
        self.spot.detours += 1;
        self.legs.pop_front();
        for &point in points.iter().skip(1).rev() {
            self.legs.push_front(point);
        }
        let other_m = other.map(|points| length(&points));
        self.tell(Happening::Detour { length_m: length(&points), points, other_m });
    }

    fn close(&mut self, judge: &mut impl Judge) {
        self.spot.closed += 1;
        let at = self.pose().at;
        let reach = self.radius_m + self.settings.detour_clearance_m;
        if let Some(&target) = self.legs.front() {
            let free = free_ahead(at, target, reach, &self.barriers);
            let share = free.metres / at.distance(target).max(1e-9);
            let stop = Point::new(at.x + share * (target.x - at.x), at.y + share * (target.y - at.y));
            let met = free.by.map(|by| self.barriers[by]);
            let at = met.map_or(stop, |barrier| stop.nearest_on(barrier.a, barrier.b));
            let (doorway, region) = self.blocked.note(&self.building.network, at, reach);
            self.tell(Happening::WayClosed { at, doorway, region });
        }
        self.replans += 1;
        // What is in the way of another path has to be seen again before that one counts as closed, too.
        self.readings_standing = 0;
        self.part.clear();
        let is_stuck = self.spot.closed > 2;
        self.plan(judge, is_stuck);
    }

    fn retry(&mut self, judge: &mut impl Judge) {
        let estimate = *self.model.estimate();
        self.model = LocalModel::new(*self.model.settings(), estimate);
        if let Some(sensed) = self.sensed {
            self.model.reckon(&sensed.odometry);
            self.model.set_estimate(estimate);
        }
        (self.memory, self.spot) = (Memory::default(), Spot::default());
        self.blocked = Blocked::new(&self.building.network);
        (self.retries, self.scans) = (self.retries + 1, 0);
        self.felt.clear();
        self.part.clear();
        self.gather();
        self.tell(Happening::Retried);
        self.plan(judge, false);
    }

    /// Looks for a path to the goal over the network; through free space as it is known where that has none.
    fn plan(&mut self, judge: &mut impl Judge, is_off_network: bool) {
        let Some(goal) = self.goal else { return };
        let ends = [self.pose().at, goal];
        let mut barriers = self.barriers[..self.obstacles_from].to_vec();
        // Where detours found nothing again and again, what they saw in the way counts, too.
        let confidence = if is_off_network { 1 } else { self.settings.least_confidence };
        barriers.extend(self.obstacles(confidence));
        let ground = self.ground(&barriers);
        let mut route = None;
        if !is_off_network {
            route = over_network(self.building, ground, &self.blocked, ends, judge);
        }
        let route = route.or_else(|| off_network(self.building, ground, ends));
        self.has_way = route.is_some();
        self.legs.clear();
        if let Some(Route { points, length_m, is_off_network }) = route {
            self.legs.extend(points.iter().skip(1));
            self.tell(Happening::Planned { points, length_m, is_off_network });
        }
        self.detours = None;
    }

    fn is_scan_complete(&self) -> bool {
        self.readings_standing >= self.settings.scan_readings
    }

    fn pose(&self) -> Pose {
        self.model.estimate().pose
    }

    fn time_s(&self) -> f64 {
        self.sensed.map_or(0.0, |sensed| sensed.time_s)
    }

    fn tell(&mut self, what: Happening) {
        let (time_s, pose) = (self.time_s(), self.pose());
        self.events.push(Event { time_s, pose, what });
    }
}
