//! Spaces and doorways: the rooms of a building as people see them, and the openings between them. They depend on walls
//! only, not on a robot.
//!
//! Loose things are taken away ([`clutter`]); of the lines across the floor from tips of walls ([`lines`]) some are
//! openings, and others mouths ([`openings`]); the pieces between them are joined over mouths where they are alike
//! ([`joined`]), and what is left over goes to those beside it ([`rest`]).

mod clutter;
mod doorways;
mod joined;
mod lines;
mod located;
mod openings;
mod planner;
mod record;
mod rest;
mod runs;

use geo::Area;
use rayon::prelude::*;

use crate::geometry::polygon::to_geo;
use crate::geometry::{Point, Segment, outline};
use crate::layers::{Lattice, Solid, squared_gaps};
use crate::world::{Occupancy, World};

use openings::Openings;

pub(crate) use located::{Located, NEEDS as OF_SPACES};
pub use planner::SpacesAndDoorways;
pub use record::{Doorway, Space};

/// The side of a cell on drawn maps, metres; on large ones as much more as keeps [`MOST_CELLS`].
const CELL_M: f64 = 0.05;

/// Of drawn maps.
const MOST_CELLS: f64 = 4e6;

/// Loose things up to so large, metres, stand in a space and part none.
const LOOSE_M: f64 = 0.8;

/// A doorway that is found so near to a named door is that door, metres.
const NAMED_M: f64 = 0.5;

/// Outlines are off by no more than so many cells.
const OUTLINE_CELLS: f64 = 1.0;

/// Spaces by the lower left cell of each; doorways by their spaces, then doors that are drawn within one.
#[derive(Clone, Debug, PartialEq)]
pub struct Spaces {
    pub spaces: Vec<Space>,
    pub doorways: Vec<Doorway>,
    floor: Occupancy,
    /// For each cell the number of its space, from 1.
    of_cell: Vec<u32>,
}

impl Spaces {
    /// The spaces of a world. The error is one sentence.
    ///
    /// # Complexity
    /// Near-linear in the number of cells, and in the number of pairs of wall ends that are near to each other.
    pub fn of(world: &World) -> Result<Self, String> {
        let given = raster(world)?;
        let mut floor = given.clone();
        clutter::clear_away(&mut floor, LOOSE_M);
        let openings = Openings::of(&floor).with_drawn(drawn(world, &floor), &floor);
        let mut of_cell = joined::joined(&floor, &openings);
        rest::flood(&floor, &mut of_cell);
        rest::absorb(&floor, &mut of_cell);
        let doorways = doorways::doorways(&floor, &of_cell, &openings.all());
        let spaces = all(&floor, &of_cell);
        let of_cell =
            of_cell.iter().zip(&given.blocked).map(|(of, solid)| if *solid { 0 } else { *of }).collect();
        let mut all = Self { spaces, doorways, floor, of_cell };
        all.name(world);
        Ok(all)
    }

    /// Has each named door be a doorway: the one that was found there, drawn as it is, or one more.
    fn name(&mut self, world: &World) {
        for (number, door) in world.named_doors.iter().enumerate() {
            let segment = Segment::new(door.from, door.to);
            let off = |doorway: &Doorway| {
                let (drawn, found) = (segment.middle(), doorway.segment.middle());
                doorway.segment.distance(drawn).max(segment.distance(found))
            };
            let unnamed = (0..self.doorways.len()).filter(|&place| self.doorways[place].named.is_none());
            let nearest = unnamed.min_by(|&a, &b| off(&self.doorways[a]).total_cmp(&off(&self.doorways[b])));
            if let Some(place) = nearest.filter(|&place| off(&self.doorways[place]) <= NAMED_M) {
                let doorway = &mut self.doorways[place];
                (doorway.segment, doorway.named) = (segment, Some(number));
                continue;
            }
            let aside = segment.direction().perpendicular() * NAMED_M;
            let beside = [aside, -aside].map(|aside| self.at(segment.middle() + aside));
            if let Some(one) = beside[0].or(beside[1]) {
                let other = beside[1].unwrap_or(one);
                let spaces = [one.min(other), one.max(other)];
                self.doorways.push(Doorway { spaces, segment, named: Some(number) });
            }
        }
    }

    /// The space in which a point lies, by index.
    pub fn at(&self, p: Point) -> Option<usize> {
        let (x, y) = (p.x - self.floor.origin.x, p.y - self.floor.origin.y);
        let (column, row) = (x / self.floor.resolution, y / self.floor.resolution);
        let is_inside =
            column >= 0.0 && row >= 0.0 && column < self.floor.columns as f64 && row < self.floor.rows as f64;
        let cell = is_inside.then(|| row as usize * self.floor.columns + column as usize)?;
        (self.of_cell[cell] as usize).checked_sub(1)
    }
}

