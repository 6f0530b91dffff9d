//! Every route has the least cost: our loop beside petgraph's Dijkstra and Bellman-Ford.
#![allow(clippy::float_cmp)] // sums of small whole numbers are exact

use adit_planners::geometry::{Point, Rect};
use adit_planners::routes::{
    Berth, Blockage, DoorIndex, Goal, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Shut, Start, Walking,
    blockage,
};
use petgraph::algo::{bellman_ford, dijkstra, kosaraju_scc, tarjan_scc};
use petgraph::visit::{EdgeCount, EdgeRef, IntoEdgeReferences, IntoEdgesDirected};
use petgraph::{Direction, Graph};
use proptest::prelude::*;

fn door(door: u32, room1: usize, room2: usize, hardness: f64) -> RouteDoor {
    RouteDoor {
        door,
        room1: RoomIndex::new(room1),
        room2: RoomIndex::new(room2),
        crossing: Rect::new(0.0, 0.0, 0.0, 0.0).into(),
        at: Point::default(),
        hardness: Some(hardness),
        passable: true,
        one_way: false,
    }
}

fn rooms(count: usize) -> Vec<RouteRoom> {
    vec![
        RouteRoom {
            outline: Rect::new(0.0, 0.0, 1.0, 1.0).into(),
            radius: None,
            berth: Berth::default(),
            walking: Walking::OnDoors
        };
        count
    ]
}

fn start(room: usize) -> Start {
    Start::within([RoomIndex::new(room)], Point::default())
}

fn goal(room: usize) -> Goal {
    Goal::within([RoomIndex::new(room)], None)
}

fn any_doors(rooms: usize) -> impl Strategy<Value = Vec<RouteDoor>> {
    let any = (0..rooms, 0..rooms, 0_u8..20, prop::bool::weighted(0.9), prop::bool::weighted(0.2));
    prop::collection::vec(any, 0..60).prop_map(|doors| {
        let build = |(number, (room1, room2, hardness, passable, one_way)): (usize, (_, _, u8, _, _))| {
            RouteDoor { passable, one_way, ..door(number as u32 + 1, room1, room2, f64::from(hardness)) }
        };
        doors.into_iter().enumerate().map(build).collect()
    })
}

