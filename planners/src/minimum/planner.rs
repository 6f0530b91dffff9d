//! The fewest rooms as facts.

use crate::facts::Facts;
use crate::planner::{Planner, PlannerError, Signature};
use crate::rooms::{GIVES, known_low_bridges, room_facts};
use crate::spaces::{Located, OF_SPACES};
use crate::world::World;

use super::fewest_rooms;

/// The planner "fewest rooms". It asserts `ROOMS` and `DOORS` from the map and the bridges, with `low` decided.
pub struct MinimumRooms;

const NAME: &str = "fewest rooms";

impl Planner for MinimumRooms {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        let needs = ["BRIDGES.x0", "BRIDGES.y0", "BRIDGES.x1", "BRIDGES.y1", "BRIDGES.height", "BRIDGES.low"];
        Signature::new(&[needs.as_slice(), &OF_SPACES].concat(), GIVES)
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let low = known_low_bridges(NAME, known)?;
        let rooms = fewest_rooms(world.bounds, &world.solid_rects(), &low);
        Ok(room_facts(&rooms, &Located::read(NAME, known)?))
    }
}
