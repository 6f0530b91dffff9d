//! What a scan says of the segments of the model, and of the pose.

use super::super::beam::Beam;
use super::super::correction::Correction;
use super::super::matching::{Match, Nearby, matches};
use super::super::sensor_model::Seen;
use super::super::sight::{Crossing, Evidence, Fan};
use super::super::{LocalModel, ModelSegment};

/// What a scan says of a segment.
#[derive(Clone, Debug, Default)]
pub(super) struct Look {
    pub is_matched: bool,
    pub evidence: Evidence,
}

/// Whether an echo may come from where a segment of the model is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Explained {
    pub by_any: bool,
    /// From one that scans leave where it is.
    pub by_known: bool,
}

/// The first segment that a beam meets.
pub(super) type First = Option<(usize, Crossing)>;

impl LocalModel {
    /// The places of segments within hearing.
    pub(super) fn within_hearing(&self) -> impl Iterator<Item = usize> {
        let unsure_m = self.settings.match_sigmas * self.estimate.sigma_m();
        let reach = self.settings.sonar_range_m + self.settings.match_offset_m.max(unsure_m);
        let at = self.estimate.pose.at;
        let is_near = move |segment: &ModelSegment| segment.line.bounds().grown(reach).contains(at);
        self.segments.iter().enumerate().filter(move |(_, segment)| is_near(segment)).map(|(place, _)| place)
    }

    pub(super) fn near(&self) -> Nearby {
        Nearby::new(self.within_hearing(), &self.segments, self.estimate.pose.at)
    }

    /// The segments on which one of a scan may lie, of the shorter of which such a share lies beside the other.
    pub(super) fn matches(&self, seen: &Seen, least_overlap: f64, near: &Nearby) -> Vec<Match> {
        matches(seen, least_overlap, near, &self.segments, &self.estimate, &self.settings)
    }

    /// The mean error of matched segments, in orientation and position.
    pub(super) fn correct_by_matches(&mut self, seen: &[Seen], near: &Nearby) -> usize {
        let mut correction = Correction::new();
        for one in seen {
            let firm = |on: &Match| self.segments[on.model].counts_for_pose;
            if let Some(on) = self.matches(one, self.settings.match_overlap, near).into_iter().find(firm) {
                correction.by_match(one, &on, &self.segments[on.model], &self.estimate, &self.settings);
            }
        }
        self.estimate = correction.apply(&self.estimate, &self.settings);
        correction.count
    }

    /// How many beams end where the nearest of the segments is that scans leave where they are.
    pub(super) fn explained(&self, beams: &[Beam], near: &Nearby) -> usize {
        let fan = Fan::new(beams, near.at);
        let (mut firsts, mut crossings) = (vec![None::<Crossing>; beams.len()], Vec::new());
        for wall in near.walls.iter().filter(|wall| self.segments[wall.model].is_anchored) {
            fan.crossings(&self.segments[wall.model], wall, beams, &self.settings, &mut crossings);
            for crossing in &crossings {
                let first = &mut firsts[crossing.beam];
                if first.is_none_or(|other| crossing.range_m < other.range_m) {
                    *first = Some(*crossing);
                }
            }
        }
        let variance = self.settings.recalled_sigma_m.powi(2);
        let agrees = |first: &Crossing| first.agrees(&beams[first.beam], variance, &self.settings);
        firsts.iter().flatten().filter(|first| agrees(first)).count()
    }

    /// What beams say of the segments within hearing, what each beam meets first, and how far the model explains it.
    pub(super) fn look(&self, beams: &[Beam], near: &Nearby) -> (Vec<Look>, Vec<First>, Vec<Explained>) {
        let fan = Fan::new(beams, near.at);
        let mut looks = vec![Look::default(); self.segments.len()];
        let mut firsts: Vec<First> = vec![None; beams.len()];
        let mut explained = vec![Explained::default(); beams.len()];
        let mut crossings = Vec::new();
        let (at, least_sine) = (self.estimate.pose.at, self.settings.grazing_angle.sin());
        let variances = self.estimate.variances();
        for wall in &near.walls {
            let segment = &self.segments[wall.model];
            fan.crossings(segment, wall, beams, &self.settings, &mut crossings);
            if crossings.is_empty() {
                continue;
            }
            let [place, heading] = variances[usize::from(segment.is_anchored)];
            let [sigma_m, _] = segment.relative_sigmas(&self.settings);
            let variance = place + sigma_m.powi(2) + heading * segment.line.squared_distance(at);
            let mut is_told = false;
            for crossing in &mut crossings {
                let first = &mut firsts[crossing.beam];
                if first.is_none_or(|(_, other)| crossing.range_m < other.range_m) {
                    *first = Some((wall.model, *crossing));
                }
                let beam = &beams[crossing.beam];
                let agrees = crossing.agrees(beam, variance, &self.settings);
                crossing.is_end = agrees;
                let Explained { by_any, by_known } = &mut explained[crossing.beam];
                *by_any |= agrees;
                *by_known |= agrees && segment.is_anchored;
                is_told |= agrees || beam.range_m.is_none_or(|range| range > crossing.range_m);
            }
            // beams that all end before it say nothing
            if is_told {
                looks[wall.model].evidence =
                    Evidence::new(&mut crossings, beams, wall.length_m, least_sine, &self.settings);
            }
        }
        (looks, firsts, explained)
    }

    /// Readings in critical directions: there the model predicts them, and no matched segment has used them.
    pub(super) fn correct_by_readings(
        &mut self,
        beams: &[Beam],
        firsts: &[First],
        seen: &[Seen],
        explained: &[Explained],
    ) -> usize {
        let mut is_used = vec![false; beams.len()];
        for echo in seen.iter().flat_map(|one| &one.echoes) {
            is_used[echo.beam] = true;
        }
        let mut correction = Correction::new();
        let is_vague = self.estimate.is_vague(&self.settings);
        let (sine, margin) = (self.settings.critical_angle.sin(), self.settings.critical_margin_m);
        for (i, first) in firsts.iter().enumerate() {
            let Some((model, crossing)) = first else { continue };
            let segment = &self.segments[*model];
            let is_inside = crossing.place_m >= margin && crossing.place_m <= segment.line.length() - margin;
            let is_critical = crossing.sine >= sine && is_inside && segment.counts_for_pose;
            let is_told = !(is_vague && segment.is_anchored);
            if !is_used[i] && explained[i].by_any && is_critical && is_told {
                correction.by_reading(&beams[i], crossing, segment, &self.estimate, &self.settings);
            }
        }
        self.estimate = correction.apply(&self.estimate, &self.settings);
        correction.count
    }
}
