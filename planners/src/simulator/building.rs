//! Walls in a grid, so that a beam and a robot look only at what is near.

use crate::geometry::Point;
use crate::segment::Segment;

/// Walls that never change.
#[derive(Clone, Debug)]
pub(super) struct Building {
    pub walls: Vec<Segment>,
    low: Point,
    cell_m: f64,
    columns: usize,
    rows: usize,
    /// Where the walls of each cell begin in `listed`; one more at the end.
    begins: Vec<u32>,
    listed: Vec<u32>,
}

/// No grid has more cells to a side, however large a plan is.
const MOST_CELLS: f64 = 256.0;

impl Building {
    pub fn new(walls: &[Segment]) -> Self {
        let points = || walls.iter().flat_map(|wall| [wall.a, wall.b]);
        let least = |of: fn(Point) -> f64| points().map(of).fold(f64::INFINITY, f64::min);
        let most = |of: fn(Point) -> f64| points().map(of).fold(f64::NEG_INFINITY, f64::max);
        let low = Point::new(least(|p| p.x), least(|p| p.y));
        let (dx, dy) = (most(|p| p.x) - low.x, most(|p| p.y) - low.y);
        let cell_m = (dx.max(dy) / MOST_CELLS).max(1.0);
        let cells = |extent: f64| if extent.is_finite() { (extent / cell_m) as usize + 1 } else { 1 };
        let (columns, rows) = (cells(dx), cells(dy));
        let mut grid =
            Self { walls: walls.to_vec(), low, cell_m, columns, rows, begins: vec![0], listed: Vec::new() };
        let mut cells = vec![Vec::new(); columns * rows];
        for (number, wall) in (0..).zip(walls) {
            let (x0, y0) = grid.cell(Point::new(wall.a.x.min(wall.b.x), wall.a.y.min(wall.b.y)));
            let (x1, y1) = grid.cell(Point::new(wall.a.x.max(wall.b.x), wall.a.y.max(wall.b.y)));
            for (x, y) in (y0..=y1).flat_map(|y| (x0..=x1).map(move |x| (x, y))) {
                if grid.is_near_cell(wall, x, y) {
                    cells[y * columns + x].push(number);
                }
            }
        }
        for cell in cells {
            grid.listed.extend(cell);
            grid.begins.push(grid.listed.len() as u32);
        }
        grid
    }

    /// Whether a wall comes near a cell: generously, since a wall too many costs little and one too few a lot.
    fn is_near_cell(&self, wall: &Segment, x: usize, y: usize) -> bool {
        let middle = Point::new(
            self.low.x + (x as f64 + 0.5) * self.cell_m,
            self.low.y + (y as f64 + 0.5) * self.cell_m,
        );
        wall.distance(middle) <= 0.75 * self.cell_m
    }

    /// The cell of a point, the nearest one for points outside.
    fn cell(&self, p: Point) -> (usize, usize) {
        let place =
            |at: f64, low: f64, count: usize| (((at - low) / self.cell_m).max(0.0) as usize).min(count - 1);
        (place(p.x, self.low.x, self.columns), place(p.y, self.low.y, self.rows))
    }

    fn in_cell(&self, x: usize, y: usize) -> impl Iterator<Item = &Segment> {
        let cell = y * self.columns + x;
        let listed = &self.listed[self.begins[cell] as usize..self.begins[cell + 1] as usize];
        listed.iter().map(|&wall| &self.walls[wall as usize])
    }

    /// Walls that may lie within a distance of a point. A wall may come more than once.
    pub fn around(&self, p: Point, reach_m: f64) -> impl Iterator<Item = &Segment> {
        let (x0, y0) = self.cell(Point::new(p.x - reach_m, p.y - reach_m));
        let (x1, y1) = self.cell(Point::new(p.x + reach_m, p.y + reach_m));
        (y0..=y1).flat_map(move |y| (x0..=x1).map(move |x| (x, y))).flat_map(|(x, y)| self.in_cell(x, y))
    }

