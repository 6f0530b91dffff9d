//! A floor plan that was checked: its walls close outlines, cross nowhere, and its places are free.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use geo::{Contains, Coord, Intersects, LineString, MultiPolygon, Polygon, Validation};

use super::noding::{Clash, Noded, SNAP_M, crossing, node};
use super::planar::Planar;
use crate::geometry::{Point, Rect};
use crate::read::{Code, MapErrors, Problem, Text};
use crate::world::{Occupancy, Place, Shape, World};

/// Coordinates are at most so large, metres: beyond it a micrometre is lost.
const LARGEST_M: f64 = 1e6;

/// So many problems of one kind are told.
const MOST_TOLD: usize = 12;

/// Walls without thickness, solid things, and named places, in metres.
#[derive(Clone, Debug)]
pub struct FloorPlan {
    /// What it is called.
    pub name: String,
    walls: Vec<[Point; 2]>,
    solids: Vec<Vec<Point>>,
    places: Vec<Place>,
    source: Source,
    space: Arc<Space>,
}

/// What a plan is made of, before it is checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// What it is called.
    pub name: String,
    /// Walls by their ends. They may end on one another, and must not cross.
    pub walls: Vec<[Point; 2]>,
    /// Pillars and walls with a thickness, by their corners in order. They may overlap walls and one another.
    pub solids: Vec<Vec<Point>>,
    /// Points with names.
    pub places: Vec<Place>,
}

/// Where in a file each thing stands, if it comes from one.
#[derive(Clone, Debug, Default)]
pub(super) struct Source {
    pub text: Option<Text>,
    pub walls: Vec<Range<usize>>,
    pub solids: Vec<Range<usize>>,
    pub places: Vec<Range<usize>>,
}

/// The outline of all that is solid, and on which sides of it there is free space.
#[derive(Clone, Debug)]
pub(super) struct Space {
    pub plan: Planar,
    /// For each half-edge whether free space lies to its left.
    pub free_half: Vec<bool>,
}

impl FloorPlan {
    /// Checks a plan.
    ///
    /// # Returns
    /// All that is wrong with it: numbers that are none, walls without a length, crossing walls, open outlines,
    /// places in walls or outside.
    pub fn new(drawn: Drawn) -> Result<Self, MapErrors> {
        Self::from_source(drawn, Source::default())
    }

    /// The floor plan of a map: its edge and all that is solid on it, polygons as they are drawn. Bridges are left
    /// out, and so is the map's clearance: a disc has a margin of its own.
    pub fn of_world(world: &World) -> Result<Self, MapErrors> {
        let corners = |shape: &Shape| match shape {
            Shape::Rect(r) => rectangle(r),
            Shape::Polygon(corners) => corners.clone(),
        };
        let mut solids: Vec<Vec<Point>> = world.obstacles.iter().map(|item| corners(&item.shape)).collect();
        solids.extend(world.occupancy.iter().flat_map(Occupancy::rectangles).map(|rect| rectangle(&rect)));
        solids.extend(frame(&world.bounds));
        Self::new(Drawn { solids, places: world.places.clone(), ..Drawn::default() })
    }

    pub(super) fn from_source(drawn: Drawn, source: Source) -> Result<Self, MapErrors> {
        let Drawn { name, walls, solids, places } = drawn;
        let mut check = Check { source: &source, problems: Vec::new() };
        check.shapes(&walls, &solids);
        check.names(&places);
        check.stop()?;
        let (noded, ring_from) = check.outlines(&walls, &solids)?;
        let space = Space::new(&noded, ring_from);
        check.closed(&walls, &noded, ring_from, &space);
        check.places(&places, &walls, &solids, &space);
        check.stop()?;
        let space = Arc::new(space);
        Ok(Self { name, walls, solids, places, source, space })
    }

    /// The walls by their ends, as drawn.
    pub fn walls(&self) -> &[[Point; 2]] {
        &self.walls
    }

    /// The solid things by their corners, as drawn.
    pub fn solids(&self) -> &[Vec<Point>] {
        &self.solids
    }

