//! The channels of a female part, from its outline.

mod choice;
mod free;

use super::Cuboid;
use super::outline::{Edge, OutlineError, edges, hull};
use crate::geometry::tolerance::ROUNDING;
use free::FreeSpace;

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

/// Why a female part has no chain of channels for this part.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FemaleError {
    #[error(transparent)]
    Outline(#[from] OutlineError),
    #[error("the part is {found}; expected finite numbers, each minimum below its maximum")]
    PartIsNoBox { found: Cuboid<2> },
    #[error("the part {part} and the female part overlap: {wall} is solid")]
    PartInWall {
        part: Cuboid<2>,
        /// What of the female part it meets.
        wall: Cuboid<2>,
    },
    #[error("the part {part} sticks out of the box {female} around the female part, to a side or below")]
    PartOutside { part: Cuboid<2>, female: Cuboid<2> },
    #[error("the part {part} is above the female part, which ends at z = {top}: it is disassembled")]
    AlreadyOut {
        part: Cuboid<2>,
        top: f64,
    },
    #[error(
        "the free space cannot be modelled by channels, which are rectangles along the axes: the edge {edge} is \
         sloped, and what lies in the box around it is taken for wall; without it the part {part} {}",
        place(*height)
    )]
    Sloped {
        edge: Edge,
        part: Cuboid<2>,
        /// How far up the free space around the part reaches; `None` where the part itself is in that box.
        height: Option<f64>,
    },
    #[error(
        "the free space around the part {part} is closed: it reaches up to z = {height}, the female part to {top}, \
         and a way out leads along +z"
    )]
    Closed {
        part: Cuboid<2>,
        height: f64,
        top: f64,
    },
}

fn place(height: Option<f64>) -> String {
    height.map_or_else(|| "has no place".to_owned(), |height| format!("gets up to z = {height} only"))
}
