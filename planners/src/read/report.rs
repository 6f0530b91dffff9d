//! What became of a map's free space on the way from the file to the planner.

use geo::{Area, BooleanOps, unary_union};

use super::diagnostic::{Code, MapErrors, Problem};
use crate::layers::{Lattice, Solid};
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
    /// Cost of a grid that is not the image's: cells that a wall only touches are lost whole. 0 where the layers'
    /// planner chooses the grid.
    pub grid: f64,
    /// Cost of the clearance for a point-like robot; what a robot's width costs comes on top, a layer each.
    pub clearance: f64,
    /// Free after all that.
    pub free: f64,
    /// What was mended silently otherwise: items cut at the edge.
    pub notes: Vec<Problem>,
}

impl MapReport {
    /// Fills in what was not counted cell by cell: the free space of a vector map, [`grid`](Self::grid),
    /// [`clearance`](Self::clearance) and [`free`](Self::free).
    pub(super) fn measure(&mut self, world: &World) -> Result<(), MapErrors> {
        if world.occupancy.is_none() {
            self.free_in_file = drawn_free_area(world);
        }
        self.free = self.free_in_file + self.unknown + self.specks;
        let native = world.occupancy.as_ref().map(|cells| cells.resolution);
        let Some(side) = world.grid.or(native) else { return Ok(()) };
        let lattice = Lattice::new(world.bounds, side)
            .map_err(|what| MapErrors::from(Problem::of_file(Code::GridTooFine, what)))?;
        if native == Some(side) && world.clearance <= 0.0 {
            return Ok(());
        }
        let solid = Solid::new(world, lattice);
        let area = |clearance| solid.free_cells(clearance, &[]).count() as f64 * side * side;
        let on_grid = area(0.0);
        self.grid = if native == Some(side) { 0.0 } else { on_grid - self.free };
        self.clearance = if world.clearance > 0.0 { area(world.clearance) - on_grid } else { 0.0 };
        self.free += self.grid + self.clearance;
        Ok(())
    }
}

/// Area of a vector map that no obstacle covers, square metres.
fn drawn_free_area(world: &World) -> f64 {
    let edge = crate::world::Shape::Rect(world.bounds).to_geo();
    let obstacles: Vec<_> = world.obstacles.iter().map(|obstacle| obstacle.shape.to_geo()).collect();
    world.bounds.area() - unary_union(&obstacles).intersection(&edge).unsigned_area()
}
