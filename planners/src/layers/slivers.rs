//! Slivers: rooms one cell thin. Along every curved or crooked wall the cells step, and each step leaves one: three
//! of four rooms of a scanned map are such (462 of 611 in a layer of nav2's depot). They say where the limit is to
//! within a cell, which is finer than a layer promises, so those are dropped that nobody misses.

use super::cells::{CellRect, Cells};
use super::neighbours::Owners;

/// How far from a thicker room a dropped cell may lie, in steps from cell to neighbouring cell.
const REACH: usize = 2;

/// The rooms without those slivers
/// - of which each cell lies within two free cells of a thicker room,
/// - that have rooms on one of their long sides only, so that nobody crosses them,
/// - without which the other rooms are connected as before.
///
/// The smallest are tried first; the order stays.
pub(super) fn drop_slivers(free: &Cells, rooms: &[CellRect]) -> Vec<CellRect> {
    let is_sliver = |room: &CellRect| (room.x1 - room.x0).min(room.y1 - room.y0) == 1;
    let mut near = Cells::none(free.columns(), free.rows());
    for room in rooms.iter().filter(|room| !is_sliver(room)) {
        near.insert_block(*room);
    }
    for _ in 0..REACH {
        near = near.grown_within(free);
    }
    let mut neighbours = vec![Vec::new(); rooms.len()];
    for (a, b) in Owners::new(free.columns(), free.rows(), rooms).beside() {
        neighbours[a as usize].push(b as usize);
        neighbours[b as usize].push(a as usize);
    }
    let mut kept = vec![true; rooms.len()];
    for (index, room) in rooms.iter().enumerate().rev() {
        if is_sliver(room) && near.first_missing(*room).is_none() {
            let beside: Vec<usize> = neighbours[index].iter().copied().filter(|&other| kept[other]).collect();
            let is_crossed = is_crossed(room, beside.iter().map(|&other| &rooms[other]));
            kept[index] = is_crossed || !are_connected(beside, &neighbours);
        }
    }
    rooms.iter().zip(kept).filter(|(_, kept)| *kept).map(|(room, _)| *room).collect()
}

/// Whether a sliver longer than a cell has rooms on both of its long sides.
fn is_crossed<'a>(sliver: &CellRect, beside: impl Iterator<Item = &'a CellRect> + Clone) -> bool {
    let (wide, tall) = (sliver.x1 - sliver.x0 > 1, sliver.y1 - sliver.y0 > 1);
    let some = |is_there: fn(&CellRect, &CellRect) -> bool| beside.clone().any(|room| is_there(room, sliver));
    wide && some(|room, sliver| room.y1 <= sliver.y0) && some(|room, sliver| room.y0 >= sliver.y1)
        || tall && some(|room, sliver| room.x1 <= sliver.x0) && some(|room, sliver| room.x0 >= sliver.x1)
}

/// Whether these rooms reach each other from one to the next, through no others.
fn are_connected(mut apart: Vec<usize>, neighbours: &[Vec<usize>]) -> bool {
    let mut reached: Vec<usize> = apart.pop().into_iter().collect();
    while let Some(from) = reached.pop() {
        let (beside, others) = apart.into_iter().partition(|other| neighbours[from].contains(other));
        apart = others;
        reached.extend::<Vec<usize>>(beside);
    }
    apart.is_empty()
}

#[cfg(test)]
mod tests {
    use super::super::cut::cut;
    use super::*;

    /// A disc's quarter as cells: the steps of its rim are slivers.
    fn quarter_disc(radius: u32) -> Cells {
        let mut cells = Cells::none(radius, radius);
        for y in 0..radius {
            let x1 = f64::from(radius * radius - y * y).sqrt() as u32;
            cells.insert_block(CellRect { x0: 0, y0: y, x1, y1: y + 1 });
        }
        cells
    }

    #[test]
    fn the_steps_of_a_round_wall_are_dropped_and_little_is_lost() {
        let disc = quarter_disc(40);
        let rooms = cut(&disc);
        let kept = drop_slivers(&disc, &rooms);
        let area = |rooms: &[CellRect]| rooms.iter().map(CellRect::area).sum::<u64>() as f64;
        let thin = |rooms: &[CellRect]| {
            rooms.iter().filter(|room| room.x1 - room.x0 == 1 || room.y1 - room.y0 == 1).count()
        };
        assert!(thin(&kept) * 4 < thin(&rooms), "{} of {} slivers are left", thin(&kept), thin(&rooms));
        assert!(area(&kept) > 0.95 * area(&rooms));
    }

    #[test]
    fn a_passage_one_cell_wide_stays() {
        let mut cells = Cells::none(20, 10);
        let left = CellRect { x0: 0, y0: 0, x1: 9, y1: 10 };
        let right = CellRect { x0: 11, y0: 0, x1: 20, y1: 10 };
        let passage = CellRect { x0: 9, y0: 4, x1: 11, y1: 5 };
        for block in [left, right, passage] {
            cells.insert_block(block);
        }
        let rooms = cut(&cells);
        assert_eq!(drop_slivers(&cells, &rooms), rooms);
    }
}
