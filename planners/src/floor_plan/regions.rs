//! Free space cut into convex regions, and the doorways that regions share (Crowley, sections 4.2 and 4.4).

use rayon::prelude::*;

use super::FloorPlan;
use super::face::Face;
use super::layout::Layout;
use super::near::near;
use super::planar::{Edge, Planar};
use super::search::best_layout;
use crate::geometry::polygon::is_in_convex;
use crate::geometry::tolerance::{ROUNDING_M, SNAP_M};
use crate::geometry::{Point, RayGrid};

/// A convex part of the free space.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its corners, counterclockwise; some may lie on straight sides, where another region or a doorway begins.
    pub outline: Vec<Point>,
    /// Square metres.
    pub area: f64,
}

impl Region {
    /// Whether a point lies inside or on the outline, up to a nanometre.
    pub fn contains(&self, p: Point) -> bool {
        is_in_convex(&self.outline, p, ROUNDING_M)
    }
}

/// A part of their outlines that two regions share, with no wall on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doorway {
    /// The regions: left of the way from `from` to `to`, and right of it.
    pub regions: [usize; 2],
    pub from: Point,
    pub to: Point,
}

impl Doorway {
    pub fn width(&self) -> f64 {
        self.from.distance(self.to)
    }

    pub fn middle(&self) -> Point {
        self.from.midpoint(self.to)
    }
}

/// Convex regions, the largest first, and their doorways.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Regions {
    /// Disjoint; together they are the free space.
    pub regions: Vec<Region>,
    /// In the order of their regions.
    pub doorways: Vec<Doorway>,
}

/// Edges of a plan with what is on them while it is cut.
struct Cutting {
    points: Vec<Point>,
    lines: Vec<Edge>,
    /// Ends of later cuts on lines: line, distance from its first end, node.
    stops: Vec<(u32, f64, u32)>,
}

impl Regions {
    /// Cuts free space into as few convex regions as are found; of as few, the largest is as large as is found, then
    /// the next.
    pub fn of(plan: &FloorPlan) -> Self {
        let space = plan.space();
        let (plan, mut free_half) = (&space.plan, space.free_half.clone());
        let count = plan.edges.len();
        let mut cutting =
            Cutting { points: plan.points.clone(), lines: plan.edges.clone(), stops: Vec::new() };
        for face in non_convex_faces(plan, &free_half) {
            cutting.cut_doors(&face);
        }
        free_half.resize(2 * cutting.lines.len(), true);
        let plan = Planar::new(cutting.points.clone(), cutting.lines.clone());
        let mut faces = non_convex_faces(&plan, &free_half);
        faces.par_iter_mut().for_each(|face| {
            let near = near(face);
            face.look_around(near.as_ref());
        });
        let layouts: Vec<Layout<'_>> = faces.par_iter().map(best_layout).collect();
        for (face, layout) in faces.iter().zip(&layouts) {
            cutting.cut_face(face, layout);
        }
        free_half.resize(2 * cutting.lines.len(), true);
        cutting.regions(&free_half, count)
    }
}

fn non_convex_faces(plan: &Planar, free_half: &[bool]) -> Vec<Face> {
    let mut of_face: Vec<Vec<u32>> = vec![Vec::new(); plan.cycles.len()];
    for (cycle, face) in (0..).zip(plan.faces()) {
        if let Some(face) = face.filter(|_| free_half[plan.cycles[cycle as usize].first as usize]) {
            of_face[face as usize].push(cycle);
        }
    }
    let faces = of_face.iter().filter(|cycles| !cycles.is_empty()).map(|cycles| Face::new(plan, cycles));
    faces.filter(|face| !face.corners.is_empty()).collect()
}

