//! Floor plans: walls as segments, free space cut into convex regions, doorways with two adits each, the network of
//! places, and ways through it for a disc (Crowley 1985, sections 4.2 and 4.4).

mod check;
pub mod clear;
pub mod disc;
mod face;
mod facts;
mod funnel;
mod layout;
mod merged;
mod mesh;
mod near;
pub mod network;
mod noding;
pub mod path;
pub mod plan;
mod planar;
mod read;
pub mod regions;
mod search;
mod solids;
mod space;
mod trees;

pub use disc::Disc;
pub use facts::{RegionsAndAdits, outline};
pub use network::{Adit, Network, Spot, Way};
pub use path::{NoPath, Path, Rule};
pub use plan::{Drawn, FloorPlan};
pub use read::{parse_floor_plan, read_floor_plan};
pub use regions::{Doorway, Region, Regions};
