//! A ray meets the nearest barrier, as if each of them were tried.

use adit_planners::geometry::{Point, RayGrid, Segment};
use proptest::prelude::*;

use super::regions::golden;

/// Distances to barriers by the sine rule: slower, and by other sums than the planner's.
fn tried(barriers: &[[Point; 2]], from: Point, heading: Point) -> f64 {
    let distance = |&[a, b]: &[Point; 2]| {
        let (sx, sy) = (b.x - a.x, b.y - a.y);
        let cross = heading.x * sy - heading.y * sx;
        let (wx, wy) = (a.x - from.x, a.y - from.y);
        let (t, u) = ((wx * sy - wy * sx) / cross, (wx * heading.y - wy * heading.x) / cross);
        if t >= 0.0 && (0.0..=1.0).contains(&u) { t } else { f64::INFINITY }
    };
    barriers.iter().map(distance).fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn the_nearest_barrier_is_met(
        walls in prop::collection::vec((0.0..40.0, 0.0..40.0, -9.0..9.0, -9.0..9.0), 0..60),
        rays in prop::collection::vec((-10.0..50.0, -10.0..50.0, 0.0..6.3), 20),
    ) {
        let barriers: Vec<[Point; 2]> =
            walls.iter().map(|&(x, y, dx, dy)| [Point::new(x, y), Point::new(x + dx, y + dy)]).collect();
        let grid = RayGrid::new(barriers.iter().copied().map(Segment::from).collect());
        for (x, y, angle) in rays {
            let (from, heading) = (Point::new(x, y), Point::new(f64::cos(angle), f64::sin(angle)));
            let expected = tried(&barriers, from, heading);
            match grid.cast(from, heading, 1e6) {
                Some(echo) => {
                    prop_assert!((echo.distance - expected).abs() < 1e-6, "{} {expected}", echo.distance);
                    let one = [barriers[echo.segment]];
                    prop_assert!((tried(&one, from, heading) - expected).abs() < 1e-6);
                }
                None => prop_assert!(expected.is_infinite(), "{expected}"),
            }
        }
    }
}

#[test]
fn a_ray_along_an_axis_meets_the_wall_across_and_none_beyond_its_range() {
    let plan = golden("house-7.json");
    let grid = RayGrid::new(plan.barriers().into_iter().map(Segment::from).collect());
    let east = |most| grid.cast(Point::new(1.0, 3.0), Point::new(1.0, 0.0), most);
    assert!((east(8.0).unwrap().distance - 4.0).abs() < 1e-12);
    assert_eq!(east(3.9), None);
    assert_eq!(grid.cast(Point::new(1.0, 3.0), Point::new(0.0, 0.0), 8.0), None);
    assert_eq!(grid.cast(Point::new(-5.0, 3.0), Point::new(-1.0, 0.0), 8.0), None);
}
