//! What beams have run through, as cells.

use super::grid::{Cell, Cells, GRAIN_M, Window, cell_of};
use crate::body::Reading;
use crate::geometry::{Point, Rect, Segment};
use crate::pose::{Pose, wrapped};

/// Readings farther apart than this say nothing of what lies between them, radians and metres.
const MOST_TURN: f64 = 0.13;
const MOST_STEP_M: f64 = 0.2;

/// Where no echo is heard, so much is free all the same, metres: the sonar misses some.
const SILENT_M: f64 = 2.0;

/// A beam that ends so near to a wall ends on it, metres.
const ON_WALL_M: f64 = 0.15;

/// What a beam that ends on no known wall leaves free before its echo: a share of the range.
const NOISE: f64 = 0.02;

/// Beams farther than this are not followed, metres: there they are too far apart.
const FAR_M: f64 = 6.0;

/// So many cells are added where the window has to grow.
const SPARE: i32 = 100;

/// A beam in the frame of the model.
#[derive(Clone, Copy, Debug)]
struct Beam {
    from: Point,
    direction: f64,
    range_m: f64,
}

/// What was seen free so far.
#[derive(Clone, Debug, Default)]
pub(in crate::navigation) struct Seen {
    free: Cells,
    last: Option<Beam>,
}

impl Seen {
    pub(super) fn free(&self) -> &Cells {
        &self.free
    }

    /// Takes readings in, in their order.
    ///
    /// # Arguments
    /// `pose` is where the robot is thought to be when the wheels' count is `odometry`. Nothing is seen through `walls`,
    /// and where the robot stands it is free.
    pub fn look(
        &mut self,
        readings: &[Reading],
        pose: &Pose,
        odometry: &Pose,
        radius_m: f64,
        walls: &[Segment],
    ) {
        let at = pose.at;
        let reach = FAR_M + MOST_STEP_M + radius_m;
        let window = Window::around(&Rect::new(at.x - reach, at.y - reach, at.x + reach, at.y + reach));
        let window = self.free.window.with(&window, SPARE);
        if window != self.free.window {
            self.free = self.free.moved(window);
        }
        let is_near = |wall: &&Segment| wall.distance(at) < reach;
        let walls: Vec<Segment> = walls.iter().filter(is_near).copied().collect();
        for reading in readings {
            let from = pose.then(&odometry.to(&reading.odometry));
            let range_m = reading.range_m.unwrap_or(SILENT_M);
            let beam = Beam { from: from.at, direction: from.heading + reading.bearing, range_m };
            if let Some(last) = self.last.replace(beam) {
                self.sweep(&last, &beam, &walls);
            }
        }
        self.stand(at, radius_m);
    }

    fn stand(&mut self, at: Point, radius_m: f64) {
        let (column, row) = cell_of(at);
        let far = (radius_m / GRAIN_M) as i32;
        for dy in -far..=far {
            for dx in -far..=far {
                if dx * dx + dy * dy <= far * far {
                    self.free.take((column + dx, row + dy));
                }
            }
        }
    }

    /// What lies between two beams is free as far as both run, or up to the wall on which both end.
    fn sweep(&mut self, a: &Beam, b: &Beam, walls: &[Segment]) {
        let turn = wrapped(b.direction - a.direction);
        if turn.abs() > MOST_TURN || a.from.distance(b.from) > MOST_STEP_M {
            return;
        }
        let shorter = a.range_m.min(b.range_m);
        let count = (a.range_m.max(b.range_m).min(FAR_M) * turn.abs() / (0.7 * GRAIN_M)).ceil().max(1.0);
        for number in 0..=count as u32 {
            let share = f64::from(number) / count;
            let between = |a: f64, b: f64| a + share * (b - a);
            let from = Point::new(between(a.from.x, b.from.x), between(a.from.y, b.from.y));
            let (sin, cos) = (a.direction + share * turn).sin_cos();
            let towards = Point::new(cos, sin);
            let wall = walls.iter().filter_map(|wall| wall.hit(from, towards)).map(|(range, _)| range);
            let wall = wall.fold(f64::INFINITY, f64::min);
            let is_on_wall = (wall - between(a.range_m, b.range_m)).abs() <= ON_WALL_M;
            let open = shorter * (1.0 - NOISE) - GRAIN_M;
            self.run(from, towards, if is_on_wall { wall } else { open.min(wall) }.min(FAR_M));
        }
    }

    fn run(&mut self, from: Point, towards: Point, range_m: f64) {
        let mut last: Option<Cell> = None;
        for step in 0..(range_m / (0.7 * GRAIN_M)).max(0.0) as u32 {
            let far = f64::from(step) * 0.7 * GRAIN_M;
            let cell = cell_of(from + towards * far);
            if last != Some(cell) {
                self.free.take(cell);
                last = Some(cell);
            }
        }
    }
}
