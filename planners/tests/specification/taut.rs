//! Ways where rooms weigh their metres, through layers of one shape and of several.
#![allow(clippy::float_cmp)] // two infinities are the same

use adit_planners::geometry::{Convex, Point, Rect, Segment};
use adit_planners::layers::{Kind, State, cut_layers};
use adit_planners::routes::{
    Berth, Blockage, Closed, Crossing, DoorIndex, Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start,
    Walking, Way, blockage,
};
use adit_planners::world::{Bridge, Obstacle, Shape, World};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const SIDE: f64 = 12.0;

/// A hall with blocks in it; whole numbers of half metres, so that doors of many rooms end at one point.
fn hall(blocks: &[(u8, u8, u8, u8)]) -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, SIDE, SIDE));
    world.grid = Some(0.5);
    let half = |n: u8| f64::from(n) / 2.0;
    world.obstacles = blocks
        .iter()
        .map(|&(x, y, w, h)| Rect::new(half(x), half(y), half(x + w), half(y + h)))
        .map(|rect| Obstacle { shape: Shape::Rect(rect) })
        .collect();
    world
}

fn state(name: &str, width: f64) -> State {
    State { robot: None, state: name.to_owned(), height: 1.0, width, length: None }
}

/// The graph of all layers; a metre of each state weighs as given, a change `change`.
fn graph(world: &World, states: &[(f64, f64)], change: f64) -> RouteGraph {
    let shapes: Vec<(State, f64)> =
        states.iter().map(|(width, per_m)| (state("s", *width), *per_m)).collect();
    graph_of(world, &shapes, change)
}

/// The graph of all layers of states, each with what a metre of it weighs.
fn graph_of(world: &World, states: &[(State, f64)], change: f64) -> RouteGraph {
    let shapes: Vec<State> = states.iter().map(|(state, _)| state.clone()).collect();
    let layers = cut_layers(world, &shapes).unwrap();
    let weigh = |room: &adit_planners::layers::Room| RouteRoom {
        outline: room.outline.clone(),
        radius: None,
        berth: Berth::default(),
        walking: Walking::PerMetre(states[room.state].1),
    };
    let door = |(index, crossing): (usize, &adit_planners::layers::Crossing)| RouteDoor {
        door: index as u32 + 1,
        room1: RoomIndex::new(crossing.room1),
        room2: RoomIndex::new(crossing.room2),
        crossing: match crossing.kind {
            Kind::Door => Crossing::Through(crossing.across),
            Kind::Change => Crossing::Within(layers.area(crossing)),
        },
        at: crossing.across.middle(),
        hardness: Some(if crossing.kind == Kind::Change { change } else { 0.0 }),
        passable: true,
        one_way: crossing.kind == Kind::Change,
    };
    let doors = layers.crossings.iter().enumerate().map(door).collect();
    RouteGraph::new(layers.rooms.iter().map(weigh).collect(), doors)
}

/// One that walks, one that goes sideways through what is narrow, one that squats under what is low.
fn three_shapes() -> Vec<(State, f64)> {
    let shape = |name: &str, height: f64, width: f64| State { height, ..state(name, width) };
    vec![(shape("STAND", 1.7, 0.6), 1.0), (shape("SIDE", 1.7, 0.35), 2.0), (shape("SQUAT", 1.1, 0.8), 4.0)]
}

/// Two halls with a doorway of 1 m between them, and a pipe in the first.
fn two_halls() -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, 12.0, 8.0));
    let walls = [Rect::new(5.9, 0.0, 6.1, 3.0), Rect::new(5.9, 4.0, 6.1, 8.0)];
    world.obstacles = walls.map(|rect| Obstacle { shape: Shape::Rect(rect) }).into();
    world.bridges = vec![Bridge { rect: Rect::new(2.5, 0.0, 3.0, 8.0), height: 1.3 }];
    world
}

