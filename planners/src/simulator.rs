//! A simulated robot among walls: wheels that slip, a rotating sonar that errs, a skirt that feels contact, and things in the
//! way that no model knows.
//!
//! A navigator drives it as a [`Body`], and is not told that it is a simulation. The truth is for judges and for pictures:
//! [`Simulator::pose`], [`Simulator::touches`], [`Film`]. All errors come from the seed: the same seed and the same commands
//! give the same readings, to the bit.
//!
//! # Example
//! ```
//! use adit_planners::body::{Body, Command};
//! use adit_planners::geometry::Point;
//! use adit_planners::pose::Pose;
//! use adit_planners::geometry::Segment;
//! use adit_planners::simulator::{Settings, Simulator};
//!
//! let wall = Segment::new(Point::new(2.0, -5.0), Point::new(2.0, 5.0));
//! let mut robot = Simulator::new(&[wall], Vec::new(), Settings::exact(), Pose::default(), 1)?;
//! robot.command(Command::Move { distance_m: 3.0, bearing: 0.0, speed_m_s: 0.5 });
//! let sensed = std::iter::repeat_with(|| robot.sense().unwrap()).find(|sensed| !sensed.is_busy).unwrap();
//! assert_eq!(sensed.contact.unwrap().bearing, 0.0);
//! assert!((robot.pose().at.x - 1.75).abs() < 1e-8);
//! # Ok::<(), adit_planners::simulator::SimulationError>(())
//! ```

mod error;
mod film;
mod obstacle;
mod settings;
mod shape;

pub use error::SimulationError;
pub use film::{Film, Frame};
pub use obstacle::{Course, Obstacle};
pub use settings::Settings;
pub use shape::{Shape, Shapes};

use std::f64::consts::TAU;

use obstacle::Mover;

use crate::body::{Body, Command, Contact, Reading, Sensed, Silence};
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, RayGrid, Rect, Segment, polygon};
use crate::pose::{Pose, wrapped};
use crate::random::Random;
use crate::rim::{Rim, Touch};

/// A robot in a building, with the truth about it.
#[derive(Clone, Debug)]
pub struct Simulator {
    settings: Settings,
    shapes: Shapes,
    /// The shape in which it is.
    shape: usize,
    walls: RayGrid,
    movers: Vec<Mover>,
    random: Random,
    pose: Pose,
    odometry: Pose,
    /// How often it was sensed.
    steps: u64,
    task: Task,
    touches: Vec<TouchEvent>,
}

/// A touch, as a judge sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchEvent {
    pub time_s: f64,
    pub at: Point,
    /// The obstacle that was touched, by its number from 0; `None` for a wall.
    pub obstacle: Option<usize>,
    /// Whether the robot went towards it. An obstacle that runs into a robot which stands, or goes elsewhere, is not the
    /// robot's collision.
    pub by_robot: bool,
}

/// What is left to do of a command.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Task {
    Rest,
    Turn {
        left: f64,
    },
    /// Wheels go as far as they count; `scale` is how far that really is.
    Move {
        left_m: f64,
        bearing: f64,
        speed_m_s: f64,
        scale: f64,
    },
    Change {
        to: usize,
        left_s: f64,
    },
}

/// One step of the wheels: what they count, and the truth.
#[derive(Clone, Copy, Default)]
struct Step {
    counted_m: f64,
    way: Point,
    turn: f64,
}

impl Simulator {
    /// A robot at a pose among walls and obstacles.
    pub fn new(
        walls: &[Segment],
        obstacles: Vec<Obstacle>,
        settings: Settings,
        start: Pose,
        seed: u64,
    ) -> Result<Self, SimulationError> {
        check(walls, &obstacles, &settings, &start)?;
        let simulator = Self {
            shapes: Shapes::one(&settings),
            shape: 0,
            settings,
            walls: RayGrid::new(walls.to_vec()),
            movers: obstacles.into_iter().map(Mover::new).collect(),
            random: Random::new(seed),
            pose: start,
            odometry: Pose::default(),
            steps: 0,
            task: Task::Rest,
            touches: Vec::new(),
        };
        simulator.start_is_free().map(|()| simulator)
    }

    /// The same robot at the same place, with these shapes, in one of them.
    ///
    /// # Errors
    /// Where there is no such shape, a figure of one makes no sense, or the robot does not fit there in it.
    pub fn in_shape(mut self, shapes: Shapes, shape: usize) -> Result<Self, SimulationError> {
        shapes.check(shape)?;
        (self.shapes, self.shape) = (shapes, shape);
        self.start_is_free().map(|()| self)
    }

