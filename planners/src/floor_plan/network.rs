//! The network of places: two adits a doorway, and the ways between them (Crowley, section 4.2).

use super::clear::wall_distance;
use super::disc::Disc;
use super::funnel::funnel;
use super::mesh::{Mesh, Opening};
use super::plan::FloorPlan;
use super::regions::Regions;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, path_length};
use crate::read::{Code, MapErrors, Problem};

/// A point beside a doorway where a disc can be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adit {
    /// The doorway, by index.
    pub doorway: usize,
    /// The region that it lies in, by index.
    pub region: usize,
    pub at: Point,
    /// The adit on the other side, by index.
    pub twin: usize,
}

/// An end of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Spot {
    /// An adit, by index.
    Adit(usize),
    /// A named place, by its index in the plan.
    Place(usize),
    /// Where a path is asked from.
    Start,
    /// Where a path is asked to.
    Goal,
}

/// A way that a disc can go, in both directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    pub from: Spot,
    pub to: Spot,
    /// Metres.
    pub length: f64,
    /// What stays free between the disc and the nearest wall, metres.
    pub clearance: f64,
    /// The doorway that it passes, by index; `None` where it stays in a region.
    pub doorway: Option<usize>,
    /// The region that it stays in, by index; `None` where it passes a doorway.
    pub region: Option<usize>,
    /// From one end to the other; of two points unless a wall stands close beside.
    pub points: Vec<Point>,
}

/// Adits and ways of a floor plan for a disc.
#[derive(Clone, Debug)]
pub struct Network {
    pub disc: Disc,
    pub regions: Regions,
    /// Two for each part of a doorway that the disc can pass, in the order of the doorways.
    pub adits: Vec<Adit>,
    /// Between twins, between adits of a region, and from places to the adits of theirs.
    pub ways: Vec<Way>,
    pub notes: Vec<Problem>,
    pub(super) mesh: Mesh,
    pub(super) barriers: Vec<[Point; 2]>,
}

/// A point of a region where the disc can be, with its triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    pub region: usize,
    pub at: Point,
    pub triangle: u32,
}

impl Network {
    /// Lays adits and ways.
    ///
    /// # Returns
    /// An error where the disc is none, or fits through no doorway though there are some.
    pub fn new(plan: &FloorPlan, disc: Disc) -> Result<Self, MapErrors> {
        disc.check()?;
        let regions = Regions::of(plan);
        let mesh = Mesh::new(plan, &regions, &disc);
        if mesh.openings.is_empty() && !regions.doorways.is_empty() {
            let widest = regions.doorways.iter().map(super::Doorway::width).fold(0.0, f64::max);
            let message = format!(
                "the robot is too wide for every doorway: it needs more than {} m ({} m and a margin of {} m on \
                 either side), and the widest has {} m",
                2.0 * disc.reach(),
                2.0 * disc.radius,
                disc.margin,
                (widest * 1000.0).round() / 1000.0,
            );
            return Err(Problem::of_file(Code::RobotTooWide, message).into());
        }
        let (adits, ways, notes) = (Vec::new(), Vec::new(), Vec::new());
        let mut network = Self { disc, regions, adits, ways, notes, mesh, barriers: plan.barriers() };
        network.lay_adits();
        network.lay_ways();
        network.join_places(plan);
        Ok(network)
    }

    /// The network of a building of which nothing is known: no region, no way.
    pub fn none(disc: Disc) -> Self {
        let (regions, mesh) = (Regions::default(), Mesh::default());
        Self {
            disc,
            regions,
            adits: Vec::new(),
            ways: Vec::new(),
            notes: Vec::new(),
            mesh,
            barriers: Vec::new(),
        }
    }

