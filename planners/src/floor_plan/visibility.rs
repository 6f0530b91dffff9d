//! What a ray meets first: barriers in a grid of square cells, walked along the ray (Amanatides and Woo 1987).

use crate::geometry::{Point, Rect};

/// So many barriers are meant to lie in a cell.
const PER_CELL: f64 = 1.0;

/// The most cells a grid has.
const MOST_CELLS: f64 = 1_000_000.0;

/// Cells reach so much further than their side, so that rounding loses no barrier on their edge; a share of it.
const OVERLAP: f64 = 1e-6;

/// Barriers, found by the rays that meet them.
#[derive(Clone, Debug)]
pub struct Visibility {
    barriers: Vec<[Point; 2]>,
    origin: Point,
    cell_m: f64,
    columns: usize,
    rows: usize,
    /// For each cell where its barriers begin in `listed`, and one more.
    begins: Vec<u32>,
    listed: Vec<u32>,
}

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// How far it went, metres.
    pub distance: f64,
    /// The barrier, by index.
    pub barrier: usize,
}

impl Visibility {
    /// Puts barriers into a grid; those with coordinates that are no finite numbers are never met.
    pub fn new(barriers: Vec<[Point; 2]>) -> Self {
        let is_finite = |wall: &&[Point; 2]| wall.iter().all(|p| p.x.is_finite() && p.y.is_finite());
        let ends = || barriers.iter().filter(is_finite).flatten();
        let nothing = Rect::new(f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
        let bounds = ends()
            .fold(nothing, |r, p| Rect::new(r.x0.min(p.x), r.y0.min(p.y), r.x1.max(p.x), r.y1.max(p.y)));
        let is_empty = bounds.x0 > bounds.x1;
        let cells = (barriers.len() as f64 / PER_CELL).clamp(1.0, MOST_CELLS);
        let (dx, dy) = if is_empty { (1.0, 1.0) } else { (bounds.dx().max(1e-3), bounds.dy().max(1e-3)) };
        let cell_m = (dx * dy / cells).sqrt().max(dx.max(dy) / MOST_CELLS);
        let (columns, rows) = ((dx / cell_m) as usize + 1, (dy / cell_m) as usize + 1);
        let origin = if is_empty { Point::default() } else { Point::new(bounds.x0, bounds.y0) };
        let (begins, listed) = (vec![0; columns * rows + 1], Vec::new());
        let mut grid = Self { barriers, origin, cell_m, columns, rows, begins, listed };
        grid.fill();
        grid
    }

    /// The barriers, in the order in which they were given.
    pub fn barriers(&self) -> &[[Point; 2]] {
        &self.barriers
    }

    fn fill(&mut self) {
        let mut places = Vec::new();
        for (number, wall) in (0_u32..).zip(&self.barriers) {
            let [low, high] = [f64::min, f64::max].map(|pick| {
                let p = Point::new(pick(wall[0].x, wall[1].x), pick(wall[0].y, wall[1].y));
                Point::new((p.x - self.origin.x) / self.cell_m, (p.y - self.origin.y) / self.cell_m)
            });
            if ![low, high].iter().all(|p| p.x.is_finite() && p.y.is_finite()) {
                continue;
            }
            let first = |v: f64| (v - OVERLAP).max(0.0) as usize;
            let last = |v: f64, count: usize| ((v + OVERLAP) as usize).min(count - 1);
            for row in first(low.y)..=last(high.y, self.rows) {
                for column in first(low.x)..=last(high.x, self.columns) {
                    if self.meets_cell(*wall, column, row) {
                        places.push(((row * self.columns + column) as u32, number));
                    }
                }
            }
        }
        places.sort_unstable();
        for &(cell, _) in &places {
            self.begins[cell as usize + 1] += 1;
        }
        for cell in 1..self.begins.len() {
            self.begins[cell] += self.begins[cell - 1];
        }
        self.listed = places.into_iter().map(|place| place.1).collect();
    }

    fn meets_cell(&self, [a, b]: [Point; 2], column: usize, row: usize) -> bool {
        let (half, slack) = (self.cell_m / 2.0, 1.0 + 4.0 * OVERLAP);
        let x = self.origin.x + (column as f64 + 0.5) * self.cell_m;
        let y = self.origin.y + (row as f64 + 0.5) * self.cell_m;
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let off = (dx * (y - a.y) - dy * (x - a.x)).abs();
        off <= half * slack * (dx.abs() + dy.abs())
    }

    /// The first barrier on a ray.
    ///
    /// # Arguments
    /// `heading` is a direction of any length but 0; a ray goes `most` metres.
    ///
    /// # Returns
    /// `None` where the ray meets nothing.
    pub fn cast(&self, from: Point, heading: Point, most: f64) -> Option<Echo> {
        let length = heading.x.hypot(heading.y);
        let along = Point::new(heading.x / length, heading.y / length);
        if !(along.x.is_finite() && along.y.is_finite() && from.x.is_finite() && from.y.is_finite()) {
            return None;
        }
        let bounds = self.bounds();
        let far = bounds.dx() + bounds.dy() + bounds.nearest_to(from).distance(from);
        let end = Point::new(from.x + along.x * far, from.y + along.y * far);
        let (enter, _) = bounds.clip(from, end)?;
        let mut walk = Walk::new(self, enter, along);
        let entered = enter.distance(from);
        let mut best: Option<Echo> = None;
        while let Some(cell) = walk.cell(self) {
            let (begin, stop) = (self.begins[cell] as usize, self.begins[cell + 1] as usize);
            for &barrier in &self.listed[begin..stop] {
                let Some(distance) = meeting(from, along, self.barriers[barrier as usize]) else { continue };
                let is_nearer = best.is_none_or(|b| (distance, barrier as usize) < (b.distance, b.barrier));
                if distance <= most && is_nearer {
                    best = Some(Echo { distance, barrier: barrier as usize });
                }
            }
            let left = entered + walk.leaves();
            if left > most || best.is_some_and(|echo| echo.distance < left - self.cell_m * OVERLAP) {
                break;
            }
            walk.step();
        }
        best
    }

    fn bounds(&self) -> Rect {
        let slack = self.cell_m * OVERLAP;
        let (x, y) = (self.columns as f64 * self.cell_m, self.rows as f64 * self.cell_m);
        let Point { x: x0, y: y0 } = self.origin;
        Rect::new(x0 - slack, y0 - slack, x0 + x + slack, y0 + y + slack)
    }
}

/// How far along a ray a barrier is met.
fn meeting(from: Point, along: Point, [a, b]: [Point; 2]) -> Option<f64> {
    let aside = |p: Point| along.x * (p.y - from.y) - along.y * (p.x - from.x);
    let ahead = |p: Point| along.x * (p.x - from.x) + along.y * (p.y - from.y);
    let (left, right) = (aside(a), aside(b));
    if left * right > 0.0 {
        return None;
    }
    let distance = if left - right == 0.0 {
        // The ray runs along the barrier.
        let (near, far) = (ahead(a).min(ahead(b)), ahead(a).max(ahead(b)));
        if near < 0.0 && far >= 0.0 { 0.0 } else { near }
    } else {
        let share = left / (left - right);
        ahead(a) + share * (ahead(b) - ahead(a))
    };
    (distance >= 0.0).then_some(distance)
}

/// A walk from cell to cell along a ray.
struct Walk {
    at: [i64; 2],
    step: [i64; 2],
    /// How far along the ray, from where it enters the grid, it leaves the cell by a vertical and by a horizontal edge.
    leaves: [f64; 2],
    /// How far along the ray it crosses a whole cell.
    across: [f64; 2],
}

impl Walk {
    fn new(grid: &Visibility, enter: Point, along: Point) -> Self {
        let axis = |position: f64, heading: f64, count: usize| {
            let place = position / grid.cell_m;
            let at = (place as i64).clamp(0, count as i64 - 1);
            let next = if heading > 0.0 { at as f64 + 1.0 - place } else { place - at as f64 };
            let across = if heading == 0.0 { f64::INFINITY } else { grid.cell_m / heading.abs() };
            let leaves = if heading == 0.0 { f64::INFINITY } else { next.max(0.0) * across };
            (at, if heading > 0.0 { 1 } else { -1 }, leaves, across)
        };
        let x = axis(enter.x - grid.origin.x, along.x, grid.columns);
        let y = axis(enter.y - grid.origin.y, along.y, grid.rows);
        Self { at: [x.0, y.0], step: [x.1, y.1], leaves: [x.2, y.2], across: [x.3, y.3] }
    }

    fn cell(&self, grid: &Visibility) -> Option<usize> {
        let [column, row] = self.at.map(|v| usize::try_from(v).unwrap_or(usize::MAX));
        (column < grid.columns && row < grid.rows)
            .then_some(row.wrapping_mul(grid.columns).wrapping_add(column))
    }

    fn leaves(&self) -> f64 {
        self.leaves[0].min(self.leaves[1])
    }

    fn step(&mut self) {
        let axis = usize::from(self.leaves[1] < self.leaves[0]);
        self.at[axis] += self.step[axis];
        self.leaves[axis] += self.across[axis];
    }
}
