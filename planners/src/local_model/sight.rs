//! Which beams cross which segments: what should have been seen, and what is seen to be gone.

use super::beam::Beam;
use super::matching::Near;
use super::{ModelSegment, Settings};
use crate::geometry::Point;
use crate::geometry::tolerance::{ROUNDING, ROUNDING_M};

/// A beam across a segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// The beam, by its place in the scan.
    pub beam: usize,
    /// Metres along the beam.
    pub range_m: f64,
    /// Metres along the segment from its end `a`.
    pub place_m: f64,
    /// Sine of the angle between both.
    pub sine: f64,
    /// Whether the echo may come from the segment, where that was asked.
    pub is_end: bool,
}

impl Crossing {
    /// Whether the echo may come from the segment, the place of which has a variance (square metres) seen from the robot.
    pub fn agrees(&self, beam: &Beam, variance: f64, settings: &Settings) -> bool {
        // without square roots: this is asked of every crossing
        let allowed = beam.sigma_m * beam.sigma_m + variance / (self.sine * self.sine).max(0.01);
        let off = |range: f64| (range - self.range_m) * (range - self.range_m);
        beam.range_m
            .is_some_and(|range| off(range) <= settings.match_sigmas * settings.match_sigmas * allowed)
    }
}

/// Parts of a turn, about as many as a scan has beams.
const PARTS: usize = 128;

/// In which of them a direction lies; the last is for what comes after the turn.
fn part(direction: f64) -> usize {
    ((direction * (PARTS as f64 / 4.0)) as usize).min(PARTS)
}

/// Beams sorted by direction, so that the few that can meet a segment are found at once.
pub(super) struct Fan {
    /// Direction, as a number that grows with the angle from 0 to 4, and the beam.
    order: Vec<(f64, usize)>,
    /// For equal parts of the turn the place in that order of the first beam in it or after it.
    begins: Vec<usize>,
    centre: Point,
    /// How far that is at most from where the robot was thought to be when segments near it were gathered.
    off_m: f64,
    /// How far from the centre the beams begin, at most.
    spread_m: f64,
}

impl Fan {
    /// Of a robot that was thought to be at a point when segments near it were gathered.
    pub fn new(beams: &[Beam], at: Point) -> Self {
        let count = beams.len().max(1) as f64;
        let (x, y) = beams.iter().fold((0.0, 0.0), |(x, y), beam| (x + beam.from.x, y + beam.from.y));
        let centre = Point::new(x / count, y / count);
        let off_m = centre.distance(at) * (1.0 + ROUNDING) + ROUNDING_M;
        let spread_m = beams.iter().map(|beam| beam.from.distance(centre)).fold(0.0, f64::max);
        let direction = |(i, beam): (usize, &Beam)| (beam.towards.diamond_angle(), i);
        let mut order: Vec<(f64, usize)> = beams.iter().enumerate().map(direction).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut begins = Vec::with_capacity(PARTS + 1);
        for (place, (at, _)) in order.iter().enumerate() {
            begins.resize(begins.len().max(part(*at) + 1), place);
        }
        begins.resize(PARTS + 1, order.len());
        Self { order, begins, centre, off_m, spread_m }
    }

    /// Beams from a direction on, in order.
    fn beams_from(&self, direction: f64) -> impl Iterator<Item = &(f64, usize)> {
        self.order[self.begins[part(direction)]..].iter().skip_while(move |(at, _)| *at < direction)
    }

    /// All beams across a segment that lies `near` the centre of the fan; beams reach as far as the sonar hears.
    pub fn crossings(
        &self,
        segment: &ModelSegment,
        near: &Near,
        beams: &[Beam],
        settings: &Settings,
        found: &mut Vec<Crossing>,
    ) {
        found.clear();
        let (a, b, c) = (segment.line.a, segment.line.b, self.centre);
        let (nearest, length) = (near.nearest_m - self.off_m, near.length_m);
        if nearest > settings.sonar_range_m + self.spread_m + ROUNDING_M {
            return;
        }
        let mut test = |&(_, i): &(f64, usize)| {
            let beam = &beams[i];
            if let Some((range_m, share)) = segment.line.hit(beam.from, beam.towards)
                && range_m <= settings.sonar_range_m
            {
                let cross = beam.towards.cross(b - a);
                found.push(Crossing {
                    beam: i,
                    range_m,
                    place_m: share * length,
                    sine: (cross / length).abs(),
                    is_end: false,
                });
            }
        };
        if nearest <= 2.0 * self.spread_m || nearest <= 0.0 {
            self.order.iter().for_each(&mut test);
            return;
        }
        // rounded: which end comes first does not matter of a segment that is seen end on
        let is_left = (a - c).cross(b - c) >= 0.0;
        let (first, last) = if is_left { (a, b) } else { (b, a) };
        // an angle whose sine is at most a half is at most 1.05 times as large as the sine
        let widened = 1.05 * self.spread_m / nearest + ROUNDING;
        let from = (first - c).diamond_angle() - widened;
        let mut to = (last - c).diamond_angle() + widened;
        if to < from {
            to += 4.0;
        }
        // the fan covers one turn, 0 to 4: mostly a segment lies in one of these only
        for around in [-4.0, 0.0, 4.0].into_iter().filter(|around| from + around <= 4.0 && to + around >= 0.0)
        {
            let covered = self.beams_from(from + around).take_while(|(at, _)| *at <= to + around);
            covered.for_each(&mut test);
        }
    }
}

