//! Where the centre of a disc can be, as triangles that lie in one region each.

use geo::{CoordsIter, LineString, MultiPolygon};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::disc::Disc;
use super::plan::FloorPlan;
use super::regions::Regions;
use crate::geometry::polygon::{self, is_in_convex};
use crate::geometry::tolerance::{ROUNDING_M, SNAP_M};
use crate::geometry::{Point, Rect, Segment};
use crate::search::Csr;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

const NONE: u32 = u32::MAX;

#[derive(Clone, Copy, Debug)]
struct Triangle {
    /// Counterclockwise.
    corners: [Point; 3],
    /// Beside the edge from each corner to the next; [`NONE`] where that is no triangle of the same region.
    beside: [u32; 3],
}

/// A part of a doorway that the centre can pass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    pub doorway: usize,
    /// The ends, so that the doorway's first region lies to the left.
    pub ends: [Point; 2],
    pub triangles: [u32; 2],
}

impl Opening {
    pub fn middle(&self) -> Point {
        self.ends[0].midpoint(self.ends[1])
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    /// For each region its triangles; they are numbered through all regions.
    triangles: Csr<Triangle>,
    pub openings: Vec<Opening>,
}

/// An edge that a way crosses: what lies left of the way, what right.
pub(super) type Gate = [Point; 2];

impl Mesh {
    pub fn new(plan: &FloorPlan, regions: &Regions, disc: &Disc) -> Self {
        let grown = disc.grown(plan);
        let cdt = triangulate(&grown, regions);
        let region_of = regions_of_faces(&cdt, &grown, regions);
        let mut order: Vec<u32> =
            (0..cdt.num_all_faces() as u32).filter(|&f| region_of[f as usize] != NONE).collect();
        order.sort_by_key(|&face| region_of[face as usize]);
        let mut number = vec![NONE; cdt.num_all_faces()];
        for (index, &face) in (0..).zip(&order) {
            number[face as usize] = index;
        }
        let (mut triangles, mut openings) = (Vec::with_capacity(order.len()), Vec::new());
        let by_number = cdt.inner_faces().filter(|face| number[face.fix().index()] != NONE);
        let mut faces: Vec<_> = by_number.collect();
        faces.sort_by_key(|face| number[face.fix().index()]);
        for face in faces {
            let own = face.fix().index();
            let mut triangle = Triangle { corners: face.positions().map(at), beside: [NONE; 3] };
            for (edge, beside) in face.adjacent_edges().iter().zip(&mut triangle.beside) {
                let other = edge.rev().face().fix().index();
                if region_of[other] == region_of[own] {
                    *beside = number[other];
                } else if region_of[other] != NONE {
                    let ends = edge.positions().map(at);
                    let sides = [own, other].map(|face| (region_of[face] as usize, number[face]));
                    openings.extend(opening(regions, ends, sides));
                }
            }
            triangles.push((region_of[own] as usize, triangle));
        }
        openings.sort_by_key(|opening: &Opening| opening.doorway);
        Self { triangles: Csr::new(regions.regions.len(), triangles), openings }
    }

    fn of_region(&self, region: usize) -> std::ops::Range<u32> {
        let range = self.triangles.range(region);
        range.start as u32..range.end as u32
    }

    /// The triangle of a region that holds a point.
    pub fn locate(&self, region: usize, p: Point) -> Option<u32> {
        self.of_region(region)
            .find(|&triangle| is_in_convex(&self.triangles.items()[triangle as usize].corners, p, ROUNDING_M))
    }

