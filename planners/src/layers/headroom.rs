//! Why a state is too tall: how high the best way is, and where it is lowest.

use super::free_space::Solid;
use super::lattice::Lattice;
use crate::geometry::Point;
use crate::search::bottleneck::best_way;
use crate::search::grid::beside;
use crate::world::World;

/// How high a robot may be on the highest way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Headroom {
    /// No way is wide enough, whatever the height.
    NoWay,
    /// There is a way without a bridge.
    Unlimited,
    /// Every way leads under a bridge; the highest of them is passed by what is lower than this.
    Limited {
        /// Metres.
        height: f64,
        /// Where the way is under that bridge.
        at: Point,
    },
}

/// How high a robot of a given width may be on the way, between two points, that allows most.
///
/// # Arguments
/// `width` in metres, to which the world's clearance comes; `step` is the side of the cells in which ways are
/// searched, metres, such as that of the layers. A point too near to a wall counts as the nearest free cell within
/// two cells.
pub fn headroom(world: &World, from: Point, to: Point, width: f64, step: f64) -> Result<Headroom, String> {
    let lattice = Lattice::new(world.bounds, step)?;
    let keep = width / 2.0 + world.clearance;
    let free = Solid::new(world, lattice).free_cells(keep, &[]);
    let (columns, rows) = (lattice.columns() as usize, lattice.rows() as usize);
    let centre = |node: usize| lattice.centre((node % columns) as u32, (node / columns) as u32);
    let is_free = |node: usize| free.contains((node % columns) as u32, (node / columns) as u32);
    let near = |p: Point| {
        let reach = 2.5 * step;
        let rows = lattice.rows_about(p.y - reach, p.y + reach);
        let nodes = rows.flat_map(|row| {
            let columns_there = lattice.columns_about(p.x - reach, p.x + reach);
            columns_there.map(move |column| row as usize * columns + column as usize)
        });
        let free = nodes.filter(|&node| is_free(node) && centre(node).distance(p) <= reach * 2f64.sqrt());
        free.min_by(|&a, &b| centre(a).distance(p).total_cmp(&centre(b).distance(p)))
    };
    let (Some(start), Some(goal)) = (near(from), near(to)) else { return Ok(Headroom::NoWay) };
    let height = |node: usize| {
        let here = centre(node);
        let over = world.bridges.iter().filter(|b| b.rect.nearest_to(here).distance(here) < keep);
        over.map(|bridge| bridge.height).fold(f64::INFINITY, f64::min)
    };
    let neighbours = |node: usize| beside(node, (columns, rows)).filter(|&next| is_free(next));
    let Some(way) = best_way(columns * rows, (start, goal), height, neighbours) else {
        return Ok(Headroom::NoWay);
    };
    let lowest = way.into_iter().min_by(|&a, &b| height(a).total_cmp(&height(b)));
    Ok(match lowest.map(|node| (height(node), centre(node))) {
        Some((height, at)) if height.is_finite() => Headroom::Limited { height, at },
        _ => Headroom::Unlimited,
    })
}
