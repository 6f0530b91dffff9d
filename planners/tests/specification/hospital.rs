//! The hospital floor: from the dock to ward 6 one passes under a low pipe, and only a low state does.

use std::collections::BTreeSet;
use std::path::Path;

use adit_planners::facts::{Column, Facts, Table};
use adit_planners::geometry::Point;
use adit_planners::layers::{Headroom, Kind, Layers, RoomsByState, State, cut_layers, headroom, narrowest};
use adit_planners::planner::Planner;
use adit_planners::read::{MapSettings, read_map};
use adit_planners::world::World;

fn hospital() -> World {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/maps/hospital.toml");
    read_map(&path, &MapSettings::default()).unwrap().0
}

fn states(named: &[&str]) -> Vec<State> {
    let all = [("STAND", 1.7, 0.6), ("SIDE-STAND", 1.7, 0.35), ("SQUAT", 1.1, 0.8), ("LIE", 0.6, 0.8)];
    let chosen = all.iter().filter(|(name, ..)| named.contains(name));
    chosen
        .map(|&(name, height, width)| State { robot: None, state: name.into(), height, width, length: None })
        .collect()
}

fn place(world: &World, name: &str) -> Point {
    world.places.iter().find(|place| place.name == name).unwrap().at
}

/// The rooms that can be reached from those that contain `from`, in any state, through doors and changes.
fn reachable(layers: &Layers, from: Point) -> BTreeSet<usize> {
    let mut open: Vec<usize> =
        (0..layers.rooms.len()).filter(|&room| layers.rooms[room].outline.contains(from)).collect();
    let mut reached: BTreeSet<usize> = open.iter().copied().collect();
    while let Some(room) = open.pop() {
        for crossing in &layers.crossings {
            let next = match crossing.kind {
                _ if crossing.room1 == room => crossing.room2,
                Kind::Door if crossing.room2 == room => crossing.room1,
                _ => continue,
            };
            if reached.insert(next) {
                open.push(next);
            }
        }
    }
    reached
}

fn is_way(world: &World, named: &[&str]) -> bool {
    let layers = cut_layers(world, &states(named)).unwrap();
    let goal = place(world, "ward 6");
    reachable(&layers, place(world, "dock")).iter().any(|&room| layers.rooms[room].outline.contains(goal))
}

#[test]
fn a_low_state_is_needed_to_come_under_the_pipe() {
    let world = hospital();
    assert!(is_way(&world, &["STAND", "SQUAT"]));
    assert!(is_way(&world, &["STAND", "LIE"]));
    assert!(!is_way(&world, &["STAND"]));
    assert!(
        is_way(&world, &["STAND", "SIDE-STAND"]),
        "sideways through the wards, by the door of half a metre"
    );
}

#[test]
fn the_way_between_dock_and_ward_lies_under_the_pipe() {
    let mut world = hospital();
    let pipe = world.bridges[0].rect;
    let layers = cut_layers(&world, &states(&["STAND", "SQUAT", "LIE"])).unwrap();
    let under = layers.rooms.iter().filter(|room| room.outline.common(&pipe.into()).is_some());
    assert!(under.clone().all(|room| room.height == Some(1.3) && room.state > 0));
    assert!(under.count() > 0);
    world.bridges[0].height = 0.5;
    assert!(!is_way(&world, &["STAND", "SQUAT", "LIE"]), "lower than lying, nobody passes");
}

#[test]
fn a_bridge_exactly_as_high_as_a_state_stops_it() {
    let mut world = hospital();
    world.bridges[0].height = 1.1;
    assert!(!is_way(&world, &["STAND", "SQUAT"]));
}

