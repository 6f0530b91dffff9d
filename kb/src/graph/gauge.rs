//! How near to anything solid a robot comes on its way.

use std::collections::BTreeMap;
use std::sync::Arc;

use adit_db::robot::State;
use adit_engine::KnowledgeBase as Inference;
use adit_planners::clearance::Solids;
use adit_planners::geometry::Point;
use adit_planners::rect_index::RectIndex;
use adit_planners::routes::{RoomIndex, Way};
use adit_planners::world::World;

use crate::graph::SiteGraph;
use crate::graph::heading;

/// Everything solid of a map, and the sizes of the states.
pub struct Gauge {
    solids: Arc<Solids>,
    /// What encloses the obstacles of the map, by index.
    obstacles: Arc<RectIndex>,
    sizes: Sizes,
}

/// Half the width and the height of each state of each robot, metres.
pub type Sizes = BTreeMap<(String, String), (f64, f64)>;

/// The sizes that are told or concluded.
pub fn sizes(knowledge: &Inference) -> Sizes {
    let numbers = |property| knowledge.numbers("ROBOTS", property).unwrap_or_default();
    let texts = |property| knowledge.texts("ROBOTS", property).unwrap_or_default();
    let (robots, states) = (texts("robot"), texts("state"));
    let (widths, heights) = (numbers("width"), numbers("height"));
    let size = |row: usize| {
        let (robot, state) = (robots.get(row)?.as_ref()?, states.get(row)?.as_ref()?);
        let size = ((*widths.get(row)?)? / 2.0, (*heights.get(row)?)?);
        Some(((robot.to_string(), state.to_string()), size))
    };
    (0..robots.len()).filter_map(size).collect()
}

/// The sizes of states as the database has them.
pub fn sizes_of(states: &[State]) -> Sizes {
    let size =
        |state: &State| ((state.robot.clone(), state.state.clone()), (state.width / 2.0, state.height));
    states.iter().map(size).collect()
}

impl Gauge {
    /// What is solid in the world, for robots of these sizes.
    pub fn new(world: &World, sizes: Sizes) -> Self {
        let obstacles =
            RectIndex::new(world.obstacles.iter().map(|obstacle| obstacle.shape.enclosing_rect()));
        Self { solids: Arc::new(Solids::new(world)), obstacles: Arc::new(obstacles), sizes }
    }

    /// The same for robots of other sizes.
    #[must_use]
    pub fn resized(&self, sizes: Sizes) -> Self {
        Self { solids: Arc::clone(&self.solids), obstacles: Arc::clone(&self.obstacles), sizes }
    }

    /// Whether a point of the world lies inside something solid, as [`World::is_solid`] says.
    pub fn is_solid(&self, world: &World, at: Point) -> bool {
        let drawn = self.obstacles.at(at).into_iter().any(|index| world.obstacles[index].shape.contains(at));
        drawn || world.occupancy.as_ref().is_some_and(|cells| cells.is_blocked_at(at))
    }

    /// For each leg of a way the least metres between the robot's rim and anything solid since the last bend; `None`
    /// in rooms of no state.
    pub fn clearances(&self, graph: &SiteGraph, way: &Way, bends: &[bool]) -> Vec<Option<f64>> {
        let mut since: Option<f64> = None;
        let mut all = Vec::with_capacity(way.legs.len());
        for (leg, bends) in way.legs.iter().zip(bends) {
            if *bends {
                since = None;
            }
            let here = self.clearance(graph, leg.room, leg.from, leg.to);
            since = match (since, here) {
                (Some(since), Some(here)) => Some(since.min(here)),
                (since, here) => since.or(here),
            };
            all.push(since);
        }
        all
    }

    fn clearance(&self, graph: &SiteGraph, room: RoomIndex, from: Point, to: Point) -> Option<f64> {
        let (half, height) = self.sizes.get(graph[room].layer.as_ref()?)?;
        Some((self.solids.gap(from, to, *height) - half).max(0.0))
    }
}

/// For each leg of a way whether the robot turns or changes its shape where it begins; at the first one it starts.
pub fn bends(graph: &SiteGraph, way: &Way) -> Vec<bool> {
    /// Radians by which a straight way may seem to turn.
    const STRAIGHT: f64 = 1e-6;
    let mut last: Option<f64> = None;
    let mut bends = Vec::with_capacity(way.legs.len());
    let mut changes = true;
    for leg in &way.legs {
        let heading = (leg.length() > 1e-9).then(|| (leg.to.y - leg.from.y).atan2(leg.to.x - leg.from.x));
        let turn = match (last, heading) {
            (Some(last), Some(heading)) => {
                let turn = (heading - last).rem_euclid(std::f64::consts::TAU);
                turn.min(std::f64::consts::TAU - turn) > STRAIGHT
            }
            _ => false,
        };
        bends.push(changes || turn);
        if changes {
            last = None;
        }
        last = heading.or(last);
        changes = leg.door.is_some_and(|door| graph.graph()[door].is_change());
    }
    bends
}

/// For each leg of a way the heading with which it ends; a leg of no length goes on as the one before.
pub fn headings(way: &Way, bends: &[bool]) -> Vec<Option<f64>> {
    let mut last = None;
    let all = way.legs.iter().zip(bends).map(|(leg, bends)| {
        last = heading(leg.from, leg.to).or(last.filter(|_| !bends));
        last
    });
    all.collect()
}
