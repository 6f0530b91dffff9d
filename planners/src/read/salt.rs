//! Salt: lone wall pixels that a sensor or an image's way through programs left on the floor by chance.
//!
//! Legs of tables are lone pixels, too, but they stand in groups, and with a few pixels' distance. Chance spreads its pixels
//! evenly: counted tile by tile, their number varies as that of throws of dice does.

use crate::world::Occupancy;

/// Wall cells that are joined over edges and corners.
pub(crate) type Blob = Vec<usize>;

/// Fewer lone pixels than this are no salt, whatever their places.
pub(crate) const LEAST: usize = 50;

/// Variance over mean of the lone pixels' number, tile by tile: 1 for chance; 3.7 and more on the furnished maps that we
/// have, up to 1.5 where salt of a thousandth of the pixels was strewn on floors.
const MOST_UNEVEN: f64 = 1.75;

/// Lone pixels that a tile would have on average.
const A_TILE: f64 = 4.0;

/// Of fewer tiles nobody says how even they are.
const LEAST_TILES: usize = 8;

/// In how many ways blobs of 1, 2, ... pixels may lie: fixed polyplets, <https://oeis.org/A006770>.
const SHAPES: [f64; 5] = [1.0, 4.0, 20.0, 110.0, 638.0];

/// Of what chance makes fewer than this, none is its.
const LIKELY: f64 = 0.5;

/// Pixels a side: a blob of salt is at most so large.
pub(crate) const LARGEST: usize = SHAPES.len();

/// What the lone pixels of an image are.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Salt {
    /// Too few to tell.
    None,
    /// So unevenly spread that they stand for something.
    Things,
    /// Chance, on this share of the floor's pixels.
    Chance { share: f64, specks: Vec<Blob> },
}

impl Salt {
    /// Looks at the blobs of at most [`LARGEST`] pixels.
    pub(crate) fn of(walls: &Occupancy, mut small: Vec<Blob>) -> Self {
        let mut observed = [0; LARGEST];
        for blob in &small {
            observed[blob.len() - 1] += 1;
        }
        if observed[0] < LEAST {
            return Self::None;
        }
        let mut large = walls.blocked.clone();
        for &cell in small.iter().flatten() {
            large[cell] = false;
        }
        // where a pixel would be alone, or part of a small blob
        let floor: Vec<bool> = (0..large.len())
            .map(|cell| !large[cell] && ring(walls, &large, cell) == Some([false; 8]))
            .collect();
        let places = floor.iter().filter(|&&open| open).count() as f64;
        let share = observed[0] as f64 / places;
        if unevenness(walls, &small, &floor, share) > MOST_UNEVEN {
            return Self::Things;
        }
        let is_chance = |index: usize| {
            let expected = places * SHAPES[index] * share.powi(index as i32 + 1);
            index == 0 || is_of_chance(observed[index], expected)
        };
        small.retain(|blob| is_chance(blob.len() - 1));
        let touching = |cell: &usize| touches_a_wall(walls, &large, *cell);
        let (bumps, free): (Vec<usize>, Vec<usize>) =
            (0..large.len()).filter(touching).partition(|&cell| large[cell]);
        if is_of_chance(bumps.len(), free.len() as f64 * share) {
            small.extend(bumps.into_iter().map(|cell| vec![cell]));
        }
        Self::Chance { share, specks: small }
    }
}

/// Whether there are no more than chance makes.
fn is_of_chance(observed: usize, expected: f64) -> bool {
    expected >= LIKELY && observed as f64 <= expected + 3.0 * expected.sqrt() + 1.0
}

/// Which cells about one are walls, counterclockwise from the right; `None` at the border.
fn ring(walls: &Occupancy, of: &[bool], cell: usize) -> Option<[bool; 8]> {
    about(walls, cell).map(|ring| ring.map(|cell| of[cell]))
}

/// The cells about one, counterclockwise from the right; `None` at the border.
fn about(walls: &Occupancy, cell: usize) -> Option<[usize; 8]> {
    let (columns, column, row) = (walls.columns, cell % walls.columns, cell / walls.columns);
    if column == 0 || row == 0 || column + 1 == columns || row + 1 == walls.rows {
        return None;
    }
    let (up, down) = (cell + columns, cell - columns);
    Some([cell + 1, up + 1, up, up - 1, cell - 1, down - 1, down, down + 1])
}

/// Whether a pixel sticks out of a straight wall alone, or touches the corner of a thick one with its own. The end of a thin wall
/// does not, however that is slanted.
fn touches_a_wall(walls: &Occupancy, large: &[bool], cell: usize) -> bool {
    let Some(cells) = about(walls, cell) else { return false };
    let ring = cells.map(|cell| large[cell]);
    let lies_on = |side: usize| ring[(side + 7) % 8] && ring[side] && ring[(side + 1) % 8];
    let is_thick = |at: usize| {
        let beside = about(walls, cells[at]);
        beside.is_some_and(|beside| beside.iter().filter(|&&of| of != cell && large[of]).count() >= 3)
    };
    match ring.iter().filter(|&&is_wall| is_wall).count() {
        3 => [0, 2, 4, 6].into_iter().any(lies_on),
        1 => [1, 3, 5, 7].into_iter().any(|at| ring[at] && is_thick(at)),
        _ => false,
    }
}

/// Variance over mean of the lone pixels' number in tiles, as far as these have floor.
fn unevenness(walls: &Occupancy, small: &[Blob], floor: &[bool], share: f64) -> f64 {
    let side = ((A_TILE / share).sqrt() as usize).max(4);
    let across = walls.columns.div_ceil(side);
    let tile = |cell: usize| cell / walls.columns / side * across + cell % walls.columns / side;
    let mut tiles = vec![(0.0, 0.0); across * walls.rows.div_ceil(side)];
    for cell in (0..floor.len()).filter(|&cell| floor[cell]) {
        tiles[tile(cell)].0 += share;
    }
    for blob in small.iter().filter(|blob| blob.len() == 1) {
        tiles[tile(blob[0])].1 += 1.0;
    }
    tiles.retain(|(expected, _)| *expected >= 1.0);
    if tiles.len() < LEAST_TILES {
        return f64::INFINITY;
    }
    let total = |of: fn(&(f64, f64)) -> f64| tiles.iter().map(of).sum::<f64>();
    let scale = total(|tile| tile.1) / total(|tile| tile.0);
    let off = |&(expected, found): &(f64, f64)| (found - expected * scale).powi(2) / (expected * scale);
    tiles.iter().map(off).sum::<f64>() / (tiles.len() - 1) as f64
}
