//! How far ways keep from walls.

use crate::geometry::{Point, Segment};

/// The least distance of a way from any barrier, metres.
pub fn wall_distance(way: &[Point], barriers: &[[Point; 2]]) -> f64 {
    let mut least = f64::INFINITY;
    for barrier in barriers.iter().copied().map(Segment::from) {
        for leg in way.windows(2).map(|leg| Segment::new(leg[0], leg[1])) {
            let (dx, dy) = leg.bounds().axis_gaps(&barrier.bounds());
            if dx.max(dy) < least {
                least = least.min(leg.gap(&barrier));
            }
        }
    }
    least
}
