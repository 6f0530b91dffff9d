use std::sync::Arc;
use std::time::Instant;

use adit_db::Derived;
use adit_db::door::{Door, DoorKind, Side};
use adit_db::place::Place;
use adit_db::room::Room;
use adit_db::space::{Doorway, Space};
use adit_db::weight::Weight;

use super::*;
use crate::answer::steps;
use crate::graph::Building;

/// A floor of rooms in a square, joined by doors to the right and upwards.
fn floor(side: usize) -> SiteGraph {
    let room = |number: usize| Room {
        room: number as i64 + 1,
        // names are users' texts
        name: format!("r\"{number}\\é"),
        layer: None,
        facing: None,
        rect: [
            4.1 * (number % side) as f64,
            4.1 * (number / side) as f64,
            4.1 * (number % side + 1) as f64,
            4.1 * (number / side + 1) as f64,
        ],
        outline: None,
        radius: None,
        berth: None,
        berth_cost: None,
        height: None,
        width: 4.1,
        // of the last one no outline tells
        space: Some(number as i64 % 4 + 1),
        hardness: Derived::default(),
        action: if number.is_multiple_of(7) {
            Derived::default()
        } else {
            Derived::by(1, None, "walk".to_owned())
        },
        passable: Derived::by(2, None, true),
        measures: Some(r#"{"joules":0.0,"seconds":0.0}"#.to_owned()),
    };
    let pairs = (0..side * side).flat_map(|room| {
        let (x, y) = (room % side, room / side);
        let right = (x + 1 < side).then_some((room, room + 1));
        let upper = (y + 1 < side).then_some((room, room + side));
        right.into_iter().chain(upper)
    });
    let rooms: Vec<Room> = (0..side * side).map(room).collect();
    let doors = pairs.enumerate().map(|(number, (one, two))| door(number, [one, two], &rooms)).collect();
    let place = Place { place: "dock".to_owned(), x: 1.0, y: 3.0 };
    SiteGraph::new(rooms, doors, vec![place], building())
}

/// Three spaces, of which one has no name, and a doorway between two of them.
fn building() -> Arc<Building> {
    let name = |number: i64| (number != 2).then(|| format!("ward \"{number}\""));
    let space = |number: i64| Space { space: number, name: name(number), ..Space::default() };
    let doorway = Doorway { doorway: 1, space1: 1, space2: 2, ..Doorway::default() };
    let (spaces, doorways) = ((1..4).map(space).collect(), vec![doorway]);
    Arc::new(Building { spaces, doorways, ..Building::default() })
}

fn door(number: usize, rooms: [usize; 2], all: &[Room]) -> Door {
    let side = |room: usize| Side { room: room as i64 + 1, height: None, width: None, distance: None };
    let [x0, y0, ..] = all[rooms[1]].rect;
    let is_upright = rooms[1] == rooms[0] + 1;
    let (x1, y1) = if is_upright { (x0, y0 + 4.1) } else { (x0 + 4.1, y0) };
    Door {
        door: number as i64 + 1,
        kind: DoorKind::Door,
        side1: side(rooms[0]),
        side2: side(rooms[1]),
        at: [f64::midpoint(x0, x1), f64::midpoint(y0, y1)],
        width: 4.1,
        segment: [x0, y0, x1, y1],
        hardness: Derived::by(3, None, hardness(number)),
        action: Derived::by(3, None, if number.is_multiple_of(3) { "side-walk" } else { "walk" }.to_owned()),
        passable: Derived::by(3, None, !number.is_multiple_of(31)),
        one_way: number.is_multiple_of(11),
        measures: measures(number),
    }
}

/// What some doors say; of many ways one of the measures is not known.
fn measures(number: usize) -> Option<String> {
    let seconds = format!(r#"{{"seconds":{:?}}}"#, hardness(number) / 3.0);
    let both = format!(r#"{{"joules":{:?},"seconds":1.5}}"#, hardness(number) * 7.0);
    [Some(both), Some(seconds)][usize::from(number.is_multiple_of(17))].clone()
}

fn hardness(number: usize) -> f64 {
    0.1 + (number * 7919 % 256) as f64 / 10.0
}

fn rules() -> Rules {
    [(1, "move \"so\""), (2, "enter"), (3, "pass")].map(|(key, name)| (key, name.to_owned())).into()
}

/// The answer as serde writes it, and as it is put together.
fn both(graph: &SiteGraph, [start, goal]: [&str; 2]) -> Option<[Vec<u8>; 2]> {
    let ends = [start, goal].map(|name| graph.end(name).unwrap());
    let goals = [graph.goal(None, &ends[1], None)];
    let (_, way) = graph.graph().way(&graph.start(None, &ends[0], None), &goals)?;
    let rules = rules();
    let mut answer = Answer::blank("r", start, &[goal.to_owned()], 7);
    let text = write(&answer, (graph, graph.texts().unwrap(), &rules), &way).unwrap();
    answer.steps = steps::steps(graph, &rules, &way, goals[0].at.is_some());
    answer.waypoints = steps::waypoints(graph, &way, None);
    (answer.cost, answer.status) = (Some(way.cost), Status::of(&way));
    answer.measures = answer.at_the_end();
    Some([serde_json::to_vec(&answer).unwrap(), text])
}

#[test]
fn what_is_put_together_is_what_serde_writes() {
    let mut graph = floor(9);
    graph.prepare();
    let room = |number: usize| format!("r\"{number}\\é");
    let mut routes = 0;
    for round in 0..3 {
        for from in (0..81).step_by(8) {
            for to in
                ["dock".to_owned(), room(from), room(80), room((from * 5 + 3) % 81), "30.25,20".to_owned()]
            {
                for [start, goal] in [[&room(from), &to], [&to, &room(from)]] {
                    let Some([serde, ours]) = both(&graph, [start, goal]) else { continue };
                    assert_eq!(String::from_utf8_lossy(&ours), String::from_utf8_lossy(&serde));
                    routes += 1;
                }
            }
        }
        // texts follow what is weighed anew
        let weighed = graph.graph().door_indices().step_by(2).map(|door| {
            let hardness = Derived::by(1, None, hardness(door.index() + round + 1));
            let (action, passable) = (Derived::by(1, None, "crawl".to_owned()), graph[door].passable.clone());
            let measures = measures(door.index() + round);
            (door, Weight { hardness, action, passable, measures })
        });
        let weighed: Vec<_> = weighed.collect();
        let building = Arc::clone(&graph.building);
        graph.write([], weighed, &building);
    }
    assert!(routes > 200, "{routes}");
}

/// How long answers take from names to text. `cargo test --release -p adit --lib how_long -- --ignored --nocapture`
#[test]
#[ignore = "measures"]
fn how_long_answers_take() {
    for side in [23, 71, 224] {
        let mut graph = floor(side);
        let began = Instant::now();
        graph.prepare();
        let (prepared, rules) = (began.elapsed(), rules());
        let (mut state, mut draw) = (1_u64, Vec::new());
        for _ in 0..4_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            draw.push(graph.rooms[(state >> 33) as usize % (side * side)].name.clone());
        }
        for what in ["way", "steps and waypoints", "with serde", "put together", "put together again"] {
            let (mut took, mut rooms, mut bytes) = (Vec::new(), 0, 0);
            for pair in draw.chunks_exact(2) {
                let began = Instant::now();
                let ends = [0, 1].map(|end| graph.end(&pair[end]).unwrap());
                let goals = [graph.goal(None, &ends[1], None)];
                let Some((_, way)) = graph.graph().way(&graph.start(None, &ends[0], None), &goals) else {
                    continue;
                };
                let mut answer = Answer::blank("r", &pair[0], &pair[1..], 7);
                if what.starts_with("put") {
                    bytes += write(&answer, (&graph, graph.texts().unwrap(), &rules), &way).unwrap().len();
                } else if what != "way" {
                    answer.steps = steps::steps(&graph, &rules, &way, false);
                    answer.waypoints = steps::waypoints(&graph, &way, None);
                    if what == "with serde" {
                        bytes += serde_json::to_vec(&answer).unwrap().len();
                    }
                }
                took.push(began.elapsed());
                rooms += way.legs.len();
            }
            took.sort_unstable();
            let (count, half) = (took.len(), took[took.len() / 2]);
            println!(
                "{} doors, prepared in {prepared:.1?}, {what}: {half:.1?} (99 %: {:.1?}), {} rooms, {} bytes",
                graph.doors.len(),
                took[count * 99 / 100],
                rooms / count,
                bytes / count
            );
        }
    }
}
