//! What is looked at from the points of a large face, since what is seen from all of them grows with the square.

use rstar::RTree;
use rstar::primitives::GeomWithData;
use spade::Triangulation;

use super::face::Face;
use super::merged::triangulate;
use crate::search::Csr;

/// Of so many corners that are nearest to a corner those are looked at that one cut may resolve together with it.
const NEAREST: usize = 96;

/// For each point of a large face, by index and in order, those to which an edge of a triangulation leads and, of a corner, the
/// corners near it; `None` of a face that is small enough that all is looked at from everywhere.
pub(super) fn near(face: &Face) -> Option<Csr<u32>> {
    if !face.is_large() {
        return None;
    }
    let mut joined: Vec<(usize, u32)> = Vec::new();
    if let Some((cdt, handles)) = triangulate(face) {
        let mut nodes = vec![0; cdt.num_vertices()];
        for (node, handle) in (0_u32..).zip(&handles) {
            nodes[handle.index()] = node;
        }
        for edge in cdt.directed_edges() {
            let [from, to] = [edge.from(), edge.to()].map(|vertex| nodes[vertex.fix().index()]);
            joined.push((from as usize, to));
        }
    }
    let at = |node: u32| {
        let p = face.points[node as usize];
        [p.x, p.y]
    };
    let corners =
        (0_u32..).zip(&face.corners).map(|(number, corner)| GeomWithData::new(at(corner.node), number));
    let index = RTree::bulk_load(corners.collect());
    for (number, corner) in (0_u32..).zip(&face.corners) {
        let nearest = index.nearest_neighbor_iter(at(corner.node)).take(NEAREST).map(|other| other.data);
        let joins = nearest.filter(|&other| other != number && face.may_be_joined([number, other]));
        for other in joins.map(|other| face.corners[other as usize].node) {
            joined.extend([(corner.node as usize, other), (other as usize, corner.node)]);
        }
    }
    joined.sort_unstable();
    joined.dedup();
    Some(Csr::new(face.points.len(), joined))
}
