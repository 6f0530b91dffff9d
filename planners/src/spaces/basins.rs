//! Floor cut at saddles of the clearance: each cell climbs to where it is furthest from walls, and two summits are of one
//! space unless the pass between them is a narrowing.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::mem::replace;

use petgraph::unionfind::UnionFind;
use rayon::prelude::*;

use crate::layers::squared_gaps;
use crate::search::grid::{AROUND, BESIDE, step};
use crate::world::Occupancy;

/// A pass at least so high, by the lower summit, is no narrowing.
const NO_NARROWING: f64 = 0.75;

/// Summits of which the higher is at most so many times the lower are alike: a corridor is no bay of the hall in which it
/// ends.
const ALIKE: f64 = 2.2;

/// What is smaller joins the neighbour that it has the longest border with, square metres.
const LEAST_M2: f64 = 2.0;

/// No space.
pub(super) const NONE: u32 = 0;

/// For each cell of the floor the number of its space, from 1 without gaps; [`NONE`] where none is.
///
/// # Arguments
/// `closed` is the floor with its openings closed.
pub(super) fn basins(floor: &Occupancy, closed: &Occupancy) -> Vec<u32> {
    let size = (closed.columns, closed.rows);
    let gaps = squared_gaps(size, |column, row| closed.is_blocked(column, row));
    let clear: Vec<f64> = gaps
        .par_iter()
        .zip(&closed.blocked)
        .map(|(gap, blocked)| if *blocked { 0.0 } else { f64::from(*gap).sqrt() + 1.0 })
        .collect();
    let (summit_of, summits) = climb(closed, &gaps, &clear);
    let joined = join(closed, &clear, &summit_of, &summits);
    let mut of_cell: Vec<u32> =
        summit_of.iter().map(|&summit| if summit == NONE { NONE } else { joined[summit as usize] }).collect();
    flood(floor, &mut of_cell);
    absorb(floor, &mut of_cell);
    of_cell
}

/// For each cell the summit that it climbs to, from 1; and the cell of each summit.
fn climb(floor: &Occupancy, gaps: &[u32], clear: &[f64]) -> (Vec<u32>, Vec<usize>) {
    let around = AROUND.map(|by| (on(by, floor), f64::from(step(by))));
    let steepest = |cell: usize| {
        let mut best = (cell, 0.0);
        for (on, step) in around {
            let next = cell.wrapping_add_signed(on);
            let rise = (clear[next] - clear[cell]) / step;
            // of cells that are as far from walls, the later one is the higher
            let is_higher = rise > 0.0 || rise == 0.0 && next > cell;
            if is_higher && rise.total_cmp(&best.1).then(next.cmp(&best.0)).is_gt() {
                best = (next, rise);
            }
        }
        best.0
    };
    let is_floor = |cell: usize| clear[cell] > 0.0;
    let cells = || (0..clear.len()).into_par_iter();
    let mut up: Vec<usize> = cells().map(|cell| if is_floor(cell) { steepest(cell) } else { cell }).collect();
    let mut summits: Vec<usize> = cells().filter(|&cell| is_floor(cell) && up[cell] == cell).collect();
    // the furthest from walls first, of equals the last
    summits.sort_unstable_by_key(|&cell| Reverse((gaps[cell], cell)));
    summits.insert(0, 0);
    let mut number = vec![NONE; clear.len()];
    for (at, &cell) in summits.iter().enumerate().skip(1) {
        number[cell] = at as u32;
    }
    for cell in (0..clear.len()).filter(|&cell| is_floor(cell)) {
        let mut top = cell;
        while up[top] != top {
            top = up[top];
        }
        // those behind it come to the top at once
        let mut here = cell;
        while up[here] != top {
            here = replace(&mut up[here], top);
        }
    }
    (cells().map(|cell| number[up[cell]]).collect(), summits)
}

/// Where the neighbour of a cell lies among the cells, from the cell on. A floor has a rim of solid cells.
fn on((dx, dy): (i32, i32), floor: &Occupancy) -> isize {
    dx as isize + dy as isize * floor.columns as isize
}

/// For each summit the number of the one that stands for it.
fn join(floor: &Occupancy, clear: &[f64], summit_of: &[u32], summits: &[usize]) -> Vec<u32> {
    let cell_area = floor.resolution * floor.resolution;
    let onward = AROUND.map(|by| on(by, floor)).into_iter().filter(|on| *on > 0);
    let onward: Vec<usize> = onward.map(isize::unsigned_abs).collect();
    let mut passes: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let mut area = vec![0.0; summits.len()];
    for (cell, &summit) in summit_of.iter().enumerate().filter(|(_, summit)| **summit != NONE) {
        area[summit as usize] += cell_area;
        for next in onward.iter().map(|on| cell + on) {
            let other = summit_of[next];
            if other != NONE && other != summit {
                let pass = passes.entry((summit.min(other), summit.max(other))).or_insert(0.0);
                *pass = pass.max(clear[cell].min(clear[next]));
            }
        }
    }
    let mut passes: Vec<((u32, u32), f64)> = passes.into_iter().collect();
    passes.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut top: Vec<f64> = summits.iter().map(|&cell| clear[cell]).collect();
    let mut sets = UnionFind::<u32>::new(summits.len());
    loop {
        let mut is_joined = false;
        for &((one, other), pass) in &passes {
            let (one, other) = (sets.find_mut(one) as usize, sets.find_mut(other) as usize);
            if one == other {
                continue;
            }
            let (lower, higher) = if top[one] <= top[other] { (one, other) } else { (other, one) };
            let width = 2.0 * top[lower] * floor.resolution;
            let is_small = area[lower] < 4.0 * width * width;
            if pass >= NO_NARROWING * top[lower] && (top[higher] <= ALIKE * top[lower] || is_small) {
                sets.union(one as u32, other as u32);
                let root = sets.find_mut(one as u32) as usize;
                (top[root], area[root]) = (top[higher], area[one] + area[other]);
                is_joined = true;
            }
        }
        if !is_joined {
            return sets.into_labeling();
        }
    }
}

/// Cells of the floor in no space, as where openings were closed, are of the space that is nearest by steps.
fn flood(floor: &Occupancy, of_cell: &mut [u32]) {
    let beside = BESIDE.map(|by| on(by, floor));
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
fn absorb(floor: &Occupancy, of_cell: &mut [u32]) {
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
