//! Which areas and named doors each cell lies in. Rooms are cut along them, so that none lies in an area in part.
//!
//! A cell lies in an area if its middle does; of an area so slim that it holds no cell's middle the cells that its
//! outline passes stand for it. A named door is the band of cells that its segment passes: each has a side in common
//! with the next, so nobody gets from one side of the door to the other without entering it.

use std::collections::BTreeMap;
use std::ops::Range;

use super::cells::Cells;
use super::lattice::Lattice;
use crate::geometry::tolerance::ROUNDING;
use crate::geometry::{Point, polygon};
use crate::strips::Block;
use crate::world::{Shape, World};

/// The areas and doors that a cell lies in, by their index in the world.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Label {
    pub(super) areas: Vec<usize>,
    pub(super) doors: Vec<usize>,
    /// The block that holds all its cells.
    within: Option<Block>,
}

/// The label of each cell.
pub(super) struct Labels {
    columns: usize,
    of_cell: Vec<u16>,
    /// The first one is that of the cells in nothing.
    kinds: Vec<Label>,
}

impl Labels {
    /// The labels of a world; `None` where it has neither areas nor named doors. The error is one sentence.
    pub(super) fn new(world: &World, lattice: Lattice) -> Result<Option<Self>, String> {
        if world.areas.is_empty() && world.named_doors.is_empty() {
            return Ok(None);
        }
        let columns = lattice.columns() as usize;
        let of_cell = vec![0; columns * lattice.rows() as usize];
        let mut labels = Self { columns, of_cell, kinds: vec![Label::default()] };
        for (index, area) in world.areas.iter().enumerate() {
            labels.add(&area_runs(&area.shape, lattice), |label| label.areas.push(index))?;
        }
        for (index, door) in world.named_doors.iter().enumerate() {
            labels.add(&segment_runs(door.from, door.to, lattice), |label| label.doors.push(index))?;
        }
        labels.find_blocks(world, lattice);
        Ok(Some(labels))
    }

    /// The label of a block of cells that all have the same one.
    pub(super) fn of(&self, block: Block) -> &Label {
        &self.kinds[self.number(block.x0, block.y0) as usize]
    }

    /// A number that two cells share if and only if they lie in the same areas and doors; 0 for those in nothing.
    pub(super) fn number(&self, column: u32, row: u32) -> u16 {
        self.of_cell[row as usize * self.columns + column as usize]
    }

    /// The cells of a set by their label: those in nothing first, then one set for each label, over the block (of the
    /// lattice) that holds them.
    pub(super) fn split(&self, cells: &Cells) -> (Cells, Vec<(Block, Cells)>) {
        let mut rest = cells.clone();
        let mut parts = Vec::new();
        for (number, label) in self.kinds.iter().enumerate().skip(1) {
            let Some(within) = label.within else { continue };
            let mut part = Cells::none(within.x1 - within.x0, within.y1 - within.y0);
            for row in within.y0..within.y1 {
                for column in within.x0..within.x1 {
                    if usize::from(self.number(column, row)) == number && cells.contains(column, row) {
                        rest.remove(column, row);
                        let (x0, y0) = (column - within.x0, row - within.y0);
                        part.insert_block(Block { x0, y0, x1: x0 + 1, y1: y0 + 1 });
                    }
                }
            }
            parts.push((within, part));
        }
        (rest, parts)
    }

    /// Adds one more area or door to the labels of these cells.
    fn add(&mut self, runs: &[Run], put: impl Fn(&mut Label)) -> Result<(), String> {
        let mut after: BTreeMap<u16, u16> = BTreeMap::new();
        for Run { row, columns } in runs {
            let start = *row as usize * self.columns;
            for cell in start + columns.start as usize..start + columns.end as usize {
                let before = self.of_cell[cell];
                let now = if let Some(now) = after.get(&before) {
                    *now
                } else {
                    let now = u16::try_from(self.kinds.len()).map_err(|_| {
                        format!("named areas and doors overlap in more than {} ways", u16::MAX)
                    })?;
                    let mut label = self.kinds[usize::from(before)].clone();
                    put(&mut label);
                    self.kinds.push(label);
                    after.insert(before, now);
                    now
                };
                self.of_cell[cell] = now;
            }
        }
        Ok(())
    }

    /// Finds the block of each label, which lies within that of any area or door of it.
    fn find_blocks(&mut self, world: &World, lattice: Lattice) {
        let areas = world.areas.iter().map(|area| area.shape.enclosing_rect());
        let doors =
            world.named_doors.iter().map(|door| Shape::Polygon(vec![door.from, door.to]).enclosing_rect());
        let mut ranges: Vec<Option<Range<u32>>> = vec![None; lattice.rows() as usize];
        for rect in areas.chain(doors) {
            let columns = lattice.columns_about(rect.x0, rect.x1);
            for row in lattice.rows_about(rect.y0, rect.y1) {
                let range = &mut ranges[row as usize];
                let known = range.clone().unwrap_or(columns.clone());
                *range = Some(known.start.min(columns.start)..known.end.max(columns.end));
            }
        }
        for (row, range) in (0..).zip(ranges) {
            for column in range.unwrap_or(0..0) {
                let number = usize::from(self.number(column, row));
                let cell = Block { x0: column, y0: row, x1: column + 1, y1: row + 1 };
                let within = &mut self.kinds[number].within;
                let known = within.unwrap_or(cell);
                *within = Some(Block {
                    x0: known.x0.min(column),
                    y0: known.y0.min(row),
                    x1: known.x1.max(column + 1),
                    y1: known.y1.max(row + 1),
                });
            }
        }
    }
}

