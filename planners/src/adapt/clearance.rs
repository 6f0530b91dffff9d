//! What evaluations taught about an object: room that it leaves free, and places that it takes.
//!
//! All of it lies in the frame of the object, so it holds wherever the object is moved or turned, until its shape changes.

mod rooms;
mod taken;

pub(super) use rooms::Room;
use rooms::Rooms;
use taken::Taken;

use super::robot::Link;
use super::shape::Distance;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment};

/// One thing learned, in the frame of the object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clearance {
    /// Everything nearer to this segment than so many metres is free of the object.
    Free {
        /// Where the axis of a link lay.
        axis: Segment,
        within_m: f64,
    },
    /// Everything nearer to this point than so many metres belongs to the object; 0 for a point of its outline.
    Taken { at: Point, within_m: f64 },
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Known {
    free: Rooms,
    taken: Taken,
}

/// Places that are taken are kept no closer than this: what lies between them is met on the way from one to the next.
const SPACING_M: f64 = 0.03;

/// Room is not kept again where no more of what it leaves about the link is new than this share.
const WORTHWHILE: f64 = 0.1;

/// A disc as wide is as good as all that lies on one side of a line: over 10 m it bends away by 5 µm.
const FAR_M: f64 = 1e7;

impl Known {
    /// By how many metres the known free room exceeds a link there, or that it does by `enough`; negative or `-INFINITY`
    /// where it is not known to be free.
    pub fn slack(&self, link: &Link, enough: f64) -> f64 {
        self.room(link, enough).map_or(f64::NEG_INFINITY, |(slack, _)| slack)
    }

    /// The room that exceeds a link by most metres, or any that exceeds it by `enough`, and by how many, which may be less than
    /// none; `None` where none holds even its axis.
    pub fn room(&self, link: &Link, enough: f64) -> Option<(f64, &Room)> {
        self.free.widest(link, enough)
    }

    /// A disc about all places that are known to be taken: its middle, and how far it comes.
    pub fn about_taken(&self) -> Option<(Point, f64)> {
        self.taken.about()
    }

    /// Metres from a link to the nearest place that is known to be taken, if that is nearer than so many metres; negative
    /// where they overlap. What only touches does not: room that is known to be free goes up to there, and what was free
    /// must not be refused later.
    pub fn nearer(&self, link: &Link, than_m: f64) -> Option<f64> {
        let thick = link.radius - ROUNDING_M;
        self.taken.nearer(&link.axis, than_m + thick).map(|metres| metres - thick)
    }

    /// Keeps what an evaluation found, where it says more than what is known; gives what was kept.
    pub fn learn(&mut self, link: &Link, distance: &Distance) -> impl Iterator<Item = Clearance> + use<> {
        let within_m = distance.metres;
        let spare_m = if within_m > link.radius { within_m - link.radius } else { within_m };
        let known = Link { axis: link.axis, radius: within_m - WORTHWHILE * spare_m };
        let is_free = within_m > 0.0 && self.slack(&known, 0.0) < 0.0;
        let depth_m = (-within_m).max(0.0);
        let is_taken = within_m.is_finite() && !self.taken.is_near(distance.witness, depth_m, SPACING_M);
        let room = || match distance.ahead {
            // All that is ahead of the object is free: nearly so much lies in a disc that is as wide.
            Some(ahead) => {
                let within_m = FAR_M - ROUNDING_M;
                let middle = distance.witness + ahead * FAR_M;
                Clearance::Free { axis: Segment::new(middle, middle), within_m }
            }
            None => Clearance::Free { axis: link.axis, within_m },
        };
        let kept = [
            is_free.then(room),
            is_taken.then_some(Clearance::Taken { at: distance.witness, within_m: depth_m }),
        ];
        for clearance in kept.iter().flatten() {
            self.put(clearance);
        }
        kept.into_iter().flatten()
    }

    pub fn put(&mut self, clearance: &Clearance) {
        match *clearance {
            Clearance::Free { axis, within_m } => self.free.put(axis, within_m),
            Clearance::Taken { at, within_m } => self.taken.put(at, within_m),
        }
    }

    pub fn clearances(&self) -> impl Iterator<Item = Clearance> + '_ {
        let free = self.free.all().map(|(axis, within_m)| Clearance::Free { axis, within_m });
        free.chain(self.taken.all().map(|(at, within_m)| Clearance::Taken { at, within_m }))
    }
}
