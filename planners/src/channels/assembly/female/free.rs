//! The free space of a female part.

use super::error::FemaleError;
use crate::channels::assembly::{Cuboid, Edge};
use crate::geometry::polygon::spans;
use crate::geometry::{Point, Rect, Segment};
use crate::prime_areas::maximal_rects;

/// The free space within a frame, as maximal rectangles.
pub(super) struct FreeSpace {
    pub(super) rects: Vec<Cuboid<2>>,
    pub(super) frame: Cuboid<2>,
    pub(super) tolerance: f64,
    solid: Vec<Cuboid<2>>,
    slopes: Vec<Edge>,
}

impl FreeSpace {
    pub(super) fn new(frame: Cuboid<2>, edges: &[Edge], tolerance: f64) -> Self {
        let edges = straightened(edges, tolerance);
        let is_slope = |edge: &&Edge| edge.hull().is_solid();
        let slopes: Vec<Edge> = edges.iter().filter(is_slope).copied().collect();
        let solid = solid(&edges);
        let blocked = solid.iter().copied().chain(slopes.iter().map(Edge::hull));
        let blocked: Vec<Rect> = blocked.map(|block| rect(&block)).collect();
        let rects = maximal_rects(rect(&frame), &blocked);
        let rects = rects.iter().map(|rect| Cuboid::new([rect.x0, rect.y0], [rect.x1, rect.y1])).collect();
        Self { rects, frame, tolerance, solid, slopes }
    }

    /// Whether the part lies in a rectangle, but for rounding.
    pub(super) fn holds(&self, rect: &Cuboid<2>, part: &Cuboid<2>) -> bool {
        rect.excess(part) <= self.tolerance
    }

    /// Says what the part lies in where it does not lie in free space.
    pub(super) fn check(&self, part: &Cuboid<2>) -> Result<(), FemaleError> {
        if self.rects.iter().any(|rect| self.holds(rect, part)) {
            return Ok(());
        }
        let meets = |block: &Cuboid<2>| block.intersection(part);
        if let Some(edge) = self.slopes.iter().find(|edge| meets(&edge.hull()).is_some()) {
            return Err(FemaleError::Sloped { edge: *edge, part: *part, height: None });
        }
        let depth = |block: &Cuboid<2>| meets(block).map(|common| common.size(0).min(common.size(1)));
        let walls = self.solid.iter().filter_map(|wall| Some((depth(wall)?, *wall)));
        Err(match walls.reduce(|deepest, wall| if wall.0 > deepest.0 { wall } else { deepest }) {
            Some((_, wall)) => FemaleError::PartInWall { part: *part, wall },
            None => FemaleError::PartOutside { part: *part, female: self.frame },
        })
    }

    /// Why nothing leads from the part to the top.
    pub(super) fn no_way(&self, part: &Cuboid<2>) -> FemaleError {
        let reached = self.reached_from(part);
        let height = reached.iter().map(|rect| rect.max[1]).fold(part.max[1], f64::max);
        let touches = |edge: &&Edge| reached.iter().any(|rect| gap(rect, &edge.hull()) <= self.tolerance);
        match self.slopes.iter().find(touches) {
            Some(edge) => FemaleError::Sloped { edge: *edge, part: *part, height: Some(height) },
            None => FemaleError::Closed { part: *part, height, top: self.frame.max[1] },
        }
    }

    fn reached_from(&self, part: &Cuboid<2>) -> Vec<Cuboid<2>> {
        let (mut waiting, mut rest): (Vec<_>, Vec<_>) =
            self.rects.iter().copied().partition(|rect| self.holds(rect, part));
        let mut reached = Vec::new();
        while let Some(rect) = waiting.pop() {
            let (next, others) = rest.iter().partition(|other| rect.intersection(other).is_some());
            waiting.extend::<Vec<_>>(next);
            rest = others;
            reached.push(rect);
        }
        reached
    }
}

/// How far two boxes are apart along the axis along which they are furthest apart.
fn gap(a: &Cuboid<2>, b: &Cuboid<2>) -> f64 {
    (0..2).map(|axis| (b.min[axis] - a.max[axis]).max(a.min[axis] - b.max[axis])).fold(f64::MIN, f64::max)
}

/// The edges with coordinates that are meant to be equal made equal, so that rounding slopes nothing.
fn straightened(edges: &[Edge], tolerance: f64) -> Vec<Edge> {
    let mut edges = edges.to_vec();
    for axis in 0..2 {
        let mut values: Vec<f64> = edges.iter().map(|edge| edge.from[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.dedup_by(|next, value| *next - *value <= tolerance);
        let snapped = |value: f64| values[values.partition_point(|&first| first <= value).max(1) - 1];
        for edge in &mut edges {
            edge.from[axis] = snapped(edge.from[axis]);
            edge.to[axis] = snapped(edge.to[axis]);
        }
    }
    edges
}

/// The inside of the outline, row by row between its corners. Slopes bound it where they cross the middle of the row.
fn solid(edges: &[Edge]) -> Vec<Cuboid<2>> {
    let mut heights: Vec<f64> = edges.iter().map(|edge| edge.from[1]).collect();
    heights.sort_unstable_by(f64::total_cmp);
    heights.dedup();
    let mut solid = Vec::new();
    for row in heights.windows(2) {
        let point = |[x, z]: [f64; 2]| Point::new(x, z);
        let sides = edges.iter().map(|edge| Segment::new(point(edge.from), point(edge.to)));
        let inside = spans(sides, f64::midpoint(row[0], row[1]));
        solid.extend(inside.into_iter().map(|[x0, x1]| Cuboid::new([x0, row[0]], [x1, row[1]])));
    }
    solid
}

fn rect(cuboid: &Cuboid<2>) -> Rect {
    Rect::new(cuboid.min[0], cuboid.min[1], cuboid.max[0], cuboid.max[1])
}
