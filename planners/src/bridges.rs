//! The bridges of a map as facts. Which of them are low, a rule says.

use crate::facts::{Column, Facts, Table};
use crate::known::{keys, with_edges};
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::World;

/// The planner "bridges". It asserts `BRIDGES`: bridge (from 1, in the order of the map), its edges as the map
/// gives them, and its clear height, in metres.
pub struct Bridges;

impl Planner for Bridges {
    fn name(&self) -> &'static str {
        "bridges"
    }

    fn signature(&self) -> Signature {
        let gives =
            ["BRIDGES.bridge", "BRIDGES.x0", "BRIDGES.y0", "BRIDGES.x1", "BRIDGES.y1", "BRIDGES.height"];
        Signature::new(&[], &gives)
    }

    fn facts(&self, world: &World, _known: &Facts) -> Result<Facts, PlannerError> {
        let rects: Vec<_> = world.bridges.iter().map(|bridge| bridge.rect).collect();
        let table = with_edges(Table::default().with("bridge", keys(rects.len())), &rects)
            .with("height", world.bridges.iter().map(|bridge| bridge.height).collect::<Column>());
        Ok(Facts::from([("BRIDGES".to_owned(), table)]))
    }
}
