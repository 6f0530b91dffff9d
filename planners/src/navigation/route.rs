//! Ways over the whole building.

use super::cuts::{Blocked, Cuts};
use super::field::Field;
use super::field::Ground;
use super::highway::{is_clear, straightened};
use super::judge::Judge;
use super::known::Building;
use crate::floor_plan::{NoPath, Rule};
use crate::geometry::{Point, Rect, path_length};

/// Where the network does not let the robot begin, points so far away are tried, metres.
const RINGS_M: [f64; 6] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5];
const A_RING: usize = 12;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Route {
    pub points: Vec<Point>,
    pub length_m: f64,
    pub is_off_network: bool,
}

/// The path of least weight over the network.
pub(super) fn over_network(
    building: &Building,
    ground: Ground,
    blocked: &Blocked,
    [from, to]: [Point; 2],
    judge: &mut impl Judge,
) -> Option<Route> {
    let mut cuts = Cuts::new(&building.network, ground);
    for start in starts(from, &ground) {
        let weigh = |way: &crate::floor_plan::Way| judge.weigh(&cuts.facts(way, blocked));
        match building.network.path(start, to, Rule::Tight, weigh) {
            Ok(path) => {
                let lead = (start != from).then_some(from);
                let points: Vec<Point> = lead.into_iter().chain(path.points).collect();
                let points = straightened(&points, |from, to| {
                    is_clear(&ground.rim, from, to, ground.reach, ground.barriers)
                });
                return Some(Route { length_m: path_length(&points), points, is_off_network: false });
            }
            Err(NoPath::Start) => {}
            Err(_) => return None,
        }
    }
    None
}

/// The shortest path through free space as it is known; none leads out of a building whose walls are known.
pub(super) fn off_network(building: &Building, ground: Ground, [from, to]: [Point; 2]) -> Option<Route> {
    let ends = building.walls.iter().flat_map(|wall| [wall.a, wall.b]);
    let known = Rect::around(ends.clone().chain([from])).grown(ground.grain);
    if !building.walls.is_empty() && !known.contains(to) {
        return None;
    }
    let field = Field::new(Rect::around(ends.chain([from, to])).grown(ground.grain), &ground);
    let points = field.path(from, to)?;
    Some(Route { length_m: path_length(&points), points, is_off_network: true })
}

/// The point itself, and points around it to which there is a free way.
fn starts(from: Point, ground: &Ground) -> impl Iterator<Item = Point> {
    let around = RINGS_M.into_iter().flat_map(move |radius| {
        (0..A_RING).map(move |step| {
            let (sin, cos) = (step as f64 / A_RING as f64 * std::f64::consts::TAU).sin_cos();
            Point::new(from.x + radius * cos, from.y + radius * sin)
        })
    });
    let (barriers, reach, rim) = (ground.barriers, ground.reach, ground.rim);
    std::iter::once(from).chain(around.filter(move |&at| is_clear(&rim, from, at, reach, barriers)))
}
