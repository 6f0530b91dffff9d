//! Ways between any two rooms, prepared: the least cost, whatever was weighed anew before.
#![allow(clippy::float_cmp)] // sums of the same numbers in the same order; helpers of tests

use adit_planners::geometry::{Point, Rect};
use adit_planners::routes::{
    Berth, DoorIndex, Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start, Walking, Way,
};
use petgraph::algo::dijkstra;
use petgraph::visit::EdgeRef;
use proptest::prelude::*;

const SIDE: usize = 6;
const ROOMS: usize = SIDE * SIDE;

/// Rooms of 1 m in a square; some are not entered.
fn rooms(is_entered: &[bool]) -> Vec<RouteRoom> {
    let room = |(index, &is_entered): (usize, &bool)| {
        let (x, y) = ((index % SIDE) as f64, (index / SIDE) as f64);
        let walking = if is_entered { Walking::OnDoors } else { Walking::Unknown };
        RouteRoom {
            outline: Rect::new(x, y, x + 1.0, y + 1.0).into(),
            radius: None,
            berth: Berth::default(),
            walking,
        }
    };
    is_entered.iter().enumerate().map(room).collect()
}

fn door(door: u32, room1: usize, room2: usize, hardness: Option<f64>) -> RouteDoor {
    let at = Point::new(f64::from(door), 0.5);
    RouteDoor {
        door,
        room1: RoomIndex::new(room1),
        room2: RoomIndex::new(room2),
        crossing: Rect::new(at.x, 0.0, at.x, 1.0).into(),
        at,
        hardness,
        passable: true,
        one_way: false,
    }
}

/// A hardness as rules may give it: nothing, small whole numbers with many ties, numbers of any size, and none.
fn any_hardness() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        1 => Just(None),
        2 => Just(Some(0.0)),
        4 => (1_u8..5).prop_map(|whole| Some(f64::from(whole))),
        4 => (0.01..20.0).prop_map(Some),
        1 => Just(Some(1e-12)),
        1 => Just(Some(1e12)),
    ]
}

/// Doors between neighbours, some of them twice, and some between any two rooms.
fn any_doors() -> impl Strategy<Value = Vec<RouteDoor>> {
    let step = prop_oneof![4 => Just(1_usize), 4 => Just(SIDE), 1 => 0..ROOMS];
    let any = (0..ROOMS, step, any_hardness(), prop::bool::weighted(0.9), prop::bool::weighted(0.2));
    prop::collection::vec(any, 0..120).prop_map(|doors| {
        let build = |(number, (room, step, hardness, passable, one_way)): (usize, (_, _, _, _, _))| {
            let door = door(number as u32 + 1, room, (room + step) % ROOMS, hardness);
            RouteDoor { passable, one_way, ..door }
        };
        doors.into_iter().enumerate().map(build).collect()
    })
}

type Edit = (Vec<(prop::sample::Index, Option<f64>, bool)>, Option<(usize, bool)>);

/// Doors that come to weigh something else; and a room that is entered from now on, or no longer.
fn any_edit() -> impl Strategy<Value = Edit> {
    let door = (any::<prop::sample::Index>(), any_hardness(), prop::bool::weighted(0.9));
    (prop::collection::vec(door, 0..5), prop::option::weighted(0.1, (0..ROOMS, any::<bool>())))
}

fn prepared(rooms: Vec<RouteRoom>, doors: Vec<RouteDoor>) -> RouteGraph {
    let mut graph = RouteGraph::new(rooms, doors);
    graph.prepare();
    graph
}

fn edit(graph: &mut RouteGraph, (doors, room): &Edit) {
    let count = graph.doors().len();
    let weighed: Vec<_> = doors
        .iter()
        .filter(|_| count > 0)
        .map(|(door, hardness, passable)| (DoorIndex::new(door.index(count)), *hardness, *passable))
        .collect();
    let walking = |is_entered: bool| if is_entered { Walking::OnDoors } else { Walking::Unknown };
    graph.reweigh(room.map(|(room, is_entered)| (RoomIndex::new(room), walking(is_entered))), weighed);
}

fn start<const N: usize>(rooms: [usize; N]) -> Start {
    Start::within(rooms.map(RoomIndex::new), Point::default())
}

