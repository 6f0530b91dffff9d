//! How near a straight way comes to something solid, in closed form.

use adit_planners::geometry::{Point, Rect};

/// From a point to a segment.
pub fn point_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let squared = dx * dx + dy * dy;
    if squared == 0.0 {
        return p.distance(a);
    }
    let along = (((p.x - a.x) * dx + (p.y - a.y) * dy) / squared).clamp(0.0, 1.0);
    p.distance(Point::new(a.x + along * dx, a.y + along * dy))
}

/// Between two segments; 0 where they cross.
pub fn segment_to_segment(a: Point, b: Point, c: Point, d: Point) -> f64 {
    let side = |p: Point, q: Point, r: Point| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
        return 0.0;
    }
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    ends.into_iter().map(|(p, q, r)| point_to_segment(p, q, r)).fold(f64::INFINITY, f64::min)
}

/// From a segment to a rectangle; 0 where they meet.
pub fn segment_to_rect(a: Point, b: Point, rect: &Rect) -> f64 {
    if meets(a, b, rect) {
        return 0.0;
    }
    let Rect { x0, y0, x1, y1 } = *rect;
    let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
    let ends = rect.nearest_to(a).distance(a).min(rect.nearest_to(b).distance(b));
    corners.into_iter().map(|(x, y)| point_to_segment(Point::new(x, y), a, b)).fold(ends, f64::min)
}

/// From a segment to a simple polygon; 0 where they meet or the segment lies inside.
pub fn segment_to_polygon(a: Point, b: Point, corners: &[Point]) -> f64 {
    if is_inside(a, corners) {
        return 0.0;
    }
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges.map(|(&c, &d)| segment_to_segment(a, b, c, d)).fold(f64::INFINITY, f64::min)
}

/// Whether a ray from the point crosses the outline an odd number of times.
fn is_inside(p: Point, corners: &[Point]) -> bool {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = edges
        .filter(|(c, d)| (c.y <= p.y) != (d.y <= p.y) && p.x < c.x + (p.y - c.y) / (d.y - c.y) * (d.x - c.x));
    crossed.count() % 2 == 1
}

/// How much of a segment lies inside a rectangle, metres; what runs along its outline does not.
pub fn within(a: Point, b: Point, rect: &Rect) -> f64 {
    let same = |p: f64, q: f64| (p - q).abs() < 1e-9;
    let along_outline = |p, q, low, high| same(p, q) && (same(p, low) || same(p, high));
    if along_outline(a.x, b.x, rect.x0, rect.x1) || along_outline(a.y, b.y, rect.y0, rect.y1) {
        return 0.0;
    }
    clipped(a, b, rect).map_or(0.0, |(from, to)| (to - from) * a.distance(b))
}

fn meets(a: Point, b: Point, rect: &Rect) -> bool {
    clipped(a, b, rect).is_some()
}

/// The part of a segment in a closed rectangle, as shares of its length (Liang and Barsky's clipping).
fn clipped(a: Point, b: Point, rect: &Rect) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (start, delta, low, high) in [(a.x, b.x - a.x, rect.x0, rect.x1), (a.y, b.y - a.y, rect.y0, rect.y1)]
    {
        if delta == 0.0 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let (enter, leave) = ((low - start) / delta, (high - start) / delta);
        from = from.max(enter.min(leave));
        to = to.min(enter.max(leave));
    }
    (from <= to).then_some((from, to))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: Rect = Rect::new(0.0, 0.0, 1.0, 1.0);

    fn to_square(ax: f64, ay: f64, bx: f64, by: f64) -> [f64; 2] {
        let (a, b) = (Point::new(ax, ay), Point::new(bx, by));
        let outline = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        [segment_to_rect(a, b, &SQUARE), segment_to_polygon(a, b, &outline)]
    }

    #[track_caller]
    fn expect(way: [f64; 4], distance: f64) {
        for near in to_square(way[0], way[1], way[2], way[3]) {
            assert!((near - distance).abs() < 1e-12, "{near}, not {distance}");
        }
    }

    #[test]
    fn a_way_beside_a_square_is_as_near_as_its_nearest_side() {
        expect([-1.0, 1.5, 3.0, 1.5], 0.5);
        expect([2.0, -9.0, 2.0, 9.0], 1.0);
    }

    #[test]
    fn a_slanting_way_is_as_near_as_the_corner() {
        expect([1.0, 2.0, 2.0, 1.0], 0.5f64.sqrt());
    }

    #[test]
    fn what_goes_through_or_lies_within_is_not_apart() {
        expect([-1.0, -1.0, 2.0, 2.1], 0.0);
        expect([0.2, 0.2, 0.4, 0.7], 0.0);
        expect([0.5, 0.5, 5.0, 0.5], 0.0);
    }
}
