//! Which room lies in which area or door, as facts.

use crate::facts::{Column, Facts, Table};
use crate::world::World;

/// What [`member_facts`] gives.
pub(crate) const GIVES: [&str; 4] =
    ["AREA_ROOMS.room", "AREA_ROOMS.area: text", "DOOR_ROOMS.room", "DOOR_ROOMS.door: text"];

/// `AREA_ROOMS` and `DOOR_ROOMS`.
///
/// # Arguments
/// Pairs of a room, by its key, and an area or a named door, by its index in the world.
pub(crate) fn member_facts(world: &World, areas: &[(usize, usize)], doors: &[(usize, usize)]) -> Facts {
    let area = |index: usize| world.areas[index].name.clone();
    let door = |index: usize| world.named_doors[index].name.clone();
    Facts::from([
        ("AREA_ROOMS".to_owned(), table("area", areas, area)),
        ("DOOR_ROOMS".to_owned(), table("door", doors, door)),
    ])
}

/// The pairs by room and name.
fn table(what: &str, pairs: &[(usize, usize)], name: impl Fn(usize) -> String) -> Table {
    let mut named: Vec<(usize, String)> = pairs.iter().map(|&(room, of)| (room, name(of))).collect();
    named.sort_unstable();
    Table::default()
        .with("room", named.iter().map(|(room, _)| *room as f64).collect::<Column>())
        .with(what, named.into_iter().map(|(_, name)| name).collect::<Column>())
}