proptest! {
    #[test]
    fn the_cost_of_every_room_is_the_least(doors in any_doors(12)) {
        let graph = RouteGraph::new(rooms(12), doors);
        let tree = graph.tree(&start(0));
        let reference = dijkstra(&graph, RoomIndex::new(0), None, |passage| *passage.weight());
        let other = bellman_ford(&graph, RoomIndex::new(0)).unwrap();
        for room in 0..12 {
            let ours = tree.rooms[room].map(|arrival| arrival.cost);
            prop_assert_eq!(ours, reference.get(&RoomIndex::new(room)).copied());
            prop_assert_eq!(ours.unwrap_or(f64::INFINITY), other.distances[room]);
        }
    }

    #[test]
    fn petgraph_finds_in_the_graph_of_routes_what_it_finds_in_its_own(doors in any_doors(12)) {
        let graph = RouteGraph::new(rooms(12), doors.clone());
        let mut own = Graph::<(), u32>::new();
        let nodes: Vec<_> = (0..12).map(|_| own.add_node(())).collect();
        for door in doors.iter().filter(|door| door.passable) {
            own.add_edge(nodes[door.room1.index()], nodes[door.room2.index()], door.door);
            if !door.one_way {
                own.add_edge(nodes[door.room2.index()], nodes[door.room1.index()], door.door);
            }
        }
        prop_assert_eq!(graph.edge_count(), own.edge_count());
        let key = |passage: DoorIndex| graph[passage].door;
        for &room in &nodes {
            for direction in [Direction::Outgoing, Direction::Incoming] {
                let ours = graph.edges_directed(room, direction);
                let mut ours: Vec<_> = ours.map(|at| (at.source(), at.target(), key(at.id()))).collect();
                let theirs = own.edges_directed(room, direction);
                let mut theirs: Vec<_> =
                    theirs.map(|at| (at.source(), at.target(), *at.weight())).collect();
                ours.sort_unstable();
                theirs.sort_unstable();
                prop_assert_eq!(ours, theirs);
            }
        }
        let passed: f64 = graph.edge_references().map(|passage| *passage.weight()).sum();
        let weight = |door: &u32| doors[*door as usize - 1].hardness.unwrap();
        prop_assert_eq!(passed, own.edge_weights().map(weight).sum::<f64>());
        let sorted = |mut parts: Vec<Vec<RoomIndex>>| {
            for part in &mut parts {
                part.sort_unstable();
            }
            parts.sort_unstable();
            parts
        };
        let theirs = sorted(tarjan_scc(&own));
        prop_assert_eq!(&sorted(tarjan_scc(&graph)), &theirs);
        prop_assert_eq!(&sorted(kosaraju_scc(&graph)), &theirs, "which goes against the doors, too");
    }

    #[test]
    fn each_arrival_adds_up_door_by_door(doors in any_doors(12)) {
        let graph = RouteGraph::new(rooms(12), doors);
        let tree = graph.tree(&start(3));
        for arrival in tree.rooms.iter().flatten() {
            let Some((before, door)) = arrival.from else { continue };
            let (before, through) = (tree.rooms[before.index()].unwrap(), &graph[door]);
            prop_assert!(through.passable);
            prop_assert_eq!(arrival.cost, before.cost + through.hardness.unwrap());
            prop_assert_eq!(arrival.hops, before.hops + 1);
        }
    }

    #[test]
    fn a_blockage_names_doors_that_suffice(doors in any_doors(12)) {
        let graph = RouteGraph::new(rooms(12), doors.clone());
        match blockage(&graph, &start(0), &goal(11)) {
            Blockage::Shut(shut) => {
                let open = |d: &RouteDoor| RouteDoor { passable: d.passable || shut.contains(&Shut::Door(d.door)), ..d.clone() };
                let opened = RouteGraph::new(rooms(12), doors.iter().map(open).collect());
                prop_assert!(opened.tree(&start(0)).rooms[11].is_some());
                prop_assert_eq!(shut.is_empty(), graph.tree(&start(0)).rooms[11].is_some());
            }
            Blockage::Apart => prop_assert!(graph.tree(&start(0)).rooms[11].is_none()),
        }
    }
}

#[test]
fn of_two_parallel_doors_the_easier_one_is_passed() {
    let graph = RouteGraph::new(rooms(2), vec![door(1, 0, 1, 5.0), door(2, 0, 1, 3.0)]);
    assert_eq!(graph.tree(&start(0)).rooms[1].unwrap().from, Some((RoomIndex::new(0), DoorIndex::new(1))));
}

#[test]
fn of_two_equal_doors_the_lower_number_is_passed() {
    let graph = RouteGraph::new(rooms(2), vec![door(1, 0, 1, 3.0), door(2, 0, 1, 3.0)]);
    assert_eq!(graph.tree(&start(0)).rooms[1].unwrap().from, Some((RoomIndex::new(0), DoorIndex::new(0))));
}

#[test]
fn a_one_way_door_is_passed_from_its_first_room_only() {
    let graph = RouteGraph::new(rooms(2), vec![RouteDoor { one_way: true, ..door(1, 0, 1, 1.0) }]);
    assert!(graph.tree(&start(0)).rooms[1].is_some());
    assert!(graph.tree(&start(1)).rooms[0].is_none());
    assert_eq!(blockage(&graph, &start(1), &goal(0)), Blockage::Apart);
}

#[test]
fn a_door_without_hardness_is_not_passed_but_named() {
    let unknown = RouteDoor { hardness: None, ..door(7, 0, 1, 0.0) };
    let graph = RouteGraph::new(rooms(2), vec![unknown]);
    assert!(graph.tree(&start(0)).rooms[1].is_none());
    assert_eq!(blockage(&graph, &start(0), &goal(1)), Blockage::Shut(vec![Shut::Door(7)]));
}

