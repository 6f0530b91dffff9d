//! Solid things: their common outline, and what of a wall lies outside of it.

use geo::{Contains, Coord, Intersects, LineString, MultiPolygon, Polygon};

use super::noding::crossing;
use crate::geometry::Point;
use crate::geometry::polygon::to_geo;
use crate::geometry::tolerance::SNAP_M;

/// Solids that overlap or touch made one, each outline counterclockwise.
pub(super) fn union(solids: &[Vec<Point>]) -> MultiPolygon {
    use geo::orient::{Direction, Orient};
    let polygons: Vec<Polygon> = solids.iter().map(|solid| to_geo(solid)).collect();
    let apart = |i: usize| polygons[i + 1..].iter().all(|other| !polygons[i].intersects(other));
    let all = if (0..polygons.len()).all(apart) {
        // What need not be joined keeps its coordinates to the bit.
        MultiPolygon::new(polygons)
    } else {
        geo::unary_union(&polygons)
    };
    all.orient(Direction::Default)
}

/// What of a wall lies outside of solids, and not on an outline of them.
pub(super) fn outside([a, b]: [Point; 2], solids: &MultiPolygon) -> Vec<[Point; 2]> {
    let line = geo::Line::new(a, b);
    if !solids.intersects(&line) {
        return vec![[a, b]];
    }
    let rim: Vec<[Point; 2]> = rims(solids).collect();
    let mut stops = vec![a, b];
    for &[c, d] in &rim {
        stops.extend([c, d].into_iter().filter(|&p| p.distance(p.nearest_on(a, b)) <= SNAP_M));
        stops.extend(crossing([a, b], [c, d]));
    }
    stops.sort_by(|p, q| a.distance(*p).total_cmp(&a.distance(*q)));
    let is_outside = |[p, q]: [Point; 2]| {
        let middle = p.midpoint(q);
        let is_on_rim = rim.iter().any(|&[c, d]| middle.distance(middle.nearest_on(c, d)) <= SNAP_M);
        p.distance(q) > SNAP_M && !is_on_rim && !solids.contains(&Coord::from(middle))
    };
    stops.windows(2).map(|part| [part[0], part[1]]).filter(|&part| is_outside(part)).collect()
}

/// The outlines, with what is solid to the left.
pub(super) fn rims(solids: &MultiPolygon) -> impl Iterator<Item = [Point; 2]> + '_ {
    let rings = solids.iter().flat_map(|solid| std::iter::once(solid.exterior()).chain(solid.interiors()));
    let lines = rings.flat_map(LineString::lines);
    lines.map(|line| [line.start, line.end].map(|c| Point::new(c.x, c.y)))
}
