//! Strips and prime areas as facts.

use crate::facts::{Column, Facts, Table};
use crate::geometry::Rect;
use crate::known::{keys, with_edges};
use crate::planner::{Planner, PlannerError, Signature};
use crate::strips::{Block, Strips};
use crate::world::World;

use super::prime_areas;

/// The planner "prime areas". It asserts `STRIPS` (axis "x" or "y", strip from 0, low and high edge in metres)
/// and `PRIME_AREAS` (area from 1, its edges and smaller side in metres, and the first and last strip of the
/// run of ones in its left and right string). Which areas are open it leaves to a rule.
pub struct PrimeAreas;

const GIVES: &[&str] = &[
    "STRIPS.axis: text",
    "STRIPS.strip",
    "STRIPS.low",
    "STRIPS.high",
    "PRIME_AREAS.area",
    "PRIME_AREAS.x0",
    "PRIME_AREAS.y0",
    "PRIME_AREAS.x1",
    "PRIME_AREAS.y1",
    "PRIME_AREAS.width",
    "PRIME_AREAS.left_first",
    "PRIME_AREAS.left_last",
    "PRIME_AREAS.right_first",
    "PRIME_AREAS.right_last",
];

impl Planner for PrimeAreas {
    fn name(&self) -> &'static str {
        "prime areas"
    }

    fn signature(&self) -> Signature {
        Signature::new(&[], GIVES)
    }

    fn facts(&self, world: &World, _known: &Facts) -> Result<Facts, PlannerError> {
        let (strips, areas) = prime_areas(world);
        Ok(Facts::from([
            ("STRIPS".to_owned(), strip_table(&strips)),
            ("PRIME_AREAS".to_owned(), area_table(&strips, &areas)),
        ]))
    }
}

fn strip_table(strips: &Strips) -> Table {
    let axes = [("x", &strips.x), ("y", &strips.y)];
    let rows = || axes.iter().flat_map(|(axis, lines)| lines.windows(2).enumerate().map(move |w| (axis, w)));
    Table::default()
        .with("axis", rows().map(|(axis, _)| (*axis).to_owned()).collect::<Column>())
        .with("strip", rows().map(|(_, (strip, _))| strip as f64).collect::<Column>())
        .with("low", rows().map(|(_, (_, edges))| edges[0]).collect::<Column>())
        .with("high", rows().map(|(_, (_, edges))| edges[1]).collect::<Column>())
}

fn area_table(strips: &Strips, areas: &[Block]) -> Table {
    let strip = |of: fn(&Block) -> u32| areas.iter().map(|area| f64::from(of(area))).collect::<Column>();
    let rects: Vec<_> = areas.iter().map(|&area| strips.rect(area)).collect();
    with_edges(Table::default().with("area", keys(areas.len())), &rects)
        .with("width", rects.iter().map(Rect::smaller_side).collect::<Column>())
        .with("left_first", strip(|area| area.x0))
        .with("left_last", strip(|area| area.x1 - 1))
        .with("right_first", strip(|area| area.y0))
        .with("right_last", strip(|area| area.y1 - 1))
}
