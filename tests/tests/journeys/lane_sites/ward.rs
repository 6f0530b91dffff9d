//! A building of Open-RMF with a lift and a door, and a hall of LIF with two vehicle types: closed by name, tuned, asked why.

use std::path::PathBuf;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

use super::site_of;

fn world(name: &str) -> PathBuf {
    repository().join("kb/worlds").join(name)
}

fn ward() -> TestSite {
    site_of(&world("ward.building.yaml"))
}

const STEPS: &str =
    "SELECT place, action FROM action_sequence WHERE start = 'lobby' AND goal = 'pharmacy' ORDER BY step";
const COST: &str = "SELECT status, round(cost, 3) FROM route WHERE start = 'lobby' AND goal = 'pharmacy'";

#[test]
fn a_route_leads_through_the_door_and_round_it_when_it_is_closed() {
    let site = ward();
    assert_eq!(site.sqlite3(STEPS), ["lane 0|DRIVE", "lane 2|GO-THROUGH-DOOR"]);
    assert_eq!(site.sqlite3(COST), ["ok|11.0"], "ten metres, and a metre for the door");
    let closed =
        site.adit("close", &["pharmacy_door", "--until", "2h", "--why", "inventory"]).expecting(0).stdout;
    assert!(closed.contains("lobby to pharmacy"), "{closed}");
    assert_eq!(site.sqlite3(STEPS), ["lane 0|DRIVE", "lane 6|DRIVE", "lane 8|DRIVE", "lane 9|DRIVE"]);
    let not = site.adit("why-not", &["lobby", "pharmacy", "--through", "pharmacy_door"]).expecting(0).stdout;
    assert!(not.contains("pharmacy_door is closed"), "{not}");
    // Open-RMF closes lanes by their number
    let none = site.adit("close", &["lane 6"]).expecting(0).stdout;
    assert!(none.contains("lobby to pharmacy"), "{none}");
    let why = site.adit("route", &["lobby", "pharmacy"]).expecting(1);
    assert!(
        why.stdout.contains("pharmacy_door is closed; lane 6 is closed"),
        "{} {}",
        why.stdout,
        why.stderr
    );
    // what lets nobody through elsewhere is no reason
    site.adit("close", &["store"]).expect_status(0);
    let both = site.adit("route", &["lobby", "store"]).expecting(1).stdout;
    assert!(both.ends_with(" is closed, and store is closed\n"), "{both}");
    site.adit("open", &["lane 6"]).expect_status(0);
    let store = site.adit("route", &["lobby", "store"]).expecting(1).stdout;
    assert_eq!(store, "no route from lobby to store: store is closed\n");
    site.adit("open", &["store"]).expect_status(0);
    site.adit("open", &["pharmacy_door"]).expect_status(0);
    assert_eq!(site.sqlite3(COST), ["ok|11.0"]);
    site.adit("close", &["lane 99"])
        .expecting(2)
        .complains(&["nothing called `lane 99` that could be closed"]);
    site.adit("close", &["node 9"]).expecting(2).complains(&["nothing called `node 9`"]);
}

