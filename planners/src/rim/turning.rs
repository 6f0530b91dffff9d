//! How far a body that is longer than wide turns on the spot until it touches something.

use super::Rim;
use super::disc::{HAIR_M, Touch};
use crate::geometry::Segment;
use crate::pose::Pose;

/// The least step of a turn, radians; where it leads against something, that is found by so many halvings.
const PROBE: f64 = 1e-5;
const HALVINGS: usize = 40;

/// After so many steps a turn along what is nearly touched is given up.
const MOST_STEPS: usize = 2000;

impl Rim {
    /// What it touches first where it turns by radians at a pose, the rim being that of heading 0; `None` where it does not touch.
    pub fn turn(&self, pose: &Pose, by: f64, barriers: &[Segment]) -> Option<Touch> {
        let outer_m = self.outer_m();
        let near = barriers.iter().filter(|barrier| barrier.distance(pose.at) <= outer_m + HAIR_M);
        let near: Vec<&Segment> = if self.is_disc() || by == 0.0 { Vec::new() } else { near.collect() };
        if near.is_empty() {
            return None;
        }
        let nearest = |turned: f64| {
            let rim = self.turned(pose.heading + turned);
            let gaps =
                near.iter().map(|barrier| (rim.distance(pose.at, barrier) - self.radius_m(), *barrier));
            gaps.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap_or((f64::INFINITY, near[0]))
        };
        let touched = |turned: f64| {
            let at = self.turned(pose.heading + turned).nearest_on(pose.at, nearest(turned).1);
            Some(Touch { share: turned / by, at })
        };
        let mut turned = 0.0;
        for _ in 0..MOST_STEPS {
            let left = by.abs() - f64::abs(turned);
            // no point of the body moves farther than its outermost one
            let step = ((nearest(turned).0 - HAIR_M) / outer_m).max(PROBE).min(left);
            let mut next = turned + by.signum() * step;
            if nearest(next).0 < HAIR_M {
                for _ in 0..HALVINGS {
                    let middle = f64::midpoint(turned, next);
                    (turned, next) =
                        if nearest(middle).0 < HAIR_M { (turned, middle) } else { (middle, next) };
                }
                return touched(turned);
            }
            turned = next;
            if step >= left {
                return None;
            }
        }
        touched(turned)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::geometry::Point;

    fn wall(y: f64) -> [Segment; 1] {
        [Segment::new(Point::new(-5.0, y), Point::new(5.0, y))]
    }

    #[test]
    fn a_body_beside_a_wall_turns_until_its_corner_is_there() {
        let rim = Rim::body(0.8, 0.4);
        let touch = rim
            .turn(&Pose::default(), FRAC_PI_2, &wall(0.3))
            .expect("it is longer than the room that it has");
        let turned = touch.share * FRAC_PI_2;
        // the corner rises to hypot(0.4, 0.2) * sin(turned + atan(0.2 / 0.4))
        let corner = 0.4_f64.hypot(0.2) * (turned + 0.5_f64.atan()).sin();
        assert!((corner - 0.3).abs() < 1e-3, "{corner}");
        assert!(rim.turned(turned).distance(Point::default(), &wall(0.3)[0]) >= rim.radius_m());
        assert!(rim.turned(turned).feels(Point::default(), &wall(0.3)[0]));
        assert!(touch.at.y > 0.299 && touch.at.x > 0.0, "{touch:?}");
        // and no farther from there, but back
        let there = Pose::new(0.0, 0.0, turned);
        assert!(rim.turn(&there, 0.1, &wall(0.3)).is_some_and(|touch| touch.share < 1e-3));
        assert_eq!(rim.turn(&there, -turned, &wall(0.3)), None);
    }

    #[test]
    fn a_disc_and_who_has_room_turn_all_the_way() {
        assert_eq!(Rim::disc(0.4).turn(&Pose::default(), 3.0, &wall(0.4)), None);
        assert_eq!(Rim::body(0.8, 0.4).turn(&Pose::default(), 3.0, &wall(0.46)), None);
    }
}
