//! What is known of the building at one moment: where there is free space, where it ends without a wall, and where the robot
//! can go.

use std::collections::VecDeque;

use super::grid::{Cell, Cells, GRAIN_M, cell_of, middle_of, touched};
use crate::geometry::{Point, Segment};
use crate::navigation::highway::{is_clear, straightened};
use crate::rim::Rim;
use crate::search::grid::{AROUND, BESIDE, LeastCosts, STRAIGHT, least_costs, step};

/// Beside what was seen free so many cells count as free, too: beams end before a wall, and leave out what lies between them.
const BEYOND: u32 = 3;

/// The robot may stand so far from the next cell of the ground, metres.
const NEAR_M: f64 = 0.5;

/// An opening that lets no one come near is looked at from so far, metres.
const FAR_M: f64 = 4.0;

/// So many cells of an opening are looked at.
const LOOKED_AT: usize = 12;

/// Cells where free space ends without a wall, side by side.
#[derive(Clone, Debug)]
pub(super) struct Frontier {
    /// The cell nearest to the middle of all.
    pub middle: Point,
    points: Vec<Point>,
    /// From one end to the other, metres.
    pub width_m: f64,
}

/// Where the robot can go to look into an opening.
#[derive(Clone, Copy, Debug)]
pub(super) struct LookOut {
    index: usize,
    /// Metres from the robot.
    pub distance_m: f64,
}

/// Free space as it is known, walls without thickness between.
#[derive(Clone, Debug)]
pub(super) struct Ground {
    /// Cells that a wall passes.
    pub walls: Cells,
    /// Cells that are free and joined with where the robot is.
    pub free: Cells,
    /// Where the middle of the robot can be.
    standing: Cells,
    /// The ways from where the robot is.
    ways: LeastCosts,
}

impl Ground {
    /// Free space that is joined with a place.
    ///
    /// # Arguments
    /// `reach_m` is how far the robot's middle keeps from walls and from what is not known.
    pub fn new(seen: &Cells, walls: &[Segment], robot: Point, reach_m: f64) -> Self {
        let window = seen.window;
        let mut drawn = Cells::none(window);
        for wall in walls {
            drawn.draw(wall);
        }
        let free = spread(seen, &drawn, robot);
        let standing = standing(&free, &drawn, reach_m);
        let mut ground = Self { walls: drawn, free, standing, ways: LeastCosts::default() };
        ground.walk(robot);
        ground
    }

    /// Where free space ends without a wall, from the first cell on.
    pub fn frontiers(&self) -> Vec<Frontier> {
        let window = self.free.window;
        let mut left = Cells::none(window);
        for cell in self.free.iter().filter(|cell| self.is_rim(*cell)) {
            left.take(cell);
        }
        let mut done = Cells::none(window);
        let mut frontiers = Vec::new();
        for first in left.iter() {
            if !done.take(first) {
                continue;
            }
            let mut cells = vec![first];
            let mut next = 0;
            while let Some(&(column, row)) = cells.get(next) {
                next += 1;
                let around = AROUND.iter().map(|(dx, dy)| (column + dx, row + dy));
                cells.extend(around.filter(|cell| left.has(*cell) && done.take(*cell)));
            }
            frontiers.push(Frontier::new(&cells));
        }
        frontiers
    }

    /// Cells beyond the frontiers, two deep, with the walls that they meet.
    pub fn beyond(&self) -> Cells {
        let mut beyond = Cells::none(self.free.window);
        let mut layer: Vec<Cell> = self.free.iter().filter(|cell| self.is_rim(*cell)).collect();
        for _ in 0..2 {
            let mut next = Vec::new();
            for (column, row) in layer {
                for (dx, dy) in AROUND {
                    let cell = (column + dx, row + dy);
                    if !self.free.has(cell) && beyond.take(cell) && !self.walls.has(cell) {
                        next.push(cell);
                    }
                }
            }
            layer = next;
        }
        beyond
    }

