//! The best way over a fine grid of (point, state), forty directions a point.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use adit_planners::geometry::Point;

use super::space::{ROUNDING, Space};
use super::taut::taut;
use super::way::Way;

/// One octant of the directions. Between two of all forty are at most 14.04 degrees, so that a way over the grid is
/// at most 0.76 % longer than the straight one.
const OCTANT: [(i32, i32); 6] = [(1, 0), (4, 1), (3, 1), (2, 1), (3, 2), (1, 1)];
const NOWHERE: u32 = u32::MAX;

/// A grid over the free space of every state, its first point in the environment's lower left corner.
pub struct Grid<'a> {
    space: &'a Space,
    step: f64,
    columns: usize,
    rows: usize,
    states: usize,
    /// By how much each state fits at each point: point by point, then state by state.
    spare: Vec<f32>,
    /// The least that a metre is multiplied by.
    lightest: f64,
    directions: Vec<(i32, i32, f64)>,
}

impl<'a> Grid<'a> {
    /// A grid with `step` metres between its points.
    pub fn new(space: &'a Space, step: f64) -> Self {
        let bounds = space.bounds();
        let count = |length: f64| (length / step + 1e-6).floor() as usize + 1;
        let (columns, rows) = (count(bounds.dx()), count(bounds.dy()));
        let states = space.body().states.len();
        let mut directions = Vec::new();
        for (a, b) in OCTANT {
            for (dx, dy) in [(a, b), (b, a), (-a, b), (-b, a), (a, -b), (b, -a), (-a, -b), (-b, -a)] {
                let length = f64::from(dx).hypot(f64::from(dy)) * step;
                if !directions.contains(&(dx, dy, length)) {
                    directions.push((dx, dy, length));
                }
            }
        }
        let mut grid = Self {
            space,
            step,
            columns,
            rows,
            states,
            spare: Vec::new(),
            lightest: space.lightest(),
            directions,
        };
        grid.spare = (0..columns * rows)
            .flat_map(|node| space.spares_at(grid.point(node)).map(|spare| spare as f32).collect::<Vec<_>>())
            .collect();
        grid
    }

    fn point(&self, node: usize) -> Point {
        let bounds = self.space.bounds();
        let (column, row) = (node % self.columns, node / self.columns);
        Point::new(bounds.x0 + column as f64 * self.step, bounds.y0 + row as f64 * self.step)
    }

    fn fits(&self, label: usize) -> bool {
        f64::from(self.spare[label]) >= -ROUNDING
    }

    /// Whether the state of a label may go straight to a neighbour. Between two points with room to spare no wall
    /// can be; only near to one is it looked for.
    fn is_open(&self, from: usize, to: usize, length: f64) -> bool {
        let spare = f64::from(self.spare[from]) + f64::from(self.spare[to]) - length;
        spare > 1e-6
            || self.space.is_free(
                from % self.states,
                self.point(from / self.states),
                self.point(to / self.states),
            )
    }

    /// Labels from which a state fits straight on the way to `p`, with that way's hardness.
    fn beside(&self, p: Point) -> Vec<(usize, f64)> {
        let bounds = self.space.bounds();
        let near = |at: f64, low: f64, count: usize| {
            let middle = ((at - low) / self.step).round().max(0.0) as usize;
            middle.saturating_sub(2)..(middle + 3).min(count)
        };
        let mut labels = Vec::new();
        for row in near(p.y, bounds.y0, self.rows) {
            for column in near(p.x, bounds.x0, self.columns) {
                let node = row * self.columns + column;
                for state in 0..self.states {
                    let here = self.point(node);
                    if self.space.is_free(state, here, p) {
                        labels.push((node * self.states + state, self.space.weigh(state, here, p)));
                    }
                }
            }
        }
        labels
    }

    /// The best ways from a point to all that can be reached from it.
    pub fn ways_from(&self, start: Point) -> Ways<'_> {
        let mut ways = Ways {
            grid: self,
            start,
            cost: vec![f64::INFINITY; self.spare.len()],
            before: vec![NOWHERE; self.spare.len()],
        };
        let mut queue = BinaryHeap::new();
        for (label, cost) in self.beside(start) {
            ways.offer(label, cost, NOWHERE, &mut queue);
        }
        // The bits of floats that are not negative stand in the order of the floats.
        while let Some(Reverse((bits, label))) = queue.pop() {
            let cost = f64::from_bits(bits);
            if cost <= ways.cost[label as usize] {
                self.settle(label as usize, cost, &mut ways, &mut queue);
            }
        }
        ways
    }

    fn settle(&self, label: usize, cost: f64, ways: &mut Ways<'_>, queue: &mut Queue) {
        let (node, state) = (label / self.states, label % self.states);
        let body = self.space.body();
        for other in 0..self.states {
            let next = node * self.states + other;
            if other != state && self.fits(next) {
                ways.offer(next, cost + body.change(state, other), label as u32, queue);
            }
        }
        let here = self.point(node);
        let (column, row) = ((node % self.columns) as i32, (node / self.columns) as i32);
        for &(dx, dy, length) in &self.directions {
            let (x, y) = (column + dx, row + dy);
            if x < 0 || y < 0 || x >= self.columns as i32 || y >= self.rows as i32 {
                continue;
            }
            let next = (y as usize * self.columns + x as usize) * self.states + state;
            let least = cost + length * body.states[state].hardness * self.lightest;
            if least >= ways.cost[next] {
                continue;
            }
            let after = cost + self.space.weigh(state, here, self.point(next / self.states));
            if after < ways.cost[next] && self.fits(next) && self.is_open(label, next, length) {
                ways.offer(next, after, label as u32, queue);
            }
        }
    }
}

type Queue = BinaryHeap<Reverse<(u64, u32)>>;

/// The best ways over a grid from one point.
pub struct Ways<'a> {
    grid: &'a Grid<'a>,
    start: Point,
    cost: Vec<f64>,
    before: Vec<u32>,
}

impl Ways<'_> {
    fn offer(&mut self, label: usize, cost: f64, before: u32, queue: &mut Queue) {
        if cost < self.cost[label] {
            self.cost[label] = cost;
            self.before[label] = before;
            queue.push(Reverse((cost.to_bits(), label as u32)));
        }
    }

    /// The best way over the grid to a point; `None` where no state comes there.
    pub fn over_the_grid(&self, goal: Point) -> Option<Way> {
        let total = |&(label, leg): &(usize, f64)| self.cost[label] + leg;
        let last = self.grid.beside(goal).into_iter().filter(|end| total(end).is_finite());
        let (mut label, _) = last.min_by(|a, b| total(a).total_cmp(&total(b)))?;
        let states = self.grid.states;
        let mut labels = vec![label];
        while self.before[label] != NOWHERE {
            label = self.before[label] as usize;
            labels.push(label);
        }
        labels.reverse();
        let mut way = Way { points: vec![self.start], states: Vec::new() };
        for label in &labels {
            way.points.push(self.grid.point(label / states));
            way.states.push(label % states);
        }
        way.states.push(labels[labels.len() - 1] % states);
        way.points.push(goal);
        Some(way)
    }

    /// The best way to a point, drawn taut.
    pub fn to(&self, goal: Point) -> Option<Way> {
        Some(taut(self.grid.space, &self.over_the_grid(goal)?, self.grid.step))
    }
}