    /// The adits of a region, by index.
    pub fn adits_of(&self, region: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.adits.len()).filter(move |&adit| self.adits[adit].region == region)
    }

    /// The region in which the disc stands at a point, by index; `None` where it cannot.
    pub fn region_of(&self, at: Point) -> Option<usize> {
        self.stand(at).map(|standing| standing.region)
    }

    fn lay_adits(&mut self) {
        for opening in self.mesh.openings.clone() {
            let doorway = &self.regions.doorways[opening.doorway];
            let sides = [0, 1].map(|side| (doorway.regions[side], self.beside(&opening, side)));
            let first = self.adits.len();
            for (side, (region, at)) in sides.into_iter().enumerate() {
                let twin = first + 1 - side;
                self.adits.push(Adit { doorway: opening.doorway, region, at, twin });
            }
        }
    }

    /// The adit on one side of a opening: as far inside the region as the disc keeps from walls, or nearer where that
    /// is too far.
    fn beside(&self, opening: &Opening, side: usize) -> Point {
        let ([a, b], middle) = (opening.ends, opening.middle());
        let width = a.distance(b).max(f64::MIN_POSITIVE);
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let inward = Point::new(-(b.y - a.y) / width * sign, (b.x - a.x) / width * sign);
        let region = self.regions.doorways[opening.doorway].regions[side];
        let reach = self.disc.reach();
        let spots = [1.0, 0.75, 0.5, 0.25].map(|share| {
            let metres = share * reach;
            middle + inward * metres
        });
        let can_stand = |at: &Point| {
            self.mesh.locate(region, *at).is_some()
                && wall_distance(&[middle, *at], &self.barriers) >= reach - ROUNDING_M
        };
        spots.into_iter().find(can_stand).unwrap_or(middle)
    }

    pub(super) fn standing(&self, adit: usize) -> Standing {
        let Adit { region, at, .. } = self.adits[adit];
        let opening = &self.mesh.openings[adit / 2];
        let triangle = self.mesh.locate(region, at).unwrap_or(opening.triangles[adit % 2]);
        Standing { region, at, triangle }
    }

    fn lay_ways(&mut self) {
        for first in (0..self.adits.len()).step_by(2) {
            let points = vec![self.adits[first].at, self.adits[first + 1].at];
            let doorway = Some(self.adits[first].doorway);
            let way = self.way([Spot::Adit(first), Spot::Adit(first + 1)], points, doorway, None);
            self.ways.push(way);
        }
        for region in 0..self.regions.regions.len() {
            let own: Vec<usize> = self.adits_of(region).collect();
            for (place, &from) in own.iter().enumerate() {
                for &to in &own[place + 1..] {
                    let spots = [Spot::Adit(from), Spot::Adit(to)];
                    let way = self.inside(spots, self.standing(from), self.standing(to));
                    self.ways.extend(way);
                }
            }
        }
    }

    fn join_places(&mut self, plan: &FloorPlan) {
        for (number, place) in plan.places().iter().enumerate() {
            let Some(standing) = self.stand(place.at) else {
                let distance = wall_distance(&[place.at, place.at], &self.barriers);
                let message = format!(
                    "the place `{}` is {distance:.3} m from a wall, and the robot needs {} m: it cannot go there",
                    place.name,
                    self.disc.reach()
                );
                self.notes.push(plan.problem_of_place(number, Code::PlaceInWall, message).as_advice());
                continue;
            };
            let ways = self.ways_from(Spot::Place(number), standing);
            self.ways.extend(ways);
        }
    }

    /// Where a disc stands at a point; `None` where a wall is too near.
    pub(super) fn stand(&self, at: Point) -> Option<Standing> {
        let regions = self.regions.regions.iter().enumerate().filter(|(_, region)| region.contains(at));
        let mut standing = regions.filter_map(|(region, _)| {
            self.mesh.locate(region, at).map(|triangle| Standing { region, at, triangle })
        });
        standing.next()
    }

    /// The ways from a point to the adits of its region.
    pub(super) fn ways_from(&self, spot: Spot, from: Standing) -> Vec<Way> {
        let adits = self.adits_of(from.region);
        adits.filter_map(|adit| self.inside([spot, Spot::Adit(adit)], from, self.standing(adit))).collect()
    }

    /// The way between two points of a region; `None` where walls close it within the region.
    pub(super) fn inside(&self, ends: [Spot; 2], from: Standing, to: Standing) -> Option<Way> {
        let gates = self.mesh.gates(from.region, from.triangle, to.triangle)?;
        Some(self.way(ends, funnel(from.at, &gates, to.at), None, Some(from.region)))
    }

    fn way(&self, ends: [Spot; 2], points: Vec<Point>, doorway: Option<usize>, region: Option<usize>) -> Way {
        let [from, to] = ends;
        let clearance = wall_distance(&points, &self.barriers) - self.disc.radius;
        Way { from, to, length: path_length(&points), clearance, doorway, region, points }
    }
}
