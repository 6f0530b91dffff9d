//! A body that is longer than wide, at one of a few facings, and while it turns from one to the next.
//!
//! A layer holds the points about which the body is free at exactly its facing: there it may move in any direction,
//! as a side-step does. It may turn only where all that it sweeps between two facings is free, which is a smaller
//! set of points, within the free space of both facings: so it is safe at either end of a turn and all the way.

use geo::{ConvexHull, Coord, LineString};

use crate::geometry::Point;

/// In how many ways a body can face. Half a turn shows it the same.
pub(super) const FACINGS: usize = 8;

/// Degrees from one facing to the next; counterclockwise from x.
pub(crate) const STEP_DEGREES: f64 = 180.0 / FACINGS as f64;

/// The corners of the body, counterclockwise, its length along the facing.
///
/// # Arguments
/// `clearance` is added on all four sides.
pub(crate) fn body(length: f64, width: f64, clearance: f64, facing: usize) -> Vec<Point> {
    let (radius, angles) = corners(length, width, clearance);
    let turned = |angle: f64| Point::towards(angle + radians(facing)) * radius;
    angles.map(turned).into()
}

/// The corners, counterclockwise, of a convex outline that holds all that the body sweeps while it turns to the next facing.
pub(super) fn sweep(length: f64, width: f64, clearance: f64, facing: usize) -> Vec<Point> {
    let (radius, angles) = corners(length, width, clearance);
    let half_step = STEP_DEGREES.to_radians() / 2.0;
    // Each corner moves on an arc, which lies inside of the chord and the tangents at its ends. The body at any
    // heading is the hull of its corners, so the hull of all arcs holds it.
    let arc = |angle: f64| {
        let from = angle + radians(facing);
        let apex = Point::towards(from + half_step) * (radius / half_step.cos());
        [Point::towards(from) * radius, apex, Point::towards(from + 2.0 * half_step) * radius]
    };
    let points = angles.into_iter().flat_map(arc).map(Coord::from);
    let hull = points.collect::<LineString>().convex_hull();
    hull.exterior().0[1..].iter().map(|&corner| corner.into()).collect()
}

/// The corners' distance from the middle, and their angles where the body faces along x.
fn corners(length: f64, width: f64, clearance: f64) -> (f64, [f64; 4]) {
    let (along, across) = (length / 2.0 + clearance, width / 2.0 + clearance);
    let angle = across.atan2(along);
    let half_turn = std::f64::consts::PI;
    (along.hypot(across), [angle, half_turn - angle, half_turn + angle, -angle])
}

fn radians(facing: usize) -> f64 {
    (facing as f64 * STEP_DEGREES).to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_holds_the_body_at_every_heading_between_two_facings() {
        let (length, width) = (0.7, 0.25);
        let hull = geo::ConvexHull::convex_hull(&geo::MultiPoint::from(
            sweep(length, width, 0.0, 3).iter().map(|p| (p.x, p.y)).collect::<Vec<_>>(),
        ));
        let (radius, angles) = corners(length, width, 0.0);
        for step in 0..=100 {
            let heading = (3.0 + f64::from(step) / 100.0) * STEP_DEGREES.to_radians();
            for angle in angles {
                let p = Point::towards(angle + heading) * (radius * (1.0 - 1e-9));
                assert!(geo::Intersects::intersects(&hull, &geo::Point::new(p.x, p.y)), "{p:?}");
            }
        }
    }
}
