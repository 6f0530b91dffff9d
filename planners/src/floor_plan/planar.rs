//! Edges that meet only at their ends, with what lies to the left of each: the faces of a plane map.

use petgraph::unionfind::UnionFind;

use crate::geometry::{Point, Segment, cross, polygon};
use crate::search::Csr;

/// An edge between two nodes, with the direction of the straight line that it is a part of: parts of one line are
/// parallel to the bit, however short they are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub ends: [u32; 2],
    pub direction: Point,
}

impl Edge {
    pub fn between(points: &[Point], a: u32, b: u32) -> Self {
        let (p, q) = (points[a as usize], points[b as usize]);
        Self { ends: [a, b], direction: q - p }
    }
}

/// Each edge is two half-edges, `2 e` from its first end and `2 e + 1` back; a face lies to the left of its own.
#[derive(Clone, Debug)]
pub(super) struct Planar {
    pub points: Vec<Point>,
    pub edges: Vec<Edge>,
    /// The half-edge that follows on the outline of the face to the left.
    pub next: Vec<u32>,
    /// For each half-edge the outline that it belongs to.
    pub cycle_of: Vec<u32>,
    pub cycles: Vec<Cycle>,
}

/// A closed way along half-edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    /// A half-edge of it.
    pub first: u32,
    /// Positive where the face lies inside, negative (or 0) where it lies around.
    pub area: f64,
}

impl Planar {
    pub fn new(points: Vec<Point>, edges: Vec<Edge>) -> Self {
        let next = successors(points.len(), &edges);
        let mut planar =
            Self { points, edges, cycle_of: vec![u32::MAX; next.len()], next, cycles: Vec::new() };
        for first in 0..planar.next.len() as u32 {
            if planar.cycle_of[first as usize] == u32::MAX {
                let number = planar.cycles.len() as u32;
                planar.cycles.push(Cycle { first, area: 0.0 });
                let mut at = first;
                while planar.cycle_of[at as usize] == u32::MAX {
                    planar.cycle_of[at as usize] = number;
                    at = planar.next[at as usize];
                }
                planar.cycles[number as usize].area = planar.area(number);
            }
        }
        planar
    }

    /// Of a way that goes along all its edges and back the area is 0 to the bit, so that it bounds no face.
    fn area(&self, cycle: u32) -> f64 {
        let origin = self.from(self.cycles[cycle as usize].first);
        let outline = self.along(cycle).filter(|&half| self.cycle_of[(half ^ 1) as usize] != cycle);
        let twice = outline.map(|half| {
            let (p, q) = (self.from(half), self.to(half));
            cross(origin, p, q)
        });
        twice.sum::<f64>() / 2.0
    }

    pub fn tail(&self, half: u32) -> u32 {
        self.edges[half as usize / 2].ends[half as usize % 2]
    }

    pub fn head(&self, half: u32) -> u32 {
        self.tail(half ^ 1)
    }

    pub fn from(&self, half: u32) -> Point {
        self.points[self.tail(half) as usize]
    }

    pub fn to(&self, half: u32) -> Point {
        self.points[self.head(half) as usize]
    }

    pub fn direction(&self, half: u32) -> Point {
        directed(&self.edges[half as usize / 2], half)
    }

    /// The half-edges of an outline, in order.
    pub fn along(&self, cycle: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.cycles[cycle as usize].first;
        let step = move |&half: &u32| Some(self.next[half as usize]).filter(|&next| next != first);
        std::iter::successors(Some(first), step)
    }

    pub fn is_inside(&self, cycle: u32, p: Point) -> bool {
        let sides = self.along(cycle).map(|half| Segment::new(self.from(half), self.to(half)));
        polygon::encloses(sides, p)
    }

    /// For each outline the outer outline of its face; `None` where that is the unbounded one.
    pub fn faces(&self) -> Vec<Option<u32>> {
        let part = self.parts();
        let part_of = |cycle: u32| part[self.tail(self.cycles[cycle as usize].first) as usize];
        let area = |cycle: u32| self.cycles[cycle as usize].area;
        let inner = |cycle: u32| {
            let p = self.from(self.cycles[cycle as usize].first);
            let others =
                (0..self.cycles.len() as u32).filter(|&c| area(c) > 0.0 && part_of(c) != part_of(cycle));
            others.filter(|&c| self.is_inside(c, p)).min_by(|&a, &b| area(a).total_cmp(&area(b)))
        };
        let face =
            |(number, cycle): (u32, &Cycle)| if cycle.area > 0.0 { Some(number) } else { inner(number) };
        (0..).zip(&self.cycles).map(face).collect()
    }

    /// For each node the same number as for all that edges join with it.
    fn parts(&self) -> Vec<u32> {
        let mut parts = UnionFind::new(self.points.len());
        for Edge { ends: [a, b], .. } in &self.edges {
            parts.union(*a, *b);
        }
        parts.into_labeling()
    }
}

fn directed(edge: &Edge, half: u32) -> Point {
    let d = edge.direction;
    if half.is_multiple_of(2) { d } else { -d }
}

fn successors(nodes: usize, edges: &[Edge]) -> Vec<u32> {
    let halves = 0..2 * edges.len() as u32;
    let around = halves.map(|half| {
        let edge = &edges[half as usize / 2];
        (edge.ends[half as usize % 2] as usize, (directed(edge, half).diamond_angle(), half))
    });
    let mut around = Csr::new(nodes, around);
    let mut next = vec![0; 2 * edges.len()];
    for node in 0..nodes {
        let leaving = around.of_mut(node);
        leaving.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (index, &(_, half)) in leaving.iter().enumerate() {
            let clockwise = leaving[(index + leaving.len() - 1) % leaving.len()].1;
            next[(half ^ 1) as usize] = clockwise;
        }
    }
    next
}
