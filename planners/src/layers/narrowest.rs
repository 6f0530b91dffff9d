//! Why there is no way: how wide and how high the best way is, and where it is narrowest or lowest.

use super::bottleneck::best_way;
use super::clearance::Clearance;
use super::free_space::Solid;
use super::lattice::Lattice;
use crate::geometry::{Point, Rect};
use crate::world::World;

/// The narrowest point of the widest way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrowest {
    /// Width of the widest disc that passes, metres, clearance not taken off.
    pub width: f64,
    /// Where it touches.
    pub at: Point,
}

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

/// Steps along the way on both sides of a narrow point that are searched anew, on a finer lattice.
const MARGIN: usize = 5;
/// Fine steps in a coarse one.
const FINER: usize = 8;

/// The widest way between two points, bridges ignored: of all ways the one whose least width is greatest.
///
/// # Arguments
/// `step` is the side of the lattice on which ways are searched, metres, such as that of the layers.
///
/// # Returns
/// The narrowest point of that way, to about an eighth of `step`; `None` where no way is wider than a step.
pub fn narrowest(world: &World, from: Point, to: Point, step: f64) -> Option<Narrowest> {
    let walls = Clearance::new(world);
    let mut way = search(&walls, world.bounds, (from, to), step)?;
    let mut refined = vec![false; way.len()];
    loop {
        let least = (0..way.len()).min_by(|&a, &b| way[a].1.total_cmp(&way[b].1))?;
        let (at, clearance) = way[least];
        let (first, last) = (least.saturating_sub(MARGIN), (least + MARGIN).min(way.len() - 1));
        if refined[least] || first == last {
            return Some(Narrowest { width: 2.0 * clearance, at });
        }
        refined[least] = true;
        let end = |index: usize| {
            let is_given = index == 0 || index == way.len() - 1;
            if is_given { way[index].0 } else { climb(&walls, way[index].0, step) }
        };
        let ends = (end(first), end(last));
        let window = window(way[first..=last].iter().map(|(p, _)| *p).chain([ends.0, ends.1]), 2.0 * step);
        let finer = search(&walls, window, ends, step / FINER as f64);
        let best = finer.and_then(|finer| finer.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)));
        if let Some((at, clearance)) = best {
            for (point, known) in way[first..=last].iter_mut().filter(|(_, known)| *known < clearance) {
                (*point, *known) = (at, clearance);
            }
        }
    }
}

/// Searches `window` on a lattice of its own. The way has each point's clearance, the ends included.
fn search(
    walls: &Clearance,
    window: Rect,
    (from, to): (Point, Point),
    step: f64,
) -> Option<Vec<(Point, f64)>> {
    if !window.contains(from) || !window.contains(to) {
        return None;
    }
    let columns = (window.dx() / step).ceil().max(1.0) as usize;
    let rows = (window.dy() / step).ceil().max(1.0) as usize;
    let along = |node: usize, count: usize, low: f64, high: f64| {
        low + (node as f64 + 0.5) * (high - low) / count as f64
    };
    let point = |node: usize| {
        let (column, row) = (node % columns, node / columns);
        Point::new(along(column, columns, window.x0, window.x1), along(row, rows, window.y0, window.y1))
    };
    let node = |p: Point| {
        let column = ((p.x - window.x0) / window.dx() * columns as f64) as usize;
        let row = ((p.y - window.y0) / window.dy() * rows as f64) as usize;
        row.min(rows - 1) * columns + column.min(columns - 1)
    };
    let known = std::cell::RefCell::new(vec![f64::NAN; columns * rows]);
    let clearance = |node: usize| {
        let mut known = known.borrow_mut();
        if known[node].is_nan() {
            known[node] = walls.at(point(node));
        }
        known[node]
    };
    // Where the discs of two points overlap there is no wall between the points.
    let joined =
        |a: usize, b: usize| clearance(a) + clearance(b) > point(a).distance(point(b)) * (1.0 + 1e-9);
    let neighbours = |node: usize| {
        let (column, row) = (node % columns, node / columns);
        let left = (column > 0).then(|| node - 1);
        let right = (column + 1 < columns).then(|| node + 1);
        let below = (row > 0).then(|| node - columns);
        let above = (row + 1 < rows).then(|| node + columns);
        [left, right, below, above].into_iter().flatten().filter(move |&next| joined(node, next))
    };
    let nodes = best_way(columns * rows, (node(from), node(to)), clearance, neighbours)?;
    let inner = nodes.iter().map(|&node| (point(node), clearance(node)));
    let ends = |p: Point| std::iter::once((p, walls.at(p)));
    Some(ends(from).chain(inner).chain(ends(to)).collect())
}

/// A point not further than about a step where the clearance is greater, by going uphill.
fn climb(walls: &Clearance, from: Point, step: f64) -> Point {
    let fine = step / FINER as f64;
    let mut best = (from, walls.at(from));
    for _ in 0..FINER {
        let here = best.0;
        for (dx, dy) in [(fine, 0.0), (-fine, 0.0), (0.0, fine), (0.0, -fine)] {
            let p = Point::new(here.x + dx, here.y + dy);
            let clearance = walls.at(p);
            if clearance > best.1 {
                best = (p, clearance);
            }
        }
    }
    best.0
}

fn window(points: impl Iterator<Item = Point>, margin: f64) -> Rect {
    let nothing = Rect::new(f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
    points.fold(nothing, |r, p| {
        Rect::new(
            r.x0.min(p.x - margin),
            r.y0.min(p.y - margin),
            r.x1.max(p.x + margin),
            r.y1.max(p.y + margin),
        )
    })
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
    let neighbours = |node: usize| {
        let (column, row) = (node % columns, node / columns);
        let left = (column > 0).then(|| node - 1);
        let right = (column + 1 < columns).then(|| node + 1);
        let below = (row > 0).then(|| node - columns);
        let above = (row + 1 < rows).then(|| node + columns);
        [left, right, below, above].into_iter().flatten().filter(|&next| is_free(next))
    };
    let Some(way) = best_way(columns * rows, (start, goal), height, neighbours) else {
        return Ok(Headroom::NoWay);
    };
    let lowest = way.into_iter().min_by(|&a, &b| height(a).total_cmp(&height(b)));
    Ok(match lowest.map(|node| (height(node), centre(node))) {
        Some((height, at)) if height.is_finite() => Headroom::Limited { height, at },
        _ => Headroom::Unlimited,
    })
}
