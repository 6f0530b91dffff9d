//! Polygons by their corners in order; the last side goes back to the first corner.

use geo::{ConvexHull, Polygon};

use super::{Point, Rect, Segment, orient};

pub fn sides(corners: &[Point]) -> impl Iterator<Item = Segment> + Clone + '_ {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| Segment::new(a, b))
}

/// The sides of a rectangle, counterclockwise.
pub fn sides_of_rect(rect: &Rect) -> [Segment; 4] {
    let [a, b, c, d] = rect.corners();
    [Segment::new(a, b), Segment::new(b, c), Segment::new(c, d), Segment::new(d, a)]
}

/// As the `geo` crate has it.
pub fn to_geo(corners: &[Point]) -> Polygon {
    Polygon::new(corners.iter().copied().collect(), Vec::new())
}

/// Whether a point lies inside of closed outlines, by the parity of the sides to its right; exact, and on a side either.
pub fn encloses(sides: impl IntoIterator<Item = Segment>, p: Point) -> bool {
    let is_crossed = |side: &Segment| {
        let is_up = side.b.y > p.y;
        (side.a.y > p.y) != is_up && (orient(side.a, side.b, p) > 0.0) == is_up
    };
    sides.into_iter().filter(is_crossed).count() % 2 == 1
}

/// Where a horizontal line runs inside of closed outlines, from x to x, from left to right.
pub fn spans(sides: impl IntoIterator<Item = Segment>, y: f64) -> Vec<[f64; 2]> {
    let crossing = |Segment { a, b }: Segment| {
        ((a.y <= y) != (b.y <= y)).then(|| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
    };
    let mut crossings: Vec<f64> = sides.into_iter().filter_map(crossing).collect();
    crossings.sort_by(f64::total_cmp);
    crossings.chunks_exact(2).map(|span| [span[0], span[1]]).collect()
}

/// A polygon without the corners that lie no farther than so many metres from the straight line between their neighbours.
pub fn without_straight(corners: &[Point], aside_m: f64) -> Vec<Point> {
    let leftmost = |&one: &usize, &two: &usize| {
        let (one, two) = (corners[one], corners[two]);
        one.x.total_cmp(&two.x).then(one.y.total_cmp(&two.y))
    };
    let Some(first) = (0..corners.len()).min_by(leftmost) else { return Vec::new() };
    let mut kept: Vec<Point> = Vec::with_capacity(corners.len());
    for &next in corners[first..].iter().chain(&corners[..=first]) {
        while let [.., before, last] = kept[..]
            && Segment::new(before, next).distance(last) <= aside_m
        {
            kept.pop();
        }
        if kept.last().is_none_or(|last| last.distance(next) > aside_m) {
            kept.push(next);
        }
    }
    if kept.len() > 1 && kept.first() == kept.last() {
        kept.pop();
    }
    kept
}

/// Whether a convex outline, counterclockwise, holds a point, or comes as near to it as so many metres.
pub fn is_in_convex(corners: &[Point], p: Point, slack_m: f64) -> bool {
    sides(corners).all(|side| (side.b - side.a).cross(p - side.a) >= -slack_m * side.length())
}

/// The least convex outline about points, counterclockwise.
pub fn hull(points: impl IntoIterator<Item = Point>) -> Vec<Point> {
    let hull = points.into_iter().collect::<geo::LineString>().convex_hull();
    hull.exterior().coords().skip(1).map(|&corner| corner.into()).collect()
}

/// Whether two convex outlines, counterclockwise, have a point in common.
pub fn do_convex_meet(one: &[Point], other: &[Point]) -> bool {
    let holds =
        |outline: &[Point], of: &[Point]| of.first().is_some_and(|at| is_in_convex(outline, *at, 0.0));
    holds(one, other)
        || holds(other, one)
        || sides(one).any(|side| sides(other).any(|across| side.meets(&across)))
}

/// The first two sides, by number, that meet anywhere but in the corner between neighbours, or of which one leads back
/// along the other. Exact. O(n²) for n corners.
pub fn self_crossing(corners: &[Point]) -> Option<(usize, usize)> {
    let sides: Vec<Segment> = sides(corners).collect();
    let folds_back = |tip: Point, one: Point, other: Point| {
        orient(tip, one, other) == 0.0 && (one - tip).dot(other - tip) > 0.0
    };
    let meets = |i: usize, j: usize| {
        if j == i + 1 {
            folds_back(sides[i].b, sides[i].a, sides[j].b)
        } else if i == 0 && j == sides.len() - 1 {
            folds_back(sides[i].a, sides[i].b, sides[j].a)
        } else {
            sides[i].meets(&sides[j])
        }
    };
    (0..sides.len()).find_map(|i| (i + 1..sides.len()).find(|&j| meets(i, j)).map(|j| (i, j)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon<const N: usize>(corners: [(f64, f64); N]) -> [Point; N] {
        corners.map(|(x, y)| Point::new(x, y))
    }

    #[test]
    fn a_polygon_that_crosses_touches_or_folds_back_on_itself_is_found() {
        assert_eq!(self_crossing(&polygon([(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)])), Some((0, 2)));
        assert_eq!(self_crossing(&polygon([(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 2.0)])), Some((0, 1)));
        let pinched = polygon([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0)]);
        assert_eq!(self_crossing(&pinched), Some((0, 2)));
        assert_eq!(self_crossing(&polygon([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5)])), None);
    }

    #[test]
    fn corners_on_straight_sides_and_twice_the_same_are_left_out() {
        let about =
            polygon([(1.0, 0.0), (2.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1e-8, 1.0), (0.0, 0.0)]);
        let left = without_straight(&about, 1e-7);
        assert_eq!(left, polygon([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]).to_vec());
        assert_eq!(without_straight(&[], 1e-7), []);
    }

    #[test]
    fn a_ray_through_a_corner_counts_it_once() {
        let diamond = polygon([(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]);
        assert!(encloses(sides(&diamond), Point::new(0.0, 0.0)));
        assert!(!encloses(sides(&diamond), Point::new(-2.0, 0.0)));
        assert!(!encloses(sides(&diamond), Point::new(-2.0, 1.0)));
    }
}
