//! How near to anything solid a robot comes on its way.

use std::collections::BTreeMap;
use std::sync::Arc;

use adit_db::robot::State;
use adit_engine::KnowledgeBase as Inference;
use adit_planners::clearance::{Footprint, Hindrance, Solids};
use adit_planners::geometry::{Point, Segment};
use adit_planners::rect_index::RectIndex;
use adit_planners::routes::{RoomIndex, Way};
use adit_planners::world::{self, World};

use crate::graph::SiteGraph;
use crate::graph::heading;
use crate::graph::layers::Shape;

/// Everything solid of a map, and the sizes of the states.
pub struct Gauge {
    floor: Arc<Floor>,
    sizes: Sizes,
}

/// What of a map does not hang on states.
struct Floor {
    solids: Solids,
    /// What encloses the obstacles of the map, by index.
    obstacles: RectIndex,
    areas: Vec<world::Shape>,
    doors: Vec<Segment>,
    /// Kept free around every state besides its own width, metres.
    clearance: f64,
}

/// The sizes of each state of each robot.
pub type Sizes = BTreeMap<(String, String), Size>;

/// Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    pub width: f64,
    pub height: f64,
    /// `None` for a disc of its width.
    pub length: Option<f64>,
}

/// The sizes that are told or concluded.
pub fn sizes(knowledge: &Inference) -> Sizes {
    let numbers = |property| knowledge.numbers("ROBOTS", property).unwrap_or_default();
    let texts = |property| knowledge.texts("ROBOTS", property).unwrap_or_default();
    let (robots, states) = (texts("robot"), texts("state"));
    let (widths, heights, lengths) = (numbers("width"), numbers("height"), numbers("length"));
    let size = |row: usize| {
        let (robot, state) = (robots.get(row)?.as_ref()?, states.get(row)?.as_ref()?);
        let (width, height) = ((*widths.get(row)?)?, (*heights.get(row)?)?);
        let length = lengths.get(row).copied().flatten();
        Some(((robot.to_string(), state.to_string()), Size { width, height, length }))
    };
    (0..robots.len()).filter_map(size).collect()
}

/// The sizes of states as the database has them.
pub fn sizes_of(states: &[State]) -> Sizes {
    let size = |state: &State| {
        let &State { width, height, length, .. } = state;
        ((state.robot.clone(), state.state.clone()), Size { width, height, length })
    };
    states.iter().map(size).collect()
}

impl Gauge {
    /// The sizes of each state of each robot.
    pub fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// What is solid in the world, for robots of these sizes.
    pub fn new(world: &World, sizes: Sizes) -> Self {
        let obstacles = world.obstacles.iter().map(|obstacle| obstacle.shape.enclosing_rect());
        let doors = world.named_doors.iter().map(|door| Segment::new(door.from, door.to));
        let floor = Floor {
            solids: Solids::new(world),
            obstacles: RectIndex::new(obstacles),
            areas: world.areas.iter().map(|area| area.shape.clone()).collect(),
            doors: doors.collect(),
            clearance: world.clearance,
        };
        Self { floor: Arc::new(floor), sizes }
    }

    /// The same for robots of other sizes.
    #[must_use]
    pub fn resized(&self, sizes: Sizes) -> Self {
        Self { floor: Arc::clone(&self.floor), sizes }
    }

    /// Whether a state at a facing fits all along a straight way; what is no state's does not.
    pub fn fits(&self, of: Shape<'_>, a: Point, b: Point) -> bool {
        self.footprint(of).is_some_and(|footprint| self.floor.solids.fits(&footprint, a, b))
    }

    /// The nearest point at which a state at a facing fits, as [`Solids::nearest_fit`] has it.
    pub fn nearest_fit(
        &self,
        of: Shape<'_>,
        at: Point,
        within: f64,
        is_accepted: impl Fn(Point) -> bool,
    ) -> Option<Point> {
        self.floor.solids.nearest_fit(&self.footprint(of)?, at, within, is_accepted)
    }

    /// The size of a state.
    pub fn size(&self, of: &(String, String)) -> Option<Size> {
        self.sizes.get(of).copied()
    }

    /// How wide an opening must be for a state, whichever way it turns, metres.
    pub fn needs(&self, of: &(String, String)) -> Option<f64> {
        let Size { width, length, .. } = self.size(of)?;
        Some(width.min(length.unwrap_or(width)) + 2.0 * self.floor.clearance)
    }

    /// What keeps a state from going a way, as [`Solids::hindrance`] finds it.
    pub fn hindrance(
        &self,
        of: &(String, String),
        facings: &[Option<f64>],
        way: &[Segment],
    ) -> Option<Hindrance> {
        let footprints = facings.iter().filter_map(|facing| self.footprint((Some(of), *facing)));
        self.floor.solids.hindrance(&footprints.collect::<Vec<_>>(), self.needs(of)?, way)
    }

    fn footprint(&self, (of, facing): Shape<'_>) -> Option<Footprint> {
        let Size { width, height, length } = *self.sizes.get(of?)?;
        Some(Footprint::new((width, height), self.floor.clearance, length.zip(facing)))
    }

    /// The outlines of the named areas.
    pub fn areas(&self) -> &[world::Shape] {
        &self.floor.areas
    }

    /// The named doors, across their openings.
    pub fn doors(&self) -> &[Segment] {
        &self.floor.doors
    }

    /// Whether a point of the world lies inside something solid, as [`World::is_solid`] says.
    pub fn is_solid(&self, world: &World, at: Point) -> bool {
        let drawn =
            self.floor.obstacles.at(at).into_iter().any(|index| world.obstacles[index].shape.contains(at));
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
        let size = self.sizes.get(graph[room].layer.as_ref()?)?;
        Some((self.floor.solids.gap(from, to, size.height) - size.width / 2.0).max(0.0))
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