#[test]
fn the_reason_for_no_way_is_the_pipe_for_the_tall_and_a_gap_for_the_wide() {
    let world = hospital();
    let (dock, ward) = (place(&world, "dock"), place(&world, "ward 6"));
    let Headroom::Limited { height, at } = headroom(&world, dock, ward, 0.6, 0.05).unwrap() else {
        panic!("the pipe limits the height")
    };
    assert_eq!(height.to_string(), "1.3");
    assert!((18.2..=20.8).contains(&at.x), "under the pipe, at {at:?}");
    let widest = narrowest(&world, dock, ward, 0.05).unwrap();
    assert!((widest.width - 0.65).abs() < 0.01, "past the bed store, {widest:?}");
    assert!((31.0..=33.0).contains(&widest.at.x), "{widest:?}");
}

#[test]
fn the_planner_asserts_rooms_and_doors_by_name() {
    let world = hospital();
    let texts = |values: &[&str]| values.iter().map(|v| (*v).to_owned()).collect::<Column>();
    let robots = Table::default()
        .with("robot", texts(&["nurse"; 4]))
        .with("state", texts(&["STAND", "SQUAT", "LIE", "IMPOSSIBLE"]))
        .with("height", [1.7, 1.1, 0.6, 0.0].into_iter().collect::<Column>())
        .with("width", [0.6, 0.8, 0.8, 0.0].into_iter().collect::<Column>())
        .with("length", Column::Number(vec![None; 4]))
        .with("moves", [true, true, true, false].into_iter().collect::<Column>());
    let known = Facts::from([("ROBOTS".to_owned(), robots)]);
    let facts = RoomsByState::default().facts(&world, &known).unwrap();
    let (rooms, doors) = (&facts["ROOMS"], &facts["DOORS"]);
    for given in RoomsByState::default().signature().gives {
        let (name, sort) = given.split_once(": ").unwrap_or((&given, "number"));
        let (class, property) = name.split_once('.').unwrap();
        let column = facts[class].column(property).unwrap();
        let found = match column {
            Column::Number(_) => "number",
            Column::Text(_) => "text",
            Column::Truth(_) => "truth",
        };
        assert_eq!((found, column.len()), (sort, facts[class].len()), "{given}");
    }
    assert_eq!(rooms.texts("name").unwrap()[0].as_deref(), Some("a"));
    let states: BTreeSet<_> = rooms.texts("state").unwrap().iter().flatten().cloned().collect();
    assert_eq!(states, ["LIE", "SQUAT", "STAND"].map(String::from).into());
    let pairs: Vec<_> = doors.numbers("room1").unwrap().iter().zip(doors.numbers("room2").unwrap()).collect();
    assert!(pairs.is_sorted(), "doors are numbered by their rooms");
    let changes =
        doors.texts("kind").unwrap().iter().filter(|kind| kind.as_deref() == Some("change")).count();
    let one_way = doors.truths("one_way").unwrap().iter().filter(|way| **way == Some(true)).count();
    assert_eq!((changes, changes % 2), (one_way, 0), "a change there has a change back");
    assert!(doors.numbers("width").unwrap().iter().flatten().all(|width| *width > 0.0));
}

#[test]
fn what_the_planner_lacks_it_names() {
    let message = |known: &Facts| RoomsByState::default().facts(&hospital(), known).unwrap_err().to_string();
    assert!(message(&Facts::new()).contains("ROBOTS: the class is missing"));
    let texts = |value: &str| std::iter::once(value.to_owned()).collect::<Column>();
    let numbers = |value: f64| std::iter::once(value).collect::<Column>();
    let robots = Table::default()
        .with("robot", texts("nurse"))
        .with("state", texts("STAND"))
        .with("height", numbers(1.7))
        .with("width", numbers(0.0))
        .with("length", Column::Number(vec![None]));
    let of = |robots: Table| Facts::from([("ROBOTS".to_owned(), robots)]);
    assert!(message(&of(robots.clone())).contains("`moves` is missing"));
    let robots = robots.with("moves", Column::Truth(vec![Some(true)]));
    assert!(message(&of(robots)).contains("state `STAND` moves and is 0 m wide"));
}
