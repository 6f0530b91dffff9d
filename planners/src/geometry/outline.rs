//! The outlines of cells: closed, along their sides, and simplified.

use super::{Point, Segment};

/// Columns and rows along the sides that may leave a corner: to the right, up, to the left, down.
const ALONG: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// The outlines of the cells of a set, in cells: the set lies left of each; outer ones run counterclockwise, those of
/// holes clockwise. Cells that touch in a corner only are apart.
pub fn outlines(columns: usize, rows: usize, is_in: impl Fn(usize, usize) -> bool) -> Vec<Vec<Point>> {
    // for each corner, by columns, a bit for each side that leaves it
    let mut leaving = vec![0_u8; (columns + 1) * (rows + 1)];
    let place = |x: usize, y: usize| x * (rows + 1) + y;
    let mut below = vec![false; columns];
    for y in 0..=rows {
        let mut before = false;
        for (x, below) in below.iter_mut().enumerate() {
            let here = y < rows && is_in(x, y);
            if here != *below {
                leaving[if here { place(x, y) } else { place(x + 1, y) }] |= if here { 1 } else { 1 << 2 };
            }
            if here != before {
                leaving[if here { place(x, y + 1) } else { place(x, y) }] |=
                    if here { 1 << 3 } else { 1 << 1 };
            }
            (*below, before) = (here, here);
        }
        if before {
            leaving[place(columns, y)] |= 1 << 1;
        }
    }
    let mut all = Vec::new();
    for start in 0..leaving.len() {
        while leaving[start] != 0 {
            let mut outline = Vec::new();
            let (mut at, mut side) = (start, None);
            while let Some(next) = take(&mut leaving[at], side) {
                outline.push(Point::new((at / (rows + 1)) as f64, (at % (rows + 1)) as f64));
                let (dx, dy) = ALONG[next];
                at = at.wrapping_add_signed(dx as isize * (rows as isize + 1) + dy as isize);
                side = Some(next);
            }
            all.push(outline);
        }
    }
    all
}

/// The side that goes on from a corner; of two the one to the left, which stays with the same cell.
fn take(leaving: &mut u8, before: Option<usize>) -> Option<usize> {
    let left = before.map_or(0, |before| before + 1);
    let next = [left, left + 3, left + 2, left + 1]
        .map(|side| side % 4)
        .into_iter()
        .find(|side| *leaving & 1 << side != 0)?;
    *leaving &= !(1 << next);
    Some(next)
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