    /// The named places.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Whatever stops a robot or an echo: walls, and outlines of solid things.
    pub fn barriers(&self) -> Vec<[Point; 2]> {
        self.space
            .plan
            .edges
            .iter()
            .map(|edge| edge.ends.map(|n| self.space.plan.points[n as usize]))
            .collect()
    }

    /// The area of the free space, square metres.
    pub fn free_area(&self) -> f64 {
        let plan = &self.space.plan;
        plan.cycles
            .iter()
            .filter(|cycle| self.space.free_half[cycle.first as usize])
            .map(|cycle| cycle.area)
            .sum()
    }

    /// Whether a point lies in free space; on a wall it may or may not.
    pub fn is_free(&self, p: Point) -> bool {
        self.space.is_free(p)
    }

    pub(super) fn space(&self) -> &Space {
        &self.space
    }

    /// A problem with a place, told where it stands in the file.
    pub(super) fn problem_of_place(&self, place: usize, code: Code, message: String) -> Problem {
        Check { source: &self.source, problems: Vec::new() }.problem(
            self.source.places.get(place),
            code,
            message,
        )
    }
}

impl Space {
    fn new(noded: &Noded, ring_from: usize) -> Self {
        let plan = Planar::new(noded.points.clone(), noded.edges.clone());
        let is_solid = |half: u32| half.is_multiple_of(2) && noded.wall_of[half as usize / 2] >= ring_from;
        let is_free = |face: &Option<u32>| face.is_some_and(|face| !plan.along(face).any(is_solid));
        let free: Vec<bool> = plan.faces().iter().map(is_free).collect();
        let free_half = plan.cycle_of.iter().map(|&cycle| free[cycle as usize]).collect();
        Self { plan, free_half }
    }

    /// Whether a point lies in free space; on its outline it may or may not.
    fn is_free(&self, p: Point) -> bool {
        let area = |&c: &u32| self.plan.cycles[c as usize].area;
        let outer = (0..self.plan.cycles.len() as u32).filter(|c| area(c) > 0.0);
        let around = outer.filter(|&c| self.plan.is_inside(c, p));
        let nearest = around.min_by(|a, b| area(a).total_cmp(&area(b)));
        nearest.is_some_and(|cycle| self.free_half[self.plan.cycles[cycle as usize].first as usize])
    }
}

struct Check<'s> {
    source: &'s Source,
    problems: Vec<Problem>,
}

