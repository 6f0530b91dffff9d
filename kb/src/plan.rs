//! The planners of Lee's paper on worlds of their own: a part that is taken out of another through channels (Table 1),
//! and a robot that drives through corridors (Table 2).
//!
//! A world ([`World`], a TOML file) is read once. At each junction the rules are asked where to go ([`Steps`],
//! [`Turns`]): the tables are rules, and so are the gap, what is refused, and what a corridor weighs. Geometry makes a
//! path of what they say, and measures it.

mod answer;
pub mod assembly;
pub mod consult;
pub mod corridor;
mod corridor_answer;
pub mod course;
mod drives;
mod gap;
mod parts;
mod refusal;
pub mod rules;
pub(crate) mod said;
mod steps;
mod turns;
mod world;

pub use drives::CorridorsOf;
pub use gap::{Asked, Wanted, Wishes};
pub use parts::PartsOf;
pub(crate) use refusal::decided;
pub use refusal::{NoPath, Spoke};
pub use said::{Answer, Said};
pub use steps::Steps;
pub use turns::Turns;
pub use world::{Task, World, course as course_of};
