//! Plane geometry that every planner shares: metres in the map's frame (x to the right, y up), radians
//! counter-clockwise from the x axis. Where a sign decides, it is exact ([`orient`]); values are rounded.

mod convex;
mod orientation;
pub mod outline;
mod point;
pub mod polygon;
pub mod ray_grid;
mod rect;
mod sector;
mod segment;
pub mod tolerance;

pub use convex::Convex;
pub use orientation::{cross, orient};
pub use point::{Point, path_length};
pub use ray_grid::RayGrid;
pub use rect::Rect;
pub use sector::Sector;
pub use segment::Segment;
