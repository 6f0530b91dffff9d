//! Maps that are not cut into rooms ([`course`]), and Lee's planners: a part that is taken out of another through channels
//! (Table 1), and a robot that drives through corridors (Table 2).
//!
//! At each junction the rules are asked where to go ([`Steps`], [`Turns`]): the tables are rules, and so are the gap, what is
//! refused, and what a corridor weighs. Geometry makes a path of what they say, and measures it.

pub mod assembly;
pub mod consult;
pub mod corridor;
pub mod course;
mod drives;
pub(crate) mod figures;
mod gap;
pub mod lanes;
pub mod legs;
mod parts;
mod refusal;
pub mod rules;
pub(crate) mod said;
mod steps;
mod turns;
pub mod world;

pub use drives::CorridorsOf;
pub use gap::{Asked, Wanted, Wishes};
pub use parts::PartsOf;
pub(crate) use refusal::decided;
pub use refusal::{NoPath, Spoke};
pub use said::{Answer, Said};
pub use steps::Steps;
pub use turns::Turns;
pub use world::course as course_of;
