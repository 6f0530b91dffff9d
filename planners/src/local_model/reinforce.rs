//! A segment of the model moved, turned and extended by what was seen of it.

use super::fit::Fit;
use super::{Estimate, ModelSegment, Settings};
use crate::geometry::tolerance::ROUNDING;
use crate::geometry::{Point, Segment};

/// Takes what was seen into a segment, weighted by how sure either is.
///
/// Errors of the pose are alike for all that one scan shows, and do not average out: a segment never becomes surer than
/// the pose is, unless it was before.
pub(super) fn reinforce(segment: &mut ModelSegment, seen: &Fit, ends: &Segment, estimate: &Estimate) {
    let (pose_m, pose_angle) = across(seen, estimate);
    let (middle, along) = (segment.line.middle(), aligned(segment.line.direction(), seen.along));
    // differences from the model to what is seen: an angle, and an offset to the left of the model where that was seen
    let turn = along.cross(seen.along).asin();
    let reach = seen.centre - middle;
    let offset = along.cross(reach);
    let lever = reach.dot(along);
    let mut line = Line {
        offset: 0.0,
        angle: 0.0,
        oo: segment.sigma_m.powi(2),
        oa: 0.0,
        aa: segment.sigma_angle.powi(2),
    };
    line.observe(0.0, 1.0, turn, seen.sigma_angle.powi(2) + pose_angle);
    line.observe(1.0, lever, offset, seen.sigma_m.powi(2) + pose_m);
    let new = Fit {
        centre: middle + along.perpendicular() * line.offset,
        along: along.rotated(Point::towards(line.angle)),
        sigma_m: segment.sigma_m.powi(2).min(line.oo.max(pose_m)).sqrt(),
        sigma_angle: segment.sigma_angle.powi(2).min(line.aa.max(pose_angle)).sqrt(),
    };
    let places = [segment.line.a, segment.line.b, ends.a, ends.b].map(|p| new.place(p));
    let (from, to) =
        places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(*p), b.max(*p)));
    // ends keep their names: `a` stays the end that it was
    let (from, to) =
        if new.place(segment.line.a) <= new.place(segment.line.b) { (from, to) } else { (to, from) };
    segment.line = Segment::new(new.at(from), new.at(to));
    segment.sigma_m = new.sigma_m.hypot(f64::midpoint(from, to) * new.sigma_angle);
    segment.sigma_angle = new.sigma_angle;
}

/// Variances that the pose adds to what is seen: across a line at its middle, and of its angle.
pub(super) fn across(seen: &Fit, estimate: &Estimate) -> (f64, f64) {
    let reach = seen.centre - estimate.pose.at;
    let across = seen.along.perpendicular();
    let row = nalgebra::RowVector3::new(across.x, across.y, reach.cross(across));
    ((row * estimate.covariance * row.transpose())[0].max(0.0), estimate.covariance[(2, 2)])
}

/// Whether two segments of the model show one surface: then `other` as if it had been seen.
pub(super) fn same_surface(segment: &ModelSegment, other: &ModelSegment, settings: &Settings) -> Option<Fit> {
    if is_certainly_beside(segment, other, settings) {
        return None;
    }
    let line = |s: &ModelSegment| Fit {
        centre: s.line.middle(),
        along: s.line.direction(),
        sigma_m: s.sigma_m,
        sigma_angle: s.sigma_angle,
    };
    let (one, two) = (line(segment), line(other));
    let sine = one.along.cross(two.along).abs();
    let lever = one.place(two.centre);
    let deviation = one.sigma_m.hypot(two.sigma_m).hypot(lever * one.sigma_angle);
    let allowed =
        (settings.match_sigmas * deviation).max(settings.split_m).min(settings.match_offset_m / 2.0);
    let (from, to) = (one.place(other.line.a), one.place(other.line.b));
    let half = segment.line.length() / 2.0;
    let overlap = from.max(to).min(half) - from.min(to).max(-half);
    let is_same =
        sine <= settings.match_angle.sin() && one.offset(two.centre).abs() <= allowed && overlap > 0.0;
    is_same.then_some(two)
}

/// Whether `other` lies farther aside than any deviation allows, told without roots: most that are near do.
fn is_certainly_beside(segment: &ModelSegment, other: &ModelSegment, settings: &Settings) -> bool {
    let (p, q) = (&segment.line, other.line.middle());
    let (middle, along) = (p.middle(), p.b - p.a);
    let offset = along.cross(q - middle);
    // rounding never decides: what is a little beyond is left to the exact measure
    let farthest = 0.5 * settings.match_offset_m * (1.0 + ROUNDING);
    offset * offset > farthest * farthest * along.dot(along)
}

fn aligned(along: Point, with: Point) -> Point {
    let is_opposite = along.dot(with) < 0.0;
    if is_opposite { -along } else { along }
}

/// Offset and angle of a line with their covariance.
struct Line {
    offset: f64,
    angle: f64,
    oo: f64,
    oa: f64,
    aa: f64,
}

impl Line {
    /// One observation of `by_offset * offset + by_angle * angle` (Kalman).
    fn observe(&mut self, by_offset: f64, by_angle: f64, value: f64, variance: f64) {
        let gain_o = self.oo * by_offset + self.oa * by_angle;
        let gain_a = self.oa * by_offset + self.aa * by_angle;
        let all = by_offset * gain_o + by_angle * gain_a + variance;
        if all <= 0.0 {
            return;
        }
        let surprise = (value - by_offset * self.offset - by_angle * self.angle) / all;
        self.offset += gain_o * surprise;
        self.angle += gain_a * surprise;
        self.oo -= gain_o * gain_o / all;
        self.oa -= gain_o * gain_a / all;
        self.aa -= gain_a * gain_a / all;
    }
}
