//! Free space for a robot, as it stands, among barriers, and the shortest paths through it.

use super::free_grid::FreeGrid;
use super::highway::{is_clear, straightened};
use crate::geometry::{Point, Rect, Segment};
use crate::rim::Rim;

/// The grid may lack a cell at an end of a path; the nearest one up to so far is taken, metres.
const NEAR_M: f64 = 0.4;

/// What a robot keeps from what, and how finely paths are looked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'b> {
    /// Whatever the robot must not touch.
    pub barriers: &'b [Segment],
    /// From this index on they are obstacles, before it walls.
    pub obstacles_from: usize,
    pub rim: Rim,
    /// What the robot keeps from barriers, metres, as [`Rim::distance`] has it.
    pub reach: f64,
    /// What it keeps from barriers at the goal, at the least, metres.
    pub least: f64,
    /// By how much a detour may leave the rectangle about its ends, metres.
    pub aside: f64,
    /// The grain of the search, metres.
    pub grain: f64,
}

/// Free space in a window.
#[derive(Clone, Debug)]
pub(super) struct Field {
    grid: FreeGrid,
    barriers: Vec<Segment>,
    /// Lines that no path crosses, though it may come near them.
    cuts: Vec<Segment>,
    rim: Rim,
    reach: f64,
    least: f64,
    grain: f64,
}

impl Field {
    pub fn new(window: Rect, ground: &Ground) -> Self {
        let Ground { barriers, rim, reach, least, grain, .. } = *ground;
        let is_near = |barrier: &&Segment| {
            let (dx, dy) = barrier.bounds().axis_gaps(&window);
            dx.max(dy) <= reach + rim.core_m()
        };
        let barriers: Vec<Segment> = barriers.iter().filter(is_near).copied().collect();
        let mut grid = FreeGrid::new(window, grain);
        for barrier in &barriers {
            grid.block(&rim, barrier, reach);
        }
        Self { grid, barriers, cuts: Vec::new(), rim, reach, least, grain }
    }

    /// The same for paths that do not cross a line.
    pub fn cut(&self, line: &Segment) -> Self {
        let mut field = self.clone();
        field.grid.block(&Rim::disc(0.0), line, 0.75 * self.grain);
        field.cuts.push(*line);
        field
    }

    /// The shortest path, straight from point to point; its ends may be nearer to barriers than the rest.
    pub fn path(&self, from: Point, to: Point) -> Option<Vec<Point>> {
        if self.barriers.iter().any(|barrier| self.rim.distance(to, barrier) < self.least) {
            return None;
        }
        if self.is_clear(from, to) {
            return Some(vec![from, to]);
        }
        let first = self.grid.nearest(from, NEAR_M, |at| self.is_clear(from, at))?;
        let last = self.grid.nearest(to, NEAR_M, |at| self.is_clear(at, to))?;
        let mut points = vec![from];
        points.extend(self.grid.path(first, last)?);
        points.push(to);
        Some(straightened(&points, |from, to| self.is_clear(from, to)))
    }

    fn is_clear(&self, from: Point, to: Point) -> bool {
        let is_crossed = |cut: &Segment| Segment::new(from, to).meets(cut);
        is_clear(&self.rim, from, to, self.reach, &self.barriers) && !self.cuts.iter().any(is_crossed)
    }
}
