//! The rooms that the paper's steps make.

use crate::facts::Facts;
use crate::geometry::Rect;
use crate::known::KnownClass;
use crate::planner::{Planner, PlannerError, Signature};
use crate::prime_areas::maximal_rects;
use crate::spaces::{Located, OF_SPACES};
use crate::world::World;

use super::{GIVES, LowBridge, Room, cut_low_bridges, greedy_rooms, known_low_bridges, room_facts};

/// The rooms of Abou-Ali et al., "Rooms generation", in the order in which they are made: low bridges in the order
/// given, then the largest of the open areas until they are used up, then of the hard ones.
///
/// # Arguments
/// - `solid`: what no state passes; `low`: bridges too low for the tallest state (list 1).
/// - `open`, `hard`: prime areas where the least hard state can turn round, and the others (lists 2 and 3).
pub fn paper_rooms(
    bounds: Rect,
    solid: &[Rect],
    low: &[LowBridge],
    open: &[Rect],
    hard: &[Rect],
) -> Vec<Room> {
    let mut rooms = cut_low_bridges(bounds, solid, low, |area, blocked| {
        greedy_rooms(&[], &[&maximal_rects(area, blocked)])
    });
    let first: Vec<_> = rooms.iter().map(|room| room.rect).collect();
    let chosen = greedy_rooms(&first, &[open, hard]);
    rooms.extend(chosen.into_iter().map(|rect| Room { rect, height: None }));
    rooms
}

/// The planner "rooms of the paper". It asserts `ROOMS` and `DOORS` from the prime areas, with `open` decided, and
/// the bridges, with `low` decided.
pub struct PaperRooms;

const NAME: &str = "rooms of the paper";

const NEEDS: &[&str] = &[
    "PRIME_AREAS.x0",
    "PRIME_AREAS.y0",
    "PRIME_AREAS.x1",
    "PRIME_AREAS.y1",
    "PRIME_AREAS.open",
    "BRIDGES.x0",
    "BRIDGES.y0",
    "BRIDGES.x1",
    "BRIDGES.y1",
    "BRIDGES.height",
    "BRIDGES.low",
];

impl Planner for PaperRooms {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        Signature::new(&[NEEDS, &OF_SPACES].concat(), GIVES)
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let areas = KnownClass::find(NAME, "PRIME_AREAS", known)?;
        let (rects, is_open) = (areas.rects()?, areas.truths("open")?);
        let low = known_low_bridges(NAME, known)?;
        let listed = |on_list: bool| -> Vec<Rect> {
            let all = rects.iter().zip(&is_open);
            all.filter(|&(_, &open)| open == on_list).map(|(&rect, _)| rect).collect()
        };
        let rooms = paper_rooms(world.bounds, &world.solid_rects(), &low, &listed(true), &listed(false));
        Ok(room_facts(&rooms, &Located::read(NAME, known)?))
    }
}
