//! LIF: a station is reached from any of its nodes, nodes and edges are for the vehicle types that they list, and layouts are
//! joined by edges.

use adit_tests::TestSite;

use super::site_of;

/// Two layouts; from `dock` a station is reached by the nodes `near` and `far`, of which the first named is the farther, and `far` is
/// for carts alone.
const FLOORS: &str = r#"{
  "metaInformation": {"projectIdentification": "floors", "creator": "c", "exportTimestamp": "2026-11-25T00:00:00Z", "lifVersion": "1.0.0"},
  "layouts": [
    {"layoutId": "ground", "layoutVersion": "1",
     "nodes": [
       {"nodeId": "dock", "nodePosition": {"x": 0, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}, {"vehicleTypeId": "lorry"}]},
       {"nodeId": "far", "nodePosition": {"x": 9, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}]},
       {"nodeId": "near", "nodePosition": {"x": 0, "y": 4}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}, {"vehicleTypeId": "lorry"}]}],
     "edges": [
       {"edgeId": "to far", "startNodeId": "dock", "endNodeId": "far", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart"}, {"vehicleTypeId": "lorry"}]},
       {"edgeId": "to near", "startNodeId": "dock", "endNodeId": "near", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart"}, {"vehicleTypeId": "lorry"}]},
       {"edgeId": "up", "startNodeId": "near", "endNodeId": "roof", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart"}]}],
     "stations": [{"stationId": "rack", "interactionNodeIds": ["far", "near"]}]},
    {"layoutId": "upstairs", "layoutVersion": "1",
     "nodes": [{"nodeId": "roof", "nodePosition": {"x": 1, "y": 4}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}]}],
     "edges": [], "stations": []}]
}"#;

fn floors() -> TestSite {
    let site = TestSite::empty();
    site.write("floors.lif.json", FLOORS);
    site_of(&site.path().join("floors.lif.json"))
}

/// The lanes of a route.
fn lanes(site: &TestSite, start: &str, goal: &str, robot: &str) -> Vec<String> {
    let ran = site.adit("route", &[start, goal, "--robot", robot, "--json"]).expecting(0);
    let steps = ran.json()["steps"].as_array().unwrap().clone();
    steps.iter().map(|step| step["place"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn a_station_is_reached_by_the_node_that_costs_least() {
    let site = floors();
    assert_eq!(lanes(&site, "dock", "rack", "cart"), ["lane to near"]);
    assert_eq!(lanes(&site, "dock", "rack", "lorry"), ["lane to near"]);
    assert_eq!(lanes(&site, "rack", "roof", "cart"), ["lane up"], "and left from any");
    site.adit("close", &["lane to near"]).expect_status(0);
    assert_eq!(lanes(&site, "dock", "rack", "cart"), ["lane to far"]);
    let lorry = site.adit("route", &["dock", "rack", "--robot", "lorry"]);
    for reason in ["node far is not for lorry", "lane to near is closed"] {
        assert!(lorry.stdout.contains(reason), "{}", lorry.stdout);
    }
}

#[test]
fn a_node_is_for_the_vehicle_types_that_it_lists() {
    let site = floors();
    site.adit("route", &["dock", "far", "--robot", "cart"]).expect_status(0);
    let lorry = site.adit("route", &["dock", "far", "--robot", "lorry"]);
    assert!(lorry.stdout.contains("node far is not for lorry"), "{}", lorry.stdout);
}

#[test]
fn an_edge_to_another_layout_is_read_driven_written_and_read_again() {
    let site = floors();
    site.adit("route", &["dock", "roof", "--robot", "cart"]).expect_status(0);
    let to = site.path().join("again.lif.json");
    let ran = site.adit("export", &["--to", to.to_str().unwrap()]);
    ran.expect_status(0);
    let again = site_of(&to);
    again.adit("route", &["dock", "roof", "--robot", "cart"]).expect_status(0);
    assert_eq!(
        again.sqlite3("SELECT lane, from_node, to_node FROM lanes ORDER BY 1"),
        site.sqlite3("SELECT lane, from_node, to_node FROM lanes ORDER BY 1")
    );
}
