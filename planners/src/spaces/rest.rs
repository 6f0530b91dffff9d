//! What is left over goes to the spaces beside it: cells in no space, and spaces too small to be one.

use std::collections::BTreeMap;

use petgraph::unionfind::UnionFind;

use crate::search::grid::{BESIDE, on};
use crate::world::Occupancy;

/// What is smaller joins the neighbour that it has the longest border with, square metres.
const LEAST_M2: f64 = 2.0;

/// No space.
pub(super) const NONE: u32 = 0;

/// Cells of the floor in no space, as where openings were closed, are of the space that is nearest by steps.
pub(super) fn flood(floor: &Occupancy, of_cell: &mut [u32]) {
    let beside = BESIDE.map(|by| on(by, floor.columns));
    let around = move |cell: usize| beside.map(|on| cell.wrapping_add_signed(on));
    let is_left = |cell: usize| of_cell[cell] == NONE && !floor.blocked[cell];
    let left = (0..of_cell.len()).filter(|&cell| is_left(cell));
    let mut front: Vec<usize> = left.flat_map(around).filter(|&cell| of_cell[cell] != NONE).collect();
    front.sort_unstable();
    front.dedup();
    while !front.is_empty() {
        let mut next = Vec::new();
        for cell in front {
            for to in around(cell) {
                if of_cell[to] == NONE && !floor.blocked[to] {
                    of_cell[to] = of_cell[cell];
                    next.push(to);
                }
            }
        }
        front = next;
    }
}

/// Small spaces join others, the smallest first; then numbers run from 1, by the first cell of each.
pub(super) fn absorb(floor: &Occupancy, of_cell: &mut [u32]) {
    let count = of_cell.iter().max().map_or(0, |&most| most as usize) + 1;
    let mut area = vec![0.0; count];
    let mut borders: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for (cell, &space) in of_cell.iter().enumerate().filter(|(_, space)| **space != NONE) {
        area[space as usize] += floor.resolution * floor.resolution;
        for next in [cell + 1, cell + floor.columns] {
            let other = of_cell[next];
            if other != NONE && other != space {
                *borders.entry((space, other)).or_insert(0) += 1;
                *borders.entry((other, space)).or_insert(0) += 1;
            }
        }
    }
    let mut sets = UnionFind::<u32>::new(count);
    loop {
        let mut least: Option<(f64, u32)> = None;
        let mut shared: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for (&(one, other), &border) in &borders {
            let (one, other) = (sets.find_mut(one), sets.find_mut(other));
            if one != other {
                *shared.entry((one, other)).or_insert(0) += border;
                let here = (area[one as usize], one);
                if here.0 < LEAST_M2 && least.is_none_or(|least| here < least) {
                    least = Some(here);
                }
            }
        }
        let Some((_, small)) = least else { break };
        let widest = shared.range((small, 0)..=(small, u32::MAX)).max_by_key(|(_, border)| **border);
        let Some((&(_, other), _)) = widest else { break };
        let both = area[small as usize] + area[other as usize];
        sets.union(small, other);
        area[sets.find_mut(small) as usize] = both;
    }
    let roots: Vec<usize> = sets.into_labeling().into_iter().map(|root| root as usize).collect();
    let (mut numbers, mut next) = (vec![NONE; count], NONE);
    for space in of_cell.iter_mut().filter(|space| **space != NONE) {
        let root = roots[*space as usize];
        // what is too small and has no neighbour is none
        if numbers[root] == NONE && area[root] >= LEAST_M2 / 8.0 {
            next += 1;
            numbers[root] = next;
        }
        *space = numbers[root];
    }
}
