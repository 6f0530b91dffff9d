//! What an exploration ends with.

use super::grid::{Cell, Cells, GRAIN_M, middle_of};
use super::ground::Ground;
use crate::floor_plan::{Drawn, FloorPlan};
use crate::geometry::{Point, Segment};
use crate::read::MapErrors;
use crate::world::Place;

/// A wall belongs to the model where there is free space so near to it, in cells.
const BESIDE: i32 = 8;

/// A building as a robot has learned it, in the frame of the pose where it began.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Learned {
    /// A point of its free space: where the robot began.
    pub start: Point,
    /// Half the width of the robot, metres.
    pub radius_m: f64,
    /// The surfaces of the global model, made to meet at their ends.
    pub walls: Vec<Segment>,
    /// What was never seen, where no wall lies before it: corners in order. It is not free.
    pub unseen: Vec<Vec<Point>>,
    pub places: Vec<Place>,
}

impl Learned {
    /// What is free of a building.
    ///
    /// # Arguments
    /// `walls` meet at ends only, and are those that the ground was made with.
    pub(super) fn new(start: Point, radius_m: f64, ground: &Ground, walls: &[Segment]) -> Self {
        let is_beside = |wall: &&Segment| {
            let cells = super::grid::touched(wall.a, wall.b);
            let near = |(x, y): Cell| {
                let mut around = (-BESIDE..=BESIDE).flat_map(|dy| (-BESIDE..=BESIDE).map(move |dx| (dx, dy)));
                around.any(|(dx, dy)| ground.free.has((x + dx, y + dy)))
            };
            cells.into_iter().any(near)
        };
        let walls = walls.iter().filter(is_beside).copied().collect();
        let unseen = rectangles(&ground.beyond());
        Self { start, radius_m, walls, unseen, places: Vec::new() }
    }

    /// The floor plan of what is free: one outline, with convex regions and a network as any other has.
    ///
    /// # Returns
    /// An error where walls and places make none.
    pub fn plan(&self, name: &str) -> Result<FloorPlan, MapErrors> {
        let drawn = Drawn {
            name: name.to_owned(),
            walls: self.walls.iter().map(|wall| [wall.a, wall.b]).collect(),
            solids: self.unseen.clone(),
            places: self.places.clone(),
        };
        FloorPlan::around(drawn, self.start)
    }
}

/// Rectangles that cover cells: as long as they are side by side in a row, then as high as rows are alike.
fn rectangles(cells: &Cells) -> Vec<Vec<Point>> {
    let mut runs: Vec<(i32, i32, i32)> = Vec::new();
    for (column, row) in cells.iter() {
        match runs.last_mut() {
            Some((last_row, _, end)) if *last_row == row && *end == column => *end += 1,
            _ => runs.push((row, column, column + 1)),
        }
    }
    let mut done: Vec<(i32, i32, i32, i32)> = Vec::new();
    let mut open: Vec<(i32, i32, i32, i32)> = Vec::new();
    for (row, from, to) in runs {
        let (kept, closed): (Vec<_>, Vec<_>) = open.into_iter().partition(|(.., top)| *top >= row);
        done.extend(closed);
        open = kept;
        match open.iter_mut().find(|(low, high, _, top)| *low == from && *high == to && *top == row) {
            Some((.., top)) => *top += 1,
            None => open.push((from, to, row, row + 1)),
        }
    }
    done.extend(open);
    let corner = |column: i32, row: i32| {
        let middle = middle_of((column, row));
        Point::new(middle.x - GRAIN_M / 2.0, middle.y - GRAIN_M / 2.0)
    };
    let outline = |(x0, x1, y0, y1): (i32, i32, i32, i32)| {
        vec![corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)]
    };
    done.into_iter().map(outline).collect()
}
