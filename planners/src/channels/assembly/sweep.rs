//! How near a box comes to walls while it moves along a line, in closed form.
//!
//! Along each axis the gap between two boxes is the largest of two linear functions of the share t of the way
//! and 0. The square of the distance is the sum of their squares: convex, with a slope that is continuous, grows
//! and is linear between the at most 2 D values of t where a gap opens or closes. So the least distance lies at
//! an end of the way or where the slope is 0, and that is found by looking at the slope once at each of them.

use super::Cuboid;

/// A box on its way along a line.
pub(super) struct Sweep<'a, const D: usize> {
    part: &'a Cuboid<D>,
    by: &'a [f64; D],
    swept: Cuboid<D>,
}

impl<'a, const D: usize> Sweep<'a, D> {
    pub(super) fn new(part: &'a Cuboid<D>, by: &'a [f64; D]) -> Self {
        Self { part, by, swept: part.joined(&part.moved(by)) }
    }

    /// The square of the least distance from any of the walls along the way.
    pub(super) fn squared_clearance(&self, walls: &[Cuboid<D>]) -> f64 {
        walls.iter().fold(f64::INFINITY, |least, wall| {
            if squared_distance(&self.swept, wall) >= least { least } else { least.min(self.nearest(wall)) }
        })
    }

    /// The share of the way at which the part first lies in a wall by more than `depth`, and which wall that is.
    pub(super) fn collision(&self, walls: &[Cuboid<D>], depth: f64) -> Option<(f64, Cuboid<D>)> {
        let hits = walls.iter().filter_map(|wall| Some((self.enters(wall, depth)?, *wall)));
        hits.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn nearest(&self, wall: &Cuboid<D>) -> f64 {
        let (mut from, mut to) = (0.0, 1.0);
        let mut falling = self.slope(wall, from);
        if falling >= 0.0 {
            return self.squared_at(wall, from);
        }
        let mut rising = self.slope(wall, to);
        if rising <= 0.0 {
            return self.squared_at(wall, to);
        }
        for axis in 0..D {
            for room in [wall.min[axis] - self.part.max[axis], wall.max[axis] - self.part.min[axis]] {
                let bend = room / self.by[axis];
                if from < bend && bend < to {
                    let slope = self.slope(wall, bend);
                    if slope < 0.0 { (from, falling) = (bend, slope) } else { (to, rising) = (bend, slope) }
                }
            }
        }
        self.squared_at(wall, from + (to - from) * falling / (falling - rising))
    }

    /// Half the slope of the squared distance at a share of the way.
    fn slope(&self, wall: &Cuboid<D>, share: f64) -> f64 {
        let along = |axis: usize| {
            let by = self.by[axis];
            let below = wall.min[axis] - self.part.max[axis] - by * share;
            let above = self.part.min[axis] + by * share - wall.max[axis];
            by * (above.max(0.0) - below.max(0.0))
        };
        (0..D).map(along).sum()
    }

    fn squared_at(&self, wall: &Cuboid<D>, share: f64) -> f64 {
        squared_distance(&self.part.moved(&self.by.map(|by| by * share)), wall)
    }

    fn enters(&self, wall: &Cuboid<D>, depth: f64) -> Option<f64> {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for axis in 0..D {
            let by = self.by[axis];
            let from = wall.min[axis] + depth - self.part.max[axis];
            let to = wall.max[axis] - depth - self.part.min[axis];
            if by == 0.0 {
                if from >= 0.0 || to <= 0.0 {
                    return None;
                }
            } else {
                enters = enters.max((from / by).min(to / by));
                leaves = leaves.min((from / by).max(to / by));
            }
        }
        (enters < leaves).then_some(enters)
    }
}

/// The square of the distance between two boxes; 0 where they touch or overlap.
pub(super) fn squared_distance<const D: usize>(a: &Cuboid<D>, b: &Cuboid<D>) -> f64 {
    let gap = |axis: usize| (b.min[axis] - a.max[axis]).max(a.min[axis] - b.max[axis]).max(0.0);
    (0..D).map(|axis| gap(axis) * gap(axis)).sum()
}
