//! How good a learned building is, beside the true one.

use geo::{Area, BooleanOps, MultiPolygon};

use super::Learned;
use crate::floor_plan::clear::wall_distance;
use crate::floor_plan::{Drawn, FloorPlan, Regions};
use crate::geometry::Point;
use crate::geometry::polygon::to_geo;
use crate::read::MapErrors;

/// Walls are compared at points so far apart, metres.
const STEP_M: f64 = 0.05;

/// A learned building compared with the true one, in the frame of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// The true free space that is joined with the start, square metres.
    pub true_m2: f64,
    /// The share of it that was learned, from 0 to 1.
    pub share: f64,
    /// What was learned to be free and is not, square metres.
    pub outside_m2: f64,
    /// How far beyond the nearest true wall that reaches, metres.
    pub outside_m: f64,
    /// From learned walls to the nearest true one, metres: half of them are nearer, 95 % of them, all.
    pub walls_off_m: [f64; 3],
    /// From true walls to the nearest learned one, or to what was left out, metres; likewise.
    pub walls_missed_m: [f64; 3],
    pub regions: usize,
}

/// Compares a learned building with the true one.
///
/// # Returns
/// An error where the learned walls make no floor plan.
pub fn score(learned: &Learned, truth: &FloorPlan) -> Result<Score, MapErrors> {
    let drawn = Drawn { walls: truth.walls().to_vec(), solids: truth.solids().to_vec(), ..Drawn::default() };
    let truth = FloorPlan::around(drawn, learned.start)?;
    let found = learned.plan("learned")?;
    let regions = Regions::of(&found);
    let (free, known) = (area(&Regions::of(&truth)), area(&regions));
    let (true_walls, walls) = (truth.barriers(), found.barriers());
    let outside = known.difference(&free);
    let corners = outside.iter().flat_map(|part| part.exterior().coords()).map(|c| Point::new(c.x, c.y));
    let surfaces: Vec<[Point; 2]> = learned.walls.iter().map(|wall| [wall.a, wall.b]).collect();
    let true_m2 = free.unsigned_area();
    Ok(Score {
        true_m2,
        share: known.intersection(&free).unsigned_area() / true_m2,
        outside_m2: outside.unsigned_area(),
        outside_m: corners.map(|p| wall_distance(&[p, p], &true_walls)).fold(0.0, f64::max),
        walls_off_m: spread(&surfaces, &true_walls),
        walls_missed_m: spread(&true_walls, &walls),
        regions: regions.regions.len(),
    })
}

fn area(regions: &Regions) -> MultiPolygon {
    let outlines: Vec<_> = regions.regions.iter().map(|region| to_geo(&region.outline)).collect();
    geo::unary_union(&outlines)
}

/// How far points of some walls are from others.
fn spread(walls: &[[Point; 2]], from: &[[Point; 2]]) -> [f64; 3] {
    let mut far: Vec<f64> = Vec::new();
    for &[a, b] in walls {
        let count = (a.distance(b) / STEP_M).ceil().max(1.0);
        for step in 0..=count as u32 {
            let share = f64::from(step) / count;
            let p = a.lerp(b, share);
            far.push(wall_distance(&[p, p], from));
        }
    }
    far.sort_by(f64::total_cmp);
    let at = |share: f64| far.get(((far.len().max(1) - 1) as f64 * share) as usize).copied().unwrap_or(0.0);
    [at(0.5), at(0.95), at(1.0)]
}