/// The doors in the doorway's right mouth: where each shape has come through it.
fn right_mouth(graph: &RouteGraph) -> Vec<DoorIndex> {
    let is_there = |door: &RouteDoor| {
        let Some(Segment { a, b }) = door.crossing.segment() else { return false };
        a.x == b.x && (6.2..6.6).contains(&a.x) && a.y > 3.1 && b.y < 3.9
    };
    graph.door_indices().filter(|&door| is_there(&graph[door])).collect()
}

#[test]
fn a_strip_from_which_another_change_leads_on_is_entered_as_it_is_left() {
    // once, the way back cost 21.7 where the way there cost 18.9: into the strip in which only one shape fits, no change
    // was looked for, since it is shallow
    let mut graph = graph_of(&two_halls(), &three_shapes(), 0.5);
    let mouth = right_mouth(&graph);
    assert!(mouth.len() >= 3, "one for each shape at least");
    graph.reweigh([], mouth.into_iter().map(|door| (door, Some(0.0), false)));
    let (home, window) = (Point::new(1.0, 4.0), Point::new(11.0, 7.0));
    let (there, back) = (way(&graph, home, window).unwrap(), way(&graph, window, home).unwrap());
    assert!((there.cost - back.cost).abs() < 1e-3 * there.cost, "{} and {}", there.cost, back.cost);
}

#[test]
fn a_closed_boundary_is_shut_for_every_shape() {
    let mut graph = graph_of(&two_halls(), &three_shapes(), 0.5);
    let (home, window) = (Point::new(1.0, 4.0), Point::new(11.0, 7.0));
    let before = way(&graph, home, window).unwrap();
    let doorway = Segment::new(Point::new(6.0, 3.0), Point::new(6.0, 4.0));
    graph.close(vec![Closed::for_all(doorway)]);
    assert!(way(&graph, home, window).is_none() && way(&graph, window, home).is_none());
    let goal = Goal::within(holding(&graph, window), Some(window));
    let start = Start::within(holding(&graph, home), home);
    assert!(matches!(blockage(&graph, &start, &goal), Blockage::Shut(doors) if !doors.is_empty()));
    graph.close(Vec::new());
    assert_eq!(way(&graph, home, window), Some(before), "the old way, to the bit");
}

#[test]
fn a_boundary_that_is_open_one_way_is_passed_that_way_by_every_shape() {
    let mut graph = graph_of(&two_halls(), &three_shapes(), 0.5);
    let (home, window) = (Point::new(1.0, 4.0), Point::new(11.0, 7.0));
    let [there, back] =
        [(home, window), (window, home)].map(|(from, to)| way(&graph, from, to).unwrap().cost);
    let doorway = Segment::new(Point::new(6.0, 3.0), Point::new(6.0, 4.0));
    graph.close(vec![Closed::to_left(doorway)]);
    assert!(way(&graph, home, window).is_none());
    assert!((way(&graph, window, home).unwrap().cost - back).abs() < 1e-6);
    let goal = Goal::within(holding(&graph, window), Some(window));
    let start = Start::within(holding(&graph, home), home);
    assert!(matches!(blockage(&graph, &start, &goal), Blockage::Shut(doors) if !doors.is_empty()));
    graph.close(vec![Closed::to_left(doorway.reversed())]);
    assert!(way(&graph, window, home).is_none());
    assert!((way(&graph, home, window).unwrap().cost - there).abs() < 1e-6);
    // what is open to the one side and to the other lets nobody through
    graph.close(vec![Closed::to_left(doorway), Closed::to_left(doorway.reversed())]);
    assert!(way(&graph, home, window).is_none() && way(&graph, window, home).is_none());
}

/// The whole of a door to pass.
fn closed_at(door: &RouteDoor) -> Closed {
    Closed::for_all(door.crossing.segment().unwrap())
}

fn holding(graph: &RouteGraph, p: Point) -> Vec<RoomIndex> {
    graph.room_indices().filter(|&room| graph[room].outline.contains(p)).collect()
}

