//! Everything solid of a world, ready to be asked how near a straight way comes to it.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::{Bridge, Occupancy, Shape, World};

use super::distances::{segment_to_polygon, segment_to_rect};

/// Side of the squares by which walls are found, metres.
const BUCKET: f64 = 0.5;

/// The walls of a world.
pub struct Walls {
    bounds: Rect,
    reach: f64,
    solids: Vec<Shape>,
    columns: usize,
    rows: usize,
    /// The solids within `reach` of each square, row by row.
    buckets: Vec<Vec<u32>>,
    bridges: Vec<Bridge>,
}

impl Walls {
    /// The walls of a world; distances are told up to `reach` metres.
    pub fn new(world: &World, reach: f64) -> Self {
        let pictured = world.occupancy.iter().flat_map(Occupancy::rectangles).map(Shape::Rect);
        let solids: Vec<Shape> =
            world.obstacles.iter().map(|obstacle| obstacle.shape.clone()).chain(pictured).collect();
        let bounds = world.bounds;
        let count = |length: f64| (length / BUCKET).ceil().max(1.0) as usize;
        let (columns, rows) = (count(bounds.dx()), count(bounds.dy()));
        let mut walls = Self {
            bounds,
            reach,
            solids: Vec::new(),
            columns,
            rows,
            buckets: vec![Vec::new(); columns * rows],
            bridges: world.bridges.clone(),
        };
        for (number, solid) in (0..).zip(&solids) {
            let r = solid.enclosing_rect();
            let near = Rect::new(r.x0 - reach, r.y0 - reach, r.x1 + reach, r.y1 + reach);
            for bucket in walls.buckets_at(&near).collect::<Vec<_>>() {
                walls.buckets[bucket].push(number);
            }
        }
        walls.solids = solids;
        walls
    }

    fn buckets_at(&self, rect: &Rect) -> impl Iterator<Item = usize> + use<> {
        let index =
            |at: f64, low: f64, count: usize| (((at - low) / BUCKET).max(0.0) as usize).min(count - 1);
        let (x0, x1) =
            (index(rect.x0, self.bounds.x0, self.columns), index(rect.x1, self.bounds.x0, self.columns));
        let (y0, y1) = (index(rect.y0, self.bounds.y0, self.rows), index(rect.y1, self.bounds.y0, self.rows));
        let columns = self.columns;
        (y0..=y1).flat_map(move |row| (x0..=x1).map(move |column| row * columns + column))
    }

    /// The environment.
    pub fn bounds(&self) -> Rect {
        self.bounds
    }

    /// How near the straight way from `a` to `b` comes to a wall or the edge, at most the reach; 0 where it leaves
    /// the floor. Less than `enough` may be told as anything less than `enough`.
    pub fn near(&self, a: Point, b: Point, enough: f64) -> f64 {
        let Rect { x0, y0, x1, y1 } = self.bounds;
        let inside = |p: Point| (p.x - x0).min(x1 - p.x).min(p.y - y0).min(y1 - p.y);
        let mut nearest = inside(a).min(inside(b)).clamp(0.0, self.reach);
        // Piece by piece, so that a long slanting way does not ask for all that its enclosing rectangle holds.
        let pieces = (a.distance(b) / BUCKET).ceil().max(1.0) as usize;
        let at = |piece: usize| {
            let share = piece as f64 / pieces as f64;
            Point::new(a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share)
        };
        for piece in 0..pieces {
            let (from, to) = (at(piece), at(piece + 1));
            if nearest < enough {
                break;
            }
            let about = Rect::new(from.x.min(to.x), from.y.min(to.y), from.x.max(to.x), from.y.max(to.y));
            for bucket in self.buckets_at(&about) {
                for &solid in &self.buckets[bucket] {
                    let apart = match &self.solids[solid as usize] {
                        Shape::Rect(rect) => segment_to_rect(from, to, rect),
                        Shape::Polygon(corners) => segment_to_polygon(from, to, corners),
                    };
                    nearest = nearest.min(apart);
                }
            }
        }
        nearest
    }

    /// How near the straight way comes to a bridge that is not higher than `height`; at most the reach.
    pub fn near_bridges(&self, a: Point, b: Point, height: f64) -> f64 {
        let low = self.bridges.iter().filter(|bridge| bridge.height <= height);
        low.map(|bridge| segment_to_rect(a, b, &bridge.rect)).fold(self.reach, f64::min)
    }
}
