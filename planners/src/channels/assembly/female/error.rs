//! Why no channels lead out of a female part.

use crate::channels::assembly::Cuboid;
use crate::channels::assembly::outline::{Edge, OutlineError};

/// Why a female part has no chain of channels for this part.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FemaleError {
    #[error(transparent)]
    Outline(#[from] OutlineError),
    #[error("the part is {found}; expected finite numbers, each minimum below its maximum")]
    PartIsNoBox { found: Cuboid<2> },
    #[error("the part {part} and the female part overlap: {wall} is solid")]
    PartInWall { part: Cuboid<2>, wall: Cuboid<2> },
    #[error("the part {part} sticks out of the box {female} around the female part, to a side or below")]
    PartOutside { part: Cuboid<2>, female: Cuboid<2> },
    #[error("the part {part} is above the female part, which ends at z = {top}: it is disassembled")]
    AlreadyOut { part: Cuboid<2>, top: f64 },
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
    Closed { part: Cuboid<2>, height: f64, top: f64 },
}

fn place(height: Option<f64>) -> String {
    height.map_or_else(|| "has no place".to_owned(), |height| format!("gets up to z = {height} only"))
}
