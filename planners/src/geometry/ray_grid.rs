//! What a ray meets first, and what lies near a point: segments in a grid of square cells, walked along the ray
//! (Amanatides and Woo 1987).

use super::{Point, Rect, Segment, cross};
use crate::search::Csr;

const MOST_CELLS: f64 = 1_000_000.0;

/// Segments on one line have a grid so wide, metres.
const LEAST_M: f64 = 1e-3;

/// Cells reach so much further than their side, so that rounding loses no segment on their edge; a share of it.
const OVERLAP: f64 = 1e-6;

/// Segments, found by the rays that meet them; about one to a cell.
#[derive(Clone, Debug)]
pub struct RayGrid {
    segments: Vec<Segment>,
    origin: Point,
    cell_m: f64,
    columns: usize,
    rows: usize,
    /// For each cell the segments that come near it, by index.
    cells: Csr<u32>,
}

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// How far the ray went, metres.
    pub distance: f64,
    /// What it met, by index.
    pub segment: usize,
}

impl RayGrid {
    /// Segments with coordinates that are no finite numbers are never met.
    pub fn new(segments: Vec<Segment>) -> Self {
        let is_finite = |s: &&Segment| [s.a.x, s.a.y, s.b.x, s.b.y].iter().all(|v| v.is_finite());
        let finite = || (0_u32..).zip(&segments).filter(|(_, segment)| is_finite(segment));
        let bounds = Rect::around(finite().flat_map(|(_, segment)| [segment.a, segment.b]));
        let is_empty = bounds.x0 > bounds.x1;
        let cells = (segments.len() as f64).clamp(1.0, MOST_CELLS);
        let (dx, dy) =
            if is_empty { (1.0, 1.0) } else { (bounds.dx().max(LEAST_M), bounds.dy().max(LEAST_M)) };
        let cell_m = (dx * dy / cells).sqrt().max(dx.max(dy) / MOST_CELLS);
        let (columns, rows) = ((dx / cell_m) as usize + 1, (dy / cell_m) as usize + 1);
        let origin = if is_empty { Point::default() } else { Point::new(bounds.x0, bounds.y0) };
        let mut grid = Self { segments: Vec::new(), origin, cell_m, columns, rows, cells: Csr::default() };
        let mut listed = Vec::new();
        for (number, segment) in finite() {
            let near = grid.cells_about(&segment.bounds());
            listed.extend(near.filter(|&cell| grid.is_near(segment, cell)).map(|cell| (cell, number)));
        }
        grid.cells = Csr::new(columns * rows, listed);
        grid.segments = segments;
        grid
    }