#[test]
fn a_lift_is_ridden_between_levels_and_closed_by_name() {
    let site = ward();
    let ride = "SELECT place, action, round(hardness, 1), z FROM action_sequence WHERE start = 'lobby' AND goal = 'ward 2' ORDER BY step";
    assert_eq!(
        site.sqlite3(ride),
        [
            "lane 0|DRIVE|5.0|0.0",
            "lane 4|DRIVE|4.0|0.0",
            "lane lift L1 to L2|TAKE-LIFT|14.0|4.0",
            "lane 11|DRIVE|4.0|4.0"
        ]
    );
    let back = site.sqlite3(
        "SELECT action FROM action_sequence WHERE start = 'ward 2' AND goal = 'lobby' AND place = 'lane 5'",
    );
    assert_eq!(back, ["REVERSE"], "out of the cabin a vehicle backs, since it drove in forward");
    site.adit("close", &["lift"]).expect_status(0);
    let ran = site.adit("route", &["lobby", "ward 2"]).expecting(1);
    assert!(ran.stdout.ends_with("lift is closed\n"), "{}", ran.stdout);
    let why = site.adit("why", &["lift"]).expecting(0).stdout;
    assert!(why.contains("lift closed is true"), "{why}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(ride).len(), 4);
    // any node is an end, and so is a point near one
    let near = site.adit("route", &["0.3,0.4", "L2:1", "--json"]).expecting(0).json();
    assert_eq!(near["remarks"][0], "the route starts at node L1:0, 0.50 m from 0.3,0.4");
    let refused = "`900,0.4` is 890.00 m from the nearest node, L1:2, and no lane is longer than 5 m";
    site.adit("route", &["900,0.4", "L2:1"]).expecting(2).complains(&[refused]);
}

#[test]
fn a_lift_that_a_file_only_names_is_closed_by_that_name() {
    let ward = ward();
    let graph = ward.path().join("graph.geojson");
    ward.adit("export", &["--to", graph.to_str().unwrap()]).expect_status(0);
    let site = site_of(&graph);
    assert_eq!(site.sqlite3("SELECT lift FROM lifts"), ["lift"], "Nav2's route graphs place no lifts");
    let cost = "SELECT status FROM route WHERE start = 'lobby' AND goal = 'ward 2'";
    assert_eq!(site.sqlite3(cost), ["ok"]);
    site.adit("close", &["lift"]).expect_status(0);
    assert_eq!(site.sqlite3(cost), ["no_route"]);
}

#[test]
fn tables_and_rules_of_lanes_are_tuned_explained_and_undone() {
    let site = ward();
    let before = site.sqlite3("SELECT * FROM route; SELECT * FROM action_sequence");
    let limited = site.adit("tune", &["vehicle_types", "robot", "speed", "0.55"]).expecting(0).stdout;
    assert!(!limited.is_empty());
    let slow = site.sqlite3(
        "SELECT hardness FROM action_sequence WHERE start = 'lobby' AND goal = 'store' AND place = 'lane 8'",
    );
    assert_eq!(slow, ["5.5"], "five metres at ten elevenths of a vehicle's speed weigh a tenth more");
    let why = site.adit("why", &["lane 8 from lobby to store"]).expecting(0).stdout;
    assert!(why.contains("a limit below the vehicle's own speed counts likewise"), "{why}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT * FROM route; SELECT * FROM action_sequence"), before);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(
        site.sqlite3("SELECT * FROM route; SELECT * FROM action_sequence"),
        before,
        "built anew it is the same"
    );
    site.adit("tune", &["lanes", "0", "to_node", "L1:77"])
        .expecting(2)
        .complains(&["there is no node `L1:77`"]);
    site.adit("tune", &["lanes", "0", "speed_share", "1.5"])
        .expecting(2)
        .complains(&["expected more than 0, up to 1"]);
    // rules of the site's own speak of lanes and doors
    site.write(
        "rules/night.rhai",
        "rule \"at night the pharmacy is shut\" priority 40\n    each travel in TRAVELS\n    each door in LANE_DOORS where door.door == travel.door && door.kind == \"hinged\"\n    then { travel.passable = false; travel.refusal = \"it is night\"; }\n",
    );
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(STEPS).len(), 4, "the rule keeps vehicles from the door");
    site.adit("check", &[]).expect_status(0);
    site.adit("test", &[]).expect_status(0);
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn which_vehicle_may_drive_where_follows_from_its_type_its_height_and_its_load() {
    let site = site_of(&world("racks.lif.json"));
    let way = |robot: &str| {
        site.sqlite3(&format!(
            "SELECT place FROM action_sequence WHERE robot = '{robot}' AND start = 'dock' AND goal = 'rack' ORDER BY step"
        ))
    };
    let (gate, round) = (["lane in", "lane gate"], ["lane in", "lane up", "lane across", "lane down"]);
    assert_eq!(way("forklift"), gate);
    assert_eq!(way("tugger"), round, "the gate is not for tuggers");
    let why = site
        .adit("why-not", &["dock", "rack", "--through", "lane gate", "--robot", "tugger"])
        .expecting(0)
        .stdout;
    assert!(why.contains("lane gate is not for tugger"), "{why}");
    site.adit("tune", &["vehicle_types", "forklift", "height", "2.5"]).expect_status(0);
    assert_eq!(way("forklift"), round);
    let why = site
        .adit("why-not", &["dock", "rack", "--through", "lane gate", "--robot", "forklift"])
        .expecting(0)
        .stdout;
    assert!(why.contains("lane gate allows 2.2 m of height, and forklift has 2.5 m"), "{why}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT robot, load, carried FROM loads"), ["forklift|pallet|0"]);
    let load = ["loads", "tugger/cage", "--add", "height=0.5", "width=1", "carried=1"];
    site.adit("tune", &load).expect_status(0);
    let ran = site.adit("route", &["dock", "rack", "--robot", "tugger"]).expecting(1);
    assert!(
        ran.stdout.contains("lane down is not for a loaded tugger, and it carries cage"),
        "{}",
        ran.stdout
    );
    site.adit("tune", &["loads", "forklift/pallet", "carried", "1"]).expect_status(0);
    assert_eq!(way("forklift"), gate, "pallets may go through the gate");
    let back = site.adit("route", &["rack", "dock", "--robot", "forklift"]).expecting(1);
    assert!(
        back.stdout.contains("lane back is not for a loaded forklift, and it carries pallet"),
        "{}",
        back.stdout
    );
}

