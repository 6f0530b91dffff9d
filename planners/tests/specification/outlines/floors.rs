//! Floors of rectangles, with blocks and pipes, for one or more shapes.

use adit_planners::geometry::{Point, Rect, Segment};
use adit_planners::layers::{Crossing, Kind, Room, State, cut_layers};
use adit_planners::routes::{
    Berth, Crossing as Where, Goal, Leg, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start, Walking, Way,
};
use adit_planners::world::{Bridge, Obstacle, Shape, World};
use petgraph::algo::dijkstra;
use petgraph::graph::{NodeIndex, UnGraph};
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

/// The graph of the layers of shapes, each with what a metre of it weighs; ways end where rooms do.
pub fn graph(world: &World, shapes: &[(State, f64)], change: f64) -> RouteGraph {
    let states: Vec<State> = shapes.iter().map(|(state, _)| state.clone()).collect();
    let layers = cut_layers(world, &states).unwrap();
    let weigh = |room: &Room| RouteRoom {
        outline: room.outline.clone(),
        radius: None,
        berth: Berth::default(),
        walking: Walking::PerMetre(shapes[room.state].1),
    };
    let door = |(index, crossing): (usize, &Crossing)| RouteDoor {
        door: index as u32 + 1,
        room1: RoomIndex::new(crossing.room1),
        room2: RoomIndex::new(crossing.room2),
        crossing: match crossing.kind {
            Kind::Door => Where::Through(crossing.across),
            Kind::Change => Where::Within(layers.area(crossing)),
        },
        at: crossing.across.middle(),
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

/// What must hold of every way through rooms.
pub fn check_legs(graph: &RouteGraph, way: &Way, from: Point, to: Point) -> Result<(), TestCaseError> {
    for leg in &way.legs {
        let outline = &graph[leg.room].outline;
        for p in [leg.from, leg.to] {
            prop_assert!(outline.distance(p) < 1e-6, "{leg:?} leaves its room {outline:?}");
        }
    }
    check_way(graph, way, from, to)
}

/// What must hold of every way.
pub fn check_way(graph: &RouteGraph, way: &Way, from: Point, to: Point) -> Result<(), TestCaseError> {
    let (mut at, mut cost) = (from, 0.0);
    for leg in &way.legs {
        prop_assert!(leg.from.distance(at) < 1e-9, "{leg:?} begins elsewhere than {at:?}");
        cost += leg.hardness + leg.door.map_or(0.0, |door| graph[door].hardness.unwrap());
        prop_assert!((leg.cost - cost).abs() < 1e-9);
        at = leg.to;
    }
    prop_assert!(at.distance(to) < 1e-9 && (way.cost - cost).abs() < 1e-9);
    if graph.closed().is_empty() { check_stays(graph, way) } else { Ok(()) }
}

/// Nobody leaves a room to come back by the same door, all in the room's own outline.
fn check_stays(graph: &RouteGraph, way: &Way) -> Result<(), TestCaseError> {
    let passed: Vec<usize> = (0..way.legs.len()).filter(|&leg| way.legs[leg].door.is_some()).collect();
    for pair in passed.windows(2).filter(|pair| way.legs[pair[0]].door == way.legs[pair[1]].door) {
        let outside = &way.legs[pair[0] + 1..=pair[1]];
        let room = &graph[way.legs[pair[0]].room].outline;
        let is_out = |leg: &Leg| room.distance(leg.from).max(room.distance(leg.to)) > 1e-6;
        prop_assert!(outside.iter().any(is_out), "out and back by one door: {outside:?}");
    }
    Ok(())
}

/// The least length over corners that see each other through the rooms.
pub fn shortest(graph: &RouteGraph, corners: &[Point], from: Point, to: Point) -> Option<f64> {
    shortest_over(corners, from, to, |Segment { a, b }| is_free(graph, a, b))
}

/// The least length over points that see each other.
pub fn shortest_over(
    corners: &[Point],
    from: Point,
    to: Point,
    is_free: impl Fn(Segment) -> bool,
) -> Option<f64> {
    let all: Vec<Point> = corners.iter().copied().chain([from, to]).collect();
    let mut seen = UnGraph::<(), f64>::default();
    let nodes: Vec<NodeIndex> = all.iter().map(|_| seen.add_node(())).collect();
    for (one, &a) in all.iter().enumerate() {
        for (two, &b) in all.iter().enumerate().skip(one + 1) {
            if is_free(Segment::new(a, b)) {
                seen.add_edge(nodes[one], nodes[two], a.distance(b));
            }
        }
    }
    let (from, to) = (nodes[all.len() - 2], nodes[all.len() - 1]);
    dijkstra(&seen, from, Some(to), |edge| *edge.weight()).get(&to).copied()
}

/// Whether the rooms cover the whole segment.
fn is_free(graph: &RouteGraph, a: Point, b: Point) -> bool {
    let mut parts: Vec<(f64, f64)> =
        graph.rooms().iter().filter_map(|room| room.outline.shares(a, b)).collect();
    parts.sort_by(|one, two| one.0.total_cmp(&two.0));
    let covered = parts
        .into_iter()
        .fold(0.0, |done: f64, (from, to)| if from > done + 1e-9 { done } else { done.max(to) });
    covered >= 1.0 - 1e-9
}

/// The corners of all rooms.
fn corners(graph: &RouteGraph) -> Vec<Point> {
    let mut corners: Vec<Point> = graph.rooms().iter().flat_map(|room| room.outline.corners()).collect();
    corners.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    corners.dedup_by(|a, b| a.distance(*b) < 1e-7);
    corners
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("CASES").map_or(48, |cases| cases.parse().unwrap()),
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    })]

    #[test]
    fn in_one_state_a_way_is_as_short_as_over_a_visibility_graph(
        blocks in blocks(), from in point(), to in point()
    ) {
        let graph = graph(&hall(&blocks, &[]), &shapes()[..1], 0.0);
        prop_assume!(!holding(&graph, from).is_empty() && !holding(&graph, to).is_empty());
        let (least, way) = (shortest(&graph, &corners(&graph), from, to), way(&graph, from, to));
        prop_assert_eq!(least.is_some(), way.is_some());
        if let (Some(least), Some(way)) = (least, way) {
            check_legs(&graph, &way, from, to)?;
            prop_assert!((way.cost - least).abs() < 1e-6 * least.max(1.0), "{} for {least}", way.cost);
        }
    }
}

/// A hall whose walls leave a strip in which one can only stand sideways: whoever starts or ends in it changes at its edge.
#[test]
fn whoever_starts_or_ends_in_a_strip_along_a_wall_changes_shape_at_its_edge() {
    let graph = graph(&hall(&[], &[]), &shapes()[..2], 0.5);
    // STAND keeps 0.3 m off the walls, SIDE 0.175 m
    let (from, to) = (Point::new(2.0, 0.2), Point::new(10.0, 0.2));
    let way = way(&graph, from, to).unwrap();
    let upright: f64 = way
        .legs
        .iter()
        .filter(|leg| leg.hardness <= leg.from.distance(leg.to) * 1.5)
        .map(|leg| leg.from.distance(leg.to))
        .sum();
    assert!(upright > 7.8, "{upright} m upright of {way:?}");
    // two changes, eight metres upright, twice the strip sideways
    assert!(way.cost < 0.5 * 2.0 + 8.0 + 2.0 * 2.0 * 0.11, "{}", way.cost);
}