fn way(graph: &RouteGraph, from: Point, to: Point) -> Option<Way> {
    let start = Start::within(holding(graph, from), from);
    let goal = Goal::within(holding(graph, to), Some(to));
    graph.way(&start, &[goal]).map(|(_, way)| way)
}

fn blocks() -> impl Strategy<Value = Vec<(u8, u8, u8, u8)>> {
    prop::collection::vec((0_u8..22, 0_u8..22, 1_u8..9, 1_u8..9), 0..9)
}

fn point() -> impl Strategy<Value = Point> {
    (0.2..SIDE - 0.2, 0.2..SIDE - 0.2).prop_map(|(x, y)| Point::new(x, y))
}

/// What must hold of every way.
fn check_legs(graph: &RouteGraph, way: &Way, from: Point, to: Point) -> Result<(), TestCaseError> {
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

/// Where nothing is closed, nobody has to go around the end of anything.
fn check_goes_on(way: &Way) -> Result<(), TestCaseError> {
    for pair in way.legs.windows(2) {
        prop_assert!(
            pair[0].door.is_none() || pair[0].door != pair[1].door,
            "out and back by one door: {pair:?}"
        );
    }
    Ok(())
}

/// A hall of two rooms for an easy state, and of one for a hard one, which needs no door between the two, and goes on beyond them.
#[test]
fn what_one_copy_finds_is_not_taken_by_another_that_weighs_otherwise() {
    let outline = |x0: f64, x1: f64| Convex::from(Rect::new(x0, 0.0, x1, 2.0));
    let room = |(x0, x1): (f64, f64), per_m: f64| RouteRoom {
        outline: outline(x0, x1),
        radius: None,
        berth: Berth::default(),
        walking: Walking::PerMetre(per_m),
    };
    let (here, there, low) = (RoomIndex::new(0), RoomIndex::new(1), RoomIndex::new(2));
    let door =
        |door: u32, (room1, room2): (RoomIndex, RoomIndex), crossing: Crossing, hardness: f64| RouteDoor {
            door,
            room1,
            room2,
            crossing,
            at: Point::new(4.0, 1.0),
            hardness: Some(hardness),
            passable: true,
            one_way: false,
        };
    let change = |number, room, (x0, x1)| door(number, (room, low), Crossing::Within(outline(x0, x1)), 0.5);
    let new = || {
        let rooms = vec![room((0.0, 4.0), 1.0), room((4.0, 8.0), 1.0), room((0.0, 10.0), 3.0)];
        let between = Crossing::Through(Segment::new(Point::new(4.0, 0.0), Point::new(4.0, 2.0)));
        let doors = vec![
            door(1, (here, there), between, 0.0),
            change(2, here, (0.0, 4.0)),
            change(3, there, (4.0, 8.0)),
        ];
        RouteGraph::new(rooms, doors)
    };
    let (from, to) = (Point::new(1.0, 1.0), Point::new(7.0, 1.0));
    let shut = [(DoorIndex::new(0), Some(0.0), false)];
    let (mut graph, known) = (new(), new());
    way(&known, from, to);
    // both know where ways may turn, and of no door where a change of shape pays
    graph.know_changes(&known, std::iter::repeat_n(None, 3));
    let other = graph.clone();
    graph.reweigh([], shut);
    let cost = |way: Option<Way>| way.expect("there is a way").cost;
    // one that has to change its shape asks where that may pay
    assert!(way(&other, from, Point::new(9.0, 1.0)).is_some());
    assert_eq!(cost(way(&other, from, to)), 6.0);
    let mut fresh = new();
    fresh.reweigh([], shut);
    assert_eq!(way(&graph, from, to), way(&fresh, from, to));
    // down on one side of the door, and up on the other
    assert!((cost(way(&graph, from, to)) - 7.0).abs() < 1e-6);
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("CASES").map_or(96, |cases| cases.parse().unwrap()),
        max_global_rejects: 100_000,
        // the same floors each time, or others where somebody looks for them
        rng_seed: if std::env::var_os("CASES").is_some() { RngSeed::Random } else { RngSeed::Fixed(16) },
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_way_costs_the_same_there_and_back(
        blocks in blocks(), from in point(), to in point(), change in 0.0..2.0_f64
    ) {
        let graph = graph(&hall(&blocks), &[(1.3, 1.0), (0.6, 2.5)], change);
        let (there, back) = (way(&graph, from, to), way(&graph, to, from));
        prop_assert_eq!(there.is_some(), back.is_some());
        if let (Some(there), Some(back)) = (there, back) {
            check_legs(&graph, &there, from, to)?;
            check_goes_on(&there)?;
            prop_assert!((there.cost / back.cost - 1.0).abs() < 2e-2, "{} and {}", there.cost, back.cost);
        }
    }

    #[test]
    fn all_goals_at_once_cost_what_each_costs_alone(
        blocks in blocks(), from in point(), goals in prop::collection::vec(point(), 1..5)
    ) {
        let graph = graph(&hall(&blocks), &[(1.3, 1.0), (0.6, 2.5)], 0.5);
        let start = Start::within(holding(&graph, from), from);
        let ends: Vec<Goal> =
            goals.iter().map(|&p| Goal::within(holding(&graph, p), Some(p))).collect();
        let all = graph.ways(&start, &ends, false).goals;
        let costs: Vec<Option<f64>> = all.iter().map(|way| way.as_ref().map(|way| way.cost)).collect();
        for (to, cost) in goals.iter().zip(&costs) {
            let alone = way(&graph, from, *to).map(|way| way.cost);
            prop_assert_eq!(cost.is_some(), alone.is_some());
            if let (Some(cost), Some(alone)) = (cost, alone) {
                prop_assert!((cost / alone - 1.0).abs() < 2e-2 || (cost - alone).abs() < 1e-9, "{cost} and {alone}");
            }
        }
        let nearest = costs.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let found = graph.way(&start, &ends).map_or(f64::INFINITY, |(_, way)| way.cost);
        prop_assert!(found == nearest || (found / nearest - 1.0).abs() < 2e-2 || (found - nearest).abs() < 1e-9);
    }

    #[test]
    fn the_ways_to_all_rooms_are_those_to_each_room_alone(
        blocks in blocks(), pipes in pipes(), from in point(), change in 0.0..2.0_f64,
        shut in prop::collection::vec(any::<prop::sample::Index>(), 0..12)
    ) {
        let mut graph = graph_of(&with_pipes(&blocks, &pipes), &three_shapes(), change);
        let shut: Vec<_> = shut.iter().map(|door| DoorIndex::new(door.index(graph.doors().len()))).collect();
        graph.reweigh([], shut.into_iter().map(|door| (door, Some(0.0), false)));
        let start = Start::within(holding(&graph, from), from);
        let all = graph.ways(&start, &[], true).rooms;
        for room in graph.room_indices() {
            let alone = graph.tightest_way(&start, &[Goal::within([room], None)]).map(|(_, way)| way.cost);
            let cost = all[room.index()].as_ref().map(|way| way.cost);
            prop_assert_eq!(cost.is_some(), alone.is_some(), "{:?}", graph[room].outline);
            if let (Some(cost), Some(alone)) = (cost, alone) {
                // where a state dips into a gap lie rooms of some centimetres: of ways to all rooms fewer are pulled tight
                let bounds = graph[room].outline.bounds();
                let most = if bounds.dx().max(bounds.dy()) < 0.1 { 1e-1 } else { 5e-2 };
                let is_same = (cost / alone - 1.0).abs() < most || (cost - alone).abs() < 1e-9;
                prop_assert!(is_same, "{cost} and {alone}");
            }
        }
    }

    #[test]
    fn with_three_shapes_and_doors_shut_here_and_there_a_way_costs_the_same_there_and_back(
        blocks in blocks(), pipes in pipes(), from in point(), to in point(), change in 0.0..2.0_f64,
        shut in prop::collection::vec(any::<prop::sample::Index>(), 0..12)
    ) {
        let mut graph = graph_of(&with_pipes(&blocks, &pipes), &three_shapes(), change);
        let shut = shut.iter().map(|door| DoorIndex::new(door.index(graph.doors().len())));
        let shut: Vec<_> = shut.filter(|&door| !graph[door].is_change()).collect();
        graph.reweigh([], shut.into_iter().map(|door| (door, Some(0.0), false)));
        let (there, back) = (way(&graph, from, to), way(&graph, to, from));
        prop_assert_eq!(there.is_some(), back.is_some());
        if let (Some(there), Some(back)) = (there, back) {
            check_legs(&graph, &there, from, to)?;
            check_goes_on(&there)?;
            prop_assert!((there.cost / back.cost - 1.0).abs() < 5e-2, "{} and {}", there.cost, back.cost);
        }
    }

    #[test]
    fn no_way_crosses_a_closed_boundary_or_changes_shape_on_it(
        blocks in blocks(), pipes in pipes(), from in point(), to in point(), change in 0.0..2.0_f64,
        closed in prop::collection::vec(any::<prop::sample::Index>(), 1..5)
    ) {
        let mut graph = graph_of(&with_pipes(&blocks, &pipes), &three_shapes(), change);
        let free = way(&graph, from, to);
        prop_assume!(free.is_some());
        let free = free.unwrap();
        // doors on the way, as long as there are any
        let passed: Vec<RouteDoor> = free.legs.iter().filter_map(|leg| leg.door).map(|door| graph[door].clone())
            .filter(|door| !door.is_change()).collect();
        prop_assume!(!passed.is_empty());
        let closed: Vec<Closed> = closed.iter().map(|door| closed_at(door.get(&passed))).collect();
        graph.close(closed.clone());
        if let Some(way) = way(&graph, from, to) {
            check_legs(&graph, &way, from, to)?;
            for Closed { segment, .. } in &closed {
                check_passes(&graph, &way, segment, Passes::Never)?;
            }
        }
        graph.close(Vec::new());
        prop_assert_eq!(self::way(&graph, from, to), Some(free));
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("CASES").map_or(96, |cases| cases.parse().unwrap()),
        max_global_rejects: 100_000,
        rng_seed: if std::env::var_os("CASES").is_some() { RngSeed::Random } else { RngSeed::Fixed(16) },
        ..ProptestConfig::default()
    })]

    #[test]
    fn no_way_crosses_a_boundary_from_the_side_from_which_it_is_closed(
        blocks in blocks(), pipes in pipes(), from in point(), to in point(), change in 0.0..2.0_f64,
        closed in prop::collection::vec((any::<prop::sample::Index>(), any::<bool>()), 1..5)
    ) {
        let mut graph = graph_of(&with_pipes(&blocks, &pipes), &three_shapes(), change);
        let free = way(&graph, from, to);
        prop_assume!(free.is_some());
        let free = free.unwrap();
        let passed: Vec<Segment> = free.legs.iter().filter_map(|leg| graph[leg.door?].crossing.segment()).collect();
        prop_assume!(!passed.is_empty());
        let boundary = |(door, is_turned): &(prop::sample::Index, bool)| {
            let segment = *door.get(&passed);
            if *is_turned { segment.reversed() } else { segment }
        };
        let boundaries: Vec<Segment> = closed.iter().map(boundary).collect();
        graph.close(boundaries.iter().map(|&segment| Closed::to_left(segment)).collect());
        let way = way(&graph, from, to);
        if let Some(way) = &way {
            check_legs(&graph, way, from, to)?;
            for boundary in &boundaries {
                check_passes(&graph, way, boundary, Passes::ToLeft)?;
            }
        }
        // what is closed both ways is no shorter
        graph.close(boundaries.into_iter().map(Closed::for_all).collect());
        if let Some(shut) = self::way(&graph, from, to) {
            prop_assert!(way.is_some_and(|way| way.cost <= 1.05 * shut.cost + 1e-9));
        }
    }
}

