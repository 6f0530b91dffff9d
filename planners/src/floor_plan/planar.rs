//! Edges that meet only at their ends, with what lies to the left of each: the faces of a plane map.

use crate::geometry::Point;

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
        Self { ends: [a, b], direction: Point::new(q.x - p.x, q.y - p.y) }
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
            (p.x - origin.x) * (q.y - origin.y) - (q.x - origin.x) * (p.y - origin.y)
        });
        twice.sum::<f64>() / 2.0
    }

    /// The node where a half-edge begins.
    pub fn tail(&self, half: u32) -> u32 {
        self.edges[half as usize / 2].ends[half as usize % 2]
    }

    /// The node where a half-edge ends.
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

    /// Whether a point lies inside an outline.
    pub fn is_inside(&self, cycle: u32, p: Point) -> bool {
        let is_crossed = |half: u32| {
            let (a, b) = (self.from(half), self.to(half));
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        self.along(cycle).filter(|&half| is_crossed(half)).count() % 2 == 1
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
}

impl Planar {
    /// For each node a node that stands for all that edges join with it.
    fn parts(&self) -> Vec<u32> {
        let mut above: Vec<u32> = (0..self.points.len() as u32).collect();
        let top = |above: &[u32], mut node: u32| {
            while above[node as usize] != node {
                node = above[node as usize];
            }
            node
        };
        for edge in &self.edges {
            let [a, b] = edge.ends.map(|node| top(&above, node));
            above[a.max(b) as usize] = a.min(b);
        }
        (0..above.len() as u32).map(|node| top(&above, node)).collect()
    }
}

fn directed(edge: &Edge, half: u32) -> Point {
    let d = edge.direction;
    if half.is_multiple_of(2) { d } else { Point::new(-d.x, -d.y) }
}

/// Grows with the angle of a direction, from 0 to 4.
fn turn_of(d: Point) -> f64 {
    let share = d.y / (d.x.abs() + d.y.abs());
    if d.x < 0.0 {
        2.0 - share
    } else if d.y < 0.0 {
        4.0 + share
    } else {
        share
    }
}

fn successors(nodes: usize, edges: &[Edge]) -> Vec<u32> {
    let mut begins = vec![0_u32; nodes + 1];
    let halves = 0..2 * edges.len() as u32;
    let tail = |half: u32| edges[half as usize / 2].ends[half as usize % 2] as usize;
    for half in halves.clone() {
        begins[tail(half) + 1] += 1;
    }
    for node in 0..nodes {
        begins[node + 1] += begins[node];
    }
    let mut place = begins.clone();
    let mut around = vec![(0.0, 0_u32); halves.len()];
    for half in halves.clone() {
        let at = &mut place[tail(half)];
        around[*at as usize] = (turn_of(directed(&edges[half as usize / 2], half)), half);
        *at += 1;
    }
    let mut next = vec![0; halves.len()];
    for node in 0..nodes {
        let leaving = &mut around[begins[node] as usize..begins[node + 1] as usize];
        leaving.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (index, &(_, half)) in leaving.iter().enumerate() {
            let clockwise = leaving[(index + leaving.len() - 1) % leaving.len()].1;
            next[(half ^ 1) as usize] = clockwise;
        }
    }
    next
}
