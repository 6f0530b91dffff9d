//! Which segment of a scan lies on which of the model.

use std::f64::consts::FRAC_PI_6;

use nalgebra::{Matrix3, RowVector3};

use super::sensor_model::Seen;
use super::{Estimate, ModelSegment, Settings};
use crate::geometry::Point;
use crate::geometry::tolerance::{ROUNDING, ROUNDING_M};
use crate::search::Csr;

/// A segment of a scan on one of the model, by what has to be told of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    /// The segment of the model, by its place.
    pub model: usize,
    /// How far the model's segment lies to the left of the scan's, at the middle of the latter, metres.
    pub offset_m: f64,
    /// Angle from the scan's segment to the model's, as lines: at most a quarter turn.
    pub angle: f64,
    /// Whether enough of the shorter one lies beside the other.
    pub is_enough: bool,
    /// Metres along which they lie side by side.
    overlap_m: f64,
    /// Square of the difference by its standard deviations.
    surprise: f64,
}

/// Up to this angle a segment of a scan may be one that scans leave where it is, if the standard deviations allow it.
const LARGEST_ANGLE: f64 = FRAC_PI_6;

/// What lies before a segment by less hides nothing: corners meet it there, metres.
const BEFORE_M: f64 = 0.02;

/// Segments lie in so many rings about the robot, by their nearest points.
const RINGS: usize = 64;

/// A direction and place of a segment within hearing, so that most are left out after a few operations.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub model: usize,
    pub a: Point,
    pub along: Point,
    pub length_m: f64,
    /// How far its nearest point is from where the robot was thought to be, metres, up to rounding.
    pub nearest_m: f64,
    is_anchored: bool,
}

impl Near {
    fn new(model: usize, segment: &ModelSegment, at: Point) -> Self {
        let (line, length_m) = (&segment.line, segment.line.length());
        let share = 1.0 / length_m.max(f64::MIN_POSITIVE);
        let along = (line.b - line.a) * share;
        let is_anchored = segment.is_anchored;
        let near = Self { model, a: line.a, along, length_m, nearest_m: 0.0, is_anchored };
        let nearest = near.a + along * near.place(at).clamp(0.0, length_m);
        Self { nearest_m: nearest.distance(at), ..near }
    }

    fn place(&self, p: Point) -> f64 {
        (p - self.a).dot(self.along)
    }

    /// How far a point lies to the left of the line.
    fn offset(&self, p: Point) -> f64 {
        self.along.cross(p - self.a)
    }
}

/// The segments of the model within hearing.
pub(super) struct Nearby {
    /// In the order of their places.
    pub walls: Vec<Near>,
    /// Where the robot was thought to be when they were gathered.
    pub at: Point,
    /// Where they stand in that order, by the ring about there in which the nearest point is.
    rings: Csr<u32>,
    /// How wide a ring is, metres.
    ring_m: f64,
    /// How far the middle of one that scans leave where it is is at most, and how unsure such a one is.
    middle_m: f64,
    sigmas: [f64; 2],
}

impl Nearby {
    pub fn new(places: impl Iterator<Item = usize>, segments: &[ModelSegment], at: Point) -> Self {
        let (mut walls, mut farthest_m) = (Vec::with_capacity(segments.len()), 0.0_f64);
        let (mut middle, [mut sigma_m, mut sigma_angle]) = (0.0_f64, [0.0_f64; 2]);
        for place in places {
            let segment = &segments[place];
            let wall = Near::new(place, segment, at);
            walls.push(wall);
            farthest_m = farthest_m.max(wall.nearest_m);
            if segment.is_anchored {
                middle = middle.max(segment.line.middle().squared_distance(at));
                (sigma_m, sigma_angle) = (sigma_m.max(segment.sigma_m), sigma_angle.max(segment.sigma_angle));
            }
        }
        let ring_m = (farthest_m / RINGS as f64).max(ROUNDING_M);
        let of_rings = (0..).zip(&walls).map(|(index, wall)| (ring(wall.nearest_m, ring_m), index));
        let rings = Csr::new(RINGS, of_rings);
        Self { walls, at, rings, ring_m, middle_m: middle.sqrt(), sigmas: [sigma_m, sigma_angle] }
    }

    /// All that may have a point so near to where the robot was thought to be, and some others.
    fn within(&self, reach_m: f64) -> impl Iterator<Item = &Near> {
        let reach_m = reach_m * (1.0 + ROUNDING) + ROUNDING_M;
        let rings = &self.rings.items()[..self.rings.range(ring(reach_m, self.ring_m)).end];
        rings.iter().map(|&index| &self.walls[index as usize])
    }

    /// How far from the middle of a scan's segment the line of any on which it may lie runs at most, by how unsure the pose is
    /// (a variance across the segment).
    fn reach_m(&self, seen: &Seen, by_pose: f64, estimate: &Estimate, settings: &Settings) -> f64 {
        let lever = self.middle_m + seen.fit.centre.distance(self.at);
        let (by_offset, _) = variances_by(seen, lever, self.sigmas, estimate, settings);
        let standing_m = settings.match_sigmas * (by_offset + by_pose).sqrt();
        settings.match_offset_m.max(standing_m) * (1.0 + ROUNDING)
    }
}

