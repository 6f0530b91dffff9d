//! A site as a scene to be drawn: its map, its tables, and a route.

use adit_db::{Store, Tx};
use adit_planners::geometry::{Convex, Point, Rect, Segment};
use adit_planners::world::{Occupancy, Place, Shape, World};

use crate::answer::{Answer, Status, pick_robot};
use crate::draw::{ClosedTo, Closing, Door, PrimeArea, Room, Route, Scene, Step, StepKind};
use crate::error::{Code, Error, Result};
use crate::graph::{Building, SiteGraph, crossing_of, outline_of, rect_of};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::told::Whom;

impl KnowledgeBase {
    /// What is to be seen of the site, with a route from start to goal where one is asked for.
    pub fn scene(&self, route: Option<(&str, &str)>, robot: Option<&str>) -> Result<Scene> {
        let world = Store::open_read_only(self.database())?.snapshot(|tx| self.world(tx))?;
        if robot.is_some() {
            Store::open_read_only(self.database())?.snapshot(|tx| pick_robot(tx, robot))?;
        }
        let answer = route.map(|(start, goal)| self.route(start, goal, robot)).transpose()?;
        let mut scene =
            Store::open_read_only(self.database())?.snapshot(|tx| scene(tx, &self.site().name, &world))?;
        crop(&mut scene, &world);
        if let Some(answer) = answer {
            if !matches!(answer.status, Status::Ok | Status::SameRoom) {
                let why = answer.reason.unwrap_or_default();
                let (code, message) = if let Some(unknown) = answer.status.code() {
                    (unknown, why)
                } else {
                    let message = format!("no route from {} to {}: {why}", answer.start, answer.goal);
                    (Code::DrawNoRoute, message)
                };
                return Err(Error::said(code, message, None));
            }
            scene.route = Some(self.drawn(&answer)?);
        }
        Ok(scene)
    }

    fn drawn(&self, answer: &Answer) -> Result<Route> {
        let graph = Store::open_read_only(self.database())?
            .snapshot(|tx| -> Result<SiteGraph> { SiteGraph::read(tx) })?;
        let place = |name: &str| Place {
            name: name.to_owned(),
            at: graph.end(name).map_or(Point::default(), |end| graph.point(&end)),
        };
        let step = |row: &adit_db::route::Step| Step {
            kind: match row.kind.as_str() {
                "door" => StepKind::Door,
                "change" => StepKind::Change,
                _ => StepKind::Room,
            },
            place: row.place.clone(),
            state: row.state.clone(),
            action: row.action.clone(),
            hardness: row.hardness.unwrap_or_default(),
            to: Point::new(row.x.unwrap_or_default(), row.y.unwrap_or_default()),
            heading: row.heading,
        };
        Ok(Route {
            start: place(&answer.start),
            goal: place(&answer.goal),
            steps: answer.steps.iter().map(step).collect(),
            cost: answer.cost.unwrap_or_default(),
        })
    }
}

/// An image map is often mostly unknown: what lies far from every room is cut off.
fn crop(scene: &mut Scene, world: &World) {
    if world.occupancy.is_none() || scene.rooms.is_empty() {
        return;
    }
    let all = Rect::around(scene.rooms.iter().flat_map(|room| room.outline.corners()));
    let seen = all.grown(0.05 * all.dx().max(all.dy()));
    scene.bounds = scene.bounds.intersection(&seen).unwrap_or(scene.bounds);
    let bounds = scene.bounds;
    scene.obstacles = std::mem::take(&mut scene.obstacles)
        .into_iter()
        .filter_map(|shape| match shape {
            Shape::Rect(rect) => bounds.intersection(&rect).map(Shape::Rect),
            polygon @ Shape::Polygon(_) => polygon.enclosing_rect().overlaps(&bounds).then_some(polygon),
        })
        .collect();
}

