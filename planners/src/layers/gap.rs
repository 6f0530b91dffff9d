//! Exact distances between a cell (a closed square) and what is solid, in metres.

use crate::geometry::{Point, Rect, Segment};

/// Distance of a closed rectangle from a closed segment.
pub(super) fn to_segment(cell: &Rect, a: Point, b: Point) -> f64 {
    if meets(cell, a, b) {
        return 0.0;
    }
    let segment = Segment::new(a, b);
    let from_corners = cell.corners().into_iter().map(|corner| segment.distance(corner));
    let from_ends = [a, b].into_iter().map(|end| cell.nearest_to(end).distance(end));
    from_corners.chain(from_ends).fold(f64::INFINITY, f64::min)
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
