//! The robot as floor plans know it, and where its centre cannot be.

use std::f64::consts::{PI, TAU};

use geo::{Coord, LineString, MultiPolygon, Polygon};

use super::plan::FloorPlan;
use crate::geometry::Point;
use crate::geometry::polygon::{sides, to_geo};
use crate::geometry::tolerance::SNAP_M;
use crate::read::{Code, MapErrors, Problem};

/// An arc about the end of a wall is drawn as so many edges a whole turn.
const EDGES: usize = 32;

/// A round robot, and what it keeps free around itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    pub radius: f64,
    /// What is kept free besides, metres.
    pub margin: f64,
}

/// Walls that are grown by more, metres, take for ever to be put together.
const WIDEST_M: f64 = 1e6;

impl Disc {
    /// How far its centre stays from walls, metres.
    pub fn reach(&self) -> f64 {
        self.radius + self.margin
    }

    pub(super) fn check(&self) -> Result<(), MapErrors> {
        let Self { radius, margin } = *self;
        let mut problems = Vec::new();
        if !(radius > 0.0 && radius.is_finite()) {
            let message =
                format!("the robot's radius is {radius} and must be a finite number above 0, in metres");
            problems.push(Problem::of_file(Code::NotPositive, message));
        }
        if !(margin >= 0.0 && margin.is_finite()) {
            let message =
                format!("the robot's margin is {margin} and must be a finite number from 0 on, in metres");
            problems.push(Problem::of_file(Code::NotPositive, message));
        }
        if problems.is_empty() && self.reach() > WIDEST_M {
            let message =
                format!("the robot needs {} m on either side, and no floor is so wide", self.reach());
            problems.push(Problem::of_file(Code::RobotTooWide, message));
        }
        if problems.is_empty() { Ok(()) } else { Err(MapErrors { problems }) }
    }

    /// Walls and solids grown by the reach: nowhere by less, about ends of walls by up to a half percent more.
    pub(super) fn grown(&self, plan: &FloorPlan) -> MultiPolygon {
        let solids = plan.solids();
        let rims = solids.iter().flat_map(|solid| sides(solid)).map(|side| [side.a, side.b]);
        let walls = plan.walls().iter().copied().chain(rims);
        let mut shapes: Vec<Polygon> = walls.map(|wall| around(wall, self.reach() + SNAP_M)).collect();
        shapes.extend(solids.iter().map(|solid| to_geo(solid)));
        geo::unary_union(&shapes)
    }
}

/// All points about a wall up to a distance; arcs are drawn around, straight sides are exact.
fn around([a, b]: [Point; 2], distance: f64) -> Polygon {
    let step = TAU / EDGES as f64;
    let out = distance / (step / 2.0).cos();
    let ahead = (b - a).angle();
    let half = |centre: Point, middle: f64| {
        (0..EDGES / 2).map(move |corner| {
            let angle = middle - PI / 2.0 + (corner as f64 + 0.5) * step;
            Coord { x: centre.x + out * angle.cos(), y: centre.y + out * angle.sin() }
        })
    };
    let ring: LineString = half(b, ahead).chain(half(a, ahead + PI)).collect();
    Polygon::new(ring, Vec::new())
}
