//! Free space cut into convex pieces: a constrained Delaunay triangulation, whose triangles are merged as long as they stay
//! convex (Hertel and Mehlhorn 1983), over the longest sides first: so what is narrow stays a door.

use std::collections::HashMap;

use geo::{ConvexHull, Coord, LineString};
use rstar::primitives::CachedEnvelope;
use rstar::{AABB, RTree, RTreeObject};
use spade::handles::{FixedVertexHandle, OUTER_FACE};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::grown::Rings;
use crate::geometry::polygon::{encloses, sides, without_straight};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Convex, Point, Segment, cross};

const NONE: u32 = u32::MAX;

/// The convex pieces of a free space.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    pub pieces: Vec<Convex>,
    /// Pieces (a < b) with the whole side that they share; ordered.
    pub doors: Vec<(u32, u32, Segment)>,
}

impl Pieces {
    /// # Arguments
    /// `free` is where free space lies, to the left of its rings; it is cut along `lines` besides.
    ///
    /// The error is one sentence.
    pub fn of(free: &Rings, lines: &[Segment]) -> Result<Self, String> {
        let cdt = triangulated(free, lines)?;
        let mut mesh = Mesh::new(&cdt, free);
        mesh.merge();
        Ok(mesh.pieces())
    }
}

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

fn triangulated(free: &Rings, lines: &[Segment]) -> Result<Cdt, String> {
    let mut numbers: HashMap<[u64; 2], usize> = HashMap::new();
    let (mut points, mut ends) = (Vec::new(), Vec::new());
    let mut number = |p: Point| {
        let [x, y] = [p.x, p.y].map(on_lattice);
        *numbers.entry([x.to_bits(), y.to_bits()]).or_insert_with(|| {
            points.push(Point2::new(x, y));
            points.len() - 1
        })
    };
    for side in free.iter().flat_map(|ring| sides(ring)).chain(lines.iter().copied()) {
        ends.push([number(side.a), number(side.b)]);
    }
    let mut cdt = Cdt::bulk_load_cdt(points, Vec::new())
        .map_err(|error| format!("the free space cannot be triangulated: {error}"))?;
    for [a, b] in ends.into_iter().filter(|[a, b]| a != b) {
        let [a, b] = [a, b].map(FixedVertexHandle::from_index);
        if !cdt.exists_constraint(a, b) {
            cdt.add_constraint_and_split(a, b, |p| Point2::new(on_lattice(p.x), on_lattice(p.y)));
        }
    }
    Ok(cdt)
}

/// The nearest whole nanometre. Sides that should lie on one line then do: where they are a rounding apart, spade may split
/// one at a crossing that it takes for a corner further off, and a line goes astray. Nor is anything nearer to 0 than
/// spade bears.
fn on_lattice(metres: f64) -> f64 {
    // 0 has one sign
    (metres * 1e9).round() / 1e9 + 0.0
}

/// A side of a piece, with the piece to its left.
#[derive(Clone, Copy)]
struct Half {
    from: u32,
    next: u32,
    before: u32,
    /// The piece; [`NONE`] where nothing is free.
    of: u32,
    /// Whether pieces may be merged over it.
    is_open: bool,
}

/// Pieces by their sides: that of number `n` and `n ^ 1` are two sides of one edge.
struct Mesh {
    points: Vec<Point>,
    halves: Vec<Half>,
    /// The triangles of a piece point to the first one, as a forest.
    piece_of: Vec<u32>,
}

impl Mesh {
    fn new(cdt: &Cdt, free: &Rings) -> Self {
        let points =
            cdt.vertices().map(|vertex| Point::new(vertex.position().x, vertex.position().y)).collect();
        let is_free = free_faces(cdt, free);
        let half = |edge: spade::handles::FixedDirectedEdgeHandle| {
            let edge = cdt.directed_edge(edge);
            let face = edge.face().fix();
            let of = if is_free[face.index()] { face.index() as u32 } else { NONE };
            Half {
                from: edge.from().fix().index() as u32,
                next: edge.next().fix().index() as u32,
                before: edge.prev().fix().index() as u32,
                of,
                is_open: !edge.is_constraint_edge(),
            }
        };
        let halves = cdt.fixed_directed_edges().map(half).collect();
        Self { points, halves, piece_of: (0..cdt.num_all_faces() as u32).collect() }
    }

    fn at(&self, half: u32) -> Point {
        self.points[self.halves[half as usize].from as usize]
    }

    fn length(&self, half: u32) -> f64 {
        self.at(half).distance(self.at(half ^ 1))
    }

    fn piece(&mut self, of: u32) -> u32 {
        let mut root = of;
        while self.piece_of[root as usize] != root {
            let up = self.piece_of[self.piece_of[root as usize] as usize];
            self.piece_of[root as usize] = up;
            root = up;
        }
        root
    }

    fn merge(&mut self) {
        let is_inner = |half: &u32| {
            let one = &self.halves[*half as usize];
            let other = &self.halves[*half as usize ^ 1];
            one.is_open && one.of != NONE && other.of != NONE
        };
        let edges = (0..self.halves.len() as u32).step_by(2);
        let mut inner: Vec<(f64, u32)> =
            edges.filter(is_inner).map(|half| (self.length(half), half)).collect();
        inner.sort_by(|one, two| two.0.total_cmp(&one.0).then(one.1.cmp(&two.1)));
        for (_, half) in inner {
            let (one, other) = (self.halves[half as usize], self.halves[half as usize ^ 1]);
            let (a, b) = (self.piece(one.of), self.piece(other.of));
            let is_convex = |before: u32, after: u32| self.is_convex(before, after);
            if a != b && is_convex(one.before, other.next) && is_convex(other.before, one.next) {
                self.join(one.before, other.next);
                self.join(other.before, one.next);
                self.piece_of[a.max(b) as usize] = a.min(b);
            }
        }
    }

