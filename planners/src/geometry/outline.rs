//! The outlines of cells: closed, along their sides, and simplified.

use std::collections::BTreeMap;

use super::{Point, Segment};

/// A corner of cells: column and row of the cell that has it lower left.
type Corner = (i32, i32);

/// The outlines of the cells of a set, in cells: the set lies left of each; outer ones run counterclockwise, those of
/// holes clockwise. Cells that touch in a corner only are apart.
pub fn outlines(columns: usize, rows: usize, is_in: impl Fn(usize, usize) -> bool) -> Vec<Vec<Point>> {
    let has = |column: i32, row: i32| {
        (0..columns as i32).contains(&column)
            && (0..rows as i32).contains(&row)
            && is_in(column as usize, row as usize)
    };
    let mut sides: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
    for row in 0..rows as i32 {
        for column in (0..columns as i32).filter(|&column| has(column, row)) {
            let (x, y) = (column, row);
            let all = [
                ((x, y - 1), (x, y), (x + 1, y)),
                ((x + 1, y), (x + 1, y), (x + 1, y + 1)),
                ((x, y + 1), (x + 1, y + 1), (x, y + 1)),
                ((x - 1, y), (x, y + 1), (x, y)),
            ];
            for (beside, from, to) in all {
                if !has(beside.0, beside.1) {
                    sides.entry(from).or_default().push(to);
                }
            }
        }
    }
    let mut all = Vec::new();
    while let Some((&start, _)) = sides.first_key_value() {
        let mut outline = Vec::new();
        let (mut before, mut at) = (None, start);
        while let Some(next) = take(&mut sides, before, at) {
            outline.push(Point::new(f64::from(at.0), f64::from(at.1)));
            before = Some(at);
            at = next;
        }
        all.push(outline);
    }
    all
}

/// The side that goes on from a corner; of two the one to the left, which stays with the same cell.
fn take(sides: &mut BTreeMap<Corner, Vec<Corner>>, before: Option<Corner>, at: Corner) -> Option<Corner> {
    let leaving = sides.get_mut(&at)?;
    let left = |to: &Corner| {
        let (from, here) = before.map_or(((0, 0), (0, 0)), |from| (from, at));
        (here.0 - from.0) * (to.1 - at.1) - (here.1 - from.1) * (to.0 - at.0)
    };
    let best = (0..leaving.len()).max_by_key(|&place| left(&leaving[place]))?;
    let to = leaving.swap_remove(best);
    if leaving.is_empty() {
        sides.remove(&at);
    }
    Some(to)
}

/// A closed outline with fewer corners, none further from what it was than `off` (Douglas and Peucker 1973).
pub fn simplified(outline: &[Point], off: f64) -> Vec<Point> {
    let Some(&first) = outline.first() else { return Vec::new() };
    let far = (0..outline.len())
        .max_by(|&a, &b| first.squared_distance(outline[a]).total_cmp(&first.squared_distance(outline[b])))
        .unwrap_or(0);
    let mut kept = vec![false; outline.len()];
    (kept[0], kept[far]) = (true, true);
    let at = |place: usize| outline[place % outline.len()];
    let mut open = vec![(0, far), (far, outline.len())];
    while let Some((from, to)) = open.pop() {
        let chord = Segment::new(at(from), at(to));
        let distance = |place: &usize| chord.squared_distance(at(*place));
        let furthest = (from + 1..to).max_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(place) = furthest.filter(|place| distance(place) > off * off) {
            kept[place] = true;
            open.extend([(from, place), (place, to)]);
        }
    }
    outline.iter().zip(kept).filter(|(_, kept)| *kept).map(|(corner, _)| *corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_runs_around_its_cells_and_the_other_way_around_a_hole() {
        let ring = outlines(3, 3, |column, row| (column, row) != (1, 1));
        let area = |outline: &Vec<Point>| {
            super::super::polygon::sides(outline).map(|side| side.a.cross(side.b)).sum::<f64>() / 2.0
        };
        assert_eq!(ring.iter().map(area).collect::<Vec<_>>(), [9.0, -1.0]);
        assert_eq!(ring.iter().map(|outline| simplified(outline, 0.1).len()).collect::<Vec<_>>(), [4, 4]);
    }

    #[test]
    fn cells_that_touch_in_a_corner_have_outlines_of_their_own() {
        let two = outlines(2, 2, |column, row| column == row);
        assert_eq!(two.len(), 2);
    }
}