    /// Where the robot really is.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// The shape in which it is, by number.
    pub fn shape(&self) -> usize {
        self.shape
    }

    /// Where the robot's rim is, the middle being the origin; while it changes its shape, that of the larger one.
    pub fn widest(&self) -> Rim {
        let [now, then] = [self.shape, self.becoming()].map(|shape| self.rim_in(shape));
        if then.outer_m() > now.outer_m() { then } else { now }
    }

    fn rim_in(&self, shape: usize) -> Rim {
        self.shapes.all[shape].rim.turned(self.pose.heading)
    }

    fn placed(&self) -> Rim {
        self.rim_in(self.shape)
    }

    /// The shape into which it changes; the one in which it is, where it does not.
    fn becoming(&self) -> usize {
        match self.task {
            Task::Change { to, .. } => to,
            _ => self.shape,
        }
    }

    /// How deep something is within the robot, metres; below 0 where there is a gap. While it changes its shape, in either one.
    pub fn overlap_m(&self) -> f64 {
        let at = self.pose.at;
        let in_shape = |shape: usize| {
            let rim = self.rim_in(shape);
            let sides = self.obstacles().flatten().chain(self.walls());
            let nearest = sides.map(|side| rim.distance(at, side)).fold(f64::INFINITY, f64::min);
            let above = self.shapes.all[shape].overhead.iter().map(|low| beneath(&rim, at, low));
            rim.radius_m() - above.fold(nearest, f64::min)
        };
        in_shape(self.shape).max(in_shape(self.becoming()))
    }

    /// Takes the robot elsewhere, of which its wheels count nothing, and stops it.
    pub fn put(&mut self, pose: Pose) -> Result<(), SimulationError> {
        let before = std::mem::replace(&mut self.pose, pose);
        let free = self.start_is_free();
        match free {
            Ok(()) => self.task = Task::Rest,
            Err(_) => self.pose = before,
        }
        free
    }

    /// Puts things that stand, by their corners, in place of the obstacles that there were.
    pub fn place(&mut self, things: Vec<Vec<Point>>) {
        let standing = things.into_iter().map(|corners| Mover::new(Obstacle { corners, course: None }));
        self.movers = standing.collect();
    }

    /// Where the wheels' count puts the robot, from the pose 0, 0, 0 at the beginning.
    pub fn odometry(&self) -> Pose {
        self.odometry
    }

    /// Seconds since it was switched on.
    pub fn time_s(&self) -> f64 {
        self.steps as f64 * self.settings.reading_period_s
    }

    /// All touches so far, in the order of time. One that lasts is told once.
    pub fn touches(&self) -> &[TouchEvent] {
        &self.touches
    }

    pub(crate) fn touches_by_robot(&self) -> usize {
        self.touches.iter().filter(|touch| touch.by_robot).count()
    }

    pub fn walls(&self) -> &[Segment] {
        self.walls.segments()
    }

    /// The outlines of the obstacles where they are now, by their sides.
    pub fn obstacles(&self) -> impl Iterator<Item = &[Segment]> {
        self.movers.iter().map(|mover| mover.sides.as_slice())
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Metres from a point in a direction (of length 1) to the first wall or obstacle; `None` beyond the sonar's hearing.
    pub fn range(&self, from: Point, towards: Point) -> Option<f64> {
        let reach = self.settings.sonar_range_m;
        let wall = self.walls.cast(from, towards, reach).map(|echo| echo.distance);
        let sides = self.movers.iter().flat_map(|mover| &mover.sides);
        let hits = sides.filter_map(|side| side.hit(from, towards)).map(|(range, _)| range);
        hits.filter(|range| *range <= reach).chain(wall).min_by(f64::total_cmp)
    }

    /// What it may touch besides walls that it can hear and obstacles.
    fn overhead(&self) -> impl Iterator<Item = Segment> + '_ {
        self.shapes.all[self.shape].overhead.iter().flat_map(polygon::sides_of_rect)
    }

