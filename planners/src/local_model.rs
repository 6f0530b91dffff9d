//! Crowley's composite local model: the surfaces near a robot, put together from many scans, from contacts and from what is
//! recalled of a global model; and the estimated pose, corrected by how scans differ from the model.
//!
//! Readings become segments, which are matched with the model (sections 3.2, 3.3). What is seen again is reinforced and
//! extended, what is new is entered, ends that meet are joined to sequences, things that move are followed. What becomes of
//! a segment then (its confidence, whether it stays, whether the pose is corrected by it) is not decided here: the caller's
//! state table is asked about each one, with [`SegmentFacts`], and answers with a [`Transition`].
//!
//! # Example
//! ```
//! use adit_planners::body::Reading;
//! use adit_planners::local_model::{Estimate, LocalModel, SegmentFacts, Settings, Transition};
//! use adit_planners::pose::Pose;
//!
//! // a wall 2 m ahead
//! let reading = |i: i32| {
//!     let bearing = f64::from(3 * i).to_radians();
//!     Reading { bearing, range_m: Some(2.0 / bearing.cos()), odometry: Pose::default() }
//! };
//! let scan: Vec<Reading> = (-10..=10).map(reading).collect();
//! let table = |facts: &SegmentFacts| Transition {
//!     confidence: if facts.is_matched { (facts.confidence + 1).min(5) } else { facts.confidence },
//!     source: facts.source,
//!     is_kept: true,
//!     counts_for_pose: true,
//!     is_anchored: false,
//!     is_cut: false,
//! };
//! let mut model = LocalModel::new(Settings::default(), Estimate::new(Pose::default(), 0.0, 0.0));
//! model.update(&scan, 0.0, table);
//! model.update(&scan, 1.0, table);
//! let wall = &model.segments()[0];
//! assert_eq!(wall.confidence, 2);
//! assert!((wall.line.middle().x - 2.0).abs() < 1e-6);
//! ```

mod beam;
mod correction;
mod estimate;
mod facts;
mod fit;
mod matching;
mod model_segment;
mod objects;
mod reinforce;
mod relocate;
mod sensor_model;
mod sequences;
mod settings;
mod sight;
mod update;

pub use estimate::Estimate;
pub use facts::{SegmentFacts, SegmentId, Source, Transition};
pub use model_segment::ModelSegment;
pub use objects::{Object, ObjectId};
pub use relocate::{Candidate, KnownWalls, Recognition, Scan};
pub use settings::Settings;
pub use update::Update;

use std::f64::consts::FRAC_PI_2;

use crate::body::Contact;
use crate::geometry::Segment;
use crate::pose::Pose;

/// The composite local model with the estimated pose.
#[derive(Clone, Debug)]
pub struct LocalModel {
    settings: Settings,
    estimate: Estimate,
    /// The wheels' count that the estimate holds for.
    odometry: Pose,
    /// In the order of their names.
    segments: Vec<ModelSegment>,
    objects: objects::Objects,
    next: u32,
    scans: u32,
}

impl LocalModel {
    /// An empty model. The wheels' count is thought to be 0, 0, 0 where the estimate is.
    pub fn new(settings: Settings, estimate: Estimate) -> Self {
        let (segments, objects) = (Vec::new(), objects::Objects::default());
        Self { settings, estimate, odometry: Pose::default(), segments, objects, next: 0, scans: 0 }
    }

    /// The surfaces, in the order in which they were entered.
    pub fn segments(&self) -> &[ModelSegment] {
        &self.segments
    }

    /// The things that may move and were seen lately.
    pub fn objects(&self) -> &[Object] {
        &self.objects.list
    }

    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Says where the robot is, whatever was thought of it before.
    pub fn set_estimate(&mut self, estimate: Estimate) {
        self.estimate = estimate;
    }

    /// Moves the estimate by what the wheels counted since the last call.
    pub fn reckon(&mut self, odometry: &Pose) {
        let step = self.odometry.to(odometry);
        self.estimate.advance(&step, &self.settings);
        self.odometry = *odometry;
    }

