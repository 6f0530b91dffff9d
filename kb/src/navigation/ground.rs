//! A site whose rooms are cut by state, as a robot drives in it: what stands, what hangs low, and its shapes.

use std::collections::BTreeMap;

use adit_db::room::Room;
use adit_db::route::Waypoint;
use adit_planners::floor_plan::{Disc, FloorPlan, Network};
use adit_planners::geometry::{Point, Rect, Segment, polygon};
use adit_planners::navigation::{Building, Drivable, Outfit, Stretch};
use adit_planners::routes::RoomIndex;
use adit_planners::simulator::{Shape, Shapes};

use crate::answer::{Answer, Status, pick};
use crate::error::{Code, Error, Result};
use crate::graph::{Building as Spaces, is_weighed};
use crate::navigation::body::{Outline, Used};
use crate::plan::figures;
use crate::site::driving::Driving;
use crate::state::State;

/// How fast a robot is whose table does not say it, metres a second.
const SPEED_M_S: f64 = 0.5;

/// A site as one of its robots drives in it.
#[derive(Debug)]
pub struct Ground {
    pub robot: String,
    /// The names of the robot's shapes, by number: those of its states in which it can move.
    pub states: Vec<String>,
    pub shapes: Shapes,
    /// The shapes, as a body tells them.
    pub outlines: Vec<Outline>,
    /// The building as it is for the robot in each stance: in a shape, at each of its facings where it is longer than wide.
    pub buildings: Vec<Building>,
    /// What stands, whatever the robot's height.
    pub plan: FloorPlan,
    /// What the map shows, as far as it goes.
    bounds: Rect,
    pub walls: Vec<Segment>,
    /// Where spaces go over into each other.
    pub doorways: Vec<Segment>,
    /// How it drives, and what it senses.
    pub driving: Driving,
    /// Hardness of changes of shape, by shapes.
    changes: BTreeMap<(usize, usize), f64>,
}

/// What nobody may cross in a state, though nothing is there: doorways that are closed, and the outlines of rooms that rules let
/// nobody enter.
fn closed(state: &State, of: &(String, String), facing: Option<f64>) -> Vec<Segment> {
    let graph = state.graph();
    let doorways = graph.building.closed().map(Spaces::segment);
    let is_shut = |room: &&Room| is_of(room, of, facing) && !is_weighed(room);
    let rooms = graph.rooms.iter().enumerate().filter(|(_, room)| is_shut(room));
    let outlines = rooms.flat_map(|(index, _)| {
        let corners: Vec<Point> = graph.outline(RoomIndex::new(index)).corners().collect();
        polygon::sides(&corners).collect::<Vec<_>>()
    });
    doorways.chain(outlines).collect()
}

/// Whether a room is one of a state, at a facing.
fn is_of(room: &Room, of: &(String, String), facing: Option<f64>) -> bool {
    room.layer.as_ref() == Some(of) && room.facing == facing
}

/// Where the middle of a robot may be in a state, at a facing.
fn floor(state: &State, of: &(String, String), facing: Option<f64>) -> Vec<Vec<Point>> {
    let graph = state.graph();
    let rooms = graph.rooms.iter().enumerate();
    let own = rooms.filter(|(_, room)| is_of(room, of, facing) && is_weighed(room));
    own.map(|(index, _)| graph.outline(RoomIndex::new(index)).corners().collect()).collect()
}

/// Where a waypoint is.
pub(super) const fn at(waypoint: &Waypoint) -> Point {
    Point::new(waypoint.x, waypoint.y)
}