    fn start_is_free(&self) -> Result<(), SimulationError> {
        let (at, rim) = (self.pose.at, self.placed());
        let low = self.shapes.all[self.shape].overhead.iter();
        let low = low.map(|low| (beneath(&rim, at, low).max(0.0), "what is too low for it".to_owned()));
        let walls = self.walls.segments().iter().enumerate();
        let walls = walls.map(|(i, wall)| (rim.distance(at, wall), format!("wall {}", i + 1)));
        let obstacles = self.movers.iter().enumerate().map(|(i, mover)| {
            let gap = mover.sides.iter().map(|side| rim.distance(at, side)).fold(f64::INFINITY, f64::min);
            (
                if polygon::encloses(mover.sides.iter().copied(), at) { 0.0 } else { gap },
                format!("obstacle {}", i + 1),
            )
        });
        let mut near = walls.chain(obstacles).chain(low);
        near.find(|(gap, _)| !rim.is_clear_by(*gap)).map_or(Ok(()), |(gap_m, what)| {
            let radius_m = rim.is_disc().then(|| rim.radius_m());
            Err(SimulationError::Start { x: at.x, y: at.y, gap_m, what, radius_m })
        })
    }

    /// What the wheels want to do until the next reading.
    fn step(&mut self) -> Step {
        let period = self.settings.reading_period_s;
        match self.task {
            Task::Rest | Task::Change { .. } => Step::default(),
            Task::Turn { left } => {
                let most = self.settings.turning_speed * period;
                Step { turn: left.clamp(-most, most), ..Step::default() }
            }
            Task::Move { left_m, bearing, speed_m_s, scale } => {
                let most = speed_m_s * period;
                let counted_m = left_m.clamp(-most, most);
                let far = counted_m.abs();
                let turn = self.settings.heading_noise * self.random.normal() * far.sqrt()
                    + self.settings.heading_bias * far;
                let towards = self.pose.direction(bearing + turn / 2.0);
                let true_m = counted_m * scale;
                Step { counted_m, way: Point::new(true_m * towards.x, true_m * towards.y), turn }
            }
        }
    }

    /// Moves the robot and the obstacles until the next reading, or until they touch.
    fn advance(&mut self) {
        let step = self.step();
        let (now, period) = (self.time_s(), self.settings.reading_period_s);
        let ways: Vec<Point> = (0..self.movers.len()).map(|i| self.way(i, now, period)).collect();
        let first = self.first_touch(&step, &ways);
        let robot_moved = step.way != Point::default();
        let mut share = 1.0;
        if let Some((touch, obstacle)) = first {
            // A robot that stands is not moved by what touches it; one that moves stops there.
            share = if robot_moved { touch.share } else { 1.0 };
            let time_s = now + touch.share * period;
            let ahead = (touch.at - self.pose.at).dot(step.way);
            self.touches.push(TouchEvent { time_s, at: touch.at, obstacle, by_robot: ahead > 0.0 });
        }
        self.pose.at = self.pose.at + step.way * share;
        // what stopped it is felt before the body drifts off it
        let is_stopped = first.is_some() && robot_moved;
        let by = if is_stopped && !self.placed().is_disc() { 0.0 } else { share * step.turn };
        let held = self.free_turn(by);
        let turn = held.unwrap_or(by);
        self.pose.heading = wrapped(self.pose.heading + turn);
        for (i, way) in ways.iter().enumerate() {
            let robot_way = Point::new(share * step.way.x, share * step.way.y);
            let free = self.free_share(i, *way, robot_way, share);
            self.movers[i].go(Point::new(free * way.x, free * way.y));
        }
        self.count(&Step { turn, ..step }, share, held.is_some() || is_stopped);
    }

    /// How far the robot turns, radians, where it touches something by that; `None` where it turns freely.
    fn free_turn(&mut self, by: f64) -> Option<f64> {
        let rim = self.shapes.all[self.shape].rim;
        if rim.is_disc() {
            return None;
        }
        let walls = self.walls.around(self.pose.at, rim.outer_m() + SNAP_M).copied();
        let walls: Vec<Segment> = walls.chain(self.overhead()).collect();
        let by_wall = rim.turn(&self.pose, by, &walls).map(|touch| (touch, None));
        let by_thing =
            self.movers.iter().enumerate().filter_map(|(i, mover)| {
                rim.turn(&self.pose, by, &mover.sides).map(|touch| (touch, Some(i)))
            });
        let first = by_wall.into_iter().chain(by_thing);
        let (touch, obstacle) = first.min_by(|(one, _), (other, _)| one.share.total_cmp(&other.share))?;
        self.touches.push(TouchEvent { time_s: self.time_s(), at: touch.at, obstacle, by_robot: true });
        Some(touch.share * by)
    }

