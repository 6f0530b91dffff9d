//! Concave corners of the free space, and how far one sees from them across.

use crate::skyline::Skyline;
use crate::strips::Block;

/// A point with one blocked cell around it and three free ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) x: u32,
    pub(super) y: u32,
    /// The line at which the free way across, away from the blocked cell, ends.
    pub(super) reach: u32,
}

/// The concave corners within `columns` x `rows` cells, from the top down and from left to right.
pub(super) fn concave_corners(columns: u32, rows: u32, blocks: &[Block]) -> Vec<Corner> {
    let mut skyline = Skyline::of(columns, blocks);
    let mut corners = Vec::new();
    let mut above = Vec::new();
    let points = inner_corners(columns, rows, blocks);
    for level in points.chunk_by(|a, b| a.1 == b.1) {
        let y = level[0].1;
        skyline.look_above(y);
        let covers_above = skyline.through(y);
        let is_free = |skyline: &Skyline, column, limit| skyline.cover(column, limit).is_none();
        above.clear();
        above.extend(level.iter().map(|&(x, _)| [x - 1, x].map(|c| is_free(&skyline, c, covers_above))));
        skyline.look_below(y);
        let (covers_below, covers_either) = (skyline.below(y), skyline.through(y));
        for (&(x, _), above) in level.iter().zip(&above) {
            let below = [x - 1, x].map(|column| is_free(&skyline, column, covers_below));
            let (left, right) = (above[0] && below[0], above[1] && below[1]);
            let free = above.iter().chain(&below).filter(|&&free| free).count();
            if free == 3 {
                let reach = if right {
                    skyline.right_end(x, covers_either)
                } else {
                    debug_assert!(left);
                    skyline.left_end(x - 1, covers_either)
                };
                corners.push(Corner { x, y, reach });
            }
        }
    }
    corners
}

/// Corners of blocks that do not lie on the edge, as (x, y), from the top down and from left to right.
fn inner_corners(columns: u32, rows: u32, blocks: &[Block]) -> Vec<(u32, u32)> {
    let corners = |b: &Block| [(b.x0, b.y0), (b.x1, b.y0), (b.x0, b.y1), (b.x1, b.y1)];
    let is_inner = |&(x, y): &(u32, u32)| 0 < x && x < columns && 0 < y && y < rows;
    let mut points: Vec<_> = blocks.iter().flat_map(corners).filter(is_inner).collect();
    points.sort_unstable_by_key(|&(x, y)| (std::cmp::Reverse(y), x));
    points.dedup();
    points
}
