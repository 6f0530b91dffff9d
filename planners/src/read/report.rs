//! What became of a map's free space on the way from the file to the planner.

use geo::{Area, BooleanOps, unary_union};

use super::diagnostic::{Code, MapErrors, Problem};
use crate::layers::{Lattice, free_areas};
use crate::world::World;

/// Free space in square metres: what the file has, and what each step then gave (positive) or cost (negative).
#[derive(Clone, Debug, Default)]
pub struct MapReport {
    /// Free in the file itself.
    pub free_in_file: f64,
    /// Neither free nor wall in the file (images only).
    pub unknown_in_file: f64,
    /// Given by counting the unknown as free; 0 where it counts as a wall.
    pub unknown: f64,
    /// Given by dropping specks.
    pub specks: f64,
    /// Cost of making an image's walls straight: where no gap is tight, they gain up to a cell.
    pub straightened: f64,
    /// Cost of the clearance for a point-like robot; what a robot's width costs comes on top, a layer each.
    pub clearance: f64,
    /// Free after all that.
    pub free: f64,
    /// What was mended silently otherwise: items cut at the edge.
    pub notes: Vec<Problem>,
}

impl MapReport {
    /// Fills in what was not counted cell by cell: the free space of a vector map, [`straightened`](Self::straightened),
    /// [`clearance`](Self::clearance) and [`free`](Self::free).
    pub(super) fn measure(&mut self, world: &World) -> Result<(), MapErrors> {
        if world.occupancy.is_none() {
            self.free_in_file = drawn_free_area(world);
        }
        if let Some(side) = world.grid {
            Lattice::new(world.bounds, side)
                .map_err(|what| MapErrors::from(Problem::of_file(Code::GridTooFine, what)))?;
        }
        self.free = self.free_in_file + self.unknown + self.specks;
        if world.occupancy.is_none() && world.clearance <= 0.0 {
            return Ok(());
        }
        let [straight, clear] = free_areas(world);
        self.straightened = if world.occupancy.is_some() { straight - self.free } else { 0.0 };
        self.clearance = clear - straight;
        self.free += self.straightened + self.clearance;
        Ok(())
    }
}

/// Area of a vector map that no obstacle covers, square metres.
fn drawn_free_area(world: &World) -> f64 {
    let edge = crate::world::Shape::Rect(world.bounds).to_geo();
    let obstacles: Vec<_> = world.obstacles.iter().map(|obstacle| obstacle.shape.to_geo()).collect();
    world.bounds.area() - unary_union(&obstacles).intersection(&edge).unsigned_area()
}
