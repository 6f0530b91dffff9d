//! How near to anything solid a straight way comes, and where a body fits.

mod footprint;
mod hindrance;
mod nearest;

use geo::{Distance, Euclidean, Line, Polygon};
use rstar::{AABB, RTree, RTreeObject};

use crate::geometry::{Point, Rect, Segment};
use crate::world::{Shape, World};

pub use footprint::Footprint;
pub use hindrance::Hindrance;

/// Walls, obstacles and bridges of a world, found by where they are.
pub struct Solids {
    bounds: Rect,
    tree: RTree<Solid>,
}

struct Solid {
    outline: Outline,
    envelope: AABB<[f64; 2]>,
    /// The clear height under it; `None` where there is none.
    height: Option<f64>,
}

enum Outline {
    Rect(Rect),
    Polygon(Polygon<f64>),
}

impl RTreeObject for Solid {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        self.envelope
    }
}

impl Solid {
    fn new(shape: &Shape, height: Option<f64>) -> Self {
        let rect = shape.enclosing_rect();
        let outline = match shape {
            Shape::Rect(rect) => Outline::Rect(*rect),
            Shape::Polygon(_) => Outline::Polygon(shape.to_geo()),
        };
        Self { outline, envelope: AABB::from_corners([rect.x0, rect.y0], [rect.x1, rect.y1]), height }
    }

    fn distance(&self, line: &Line<f64>) -> f64 {
        match &self.outline {
            Outline::Rect(rect) => Euclidean.distance(line, &geo::Rect::from(*rect)),
            Outline::Polygon(polygon) => Euclidean.distance(line, polygon),
        }
    }

    fn sides(&self) -> Vec<Segment> {
        let side = |line: Line<f64>| Segment::new(line.start.into(), line.end.into());
        match &self.outline {
            Outline::Rect(rect) => geo::Rect::from(*rect).to_lines().map(side).into(),
            Outline::Polygon(polygon) => polygon.exterior().lines().map(side).collect(),
        }
    }
}

impl Solids {
    pub fn new(world: &World) -> Self {
        let drawn = world.obstacles.iter().map(|obstacle| Solid::new(&obstacle.shape, None));
        let pictured = world.occupancy.iter().flat_map(|cells| cells.rectangles());
        let pictured = pictured.map(|rect| Solid::new(&Shape::Rect(rect), None));
        let bridges =
            world.bridges.iter().map(|bridge| Solid::new(&Shape::Rect(bridge.rect), Some(bridge.height)));
        Self { bounds: world.bounds, tree: RTree::bulk_load(drawn.chain(pictured).chain(bridges).collect()) }
    }

    /// Metres between the straight way from `a` to `b` and the nearest thing that a robot of a height does not pass
    /// under; the edge of the map is one.
    pub fn gap(&self, a: Point, b: Point, height: f64) -> f64 {
        let edge = [a, b].into_iter().map(|p| {
            let b = &self.bounds;
            (p.x - b.x0).min(b.x1 - p.x).min(p.y - b.y0).min(b.y1 - p.y)
        });
        let edge = edge.fold(f64::INFINITY, f64::min).max(0.0);
        let line = Line::from(Segment::new(a, b));
        let about = Segment::new(a, b).bounds();
        // what is nearer than the reach is certainly found; farther than the edge nothing needs to be looked for
        let mut reach = edge.min(1.0);
        loop {
            let solid = self.within(about.grown(reach), height);
            let gap = solid.map(|solid| solid.distance(&line)).fold(edge, f64::min);
            if gap <= reach || reach >= edge {
                return gap;
            }
            reach = (reach * 2.0).min(edge);
        }
    }

    /// What a robot of a height does not pass under, as far as its envelope meets a rectangle.
    fn within(&self, rect: Rect, height: f64) -> impl Iterator<Item = &Solid> {
        let around = AABB::from_corners([rect.x0, rect.y0], [rect.x1, rect.y1]);
        let near = self.tree.locate_in_envelope_intersecting(around);
        near.filter(move |solid| solid.height.is_none_or(|clear| clear <= height))
    }
}