    /// From where to look into an opening: near to it and to the robot, with nothing between; `None` where no such place
    /// can be reached.
    ///
    /// # Arguments
    /// `far_m` is how near it has to be, if that can be; the middle of the opening is looked at, if that can be.
    pub fn look_out(&self, frontier: &Frontier, far_m: f64) -> Option<LookOut> {
        let nearest = |far_m: f64| {
            let found = frontier.points.iter().filter_map(|point| self.look_at(*point, far_m));
            found.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m))
        };
        self.look_at(frontier.middle, far_m).or_else(|| nearest(far_m)).or_else(|| nearest(FAR_M))
    }

    fn look_at(&self, towards: Point, far_m: f64) -> Option<LookOut> {
        let far = (far_m / GRAIN_M).ceil() as i32;
        let (column, row) = cell_of(towards);
        let mut found: Vec<(u64, usize)> = Vec::new();
        for dy in -far..=far {
            for dx in -far..=far {
                let cell = (column + dx, row + dy);
                let Some(index) = self.free.window.index(cell) else { continue };
                let left_m = middle_of(cell).distance(towards);
                if let Some(cost) = self.ways.cost(index)
                    && left_m <= far_m
                {
                    // nearer to the opening is worth a way that is longer by twice as much
                    let left = (left_m / GRAIN_M * 2.0 * f64::from(STRAIGHT)) as u64;
                    found.push((u64::from(cost) + left, index));
                }
            }
        }
        found.sort_unstable();
        let is_seen = |index: &usize| self.is_open(middle_of(self.free.window.cell(*index)), towards);
        let (_, index) = found.into_iter().find(|(_, index)| is_seen(index))?;
        let cost = self.ways.cost(index)?;
        Some(LookOut { index, distance_m: f64::from(cost) * GRAIN_M / f64::from(STRAIGHT) })
    }

    /// The way to a look-out from where the robot is, straight from point to point; without its begin.
    ///
    /// # Arguments
    /// `reach_m` is what the robot's middle keeps from `walls` at the least.
    pub fn way(&self, robot: Point, to: LookOut, walls: &[Segment], reach_m: f64) -> Vec<Point> {
        let steps = self.ways.way(to.index).into_iter().map(|index| middle_of(self.free.window.cell(index)));
        let points: Vec<Point> = std::iter::once(robot).chain(steps).collect();
        // Where the robot is may be no ground, and the way from there to it is short.
        let is_ground = |a: Point, b: Point| touched(a, b).all(|cell| a == robot || self.standing.has(cell));
        let is_open = |a: Point, b: Point| a != robot || self.is_open(a, b);
        let straight = straightened(&points, |a, b| {
            is_ground(a, b) && is_open(a, b) && is_clear(&Rim::disc(0.0), a, b, reach_m, walls)
        });
        straight[1..].to_vec()
    }

    /// Whether free space, and nothing else, lies between two points; the last cell may be anything.
    pub fn is_open(&self, from: Point, to: Point) -> bool {
        let last = cell_of(to);
        touched(from, to).all(|cell| cell == last || (self.free.has(cell) && !self.walls.has(cell)))
    }

    fn is_rim(&self, (column, row): Cell) -> bool {
        let is_open = |cell: Cell| !self.free.has(cell) && !self.walls.has(cell);
        !self.walls.has((column, row)) && BESIDE.iter().any(|(dx, dy)| is_open((column + dx, row + dy)))
    }

    /// Finds the shortest ways from where the robot is (Dijkstra).
    fn walk(&mut self, robot: Point) {
        let window = self.free.window;
        let first = nearest(robot, |cell| self.standing.has(cell)).and_then(|cell| window.index(cell));
        let standing = &self.standing;
        let next = |index: usize| {
            let (column, row) = window.cell(index);
            AROUND.into_iter().filter_map(move |(dx, dy)| {
                let cell = (column + dx, row + dy);
                window.index(cell).filter(|_| standing.has(cell)).map(|next| (next, step((dx, dy))))
            })
        };
        let ways = first.map(|first| least_costs(window.len(), first, None, |_| 0, next));
        self.ways = ways.unwrap_or_default();
    }
}

