//! Least-cost ways over the cells of a grid.
//!
//! Cells are numbers and what is known of each lies in arrays; petgraph's searches keep hash maps, over a graph that has to
//! be laid first: 15 times as long to all cells, twice to a goal (`cargo bench -p adit-planners --bench search`).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Columns and rows to the eight neighbours of a cell: over its sides first, then over its corners.
pub const AROUND: [(i32, i32); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];

/// Columns and rows to the four neighbours over its sides.
pub const BESIDE: [(i32, i32); 4] = [AROUND[0], AROUND[1], AROUND[2], AROUND[3]];

/// What a step over a side of a cell costs.
pub const STRAIGHT: u32 = 1000;

/// What one over a corner costs: longer by the root of 2, less a part in 6,000.
const DIAGONAL: u32 = 1414;

/// What a step to one of the cells [`AROUND`] costs.
pub fn step((dx, dy): (i32, i32)) -> u32 {
    if dx == 0 || dy == 0 { STRAIGHT } else { DIAGONAL }
}

/// Where a neighbour of a cell lies among the cells of so many columns, from the cell on.
pub fn on((dx, dy): (i32, i32), columns: usize) -> isize {
    dx as isize + dy as isize * columns as isize
}

/// The least cost of a way over so many columns and rows.
pub fn least_cost(columns: usize, rows: usize) -> u32 {
    STRAIGHT * columns.max(rows) as u32 + (DIAGONAL - STRAIGHT) * columns.min(rows) as u32
}

/// The cells around one that lie on a grid of `size` columns and rows, numbered row by row, with what a step there costs.
pub fn around(cell: usize, size: (usize, usize)) -> impl Iterator<Item = (usize, u32)> {
    let from = (cell % size.0, cell / size.0);
    AROUND.into_iter().filter_map(move |by| Some((stepped(from, size, by)?, step(by))))
}

/// Those over its sides.
pub fn beside(cell: usize, size: (usize, usize)) -> impl Iterator<Item = usize> {
    let from = (cell % size.0, cell / size.0);
    BESIDE.into_iter().filter_map(move |by| stepped(from, size, by))
}

fn stepped(
    (column, row): (usize, usize),
    (columns, rows): (usize, usize),
    (dx, dy): (i32, i32),
) -> Option<usize> {
    let (column, row) = (column.checked_add_signed(dx as isize)?, row.checked_add_signed(dy as isize)?);
    (column < columns && row < rows).then_some(row * columns + column)
}

/// Least costs from a cell, and the ways that have them.
#[derive(Clone, Debug, Default)]
pub struct LeastCosts {
    costs: Vec<u32>,
    before: Vec<usize>,
}

impl LeastCosts {
    /// The least cost of a cell; `None` where the search did not come.
    pub fn cost(&self, cell: usize) -> Option<u32> {
        self.costs.get(cell).copied().filter(|&cost| cost < u32::MAX)
    }

    /// The cells from where the search began to one that it reached.
    pub fn way(&self, to: usize) -> Vec<usize> {
        let back = std::iter::successors(Some(to), |&cell| {
            Some(self.before[cell]).filter(|&cell| cell != usize::MAX)
        });
        let mut way: Vec<usize> = back.collect();
        way.reverse();
        way
    }
}

/// Finds ways to a goal (A*, Hart, Nilsson and Raphael 1968), or to all cells (Dijkstra 1959).
///
/// # Arguments
/// `cells` is how many there are; `left` is no more than what is left from a cell to the goal, 0 where there is none;
/// `next` gives the cells that a cell leads to, and what the steps cost.
pub fn least_costs<I: Iterator<Item = (usize, u32)>>(
    cells: usize,
    start: usize,
    goal: Option<usize>,
    left: impl Fn(usize) -> u32,
    next: impl Fn(usize) -> I,
) -> LeastCosts {
    let mut found = LeastCosts { costs: vec![u32::MAX; cells], before: vec![usize::MAX; cells] };
    found.costs[start] = 0;
    let mut open = BinaryHeap::from([Reverse((left(start), 0, start))]);
    while let Some(Reverse((_, so_far, cell))) = open.pop() {
        if goal == Some(cell) {
            break;
        }
        if so_far > found.costs[cell] {
            continue;
        }
        for (next, step) in next(cell) {
            let cost = so_far + step;
            if cost < found.costs[next] {
                (found.costs[next], found.before[next]) = (cost, cell);
                open.push(Reverse((cost + left(next), cost, next)));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_goes_round_what_is_in_the_way() {
        // Five by three cells; a wall in the middle column leaves the upper row open.
        let next = |cell: usize| {
            let (column, row) = ((cell % 5) as i32, (cell / 5) as i32);
            BESIDE.iter().filter_map(move |(dx, dy)| {
                let (x, y) = (column + dx, row + dy);
                let is_open = (0..5).contains(&x) && (0..3).contains(&y) && (x != 2 || y == 2);
                is_open.then_some(((y * 5 + x) as usize, 1))
            })
        };
        let to_goal = least_costs(15, 0, Some(4), |cell| (4 - cell % 5) as u32, next);
        let to_all = least_costs(15, 0, None, |_| 0, next);
        assert_eq!((to_goal.cost(4), to_all.cost(4), to_all.cost(2)), (Some(8), Some(8), None));
        let way = to_all.way(4);
        assert_eq!((way.len(), way[0], way[8]), (9, 0, 4));
        assert!(way.contains(&12));
    }
}
