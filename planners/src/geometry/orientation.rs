//! On which side of a line a point lies.

use robust::{Coord, orient2d};

use super::Point;

/// Twice the area of a triangle, square metres: positive where `c` lies left of the way from `a` to `b`, negative where
/// it lies right, 0 on the line. The sign is exact (Shewchuk 1997), the value right to a rounding.
pub fn orient(a: Point, b: Point, c: Point) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// The same, rounded: for a comparison with a tolerance, or where it is a length times a distance. A third of the time.
pub fn cross(a: Point, b: Point, c: Point) -> f64 {
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_a_rounding_beside_a_line_is_not_on_it() {
        let (a, b) = (Point::new(0.1, 0.1), Point::new(0.7, 0.7));
        let beside = Point::new(0.3, 0.3_f64.next_up());
        assert!(orient(a, b, beside) > 0.0 && orient(b, a, beside) < 0.0);
        assert!(orient(a, b, Point::new(0.3, 0.3)).abs() <= 0.0);
        assert!(cross(a, b, beside).abs() < 1e-16, "rounded, it hardly is beside");
    }
}