fn goal(room: usize) -> Goal {
    Goal::within([RoomIndex::new(room)], None)
}

fn way(graph: &RouteGraph, from: usize, to: usize) -> Option<Way> {
    graph.way(&start([from]), &[goal(to)]).map(|(_, way)| way)
}

fn doors_of(way: &Way) -> Vec<DoorIndex> {
    way.legs.iter().filter_map(|leg| leg.door).collect()
}

/// Whether each leg's door leads from its room into the next one's, for a robot that passes it.
fn is_driven(graph: &RouteGraph, way: &Way, to: usize) -> bool {
    let rooms: Vec<RoomIndex> = way.legs.iter().map(|leg| leg.room).collect();
    let mut seen = rooms.clone();
    seen.sort_unstable();
    seen.dedup();
    let follows = |(leg, next): (usize, &RoomIndex)| {
        let door = &graph[way.legs[leg].door.unwrap()];
        let (one, two) = (door.room1, door.room2);
        let leads = (one, two) == (rooms[leg], *next) || !door.one_way && (two, one) == (rooms[leg], *next);
        leads && door.weight().is_some()
    };
    seen.len() == rooms.len()
        && rooms.last() == Some(&RoomIndex::new(to))
        && rooms[1..].iter().enumerate().all(follows)
}

/// Whether two sums of the same size are the same but for their rounding.
fn is_same(one: f64, two: f64) -> bool {
    (one - two).abs() <= 1e-12 * one.abs().max(two.abs())
}