/// The state in which most of a route's rooms are crossed: the layer that its picture shows.
pub fn main_state(route: &Route) -> Option<String> {
    let rooms = route.steps.iter().filter(|step| step.kind == StepKind::Room);
    let states: Vec<&String> = rooms.filter_map(|step| step.state.as_ref()).collect();
    let count = |state: &String| states.iter().filter(|other| **other == state).count();
    states.iter().rev().max_by_key(|state| count(state)).map(|state| (*state).clone())
}

fn scene(tx: &mut Tx<'_>, title: &str, world: &World) -> Result<Scene> {
    let mut scene = Scene::new(title, world.bounds);
    scene.obstacles = world.obstacles.iter().map(|obstacle| obstacle.shape.clone()).collect();
    scene.obstacles.extend(world.occupancy.iter().flat_map(Occupancy::rectangles).map(Shape::Rect));
    scene.bridges.clone_from(&world.bridges);
    scene.places.clone_from(&world.places);
    scene.areas.clone_from(&world.areas);
    scene.named_doors.clone_from(&world.named_doors);
    scene.closings = closings(&Building::read(tx)?);
    let rooms = tx.rooms()?;
    // an outline that somebody else spoilt is drawn as the box about it
    let outline = |room: &adit_db::room::Room| outline_of(room).unwrap_or_else(|_| rect_of(room).into());
    let outlines: Vec<Convex> = rooms.iter().map(outline).collect();
    let index = |key: i64| rooms.binary_search_by_key(&key, |room| room.room).unwrap_or_default();
    for door in tx.doors()? {
        let sides = [door.side1.room, door.side2.room].map(index);
        scene.doors.push(Door {
            number: door.door,
            kind: door.kind,
            room1: sides[0],
            room2: sides[1],
            crossing: Some(crossing_of(&door, sides.map(|room| &outlines[room]))),
            at: Point::new(door.at[0], door.at[1]),
            hardness: door.hardness.value,
            action: door.action.value,
            passable: door.passable.value.unwrap_or(false),
            one_way: door.one_way,
        });
    }
    scene.rooms = rooms
        .into_iter()
        .zip(outlines)
        .map(|(room, outline)| Room {
            name: room.name,
            outline,
            state: room.layer.map(|(_, state)| state),
            height: room.height,
            hardness: room.hardness.value,
            action: room.action.value,
        })
        .collect();
    [scene.strips_x, scene.strips_y] = tx.strip_edges()?;
    for (number, area) in tx.areas()?.into_iter().enumerate() {
        let edge = |edges: &[f64], strip: i64| edges.get(strip as usize).copied().unwrap_or_default();
        scene.prime_areas.push(PrimeArea {
            label: label(number),
            rect: Rect::new(
                edge(&scene.strips_x, area.x.0),
                edge(&scene.strips_y, area.y.0),
                edge(&scene.strips_x, area.x.1 + 1),
                edge(&scene.strips_y, area.y.1 + 1),
            ),
            open: area.open.value,
        });
    }
    for state in tx.states_in_force()? {
        if !scene.actions.contains(&state.action) {
            scene.actions.push(state.action);
        }
    }
    Ok(scene)
}

/// The doorways that rules close, and the lines that are told to be closed.
fn closings(building: &Building) -> Vec<Closing> {
    let closing = |Segment { a, b }, to_whom| Closing { from: a, to: b, to_whom };
    let doorways = building.closed().map(|doorway| match building.one_way(doorway) {
        Some(segment) => closing(segment, ClosedTo::OneSide),
        None => closing(Building::segment(doorway), ClosedTo::All),
    });
    let lines = building.lines.iter().map(|line| {
        let [x0, y0, x1, y1] = line.segment;
        let to_whom = if line.whom == Whom::All { ClosedTo::All } else { ClosedTo::SomeRobots };
        closing(Segment::new(Point::new(x0, y0), Point::new(x1, y1)), to_whom)
    });
    doorways.chain(lines).collect()
}

/// Prime areas are lettered as in the paper's Figure 5.
fn label(number: usize) -> String {
    adit_planners::names::room_name(number).to_uppercase()
}
