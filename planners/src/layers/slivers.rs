//! Slivers: rooms one cell thin. Along every curved or crooked wall the cells step, and each step leaves one: three
//! of four rooms of a scanned map are such (462 of 611 in a layer of nav2's depot). They say where the limit is to
//! within a cell, which is finer than a layer promises, so those are dropped that nobody misses.

use super::cells::Cells;
use super::labels::Labels;
use super::neighbours::{Owners, by_room};
use crate::search::Csr;
use crate::strips::Block;

/// How far from a thicker room a dropped cell may lie, in steps from cell to neighbouring cell.
const REACH: usize = 2;

/// The rooms without those slivers
/// - of which each cell lies within two free cells of a thicker room,
/// - that have rooms on one of their long sides only, so that nobody crosses them,
/// - without which the other rooms are connected as before,
/// - that have the label of all rooms beside them, and of one at least where they have a label: so no area or named
///   door loses its last room, and rooms stay connected as before without any that a rule shuts.
///
/// The smallest are tried first; the order stays.
pub(super) fn drop_slivers(free: &Cells, rooms: &[Block], labels: Option<&Labels>) -> Vec<Block> {
    let is_sliver = |room: &Block| (room.x1 - room.x0).min(room.y1 - room.y0) == 1;
    let mut near = Cells::none(free.columns(), free.rows());
    for room in rooms.iter().filter(|room| !is_sliver(room)) {
        near.insert_block(*room);
    }
    for _ in 0..REACH {
        near = near.grown_within(free);
    }
    let neighbours = by_room(rooms.len(), &Owners::new(free.columns(), free.rows(), rooms).beside());
    let mut kept = vec![true; rooms.len()];
    for (index, room) in rooms.iter().enumerate().rev() {
        if is_sliver(room) && near.first_missing(*room).is_none() {
            let beside = neighbours.of(index).iter().copied().filter(|&other| kept[other as usize]);
            let beside: Vec<u32> = beside.collect();
            let around: Vec<Block> = beside.iter().map(|&other| rooms[other as usize]).collect();
            kept[index] = labels.is_some_and(|labels| !is_among_its_own(room, &around, labels))
                || is_crossed(room, &around)
                || !are_connected(beside, &neighbours);
        }
    }
    rooms.iter().zip(kept).filter(|(_, kept)| *kept).map(|(room, _)| *room).collect()
}

/// Whether all rooms around a sliver have its label, and there is one if the sliver lies in something.
fn is_among_its_own(sliver: &Block, around: &[Block], labels: &Labels) -> bool {
    let number = |room: &Block| labels.number(room.x0, room.y0);
    let own = number(sliver);
    around.iter().all(|room| number(room) == own) && (own == 0 || !around.is_empty())
}

/// Whether a sliver longer than a cell has rooms on both of its long sides.
fn is_crossed(sliver: &Block, around: &[Block]) -> bool {
    let (wide, tall) = (sliver.x1 - sliver.x0 > 1, sliver.y1 - sliver.y0 > 1);
    let some = |is_there: fn(&Block, &Block) -> bool| around.iter().any(|room| is_there(room, sliver));
    wide && some(|room, sliver| room.y1 <= sliver.y0) && some(|room, sliver| room.y0 >= sliver.y1)
        || tall && some(|room, sliver| room.x1 <= sliver.x0) && some(|room, sliver| room.x0 >= sliver.x1)
}

/// Whether these rooms reach each other from one to the next, through no others.
fn are_connected(mut apart: Vec<u32>, neighbours: &Csr<u32>) -> bool {
    let mut reached: Vec<u32> = apart.pop().into_iter().collect();
    while let Some(from) = reached.pop() {
        let (beside, others) =
            apart.into_iter().partition(|other| neighbours.of(from as usize).contains(other));
        apart = others;
        reached.extend::<Vec<u32>>(beside);
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
            cells.insert_block(Block { x0: 0, y0: y, x1, y1: y + 1 });
        }
        cells
    }

    #[test]
    fn the_steps_of_a_round_wall_are_dropped_and_little_is_lost() {
        let disc = quarter_disc(40);
        let rooms = cut(&disc);
        let kept = drop_slivers(&disc, &rooms, None);
        let area = |rooms: &[Block]| rooms.iter().map(Block::area).sum::<u64>() as f64;
        let thin = |rooms: &[Block]| {
            rooms.iter().filter(|room| room.x1 - room.x0 == 1 || room.y1 - room.y0 == 1).count()
        };
        assert!(thin(&kept) * 4 < thin(&rooms), "{} of {} slivers are left", thin(&kept), thin(&rooms));
        assert!(area(&kept) > 0.95 * area(&rooms));
    }

    #[test]
    fn a_passage_one_cell_wide_stays() {
        let mut cells = Cells::none(20, 10);
        let left = Block { x0: 0, y0: 0, x1: 9, y1: 10 };
        let right = Block { x0: 11, y0: 0, x1: 20, y1: 10 };
        let passage = Block { x0: 9, y0: 4, x1: 11, y1: 5 };
        for block in [left, right, passage] {
            cells.insert_block(block);
        }
        let rooms = cut(&cells);
        assert_eq!(drop_slivers(&cells, &rooms, None), rooms);
    }
}
