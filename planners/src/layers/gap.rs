//! Exact distances between a cell (a closed square) and what is solid, in metres.

use crate::geometry::{Point, Rect};

/// Signed gaps along x and y between two rectangles; negative where they overlap along that axis.
pub(super) fn axis_gaps(a: &Rect, b: &Rect) -> (f64, f64) {
    ((a.x0 - b.x1).max(b.x0 - a.x1), (a.y0 - b.y1).max(b.y0 - a.y1))
}

/// Distance of two closed rectangles.
pub(super) fn to_rect(cell: &Rect, rect: &Rect) -> f64 {
    let (dx, dy) = axis_gaps(cell, rect);
    dx.max(0.0).hypot(dy.max(0.0))
}

/// Distance of a closed rectangle from a closed segment.
pub(super) fn to_segment(cell: &Rect, a: Point, b: Point) -> f64 {
    if meets(cell, a, b) {
        return 0.0;
    }
    let corners = [(cell.x0, cell.y0), (cell.x1, cell.y0), (cell.x0, cell.y1), (cell.x1, cell.y1)];
    let from_corners = corners.into_iter().map(|(x, y)| point_to_segment(Point::new(x, y), a, b));
    let from_ends = [a, b].into_iter().map(|end| cell.nearest_to(end).distance(end));
    from_corners.chain(from_ends).fold(f64::INFINITY, f64::min)
}

/// Distance of a point from a closed segment.
pub(super) fn point_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let length2 = dx * dx + dy * dy;
    if length2 == 0.0 {
        return p.distance(a);
    }
    let t = (((p.x - a.x) * dx + (p.y - a.y) * dy) / length2).clamp(0.0, 1.0);
    p.distance(Point::new(a.x + t * dx, a.y + t * dy))
}

/// Whether segment and rectangle have a common point (Liang and Barsky's clipping).
fn meets(rect: &Rect, a: Point, b: Point) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let slabs = [(a.x, b.x - a.x, rect.x0, rect.x1), (a.y, b.y - a.y, rect.y0, rect.y1)];
    for (from, along, low, high) in slabs {
        if along == 0.0 {
            if from < low || from > high {
                return false;
            }
            continue;
        }
        let (t0, t1) = ((low - from) / along, (high - from) / along);
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    enter <= leave
}
