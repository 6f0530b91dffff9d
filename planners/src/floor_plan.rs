//! Floor plans: walls as segments, free space cut into convex regions, doorways with two adits each, the network of
//! places, and ways through it for a disc (Crowley 1985, sections 4.2 and 4.4).

mod dice;
mod hall;
mod layout;
mod merged;
mod noding;
mod plan;
mod planar;
mod read;
pub mod regions;
mod search;

pub use plan::{Drawn, FloorPlan};
pub use read::{parse_floor_plan, read_floor_plan};
pub use regions::{Doorway, Region, Regions};