fn ring(far_m: f64, ring_m: f64) -> usize {
    ((far_m / ring_m) as usize).min(RINGS - 1)
}

/// How sure the place of a segment is as seen from an estimated pose: variances across it at a point, and of its angle.
pub(super) fn variances(
    seen: &Seen,
    segment: &ModelSegment,
    estimate: &Estimate,
    settings: &Settings,
) -> (f64, f64) {
    let lever = seen.fit.place(segment.line.middle());
    variances_by(seen, lever, segment.relative_sigmas(settings), estimate, settings)
}

/// The same for a segment with standard deviations across it and of its angle, the middle of which lies so far along.
fn variances_by(
    seen: &Seen,
    lever: f64,
    [sigma_m, sigma_angle]: [f64; 2],
    estimate: &Estimate,
    settings: &Settings,
) -> (f64, f64) {
    let (fit, at) = (&seen.fit, estimate.pose.at);
    let arm = fit.place(at).abs();
    let heading = settings.heading_noise.powi(2) * seen.since_m;
    let driven = (settings.distance_noise * seen.since_m).powi(2);
    let offset = fit.sigma_m.powi(2)
        + sigma_m.powi(2)
        + (lever * sigma_angle).powi(2)
        + driven
        + heading * arm.powi(2);
    let angle = fit.sigma_angle.powi(2) + sigma_angle.powi(2) + heading;
    (offset, angle)
}

/// Whether another segment that stays where it is lies before one, seen from the robot towards what a scan shows of it:
/// of the two faces of a wall only the nearer one can be seen.
fn is_hidden(wall: &Near, seen: &Seen, near: &Nearby, segments: &[ModelSegment], from: Point) -> bool {
    let on = wall.a + wall.along * wall.place(seen.fit.centre).clamp(0.0, wall.length_m);
    let far = on.distance(from);
    let towards = (on - from) * (1.0 / far.max(f64::MIN_POSITIVE));
    // no point of the others is so near
    near.within(far + from.distance(near.at)).filter(|other| other.is_anchored).any(|other| {
        let hit = segments[other.model].line.hit(from, towards);
        other.model != wall.model && hit.is_some_and(|(range_m, _)| range_m < far - BEFORE_M)
    })
}

