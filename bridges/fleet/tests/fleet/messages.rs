//! Every message that is sent is what the published schemas of its version say, and what the text of VDA 5050 says of orders,
//! whatever the routes and whatever the vehicle reports.

use std::fmt::Write;

use adit_fleet::driver::{Clock, Driver, Effect, World};
use adit_fleet::site::{Fleet, Route, Step, Vehicle, Waypoint};
use adit_fleet::way::{Bridge, Margins};
use adit_fleet::wire::{self, Version};
use adit_tests::{TestSite, shared};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::judge::{Chance, Judge, Schemas, schemas};

/// A route of chance from a point: bends, changes of shape, turns, doorways, at times two at one point.
pub fn route(chance: &mut Chance, start: [f64; 2]) -> Route {
    let mut points = vec![start];
    for _ in 0..chance.below(9) {
        let last = points[points.len() - 1];
        points.push(if chance.below(5) == 0 { last } else { [chance.metres(), chance.metres()] });
    }
    let states = ["LOW", "HIGH", "LONG"];
    let mut state = states[chance.below(3) as usize];
    let waypoints = points.iter().map(|at| {
        if chance.below(3) == 0 {
            state = states[chance.below(3) as usize];
        }
        Waypoint {
            x: at[0],
            y: at[1],
            state: Some(state.to_owned()),
            facing: (state == "LONG").then(|| chance.below(8) as f64 * 22.5),
            clearance: (chance.below(2) == 0).then(|| chance.below(900) as f64 / 1000.0),
            ..Waypoint::default()
        }
    });
    let waypoints: Vec<Waypoint> = waypoints.collect();
    let mut steps = Vec::new();
    for (index, pair) in points.windows(2).enumerate() {
        steps.push(Step { space: Some(format!("room {index}")), ..Step::default() });
        for _ in 0..chance.below(3) {
            let share = chance.below(101) as f64 / 100.0;
            let at = |axis: usize| Some(pair[0][axis] + share * (pair[1][axis] - pair[0][axis]));
            steps.push(Step {
                x: at(0),
                y: at(1),
                doorway: Some(format!("doorway {}", chance.below(4))),
                ..Step::default()
            });
        }
    }
    let status = if chance.below(12) == 0 { "no_route" } else { "ok" };
    let start = format!("{},{}", start[0], start[1]);
    Route { status: status.to_owned(), start, goal: "gate".to_owned(), steps, waypoints, ..Route::default() }
}

pub fn fleet() -> Fleet {
    let state = |name: &str, action: Value| {
        let columns = ["robot", "state", "width", "height"].map(|name| json!({"name": name}));
        let concluded = json!([{"property": "vehicle_action", "values": [action]},
                               {"property": "vehicle_blocking", "values": ["SINGLE"]},
                               {"property": "speed", "values": [1.5]}]);
        (columns, json!(["cart", name, 0.7, 1.2]), concluded)
    };
    let rows: Vec<_> =
        [state("LOW", json!("lower")), state("HIGH", json!("raise")), state("LONG", Value::Null)].into();
    let values = |index: usize| rows.iter().map(|row| row.2[index]["values"][0].clone()).collect::<Vec<_>>();
    let concluded: Vec<Value> = ["vehicle_action", "vehicle_blocking", "speed"]
        .iter()
        .enumerate()
        .map(|(index, property)| json!({"property": property, "values": values(index)}))
        .collect();
    let tables = json!({"tables": [
        {"table": "robots", "columns": rows[0].0, "keys": ["cart/LOW", "cart/HIGH", "cart/LONG"],
         "rows": rows.iter().map(|row| row.1.clone()).collect::<Vec<_>>(), "concluded": concluded},
        {"table": "vehicles", "columns": [{"name": "vehicle"}, {"name": "manufacturer"}, {"name": "doing"}], "keys": ["v"],
         "rows": [["v", "acme", null]], "concluded": []},
    ]});
    Fleet::read(&tables).unwrap()
}

