//! A part that leaves the other part that it was put into, or enters it, through channels (Lee, "Rule-Based
//! Path Finding Algorithm for Part Assembly", sections 2 to 4), in two dimensions or three.
//!
//! Where in each junction the part goes is decided outside, junction by junction, from [`StepFacts`]; here is
//! what that means in numbers: the way, its length, and how near it comes to the walls.
//!
//! ```
//! use adit_planners::channels::assembly::{Assembly, Cuboid, Decision, Margin, StepFacts};
//!
//! // The shaft leads out, the passage leads to it from the right.
//! let channels = vec![Cuboid::new([0.0, 0.0], [4.0, 9.0]), Cuboid::new([0.0, 0.0], [10.0, 4.0])];
//! let part = Cuboid::new([7.0, 1.0], [9.0, 3.0]);
//! let assembly = Assembly::new(channels, part)?;
//! let corner = |_: &StepFacts<2>| {
//!     Ok::<_, String>(Decision { rule: Some(3.0), gap: [0.5, 0.5], margin: [Margin::High, Margin::High] })
//! };
//! let path = assembly.disassemble(None, corner)?;
//! assert_eq!(path.waypoints, [[7.0, 1.0], [1.5, 1.5], [1.5, 9.0]]);
//! assert_eq!(path.min_clearance, 0.5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chain;
mod cuboid;
mod female;
mod outline;
mod path;
mod step;
mod sweep;
mod walls;

pub use chain::{Assembly, AssemblyError};
pub use cuboid::Cuboid;
pub use female::{FemaleError, channels_of};
pub use outline::{Edge, OutlineError, bounding_box};
pub use path::{Leg, PartPath, PathError};
pub use step::{Decision, Margin, StepFacts};