impl Frontier {
    fn new(cells: &[Cell]) -> Self {
        let points: Vec<Point> = cells.iter().map(|cell| middle_of(*cell)).collect();
        let count = points.len().max(1) as f64;
        let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.x, y + p.y));
        let centre = Point::new(x / count, y / count);
        let near = |a: &&Point, b: &&Point| a.distance(centre).total_cmp(&b.distance(centre));
        let middle = points.iter().min_by(near).copied().unwrap_or(centre);
        let extent = |of: fn(&Point) -> f64| {
            let values = points.iter().map(of);
            values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
        };
        let each = points.len().div_ceil(LOOKED_AT).max(1);
        let looked_at = points.iter().step_by(each).copied().collect();
        Self { middle, points: looked_at, width_m: extent(|p| p.x).hypot(extent(|p| p.y)) + GRAIN_M }
    }
}

/// The cell nearest to a point that passes a test, up to half a metre away.
fn nearest(p: Point, passes: impl Fn(Cell) -> bool) -> Option<Cell> {
    let far = (NEAR_M / GRAIN_M) as i32;
    let (column, row) = cell_of(p);
    let around = (-far..=far).flat_map(|dy| (-far..=far).map(move |dx| (column + dx, row + dy)));
    around
        .filter(|cell| passes(*cell))
        .min_by(|a, b| p.distance(middle_of(*a)).total_cmp(&p.distance(middle_of(*b))))
}

/// What was seen free and is joined with a place, and a little beside it; walls end it.
fn spread(seen: &Cells, walls: &Cells, from: Point) -> Cells {
    let window = seen.window;
    let mut free = Cells::none(window);
    let Some(first) = nearest(from, |cell| seen.has(cell) && !walls.has(cell)) else { return free };
    // how many cells lie between each cell and what was seen
    let mut gap = vec![u32::MAX; window.len()];
    let mut open = VecDeque::from([first]);
    if let Some(index) = window.index(first) {
        gap[index] = 0;
    }
    while let Some((column, row)) = open.pop_front() {
        let Some(so_far) = window.index((column, row)).map(|index| gap[index]) else { continue };
        free.take((column, row));
        for (dx, dy) in BESIDE {
            let cell = (column + dx, row + dy);
            let Some(index) = window.index(cell).filter(|_| !walls.has(cell)) else { continue };
            let next = if seen.has(cell) { 0 } else { so_far + 1 };
            if next <= BEYOND && next < gap[index] {
                gap[index] = next;
                open.push_back(cell);
            }
        }
    }
    free
}

/// Free cells that are far enough from walls and from what is not known.
fn standing(free: &Cells, walls: &Cells, reach_m: f64) -> Cells {
    let window = free.window;
    let far = (reach_m / GRAIN_M).ceil() as i32;
    let is_within = |dx: i32, dy: i32| f64::from(dx).hypot(f64::from(dy)) * GRAIN_M < reach_m;
    let disc: Vec<Cell> = (-far..=far)
        .flat_map(|dy| (-far..=far).map(move |dx| (dx, dy)))
        .filter(|(dx, dy)| is_within(*dx, *dy))
        .collect();
    let is_known = |cell: Cell| free.has(cell) && !walls.has(cell);
    let (mut edges, mut taken) = (Cells::none(window), Cells::none(window));
    for (column, row) in free.iter() {
        let around = AROUND.iter().map(|(dx, dy)| (column + dx, row + dy));
        for edge in around.filter(|edge| !is_known(*edge)) {
            if edges.take(edge) {
                for (dx, dy) in &disc {
                    taken.take((edge.0 + dx, edge.1 + dy));
                }
            }
        }
    }
    let mut standing = Cells::none(window);
    for cell in free.iter().filter(|cell| !taken.has(*cell)) {
        standing.take(cell);
    }
    standing
}