    /// What the robot touches first, if each went on as it wants to; what it touches is at its place at that time.
    fn first_touch(&self, step: &Step, ways: &[Point]) -> Option<(Touch, Option<usize>)> {
        let (at, rim) = (self.pose.at, self.placed());
        let reach = rim.outer_m() + step.way.length() + SNAP_M;
        let walls = self.walls.around(at, reach);
        let overhead = self.overhead().filter_map(|low| rim.touch(at, step.way, &low));
        let walls = walls.filter_map(|wall| rim.touch(at, step.way, wall));
        let walls = walls.chain(overhead).map(|touch| (touch, None));
        let obstacles = self.movers.iter().zip(ways).enumerate().flat_map(|(i, (mover, way))| {
            let relative = step.way - *way;
            let way = *way;
            mover.sides.iter().filter_map(move |side| {
                let touch = rim.touch(at, relative, side)?;
                let moved = touch.at + way * touch.share;
                Some((Touch { at: moved, ..touch }, Some(i)))
            })
        });
        walls.chain(obstacles).min_by(|(a, i), (b, j)| a.share.total_cmp(&b.share).then(i.cmp(j)))
    }

    /// How much of its way an obstacle goes, while the robot goes a way of its own in the first `robot_share` of the time.
    /// The robot is at the end of its way already.
    fn free_share(&self, mover: usize, way: Point, robot_way: Point, robot_share: f64) -> f64 {
        if way == Point::default() {
            return 0.0;
        }
        let (at, rim) = (self.pose.at, self.placed());
        let sides = &self.movers[mover].sides;
        let begin = at - robot_way;
        let together = Point::new(robot_way.x - robot_share * way.x, robot_way.y - robot_share * way.y);
        let least = |from: Point, relative: Point| {
            let touches = sides.iter().filter_map(|side| rim.touch(from, relative, side));
            touches.map(|touch| touch.share).fold(f64::INFINITY, f64::min)
        };
        let first = least(begin, together);
        if first < 1.0 {
            return first * robot_share;
        }
        let rest = Point::new(-(1.0 - robot_share) * way.x, -(1.0 - robot_share) * way.y);
        let from = begin + together;
        robot_share + (1.0 - robot_share) * least(from, rest).min(1.0)
    }

    /// The way that an obstacle tries to go. One that touches the robot waits until the way is free.
    fn way(&self, mover: usize, now_s: f64, step_s: f64) -> Point {
        let way = self.movers[mover].way(now_s, step_s);
        let (at, rim) = (self.pose.at, self.placed());
        let back = -way;
        let mut touches = self.movers[mover].sides.iter().filter_map(|side| rim.touch(at, back, side));
        if touches.any(|touch| touch.share <= 0.0) { Point::default() } else { way }
    }

    /// Lets the wheels count a step of which a share was done.
    fn count(&mut self, step: &Step, share: f64, has_touched: bool) {
        let is_turn = matches!(self.task, Task::Turn { .. });
        let turn = if is_turn { step.turn } else { 0.0 };
        let bearing = if let Task::Move { bearing, .. } = self.task { bearing } else { 0.0 };
        let counted = Point::towards(bearing) * (share * step.counted_m);
        self.odometry = self.odometry.then(&Pose { at: counted, heading: turn });
        self.task = match self.task {
            _ if has_touched => Task::Rest,
            Task::Turn { left } if (left - step.turn).abs() > 0.0 => Task::Turn { left: left - step.turn },
            Task::Change { to, left_s } if left_s > self.settings.reading_period_s => {
                Task::Change { to, left_s: left_s - self.settings.reading_period_s }
            }
            Task::Change { to, .. } => {
                self.shape = to;
                Task::Rest
            }
            Task::Move { left_m, bearing, speed_m_s, scale } if (left_m - step.counted_m).abs() > 0.0 => {
                Task::Move { left_m: left_m - step.counted_m, bearing, speed_m_s, scale }
            }
            _ => Task::Rest,
        };
    }

    /// A reading in one of the directions of a turn. As many numbers of chance are used for each, whatever it shows.
    fn read(&mut self, direction: u64) -> Reading {
        let bearing = wrapped(TAU * direction as f64 / f64::from(self.settings.readings_a_turn));
        let (kind, noise, place) = (self.random.share(), self.random.normal(), self.random.share());
        let reach = self.settings.sonar_range_m;
        let range_m = if kind < self.settings.missed {
            None
        } else if kind < self.settings.missed + self.settings.false_echoes {
            let least = self.placed().reach_m(self.pose.direction(bearing));
            Some(least + place * (reach - least).max(0.0))
        } else {
            let range = self.range(self.pose.at, self.pose.direction(bearing));
            let heard = range.map(|range| (range * (1.0 + self.settings.range_noise * noise)).max(0.0));
            heard.filter(|range| *range <= reach)
        };
        Reading { bearing, range_m, odometry: self.odometry }
    }

