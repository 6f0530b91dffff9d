//! Everything solid of a world as rings of corners, with as few corners as tell where discs and bodies can be.

use rayon::prelude::*;
use rstar::primitives::CachedEnvelope;
use rstar::{AABB, RTree, RTreeObject};

use super::traced::{outlines, simplified};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Rect, Segment, polygon};
use crate::world::{Occupancy, Shape, World};

/// The outlines of an image's walls may gain so much by being made straight, in cells: a wall that leans by one cell in a
/// row of many has steps one cell deep.
const STRAIGHTENED: f64 = 1.0;

/// A corner of something solid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Corner {
    pub at: Point,
    /// Directions, of length 1, in which something else is so near that the arc about the corner has to be exact there.
    pub tight: Vec<Point>,
}

impl From<Point> for Corner {
    fn from(at: Point) -> Self {
        Self { at, tight: Vec::new() }
    }
}

/// A closed outline with what is solid to its left.
#[derive(Clone, Debug)]
struct Ring {
    corners: Vec<Point>,
    /// Which of the corners are left when it is made straight; all of a drawn one.
    kept: Vec<usize>,
}

/// What is solid whatever the state's height.
#[derive(Debug)]
pub(super) struct Walls {
    rings: Vec<Ring>,
    /// Their straight sides, found by where they are.
    sides: RTree<CachedEnvelope<Side>>,
}

impl Walls {
    pub fn new(world: &World) -> Self {
        let drawn = world.obstacles.iter().map(|obstacle| Ring::drawn(&obstacle.shape));
        let pictured = world.occupancy.iter().flat_map(Ring::pictured);
        let rings: Vec<Ring> = drawn.chain(pictured).collect();
        let sides = RTree::bulk_load(sides_of(&rings, 0).collect());
        Self { rings, sides }
    }

    /// The walls with the rectangles `low`, as straight as they can be without closing a gap that a disc passes.
    ///
    /// # Arguments
    /// `across` is what the disc takes of room, metres: its width with what it keeps free on both sides. `most` is
    /// what it may take where arcs are drawn coarsely.
    pub fn about_discs(&self, low: &[Rect], bounds: Rect, [across, most]: [f64; 2]) -> Vec<Vec<Corner>> {
        let low: Vec<Ring> = low.iter().map(Ring::of_rect).collect();
        let all: Vec<&Ring> = self.rings.iter().chain(&low).collect();
        let edge = Ring::of_rect(&bounds);
        let low = RTree::bulk_load(sides_of(&low, self.rings.len()).collect());
        let is_restored = |side: &Side| {
            let near = around(side.line, across);
            !side.is_whole
                && [&self.sides, &low]
                    .iter()
                    .flat_map(|sides| sides.locate_in_envelope_intersecting(near))
                    .any(|other| {
                        faces(&side.line, &other.line)
                            && side.line.gap(&other.line) < across
                            && least_gap(
                                &all[side.ring].chain(side.number),
                                &all[other.ring].chain(other.number),
                            ) >= across
                    })
        };
        let restored = |(number, ring): (usize, &&Ring)| -> Vec<bool> {
            ring.sides(number).map(|side| is_restored(&side)).collect()
        };
        let restored: Vec<Vec<bool>> = all.par_iter().enumerate().map(restored).collect();
        let mut restored = restored.into_iter().flatten();
        let mut rings: Vec<Vec<Corner>> = Vec::with_capacity(all.len());
        for ring in &all {
            let mut corners = Vec::with_capacity(ring.kept.len());
            for (side, &corner) in ring.kept.iter().enumerate() {
                corners.push(ring.corners[corner].into());
                if restored.next().unwrap_or(false) {
                    corners.extend(ring.between(side).map(Corner::from));
                }
            }
            rings.push(corners);
        }
        let lines = rings.iter().flat_map(|ring| lines(ring)).chain(polygon::sides(&edge.corners));
        let index = RTree::bulk_load(lines.map(|line| CachedEnvelope::new(Line(line))).collect());
        rings.par_iter_mut().for_each(|ring| find_tight(ring, &index, [across, most]));
        rings
    }

    /// The walls with the rectangles `low`, as straight as they can be.
    pub fn straight(&self, low: &[Rect]) -> Vec<Vec<Corner>> {
        let corners = |ring: &Ring| ring.kept.iter().map(|&corner| ring.corners[corner].into()).collect();
        self.rings.iter().map(corners).chain(low.iter().map(|rect| corners(&Ring::of_rect(rect)))).collect()
    }
}

/// The straight sides of rings that are numbered from a number on.
fn sides_of(rings: &[Ring], first: usize) -> impl Iterator<Item = CachedEnvelope<Side>> + '_ {
    rings
        .iter()
        .enumerate()
        .flat_map(move |(number, ring)| ring.sides(first + number))
        .map(CachedEnvelope::new)
}

fn lines(ring: &[Corner]) -> impl Iterator<Item = Segment> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| Segment::new(a.at, b.at))
}

/// Of gaps that a disc does not pass, into those of at least this share of what it takes it dips so deep that a slimmer state
/// goes noticeably less far alone: the deepest place is drawn exactly.
const DIPPED: f64 = 0.8;

