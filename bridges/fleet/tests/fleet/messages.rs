//! Every message that is sent is what the published schemas of its version say, and what the text of VDA 5050 says of orders,
//! whatever the routes and whatever the vehicle reports.

use std::collections::BTreeMap;

use adit_fleet::driver::{Clock, Driver, Effect, World};
use adit_fleet::site::{Fleet, Route, Step, Vehicle, Waypoint};
use adit_fleet::way::{Bridge, Margins};
use adit_fleet::wire::{self, Version};
use adit_tests::{TestSite, shared};
use jsonschema::Validator;
use proptest::prelude::*;
use serde_json::{Value, json};

/// The schemas of a version.
struct Schemas {
    order: Validator,
    instant: Validator,
}

fn schemas() -> Option<BTreeMap<&'static str, Schemas>> {
    let folder = shared("data/vda5050")?;
    let of = |version: &str, what: &str| {
        let text = std::fs::read_to_string(folder.join(version).join(format!("{what}.schema"))).unwrap();
        let schema = serde_json::from_str(&text).unwrap();
        jsonschema::options().should_validate_formats(true).build(&schema).unwrap()
    };
    let both =
        |version: &str| Schemas { order: of(version, "order"), instant: of(version, "instantActions") };
    Some(BTreeMap::from([
        ("2.0.0", both("schemas-2.0.0")),
        ("2.1.0", both("schemas-2.1.0")),
        ("3.0.0", both("schemas-3")),
    ]))
}

fn expect_valid(schema: &Validator, message: &Value) {
    let errors: Vec<String> =
        schema.iter_errors(message).map(|e| format!("{}: {e}", e.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:#?}\n{message:#}");
}

/// Numbers of chance (splitmix64).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    fn metres(&mut self) -> f64 {
        self.below(40_000) as f64 / 1000.0 - 20.0
    }
}

/// A route of chance from a point: bends, changes of shape, turns, doorways, at times two at one point.
fn route(chance: &mut Chance, start: [f64; 2]) -> Route {
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

fn fleet() -> Fleet {
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

/// A vehicle that takes its orders as the text of VDA 5050 says, and what it holds of what it is told.
struct Judge<'a> {
    schemas: Option<&'a Schemas>,
    version: Version,
    order: String,
    update: u64,
    nodes: Vec<Value>,
    /// The stop at which it is.
    at: usize,
    actions: Vec<Value>,
    cancelled: Option<String>,
    point: [f64; 2],
}

impl Judge<'_> {
    fn hears(&mut self, topic: &str, message: &Value) {
        if topic == "instantActions" {
            if let Some(schemas) = self.schemas {
                expect_valid(&schemas.instant, message);
            }
            assert_eq!(message["actions"][0]["actionType"], "cancelOrder");
            self.cancelled = message["actions"][0]["actionId"].as_str().map(str::to_owned);
            self.nodes.truncate(self.at + 1);
            return;
        }
        if let Some(schemas) = self.schemas {
            expect_valid(&schemas.order, message);
        }
        assert_eq!(message["version"], self.version.full());
        let nodes = message["nodes"].as_array().unwrap();
        let edges = message["edges"].as_array().unwrap();
        assert_eq!(edges.len() + 1, nodes.len());
        let first = nodes[0]["sequenceId"].as_u64().unwrap();
        for (index, node) in nodes.iter().enumerate() {
            assert_eq!(node["sequenceId"], first + 2 * index as u64);
        }
        for (index, edge) in edges.iter().enumerate() {
            assert_eq!(edge["sequenceId"], first + 2 * index as u64 + 1);
            assert_eq!(
                edge["released"],
                nodes[index + 1]["released"],
                "an edge is released with the node to which it leads"
            );
            if self.version < Version::V3_0 {
                assert_eq!(
                    [&edge["startNodeId"], &edge["endNodeId"]],
                    [&nodes[index]["nodeId"], &nodes[index + 1]["nodeId"]]
                );
            }
        }
        let base = nodes.iter().take_while(|node| node["released"] == true).count();
        assert!(base > 0, "there is a base");
        assert!(nodes.iter().skip(base).all(|node| node["released"] == false), "a base, then a horizon");
        let update = message["orderUpdateId"].as_u64().unwrap();
        if message["orderId"] == self.order.as_str() {
            if update == self.update {
                return;
            }
            assert_eq!(update, self.update + 1);
            let stitch = self.nodes.iter().rposition(|node| node["released"] == true).unwrap();
            assert_eq!(nodes[0], self.nodes[stitch], "what was released is said again as it was");
            self.nodes.truncate(stitch);
        } else {
            assert_eq!((first, update), (0, 0), "a new order begins anew");
            assert!(
                self.cancelled.is_some() || self.nodes.len() <= self.at + 1,
                "the order of before was done"
            );
            let at = &nodes[0]["nodePosition"];
            let off =
                (at["x"].as_f64().unwrap() - self.point[0]).hypot(at["y"].as_f64().unwrap() - self.point[1]);
            assert!(off < 1e-6, "its first node is where the vehicle stands");
            (self.nodes, self.at, self.cancelled) = (Vec::new(), 0, None);
            self.order = message["orderId"].as_str().unwrap().to_owned();
            self.actions = Vec::new();
        }
        self.update = update;
        self.nodes.extend(nodes.iter().cloned());
        // the stop that was released is said again with what is done there
        let released =
            nodes.iter().skip(usize::from(update > 0)).chain(edges).filter(|part| part["released"] == true);
        for action in released.flat_map(|part| part["actions"].as_array().unwrap()) {
            assert!(!self.actions.contains(&action["actionId"]), "actions have names of their own");
            self.actions.push(action["actionId"].clone());
        }
    }

    fn drives(&mut self) {
        if self.cancelled.is_none()
            && self.nodes.get(self.at + 1).is_some_and(|next| next["released"] == true)
        {
            self.at += 1;
        }
        if let Some(node) = self.nodes.get(self.at) {
            self.point = ["x", "y"].map(|axis| node["nodePosition"][axis].as_f64().unwrap());
        }
    }

    fn says(&self, chance: &mut Chance) -> Value {
        let left = |part: &Value| json!({"nodeId": "", "sequenceId": part["sequenceId"], "released": part["released"]});
        let nodes: Vec<Value> = self.nodes.iter().skip(self.at + 1).map(left).collect();
        let [position, localized] = match self.version {
            Version::V3_0 => ["mobileRobotPosition", "localized"],
            _ => ["agvPosition", "positionInitialized"],
        };
        let errors = match chance.below(8) {
            0 => json!([{"errorType": "obstacle", "errorLevel": "WARNING"}]),
            1 => json!([{"errorType": "motor", "errorLevel": "FATAL"}]),
            _ => json!([]),
        };
        let ended = self.cancelled.as_ref().map(|id| json!({"actionId": id, "actionStatus": "FINISHED"}));
        json!({
            "headerId": 0, "version": self.version.full(), "orderId": self.order, "orderUpdateId": self.update,
            "lastNodeId": self.nodes.get(self.at).map_or(Value::from(""), |node| node["nodeId"].clone()),
            "lastNodeSequenceId": 2 * self.at, "nodeStates": nodes, "edgeStates": null,
            position: {"x": self.point[0], "y": self.point[1], "theta": 0.0, "mapId": "m", localized: chance.below(9) > 0},
            "driving": chance.below(2) == 0, "newBaseRequest": chance.below(5) == 0,
            "actionStates": ended.into_iter().collect::<Vec<_>>(), "errors": errors, "operatingMode": "AUTOMATIC",
        })
    }
}