    /// The gates on the way from one triangle of a region to another one; `None` where they are not joined in it.
    pub fn gates(&self, region: usize, from: u32, to: u32) -> Option<Vec<Gate>> {
        let range = self.of_region(region);
        let mut before: Vec<(u32, u32)> = vec![(NONE, 0); range.len()];
        let place = |triangle: u32| (triangle - range.start) as usize;
        before[place(to)] = (to, 0);
        let mut next = std::collections::VecDeque::from([to]);
        while before[place(from)].0 == NONE {
            let triangle = next.pop_front()?;
            for &other in
                self.triangles.items()[triangle as usize].beside.iter().filter(|&&other| other != NONE)
            {
                if before[place(other)].0 == NONE {
                    let beside = self.triangles.items()[other as usize].beside;
                    let edge = beside.iter().position(|&b| b == triangle)? as u32;
                    before[place(other)] = (triangle, edge);
                    next.push_back(other);
                }
            }
        }
        let (mut gates, mut at) = (Vec::new(), from);
        while at != to {
            let (towards, edge) = before[place(at)];
            let corners = self.triangles.items()[at as usize].corners;
            // The triangle lies left of its edges, so a way out of it has the edge's end to the left.
            gates.push([corners[(edge as usize + 1) % 3], corners[edge as usize]]);
            at = towards;
        }
        Some(gates)
    }
}

fn at(p: Point2<f64>) -> Point {
    Point::new(p.x, p.y)
}

fn triangulate(grown: &MultiPolygon, regions: &Regions) -> Cdt {
    let mut cdt = Cdt::new();
    let insert = |cdt: &mut Cdt, x: f64, y: f64| cdt.insert(Point2::new(x, y)).ok();
    let mut lines: Vec<[FixedVertexHandle; 2]> = Vec::new();
    for ring in rings(grown) {
        let handles: Vec<Option<FixedVertexHandle>> =
            ring.coords_iter().map(|c| insert(&mut cdt, c.x, c.y)).collect();
        lines.extend(handles.windows(2).filter_map(|ends| Some([ends[0]?, ends[1]?])));
    }
    for doorway in &regions.doorways {
        let ends = [doorway.from, doorway.to].map(|p| insert(&mut cdt, p.x, p.y));
        if let [Some(a), Some(b)] = ends {
            lines.push([a, b]);
        }
    }
    for [a, b] in lines.into_iter().filter(|[a, b]| a != b) {
        cdt.add_constraint_and_split(a, b, |p| p);
    }
    cdt
}

fn rings(grown: &MultiPolygon) -> impl Iterator<Item = &LineString> {
    grown.iter().flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()))
}

/// For each face the region that it lies in; [`NONE`] where the centre cannot be.
fn regions_of_faces(cdt: &Cdt, grown: &MultiPolygon, regions: &Regions) -> Vec<u32> {
    let rings: Vec<(Rect, &LineString)> = rings(grown)
        .map(|ring| (Rect::around(ring.coords_iter().map(|c| Point::new(c.x, c.y))), ring))
        .collect();
    let is_grown = |p: Point| {
        let about = rings.iter().filter(|(bounds, _)| bounds.contains(p));
        about.filter(|(_, ring)| is_inside(ring, p)).count() % 2 == 1
    };
    let mut region_of = vec![NONE; cdt.num_all_faces()];
    let mut is_known = vec![false; cdt.num_all_faces()];
    for first in cdt.inner_faces() {
        if is_known[first.fix().index()] {
            continue;
        }
        is_known[first.fix().index()] = true;
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
        let middle = largest.map_or(Point::default(), |face| at(face.center()));
        let region = regions.regions.iter().position(|region| region.contains(middle));
        if let Some(region) = region.filter(|_| !is_grown(middle)) {
            for face in part {
                region_of[face.fix().index()] = region as u32;
            }
        }
    }
    region_of
}

fn is_inside(ring: &LineString, p: Point) -> bool {
    let point = |c: geo::Coord| Point::new(c.x, c.y);
    polygon::encloses(ring.lines().map(|line| Segment::new(point(line.start), point(line.end))), p)
}

/// The opening on an edge of the mesh, seen from its left side, if that is the doorway's first region.
fn opening(regions: &Regions, ends: [Point; 2], sides: [(usize, u32); 2]) -> Option<Opening> {
    let middle = ends[0].midpoint(ends[1]);
    let is_own = |(_, doorway): &(usize, &super::regions::Doorway)| {
        doorway.regions == sides.map(|side| side.0)
            && middle.distance(middle.nearest_on(doorway.from, doorway.to)) <= SNAP_M
    };
    let (doorway, _) = regions.doorways.iter().enumerate().find(is_own)?;
    Some(Opening { doorway, ends, triangles: sides.map(|side| side.1) })
}