    /// In the order in which they were given.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The first segment on a ray.
    ///
    /// # Arguments
    /// `along` is a direction of length 1; a ray goes `most` metres.
    ///
    /// # Returns
    /// `None` where the ray meets nothing. A ray along a segment does not meet it.
    pub fn cast(&self, from: Point, along: Point, most: f64) -> Option<Echo> {
        if !(along.x.is_finite() && along.y.is_finite() && from.x.is_finite() && from.y.is_finite()) {
            return None;
        }
        let bounds = self.bounds();
        let enter = if bounds.contains(from) {
            from
        } else {
            let far = bounds.dx() + bounds.dy() + bounds.nearest_to(from).distance(from);
            bounds.clip(from, from + along * far)?.0
        };
        let mut walk = Walk::new(self, enter, along);
        let entered = enter.distance(from);
        let mut best: Option<Echo> = None;
        while let Some(cell) = walk.cell(self) {
            for &index in self.cells.of(cell) {
                let segment = index as usize;
                let Some((distance, _)) = self.segments[segment].hit(from, along) else { continue };
                let is_nearer = best.is_none_or(|b| (distance, segment) < (b.distance, b.segment));
                if distance <= most && is_nearer {
                    best = Some(Echo { distance, segment });
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

    /// Segments that may meet a straight way, or come as near to it as rounding tells, by index, from its begin on. One may come
    /// more than once.
    pub fn beside(&self, way: Segment) -> impl Iterator<Item = usize> {
        let (along, length) = (way.direction(), way.length());
        let bounds = self.bounds();
        let inside = bounds.clip(way.a, way.b);
        let entered = inside.map_or(0.0, |(enter, _)| enter.distance(way.a));
        let mut walk = inside.map(|(enter, _)| Walk::new(self, enter, along));
        let cells = std::iter::from_fn(move || {
            let here = walk.as_mut()?;
            let cell = here.cell(self)?;
            if entered + here.leaves() > length {
                walk = None;
            } else {
                here.step();
            }
            Some(cell)
        });
        cells.flat_map(|cell| self.cells.of(cell)).map(|&segment| segment as usize)
    }

    /// Segments that may lie within a distance of a point. One may come more than once.
    pub fn around(&self, p: Point, reach_m: f64) -> impl Iterator<Item = &Segment> {
        let cells = self.cells_about(&Rect::around([p]).grown(reach_m));
        cells.flat_map(|cell| self.cells.of(cell)).map(|&segment| &self.segments[segment as usize])
    }

    /// The cells that a rectangle meets, by index; those at the rim for what lies beyond it.
    fn cells_about(&self, rect: &Rect) -> impl Iterator<Item = usize> + use<> {
        let place = |at: f64, origin: f64, slack: f64, count: usize| {
            (((at - origin) / self.cell_m + slack).max(0.0) as usize).min(count - 1)
        };
        let span = |from: f64, to: f64, origin: f64, count: usize| {
            place(from, origin, -OVERLAP, count)..=place(to, origin, OVERLAP, count)
        };
        let across = span(rect.x0, rect.x1, self.origin.x, self.columns);
        let (columns, up) = (self.columns, span(rect.y0, rect.y1, self.origin.y, self.rows));
        up.flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }

    fn is_near(&self, segment: &Segment, cell: usize) -> bool {
        let (column, row) = ((cell % self.columns) as f64, (cell / self.columns) as f64);
        let middle = self.origin + Point::new(column + 0.5, row + 0.5) * self.cell_m;
        let way = segment.b - segment.a;
        let (half, slack) = (self.cell_m / 2.0, 1.0 + 4.0 * OVERLAP);
        cross(segment.a, segment.b, middle).abs() <= half * slack * (way.x.abs() + way.y.abs())
    }

    fn bounds(&self) -> Rect {
        let far = Point::new(self.columns as f64, self.rows as f64) * self.cell_m;
        Rect::around([self.origin, self.origin + far]).grown(self.cell_m * OVERLAP)
    }
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
    fn new(grid: &RayGrid, enter: Point, along: Point) -> Self {
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

    fn cell(&self, grid: &RayGrid) -> Option<usize> {
        let [column, row] = self.at.map(|v| usize::try_from(v).unwrap_or(usize::MAX));
        (column < grid.columns && row < grid.rows).then(|| row * grid.columns + column)
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
            let found = RayGrid::new(walls).cast(from, towards, 8.0).map_or(f64::INFINITY, |echo| echo.distance);
            let expected = if nearest <= 8.0 { nearest } else { f64::INFINITY };
            prop_assert!(found.total_cmp(&expected).is_eq(), "{found} is not {expected}");
        }

        #[test]
        fn no_wall_across_a_way_is_forgotten(
            walls in walls(), (x0, y0, x1, y1) in (-15.0..15.0, -15.0..25.0, -15.0..15.0, -15.0..25.0), whole in any::<bool>(),
        ) {
            let at = |x: f64, y: f64| if whole { Point::new(x.round(), y.round()) } else { Point::new(x, y) };
            let way = Segment::new(at(x0, y0), at(x1, y1));
            let found: Vec<usize> = RayGrid::new(walls.clone()).beside(way).collect();
            for (number, wall) in walls.iter().enumerate() {
                prop_assert!(!way.meets(wall) || found.contains(&number), "{number}");
            }
        }

        #[test]
        fn no_wall_near_a_point_is_forgotten(walls in walls(), (x, y) in (-15.0..15.0, -15.0..25.0)) {
            let (p, grid) = (Point::new(x, y), RayGrid::new(walls.clone()));
            for wall in walls.iter().filter(|wall| wall.distance(p) <= 1.5) {
                prop_assert!(grid.around(p, 1.5).any(|found| found == wall));
            }
        }
    }
}