/// A vehicle is driven through two hundred moments, with routes of chance.
fn drive(seed: u64, version: Version, schemas: Option<&Schemas>) -> usize {
    let chance = &mut Chance(seed);
    let fleet = fleet();
    let mut driver = Driver::new(Vehicle { goal: Some("gate".to_owned()), ..fleet.vehicles[0].clone() });
    let mut judge = Judge {
        schemas,
        version,
        order: String::new(),
        update: 0,
        nodes: Vec::new(),
        at: 0,
        actions: Vec::new(),
        cancelled: None,
        point: [0.0, 0.0],
    };
    let margins = Margins { before: 0.3, ahead: 3.0 };
    let bridges = [Bridge { rect: [0.0, 0.0, 5.0, 5.0], height: 1.6 }];
    let (mut sent, mut follows) = (0, None);
    for moment in 0..200 {
        let clock = Clock { seconds: f64::from(moment), words: format!("2026-11-24T08:00:00.{moment:03}Z") };
        let world = World { fleet: &fleet, margins: &margins, bridges: &bridges, map: "m", clock: &clock };
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
        map += &format!(
            "[[obstacle]]\nrect = [{x}, 0.0, {}, {gap}]\n[[obstacle]]\nrect = [{x}, {wide}, {}, 8.0]\n",
            x + 0.2,
            x + 0.2
        );
    }
    map += "[[bridge]]\nrect = [6.0, 0.0, 7.0, 8.0]\nheight = 1.5\n[[place]]\nname = \"home\"\nat = [1.5, 4.0]\n[[place]]\nname = \"gate\"\nat = [12.5, 4.0]\n";
    let robots = "[[robots]]\nstate = \"HIGH\"\naction = \"GO\"\nheight = 1.8\nwidth = 0.7\nhardness = 1.0\n\
                  [[robots]]\nstate = \"LOW\"\naction = \"CREEP\"\nheight = 1.0\nwidth = 0.7\nhardness = 2.0\n\
                  [[changes]]\nfrom_state = \"HIGH\"\nto_state = \"LOW\"\nhardness = 1.0\n\
                  [[changes]]\nfrom_state = \"LOW\"\nto_state = \"HIGH\"\nhardness = 1.0\n";
    let site = "name = \"small\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n";
    TestSite::empty().with("site.toml", site).with("map.toml", &map).with("robots.toml", robots).built()
}

#[test]
fn orders_of_small_sites_of_chance_are_valid() {
    let Some(schemas) = schemas() else { return };
    for seed in 0..5 {
        let site = small_site(&mut Chance(seed));
        let answer = site.adit("route", &["home", "gate", "--json"]).expecting(0).json();
        let route: Route = serde_json::from_value(answer).unwrap();
        for version in Version::ALL {
            let mut judge = Judge {
                schemas: Some(&schemas[version.full()]),
                version,
                order: String::new(),
                update: 0,
                nodes: Vec::new(),
                at: 0,
                actions: Vec::new(),
                cancelled: None,
                point: [1.5, 4.0],
            };
            let fleet = fleet();
            let mut driver =
                Driver::new(Vehicle { goal: Some("gate".to_owned()), ..fleet.vehicles[0].clone() });
            let mut chance = Chance(seed);
            for moment in 0..400 {
                let clock =
                    Clock { seconds: f64::from(moment), words: format!("2026-11-24T08:00:00.{moment:03}Z") };
                let margins = Margins { before: 0.3, ahead: 1.0 };
                let world = World { fleet: &fleet, margins: &margins, bridges: &[], map: "m", clock: &clock };
                for effect in driver.think(&world) {
                    match effect {
                        Effect::Send { topic, message, .. } => judge.hears(topic, &message),
                        Effect::Follow { epoch, .. } => driver.routed(epoch, route.clone()),
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