fn check(graph: &RouteGraph) -> Result<(), TestCaseError> {
    for from in (0..ROOMS).step_by(5) {
        let start = start([from]);
        let tree = graph.tree(&start);
        let reference = dijkstra(graph, RoomIndex::new(from), None, |passage| *passage.weight());
        for (to, room) in graph.room_indices().enumerate() {
            let Some(way) = way(graph, from, to) else {
                prop_assert!(tree.rooms[to].is_none(), "{from} to {to}");
                continue;
            };
            let arrival = tree.rooms[to].unwrap();
            prop_assert!(is_same(way.cost, arrival.cost), "{from} to {to}: {} {}", way.cost, arrival.cost);
            prop_assert!(is_same(way.cost, reference[&room]));
            prop_assert!(is_driven(graph, &way, to), "{from} to {to}: {way:?}");
            let (mut room, mut doors) = (room, Vec::new());
            while let Some((before, door)) = tree.rooms[room.index()].unwrap().from {
                doors.push(door);
                room = before;
            }
            doors.reverse();
            if doors == doors_of(&way) {
                prop_assert_eq!(way.cost.to_bits(), arrival.cost.to_bits());
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_way_costs_what_the_search_from_door_to_door_finds(
        is_entered in prop::collection::vec(prop::bool::weighted(0.95), ROOMS),
        doors in any_doors(),
        edits in prop::collection::vec(any_edit(), 0..6),
    ) {
        let mut graph = prepared(rooms(&is_entered), doors);
        check(&graph)?;
        for one in &edits {
            edit(&mut graph, one);
            check(&graph)?;
        }
    }

    #[test]
    fn ways_do_not_hang_on_what_was_weighed_before(
        doors in any_doors(),
        edits in prop::collection::vec(any_edit(), 1..12),
    ) {
        let mut edited = prepared(rooms(&[true; ROOMS]), doors);
        for one in &edits {
            edit(&mut edited, one);
        }
        let anew = prepared(edited.rooms().to_vec(), edited.doors().to_vec());
        for (from, to) in (0..ROOMS).flat_map(|from| (0..ROOMS).map(move |to| (from, to))) {
            prop_assert_eq!(way(&edited, from, to), way(&anew, from, to));
        }
    }

    #[test]
    fn a_clone_keeps_its_weights(doors in any_doors(), one in any_edit()) {
        let before = prepared(rooms(&[true; ROOMS]), doors);
        let ways: Vec<_> = (0..ROOMS).map(|to| way(&before, 0, to)).collect();
        let mut copy = before.clone();
        edit(&mut copy, &one);
        prop_assert_eq!(ways, (0..ROOMS).map(|to| way(&before, 0, to)).collect::<Vec<_>>());
    }
}

/// A floor of so many rooms a side with some walls, and numbers as if they were drawn.
fn floor(side: usize, draw: &mut impl FnMut(u64) -> u64) -> RouteGraph {
    let square = |room: usize| {
        let (x, y) = ((room % side) as f64, (room / side) as f64);
        RouteRoom {
            outline: Rect::new(x, y, x + 1.0, y + 1.0).into(),
            radius: None,
            berth: Berth::default(),
            walking: Walking::OnDoors,
        }
    };
    let mut doors = Vec::new();
    for room in 0..side * side {
        let right = (room % side + 1 < side).then_some(room + 1);
        let upper = (room / side + 1 < side).then_some(room + side);
        for next in right.into_iter().chain(upper) {
            let passable = draw(5) > 0;
            let one_way = draw(20) == 0;
            let hardness = Some(draw(1000) as f64 / 7.0);
            doors.push(RouteDoor { passable, one_way, ..door(doors.len() as u32 + 1, room, next, hardness) });
        }
    }
    prepared((0..side * side).map(square).collect(), doors)
}

#[test]
fn on_a_large_floor_every_way_costs_least_after_small_and_large_edits() {
    let (side, mut state) = (60, 1_u64);
    let mut draw = |below: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    let mut graph = floor(side, &mut draw);
    let (rooms, doors) = (graph.rooms().len(), graph.doors().len());
    for changed in [0, 1, 1, 3, 30, 1, doors, 2] {
        let weighed: Vec<_> = (0..changed)
            .map(|_| {
                (DoorIndex::new(draw(doors as u64) as usize), Some(draw(1000) as f64 / 3.0), draw(5) > 0)
            })
            .collect();
        graph.reweigh([], weighed);
        let anew = prepared(graph.rooms().to_vec(), graph.doors().to_vec());
        for _ in 0..5 {
            let from = draw(rooms as u64) as usize;
            let tree = graph.tree(&start([from]));
            for to in (0..rooms).step_by(37) {
                let found = way(&graph, from, to);
                assert_eq!(found, way(&anew, from, to));
                let least = tree.rooms[to].map(|arrival| arrival.cost);
                match (&found, least) {
                    (Some(way), Some(least)) => {
                        assert!(is_same(way.cost, least) && is_driven(&graph, way, to), "{from} to {to}");
                    }
                    (found, least) => assert!(found.is_none() && least.is_none(), "{from} to {to}"),
                }
            }
        }
    }
}

#[test]
fn of_two_equal_doors_the_lower_number_is_passed() {
    let graph = prepared(rooms(&[true; ROOMS]), vec![door(9, 0, 1, Some(3.0)), door(4, 1, 0, Some(3.0))]);
    assert_eq!(doors_of(&way(&graph, 0, 1).unwrap()), [DoorIndex::new(1)]);
}

#[test]
fn rooms_that_no_doors_join_have_no_way() {
    let graph = prepared(rooms(&[true; ROOMS]), vec![door(1, 0, 1, Some(3.0))]);
    assert_eq!(way(&graph, 0, 2), None);
    assert_eq!(way(&graph, 2, 0), None);
    assert_eq!(way(&graph, 2, 2).unwrap().cost, 0.0);
}

#[test]
fn of_several_goals_the_cheapest_is_chosen_and_of_equal_ones_the_first() {
    let doors = vec![door(1, 0, 1, Some(3.0)), door(2, 0, 2, Some(2.0)), door(3, 0, 3, Some(2.0))];
    let graph = prepared(rooms(&[true; ROOMS]), doors);
    let (chosen, way) = graph.way(&start([0]), &[goal(1), goal(2), goal(3)]).unwrap();
    assert_eq!((chosen, way.cost), (1, 2.0));
}

#[test]
fn a_start_in_several_rooms_leaves_from_the_best_one() {
    let doors = vec![door(1, 0, 2, Some(3.0)), door(2, 1, 2, Some(2.0))];
    let graph = prepared(rooms(&[true; ROOMS]), doors);
    let (_, way) = graph.way(&start([0, 1]), &[goal(2)]).unwrap();
    assert_eq!((way.legs[0].room, way.cost), (RoomIndex::new(1), 2.0));
}