/// Finds where something is so near to a corner that a coarse arc about it might close the gap: straight ahead of it, not along
/// its own wall. Where the gap is too narrow for the disc, what it touches from where it comes furthest into it.
fn find_tight(ring: &mut [Corner], index: &RTree<CachedEnvelope<Line>>, [across, most]: [f64; 2]) {
    let count = ring.len();
    for number in 0..count {
        let here = ring[number].at;
        let (before, after) = (ring[(number + count - 1) % count].at, ring[(number + 1) % count].at);
        let (come, go) = (here - before, after - here);
        if come.cross(go) <= 0.0 {
            continue;
        }
        let near = index.locate_in_envelope_intersecting(around(Segment::new(here, here), most));
        let mut tight = Vec::new();
        for Line(line) in near.map(|line| &**line) {
            let way = line.nearest_to(here) - here;
            let length = way.length();
            let is_ahead = way.dot(come) >= -ROUNDING_M && way.dot(go) <= ROUNDING_M;
            let share = (length + ROUNDING_M) / across;
            if !is_ahead || length + ROUNDING_M >= most || share < DIPPED {
                continue;
            }
            let towards = way * (1.0 / length);
            if share >= 1.0 {
                tight.push(towards);
                continue;
            }
            let is_corner = [line.a, line.b].iter().any(|end| end.distance(here + way) <= ROUNDING_M);
            let touching = if is_corner { share } else { 2.0 * share - 1.0 };
            let aside = (1.0 - touching * touching).max(0.0).sqrt();
            tight.extend([aside, -aside].map(|aside| towards.rotated(Point::new(touching, aside))));
        }
        ring[number].tight = tight;
    }
}

/// Whether the shortest way from one side to another leaves it on the outside.
fn faces(side: &Segment, other: &Segment) -> bool {
    let ends = [other.a, other.b].map(|end| (side.nearest_to(end), end));
    let back = [side.a, side.b].map(|end| (end, other.nearest_to(end)));
    let nearest = ends
        .into_iter()
        .chain(back)
        .min_by(|one, two| one.0.squared_distance(one.1).total_cmp(&two.0.squared_distance(two.1)));
    nearest.is_some_and(|(here, there)| {
        let (along, way) = (side.direction(), there - here);
        along.cross(way) < -OUTWARDS * way.length()
    })
}

/// The sine of the angle by which a way has to lead away from a wall to lead across a gap.
const OUTWARDS: f64 = 0.1;

fn least_gap(one: &[Segment], other: &[Segment]) -> f64 {
    let gaps = one.iter().flat_map(|a| other.iter().map(move |b| a.gap(b)));
    gaps.fold(f64::INFINITY, f64::min)
}

fn around(line: Segment, by: f64) -> AABB<[f64; 2]> {
    let Rect { x0, y0, x1, y1 } = line.bounds().grown(by);
    AABB::from_corners([x0, y0], [x1, y1])
}

struct Line(Segment);

impl RTreeObject for Line {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        around(self.0, 0.0)
    }
}

/// A straight side, by the number of its ring and in it.
#[derive(Clone, Debug)]
struct Side {
    ring: usize,
    number: usize,
    line: Segment,
    /// Whether no corner was left out.
    is_whole: bool,
}

impl RTreeObject for Side {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        around(self.line, 0.0)
    }
}

impl Ring {
    fn of_rect(rect: &Rect) -> Self {
        Self { corners: rect.corners().into(), kept: (0..4).collect() }
    }

    fn drawn(shape: &Shape) -> Self {
        match shape {
            Shape::Rect(rect) => Self::of_rect(rect),
            Shape::Polygon(corners) => {
                let area: f64 = polygon::sides(corners).map(|side| side.a.cross(side.b)).sum();
                let mut corners = corners.clone();
                if area < 0.0 {
                    corners.reverse();
                }
                corners.dedup();
                Self { kept: (0..corners.len()).collect(), corners }
            }
        }
    }

    fn pictured(occupancy: &Occupancy) -> Vec<Self> {
        let Occupancy { origin, resolution, .. } = *occupancy;
        let at = |[x, y]: [i32; 2]| {
            Point::new(origin.x + f64::from(x) * resolution, origin.y + f64::from(y) * resolution)
        };
        let ring = |outline: &Vec<[i32; 2]>| Self {
            corners: outline.iter().map(|&corner| at(corner)).collect(),
            kept: simplified(outline, STRAIGHTENED),
        };
        outlines(occupancy).par_iter().map(ring).collect()
    }

    fn sides(&self, ring: usize) -> impl Iterator<Item = Side> + '_ {
        (0..self.kept.len()).map(move |number| self.side(ring, number))
    }

    fn side(&self, ring: usize, number: usize) -> Side {
        let (from, to) = (self.kept[number], self.kept[(number + 1) % self.kept.len()]);
        let is_whole = (from + 1) % self.corners.len() == to;
        Side { ring, number, line: Segment::new(self.corners[from], self.corners[to]), is_whole }
    }

    /// The corners that a side leaves out.
    fn between(&self, side: usize) -> impl Iterator<Item = Point> + '_ {
        let count = self.corners.len();
        let (from, to) = (self.kept[side], self.kept[(side + 1) % self.kept.len()]);
        let left_out = (to + count - from - 1) % count;
        (1..=left_out).map(move |step| self.corners[(from + step) % count])
    }

    fn chain(&self, side: usize) -> Vec<Segment> {
        let line = self.side(0, side).line;
        let corners: Vec<Point> = [line.a].into_iter().chain(self.between(side)).chain([line.b]).collect();
        corners.windows(2).map(|ends| Segment::new(ends[0], ends[1])).collect()
    }
}
