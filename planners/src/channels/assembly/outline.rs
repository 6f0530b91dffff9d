//! Outlines of parts as polygons, and what is wrong with them.

use std::fmt;

use geo::line_intersection::{LineIntersection, line_intersection};
use geo::{Coord, Line};

use super::Cuboid;

/// The box around a part with this outline, corner by corner (x, z): what moves in its stead.
pub fn bounding_box(outline: &[[f64; 2]]) -> Result<Cuboid<2>, OutlineError> {
    let edges = edges(outline)?;
    Ok(hull(&edges))
}

/// The box around edges, of which there is at least one.
pub(super) fn hull(edges: &[Edge]) -> Cuboid<2> {
    let around = edges.iter().map(Edge::hull);
    around.reduce(|hull, edge| hull.joined(&edge)).unwrap_or(Cuboid::new([0.0; 2], [0.0; 2]))
}

/// A side of an outline. Corners are numbered from 1, in the order that they were given in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The numbers of the corners that it joins.
    pub corners: [usize; 2],
    pub from: [f64; 2],
    pub to: [f64; 2],
}

impl Edge {
    /// The box around it; without an interior where it is parallel to an axis.
    pub fn hull(&self) -> Cuboid<2> {
        Cuboid::new(self.from, self.from).joined(&Cuboid::new(self.to, self.to))
    }

    fn line(&self) -> Line {
        Line::new(Coord::from(self.from), Coord::from(self.to))
    }

    /// Where two edges meet though they should not: anywhere but at a corner that they have in common.
    fn crosses(&self, other: &Self) -> Option<[f64; 2]> {
        match line_intersection(self.line(), other.line())? {
            LineIntersection::Collinear { intersection } => {
                Some([intersection.start.x, intersection.start.y])
            }
            LineIntersection::SinglePoint { intersection, .. } => {
                let follow = self.corners[1] == other.corners[0] || other.corners[1] == self.corners[0];
                (!follow).then_some([intersection.x, intersection.y])
            }
        }
    }
}

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([first, second], [x0, z0], [x1, z1]) = (self.corners, self.from, self.to);
        write!(f, "from corner {first} ({x0}, {z0}) to corner {second} ({x1}, {z1})")
    }
}

/// The edges of a simple polygon. A corner that repeats the one before it, or the first one at the end, is left out.
///
/// Complexity: O(n log n + p) for n corners and p pairs of edges that share values of x.
pub(super) fn edges(outline: &[[f64; 2]]) -> Result<Vec<Edge>, OutlineError> {
    if let Some(index) = outline.iter().position(|corner| !corner.iter().all(|value| value.is_finite())) {
        return Err(OutlineError::NotFinite { corner: index + 1, found: outline[index] });
    }
    let mut corners: Vec<(usize, [f64; 2])> = (1..).zip(outline.iter().copied()).collect();
    let same = |a: [f64; 2], b: [f64; 2]| a.partial_cmp(&b).is_some_and(std::cmp::Ordering::is_eq);
    corners.dedup_by(|next, corner| same(next.1, corner.1));
    if corners.len() > 1 && same(corners[0].1, corners[corners.len() - 1].1) {
        corners.pop();
    }
    if corners.len() < 3 {
        return Err(OutlineError::TooFew { corners: corners.len() });
    }
    let around = corners.iter().zip(corners.iter().cycle().skip(1));
    let edges: Vec<Edge> =
        around.map(|(from, to)| Edge { corners: [from.0, to.0], from: from.1, to: to.1 }).collect();
    match first_crossing(&edges) {
        Some((first, second, at)) => Err(OutlineError::CrossesItself { first, second, at }),
        None => Ok(edges),
    }
}

/// Of all edges that cross, those that come first in the outline.
fn first_crossing(edges: &[Edge]) -> Option<(Edge, Edge, [f64; 2])> {
    let mut order: Vec<usize> = (0..edges.len()).collect();
    let span = |index: usize| (edges[index].hull().min[0], edges[index].hull().max[0]);
    order.sort_by(|&a, &b| span(a).0.total_cmp(&span(b).0));
    let mut first: Option<((usize, usize), [f64; 2])> = None;
    for (place, &one) in order.iter().enumerate() {
        for &other in order[place + 1..].iter().take_while(|&&other| span(other).0 <= span(one).1) {
            let pair = (one.min(other), one.max(other));
            if first.is_none_or(|(found, _)| pair < found)
                && let Some(at) = edges[pair.0].crosses(&edges[pair.1])
            {
                first = Some((pair, at));
            }
        }
    }
    first.map(|((one, other), at)| (edges[one], edges[other], at))
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    #[error("corner {corner} is ({}, {}); expected finite numbers", found[0], found[1])]
    NotFinite {
        /// Its number, from 1.
        corner: usize,
        found: [f64; 2],
    },
    #[error("the outline has {corners} distinct corners; expected at least 3")]
    TooFew { corners: usize },
    #[error("the outline crosses or touches itself at ({}, {}): the edge {first} and the edge {second}", at[0], at[1])]
    CrossesItself { first: Edge, second: Edge, at: [f64; 2] },
}