/// What the beams across a segment say of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Evidence {
    pub on: u32,
    pub through: u32,
    /// Pieces of the segment seen free, metres from its end `a`.
    pub free: Vec<(f64, f64)>,
}

impl Evidence {
    /// Judges crossings: a beam ends on the segment, before it (which says nothing), or ran through it.
    /// `least_sine` is the sine of the grazing angle.
    pub fn new(
        crossings: &mut [Crossing],
        beams: &[Beam],
        length_m: f64,
        least_sine: f64,
        settings: &Settings,
    ) -> Self {
        crossings.sort_unstable_by(|a, b| a.place_m.total_cmp(&b.place_m).then(a.beam.cmp(&b.beam)));
        let mut evidence = Self::default();
        // a run of beams side by side through it: where the first one crosses, how many there are, and the place before
        let (mut run, mut before_m) = (None::<(f64, u32)>, 0.0);
        for crossing in crossings.iter().filter(|crossing| crossing.sine >= least_sine) {
            let beam = &beams[crossing.beam];
            let beyond = beam.range_m.unwrap_or(f64::INFINITY) - crossing.range_m;
            let agrees = crossing.is_end;
            if !agrees && beyond > 0.0 {
                evidence.through += 1;
                // what is free begins half way from the beam before
                let (from, count) = run.unwrap_or((f64::midpoint(before_m, crossing.place_m), 0));
                let from = if before_m > 0.0 || count > 0 { from } else { 0.0 };
                run = Some((from, count + 1));
            } else {
                evidence.on += u32::from(agrees);
                evidence.close(run.take(), f64::midpoint(before_m, crossing.place_m), settings);
            }
            before_m = crossing.place_m;
        }
        evidence.close(run, length_m, settings);
        evidence
    }

    fn close(&mut self, run: Option<(f64, u32)>, to: f64, settings: &Settings) {
        if let Some((from, count)) = run
            && count >= settings.free_beams
        {
            self.free.push((from, to));
        }
    }

    pub fn free_m(&self) -> f64 {
        self.free.iter().map(|(from, to)| to - from).sum()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::matching::Nearby;
    use super::super::{Estimate, LocalModel, Transition};
    use super::*;
    use crate::geometry::Segment;
    use crate::pose::Pose;

    proptest! {
        #[test]
        fn no_beam_across_a_segment_is_forgotten(
            (x0, y0, x1, y1) in (-3.0..3.0, -3.0..3.0, -3.0..3.0, -3.0..3.0),
            beams in prop::collection::vec((-0.2..0.2, -0.2..0.2, 0.0..6.3), 0..150),
            whole in any::<bool>(),
        ) {
            let at = |x: f64, y: f64| if whole { Point::new(x.round(), y.round()) } else { Point::new(x, y) };
            let line = Segment::new(at(x0, y0), at(x1, y1));
            let mut model = LocalModel::new(Settings::default(), Estimate::new(Pose::default(), 0.0, 0.0));
            model.recall([(0, line)], |facts| Transition {
                confidence: 5,
                source: facts.source,
                is_kept: true,
                counts_for_pose: true,
                is_anchored: true,
                is_cut: false,
            });
            let beam = |(x, y, angle): (f64, f64, f64)| {
                // along an axis, too
                let towards = if whole { at(angle.cos(), angle.sin()) } else { Point::towards(angle) };
                Beam { from: at(x, y), towards, range_m: Some(2.0), sigma_m: 0.01, since_m: 0.0 }
            };
            let is_direction = |beam: &Beam| (beam.towards.length() - 1.0).abs() < ROUNDING;
            let beams: Vec<Beam> = beams.into_iter().map(beam).filter(is_direction).collect();
            let (fan, settings) = (Fan::new(&beams, Point::default()), Settings::default());
            let near = Nearby::new(0..model.segments().len(), model.segments(), Point::default());
            let all = Fan { spread_m: f64::INFINITY, order: fan.order.clone(), begins: fan.begins.clone(), ..fan };
            for (segment, near) in model.segments().iter().zip(&near.walls) {
                let [found, expected] = [&fan, &all].map(|fan| {
                    let mut crossings = Vec::new();
                    fan.crossings(segment, near, &beams, &settings, &mut crossings);
                    crossings.sort_by_key(|crossing| crossing.beam);
                    format!("{crossings:?}")
                });
                prop_assert_eq!(found, expected);
            }
        }
    }
}
