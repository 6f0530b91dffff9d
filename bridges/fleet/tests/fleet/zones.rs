//! The areas of a site are zones to vehicles that know them: valid by the published schema, whatever is said of areas.

use adit_fleet::driver::{Clock, Driver, Effect, World};
use adit_fleet::site::{Area, Vehicle};
use adit_fleet::way::{Body, Floor, Margins, stops};
use adit_fleet::wire::{self, Version};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::judge::{Chance, Judge, expect_valid, schemas};
use crate::messages::fleet;

/// What the fleet says to a vehicle, by topic, of these areas, one after the other.
fn told(version: Version, all: &[Value]) -> (Vec<(&'static str, Value)>, Vec<String>) {
    let fleet = fleet();
    let mut driver = Driver::new(fleet.vehicles[0].clone());
    let judge = Judge::new(version, None, [0.0, 0.0]);
    let (mut told, mut said) = (Vec::new(), Vec::new());
    for (moment, areas) in all.iter().enumerate() {
        let areas = Area::read(&json!({"areas": areas}));
        let clock = Clock { seconds: moment as f64, words: format!("2026-11-24T08:00:00.{moment:03}Z") };
        let margins = Margins { before: 0.3, ahead: 3.0 };
        let world = World {
            fleet: &fleet,
            margins: &margins,
            bridges: &[],
            areas: &areas,
            bounds: Some([-20.0, -20.0, 20.0, 20.0]),
            map: "m",
            clock: &clock,
        };
        driver.read(Vehicle { goal: None, ..fleet.vehicles[0].clone() });
        driver.reported(wire::state(judge.says(&mut Chance(1)).to_string().as_bytes()).unwrap());
        for effect in driver.think(&world) {
            match effect {
                Effect::Send { topic, message, .. } => told.push((topic, message)),
                Effect::Say(words) => said.push(words),
                _ => {}
            }
        }
    }
    (told, said)
}

fn area(name: &str, kind: Option<&str>, properties: &Value) -> Value {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.5]];
    json!({"name": name, "kind": kind, "corners": corners, "properties": properties})
}