/// What is solid, with a rim of solid cells about it.
fn raster(world: &World) -> Result<Occupancy, String> {
    let drawn = (world.bounds.area() / MOST_CELLS).sqrt().max(CELL_M);
    let side = world.occupancy.as_ref().map_or(drawn, |cells| cells.resolution);
    let lattice = Lattice::new(world.bounds, side)?;
    let free = Solid::new(world, lattice).free_cells(0.0, &[]);
    let (columns, rows) = (lattice.columns() as usize + 2, lattice.rows() as usize + 2);
    let mut blocked = vec![true; columns * rows];
    for row in 0..lattice.rows() {
        for column in (0..lattice.columns()).filter(|&column| free.contains(column, row)) {
            blocked[(row as usize + 1) * columns + column as usize + 1] = false;
        }
    }
    let origin = Point::new(world.bounds.x0 - side, world.bounds.y0 - side);
    Ok(Occupancy { origin, resolution: side, columns, rows, blocked })
}

/// The named doors, in cells.
fn drawn(world: &World, floor: &Occupancy) -> Vec<Segment> {
    let cells = |p: Point| (p - floor.origin) * (1.0 / floor.resolution);
    world.named_doors.iter().map(|door| Segment::new(cells(door.from), cells(door.to))).collect()
}

fn all(floor: &Occupancy, of_cell: &[u32]) -> Vec<Space> {
    let count = of_cell.iter().max().map_or(0, |&most| most as usize);
    let mut found = vec![Found { within: [usize::MAX, usize::MAX, 0, 0], cells: 0, widest: 0 }; count];
    // where another space begins, or a wall
    let is_rim = |column: usize, row: usize| {
        let cell = row * floor.columns + column;
        let others = || [cell - 1, cell + 1, cell - floor.columns, cell + floor.columns];
        let is_lower = |next: usize| (1..of_cell[cell]).contains(&of_cell[next]);
        of_cell[cell] == 0 || others().into_iter().any(is_lower)
    };
    let gaps = squared_gaps((floor.columns, floor.rows), is_rim);
    let rows = (0..floor.rows).flat_map(|row| (0..floor.columns).map(move |column| (column, row)));
    for (cell, (column, row)) in rows.enumerate() {
        let Some(of) = (of_cell[cell] as usize).checked_sub(1).map(|index| &mut found[index]) else {
            continue;
        };
        let [x0, y0, x1, y1] = &mut of.within;
        (*x0, *y0) = ((*x0).min(column), (*y0).min(row));
        (*x1, *y1) = ((*x1).max(column), (*y1).max(row));
        if of.cells == 0 || gaps[cell] > gaps[of.widest] {
            of.widest = cell;
        }
        of.cells += 1;
    }
    let space = |(number, found): (u32, &Found)| {
        let middle = |cell: usize| {
            let (column, row) = ((cell % floor.columns) as f64 + 0.5, (cell / floor.columns) as f64 + 0.5);
            floor.origin + Point::new(column, row) * floor.resolution
        };
        Space {
            outline: outline_of(floor, of_cell, number, found.within),
            area: found.cells as f64 * floor.resolution * floor.resolution,
            at: middle(found.widest),
            breadth: (2.0 * f64::from(gaps[found.widest]).sqrt() + 1.0) * floor.resolution,
        }
    };
    found.par_iter().enumerate().map(|(index, found)| space((index as u32 + 1, found))).collect()
}

/// The cells of a space.
#[derive(Clone)]
struct Found {
    /// First and last column and row: x0, y0, x1, y1.
    within: [usize; 4],
    cells: usize,
    /// The one that is furthest from its rim.
    widest: usize,
}

fn outline_of(
    floor: &Occupancy,
    of_cell: &[u32],
    number: u32,
    [x0, y0, x1, y1]: [usize; 4],
) -> Vec<Vec<Point>> {
    let has = |column: usize, row: usize| of_cell[(row + y0) * floor.columns + column + x0] == number;
    let rings = outline::outlines(x1 + 1 - x0, y1 + 1 - y0, has);
    let metres = |p: Point| floor.origin + Point::new(p.x + x0 as f64, p.y + y0 as f64) * floor.resolution;
    let ring = |ring: Vec<Point>| -> Vec<Point> {
        outline::simplified(&ring, OUTLINE_CELLS).into_iter().map(metres).collect()
    };
    let mut outline: Vec<Vec<Point>> = rings.into_iter().map(ring).filter(|ring| ring.len() > 2).collect();
    outline.sort_by(|a, b| to_geo(b).signed_area().total_cmp(&to_geo(a).signed_area()));
    outline
}
