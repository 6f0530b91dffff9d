//! The measure: a constrained Delaunay triangulation whose diagonals are dropped, in a random order, where both ends
//! stay convex (Hertel and Mehlhorn 1983).

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use adit_planners::floor_plan::FloorPlan;
use adit_planners::geometry::Point;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::dice::Dice;

/// A triangulation of the free space.
pub struct Triangles {
    areas: Vec<f64>,
    /// Diagonals: ends, triangles on both sides.
    diagonals: Vec<([usize; 2], [usize; 2])>,
    /// For each node the directions of walls.
    walls: Vec<Vec<f64>>,
    points: Vec<Point>,
}

impl Triangles {
    pub fn new(plan: &FloorPlan) -> Self {
        let mut cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
        for wall in plan.barriers() {
            let [a, b] = wall.map(|p| cdt.insert(Point2::new(p.x, p.y)).unwrap());
            cdt.add_constraint(a, b);
        }
        let points: Vec<Point> = cdt.vertices().map(|v| Point::new(v.position().x, v.position().y)).collect();
        let (mut areas, mut number) = (Vec::new(), BTreeMap::new());
        for face in cdt.inner_faces() {
            let centre = face.center();
            if plan.is_free(Point::new(centre.x, centre.y)) {
                number.insert(face.fix().index(), areas.len());
                areas.push(face.area());
            }
        }
        let mut walls = vec![Vec::new(); points.len()];
        let mut diagonals = Vec::new();
        for edge in cdt.undirected_edges() {
            let ends = edge.vertices().map(|v| v.fix().index());
            let sides = [edge.as_directed().face(), edge.as_directed().rev().face()];
            let faces = sides.map(|side| side.as_inner().and_then(|f| number.get(&f.fix().index()).copied()));
            if edge.is_constraint_edge() {
                walls[ends[0]].push(direction(&points, ends[0], ends[1]));
                walls[ends[1]].push(direction(&points, ends[1], ends[0]));
            } else if let [Some(a), Some(b)] = faces {
                diagonals.push((ends, [a, b]));
            }
        }
        Self { areas, diagonals, walls, points }
    }

    /// The areas of the regions for a random order of the diagonals, the largest first.
    pub fn merged(&self, dice: &mut Dice) -> Vec<f64> {
        let mut spokes = self.walls.clone();
        for &([a, b], _) in &self.diagonals {
            spokes[a].push(direction(&self.points, a, b));
            spokes[b].push(direction(&self.points, b, a));
        }
        let mut order: Vec<usize> = (0..self.diagonals.len()).collect();
        dice.shuffle(&mut order);
        let mut group: Vec<usize> = (0..self.areas.len()).collect();
        for diagonal in order {
            let ([a, b], [left, right]) = self.diagonals[diagonal];
            let (there, back) = (direction(&self.points, a, b), direction(&self.points, b, a));
            if is_convex_without(&spokes[a], there) && is_convex_without(&spokes[b], back) {
                spokes[a].retain(|&angle| angle != there);
                spokes[b].retain(|&angle| angle != back);
                let (old, new) = (root(&group, left), root(&group, right));
                group[old] = new;
            }
        }
        let mut sums = vec![0.0; self.areas.len()];
        for (triangle, area) in self.areas.iter().enumerate() {
            sums[root(&group, triangle)] += area;
        }
        sums.retain(|&sum| sum > 0.0);
        sums.sort_by(|a, b| b.total_cmp(a));
        sums
    }
}

fn root(group: &[usize], mut at: usize) -> usize {
    while group[at] != at {
        at = group[at];
    }
    at
}

fn direction(points: &[Point], from: usize, to: usize) -> f64 {
    (points[to].y - points[from].y).atan2(points[to].x - points[from].x)
}

/// Whether the gap that a spoke leaves when it goes is at most half a turn.
fn is_convex_without(spokes: &[f64], gone: f64) -> bool {
    let turn = |angle: f64| (angle - gone).rem_euclid(TAU);
    let rest: Vec<f64> = spokes.iter().filter(|&&angle| angle != gone).map(|&angle| turn(angle)).collect();
    let after = rest.iter().copied().fold(f64::INFINITY, f64::min);
    let before = rest.iter().copied().fold(0.0, f64::max);
    after + (TAU - before) <= PI + 1e-7
}
