//! Robots that are heard by lines of JSON: what Adit says to one and hears of it, over standard input and output of a program, or
//! over a socket. `manual/src/bodies.md` is the protocol for those who write one.
//!
//! Adit speaks, and each of its lines is answered by one line. [`Remote`] is such a robot as a navigator knows it, [`Host`] is a
//! robot of ours as others hear it, [`conform`] puts somebody else's through all that the protocol asks.

pub mod conform;
mod host;
mod limits;
mod link;
mod message;
mod remote;
mod terms;

pub use host::Host;
pub use link::{Ends, Link};
pub use message::{Outline, Profile};
pub use remote::{Remote, Used};
