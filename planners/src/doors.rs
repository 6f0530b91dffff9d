//! Doors: where two rooms share a boundary (Abou-Ali et al., "Doors generation").

use crate::geometry::Rect;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedEdge {
    /// Index of one rectangle, the lower one.
    pub first: usize,
    pub second: usize,
    /// The shared segment, in metres: a rectangle without extent along one axis.
    pub segment: Rect,
}

impl SharedEdge {
    pub fn length(&self) -> f64 {
        self.segment.dx().max(self.segment.dy())
    }
}

/// One entry for every two rectangles that share a boundary segment of positive length, ordered by (first, second).
/// The rectangles must be disjoint (they may touch) and have a positive area; edges meet where their coordinates are
/// equal, not merely near.
///
/// Complexity: O((n + k) log n) for n rectangles and k shared edges.
///
/// # Example
/// ```
/// use adit_planners::{doors::shared_edges, geometry::Rect};
/// let rooms = [Rect::new(0.0, 0.0, 2.0, 2.0), Rect::new(2.0, 1.0, 3.0, 4.0), Rect::new(0.0, 2.0, 2.0, 3.0)];
/// let doors = shared_edges(&rooms);
/// assert_eq!(doors.iter().map(|d| (d.first, d.second)).collect::<Vec<_>>(), [(0, 1), (0, 2), (1, 2)]);
/// assert_eq!(doors[0].segment, Rect::new(2.0, 1.0, 2.0, 2.0));
/// ```
pub fn shared_edges(rects: &[Rect]) -> Vec<SharedEdge> {
    let upright = |rect: &Rect| *rect;
    let turned = |rect: &Rect| Rect::new(rect.y0, rect.x0, rect.y1, rect.x1);
    let mut shared = Vec::new();
    each_contact(rects, upright, |first, second, segment| shared.push(edge(first, second, segment)));
    each_contact(rects, turned, |first, second, segment| shared.push(edge(first, second, turned(&segment))));
    shared.sort_unstable_by_key(|edge| (edge.first, edge.second));
    shared
}

fn edge(one: usize, other: usize, segment: Rect) -> SharedEdge {
    SharedEdge { first: one.min(other), second: one.max(other), segment }
}

/// An upright edge of a rectangle.
struct Side {
    x: f64,
    y0: f64,
    y1: f64,
    rect: usize,
}

/// Calls `contact` for each right side that meets a left side, in the frame that `view` gives.
fn each_contact(rects: &[Rect], view: impl Fn(&Rect) -> Rect, mut contact: impl FnMut(usize, usize, Rect)) {
    let rights = sides(rects, |rect| view(rect).x1, &view);
    let lefts = sides(rects, |rect| view(rect).x0, &view);
    let (mut i, mut j) = (0, 0);
    while let (Some(right), Some(left)) = (rights.get(i), lefts.get(j)) {
        // Sides on one line come in order and do not overlap each other, so the one that ends first is done.
        if right.x < left.x || (right.x <= left.x && right.y1 <= left.y1) {
            i += 1;
        } else {
            j += 1;
        }
        let (low, high) = (right.y0.max(left.y0), right.y1.min(left.y1));
        if right.x <= left.x && left.x <= right.x && low < high {
            contact(right.rect, left.rect, Rect::new(right.x, low, right.x, high));
        }
    }
}

fn sides(rects: &[Rect], x: impl Fn(&Rect) -> f64, view: impl Fn(&Rect) -> Rect) -> Vec<Side> {
    let side = |(rect, of): (usize, &Rect)| Side { x: x(of) + 0.0, y0: view(of).y0, y1: view(of).y1, rect };
    let mut sides: Vec<_> = rects.iter().enumerate().map(side).collect();
    sides.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y0.total_cmp(&b.y0)).then(a.rect.cmp(&b.rect)));
    sides
}
