//! The same answers by plain search over all cells: slow, and written from the definitions.

use std::collections::HashMap;

use adit_planners::geometry::Rect;

use crate::rooms::maps::{BOUNDS, Map};

/// The cells between all edges of a map.
pub struct Cells {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
}

impl Cells {
    pub fn of(map: &Map) -> Self {
        let rects = || map.obstacles.iter().copied().chain(map.low.iter().map(|bridge| bridge.rect));
        let lines = |low: f64, high: f64, of: fn(Rect) -> [f64; 2]| {
            let mut lines: Vec<_> = rects().flat_map(of).map(|line| line.clamp(low, high)).collect();
            lines.extend([low, high]);
            lines.sort_by(f64::total_cmp);
            lines.dedup();
            lines
        };
        let x = lines(BOUNDS.x0, BOUNDS.x1, |rect| [rect.x0, rect.x1]);
        let y = lines(BOUNDS.y0, BOUNDS.y1, |rect| [rect.y0, rect.y1]);
        Self { x, y }
    }

    pub fn all(&self) -> impl Iterator<Item = Rect> + '_ {
        let cell = |x: &[f64], y: &[f64]| Rect::new(x[0], y[0], x[1], y[1]);
        self.x.windows(2).flat_map(move |x| self.y.windows(2).map(move |y| cell(x, y)))
    }
}

pub fn is_blocked(map: &Map, cell: &Rect) -> bool {
    map.obstacles.iter().any(|obstacle| obstacle.intersection(cell).is_some())
}

/// The clear height over a free cell, if a low bridge limits it.
pub fn height(map: &Map, cell: &Rect) -> Option<f64> {
    let over =
        map.low.iter().filter(|bridge| bridge.rect.intersection(cell).is_some()).map(|bridge| bridge.height);
    over.min_by(f64::total_cmp)
}

/// All rectangles of cells that are free and that no free one contains.
pub fn maximal(map: &Map) -> Vec<Rect> {
    let cells = Cells::of(map);
    let mut free = Vec::new();
    for (i, &x0) in cells.x.iter().enumerate() {
        for &x1 in &cells.x[i + 1..] {
            for (j, &y0) in cells.y.iter().enumerate() {
                for &y1 in &cells.y[j + 1..] {
                    let rect = Rect::new(x0, y0, x1, y1);
                    if !is_blocked(map, &rect) {
                        free.push(rect);
                    }
                }
            }
        }
    }
    let grown = |rect: &Rect| {
        let next = |lines: &[f64], line: f64| lines.iter().copied().find(|&other| other > line);
        let before = |lines: &[f64], line: f64| lines.iter().copied().rev().find(|&other| other < line);
        [
            before(&cells.x, rect.x0).map(|x0| Rect { x0, ..*rect }),
            next(&cells.x, rect.x1).map(|x1| Rect { x1, ..*rect }),
            before(&cells.y, rect.y0).map(|y0| Rect { y0, ..*rect }),
            next(&cells.y, rect.y1).map(|y1| Rect { y1, ..*rect }),
        ]
    };
    free.retain(|rect| grown(rect).into_iter().flatten().all(|larger| is_blocked(map, &larger)));
    free.sort_by(|a, b| a.partial_cmp(b).unwrap());
    free
}

/// The paper's steps 2 to 4, word by word: `first` are list 1, `lists` are lists 2 and 3.
pub fn paper_steps(first: &[Rect], mut lists: [Vec<Rect>; 2]) -> Vec<Rect> {
    for room in first {
        for list in &mut lists {
            subtract(list, room);
        }
    }
    let mut rooms = Vec::new();
    for i in 0..2 {
        while let Some(largest) = lists[i].iter().copied().reduce(larger) {
            for list in &mut lists {
                subtract(list, &largest);
            }
            rooms.push(largest);
        }
    }
    rooms
}

fn larger(a: Rect, b: Rect) -> Rect {
    // areas that differ by rounding are equal: the last 12 bits of 52 do not count
    let size = |rect: &Rect| (rect.area().to_bits() + (1 << 11)) >> 12;
    let b_wins = size(&b) > size(&a) || (size(&b) == size(&a) && b < a);
    if b_wins { b } else { a }
}

/// What is left of each area, up to four maximal rectangles, without those inside another one.
fn subtract(list: &mut Vec<Rect>, room: &Rect) {
    let mut left = Vec::new();
    for area in list.drain(..) {
        if !area.overlaps(room) {
            left.push(area);
            continue;
        }
        let sides = [
            Rect { x1: room.x0, ..area },
            Rect { x0: room.x1, ..area },
            Rect { y1: room.y0, ..area },
            Rect { y0: room.y1, ..area },
        ];
        left.extend(sides.into_iter().filter(|side| side.x0 < side.x1 && side.y0 < side.y1));
    }
    for (i, area) in left.iter().enumerate() {
        let is_inside = |(j, other): (usize, &Rect)| other.encloses(area) && (other != area || j < i);
        if !left.iter().enumerate().any(is_inside) {
            list.push(*area);
        }
    }
}

/// The fewest rectangles that part the free cells (bits, row by row) of a grid `columns` wide.
pub fn fewest(free: u32, columns: u32, known: &mut HashMap<u32, usize>) -> usize {
    if free == 0 {
        return 0;
    }
    if let Some(&count) = known.get(&free) {
        return count;
    }
    let corner = free.trailing_zeros();
    let mut best = usize::MAX;
    for width in 1..=columns - corner % columns {
        let row = ((1_u32 << width) - 1) << corner;
        let mut rect = 0;
        let mut shift = 0;
        while shift + corner < u32::BITS && free & (row << shift) == row << shift {
            rect |= row << shift;
            best = best.min(1 + fewest(free & !rect, columns, known));
            shift += columns;
        }
    }
    known.insert(free, best);
    best
}
