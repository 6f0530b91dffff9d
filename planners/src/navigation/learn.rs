//! Learn mode (Crowley 1985, sections 4.1 to 4.3): a robot explores a building that it does not know, and ends with a
//! global model (its walls) and with the network of places over the convex regions of what it has seen free.
//!
//! The robot goes a little, looks around, and goes on: to an *opening*, where what it has seen free ends without a wall.
//! Which opening is next, and which are left alone, is asked of a [`Guide`]; where none is left that is worth a look, the
//! building is learned. Free is what beams have run through; what was never seen is not free, and an opening that is left
//! over is closed.
//!
//! [`Explorer`] does it with any body, [`Exploration`] in a simulated building, and [`score`] compares the result with the
//! true one.

mod exploration;
mod explorer;
mod grid;
mod ground;
mod joints;
mod learned;
mod opening;
mod pieces;
mod score;
mod seen;

pub use exploration::{Exploration, Explored};
pub use explorer::Explorer;
pub use learned::Learned;
pub use opening::{Guide, OpeningFacts};
pub use score::{Score, score};
pub(super) use seen::Seen;
