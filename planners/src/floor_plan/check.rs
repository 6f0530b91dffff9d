//! What can be wrong with a floor plan, each said at its place in the file.

use std::collections::BTreeSet;
use std::ops::Range;

use geo::{Intersects, Validation};

use super::noding::{Clash, Noded, node};
use super::solids::{outside, rims, union};
use super::space::Space;
use crate::geometry::Point;
use crate::geometry::polygon::to_geo;
use crate::geometry::tolerance::SNAP_M;
use crate::read::{Code, MapErrors, Problem, Text};
use crate::world::Place;

/// Coordinates are at most so large, metres: beyond it a micrometre is lost.
const LARGEST_M: f64 = 1e6;

/// So many problems of one kind are told.
const MOST_TOLD: usize = 12;
/// So many walls of open outlines are told: one gap often opens many.
const MOST_OPEN: usize = 3;

/// Where in a file each thing stands, if it comes from one.
#[derive(Clone, Debug, Default)]
pub(super) struct Source {
    pub text: Option<Text>,
    pub walls: Vec<Range<usize>>,
    pub solids: Vec<Range<usize>>,
    pub places: Vec<Range<usize>>,
}

/// The problems of a plan, while it is looked at.
pub(super) struct Check<'s> {
    source: &'s Source,
    problems: Vec<Problem>,
}

impl<'s> Check<'s> {
    pub fn new(source: &'s Source) -> Self {
        Self { source, problems: Vec::new() }
    }

    pub fn problem(&self, span: Option<&Range<usize>>, code: Code, message: String) -> Problem {
        match (&self.source.text, span) {
            (Some(text), Some(span)) => text.problem(code, span, message),
            _ => Problem::of_file(code, message),
        }
    }

    fn tell(&mut self, span: Option<&Range<usize>>, code: Code, message: String, help: &str) {
        let problem = self.problem(span, code, message).with_help(help);
        self.problems.push(problem);
    }

    pub fn stop(&mut self) -> Result<(), MapErrors> {
        let problems = std::mem::take(&mut self.problems);
        if problems.is_empty() { Ok(()) } else { Err(MapErrors { problems }) }
    }

    pub fn shapes(&mut self, walls: &[[Point; 2]], solids: &[Vec<Point>]) {
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
            } else if let Err(invalid) = to_geo(solid).check_validation() {
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

    pub fn names(&mut self, places: &[Place]) {
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
    pub fn outlines(
        &mut self,
        walls: &[[Point; 2]],
        solids: &[Vec<Point>],
    ) -> Result<(Noded, usize), MapErrors> {
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

    pub fn closed(&mut self, walls: &[[Point; 2]], noded: &Noded, ring_from: usize, space: &Space) {
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
        let ends = |edge: usize| noded.edges[edge].ends.map(|node| node as usize);
        let mut met = vec![0_u32; noded.points.len()];
        for node in (0..noded.edges.len()).flat_map(ends) {
            met[node] += 1;
        }
        let is_lost = |edge: &usize| !space.free_half[2 * edge] && !space.free_half[2 * edge + 1];
        let mut lost: Vec<usize> =
            (0..noded.edges.len()).filter(|&edge| noded.wall_of[edge] < ring_from).filter(is_lost).collect();
        // One gap opens all that hangs together: walls that end at nothing are where it is.
        lost.sort_by_key(|&edge| ends(edge).into_iter().all(|node| met[node] > 1));
        let mut told_of = BTreeSet::new();
        for edge in lost {
            let [a, b] = ends(edge).map(|node| noded.points[node]);
            let is_on =
                |p: Point, wall: [Point; 2]| p.distance(p.nearest_on(wall[0], wall[1])) <= 2.0 * SNAP_M;
            let drawn = walls
                .iter()
                .position(|&wall| is_on(a, wall) && is_on(b, wall))
                .unwrap_or(noded.wall_of[edge]);
            if told_of.len() < MOST_OPEN && told_of.insert(drawn) {
                let loose = ends(edge).into_iter().find(|&node| met[node] == 1);
                let loose = loose.map_or_else(String::new, |node| {
                    format!("; it ends at nothing at {}", told(noded.points[node]))
                });
                let message = format!(
                    "no free space lies beside the wall {}: its outline is open{loose}",
                    line([a, b])
                );
                let help = "close the gap in the outline that this wall belongs to, or leave the wall out";
                self.tell(source.walls.get(drawn), Code::OpenOutline, message, help);
            }
        }
    }

    pub fn places(&mut self, places: &[Place], walls: &[[Point; 2]], solids: &[Vec<Point>], space: &Space) {
        let source = self.source;
        // Where an outline is open, it is not the places that are wrong.
        let is_open = self.problems.iter().any(|problem| problem.code == Code::OpenOutline);
        for (index, place) in places.iter().enumerate() {
            let (at, name, span) = (place.at, &place.name, source.places.get(index));
            let wall = walls.iter().find(|[a, b]| at.distance(at.nearest_on(*a, *b)) <= SNAP_M);
            let point = geo::Point::new(at.x, at.y);
            if let Some(wall) = wall {
                let message = format!("the place `{name}` at {} lies on the wall {}", told(at), line(*wall));
                self.tell(span, Code::PlaceInWall, message, "put it where a robot can stand");
            } else if solids.iter().any(|solid| to_geo(solid).intersects(&point)) {
                let message = format!("the place `{name}` at {} lies in something solid", told(at));
                self.tell(span, Code::PlaceInWall, message, "put it where a robot can stand");
            } else if !is_open && !space.is_free(at) {
                let message =
                    format!("the place `{name}` at {} lies outside of every closed outline", told(at));
                self.tell(span, Code::PlaceOutside, message, "move it, or close the outline around it");
            }
        }
    }
}

fn told(p: Point) -> String {
    format!("({}, {})", p.x, p.y)
}

fn line([a, b]: [Point; 2]) -> String {
    format!("from {} to {}", told(a), told(b))
}
