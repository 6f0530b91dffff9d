//! The world as a planner reads it: one map, whatever file it came from, with what a site lays over it.

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

/// Walls as square cells, row 0 lowest (smallest y), column 0 leftmost.
#[derive(Clone, Debug, PartialEq)]
pub struct Occupancy {
    /// Lower left corner of cell (0, 0), map frame.
    pub origin: Point,
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// `columns * rows` cells, row by row; `true` is a wall.
    pub blocked: Vec<bool>,
}

impl Occupancy {
    /// Whether the cell is a wall.
    pub fn is_blocked(&self, column: usize, row: usize) -> bool {
        self.blocked[row * self.columns + column]
    }

    /// The cell's square.
    pub fn cell(&self, column: usize, row: usize) -> Rect {
        let (x, y) = (self.origin.x, self.origin.y);
        Rect::new(
            x + column as f64 * self.resolution,
            y + row as f64 * self.resolution,
            x + (column + 1) as f64 * self.resolution,
            y + (row + 1) as f64 * self.resolution,
        )
    }
}
