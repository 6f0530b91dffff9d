//! Backward chaining: a route asks for the weights of the doors that its search comes to, and of no others.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile};
use adit_planners::geometry::{Point, Rect};
use adit_planners::routes::{CompactGraph, RouteDoor, RouteGraph, RouteRoom, Start, Walking};

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
        let rect = Rect::new(0.0, 0.0, 1.0, 1.0);
        let rooms = vec![RouteRoom { rect, walking: Walking::OnDoors }; SIDE * SIDE];
        let door = |(door, &(room1, room2)): (usize, &(usize, usize))| RouteDoor {
            door: door as u32 + 1,
            room1,
            room2,
            crossing: Rect::new(0.0, 0.0, 0.0, 1.0),
            at: Point::new(0.0, 0.0),
            hardness: hardness.get(door).copied().flatten(),
            passable: true,
            one_way: false,
        };
        RouteGraph::new(rooms, pairs.iter().enumerate().map(door).collect())
    };
    let (start, goal) = (SIDE * 100 + 100, SIDE * 130 + 120);

    let mut knowledge = inference(&width, &distance);
    let mut asked = 0;
    let found = CompactGraph::new(&graph(&[])).unwrap().lazy_route(start, goal, |doors| {
        asked += doors.len();
        knowledge.ask_rows(&rules, "DOORS", doors, &["hardness"]);
        doors
            .iter()
            .map(|&door| match knowledge.value_at("DOORS", door as usize, "hardness") {
                Some(adit_engine::Value::Number(hardness)) => Some(hardness),
                _ => None,
            })
            .collect()
    });
    eprintln!(
        "settled {} of {} rooms, weighed {} of {} doors",
        found.settled,
        SIDE * SIDE,
        found.weighed,
        pairs.len()
    );

    let known = knowledge.numbers("DOORS", "hardness").unwrap();
    assert_eq!(known.iter().flatten().count(), found.weighed, "nothing else was computed");
    assert_eq!(asked, found.weighed);

    let mut whole = inference(&width, &distance);
    whole.conclude(&rules);
    let all = graph(&whole.numbers("DOORS", "hardness").unwrap());
    let tree = all.tree(&Start { rooms: vec![start], at: Point::new(0.0, 0.0) });
    let cost = tree.rooms[goal].unwrap().cost;
    assert_eq!(found.cost, Some(cost));
    // of equal costs the room of lower number is settled first
    let is_settled =
        |room: usize| tree.rooms[room].is_some_and(|arrival| (arrival.cost, room) < (cost, goal));
    let settled: Vec<bool> = (0..SIDE * SIDE).map(is_settled).collect();
    let out_of_settled = pairs.iter().filter(|(a, b)| settled[*a] || settled[*b]).count();
    assert_eq!(found.weighed, out_of_settled, "the doors of the rooms settled before the goal");
    assert!(found.weighed * 4 < pairs.len());

    let compact = CompactGraph::new(&all).unwrap().tree(&[start]);
    for room in 0..SIDE * SIDE {
        let best = tree.rooms[room].unwrap();
        assert_eq!(compact.costs[room].to_bits(), best.cost.to_bits());
        assert_eq!(compact.hops[room], best.hops);
    }
}