impl Check<'_> {
    fn problem(&self, span: Option<&Range<usize>>, code: Code, message: String) -> Problem {
        match (&self.source.text, span) {
            (Some(text), Some(span)) => text.problem(code, span, message),
            _ => Problem::of_file(code, message),
        }
    }

    fn tell(&mut self, span: Option<&Range<usize>>, code: Code, message: String, help: &str) {
        let problem = self.problem(span, code, message).with_help(help);
        self.problems.push(problem);
    }

    fn stop(&mut self) -> Result<(), MapErrors> {
        let problems = std::mem::take(&mut self.problems);
        if problems.is_empty() { Ok(()) } else { Err(MapErrors { problems }) }
    }

    fn shapes(&mut self, walls: &[[Point; 2]], solids: &[Vec<Point>]) {
        let source = self.source;
        for (index, wall) in walls.iter().enumerate() {
            let span = source.walls.get(index);
            if !self.numbers("wall", wall, span) {
                continue;
            }
            if wall[0].distance(wall[1]) <= SNAP_M {
                let message = format!("the wall at {} has no length", told(wall[0]));
                self.tell(span, Code::Degenerate, message, "a wall goes from a point to another one");
            }
        }
        for (index, solid) in solids.iter().enumerate() {
            let span = source.solids.get(index);
            if !self.numbers("solid", solid, span) {
                continue;
            }
            if solid.len() < 3 {
                let message = format!("a solid needs three corners or more, this one has {}", solid.len());
                self.tell(span, Code::FewCorners, message, "list the corners in order, each once");
            } else if let Err(invalid) = polygon(solid).check_validation() {
                let message = format!("this solid is not a simple outline: {invalid}");
                self.tell(span, Code::SelfCrossing, message, "list the corners in order, each once");
            }
        }
    }

    fn numbers(&mut self, what: &str, points: &[Point], span: Option<&Range<usize>>) -> bool {
        let wrong = points.iter().flat_map(|p| [p.x, p.y]).find(|v| v.is_nan() || v.abs() > LARGEST_M);
        if let Some(value) = wrong {
            let message =
                format!("a {what} has the coordinate {value}; finite numbers up to {LARGEST_M:e} are read");
            self.tell(span, Code::NotFinite, message, "coordinates are in metres");
        }
        wrong.is_none()
    }

    fn names(&mut self, places: &[Place]) {
        let (mut known, source) = (BTreeSet::new(), self.source);
        for (index, place) in places.iter().enumerate() {
            let span = source.places.get(index);
            if place.name.trim().is_empty() {
                let message = format!("the place at {} has an empty name", told(place.at));
                self.tell(span, Code::EmptyName, message, "a place is asked for by its name");
            } else if !known.insert(&place.name) {
                let message = format!("there are two places `{}`", place.name);
                self.tell(span, Code::DuplicatePlace, message, "names of places are unique");
            }
            self.numbers("place", &[place.at], span);
        }
    }

    /// Walls outside of solids, then the outlines of solids with the solid to the left; from which wall on they are.
    fn outlines(&mut self, walls: &[[Point; 2]], solids: &[Vec<Point>]) -> Result<(Noded, usize), MapErrors> {
        if let Err(clashes) = node(walls) {
            for clash in clashes.iter().take(MOST_TOLD) {
                self.clash(clash, walls);
            }
            self.stop()?;
        }
        let solids = union(solids);
        let mut lines: Vec<[Point; 2]> = walls.iter().flat_map(|wall| outside(*wall, &solids)).collect();
        let ring_from = lines.len();
        lines.extend(rims(&solids));
        lines.retain(|[a, b]| a.distance(*b) > SNAP_M);
        let noded = node(&lines).map_err(|_| {
            Problem::of_file(
                Code::CrossingWalls,
                "walls and solids meet in a way that is too fine to tell apart",
            )
        })?;
        Ok((noded, ring_from))
    }

    fn clash(&mut self, clash: &Clash, walls: &[[Point; 2]]) {
        let (Clash::Cross { walls: [i, j], .. } | Clash::Overlap { walls: [i, j] }) = *clash;
        let (first, second) = (line(walls[i]), line(walls[j]));
        let message = match clash {
            Clash::Cross { at, .. } => format!("the wall {second} crosses the wall {first} at {}", told(*at)),
            Clash::Overlap { .. } => format!("the wall {second} lies on the wall {first}"),
        };
        let help = "walls may end on one another; let one of them end where they meet, or draw it as two";
        let mut problem =
            self.problem(self.source.walls.get(j), Code::CrossingWalls, message).with_help(help);
        if let Some(span) = self.source.walls.get(i) {
            problem = problem.and_at(span, "the other wall");
        }
        self.problems.push(problem);
    }

    fn closed(&mut self, walls: &[[Point; 2]], noded: &Noded, ring_from: usize, space: &Space) {
        let source = self.source;
        if !space.free_half.contains(&true) {
            let message = format!("none of the {} walls bound free space: no outline is closed", walls.len());
            self.tell(
                None,
                Code::OpenOutline,
                message,
                "draw the outer walls so that each ends on another one",
            );
            return;
        }
        let mut told_of = BTreeSet::new();
        for (edge, &wall) in noded.wall_of.iter().enumerate().filter(|&(_, &wall)| wall < ring_from) {
            let is_lost = !space.free_half[2 * edge] && !space.free_half[2 * edge + 1];
            let [a, b] = noded.edges[edge].ends.map(|n| noded.points[n as usize]);
            let is_on =
                |p: Point, wall: [Point; 2]| p.distance(p.nearest_on(wall[0], wall[1])) <= 2.0 * SNAP_M;
            let drawn = walls.iter().position(|&wall| is_on(a, wall) && is_on(b, wall)).unwrap_or(wall);
            if is_lost && told_of.len() < MOST_TOLD && told_of.insert(drawn) {
                let message =
                    format!("no free space lies beside the wall {}: its outline is open", line([a, b]));
                let help = "close the gap in the outline that this wall belongs to, or leave the wall out";
                self.tell(source.walls.get(drawn), Code::OpenOutline, message, help);
            }
        }
    }

    fn places(&mut self, places: &[Place], walls: &[[Point; 2]], solids: &[Vec<Point>], space: &Space) {
        let source = self.source;
        for (index, place) in places.iter().enumerate() {
            let (at, name, span) = (place.at, &place.name, source.places.get(index));
            let wall = walls.iter().find(|[a, b]| at.distance(at.nearest_on(*a, *b)) <= SNAP_M);
            let point = geo::Point::new(at.x, at.y);
            if let Some(wall) = wall {
                let message = format!("the place `{name}` at {} lies on the wall {}", told(at), line(*wall));
                self.tell(span, Code::PlaceInWall, message, "put it where a robot can stand");
            } else if solids.iter().any(|solid| polygon(solid).intersects(&point)) {
                let message = format!("the place `{name}` at {} lies in something solid", told(at));
                self.tell(span, Code::PlaceInWall, message, "put it where a robot can stand");
            } else if !space.is_free(at) {
                let message =
                    format!("the place `{name}` at {} lies outside of every closed outline", told(at));
                self.tell(span, Code::PlaceOutside, message, "move it, or close the outline around it");
            }
        }
    }
}

