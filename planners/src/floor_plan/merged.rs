//! A face as merged triangles (Hertel and Mehlhorn 1983): so many regions cuts for large regions may not exceed.

use std::f64::consts::{PI, TAU};

use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::face::{ANGLE, Face};
use crate::random::Xorshift;

/// Diagonals are dropped in so many random orders at least, and in more where they are few.
const FEWEST_ORDERS: usize = 20;
const MOST_ORDERS: usize = 200;
const DIAGONALS_TRIED: usize = 4_000;

pub(super) type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Triangles merged in the best of some orders.
pub(super) struct Merged {
    pub regions: usize,
    /// The diagonals that stay, by the face's nodes.
    pub diagonals: Vec<[u32; 2]>,
}

/// Merges triangles; `None` where the face cannot be triangulated as it is.
pub(super) fn merged(face: &Face) -> Option<Merged> {
    let (cdt, handles) = triangulate(face)?;
    let mut is_free = vec![false; cdt.num_all_faces()];
    let mut next = Vec::new();
    for side in &face.sides {
        let [a, b] = side.ends.map(|node| handles[node as usize]);
        let edge = cdt.get_edge_from_neighbors(a, b)?;
        let faces = [edge.face(), edge.rev().face()];
        next.extend(faces.iter().zip(side.free).filter(|(_, free)| *free).map(|(face, _)| face.fix()));
    }
    let (mut diagonals, mut triangles) = (Vec::new(), 0);
    while let Some(face) = next.pop() {
        if std::mem::replace(&mut is_free[face.index()], true) {
            continue;
        }
        triangles += 1;
        let inner = cdt.face(face).as_inner()?;
        for edge in inner.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge()) {
            let ends = [edge.from(), edge.to()].map(|vertex| vertex.fix().index());
            if ends[0] < ends[1] {
                diagonals.push(ends);
            }
            next.push(edge.rev().face().fix());
        }
    }
    diagonals.sort_unstable();
    diagonals.dedup();
    let merging = Merging::new(&cdt, &diagonals);
    let mut random = Xorshift::new();
    let mut order: Vec<usize> = (0..diagonals.len()).collect();
    let orders = (DIAGONALS_TRIED / diagonals.len().max(1)).clamp(FEWEST_ORDERS, MOST_ORDERS);
    let tries = (0..orders).map(|_| {
        random.shuffle(&mut order);
        merging.kept(&order)
    });
    let kept = tries.min_by_key(Vec::len)?;
    // Each diagonal that goes makes one region of two.
    let regions = triangles + kept.len() - diagonals.len();
    let node =
        |vertex: usize| handles.iter().position(|handle| handle.index() == vertex).map(|node| node as u32);
    let ends = |&diagonal: &usize| Some([node(diagonals[diagonal][0])?, node(diagonals[diagonal][1])?]);
    Some(Merged { regions, diagonals: kept.iter().map(ends).collect::<Option<_>>()? })
}

pub(super) fn triangulate(face: &Face) -> Option<(Cdt, Vec<FixedVertexHandle>)> {
    let mut cdt = Cdt::new();
    let insert = |point: &crate::geometry::Point| cdt.insert(Point2::new(point.x, point.y)).ok();
    let handles: Vec<FixedVertexHandle> = face.points.iter().map(insert).collect::<Option<_>>()?;
    for side in &face.sides {
        let [a, b] = side.ends.map(|node| handles[node as usize]);
        if !cdt.can_add_constraint(a, b) {
            return None;
        }
        cdt.add_constraint(a, b);
    }
    Some((cdt, handles))
}

/// Diagonals with the directions of all edges about their ends.
struct Merging {
    /// For each node the directions of its edges.
    spokes: Vec<Vec<f64>>,
    /// For each diagonal its ends, each with the direction there.
    diagonals: Vec<[(usize, f64); 2]>,
}

impl Merging {
    fn new(cdt: &Cdt, diagonals: &[[usize; 2]]) -> Self {
        let at: Vec<Point2<f64>> = cdt.vertices().map(|vertex| vertex.position()).collect();
        let direction = |from: usize, to: usize| (at[to].y - at[from].y).atan2(at[to].x - at[from].x);
        let mut spokes = vec![Vec::new(); at.len()];
        let fixed = cdt.undirected_edges().filter(|edge| edge.is_constraint_edge());
        let fixed = fixed.map(|edge| edge.vertices().map(|vertex| vertex.fix().index()));
        for [a, b] in fixed.chain(diagonals.iter().copied()) {
            spokes[a].push(direction(a, b));
            spokes[b].push(direction(b, a));
        }
        let ends = |&[a, b]: &[usize; 2]| [(a, direction(a, b)), (b, direction(b, a))];
        Self { spokes, diagonals: diagonals.iter().map(ends).collect() }
    }

    /// The diagonals that stay if they are tried in this order.
    fn kept(&self, order: &[usize]) -> Vec<usize> {
        let mut spokes = self.spokes.clone();
        let mut kept = Vec::new();
        for &diagonal in order {
            let ends = &self.diagonals[diagonal];
            if ends.iter().all(|&(node, direction)| is_convex_without(&spokes[node], direction)) {
                for &(node, direction) in ends {
                    spokes[node].retain(|spoke| spoke.total_cmp(&direction).is_ne());
                }
            } else {
                kept.push(diagonal);
            }
        }
        kept
    }
}

/// Whether at most half a turn is left where an edge goes.
fn is_convex_without(spokes: &[f64], gone: f64) -> bool {
    let (mut after, mut before) = (TAU, TAU);
    for spoke in spokes.iter().filter(|spoke| spoke.total_cmp(&gone).is_ne()) {
        let turned = (spoke - gone).rem_euclid(TAU);
        after = after.min(turned);
        before = before.min(TAU - turned);
    }
    after + before <= PI + ANGLE
}