    /// Enters surfaces of a global model that are near and not entered yet; each by its number there.
    /// The state table is asked about each new one.
    ///
    /// # Returns
    /// How many were entered.
    pub fn recall(
        &mut self,
        surfaces: impl IntoIterator<Item = (u32, Segment)>,
        mut decide: impl FnMut(&SegmentFacts) -> Transition,
    ) -> usize {
        let at = self.estimate.pose.at;
        let mut known: Vec<u32> = self.segments.iter().filter_map(|segment| segment.recalled).collect();
        known.sort_unstable();
        let (mut count, mut next) = (0, 0);
        for (number, line) in surfaces {
            // What is known already is told apart first: mostly it is nearly all. Where surfaces come in the order of their
            // numbers, the next one stands where the one before was found, or behind it.
            let is_there = next == 0 || known[next - 1] < number;
            if !is_there || known.get(next).is_some_and(|known| *known < number) {
                next = known.partition_point(|known| *known < number);
            }
            let is_known = known.get(next) == Some(&number);
            next += usize::from(is_known);
            if is_known || line.distance(at) > self.settings.recall_m || line.length() <= 0.0 {
                continue;
            }
            let (sigma_m, sigma_angle) = (self.settings.recalled_sigma_m, self.settings.recalled_sigma_angle);
            self.add(line, sigma_m, sigma_angle, Source::RECALLED, None);
            if self.ask_about_last(false, &mut decide) {
                if let Some(segment) = self.segments.last_mut() {
                    segment.recalled = Some(number);
                }
                self.settings.knows_walls = true;
                count += 1;
            }
        }
        count
    }

    /// Takes a touch of the skirt into the model: what is known to be there was met, and where nothing is known a short
    /// surface across the touch is entered. The state table is asked about it.
    pub fn touched(
        &mut self,
        contact: &Contact,
        radius_m: f64,
        mut decide: impl FnMut(&SegmentFacts) -> Transition,
    ) -> SegmentId {
        let pose = &self.estimate.pose;
        let towards = pose.direction(contact.bearing);
        let at = pose.at + towards * radius_m;
        let far = |segment: &ModelSegment| segment.line.distance(at);
        let nearest = self.segments.iter().enumerate().min_by(|(_, a), (_, b)| far(a).total_cmp(&far(b)));
        let reach = self.settings.match_sigmas * self.estimate.sigma_m() + self.settings.join_m / 2.0;
        if let Some((place, known)) = nearest.filter(|(_, segment)| far(segment) <= reach) {
            let id = known.id;
            let facts = SegmentFacts {
                is_matched: true,
                is_visible: true,
                ..known.facts(self.estimate.pose.at, self.settings.is_learning)
            };
            let transition = decide(&facts);
            self.segments[place].follow(transition);
            if !transition.is_kept {
                self.segments.remove(place);
                sequences::forget(&mut self.segments, &[id]);
            }
            return id;
        }
        let (sigma_m, sigma_angle) = (self.estimate.sigma_m(), FRAC_PI_2 / 3.0);
        let id = self.add(self.surface_at(contact, radius_m), sigma_m, sigma_angle, Source::CONTACT, None);
        self.ask_about_last(true, &mut decide);
        id
    }

    /// A short surface across a touch.
    pub fn surface_at(&self, contact: &Contact, radius_m: f64) -> Segment {
        let pose = &self.estimate.pose;
        let at = pose.at + pose.direction(contact.bearing) * radius_m;
        let aside = pose.direction(contact.bearing + FRAC_PI_2) * (self.settings.contact_length_m / 2.0);
        Segment::new(at - aside, at + aside)
    }

    /// Asks about the segment that was entered last; it goes again if the table says so.
    fn ask_about_last(
        &mut self,
        is_matched: bool,
        decide: &mut impl FnMut(&SegmentFacts) -> Transition,
    ) -> bool {
        let (at, is_learning) = (self.estimate.pose.at, self.settings.is_learning);
        let Some(segment) = self.segments.last_mut() else { return false };
        let transition = decide(&SegmentFacts { is_matched, ..segment.facts(at, is_learning) });
        segment.follow(transition);
        if !transition.is_kept {
            self.segments.pop();
        }
        transition.is_kept
    }

    fn add(
        &mut self,
        line: Segment,
        sigma_m: f64,
        sigma_angle: f64,
        source: Source,
        object: Option<ObjectId>,
    ) -> SegmentId {
        let id = self.next_id();
        self.segments.push(ModelSegment {
            id,
            line,
            sigma_m,
            sigma_angle,
            source,
            confidence: 0,
            counts_for_pose: false,
            is_anchored: false,
            age: 0,
            unseen: 0,
            object,
            joins: [None; 2],
            recalled: None,
        });
        id
    }

    fn next_id(&mut self) -> SegmentId {
        let id = SegmentId(self.next);
        self.next += 1;
        id
    }
}
