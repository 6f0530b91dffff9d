//! Backward chaining: a search that weighs doors as it comes to them asks for the weights of those, and of no others. The
//! search is petgraph's, handed the graph of routes.
#![allow(clippy::float_cmp, clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile};
use adit_planners::geometry::{Convex, Point, Rect};
use adit_planners::routes::{
    Berth, CompactGraph, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Start, Walking,
};
use petgraph::algo::dijkstra;
use petgraph::visit::{EdgeRef, IntoEdges};

/// Rooms a side.
const SIDE: usize = 317;

const RULES: &str = r#"rule "weigh a door"
    each  door  in DOORS
    least state in ROBOTS by hardness where state.width < door.width
    then { door.hardness = door.distance * state.hardness; }
"#;

fn inference(width: &[f64], distance: &[f64]) -> KnowledgeBase {
    let mut knowledge = KnowledgeBase::new();
    let states = Class::new("ROBOTS", &["state"])
        .texts("state", [Some("STAND"), Some("CREEP"), Some("NEVER")])
        .numbers("width", [Some(3.0), Some(1.0), Some(0.0)])
        .numbers("hardness", [Some(1.0), Some(8.0), Some(100.0)]);
    knowledge.assert(states).unwrap();
    let doors = Class::new("DOORS", &["door"])
        .numbers("door", (0..width.len()).map(|door| Some(door as f64)))
        .numbers("width", width.iter().copied().map(Some))
        .numbers("distance", distance.iter().copied().map(Some));
    knowledge.assert(doors).unwrap();
    knowledge
}

#[test]
fn a_route_over_a_hundred_thousand_rooms_weighs_the_doors_of_settled_rooms_only() {
    let mut pairs = Vec::new();
    for room in 0..SIDE * SIDE {
        pairs.extend((room % SIDE + 1 < SIDE).then_some((room, room + 1)));
        pairs.extend((room / SIDE + 1 < SIDE).then_some((room, room + SIDE)));
    }
    let width: Vec<f64> = (0..pairs.len()).map(|door| 0.01 + (door * 7919 % 500) as f64 / 100.0).collect();
    let distance: Vec<f64> = (0..pairs.len()).map(|door| 1.0 + (door * 104_729 % 97) as f64 / 8.0).collect();
    let rules = RuleBase::compile(&[SourceFile::new("doors.rhai", RULES)]).unwrap();

    let graph = |hardness: &[Option<f64>]| {
        let outline = Convex::from(Rect::new(0.0, 0.0, 1.0, 1.0));
        let rooms =
            vec![
                RouteRoom { outline, radius: None, berth: Berth::default(), walking: Walking::OnDoors };
                SIDE * SIDE
            ];
        let door = |(door, &(room1, room2)): (usize, &(usize, usize))| RouteDoor {
            door: door as u32 + 1,
            room1: RoomIndex::new(room1),
            room2: RoomIndex::new(room2),
            crossing: Rect::new(0.0, 0.0, 0.0, 1.0).into(),
            at: Point::new(0.0, 0.0),
            hardness: hardness[door],
            passable: true,
            one_way: false,
        };
        RouteGraph::new(rooms, pairs.iter().enumerate().map(door).collect())
    };
    let (start, goal) = (RoomIndex::new(SIDE * 100 + 100), RoomIndex::new(SIDE * 130 + 120));

    let mut knowledge = inference(&width, &distance);
    let unweighed = graph(&vec![Some(0.0); pairs.len()]);
    let mut weights: Vec<Option<f64>> = vec![None; pairs.len()];
    let found = dijkstra(&unweighed, start, Some(goal), |passage| {
        if weights[passage.id().index()].is_none() {
            // whoever comes to a room asks for all of its doors at once
            let doors = unweighed.edges(passage.source()).map(|passage| passage.id());
            let doors: Vec<u32> = doors
                .filter(|door| weights[door.index()].is_none())
                .map(|door| door.index() as u32)
                .collect();
            knowledge.ask_rows(&rules, "DOORS", &doors, &["hardness"]);
            for door in doors {
                let hardness = knowledge.value_at("DOORS", door as usize, "hardness");
                let Some(adit_engine::Value::Number(hardness)) = hardness else { panic!("{hardness:?}") };
                weights[door as usize] = Some(hardness);
            }
        }
        weights[passage.id().index()].unwrap()
    });
    let weighed = weights.iter().flatten().count();
    eprintln!("weighed {weighed} of {} doors", pairs.len());

    let known = knowledge.numbers("DOORS", "hardness").unwrap();
    assert_eq!(known, weights, "nothing else was computed");

    let mut whole = inference(&width, &distance);
    whole.conclude(&rules);
    let all = graph(&whole.numbers("DOORS", "hardness").unwrap());
    let tree = all.tree(&Start::within([start], Point::new(0.0, 0.0)));
    let cost = tree.rooms[goal.index()].unwrap().cost;
    assert_eq!(found[&goal], cost);
    // of rooms that cost as much as the goal, some are settled before it
    let doors_of = |is_settled: &dyn Fn(usize) -> bool| {
        pairs.iter().filter(|(a, b)| is_settled(*a) || is_settled(*b)).count()
    };
    let costs = |room: usize| tree.rooms[room].map_or(f64::INFINITY, |arrival| arrival.cost);
    let least = doors_of(&|room| costs(room) < cost);
    let most = doors_of(&|room| costs(room) <= cost && room != goal.index());
    assert!(
        (least..=most).contains(&weighed),
        "the doors of the rooms settled before the goal: {least} to {most}"
    );
    assert!(weighed * 4 < pairs.len());

    let compact = CompactGraph::new(&all).unwrap().tree(&Start::within([start], Point::new(0.0, 0.0)));
    for room in all.room_indices() {
        let best = tree.rooms[room.index()].unwrap();
        assert_eq!(compact.cost(room).to_bits(), best.cost.to_bits());
        assert_eq!(compact.hops(room), best.hops);
    }
}