    fn join(&mut self, before: u32, after: u32) {
        self.halves[before as usize].next = after;
        self.halves[after as usize].before = before;
    }

    /// Whether the ground turns left, or hardly right, from one side into the one after it.
    fn is_convex(&self, before: u32, after: u32) -> bool {
        let (a, b, c) = (self.at(before), self.at(after), self.at(after ^ 1));
        let turn = cross(a, b, c);
        turn >= 0.0 || -turn <= ROUNDING_M * a.distance(c)
    }

    fn pieces(mut self) -> Pieces {
        let mut outlines = Vec::new();
        let mut number = vec![NONE; self.piece_of.len()];
        let mut is_walked = vec![false; self.halves.len()];
        for first in 0..self.halves.len() as u32 {
            let of = self.halves[first as usize].of;
            if of == NONE || is_walked[first as usize] || self.is_gone(first) {
                continue;
            }
            let piece = self.piece(of);
            number[piece as usize] = outlines.len() as u32;
            let mut outline = Vec::new();
            let mut half = first;
            while !std::mem::replace(&mut is_walked[half as usize], true) {
                outline.push(half);
                half = self.halves[half as usize].next;
            }
            outlines.push(outline);
        }
        let shape = |outline: &Vec<u32>| {
            // what was merged may turn right by a rounding here and there
            let hull =
                outline.iter().map(|&half| Coord::from(self.at(half))).collect::<LineString>().convex_hull();
            let corners: Vec<Point> = hull.exterior().coords().map(|&corner| corner.into()).collect();
            let kept = without_straight(&corners, ROUNDING_M);
            // of a piece that is as thin as rounding the corners of the hull are kept; the last is the first again
            Convex::new(if kept.len() < 3 { corners[1..].to_vec() } else { kept })
        };
        let shapes: Vec<Convex> = outlines.iter().map(shape).collect();
        let mut order: Vec<usize> = (0..shapes.len()).collect();
        let areas: Vec<f64> = shapes.iter().map(Convex::area).collect();
        order.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]).then(a.cmp(&b)));
        let mut place = vec![0; order.len()];
        for (at, &piece) in (0..).zip(&order) {
            place[piece] = at;
        }
        let mut doors: Vec<(u32, u32, Segment)> = Vec::new();
        let mut shared: Vec<((u32, u32), u32)> = Vec::new();
        for (piece, outline) in outlines.iter().enumerate() {
            for &half in outline {
                let other = self.halves[half as usize ^ 1].of;
                if other == NONE {
                    continue;
                }
                let other = number[self.piece(other) as usize] as usize;
                if place[piece] < place[other] {
                    shared.push(((place[piece], place[other]), half));
                }
            }
        }
        shared.sort_by_key(|(pair, _)| *pair);
        for same in shared.chunk_by(|one, two| one.0 == two.0) {
            let (a, b) = same[0].0;
            let ends = same.iter().flat_map(|&(_, half)| [self.at(half), self.at(half ^ 1)]);
            // the sides lie on one line, so its ends are the first and the last by x, and by y where they stand upright
            let by_place = |p: &Point, q: &Point| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
            if let (Some(first), Some(last)) = (ends.clone().min_by(by_place), ends.max_by(by_place)) {
                doors.push((a, b, Segment::new(first, last)));
            }
        }
        Pieces { pieces: order.into_iter().map(|piece| shapes[piece].clone()).collect(), doors }
    }

    /// Whether the two pieces on its sides are one.
    fn is_gone(&mut self, half: u32) -> bool {
        let (one, other) = (self.halves[half as usize].of, self.halves[half as usize ^ 1].of);
        other != NONE && self.piece(one) == self.piece(other)
    }
}

#[derive(Clone, Copy)]
struct Side(Segment);

impl RTreeObject for Side {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        let bounds = self.0.bounds();
        AABB::from_corners([bounds.x0, bounds.y0], [bounds.x1, bounds.y1])
    }
}

/// Which faces are free: those that constraints part are asked one by one.
fn free_faces(cdt: &Cdt, free: &Rings) -> Vec<bool> {
    let all = free.iter().flat_map(|ring| sides(ring)).map(|side| CachedEnvelope::new(Side(side)));
    let index = RTree::bulk_load(all.collect());
    let mut is_free = vec![false; cdt.num_all_faces()];
    let mut is_known = vec![false; cdt.num_all_faces()];
    is_known[OUTER_FACE.index()] = true;
    for first in cdt.inner_faces() {
        if std::mem::replace(&mut is_known[first.fix().index()], true) {
            continue;
        }
        let (mut part, mut next) = (Vec::new(), vec![first]);
        while let Some(face) = next.pop() {
            part.push(face);
            let open = face.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge());
            for other in open.filter_map(|edge| edge.rev().face().as_inner()) {
                if !std::mem::replace(&mut is_known[other.fix().index()], true) {
                    next.push(other);
                }
            }
        }
        let largest = part.iter().max_by(|a, b| a.area().total_cmp(&b.area()));
        let Some(middle) = largest.map(|face| face.center()).map(|at| Point::new(at.x, at.y)) else {
            continue;
        };
        let right = AABB::from_corners([middle.x, middle.y], [f64::MAX, middle.y]);
        if encloses(index.locate_in_envelope_intersecting(right).map(|side| side.0), middle) {
            for face in part {
                is_free[face.fix().index()] = true;
            }
        }
    }
    is_free
}
