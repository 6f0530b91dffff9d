//! How far a point is from everything solid.

use rstar::{AABB, PointDistance, RTree, RTreeObject};

use crate::geometry::{Point, Rect, polygon};
use crate::world::{Occupancy, Shape, World};

/// Everything solid in a world, bridges aside, ready to be asked for distances from points.
pub(super) struct Clearance {
    bounds: Rect,
    walls: RTree<Wall>,
}

struct Wall(Shape);

impl RTreeObject for Wall {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        let Rect { x0, y0, x1, y1 } = self.0.enclosing_rect();
        AABB::from_corners([x0, y0], [x1, y1])
    }
}

impl PointDistance for Wall {
    fn distance_2(&self, &[x, y]: &[f64; 2]) -> f64 {
        let p = Point::new(x, y);
        let distance = match &self.0 {
            Shape::Rect(rect) => rect.nearest_to(p).distance(p),
            shape @ Shape::Polygon(_) if shape.contains(p) => 0.0,
            Shape::Polygon(corners) => {
                polygon::sides(corners).map(|side| side.distance(p)).fold(f64::INFINITY, f64::min)
            }
        };
        distance * distance
    }
}

impl Clearance {
    pub(super) fn new(world: &World) -> Self {
        let drawn = world.obstacles.iter().map(|obstacle| obstacle.shape.clone());
        let pictured = world.occupancy.iter().flat_map(Occupancy::rectangles).map(Shape::Rect);
        Self { bounds: world.bounds, walls: RTree::bulk_load(drawn.chain(pictured).map(Wall).collect()) }
    }

    /// Distance from the nearest wall or the edge, metres; 0 in a wall and outside.
    pub(super) fn at(&self, p: Point) -> f64 {
        let b = self.bounds;
        let edge = (p.x - b.x0).min(b.x1 - p.x).min(p.y - b.y0).min(b.y1 - p.y).max(0.0);
        let wall = self.walls.nearest_neighbor_iter_with_distance_2([p.x, p.y]).next();
        wall.map_or(edge, |(_, distance_2)| edge.min(distance_2.sqrt()))
    }
}