/// A vehicle is driven through two hundred moments, with routes of chance.
fn drive(seed: u64, version: Version, schemas: Option<&Schemas>) -> usize {
    let chance = &mut Chance(seed);
    let fleet = fleet();
    let mut driver = Driver::new(Vehicle { goal: Some("gate".to_owned()), ..fleet.vehicles[0].clone() });
    let mut judge = Judge::new(version, schemas, [0.0, 0.0]);
    let margins = Margins { before: 0.3, ahead: 3.0 };
    let bridges = [Bridge { rect: [0.0, 0.0, 5.0, 5.0], height: 1.6 }];
    let (mut sent, mut follows) = (0, None);
    for moment in 0..200 {
        let clock = Clock { seconds: f64::from(moment), words: format!("2026-11-24T08:00:00.{moment:03}Z") };
        let world = World {
            fleet: &fleet,
            margins: &margins,
            bridges: &bridges,
            areas: &[],
            bounds: Some([-20.0, -20.0, 20.0, 20.0]),
            map: "m",
            clock: &clock,
        };
        for effect in driver.think(&world) {
            match effect {
                Effect::Send { topic, message, .. } => {
                    sent += 1;
                    // some are lost on the way
                    if chance.below(10) > 0 {
                        judge.hears(topic, &message);
                    }
                }
                Effect::Follow { epoch, start, .. } => follows = Some((epoch, start)),
                Effect::Ask { epoch, start, .. } => {
                    if chance.below(5) > 0 {
                        driver.answered(epoch, route(chance, start));
                    }
                }
                Effect::Moved { at } => follows = follows.map(|(epoch, _)| (epoch, at)),
                Effect::Unfollow => follows = None,
                Effect::Check { order, update, .. } => driver.checked(&order, update, chance.below(6) > 0),
                Effect::Arrived { .. } => driver.is_written(),
                Effect::Block { .. } | Effect::Write { .. } | Effect::Say(_) => {}
            }
        }
        match (chance.below(6), follows) {
            (0, Some((epoch, start))) => driver.routed(epoch, route(chance, start)),
            (1, _) => driver.doubted(),
            (2, _) => judge.drives(),
            (3, _) if driver.row.goal.is_none() => {
                driver.read(Vehicle { goal: Some("gate".to_owned()), ..driver.row.clone() });
            }
            _ => driver.reported(wire::state(judge.says(chance).to_string().as_bytes()).unwrap()),
        }
    }
    sent
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn all_that_is_sent_is_valid_whatever_comes(seed in any::<u64>()) {
        let schemas = schemas();
        for version in Version::ALL {
            drive(seed, version, schemas.as_ref().map(|all| &all[version.full()]));
        }
    }
}

#[test]
fn such_a_drive_sends_orders() {
    let sent: usize = (0..20).map(|seed| drive(seed, Version::V2_1, None)).sum();
    assert!(sent > 100, "{sent}");
}

/// A small site of chance: two walls with gaps.
fn small_site(chance: &mut Chance) -> TestSite {
    let mut map = String::from("width = 14.0\ndepth = 8.0\n");
    for x in [4.0, 9.0] {
        let gap = 1.0 + chance.below(50) as f64 / 10.0;
        let wide = gap + 0.9 + chance.below(8) as f64 / 10.0;
        let end = x + 0.2;
        for [from, to] in [[0.0, gap], [wide, 8.0]] {
            writeln!(map, "[[obstacle]]\nrect = [{x}, {from}, {end}, {to}]").unwrap();
        }
    }
    map += "[[bridge]]\nrect = [6.0, 0.0, 7.0, 8.0]\nheight = 1.5\n[[place]]\nname = \"home\"\nat = [1.5, 4.0]\n[[place]]\nname = \"gate\"\nat = [12.5, 4.0]\n";
    let robots = "[[robots]]\nstate = \"HIGH\"\naction = \"GO\"\nheight = 1.8\nwidth = 0.7\nhardness = 1.0\n\
                  [[robots]]\nstate = \"LOW\"\naction = \"CREEP\"\nheight = 1.0\nwidth = 0.7\nhardness = 2.0\n\
                  [[changes]]\nfrom_state = \"HIGH\"\nto_state = \"LOW\"\nhardness = 1.0\n\
                  [[changes]]\nfrom_state = \"LOW\"\nto_state = \"HIGH\"\nhardness = 1.0\n";
    let site = "name = \"small\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n";
    TestSite::empty().with("site.toml", site).with("map.toml", &map).with("robots.toml", robots).built()
}

