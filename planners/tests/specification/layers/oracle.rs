//! Ways in configuration space by breadth-first search on a fine grid with exact distances, by the `geo` crate.

use adit_planners::geometry::{Point, Rect};
use adit_planners::layers::State;
use adit_planners::world::{Shape, World};
use geo::{Coord, Distance, Euclidean, LineString, Polygon};

/// How many steps of the search a cell of the layers has.
const FINER: f64 = 4.0;

/// Distance of a point from everything that a state cannot pass, the edge included.
pub fn clearance(world: &World, state: &State, p: Point) -> f64 {
    let low = world.bridges.iter().filter(|bridge| bridge.height <= state.height);
    let low = low.map(|bridge| distance(&outline(&Shape::Rect(bridge.rect)), p));
    low.fold(wall_distance(&outlines(world), world.bounds, p), f64::min)
}

fn outlines(world: &World) -> Vec<Polygon<f64>> {
    world.obstacles.iter().map(|obstacle| outline(&obstacle.shape)).collect()
}

fn outline(shape: &Shape) -> Polygon<f64> {
    let ring: Vec<(f64, f64)> = match shape {
        Shape::Rect(r) => vec![(r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1)],
        Shape::Polygon(corners) => corners.iter().map(|p| (p.x, p.y)).collect(),
    };
    Polygon::new(LineString::from(ring), Vec::new())
}

fn distance(outline: &Polygon<f64>, p: Point) -> f64 {
    Euclidean.distance(&geo::Point(Coord { x: p.x, y: p.y }), outline)
}

fn wall_distance(walls: &[Polygon<f64>], b: Rect, p: Point) -> f64 {
    let edge = (p.x - b.x0).min(b.x1 - p.x).min(p.y - b.y0).min(b.y1 - p.y);
    walls.iter().map(|wall| distance(wall, p)).fold(edge, f64::min)
}

/// The connected parts of configuration space, once with everything a bit wider, once a bit slimmer.
pub struct Oracle {
    bounds: Rect,
    columns: usize,
    step: f64,
    surely: Vec<Option<usize>>,
    perhaps: Vec<Option<usize>>,
    nodes: usize,
}

impl Oracle {
    /// `grid` is the side of the layers' cells: the limits within which an answer may differ follow from it.
    pub fn new(world: &World, states: &[State], grid: f64) -> Self {
        let step = grid / FINER;
        let bounds = world.bounds;
        let (columns, rows) = ((bounds.dx() / step).round() as usize, (bounds.dy() / step).round() as usize);
        let centre = |node: usize| {
            let along = |low: f64, count: usize| low + (count as f64 + 0.5) * step;
            Point::new(along(bounds.x0, node % columns), along(bounds.y0, node / columns))
        };
        let walls = outlines(world);
        let to_wall: Vec<f64> =
            (0..columns * rows).map(|node| wall_distance(&walls, bounds, centre(node))).collect();
        // What a state has beyond its width, negative where it does not fit.
        let spare: Vec<f64> = states
            .iter()
            .flat_map(|state| {
                let low: Vec<_> = world.bridges.iter().filter(|b| b.height <= state.height).collect();
                let low: Vec<_> = low.iter().map(|bridge| outline(&Shape::Rect(bridge.rect))).collect();
                let keep = state.width / 2.0 + world.clearance;
                let to_wall = &to_wall;
                (0..columns * rows).map(move |node| {
                    let to_low = low.iter().map(|bridge| distance(bridge, centre(node)));
                    to_low.fold(to_wall[node], f64::min) - keep
                })
            })
            .collect();
        // A cell is whole where its diagonal is spare; half a step passes between two nodes. Thin rooms may be
        // missing within two more cells of the limit, and with them the change of shape there.
        let (diagonal, between) = (grid * 2f64.sqrt(), step / 2.0);
        let surely = parts(&spare, (columns, rows), diagonal + between, 3.0 * diagonal + between);
        let perhaps = parts(&spare, (columns, rows), -step, -step);
        Self { bounds, columns, step, surely, perhaps, nodes: columns * rows }
    }

    /// Whether there is a way even for wider states.
    pub fn is_surely_way(&self, from: (usize, Point), to: (usize, Point)) -> bool {
        self.is_way(&self.surely, from, to)
    }

    /// Whether there is a way for slimmer states.
    pub fn is_perhaps_way(&self, from: (usize, Point), to: (usize, Point)) -> bool {
        self.is_way(&self.perhaps, from, to)
    }

    fn is_way(&self, parts: &[Option<usize>], from: (usize, Point), to: (usize, Point)) -> bool {
        let part = |(state, p): (usize, Point)| {
            let column = ((p.x - self.bounds.x0) / self.step) as usize;
            let row = ((p.y - self.bounds.y0) / self.step) as usize;
            parts[state * self.nodes + row * self.columns + column]
        };
        part(from).is_some() && part(from) == part(to)
    }
}

/// For each node of each state its connected part: nodes with `to_stay` to spare, joined over sides, and over states
/// where both have `to_change` to spare.
fn parts(spare: &[f64], (columns, rows): (usize, usize), to_stay: f64, to_change: f64) -> Vec<Option<usize>> {
    let nodes = columns * rows;
    let mut part = vec![None; spare.len()];
    for start in 0..spare.len() {
        if spare[start] < to_stay || part[start].is_some() {
            continue;
        }
        part[start] = Some(start);
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            let (node, column, row) = (at % nodes, at % columns, at % nodes / columns);
            let sides = [
                (column > 0).then(|| at - 1),
                (column + 1 < columns).then(|| at + 1),
                (row > 0).then(|| at - columns),
                (row + 1 < rows).then(|| at + columns),
            ];
            let changes = (0..spare.len() / nodes).map(|state| state * nodes + node);
            let changes = changes.filter(|&next| spare[at] >= to_change && spare[next] >= to_change);
            for next in sides.into_iter().flatten().chain(changes) {
                if spare[next] >= to_stay && part[next].is_none() {
                    part[next] = Some(start);
                    open.push(next);
                }
            }
        }
    }
    part
}