/// Cells of one row beside each other.
#[derive(Clone, Debug, PartialEq)]
struct Run {
    row: u32,
    columns: Range<u32>,
}

fn area_runs(shape: &Shape, lattice: Lattice) -> Vec<Run> {
    let corners = match shape {
        Shape::Rect(rect) => rect.corners().into(),
        Shape::Polygon(corners) => corners.clone(),
    };
    let rect = shape.enclosing_rect();
    let mut runs = Vec::new();
    for row in lattice.rows_about(rect.y0, rect.y1) {
        let y = lattice.centre(0, row).y;
        for inside in polygon::spans(polygon::sides(&corners), y) {
            let is_in = |column: &u32| {
                let x = lattice.centre(*column, row).x;
                inside[0] <= x && x < inside[1]
            };
            let mut columns = lattice.columns_about(inside[0], inside[1]);
            let first = columns.find(is_in);
            let last = columns.rev().find(is_in).or(first);
            if let (Some(first), Some(last)) = (first, last) {
                runs.push(Run { row, columns: first..last + 1 });
            }
        }
    }
    if runs.is_empty() {
        runs = once_each(
            polygon::sides(&corners).flat_map(|side| segment_runs(side.a, side.b, lattice)).collect(),
        );
    }
    runs
}

/// The same cells, none of them twice.
fn once_each(mut runs: Vec<Run>) -> Vec<Run> {
    runs.sort_unstable_by_key(|run| (run.row, run.columns.start));
    let mut merged: Vec<Run> = Vec::new();
    for run in runs {
        match merged.last_mut() {
            Some(last) if last.row == run.row && run.columns.start <= last.columns.end => {
                last.columns.end = last.columns.end.max(run.columns.end);
            }
            _ => merged.push(run),
        }
    }
    merged
}