#[test]
fn metres_are_weighed_from_crossing_point_to_crossing_point() {
    // two rooms side by side; the shared wall lies at x = 10, the start 3 m left of it and 4 m below its lower end
    let room = |x0, hardness| RouteRoom {
        outline: Rect::new(x0, 0.0, x0 + 10.0, 10.0).into(),
        radius: None,
        berth: Berth::default(),
        walking: Walking::PerMetre(hardness),
    };
    let wall = RouteDoor { crossing: Rect::new(10.0, 8.0, 10.0, 10.0).into(), ..door(1, 0, 1, 0.5) };
    let graph = RouteGraph::new(vec![room(0.0, 1.0), room(10.0, 2.0)], vec![wall]);
    let start = Start::within([RoomIndex::new(0)], Point::new(7.0, 4.0));
    let goal = Goal::within([RoomIndex::new(1)], Some(Point::new(13.0, 8.0)));
    let (_, way) = graph.way(&start, &[goal]).unwrap();
    let legs: Vec<_> =
        way.legs.iter().map(|leg| (leg.room.index(), leg.to, leg.hardness, leg.cost)).collect();
    let bend = Point::new(10.0, 8.0);
    assert_eq!(legs, [(0, bend, 5.0, 5.5), (1, Point::new(13.0, 8.0), 6.0, 11.5)]);
}

#[test]
fn the_shape_is_changed_where_that_is_cheapest_not_where_it_is_first_possible() {
    // a corridor 20 m long, walked at 1 a metre but for a pipe between 9 and 10 m; on the knees 4 a metre all along
    let room = |x0, x1, hardness| RouteRoom {
        outline: Rect::new(x0, 0.0, x1, 2.0).into(),
        radius: None,
        berth: Berth::default(),
        walking: Walking::PerMetre(hardness),
    };
    let rooms = vec![room(0.0, 9.0, 1.0), room(10.0, 20.0, 1.0), room(0.0, 20.0, 4.0)];
    let change = |number, from, to, x0, x1| RouteDoor {
        crossing: Rect::new(x0, 0.0, x1, 2.0).into(),
        one_way: true,
        ..door(number, from, to, 0.5)
    };
    let doors = vec![change(1, 0, 2, 0.0, 9.0), change(2, 2, 1, 10.0, 20.0)];
    let graph = RouteGraph::new(rooms, doors);
    let start = Start::within([RoomIndex::new(0)], Point::new(1.0, 1.0));
    let goal = Goal::within([RoomIndex::new(1)], Some(Point::new(19.0, 1.0)));
    let (_, way) = graph.way(&start, &[goal]).unwrap();
    assert!((way.cost - (8.0 + 0.5 + 4.0 + 0.5 + 9.0)).abs() < 1e-9);
    let at: Vec<Point> = way.legs.iter().map(|leg| leg.to).collect();
    assert_eq!(at, [Point::new(9.0, 1.0), Point::new(10.0, 1.0), Point::new(19.0, 1.0)]);
}

#[test]
fn a_room_of_unknown_hardness_is_not_entered_and_its_door_is_named() {
    // two rules that disagree about a room left its hardness unknown, and it was walked for nothing
    let mut rooms = rooms(3);
    rooms[1].walking = Walking::Unknown;
    let graph = RouteGraph::new(rooms, vec![door(1, 0, 1, 1.0), door(2, 1, 2, 1.0)]);
    let tree = graph.tree(&start(0));
    assert!(tree.rooms[1].is_none() && tree.rooms[2].is_none());
    assert_eq!(blockage(&graph, &start(0), &goal(2)), Blockage::Shut(vec![Shut::Door(1), Shut::Door(2)]));
    assert!(graph.tree(&start(1)).rooms[1].is_none());
}
