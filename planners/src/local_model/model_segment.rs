//! A segment of the model with what is kept of it.

use super::Settings;
use super::facts::{SegmentFacts, SegmentId, Source, Transition};
use super::objects::ObjectId;
use crate::geometry::{Point, Segment};

/// A surface that the model believes in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelSegment {
    pub id: SegmentId,
    /// Where it is, in the frame of the estimated pose.
    pub line: Segment,
    /// Standard deviation across it at its middle, metres.
    pub sigma_m: f64,
    /// Standard deviation of its angle, radians.
    pub sigma_angle: f64,
    pub source: Source,
    /// 1 to 5, as the state table gave it.
    pub confidence: u8,
    pub counts_for_pose: bool,
    /// Whether scans leave it where it is.
    pub is_anchored: bool,
    /// Scans since it was entered.
    pub age: u32,
    /// Scans since it was last matched, or since it was entered.
    pub unseen: u32,
    /// The moving object of which it is a part.
    pub object: Option<ObjectId>,
    /// The segments that its ends `a` and `b` join: with them it is a connected sequence.
    pub joins: [Option<SegmentId>; 2],
    /// Its number in the global model that it was recalled from.
    pub recalled: Option<u32>,
}

impl ModelSegment {
    /// What is known of it without a scan, for a robot at a place.
    pub(super) fn facts(&self, robot: Point, is_learning: bool) -> SegmentFacts {
        SegmentFacts {
            id: self.id,
            source: self.source,
            confidence: self.confidence,
            is_matched: false,
            is_visible: false,
            is_seen_free: false,
            is_moving: false,
            beams_on: 0,
            beams_through: 0,
            free_m: 0.0,
            age: self.age,
            unseen: self.unseen,
            distance_m: self.line.distance(robot),
            length_m: self.line.length(),
            is_learning,
            sigma_m: self.sigma_m,
        }
    }

    /// Whether it is the robot's own find and no more: while a building is learned, such surfaces are what it will be made of, and
    /// where no wall is known there is nothing else to go by.
    pub(super) fn is_own(&self, settings: &Settings) -> bool {
        !self.is_anchored && !settings.is_learning && settings.knows_walls
    }

    /// Standard deviations across it and of its angle as seen from a robot that was there when it was found: what the pose was
    /// unsure by then is in both.
    pub(super) fn relative_sigmas(&self, settings: &Settings) -> [f64; 2] {
        if !self.is_own(settings) {
            return [self.sigma_m, self.sigma_angle];
        }
        [self.sigma_m.min(settings.own_sigma_m), self.sigma_angle.min(settings.own_sigma_angle)]
    }

    /// Becomes what the state table says.
    pub(super) fn follow(&mut self, transition: Transition) {
        self.source = transition.source;
        self.confidence = transition.confidence;
        self.counts_for_pose = transition.counts_for_pose;
        self.is_anchored = transition.is_anchored;
    }

    /// What is left of it without pieces (metres from its end `a`, in order), and is not too short.
    pub(super) fn without(&self, free: &[(f64, f64)], shortest_m: f64) -> Vec<Segment> {
        let (along, length) = (self.line.direction(), self.line.length());
        let at = |place: f64| self.line.a + along * place;
        let begins = std::iter::once(0.0).chain(free.iter().map(|(_, to)| *to));
        let ends = free.iter().map(|(from, _)| *from).chain([length]);
        let left = begins.zip(ends).filter(|(from, to)| to - from >= shortest_m);
        left.map(|(from, to)| Segment::new(at(from), at(to))).collect()
    }
}