impl Ground {
    /// The site as it is now, for one of its robots.
    pub fn of(state: &State, robot: Option<&str>) -> Result<Self> {
        let robot = pick(&state.robots(), robot)?;
        let plan =
            FloorPlan::of_world(&state.world, Some(0.0)).map_err(|errors| Error::all(errors.problems))?;
        let walls: Vec<Segment> = plan.barriers().into_iter().map(Segment::from).collect();
        let asked = state.asked();
        let rows = asked.objects("ROBOTS");
        let mut ground = Self {
            shapes: Shapes { all: Vec::new(), seconds: BTreeMap::new() },
            doorways: state.graph().building.doorways.iter().map(Spaces::segment).collect(),
            robot,
            states: Vec::new(),
            outlines: Vec::new(),
            buildings: Vec::new(),
            plan,
            bounds: state.world.bounds,
            walls,
            driving: figures::driving(&asked, Driving::of_rooms())?,
            changes: BTreeMap::new(),
        };
        for row in rows.rows() {
            let of =
                (rows.text(row, "robot").unwrap_or_default(), rows.text(row, "state").unwrap_or_default());
            let has_rooms = state.graph().rooms.iter().any(|room| room.layer.as_ref() == Some(&of));
            if of.0 == ground.robot && has_rooms {
                ground.add(state, of.1, rows.number(row, "speed"));
            }
        }
        if ground.states.is_empty() {
            let message = format!("{} has rooms in no state: there is nowhere to drive", ground.robot);
            return Err(Error::said(Code::SimulateImpossible, message, None));
        }
        ground.driving.navigation.speed_m_s =
            ground.shapes.all.iter().map(|shape| shape.greatest_speed_m_s).fold(0.0, f64::max);
        let rows = asked.objects("CHANGES");
        for row in rows.rows() {
            let shape = |name| rows.text(row, name).and_then(|state| ground.shape(&state));
            let is_own = rows.text(row, "robot").is_some_and(|robot| robot == ground.robot);
            if let (true, Some(from), Some(to)) = (is_own, shape("from_state"), shape("to_state")) {
                ground.shapes.seconds.extend(rows.number(row, "seconds").map(|value| ((from, to), value)));
                ground.changes.extend(rows.number(row, "hardness").map(|value| ((from, to), value)));
            }
        }
        Ok(ground)
    }

    /// A shape more: that of a state.
    fn add(&mut self, state: &State, name: String, speed: Option<f64>) {
        let of = (self.robot.clone(), name);
        let Some(size) = state.gauge.size(&of) else { return };
        let outline = Outline { name: of.1.clone(), radius_m: size.width / 2.0, length_m: size.length };
        let rim = outline.rim();
        let low = state.world.bridges.iter().filter(|bridge| size.height >= bridge.height);
        let overhead: Vec<Rect> = low.map(|bridge| bridge.rect).collect();
        let sides: Vec<Segment> = overhead.iter().flat_map(polygon::sides_of_rect).collect();
        for facing in state.graph().facings(&of) {
            let network = Network::none(Disc { radius: rim.inner_m(), margin: 0.0 });
            let building = Building {
                overhead: sides.clone(),
                floor: floor(state, &of, facing),
                closed: closed(state, &of, facing),
                ..Building::of_walls(network, self.walls.clone())
            };
            self.buildings.push(building.in_stance(self.states.len(), &rim, facing.map(f64::to_radians)));
        }
        self.shapes.all.push(Shape { rim, greatest_speed_m_s: speed.unwrap_or(SPEED_M_S), overhead });
        self.states.push(of.1);
        self.outlines.push(outline);
    }

    /// The number of the shape of a state.
    pub fn shape(&self, state: &str) -> Option<usize> {
        self.states.iter().position(|known| known == state)
    }

    /// The stance of a shape, at a facing in degrees if it has any.
    fn stance(&self, shape: usize, facing: Option<f64>) -> Option<usize> {
        let facing = facing.map(f64::to_radians);
        self.buildings.iter().position(|stance| stance.shape == shape && stance.facing == facing)
    }

    /// The stance of a shape that is nearest to how a robot stands there.
    pub fn stance_at(&self, shape: usize, heading: f64) -> usize {
        let own = self.buildings.iter().enumerate().filter(|(_, stance)| stance.shape == shape);
        let off = |stance: &Building| stance.off_facing(heading).abs();
        let nearest = own.min_by(|(_, one), (_, other)| off(one).total_cmp(&off(other)));
        nearest.map_or(0, |(number, _)| number)
    }

    /// The name of the state of a stance, and the facing in degrees.
    pub fn of_stance(&self, stance: usize) -> (&str, Option<f64>) {
        let building = &self.buildings[stance];
        (&self.states[building.shape], building.facing.map(f64::to_degrees))
    }

