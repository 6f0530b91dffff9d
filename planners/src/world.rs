//! The world as a planner reads it: one map, whatever file it came from, with what a site lays over it.

mod occupancy;

use geo::{Contains, Coord, LineString, Polygon};

pub use occupancy::Occupancy;

use crate::geometry::{Point, Rect};

/// Everything a geometric planner may look at. Metres, in the map's frame; the edge of `bounds` is a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// The environment.
    pub bounds: Rect,
    /// What no state passes.
    pub obstacles: Vec<Obstacle>,
    /// What only low states pass: rectangles with a clear height under them.
    pub bridges: Vec<Bridge>,
    /// Named points.
    pub places: Vec<Place>,
    /// Walls given as an image; `None` for a vector map.
    pub occupancy: Option<Occupancy>,
    /// Pose of the map in the world.
    pub frame: Pose,
    /// Side of a cell where a layer is cut into cells, metres; `None`: chosen by the planner.
    pub grid: Option<f64>,
    /// Kept free around every state besides its own width, metres.
    pub clearance: f64,
}

impl World {
    /// A world with nothing in it but its edge.
    pub fn empty(bounds: Rect) -> Self {
        Self {
            bounds,
            obstacles: Vec::new(),
            bridges: Vec::new(),
            places: Vec::new(),
            occupancy: None,
            frame: Pose::default(),
            grid: None,
            clearance: 0.0,
        }
    }

    /// Everything solid as rectangles inside of the environment: what the paper's modes look at. Polygons by
    /// their minimum enclosing rectangle, an image's walls cell by cell in as few runs as merge. The
    /// [`clearance`](Self::clearance) is not added: the paper has none.
    pub fn solid_rects(&self) -> Vec<Rect> {
        let drawn = self.obstacles.iter().map(|obstacle| obstacle.shape.enclosing_rect());
        let pictured = self.occupancy.iter().flat_map(Occupancy::rectangles);
        drawn.chain(pictured).filter_map(|rect| self.bounds.intersection(&rect)).collect()
    }
}

/// Something solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its outline.
    pub shape: Shape,
}

/// The outline of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// An axis-parallel rectangle.
    Rect(Rect),
    /// A simple polygon, at least three corners, not closed by a repeated one.
    Polygon(Vec<Point>),
}

impl Shape {
    /// The minimum enclosing rectangle: what the paper's mode takes for a polygon.
    pub fn enclosing_rect(&self) -> Rect {
        match self {
            Self::Rect(rect) => *rect,
            Self::Polygon(corners) => corners.iter().fold(
                Rect::new(f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
                |r, p| Rect::new(r.x0.min(p.x), r.y0.min(p.y), r.x1.max(p.x), r.y1.max(p.y)),
            ),
        }
    }

    /// Whether the point lies inside; not on the outline.
    pub fn contains(&self, p: Point) -> bool {
        match self {
            Self::Rect(r) => r.x0 < p.x && p.x < r.x1 && r.y0 < p.y && p.y < r.y1,
            Self::Polygon(corners) => to_geo(corners).contains(&Coord { x: p.x, y: p.y }),
        }
    }

    /// The outline as the `geo` crate has it.
    pub fn to_geo(&self) -> Polygon<f64> {
        match self {
            Self::Rect(r) => {
                geo::Rect::new(Coord { x: r.x0, y: r.y0 }, Coord { x: r.x1, y: r.y1 }).to_polygon()
            }
            Self::Polygon(corners) => to_geo(corners),
        }
    }
}

fn to_geo(corners: &[Point]) -> Polygon<f64> {
    Polygon::new(LineString::new(corners.iter().map(|p| Coord { x: p.x, y: p.y }).collect()), Vec::new())
}

/// A bridge: the robot may pass under it where its state is lower than `height`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bridge {
    /// Its outline.
    pub rect: Rect,
    /// Clear height under it, metres; positive.
    pub height: f64,
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name, unique in the map.
    pub name: String,
    /// Where it is.
    pub at: Point,
}

/// A pose in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Pose {
    /// Metres.
    pub x: f64,
    /// Metres.
    pub y: f64,
    /// Radians, counterclockwise.
    pub yaw: f64,
}
