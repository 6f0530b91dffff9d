//! What adds up along a mission, whoever knows where the robot is.

use crate::geometry::Point;

/// Where a robot was, and how far it went in which shape.
#[derive(Clone, Debug)]
pub struct Log {
    /// The shape in which it is, by number.
    shape: usize,
    /// Metres that it went, by shape.
    pub metres: Vec<f64>,
    /// Changes of shape, in order: from which into which.
    pub changes: Vec<(usize, usize)>,
    /// Where it was, in which shape, whenever it had gone on a little.
    pub track: Vec<(Point, usize)>,
}

/// The track has a point each so many metres.
const TRACK_M: f64 = 0.25;

impl Log {
    /// Of a robot in one of so many shapes, of which nothing was driven yet.
    pub fn begun(at: Point, shape: usize, shapes: usize) -> Self {
        Self { shape, metres: vec![0.0; shapes], changes: Vec::new(), track: vec![(at, shape)] }
    }

    /// Takes note of a step of so many metres to where the robot is now, in the shape in which it is now.
    pub fn note(&mut self, by_m: f64, at: Point, now: usize) {
        self.metres[self.shape] += by_m;
        let is_changed = now != self.shape;
        if is_changed {
            self.changes.push((self.shape, now));
            self.shape = now;
        }
        if is_changed || self.track.last().is_none_or(|(last, _)| last.distance(at) >= TRACK_M) {
            self.track.push((at, now));
        }
    }
}