/// Areas of which all that may be said is said by chance, right or wrong.
fn areas(chance: &mut Chance) -> Value {
    let kinds = [None, Some("keep-out"), Some("speed-limit"), Some("wet")];
    let zones = [
        "BLOCKED",
        "SPEED_LIMIT",
        "PENALTY",
        "PRIORITY",
        "DIRECTED",
        "BIDIRECTED",
        "LINE_GUIDED",
        "ACTION",
        "RELEASE",
        "",
    ];
    let one = |number: u64, chance: &mut Chance| {
        let mut properties = json!({
            "zone_factor": chance.metres() / 10.0, "speed_limit": chance.metres() / 10.0, "zone_direction": chance.metres() * 30.0,
            "zone_limitation": (["SOFT", "STRICT", "HARD"][chance.below(3) as usize]), "zone_action": "beep",
            "zone_blocking": (["NONE", "SOFT", "SINGLE", "LOUD"][chance.below(4) as usize]), "closed": chance.below(5) == 0,
        });
        for property in ["zone_factor", "speed_limit", "zone_limitation", "zone_action", "zone_blocking"] {
            if chance.below(4) == 0 {
                properties.as_object_mut().unwrap().remove(property);
            }
        }
        if chance.below(4) > 0 {
            properties["zone"] = json!(zones[chance.below(10) as usize]);
        }
        let mut area = area(&format!("area {number}"), kinds[chance.below(4) as usize], &properties);
        let corners: Vec<_> = (0..3 + chance.below(5)).map(|_| [chance.metres(), chance.metres()]).collect();
        area["corners"] = json!(corners);
        area
    };
    let count = chance.below(8);
    (0..count).map(|number| one(number, chance)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn every_zone_set_is_valid_whatever_is_said_of_areas(seed in any::<u64>()) {
        let chance = &mut Chance(seed);
        let all: Vec<Value> = (0..5).map(|_| areas(chance)).collect();
        for version in [Version::V2_0, Version::V2_1] {
            prop_assert!(told(version, &all).0.is_empty(), "vehicles before 3.0 know no zones");
        }
        let Some(schemas) = schemas() else { return Ok(()) };
        let schemas = &schemas["3.0.0"];
        for pair in told(Version::V3_0, &all).0.chunks(2) {
            let [(zones, set), (instant, action)] = pair else { panic!("{pair:?}") };
            prop_assert_eq!((*zones, *instant), ("zoneSet", "instantActions"));
            expect_valid(schemas.zones.as_ref().unwrap(), set);
            expect_valid(&schemas.instant, action);
            let enabled = &action["actions"][0]["actionParameters"][0]["value"];
            prop_assert_eq!(enabled, &set["zoneSet"]["zoneSetId"]);
        }
    }
}

#[test]
fn each_kind_of_zone_says_what_is_said_of_the_area() {
    let areas = json!([
        area("stairs", Some("keep-out"), &json!({})),
        area("shut", None, &json!({"closed": true})),
        area("ramp", Some("speed-limit"), &json!({"speed_limit": 0.5})),
        area("wet", Some("wet"), &json!({"zone": "PENALTY", "zone_factor": 0.8})),
        area("lane", None, &json!({"zone": "PRIORITY", "zone_factor": 0.25})),
        area(
            "one way",
            None,
            &json!({"zone": "DIRECTED", "zone_direction": 90.0, "zone_limitation": "STRICT"})
        ),
        area("aisle", None, &json!({"zone": "BIDIRECTED", "zone_direction": 180.0})),
        area("line", None, &json!({"zone": "LINE_GUIDED"})),
        area("crossing", None, &json!({"zone": "ACTION", "zone_action": "beep", "zone_blocking": "NONE"})),
        area("hall", None, &json!({})),
        area("slow", Some("speed-limit"), &json!({"speed_percent": 50.0})),
    ]);
    let (told, said) = told(Version::V3_0, &[areas.clone(), areas, json!([])]);
    assert_eq!(told.len(), 4, "once, and when there are none any more");
    let zones = told[0].1["zoneSet"]["zones"].as_array().unwrap();
    let of = |name: &str| zones.iter().find(|zone| zone["zoneId"] == name).cloned().unwrap_or_default();
    for (name, key, value) in [
        ("stairs", "zoneType", json!("BLOCKED")),
        ("shut", "zoneType", json!("BLOCKED")),
        ("ramp", "maximumSpeed", json!(0.5)),
        ("wet", "penaltyFactor", json!(0.8)),
        ("lane", "priorityFactor", json!(0.25)),
        ("one way", "direction", json!(90f64.to_radians())),
        ("one way", "directedLimitation", json!("STRICT")),
        ("aisle", "bidirectedLimitation", json!("SOFT")),
        ("line", "zoneType", json!("LINE_GUIDED")),
        ("crossing", "entryActions", json!([{"actionType": "beep", "blockingType": "NONE"}])),
    ] {
        assert_eq!(of(name)[key], value, "{name}");
    }
    assert_eq!(
        of("stairs")["vertices"],
        json!([{"x": 0.0, "y": 0.0}, {"x": 2.0, "y": 0.0}, {"x": 2.0, "y": 1.5}])
    );
    assert_eq!(zones.len(), 9);
    assert!(
        said.iter().any(|words| words.contains("`slow` is no zone SPEED_LIMIT: it needs a `speed_limit`")),
        "{said:?}"
    );
    assert_eq!(told[2].1["zoneSet"]["zones"], json!([]));
}

#[test]
fn one_drives_no_faster_on_a_leg_than_any_area_on_it_lets_one() {
    let areas = json!([
        area("ramp", Some("speed-limit"), &json!({"speed_limit": 0.5})),
        area("ward", Some("speed-limit"), &json!({"speed_percent": 25.0})),
        area("hall", None, &json!({})),
    ]);
    let mut areas = Area::read(&json!({"areas": areas}));
    // the ramp from x 0 to 2, the ward from 10 to 12
    areas[1].corners.iter_mut().for_each(|corner| corner[0] += 10.0);
    let route = json!({"status": "ok", "start": "0,1", "goal": "14,1", "waypoints": [
        {"x": 0.0, "y": 1.0, "state": "GO"}, {"x": 1.9, "y": 1.4, "state": "GO"}, {"x": 6.0, "y": 1.0, "state": "GO"},
        {"x": 14.0, "y": 1.0, "state": "GO"}, {"x": 11.0, "y": 8.0, "state": "GO"},
    ]});
    let route = serde_json::from_value(route).unwrap();
    let margins = Margins { before: 0.3, ahead: 3.0 };
    let speeds = |own| {
        let floor = Floor { bridges: &[], areas: &areas };
        let stops = stops(&route, |_| Body { half: 0.3, speed: own }, &margins, floor);
        stops.iter().skip(1).map(|stop| stop.speed).collect::<Vec<_>>()
    };
    assert_eq!(speeds(Some(1.2)), [Some(0.5), Some(0.5), Some(0.3), Some(1.2)]);
    assert_eq!(speeds(None), [Some(0.5), Some(0.5), None, None], "a share of what is not known is not known");
    assert_eq!(speeds(Some(0.4))[0], Some(0.4));
}