/// The cells that a segment passes, row by row: those of a row meet those of the next over a side.
fn segment_runs(a: Point, b: Point, lattice: Lattice) -> Vec<Run> {
    let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
    let column_of = |x: f64| cell((x - lattice.x(0)) / lattice.side());
    let row_of = |y: f64| cell((y - lattice.y(0)) / lattice.side());
    let top = i64::from(lattice.rows()) - 1;
    let first = row_of(a.y).clamp(0, top);
    let last = cell_below((b.y - lattice.y(0)) / lattice.side()).clamp(first, top.max(first));
    let mut runs = Vec::new();
    for row in lattice.rows_about(a.y, b.y).filter(|row| (first..=last).contains(&i64::from(*row))) {
        // Both rows beside a line of the lattice take the cell in which the segment crosses it.
        let crosses = |y: f64| column_of(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        let below = (i64::from(row) > first).then(|| crosses(lattice.y(row)));
        let above = (i64::from(row) < last).then(|| crosses(lattice.y(row + 1)));
        let end = |x: f64, other: f64| {
            let ends_on_line = cell_below((x - lattice.x(0)) / lattice.side());
            if other < x { ends_on_line.max(column_of(other)) } else { column_of(x) }
        };
        let (from, to) = (below.unwrap_or_else(|| end(a.x, b.x)), above.unwrap_or_else(|| end(b.x, a.x)));
        let in_lattice = |column: i64| column.clamp(0, i64::from(lattice.columns()) - 1) as u32;
        runs.push(Run { row, columns: in_lattice(from.min(to))..in_lattice(from.max(to)) + 1 });
    }
    runs
}

/// The cell in which a coordinate lies, in cells; on a line of the lattice the one after it.
fn cell(coordinate: f64) -> i64 {
    (coordinate + ROUNDING).floor() as i64
}

/// The cell in which a coordinate lies; on a line of the lattice the one before it.
fn cell_below(coordinate: f64) -> i64 {
    (coordinate - ROUNDING).floor() as i64
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Rect;
    use crate::world::{Area, NamedDoor};

    const SIDE: f64 = 0.05;

    fn lattice() -> Lattice {
        Lattice::new(Rect::new(0.0, 0.0, 2.0, 2.0), SIDE).unwrap()
    }

    fn labels(areas: Vec<Shape>, doors: &[(Point, Point)]) -> Labels {
        let mut world = World::empty(Rect::new(0.0, 0.0, 2.0, 2.0));
        let named = |shape: Shape| Area {
            name: String::new(),
            kind: None,
            centre: shape.enclosing_rect().centre(),
            shape,
            further: Vec::new(),
        };
        world.areas = areas.into_iter().map(named).collect();
        let door = |&(from, to): &(Point, Point)| NamedDoor {
            name: String::new(),
            kind: None,
            from,
            to,
            further: Vec::new(),
        };
        world.named_doors = doors.iter().map(door).collect();
        Labels::new(&world, lattice()).unwrap().unwrap()
    }

    fn cells(labels: &Labels, is_in: impl Fn(&Label) -> bool) -> Vec<(u32, u32)> {
        let all = (0..40).flat_map(|row| (0..40).map(move |column| (column, row)));
        all.filter(|&(x, y)| is_in(labels.of(Block { x0: x, y0: y, x1: x + 1, y1: y + 1 }))).collect()
    }

    #[test]
    fn a_door_along_a_line_of_the_lattice_is_one_cell_thick_and_ends_where_it_ends() {
        let upright = labels(Vec::new(), &[(Point::new(1.0, 0.5), Point::new(1.0, 0.7))]);
        let band: Vec<_> = (10..14).map(|row| (20, row)).collect();
        assert_eq!(cells(&upright, |label| !label.doors.is_empty()), band);
        let level = labels(Vec::new(), &[(Point::new(0.7, 1.0), Point::new(0.5, 1.0))]);
        let band: Vec<_> = (10..14).map(|column| (column, 20)).collect();
        assert_eq!(cells(&level, |label| !label.doors.is_empty()), band);
    }

    #[test]
    fn areas_that_share_an_edge_share_no_cell_and_leave_none_out() {
        let split = labels(
            vec![Shape::Rect(Rect::new(0.0, 0.0, 0.975, 2.0)), Shape::Rect(Rect::new(0.975, 0.0, 2.0, 2.0))],
            &[],
        );
        assert_eq!(cells(&split, |label| label.areas.len() == 1).len(), 1600);
    }

    #[test]
    fn an_area_slimmer_than_a_cell_has_the_cells_that_it_passes() {
        let slim = labels(vec![Shape::Rect(Rect::new(0.51, 0.51, 0.52, 0.69))], &[]);
        assert_eq!(
            cells(&slim, |label| label.areas == [0]),
            (10..14).map(|row| (10, row)).collect::<Vec<_>>()
        );
    }

    #[test]
    fn where_areas_overlap_a_cell_lies_in_both() {
        let both = labels(
            vec![Shape::Rect(Rect::new(0.0, 0.0, 1.0, 1.0)), Shape::Rect(Rect::new(0.9, 0.0, 2.0, 1.0))],
            &[(Point::new(0.95, 0.0), Point::new(0.95, 2.0))],
        );
        assert_eq!(cells(&both, |label| label.areas == [0, 1]).len(), 2 * 20);
        assert_eq!(cells(&both, |label| label.areas == [0, 1] && label.doors == [0]).len(), 20);
        assert_eq!(cells(&both, |label| label.areas.is_empty() && label.doors == [0]).len(), 20);
    }

    fn points() -> impl Strategy<Value = (Point, Point)> {
        // often on lines and corners of the lattice
        let coordinate = || prop_oneof![(0..=40).prop_map(|v| f64::from(v) * SIDE), 0.0..2.0];
        let point = move || (coordinate(), coordinate()).prop_map(|(x, y)| Point::new(x, y));
        (point(), point()).prop_filter("a door has a width", |(a, b)| a.distance(*b) > 1e-3)
    }

    proptest! {
        #[test]
        fn each_cell_of_a_door_meets_it_and_the_next_one_over_a_side((from, to) in points()) {
            let labels = labels(Vec::new(), &[(from, to)]);
            let band = cells(&labels, |label| !label.doors.is_empty());
            prop_assert!(!band.is_empty());
            for &(x, y) in &band {
                let rect = lattice().rect(Block { x0: x, y0: y, x1: x + 1, y1: y + 1 });
                let grown = Rect::new(rect.x0 - 1e-6, rect.y0 - 1e-6, rect.x1 + 1e-6, rect.y1 + 1e-6);
                prop_assert!(grown.clip(from, to).is_some(), "{rect:?}");
            }
            let mut reached = vec![band[0]];
            let mut next = 0;
            while let Some(&(x, y)) = reached.get(next) {
                next += 1;
                for &cell in &band {
                    if x.abs_diff(cell.0) + y.abs_diff(cell.1) == 1 && !reached.contains(&cell) {
                        reached.push(cell);
                    }
                }
            }
            prop_assert_eq!(reached.len(), band.len());
            // every inner point of the segment lies in the band, or on the line beside it
            for step in 1..100 {
                let share = f64::from(step) / 100.0;
                let p = from.lerp(to, share);
                let is_in = band.iter().any(|&(x, y)| {
                    let r = lattice().rect(Block { x0: x, y0: y, x1: x + 1, y1: y + 1 });
                    r.nearest_to(p).distance(p) < 1e-6
                });
                prop_assert!(is_in || p.x > 2.0 - 1e-6 || p.y > 2.0 - 1e-6, "{p:?}");
            }
        }
    }
}