#[test]
fn a_door_that_a_navigation_graph_only_names_is_closed_by_name() {
    let folder = TestSite::empty();
    let graph = "building_name: t\nlevels:\n  L1:\n    lanes: [[0, 1, {door_name: coe_door}]]\n    vertices: [[0, 0, {name: a}], [1, 0, {name: b}]]\n";
    folder.write("door.yaml", graph);
    let site = site_of(&folder.path().join("door.yaml"));
    site.adit("route", &["a", "b"]).expect_status(0);
    site.adit("close", &["coe_door"]).expect_status(0);
    let ran = site.adit("route", &["a", "b"]).expecting(1);
    assert!(ran.stdout.contains("coe_door is closed"), "{}", ran.stdout);
}

#[test]
fn a_vehicle_that_is_blocked_closes_the_lane_ahead_of_it() {
    let site = site_of(&world("racks.lif.json"));
    let built = site.adit("build", &[]).expecting(0);
    built.complains(&["limits of speed count for nothing", "row `forklift`, column `speed`"]);
    let closed = || site.sqlite3("SELECT key FROM told WHERE class = 'LANES' AND property = 'closed'");
    // three lanes meet at 6,0: one ends there, one goes on, one turns off
    site.adit("close", &["6,0@0"]).expecting(0).complains(&["6,0@0 is at lane gate, and that is closed"]);
    assert_eq!(closed(), ["gate"]);
    site.adit("open", &["6,0@0"]).expect_status(0);
    site.adit("close", &["7.2,5.3@10", "--for", "1h"]).expect_status(0);
    assert_eq!(closed(), ["across"]);
    site.adit("undo", &[]).expect_status(0);
    site.adit("close", &["6,0@45"]).expecting(2).complains(&["lies on lane gate and on lane up"]);
    site.adit("close", &["6,0"]).expecting(2).complains(&["or the heading as well"]);
    site.adit("close", &["60,2@0"]).expecting(2).complains(&["within 1.5 m of 60,2"]);
    assert_eq!(closed(), [""; 0]);
}

#[test]
fn a_name_of_two_nodes_is_answered_with_both_and_a_point_beyond_all_measure_is_refused() {
    let folder = TestSite::empty();
    let building = "coordinate_system: cartesian_meters\nname: t\nlevels:\n  L1:\n    vertices: [[0, 0, 0, a], [4, 0, 0, b], [4, 4, 0, a]]\n    lanes: [[0, 1, {}], [1, 2, {}]]\n";
    folder.write("names.building.yaml", building);
    let site = site_of(&folder.path().join("names.building.yaml"));
    site.adit("route", &["a", "b"]).expecting(2).complains(&["`a` may be node 0 or node 2"]);
    site.adit("route", &["node 0", "b"]).expect_status(0);
    site.adit("route", &["1e308,1e308", "b"])
        .expecting(2)
        .complains(&["is too far away, expected at most 1e9 m"]);
}

#[test]
fn every_property_that_rules_are_told_of_lanes_is_in_the_manual() {
    let page = std::fs::read_to_string(repository().join("manual/src/lane-graphs.md")).unwrap();
    let class = adit::plan::lanes::judge::class();
    let all = class.told.iter().map(|(name, _)| *name).chain(class.asked.iter().copied());
    for name in all {
        assert!(page.contains(&format!("`{name}`")), "{name} is not in manual/src/lane-graphs.md");
    }
}

#[test]
fn a_layer_of_which_the_map_gives_nothing_is_said_to_be_empty() {
    let site = ward();
    let to = site.path().join("rooms.geojson");
    let ran = site.adit("export", &["rooms", "--to", to.to_str().unwrap()]).expecting(0);
    assert!(ran.stderr.contains("`rooms` is empty; layers that are not: "), "{}", ran.stderr);
}

#[test]
fn why_a_way_over_a_file_is_as_it_is_is_answered_without_a_site() {
    let map = world("ward.building.yaml");
    let why = Command::new(adit()).arg("why").arg(map).args(["lobby", "store"]).output().unwrap();
    let said = Ran::new(&why).expecting(0).stdout;
    assert!(said.starts_with("The route from lobby to store costs 14.\nlane 0: weighs 5"), "{said}");
}
