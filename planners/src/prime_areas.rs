//! Prime areas: every maximal rectangle of free cells, bridges counted as free. They are what the McCluskey
//! method yields, whose prime implicants are maximal rectangles (Abou-Ali et al., "Isolation of free areas").

pub(crate) mod maximal;
mod planner;

use crate::geometry::Rect;
use crate::strips::{Block, Strips};
use crate::world::World;

pub use planner::PrimeAreas;

use maximal::MaximalBlocks;

/// The strips of a world and its prime areas as blocks of them, ordered by (x0, y0, x1, y1).
///
/// Complexity: O((n + k) log n) for n obstacles and k areas, plus sorting the areas.
pub fn prime_areas(world: &World) -> (Strips, Vec<Block>) {
    let strips = Strips::of_world(world);
    let blocked =
        world.solid_rects().into_iter().filter_map(|rect| strips.block(rect.intersection(&world.bounds)?));
    let areas = maximal_blocks(&strips, &blocked.collect::<Vec<_>>());
    (strips, areas)
}

/// The maximal rectangles within `bounds` that share no area with any of `blocked`, which may overlap, touch,
/// stick out or be flat; ordered by (x0, y0, x1, y1).
pub fn maximal_rects(bounds: Rect, blocked: &[Rect]) -> Vec<Rect> {
    let (strips, blocked) = Strips::with_blocks(bounds, blocked.iter().copied());
    maximal_blocks(&strips, &blocked).into_iter().map(|block| strips.rect(block)).collect()
}

fn maximal_blocks(strips: &Strips, blocked: &[Block]) -> Vec<Block> {
    let mut areas = Vec::new();
    MaximalBlocks::new().each(strips.columns(), strips.rows(), blocked, |area| areas.push(area));
    sorted(strips.columns(), &areas)
}

/// The blocks by (x0, y0, x1, y1): counted into place by x0, then sorted among equals.
fn sorted(columns: u32, blocks: &[Block]) -> Vec<Block> {
    let mut ends = vec![0; columns as usize + 1];
    for block in blocks {
        ends[block.x0 as usize + 1] += 1;
    }
    for column in 1..ends.len() {
        ends[column] += ends[column - 1];
    }
    let mut sorted = blocks.to_vec();
    for block in blocks {
        let place: &mut usize = &mut ends[block.x0 as usize];
        sorted[*place] = *block;
        *place += 1;
    }
    for equals in sorted.chunk_by_mut(|a, b| a.x0 == b.x0) {
        equals.sort_unstable();
    }
    sorted
}
