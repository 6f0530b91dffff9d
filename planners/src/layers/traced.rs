//! The outlines of an image's walls.

use std::collections::BTreeSet;

use crate::geometry::{Point, Segment, cross};
use crate::world::Occupancy;

/// A corner of cells: column and row.
type Corner = [i32; 2];

/// The outlines of walls, which lie to their left; cells that touch at a corner are joined there. Straight sides have no
/// corners between their ends.
pub(super) fn outlines(occupancy: &Occupancy) -> Vec<Vec<Corner>> {
    let (columns, rows) = (occupancy.columns as i32, occupancy.rows as i32);
    let is_wall = |column: i32, row: i32| {
        (0..columns).contains(&column)
            && (0..rows).contains(&row)
            && occupancy.is_blocked(column as usize, row as usize)
    };
    // what lies ahead, left and right, of a corner in a direction
    let ahead = |[x, y]: Corner, direction: u8| match direction {
        0 => [is_wall(x, y), is_wall(x, y - 1)],
        1 => [is_wall(x - 1, y), is_wall(x, y)],
        2 => [is_wall(x - 1, y - 1), is_wall(x - 1, y)],
        _ => [is_wall(x, y - 1), is_wall(x - 1, y - 1)],
    };
    let step = |[x, y]: Corner, direction: u8| match direction {
        0 => [x + 1, y],
        1 => [x, y + 1],
        2 => [x - 1, y],
        _ => [x, y - 1],
    };
    // sides that run to the right, with the wall above: each outline has one
    let mut open: BTreeSet<(i32, i32)> = BTreeSet::new();
    for row in 0..rows {
        for column in 0..columns {
            if is_wall(column, row) && !is_wall(column, row - 1) {
                open.insert((row, column));
            }
        }
    }
    let mut rings = Vec::new();
    while let Some(&(row, column)) = open.first() {
        let (start, mut at, mut direction) = ([column, row], [column, row], 0);
        let mut ring = Vec::new();
        loop {
            if direction == 0 {
                open.remove(&(at[1], at[0]));
            }
            at = step(at, direction);
            // at a corner where two walls touch, the outline goes on along the other one
            let next = match ahead(at, direction) {
                [_, true] => (direction + 3) % 4,
                [true, false] => direction,
                [false, false] => (direction + 1) % 4,
            };
            if next != direction {
                ring.push(at);
            }
            direction = next;
            if at == start && direction == 0 {
                break;
            }
        }
        rings.push(ring);
    }
    rings
}

/// Which corners, by number, an outline needs that may leave some out: walls only gain by it, and nowhere more than `tolerance`
/// cells.
///
/// From a corner of the wall the outline goes straight to the furthest one from which all that lies between is seen to
/// its left, no further off than the tolerance.
pub(super) fn simplified(ring: &[Corner], tolerance: f64) -> Vec<usize> {
    let count = ring.len();
    let at = |number: usize| {
        let [x, y] = ring[number % count];
        Point::new(f64::from(x), f64::from(y))
    };
    let turn = |number: usize| cross(at(number + count - 1), at(number), at(number + 1));
    let Some(first) = (0..count).find(|&number| turn(number) > 0.0) else { return (0..count).collect() };
    let mut kept = Vec::new();
    let mut here = first;
    while here < first + count {
        kept.push(here % count);
        let mut next = here + 1;
        for there in here + 2..(here + FURTHEST).min(first + count + 1) {
            let line = Segment::new(at(here), at(there));
            if line.length() <= 0.0 {
                break;
            }
            let mut between = (here + 1..there).map(at);
            if between.all(|p| cross(line.a, line.b, p) >= 0.0 && line.distance(p) <= tolerance) {
                next = there;
            }
        }
        here = next;
    }
    // what is left of a speck is no less than a triangle
    if kept.len() < 3 { (0..count).collect() } else { kept }
}

/// How many corners a straight side may leave out.
const FURTHEST: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(rows: &[&str]) -> Occupancy {
        let blocked = rows.iter().rev().flat_map(|row| row.chars().map(|c| c == '#')).collect();
        let (columns, rows) = (rows[0].len(), rows.len());
        Occupancy { origin: Point::default(), resolution: 1.0, columns, rows, blocked }
    }

    fn area(ring: &[Corner]) -> i32 {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<i32>() / 2
    }

    #[test]
    fn a_wall_with_a_hole_has_two_outlines() {
        let rings = outlines(&drawn(&["####", "#..#", "####"]));
        let mut areas: Vec<i32> = rings.iter().map(|ring| area(ring)).collect();
        areas.sort_unstable();
        assert_eq!(areas, [-2, 12]);
        assert!(rings.iter().all(|ring| ring.len() == 4));
    }

    #[test]
    fn cells_that_touch_at_a_corner_have_one_outline() {
        let rings = outlines(&drawn(&[".#", "#."]));
        assert_eq!(rings.len(), 1);
        assert_eq!(area(&rings[0]), 2);
    }

    #[test]
    fn the_steps_of_a_slanted_wall_become_its_slope() {
        let rings = outlines(&drawn(&["#......", "###....", "#####..", "#######"]));
        let mut simple: Vec<Corner> = simplified(&rings[0], 1.0).iter().map(|&kept| rings[0][kept]).collect();
        simple.sort_unstable();
        assert_eq!(simple, [[0, 0], [0, 4], [1, 4], [7, 0], [7, 1]]);
    }
}
