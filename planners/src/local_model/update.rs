//! One scan taken into the model.

mod integrating;
mod looking;
mod settling;

use super::beam::{Beam, Shift};
use super::fit::Echo;
use super::objects::Cluster;
use super::reinforce::across;
use super::sensor_model::{self, Seen};
use super::sequences;
use super::{LocalModel, ObjectId, SegmentFacts, SegmentId, Source, Transition};
use crate::body::Reading;
use crate::pose::{Past, Pose};
use looking::{Explained, Look};

/// What one scan changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Update {
    /// The error of the pose that was found, as a step from the old pose to the new one.
    pub correction: Pose,
    /// By how many observations: segments give two each, predicted readings one.
    pub observations: usize,
    pub seen: usize,
    /// How many of them lie on the model.
    pub matched: usize,
    pub entered: Vec<SegmentId>,
    pub removed: Vec<SegmentId>,
}

impl LocalModel {
    /// Takes a scan into the model: readings that follow one another, of a whole turn of the sonar or of a part, up to the
    /// pose that was last reckoned.
    ///
    /// # Arguments
    /// `decide` is the state table: it is asked about each segment of which the scan shows something, new ones included
    /// (their confidence is 0 then), and about the others in turn, once in [`Settings::hidden_scans`] scans.
    ///
    /// # Complexity
    /// For b readings, s segments of which n within hearing and m that the scan shows:
    /// O(s + n log b + m n + crossings); `decide` is called for those that beams meet, and for s / `hidden_scans` others.
    pub fn update(
        &mut self,
        scan: &[Reading],
        time_s: f64,
        mut decide: impl FnMut(&SegmentFacts) -> Transition,
    ) -> Update {
        let before = self.estimate;
        let mut past = Past::new(before.pose, self.odometry);
        let beams: Vec<Beam> =
            scan.iter().map(|reading| Beam::new(reading, &mut past, &self.settings)).collect();
        let groups = sensor_model::groups(&beams, &self.settings);
        let seen = sensor_model::build(&groups, &beams, &self.settings);
        let near = self.near();
        let shift = |beams: &[Beam], to: &Pose| -> Vec<Beam> {
            let shift = Shift::new(&before.pose, to);
            beams.iter().map(|beam| beam.moved(&shift)).collect()
        };
        let mut observations = self.correct_by_matches(&seen, &near);
        let step_m = before.pose.at.distance(self.estimate.pose.at);
        if step_m > self.settings.certain_step_m {
            let after = shift(&beams, &self.estimate.pose);
            if self.explained(&after, &near) < self.explained(&beams, &near) {
                (self.estimate, observations) = (before, 0);
            }
        }
        let placed = shift(&beams, &self.estimate.pose);
        let (mut looks, firsts, mut explained) = self.look(&placed, &near);
        observations += self.correct_by_readings(&placed, &firsts, &seen, &explained);
        let moved = Shift::new(&before.pose, &self.estimate.pose);
        let seen: Vec<Seen> = seen.iter().map(|one| one.moved(&moved)).collect();
        let placed = shift(&beams, &self.estimate.pose);

        let mut update = Update {
            correction: before.pose.to(&self.estimate.pose),
            observations,
            seen: seen.len(),
            ..Update::default()
        };
        let (new, changed) = self.integrate(&seen, &near, &mut looks, &mut explained, &mut update);
        let groups: Vec<Vec<Echo>> = groups.iter().map(|group| moved_echoes(group, &placed)).collect();
        let objects = self.follow(&groups, &placed, &explained, &looks, time_s);
        let changed: Vec<SegmentId> = changed.into_iter().map(|place| self.segments[place].id).collect();
        let absorbed = self.merge(&changed, &near, &mut looks);
        update.removed.extend(&absorbed);
        for one in new {
            let object = objects.iter().find(|(beams, _)| one.echoes.iter().any(|e| beams.contains(&e.beam)));
            let id = self.enter(&one, object.map(|(_, id)| *id));
            update.entered.push(id);
            looks.push(Look { is_matched: true, ..Look::default() });
        }
        self.settle(&looks, &mut decide, &mut update);
        let touched: Vec<SegmentId> = changed.iter().chain(&update.entered).copied().collect();
        self.connect(&touched, &update.removed);
        update
    }

    fn follow(
        &mut self,
        groups: &[Vec<Echo>],
        beams: &[Beam],
        explained: &[Explained],
        looks: &[Look],
        time_s: f64,
    ) -> Vec<(Vec<usize>, ObjectId)> {
        let is_explained: Vec<bool> = explained.iter().map(|explained| explained.by_any).collect();
        let clusters = Cluster::among(groups, &is_explained, &self.settings);
        let matched = self.segments.iter().zip(looks).filter(|(_, look)| look.is_matched);
        let standing: Vec<ObjectId> = matched.filter_map(|(segment, _)| segment.object).collect();
        let ids = self.objects.follow(&clusters, beams, |id| standing.contains(&id), time_s, &self.settings);
        clusters.into_iter().map(|cluster| cluster.beams).zip(ids).collect()
    }

    /// Where a segment stands; segments stand in the order of their names.
    fn place(&self, id: SegmentId) -> Result<usize, usize> {
        self.segments.binary_search_by_key(&id, |segment| segment.id)
    }

    fn enter(&mut self, one: &Seen, object: Option<ObjectId>) -> SegmentId {
        let (pose_m, pose_angle) = across(&one.fit, &self.estimate);
        self.add(
            one.line,
            (one.fit.sigma_m.powi(2) + pose_m).sqrt(),
            (one.fit.sigma_angle.powi(2) + pose_angle).sqrt(),
            Source::SONAR,
            object,
        )
    }

    /// Joins the ends of what changed.
    fn connect(&mut self, changed: &[SegmentId], gone: &[SegmentId]) {
        sequences::forget(&mut self.segments, gone);
        if changed.is_empty() {
            return;
        }
        let near: Vec<usize> = self.within_hearing().collect();
        let changed: Vec<usize> = changed.iter().filter_map(|id| self.place(*id).ok()).collect();
        sequences::join(&mut self.segments, &changed, &near, &self.settings);
    }
}

fn moved_echoes(group: &[Echo], beams: &[Beam]) -> Vec<Echo> {
    group.iter().filter_map(|echo| beams[echo.beam].echo().map(|at| Echo { at, ..*echo })).collect()
}
