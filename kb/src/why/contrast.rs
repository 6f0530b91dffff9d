//! The one computation behind why, why-not and how firm: the best way beside the best way that does otherwise, and from
//! which value of a number of the tables on the one gives way to the other.
//!
//! A [`Contrast`] names two sets of ways: those that keep to what is asked about, and those that speak against it.
//! - *Why not through X*: all ways, and those through X ([`through`]).
//! - *Why in this state*: all ways, and those without it ([`without`]).
//! - *How firm*: the way as it is now, driven as is best at each value ([`same_way`]), and all ways.
//!
//! What the best of a set costs is concave in any number in which weights are linear: it is the least of many straight lines. So
//! where the one set gives way to the other is found between two values by the lines of the ways that are best there ([`turn`]).
//! Where rooms weigh their metres a way bends a little otherwise at each value, and the search for it is not exact to the last
//! digit: there an end is said to a thousandth, and what is driven a thousandth before and beyond it was looked at.
//! Each rule may use a number as it likes; whether weights are linear in it is looked at, piece by piece, between the values
//! that other rows of its column have. Where they are not, values are tried and halved, and [`Found::is_exact`] is false.

mod end;
mod others;
mod path;
pub mod same_way;
mod straight;
pub mod through;
mod turn;
pub mod without;
mod words;

pub use end::{Contrast, End, Found, Known, Look, Takeover};
pub use others::{Beside, Choice, Ways, is_best};
pub use path::{Path, Routes};
pub use turn::Turn;
pub use words::{actions, instead};