/// All segments of the model on which one of a scan may lie, the best first.
///
/// # Arguments
/// `least_overlap` is the share of the shorter one that has to lie beside the other.
pub(super) fn matches(
    seen: &Seen,
    least_overlap: f64,
    near: &Nearby,
    segments: &[ModelSegment],
    estimate: &Estimate,
    settings: &Settings,
) -> Vec<Match> {
    let mut found = Vec::new();
    let (largest_sine, least_sine) = (LARGEST_ANGLE.sin(), settings.match_angle.sin());
    let (fit, length_m) = (&seen.fit, seen.line.length());
    let is_vague = estimate.is_vague(settings);
    let across = fit.along.perpendicular();
    let lever = (fit.centre - estimate.pose.at).cross(across);
    let row = RowVector3::new(across.x, across.y, lever);
    let by_pose = |covariance: &Matrix3<f64>| (row * covariance * row.transpose())[0];
    let reach_m = near.reach_m(seen, by_pose(&estimate.covariance), estimate, settings);
    // what lies beside a part of it is no farther from its centre than that
    let ends_m = seen.line.a.distance(fit.centre).max(seen.line.b.distance(fit.centre));
    let far_m = fit.centre.distance(near.at) + reach_m + ends_m;
    for wall in near.within(far_m) {
        let offset = wall.offset(fit.centre);
        if offset.abs() > reach_m {
            continue;
        }
        let sine = fit.along.cross(wall.along);
        if sine.abs() > largest_sine {
            continue;
        }
        let segment = &segments[wall.model];
        let is_off = offset.abs() > settings.match_offset_m || sine.abs() > least_sine;
        let is_out = if segment.is_anchored { is_vague } else { is_off };
        if is_out {
            continue;
        }
        let (from, to) = (wall.place(seen.line.a), wall.place(seen.line.b));
        let overlap_m = from.max(to).min(wall.length_m) - from.min(to).max(0.0);
        let shorter_m = length_m.min(wall.length_m);
        if overlap_m < least_overlap * shorter_m {
            continue;
        }
        let is_along = fit.along.dot(wall.along) >= 0.0;
        // measured to the left of the scan's segment, whose direction may be the other one
        let offset_m = if is_along { -offset } else { offset };
        let angle = if is_along { sine } else { -sine }.asin();
        let (by_offset, by_angle) = variances(seen, segment, estimate, settings);
        let covariance = estimate.seen_from(segment);
        let offset_variance = by_offset + by_pose(covariance);
        let angle_variance = by_angle + covariance[(2, 2)];
        let gate = settings.match_sigmas.powi(2);
        let (off, turned) = (offset_m.powi(2) / offset_variance, angle.powi(2) / angle_variance);
        if off > gate || turned > gate {
            continue;
        }
        if !(segment.is_anchored && is_hidden(wall, seen, near, segments, estimate.pose.at)) {
            let is_enough = overlap_m >= settings.match_overlap * shorter_m;
            let (model, surprise) = (wall.model, off + turned);
            found.push(Match { model, offset_m, angle, is_enough, overlap_m, surprise });
        }
    }
    // Of known walls the nearest one is seen; of what the robot has found, the longest is the surest.
    let rank = |one: &Match| {
        if segments[one.model].is_anchored { (0, one.surprise) } else { (1, -one.overlap_m) }
    };
    let order = |a: &Match, b: &Match| {
        let ((kind, a_by), (other_kind, b_by)) = (rank(a), rank(b));
        kind.cmp(&other_kind).then(a_by.total_cmp(&b_by)).then(a.model.cmp(&b.model))
    };
    found.sort_by(order);
    found
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::super::beam::Beam;
    use super::super::sensor_model;
    use super::*;
    use crate::body::Reading;
    use crate::geometry::Segment;
    use crate::local_model::{LocalModel, SegmentFacts, Transition};
    use crate::pose::{Past, Pose};

    impl Nearby {
        /// The same, by which none is left out early.
        fn without_bounds(mut self) -> Self {
            self.sigmas[0] = f64::INFINITY;
            self.ring_m = f64::MIN_POSITIVE;
            self
        }
    }

    fn stays(facts: &SegmentFacts) -> Transition {
        let confidence = 5;
        let is_anchored = !facts.id.0.is_multiple_of(3);
        let source = facts.source;
        Transition { confidence, source, is_kept: true, counts_for_pose: true, is_anchored, is_cut: false }
    }

    /// What a robot that stands at the origin hears of walls.
    fn scan(walls: &[Segment], noise_m: &[f64]) -> Vec<Reading> {
        let count = noise_m.len() as f64;
        let reading = |(i, noise_m): (usize, &f64)| {
            let bearing = TAU * i as f64 / count;
            let ranges = walls.iter().filter_map(|wall| wall.hit(Point::default(), Point::towards(bearing)));
            let range_m = ranges.map(|(range_m, _)| range_m).min_by(f64::total_cmp);
            let range_m = range_m.filter(|range_m| *range_m < 8.0).map(|range_m| range_m + noise_m);
            Reading { bearing, range_m, odometry: Pose::default() }
        };
        noise_m.iter().enumerate().map(reading).collect()
    }

    fn wall() -> impl Strategy<Value = Segment> {
        let middle = (-5.0..5.0, -5.0..5.0).prop_map(|(x, y)| Point::new(x, y));
        (middle, 0.0..TAU, 0.1..4.0).prop_map(|(middle, angle, half_m)| {
            let half = Point::towards(angle) * half_m;
            Segment::new(middle - half, middle + half)
        })
    }

    proptest! {
        #[test]
        fn what_is_left_out_early_matches_nothing(
            walls in prop::collection::vec(wall(), 1..40),
            copies in prop::collection::vec((0..40_usize, -0.3..0.3, -0.3..0.3), 0..40),
            noise_m in prop::collection::vec(-0.02..0.02, 120),
            (x, y, heading) in (-0.2..0.2, -0.2..0.2, -0.1..0.1),
            (sigma_m, sigma_heading) in (0.0..0.3, 0.0..0.1),
            moved_m in -0.3..0.3,
        ) {
            // faces of walls that hide one another
            let faces = copies.into_iter().map(|(wall, dx, dy)| {
                let Segment { a, b } = walls[wall % walls.len()];
                Segment::new(a + Point::new(dx, dy), b + Point::new(dx, dy))
            });
            let known: Vec<Segment> = walls.iter().copied().chain(faces).collect();
            let estimate = Estimate::new(Pose::new(x, y, heading), sigma_m, sigma_heading);
            let mut model = LocalModel::new(Settings::default(), estimate);
            model.recall((0..).zip(known), stays);
            let (settings, segments) = (&model.settings, &model.segments);
            let mut past = Past::new(estimate.pose, Pose::default());
            let beam = |reading: &Reading| Beam::new(reading, &mut past, settings);
            let beams: Vec<Beam> = scan(&walls, &noise_m).iter().map(beam).collect();
            // the pose is corrected after the walls were gathered
            let at = estimate.pose.at + Point::new(moved_m, moved_m / 2.0);
            let nearby = || Nearby::new(0..segments.len(), segments, at);
            let (near, all) = (nearby(), nearby().without_bounds());
            for seen in sensor_model::build(&sensor_model::groups(&beams, settings), &beams, settings) {
                for least_overlap in [0.0, settings.match_overlap] {
                    let [found, expected] = [&near, &all]
                        .map(|near| matches(&seen, least_overlap, near, segments, &estimate, settings));
                    prop_assert_eq!(format!("{found:?}"), format!("{expected:?}"));
                }
            }
        }
    }
}