fn rectangle(r: &Rect) -> Vec<Point> {
    [(r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1)].map(|(x, y)| Point::new(x, y)).to_vec()
}

/// Something solid all around, as thick as the rectangle's smaller side.
fn frame(r: &Rect) -> Vec<Vec<Point>> {
    let thick = r.smaller_side();
    let (x0, y0, x1, y1) = (r.x0 - thick, r.y0 - thick, r.x1 + thick, r.y1 + thick);
    let bars = [
        Rect::new(x0, y0, x1, r.y0),
        Rect::new(x0, r.y1, x1, y1),
        Rect::new(x0, r.y0, r.x0, r.y1),
        Rect::new(r.x1, r.y0, x1, r.y1),
    ];
    bars.iter().map(rectangle).collect()
}

fn told(p: Point) -> String {
    format!("({}, {})", p.x, p.y)
}

fn line([a, b]: [Point; 2]) -> String {
    format!("from {} to {}", told(a), told(b))
}

pub(super) fn polygon(corners: &[Point]) -> Polygon {
    let ring: LineString = corners.iter().map(|p| Coord { x: p.x, y: p.y }).collect();
    Polygon::new(ring, Vec::new())
}

/// Solids that overlap or touch made one, each outline counterclockwise.
fn union(solids: &[Vec<Point>]) -> MultiPolygon {
    use geo::orient::{Direction, Orient};
    let polygons: Vec<Polygon> = solids.iter().map(|solid| polygon(solid)).collect();
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
fn outside([a, b]: [Point; 2], solids: &MultiPolygon) -> Vec<[Point; 2]> {
    let line = geo::Line::new(Coord { x: a.x, y: a.y }, Coord { x: b.x, y: b.y });
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
        let middle = Point::new(f64::midpoint(p.x, q.x), f64::midpoint(p.y, q.y));
        let is_on_rim = rim.iter().any(|&[c, d]| middle.distance(middle.nearest_on(c, d)) <= SNAP_M);
        p.distance(q) > SNAP_M && !is_on_rim && !solids.contains(&Coord { x: middle.x, y: middle.y })
    };
    stops.windows(2).map(|part| [part[0], part[1]]).filter(|&part| is_outside(part)).collect()
}

/// The outlines, with what is solid to the left.
fn rims(solids: &MultiPolygon) -> impl Iterator<Item = [Point; 2]> + '_ {
    let rings = solids.iter().flat_map(|solid| std::iter::once(solid.exterior()).chain(solid.interiors()));
    let lines = rings.flat_map(LineString::lines);
    lines.map(|line| [line.start, line.end].map(|c| Point::new(c.x, c.y)))
}
