//! Why there is no way: how wide the widest is, and where it is narrowest.

use super::clearance::Clearance;
use crate::geometry::tolerance::{ROUNDING, ROUNDING_M};
use crate::geometry::{Point, Rect};
use crate::search::bottleneck::best_way;
use crate::search::grid::beside;
use crate::world::World;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrowest {
    /// Width of the widest disc that passes, metres, clearance not taken off.
    pub width: f64,
    /// Where it touches.
    pub at: Point,
}

/// Steps along the way on both sides of a narrow point that are searched anew, on a finer lattice.
const MARGIN: usize = 5;
/// Over so many metres on both sides it is found in which direction there is more room.
const SLOPE_M: f64 = 1e-6;
/// So often the stretch is made shorter by a third on which a gap's middle lies.
const HALVINGS: usize = 48;
/// Fine steps in a coarse one.
const FINER: usize = 8;

/// The widest way between two points, bridges ignored: of all ways the one whose least width is greatest.
///
/// # Arguments
/// `step` is the side of the lattice on which ways are searched, metres, such as that of the layers.
///
/// # Returns
/// The narrowest point of that way; `None` where no way is wider than a step.
pub fn narrowest(world: &World, from: Point, to: Point, step: f64) -> Option<Narrowest> {
    let walls = Clearance::new(world);
    let mut way = search(&walls, world.bounds, (from, to), step)?;
    let mut refined = vec![false; way.len()];
    loop {
        let least = middle_of_least(&way)?;
        let (at, clearance) = way[least];
        let (first, last) = (least.saturating_sub(MARGIN), (least + MARGIN).min(way.len() - 1));
        if refined[least] || first == last {
            let within = clearance + step / FINER as f64;
            let inner = way.get(1..way.len() - 1).unwrap_or_default();
            let narrow = inner.iter().filter(|(_, known)| *known <= within);
            let mut settled: Vec<(Point, f64)> =
                narrow.map(|&(p, known)| centred(&walls, (p, known), step)).collect();
            // where they begin and end ways are told, and not to be moved
            settled.extend([way[0], way[way.len() - 1]]);
            let (at, clearance) = middle_of_least(&settled).map_or((at, clearance), |least| settled[least]);
            return Some(Narrowest { width: 2.0 * clearance, at });
        }
        // The ends of the window may lie in a wrong place of a narrow; what is between them is settled.
        refined[(first + 1).min(least)..last.max(least + 1)].fill(true);
        let end = |index: usize| {
            let is_given = index == 0 || index == way.len() - 1;
            if is_given { way[index].0 } else { climb(&walls, way[index].0, step) }
        };
        let ends = (end(first), end(last));
        let window =
            Rect::around(way[first..=last].iter().map(|(p, _)| *p).chain([ends.0, ends.1])).grown(2.0 * step);
        let finer = search(&walls, window, ends, step / FINER as f64);
        let best = finer.and_then(|finer| finer.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)));
        if let Some((at, clearance)) = best {
            for (point, known) in way[first..=last].iter_mut().filter(|(_, known)| *known < clearance) {
                (*point, *known) = (at, clearance);
            }
        }
    }
}

/// The middle of the first stretch of the way that has the least clearance: where a long gap is narrow, rather than
/// where the way first comes as near to a wall.
fn middle_of_least(way: &[(Point, f64)]) -> Option<usize> {
    let least = way.iter().map(|(_, clearance)| *clearance).min_by(f64::total_cmp)?;
    let is_least = |(_, clearance): &(Point, f64)| *clearance <= least + ROUNDING_M;
    let first = way.iter().position(is_least)?;
    let length = way[first..].iter().take_while(|point| is_least(point)).count();
    Some(first + length / 2)
}

/// A point of a lattice, moved straight away from the nearest wall to the middle of the gap in which it lies.
fn centred(walls: &Clearance, (at, known): (Point, f64), step: f64) -> (Point, f64) {
    let beside = |dx: f64, dy: f64| walls.at(Point::new(at.x + dx, at.y + dy));
    let slope = Point::new(
        beside(SLOPE_M, 0.0) - beside(-SLOPE_M, 0.0),
        beside(0.0, SLOPE_M) - beside(0.0, -SLOPE_M),
    );
    let steep = slope.x.hypot(slope.y);
    if steep < ROUNDING_M {
        return (at, known);
    }
    let along = |metres: f64| {
        let p = Point::new(at.x + slope.x / steep * metres, at.y + slope.y / steep * metres);
        (p, walls.at(p))
    };
    let (mut low, mut high) = (0.0, step);
    for _ in 0..HALVINGS {
        let [one, other] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if along(one).1 < along(other).1 { low = one } else { high = other }
    }
    let found = along(f64::midpoint(low, high));
    if found.1 > known { found } else { (at, known) }
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
        &|a: usize, b: usize| clearance(a) + clearance(b) > point(a).distance(point(b)) * (1.0 + ROUNDING);
    let neighbours = |node: usize| beside(node, (columns, rows)).filter(move |&next| joined(node, next));
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
