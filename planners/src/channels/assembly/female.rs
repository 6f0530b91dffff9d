//! The channels of a female part, from its outline.

mod choice;
mod error;
mod free;

use super::Cuboid;
use super::outline::{edges, hull};
use crate::geometry::tolerance::ROUNDING;
use free::FreeSpace;

pub use error::FemaleError;

/// The chain of channels by which a part leaves the female part with this outline, corner by corner (x, z), in
/// either sense; the first channel leads out, along +z.
///
/// Channels are maximal free rectangles of the box around the female part (up to the part's upper side, where that is
/// higher), so what is beside or below it counts as wall. Of all orthogonal chains this is one with the fewest
/// junctions that are not larger than the part; of these, with the fewest channels; of these, with the
/// most room in its tightest junction. Where the cavity is bounded by a slope, the box around the slope counts as wall.
///
/// Wherever free rectangles that overlap lead from the part to the top, there is such a chain: two that overlap at
/// their corners only have a third one that spans both.
///
/// Complexity: O(k^2) for k maximal rectangles, of which a cavity with n corners has O(n^2) at worst.
pub fn channels_of(female: &[[f64; 2]], part: &Cuboid<2>) -> Result<Vec<Cuboid<2>>, FemaleError> {
    if !part.is_finite() || !part.is_solid() {
        return Err(FemaleError::PartIsNoBox { found: *part });
    }
    let edges = edges(female)?;
    let female = hull(&edges);
    let extent = female.joined(part);
    let tolerance = ROUNDING * extent.size(0).max(extent.size(1));
    if part.min[1] >= female.max[1] {
        return Err(FemaleError::AlreadyOut { part: *part, top: female.max[1] });
    }
    let mut frame = female;
    frame.max[1] = frame.max[1].max(part.max[1]);
    if frame.excess(part) > tolerance {
        return Err(FemaleError::PartOutside { part: *part, female });
    }
    let free = FreeSpace::new(frame, &edges, tolerance);
    free.check(part)?;
    choice::best_chain(&free, part).ok_or_else(|| free.no_way(part))
}
