//! What a world says of its doors and regions reaches the rules that weigh ways.

use adit_tests::TestSite;
use serde_json::Value;

use super::flat::{copy_rules, flat, run};

/// From the bed to a spot beside the door to the store: over the desk's own door, or through the store.
const TRIP: [&str; 3] = ["bed", "8.6,1.7", "--json"];

fn route(folder: &TestSite, args: &[&str]) -> Value {
    run(folder, "route", args).expect_status(0).json()
}

fn doorways(route: &Value) -> Vec<String> {
    let places = route["steps"].as_array().expect("steps").iter().filter_map(|step| step["place"].as_str());
    places.filter(|place| place.starts_with("doorway")).map(str::to_owned).collect()
}

#[test]
fn a_door_that_squeaks_is_spared_by_a_way_that_is_not_much_longer() {
    let folder = flat();
    let quiet = route(&folder, &TRIP);
    folder.write("flat.toml", folder.read("flat.toml") + "\n[[doorway]]\nat = [6.5, 4.0]\nsqueaks = true\n");
    let spared = route(&folder, &TRIP);
    assert_ne!(doorways(&spared), doorways(&quiet));
    assert!(spared["distance"].as_f64() > quiet["distance"].as_f64());
    // Right behind the door there is no way that is worth it.
    let short = ["bed", "6.5,3.0", "--json"];
    let through = route(&folder, &short);
    assert!(doorways(&through).contains(&doorways(&quiet)[1]));
    assert!(through["cost"].as_f64() > through["distance"].as_f64(), "it weighs more than its length");
    folder.edit("flat.toml", "squeaks = true", "squeaks = false");
    assert_eq!(doorways(&route(&folder, &TRIP)), doorways(&quiet));
}

#[test]
fn a_robot_spares_it_as_well() {
    let folder = flat();
    let length = |folder| run(folder, "simulate", &TRIP).expect_status(0).json()[0]["length"].as_f64();
    let quiet = length(&folder).expect("metres");
    folder.write("flat.toml", folder.read("flat.toml") + "\n[[doorway]]\nat = [6.5, 4.0]\nsqueaks = true\n");
    assert!(length(&folder).expect("metres") > quiet + 2.0);
}

#[test]
fn properties_of_a_users_own_are_there_for_rules_of_a_users_own() {
    let folder = flat();
    copy_rules(&folder);
    let wet = "rule \"nobody crosses what is wet\" priority 2\n    each way in WAYS where way.floor == \"wet\"\n    then { way.passable = false; }\n";
    folder.write("rules/own.rhai", wet);
    folder.write("flat.toml", folder.read("flat.toml") + "\n[[region]]\nat = [7.0, 4.8]\nfloor = \"dry\"\n");
    run(&folder, "route", &["bed", "bath"]).expect_status(0);
    folder.edit("flat.toml", "\"dry\"", "\"wet\"");
    run(&folder, "route", &["bed", "bath"]).expect_status(1);
    run(&folder, "route", &["desk", "store"]).expect_status(0);
    // What no world tells is no property that rules may name.
    folder.edit("flat.toml", "floor = \"wet\"", "");
    run(&folder, "route", &["bed", "bath"]).expect_status(2).complains(&["own.rhai", "floor"]);
}