fn pipes() -> impl Strategy<Value = Vec<(u8, bool)>> {
    prop::collection::vec((2_u8..22, any::<bool>()), 0..3)
}

/// A hall with blocks, and pipes across it; in cells of 10 cm.
fn with_pipes(blocks: &[(u8, u8, u8, u8)], pipes: &[(u8, bool)]) -> World {
    let mut world = hall(blocks);
    world.grid = Some(0.1);
    let pipe = |&(at, is_upright): &(u8, bool)| {
        let at = f64::from(at) / 2.0;
        let rect =
            if is_upright { Rect::new(at, 0.0, at + 0.5, SIDE) } else { Rect::new(0.0, at, SIDE, at + 0.5) };
        Bridge { rect, height: 1.3 }
    };
    world.bridges = pipes.iter().map(pipe).collect();
    world
}

/// Which way a boundary is crossed, if at all.
#[derive(Clone, Copy, PartialEq)]
enum Passes {
    Never,
    ToLeft,
}

/// A way comes to a closed boundary from one side, if at all, and leaves to that side or round its end, or where it may be crossed.
fn check_passes(
    graph: &RouteGraph,
    way: &Way,
    boundary: &Segment,
    passes: Passes,
) -> Result<(), TestCaseError> {
    let seen = |p: Point| (p - boundary.a).seen_along(boundary.direction());
    let (across, along) = (|p: Point| seen(p).y, |p: Point| seen(p).x);
    let is_within = |p: Point| along(p) > 1e-6 && along(p) < boundary.length() - 1e-6;
    let is_on = |p: Point| across(p).abs() < 1e-6 && is_within(p);
    // the side on which the way last was, as long as it has not been past an end since
    let mut side = 0.0;
    for leg in &way.legs {
        let (from, to) = (leg.from, leg.to);
        let (one, two) = (across(from), across(to));
        if one.abs() > 1e-6 {
            side = one;
        } else if !is_within(from) {
            side = 0.0;
        }
        if two.abs() > 1e-6 && side * two < 0.0 && (passes == Passes::Never || two < 0.0) {
            let share = one.abs() / (one.abs() + two.abs());
            let at = Point::new(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share);
            prop_assert!(!is_within(at), "{leg:?} crosses {boundary:?}");
        }
        let is_change = leg.door.is_some_and(|door| graph[door].is_change());
        prop_assert!(!(is_change && is_on(leg.to)), "a shape is changed on {boundary:?}: {leg:?}");
    }
    Ok(())
}

/// Who stands on the wrong side of a one-way boundary is at its end sooner, and cannot go on from there.
#[test]
fn a_way_bends_at_the_end_of_a_one_way_boundary_though_another_is_there_sooner_on_its_other_side() {
    let blocks = [(9, 6, 3, 4), (19, 3, 1, 6), (3, 5, 8, 7)];
    let mut graph = graph_of(&with_pipes(&blocks, &[]), &three_shapes(), 0.46);
    let (from, to) = (Point::new(9.25, 3.45), Point::new(0.2, 8.04));
    let passed: Vec<Segment> = way(&graph, from, to)
        .unwrap()
        .legs
        .iter()
        .filter_map(|leg| graph[leg.door?].crossing.segment())
        .map(|door| door.reversed())
        .collect();
    let doors = [passed[0], passed[passed.len() / 4], passed[passed.len() / 2]];
    graph.close(doors.into_iter().map(Closed::to_left).collect());
    let one_way = way(&graph, from, to).unwrap();
    graph.close(doors.into_iter().map(Closed::for_all).collect());
    let shut = way(&graph, from, to).unwrap();
    assert!(one_way.cost < 0.97 * shut.cost, "{} beside {}", one_way.cost, shut.cost);
}