    /// Metres along a ray to the first wall; `towards` has length 1. `None` where none is met within `reach_m`.
    ///
    /// # Complexity
    /// O(cells and walls on the way), after Amanatides and Woo (1987).
    pub fn range(&self, from: Point, towards: Point, reach_m: f64) -> Option<f64> {
        let (width, height) = (self.columns as f64 * self.cell_m, self.rows as f64 * self.cell_m);
        let (entry, exit) = clip(
            [(from.x - self.low.x, towards.x, width), (from.y - self.low.y, towards.y, height)],
            reach_m,
        )?;
        let start = Point::new(from.x + entry * towards.x, from.y + entry * towards.y);
        let (x, y) = self.cell(start);
        let mut walk = [
            Axis::new(x, self.columns, from.x - self.low.x, towards.x, self.cell_m),
            Axis::new(y, self.rows, from.y - self.low.y, towards.y, self.cell_m),
        ];
        let mut nearest = f64::INFINITY;
        loop {
            for wall in self.in_cell(walk[0].cell, walk[1].cell) {
                if let Some((range, _)) = wall.hit(from, towards) {
                    nearest = nearest.min(range);
                }
            }
            let axis = usize::from(walk[1].next < walk[0].next);
            if nearest <= walk[axis].next || walk[axis].next > exit || !walk[axis].step() {
                return (nearest <= reach_m).then_some(nearest);
            }
        }
    }
}

/// Where a ray enters and leaves a range of each axis (place, direction, width); `None` where it misses it.
fn clip(axes: [(f64, f64, f64); 2], reach_m: f64) -> Option<(f64, f64)> {
    let (mut entry, mut exit) = (0.0_f64, reach_m);
    for (place, direction, width) in axes {
        if direction == 0.0 {
            if place < 0.0 || place > width {
                return None;
            }
        } else {
            let (one, other) = (-place / direction, (width - place) / direction);
            entry = entry.max(one.min(other));
            exit = exit.min(one.max(other));
        }
    }
    (entry <= exit).then_some((entry, exit))
}

/// A ray's way through the columns, or the rows, of a grid.
struct Axis {
    cell: usize,
    count: usize,
    /// Metres along the ray to the next cell, and from each to the one after.
    next: f64,
    each: f64,
    is_up: bool,
}

impl Axis {
    fn new(cell: usize, count: usize, place: f64, direction: f64, cell_m: f64) -> Self {
        let is_up = direction > 0.0;
        let edge = (cell + usize::from(is_up)) as f64 * cell_m;
        let next = if direction == 0.0 { f64::INFINITY } else { (edge - place) / direction };
        Self { cell, count, next, each: (cell_m / direction).abs(), is_up }
    }

    /// Goes on to the next cell; whether there is one.
    fn step(&mut self) -> bool {
        self.next += self.each;
        if self.is_up {
            self.cell += 1;
            self.cell < self.count
        } else {
            let is_last = self.cell == 0;
            self.cell = self.cell.saturating_sub(1);
            !is_last
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn walls() -> impl Strategy<Value = Vec<Segment>> {
        let point = || (-10.0..10.0, -4.0..17.0).prop_map(|(x, y)| Point::new(x, y));
        prop::collection::vec((point(), point()).prop_map(|(a, b)| Segment::new(a, b)), 0..30)
    }

    proptest! {
        #[test]
        fn a_ray_finds_what_looking_at_all_walls_finds(
            walls in walls(), (x, y, angle) in (-15.0..15.0, -15.0..25.0, 0.0..6.3_f64), upright in any::<bool>(),
        ) {
            let angle = if upright { (angle / 1.6).floor() * std::f64::consts::FRAC_PI_2 } else { angle };
            let (from, towards) = (Point::new(x, y), Point::new(angle.cos(), angle.sin()));
            let all = walls.iter().filter_map(|wall| wall.hit(from, towards)).map(|(range, _)| range);
            let nearest = all.fold(f64::INFINITY, f64::min);
            let found = Building::new(&walls).range(from, towards, 8.0).unwrap_or(f64::INFINITY);
            let expected = if nearest <= 8.0 { nearest } else { f64::INFINITY };
            prop_assert!(found.total_cmp(&expected).is_eq(), "{found} is not {expected}");
        }

        #[test]
        fn no_wall_near_a_point_is_forgotten(walls in walls(), (x, y) in (-15.0..15.0, -15.0..25.0)) {
            let (p, building) = (Point::new(x, y), Building::new(&walls));
            for wall in walls.iter().filter(|wall| wall.distance(p) <= 1.5) {
                prop_assert!(building.around(p, 1.5).any(|found| found == wall));
            }
        }
    }
}
