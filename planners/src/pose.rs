//! Where a robot is and which way it looks.

use std::f64::consts::{PI, TAU};

use crate::geometry::Point;

/// A place and a heading: in the map's frame, or relative to another pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Where, in metres.
    pub at: Point,
    /// Which way, in radians counter-clockwise from the x axis.
    pub heading: f64,
}

impl Pose {
    /// A pose from its parts: metres, metres, radians.
    pub const fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { at: Point::new(x, y), heading }
    }

    /// This pose, moved by a step that is told as seen from it.
    #[must_use]
    pub fn then(&self, step: &Self) -> Self {
        Self { at: Frame::from(self).place(step.at), heading: wrapped(self.heading + step.heading) }
    }

    /// The other pose as seen from this one: `self.then(&self.to(other))` is `other`.
    #[must_use]
    pub fn to(&self, other: &Self) -> Self {
        Self { at: Frame::from(self).seen(other.at), heading: wrapped(other.heading - self.heading) }
    }

    /// The pose so many metres ahead.
    #[must_use]
    pub fn ahead(&self, distance_m: f64) -> Self {
        self.then(&Self::new(distance_m, 0.0, 0.0))
    }

    /// The direction of a bearing (radians from the heading), of length 1.
    pub fn direction(&self, bearing: f64) -> Point {
        Point::towards(self.heading + bearing)
    }

    /// The bearing of a point: radians from the heading, above -PI up to PI.
    pub fn bearing(&self, of: Point) -> f64 {
        wrapped((of - self.at).angle() - self.heading)
    }
}

/// Where a robot was before, told by its wheels' count then: what was sensed while it stood has one count.
#[derive(Clone, Debug)]
pub(crate) struct Past {
    now: Pose,
    odometry: Pose,
    /// The count that was asked about last, with what was said.
    last: Option<(Pose, [Pose; 2])>,
}

impl Past {
    /// For a robot that is at a pose now, with this count.
    pub const fn new(now: Pose, odometry: Pose) -> Self {
        Self { now, odometry, last: None }
    }

    /// Where it was at a count: as seen from where it is now, and on the map.
    pub fn at(&mut self, odometry: &Pose) -> [Pose; 2] {
        if let Some((_, poses)) = self.last.filter(|(asked, _)| asked == odometry) {
            return poses;
        }
        let back = self.odometry.to(odometry);
        let poses = [back, self.now.then(&back)];
        self.last = Some((*odometry, poses));
        poses
    }
}

/// The frame of a pose, made ready to carry many points into it and out of it.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub at: Point,
    /// The direction of the heading, of length 1.
    pub ahead: Point,
}

impl From<&Pose> for Frame {
    fn from(pose: &Pose) -> Self {
        Self { at: pose.at, ahead: Point::towards(pose.heading) }
    }
}

impl Frame {
    /// A point of the map as it is seen from here.
    pub fn seen(&self, p: Point) -> Point {
        (p - self.at).seen_along(self.ahead)
    }

    /// Where on the map a point is that is told as seen from here.
    pub fn place(&self, own: Point) -> Point {
        let Point { x: cos, y: sin } = self.ahead;
        Point::new(self.at.x + cos * own.x - sin * own.y, self.at.y + sin * own.x + cos * own.y)
    }
}

/// The same angle above -PI and up to PI, radians.
pub fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_step_is_told_as_seen_from_the_robot() {
        let moved = Pose::new(1.0, 2.0, PI / 2.0).then(&Pose::new(3.0, 1.0, -PI / 2.0));
        assert!(moved.at.distance(Point::new(0.0, 5.0)) < 1e-12);
        assert!(moved.heading.abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn what_was_seen_from_a_pose_is_found_from_it(
            (x, y, heading) in (-9.0..9.0, -9.0..9.0, -9.0..9.0),
            (u, v, way) in (-9.0..9.0, -9.0..9.0, -9.0..9.0),
        ) {
            let (from, other) = (Pose::new(x, y, heading), Pose::new(u, v, way));
            let found = from.then(&from.to(&other));
            prop_assert!(found.at.distance(other.at) < 1e-9);
            prop_assert!(wrapped(found.heading - other.heading).abs() < 1e-9);
        }

        #[test]
        fn an_angle_is_wrapped_to_one_turn(angle in -50.0..50.0_f64) {
            let turned = wrapped(angle);
            prop_assert!(-PI < turned && turned <= PI);
            prop_assert!((turned.sin() - angle.sin()).abs() < 1e-9);
        }
    }
}