impl Cutting {
    /// Cuts between two corners that resolve each other and nothing else: the doors between rooms. What is left are
    /// smaller faces, which can be cut one by one.
    fn cut_doors(&mut self, face: &Face) {
        let chords = face.chords(near(face).as_ref());
        let mut ends = vec![0_u32; face.corners.len()];
        for &corner in chords.iter().flatten() {
            ends[corner as usize] += 1;
        }
        let grid = RayGrid::new(chords.iter().map(|&chord| face.between(chord)).collect());
        let is_a_door = |place: &usize| {
            let way = grid.segments()[*place];
            let is_alone = chords[*place].iter().all(|&corner| ends[corner as usize] == 1);
            is_alone && grid.beside(way).all(|other| !way.crosses(&grid.segments()[other]))
        };
        let doors: Vec<usize> = (0..chords.len()).into_par_iter().filter(is_a_door).collect();
        for door in doors {
            let [a, b] = chords[door].map(|corner| face.nodes[face.corners[corner as usize].node as usize]);
            self.lines.push(Edge::between(&self.points, a, b));
        }
    }

    fn cut_face(&mut self, face: &Face, layout: &Layout) {
        let known = face.points.len();
        let made = self.points.len();
        self.points.extend(&layout.points[known..]);
        let node = |local: u32| match (local as usize).checked_sub(known) {
            Some(beyond) => (made + beyond) as u32,
            None => face.nodes[local as usize],
        };
        let first_cut = self.lines.len();
        for &[a, b] in &layout.cuts {
            let (a, b) = (node(a), node(b));
            self.lines.push(Edge::between(&self.points, a, b));
        }
        for &(line, distance, stop) in &layout.stops {
            let line = match (line as usize).checked_sub(face.sides.len()) {
                Some(cut) => (first_cut + cut) as u32,
                None => face.sides[line as usize].edge,
            };
            self.stops.push((line, distance, node(stop)));
        }
    }

    fn regions(mut self, free_half: &[bool], walls: usize) -> Regions {
        self.stops.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let (mut edges, mut line_of) = (Vec::new(), Vec::new());
        let mut stops = self.stops.iter().peekable();
        for (number, line) in (0..).zip(&self.lines) {
            let mut last = line.ends[0];
            let own = std::iter::from_fn(|| stops.next_if(|stop| stop.0 == number).map(|stop| stop.2));
            for end in own.chain([line.ends[1]]) {
                edges.push(Edge { ends: [last, end], direction: line.direction });
                line_of.push(number as usize);
                last = end;
            }
        }
        let plan = Planar::new(self.points, edges);
        let is_free = |half: u32| free_half[2 * line_of[half as usize / 2] + half as usize % 2];
        let mut cycles: Vec<u32> = (0..plan.cycles.len() as u32)
            .filter(|&c| plan.cycles[c as usize].area > 0.0 && is_free(plan.cycles[c as usize].first))
            .collect();
        let area = |c: u32| plan.cycles[c as usize].area;
        cycles.sort_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
        let mut number = vec![usize::MAX; plan.cycles.len()];
        for (index, &cycle) in cycles.iter().enumerate() {
            number[cycle as usize] = index;
        }
        let region = |&cycle: &u32| Region {
            outline: plan.along(cycle).map(|half| plan.from(half)).collect(),
            area: area(cycle),
        };
        let regions = cycles.iter().map(region).collect();
        let is_open = |edge: usize| line_of[edge] >= walls;
        let between = |half: u32| [half, half ^ 1].map(|half| number[plan.cycle_of[half as usize] as usize]);
        let mut doorways: Vec<Doorway> = Vec::new();
        let mut last: Option<(usize, usize)> = None;
        for edge in (0..plan.edges.len()).filter(|&edge| is_open(edge)) {
            let half = 2 * edge as u32;
            let (regions, from, to) = (between(half), plan.from(half), plan.to(half));
            let goes_on = last == Some((line_of[edge], edge.wrapping_sub(1)));
            last = Some((line_of[edge], edge));
            match doorways.last_mut() {
                Some(before) if goes_on && before.regions == regions => before.to = to,
                _ => doorways.push(Doorway { regions, from, to }),
            }
        }
        doorways.retain(|doorway| doorway.regions[0] != doorway.regions[1] && doorway.width() > SNAP_M);
        doorways.sort_by_key(|d| (d.regions[0].min(d.regions[1]), d.regions[0].max(d.regions[1])));
        Regions { regions, doorways }
    }
}