    fn contact(&self) -> Option<Contact> {
        let (at, rim) = (self.pose.at, self.placed());
        let walls = self.walls.around(at, rim.outer_m() + SNAP_M);
        let sides = self.movers.iter().flat_map(|mover| &mover.sides);
        let all = walls.chain(sides).copied().chain(self.overhead());
        let far = |side: &Segment| rim.distance(at, side);
        let nearest = all.min_by(|one, other| far(one).total_cmp(&far(other)))?;
        rim.feels(at, &nearest).then(|| Contact { bearing: self.pose.bearing(rim.nearest_on(at, &nearest)) })
    }
}

impl Body for Simulator {
    fn rim(&self) -> Rim {
        self.shapes.all[self.shape].rim
    }

    fn directions(&self) -> usize {
        self.settings.readings_a_turn.into()
    }

    fn command(&mut self, command: Command) {
        self.task = match command {
            Command::Turn { by } if by.is_finite() && by != 0.0 => Task::Turn { left: by },
            Command::Move { distance_m, bearing, speed_m_s }
                if distance_m.is_finite() && bearing.is_finite() && speed_m_s > 0.0 =>
            {
                let speed_m_s = speed_m_s.min(self.shapes.all[self.shape].greatest_speed_m_s);
                let scale = 1.0 + self.settings.distance_noise * self.random.normal();
                Task::Move { left_m: distance_m, bearing, speed_m_s, scale }
            }
            Command::Change { to } if to != self.shape && to < self.shapes.all.len() => {
                Task::Change { to, left_s: self.shapes.seconds(self.shape, to) }
            }
            _ => Task::Rest,
        };
    }

    fn sense(&mut self) -> Result<Sensed, Silence> {
        self.advance();
        let directions = u64::from(self.settings.readings_a_turn);
        let first = self.steps * u64::from(self.settings.readings_at_once);
        let readings = (first..)
            .take(self.settings.readings_at_once.into())
            .map(|n| self.read(n % directions))
            .collect();
        self.steps += 1;
        Ok(Sensed {
            time_s: self.time_s(),
            odometry: self.odometry,
            readings,
            contact: self.contact().filter(|_| self.settings.has_skirt),
            is_busy: self.task != Task::Rest,
            shape: self.shape,
        })
    }
}

/// As [`Rim::distance`], from what hangs low; below 0 where the middle is beneath it.
fn beneath(rim: &Rim, at: Point, low: &Rect) -> f64 {
    let sides = polygon::sides_of_rect(low);
    let far = sides.iter().map(|side| rim.distance(at, side)).fold(f64::INFINITY, f64::min);
    if low.contains(at) { -far } else { far }
}

fn check(
    walls: &[Segment],
    obstacles: &[Obstacle],
    settings: &Settings,
    start: &Pose,
) -> Result<(), SimulationError> {
    if let Some((name, value)) = settings.wrong() {
        return Err(SimulationError::Setting { name, value });
    }
    let walls = walls.iter().enumerate();
    let ends = walls.flat_map(|(i, wall)| [wall.a, wall.b].map(|p| (p, format!("an end of wall {}", i + 1))));
    let corners = obstacles.iter().enumerate().flat_map(|(i, obstacle)| {
        let course = obstacle.course.iter().flat_map(|course| &course.through);
        obstacle.corners.iter().chain(course).map(move |p| (*p, format!("a point of obstacle {}", i + 1)))
    });
    let heading = (Point::new(start.heading, 0.0), "the robot's heading".to_owned());
    let points = ends.chain(corners).chain([(start.at, "the robot".to_owned()), heading]);
    for (p, what) in points {
        if !(p.x.is_finite() && p.y.is_finite()) {
            return Err(SimulationError::NotFinite { what, x: p.x, y: p.y });
        }
    }
    for (number, obstacle) in (1..).zip(obstacles) {
        let corners = obstacle.corners.len();
        if corners < 3 {
            return Err(SimulationError::Outline { number, corners });
        }
        if let Some(course) = &obstacle.course
            && !(course.speed_m_s.is_finite() && course.speed_m_s >= 0.0 && course.starts_s.is_finite())
        {
            return Err(SimulationError::Speed { number, speed_m_s: course.speed_m_s });
        }
    }
    Ok(())
}
