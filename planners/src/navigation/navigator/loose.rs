//! Echoes of which no surface was made: they are too few, or what they hit is too short. Something stands there all the same.

use super::Navigator;
use crate::body::Reading;
use crate::geometry::{Point, Segment};
use crate::pose::Past;

/// So near to a surface of the model an echo is one of that, metres, and standard deviations of its range.
const OF_SURFACE_M: f64 = 0.03;
const OF_SURFACE_SIGMAS: f64 = 3.0;

/// Echoes side by side that are no farther apart come from one thing, metres.
const SAME_THING_M: f64 = 0.2;

/// Echoes from farther away wait until the robot is nearer, metres.
const NEAR_M: f64 = 2.5;

impl Navigator<'_> {
    /// Takes note of the echoes of the last turn that no surface explains.
    pub(super) fn keep_loose(&mut self, part: &[Reading]) {
        let at = self.pose().at;
        let reach = NEAR_M + SAME_THING_M;
        let known = self.barriers.iter().chain(&self.moving).copied();
        let mut near: Vec<Segment> = Vec::with_capacity(self.barriers.len());
        near.extend(known.filter(|line| line.is_within(at, reach)));
        let mut past = Past::new(self.pose(), self.odometry());
        let sigma_m = self.model.estimate().sigma_m();
        let mut on = 0;
        let echo = |reading| self.loose_echo(reading, &mut past, sigma_m, (&near, &mut on));
        let echoes: Vec<Option<Point>> = part.iter().map(echo).collect();
        let is_apart = |a: &Option<Point>, b: &Option<Point>| match (a, b) {
            (Some(a), Some(b)) => a.distance(*b) > SAME_THING_M,
            _ => true,
        };
        for group in echoes.chunk_by(|a, b| !is_apart(a, b)) {
            if group.len() >= self.settings.echoes
                && let (Some(first), Some(last)) = (group[0], group[group.len() - 1])
            {
                let surface = Segment::new(first, last);
                self.loose.push((0, surface));
                self.barriers.push(surface);
            }
        }
    }

    /// Forgets those that were heard a whole turn ago: what is there is heard again.
    pub(super) fn forget_loose(&mut self, readings: usize) {
        let turn = self.scan_readings();
        for (since, _) in &mut self.loose {
            *since += readings;
        }
        self.loose.retain(|(since, _)| *since < turn);
    }

    /// Where an echo comes from that is near, and of no surface; `sigma_m` is how unsure the robot is of its place. Surfaces are
    /// looked at from the one `on` which the echo before lies, since most lie on the same.
    fn loose_echo(
        &self,
        reading: &Reading,
        past: &mut Past,
        sigma_m: f64,
        (near, on): (&[Segment], &mut usize),
    ) -> Option<Point> {
        let range_m = reading.range_m.filter(|range| *range <= NEAR_M)?;
        let of = self.model.settings();
        let [_, from] = past.at(&reading.odometry);
        let at = from.at + from.direction(reading.bearing) * range_m;
        let sigma_m = (of.range_noise * range_m).hypot(of.range_noise_m).hypot(sigma_m);
        let reach = OF_SURFACE_M + OF_SURFACE_SIGMAS * sigma_m;
        let mut order = (*on..near.len()).chain(0..*on);
        let found = order.find(|&index| near[index].is_within(at, reach));
        *on = found.unwrap_or(*on);
        found.is_none().then_some(at)
    }
}
