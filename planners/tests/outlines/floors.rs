//! Floors of rectangles, with blocks and pipes, for one or more shapes.

use adit_planners::geometry::{Point, Rect};
use adit_planners::layers::{Crossing, Kind, Room, State, cut_layers};
use adit_planners::routes::{Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start, Walking, Way};
use adit_planners::world::{Bridge, Obstacle, Shape, World};
use proptest::prelude::*;

pub const SIDE: f64 = 12.0;

/// Where blocks stand: in half metres.
pub type Blocks = Vec<(u8, u8, u8, u8)>;

pub fn blocks() -> impl Strategy<Value = Blocks> {
    prop::collection::vec((0_u8..22, 0_u8..22, 1_u8..9, 1_u8..9), 0..9)
}

/// Pipes across the hall: where, in half metres, and whether along y.
pub fn pipes() -> impl Strategy<Value = Vec<(u8, bool)>> {
    prop::collection::vec((2_u8..22, any::<bool>()), 0..3)
}

pub fn point() -> impl Strategy<Value = Point> {
    (0.2..SIDE - 0.2, 0.2..SIDE - 0.2).prop_map(|(x, y)| Point::new(x, y))
}

/// A hall in cells of 10 cm.
pub fn hall(blocks: &[(u8, u8, u8, u8)], pipes: &[(u8, bool)]) -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, SIDE, SIDE));
    world.grid = Some(0.1);
    let half = |n: u8| f64::from(n) / 2.0;
    let block = |&(x, y, w, h): &(u8, u8, u8, u8)| Rect::new(half(x), half(y), half(x + w), half(y + h));
    world.obstacles = blocks.iter().map(block).map(|rect| Obstacle { shape: Shape::Rect(rect) }).collect();
    let pipe = |&(at, is_upright): &(u8, bool)| {
        let at = half(at);
        let rect =
            if is_upright { Rect::new(at, 0.0, at + 0.5, SIDE) } else { Rect::new(0.0, at, SIDE, at + 0.5) };
        Bridge { rect, height: 1.3 }
    };
    world.bridges = pipes.iter().map(pipe).collect();
    world
}

/// One that walks, one that goes sideways through what is narrow, one that squats under what is low.
pub fn shapes() -> Vec<(State, f64)> {
    let shape = |name: &str, height: f64, width: f64| State {
        robot: None,
        state: name.to_owned(),
        height,
        width,
        length: None,
    };
    vec![(shape("STAND", 1.7, 0.6), 1.0), (shape("SIDE", 1.7, 0.35), 2.0), (shape("SQUAT", 1.1, 0.8), 4.0)]
}

/// The graph of the layers of shapes, each with what a metre of it weighs.
pub fn graph(world: &World, shapes: &[(State, f64)], change: f64) -> RouteGraph {
    let states: Vec<State> = shapes.iter().map(|(state, _)| state.clone()).collect();
    let layers = cut_layers(world, &states).unwrap();
    let weigh = |room: &Room| RouteRoom {
        outline: room.rect.into(),
        walking: Walking::PerMetre(shapes[room.state].1),
    };
    let door = |(index, crossing): (usize, &Crossing)| RouteDoor {
        door: index as u32 + 1,
        room1: RoomIndex::new(crossing.room1),
        room2: RoomIndex::new(crossing.room2),
        crossing: crossing.rect.into(),
        at: crossing.rect.centre(),
        hardness: Some(if crossing.kind == Kind::Change { change } else { 0.0 }),
        passable: true,
        one_way: crossing.kind == Kind::Change,
    };
    let doors = layers.crossings.iter().enumerate().map(door).collect();
    RouteGraph::new(layers.rooms.iter().map(weigh).collect(), doors)
}

pub fn holding(graph: &RouteGraph, p: Point) -> Vec<RoomIndex> {
    graph.room_indices().filter(|&room| graph[room].outline.contains(p)).collect()
}

pub fn way(graph: &RouteGraph, from: Point, to: Point) -> Option<Way> {
    let start = Start::within(holding(graph, from), from);
    let goal = Goal::within(holding(graph, to), Some(to));
    graph.way(&start, &[goal]).map(|(_, way)| way)
}

/// What must hold of every way.
pub fn check_legs(graph: &RouteGraph, way: &Way, from: Point, to: Point) -> Result<(), TestCaseError> {
    let (mut at, mut cost) = (from, 0.0);
    for leg in &way.legs {
        prop_assert!(leg.from.distance(at) < 1e-9, "{leg:?} begins elsewhere than {at:?}");
        let outline = &graph[leg.room].outline;
        for p in [leg.from, leg.to] {
            prop_assert!(outline.distance(p) < 1e-6, "{leg:?} leaves its room {outline:?}");
        }
        cost += leg.hardness + leg.door.map_or(0.0, |door| graph[door].hardness.unwrap());
        prop_assert!((leg.cost - cost).abs() < 1e-9);
        at = leg.to;
    }
    prop_assert!(at.distance(to) < 1e-9 && (way.cost - cost).abs() < 1e-9);
    Ok(())
}