    /// The stances in which the robot fits at a point, by number; at least one.
    pub fn fitting(&self, state: &State, at: Point) -> Result<Vec<usize>> {
        let fitting = state.graph().stances_at(&state.gauge, at, Some(&self.robot));
        let stance = |(state, facing): (&str, Option<f64>)| self.stance(self.shape(state)?, facing);
        let mut stances: Vec<usize> = fitting.into_iter().filter_map(stance).collect();
        stances.sort_unstable();
        if stances.is_empty() {
            let message =
                format!("no robot can begin at ({:?}, {:?}): it fits there in no state", at.x, at.y);
            return Err(Error::said(Code::SimulateImpossible, message, None));
        }
        Ok(stances)
    }

    /// Its shapes, as a body must have them that is driven here.
    pub fn used(&self) -> Vec<Used> {
        let used = |outline: &Outline| Used { rim: outline.rim(), name: Some(outline.name.clone()) };
        self.outlines.iter().map(used).collect()
    }

    /// Where a simulated robot that begins in a stance drives, and how it is set.
    pub fn stage(&self, stance: usize) -> (Drivable<'_>, Outfit) {
        let on =
            Drivable { walls: &self.walls, shapes: Some(&self.shapes), stance, buildings: &self.buildings };
        (on, self.driving.outfit(self.buildings[stance].rim.inner_m()))
    }

    /// The least room that the robot needs about its middle, metres: in its smallest shape, turning any way.
    pub fn least_radius(&self) -> f64 {
        self.shapes.all.iter().map(|shape| shape.rim.outer_m()).fold(f64::INFINITY, f64::min)
    }

    /// The most room that it needs there, metres.
    pub fn widest_radius(&self) -> f64 {
        self.shapes.all.iter().map(|shape| shape.rim.outer_m()).fold(0.0, f64::max)
    }

    /// Whether something lies on the map, so that it can be laid over it.
    pub fn is_on_map(&self, outline: &[Point]) -> bool {
        Rect::around(outline.iter().copied()).overlaps(&self.bounds)
    }

    /// Whether a route ends at a point, as near as a robot has to come to it.
    pub fn leads_to(&self, answer: &Answer, goal: Point) -> bool {
        let tolerance = self.driving.navigation.goal_tolerance_m;
        answer.waypoints.last().is_some_and(|last| at(last).distance(goal) <= tolerance)
    }

    /// A route as it is driven, from stance to stance; `None` where there is none.
    pub fn stretches(&self, answer: &Answer) -> Option<Vec<Stretch>> {
        if !matches!(answer.status, Status::Ok | Status::SameRoom) {
            return None;
        }
        let mut way: Vec<Stretch> = Vec::new();
        for waypoint in &answer.waypoints {
            let shape = self.shape(waypoint.state.as_deref()?)?;
            let (at, stance) = (at(waypoint), self.stance(shape, waypoint.facing)?);
            match way.last_mut() {
                Some(stretch) if stretch.stance == stance => stretch.points.push(at),
                Some(stretch) => {
                    let from = stretch.points.last().copied().unwrap_or(at);
                    way.push(Stretch { stance, points: vec![from, at] });
                }
                None => way.push(Stretch { stance, points: vec![at] }),
            }
        }
        Some(way)
    }

    /// The hardness of what a robot did: of its metres by the rooms in which it went them, and of its changes of shape.
    ///
    /// # Arguments
    /// `track` is where it was, in which shape. Where it was in no room of its shape, being a little off, the room before
    /// counts.
    pub fn hardness(&self, state: &State, track: &[(Point, usize)], changes: &[(usize, usize)]) -> f64 {
        let graph = state.graph();
        let (mut total, mut last) = (0.0, 0.0);
        for leg in track.windows(2) {
            let of = (self.robot.clone(), self.states[leg[0].1].clone());
            let middle = leg[0].0.lerp(leg[1].0, 0.5);
            let here = graph.rooms_at(&of, middle).filter_map(|room| graph[room].hardness.value);
            last = here
                .fold(None, |least: Option<f64>, one| Some(least.map_or(one, |least| least.min(one))))
                .unwrap_or(last);
            total += last * leg[0].0.distance(leg[1].0);
        }
        total + changes.iter().map(|change| self.changes.get(change).copied().unwrap_or(0.0)).sum::<f64>()
    }
}