/// What is left of a route from a point of it.
fn rest(route: &Route, from: [f64; 2]) -> Route {
    let mut rest = route.clone();
    let off = |x: f64, y: f64| (x - from[0]).hypot(y - from[1]);
    let mut metres = 0.0;
    let along = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    // the routes of these sites go from the left to the right
    rest.steps.retain(|step| step.x.is_none_or(|x| x > from[0] + 1e-9));
    let next = route
        .waypoints
        .iter()
        .position(|point| point.x > from[0] + 1e-9)
        .unwrap_or(route.waypoints.len() - 1);
    rest.waypoints.drain(..next);
    let first = Waypoint { x: from[0], y: from[1], ..rest.waypoints[0].clone() };
    rest.waypoints.insert(0, first);
    for pair in rest.waypoints.windows(2) {
        metres += along([pair[0].x, pair[0].y], [pair[1].x, pair[1].y]);
    }
    assert!(metres >= off(12.5, 4.0) - 1e-9);
    Route { start: format!("{},{}", from[0], from[1]), ..rest }
}

#[test]
fn orders_of_small_sites_of_chance_are_valid() {
    let Some(schemas) = schemas() else { return };
    for seed in 0..5 {
        let site = small_site(&mut Chance(seed));
        let answer = site.adit("route", &["home", "gate", "--json"]).expecting(0).json();
        let route: Route = serde_json::from_value(answer).unwrap();
        for version in Version::ALL {
            let mut judge = Judge::new(version, Some(&schemas[version.full()]), [1.5, 4.0]);
            let fleet = fleet();
            let mut driver =
                Driver::new(Vehicle { goal: Some("gate".to_owned()), ..fleet.vehicles[0].clone() });
            let mut chance = Chance(seed);
            for moment in 0..400 {
                let clock =
                    Clock { seconds: f64::from(moment), words: format!("2026-11-24T08:00:00.{moment:03}Z") };
                let margins = Margins { before: 0.3, ahead: 1.0 };
                let world = World {
                    fleet: &fleet,
                    margins: &margins,
                    bridges: &[],
                    areas: &[],
                    bounds: Some([-20.0, -20.0, 20.0, 20.0]),
                    map: "m",
                    clock: &clock,
                };
                for effect in driver.think(&world) {
                    match effect {
                        Effect::Send { topic, message, .. } => judge.hears(topic, &message),
                        Effect::Follow { epoch, .. } => driver.routed(epoch, route.clone()),
                        Effect::Ask { epoch, start, .. } => driver.answered(epoch, rest(&route, start)),
                        Effect::Arrived { .. } => driver.is_written(),
                        _ => {}
                    }
                }
                judge.drives();
                let mut state = judge.says(&mut chance);
                state["errors"] = json!([]);
                driver.reported(wire::state(state.to_string().as_bytes()).unwrap());
            }
            let last = judge.nodes.last().unwrap();
            assert_eq!(
                (last["nodeId"].as_str(), judge.at + 1),
                (Some("gate"), judge.nodes.len()),
                "it came there"
            );
            let words: Vec<&str> = judge.nodes.iter().map(|node| node["nodeId"].as_str().unwrap()).collect();
            assert_eq!(words.iter().filter(|id| id.starts_with("doorway")).count(), 2, "{words:?}");
            assert_eq!(judge.actions.len(), 2, "down before the bridge and up behind it: {words:?}");
        }
    }
}

#[test]
fn messages_with_null_for_what_may_be_left_out_are_read() {
    let Some(folder) = shared("data/vda5050/messages-2.0") else { return };
    for name in ["StateTest.jsonSampleMinimal.json", "stateMessageWithNullForOptionalFields.json"] {
        let text = std::fs::read(folder.join(name)).unwrap();
        wire::state(&text).unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}
