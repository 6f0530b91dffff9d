//! What is written for others is read again with the same ids, names and weights, and written again to the byte.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use adit_tests::service::Service;
use adit_tests::{TestSite, repository};

use super::{FILES, file, site_of};

/// Nodes, lanes with their ends, names, and what a lane weighs, of those that any format has.
fn said(site: &TestSite) -> [Vec<String>; 2] {
    [
        site.sqlite3("SELECT node, ifnull(name, ''), level, round(x, 6), round(y, 6) FROM nodes ORDER BY 1"),
        site.sqlite3("SELECT lane, from_node, to_node FROM lanes ORDER BY 1"),
    ]
}

fn costs(site: &TestSite, robot: &str) -> BTreeMap<String, String> {
    let rows = site.sqlite3(&format!(
        "SELECT start || ' to ' || goal, round(cost, 6) FROM route WHERE robot = '{robot}'"
    ));
    rows.iter()
        .filter_map(|row| row.split_once('|'))
        .map(|(key, cost)| (key.to_owned(), cost.to_owned()))
        .collect()
}

fn export(site: &TestSite, name: &str, robot: Option<&str>) -> String {
    let to = exported(site, name);
    std::fs::create_dir_all(to.parent().unwrap()).unwrap();
    let mut args = vec!["--to", to.to_str().unwrap()];
    args.extend(robot.into_iter().flat_map(|robot| ["--robot", robot]));
    site.adit("export", &args).expect_status(0);
    std::fs::read_to_string(to).unwrap()
}

/// Beside the site's own files: its map may be called so.
fn exported(site: &TestSite, name: &str) -> PathBuf {
    site.path().join("exported").join(name)
}

fn again(site: &TestSite, name: &str) -> TestSite {
    site_of(&exported(site, name))
}

#[test]
fn all_files_are_written_for_nav2_and_read_again_with_ids_names_and_weights() {
    for (name, _, lanes) in FILES.into_iter().filter(|(_, _, lanes)| *lanes > 0) {
        let Some(map) = file(name) else { return };
        let site = site_of(&map);
        let robots = site.sqlite3("SELECT DISTINCT vehicle_type FROM vehicle_types ORDER BY 1");
        let robot = &robots[0];
        let text = export(&site, "graph.geojson", Some(robot));
        assert_eq!(
            text,
            export(&site, "graph.geojson", Some(robot)),
            "{name}: the same from export to export"
        );
        let other = again(&site, "graph.geojson");
        assert_eq!(text, export(&other, "graph.geojson", None), "{name}: and of what was read again");
        if robots.len() == 1 {
            assert_eq!(said(&other), said(&site), "{name}, {lanes} lanes");
        }
        let (before, after) = (costs(&site, robot), costs(&other, "robot"));
        let both = before.iter().filter(|(key, _)| after.contains_key(*key));
        assert!(both.clone().count() > 0 || before.is_empty(), "{name}");
        for (key, cost) in both {
            assert_eq!(&after[key], cost, "{name}: {key}");
        }
    }
}

#[test]
fn all_files_are_written_for_open_rmf_and_read_again() {
    for (name, ..) in FILES.into_iter().filter(|(name, _, lanes)| *lanes > 0 && !name.starts_with("lif")) {
        let Some(map) = file(name) else { return };
        let site = site_of(&map);
        let robots = site.sqlite3("SELECT DISTINCT vehicle_type FROM vehicle_types ORDER BY 1");
        let text = export(&site, "nav.yaml", Some(&robots[0]));
        let other = again(&site, "nav.yaml");
        assert_eq!(text, export(&other, "nav.yaml", None), "{name}: the same from export to export");
        if robots.len() == 1 {
            assert_eq!(said(&other), said(&site), "{name}");
            assert_eq!(costs(&other, "robot"), costs(&site, "robot"), "{name}");
        }
    }
}

#[test]
fn lif_is_written_for_all_vehicle_types_at_once() {
    for (name, ..) in FILES.into_iter().filter(|(.., lanes)| *lanes > 0) {
        let Some(map) = file(name) else { return };
        let site = site_of(&map);
        let text = export(&site, "site.lif.json", None);
        let other = again(&site, "site.lif.json");
        assert_eq!(text, export(&other, "site.lif.json", None), "{name}: the same from export to export");
        assert_eq!(said(&other), said(&site), "{name}");
    }
    let Some(map) = file("lif/example.lif.json") else { return };
    let site = site_of(&map);
    let read = |path: &Path| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
    };
    export(&site, "site.lif.json", None);
    assert_eq!(read(&exported(&site, "site.lif.json")), read(&map), "nothing of a LIF file is lost or added");
}

#[test]
fn the_service_says_how_far_a_lane_graph_reaches_and_moves_no_end_of_a_route() {
    let Some(map) = file("open-rmf/office.building.yaml") else { return };
    let site = site_of(&map);
    let service = Service::start(&site);
    let extent = site.sqlite3("SELECT min(x), min(y), max(x), max(y) FROM nodes").remove(0);
    let extent: Vec<f64> = extent.split('|').map(|number| number.parse().unwrap()).collect();
    for asked in ["/api/site", "/api/map"] {
        let bounds = service.ask("GET", asked, None).1["bounds"].clone();
        let bounds: Vec<f64> =
            bounds.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect();
        let is_within = |at: usize, is_least: bool| {
            if is_least { bounds[at] >= extent[at] } else { bounds[at] <= extent[at] }
        };
        assert!(
            is_within(0, true) && is_within(1, true) && is_within(2, false) && is_within(3, false),
            "{bounds:?}, {extent:?}"
        );
        assert!(bounds[0] > 2.0 && bounds[1] < -1.0 && bounds[2] > bounds[0] + 5.0, "{bounds:?}");
    }
    let (status, answer) = service.ask("GET", "/api/route?start=7,-5&goal=1000,-5&within=0.3", None);
    assert_eq!((status, &answer["error"]["code"]), (400, &serde_json::json!("course/unfit")), "{answer}");
}

#[test]
fn what_is_written_takes_the_place_of_no_file_of_the_site() {
    let Some(map) = file("open-rmf/office.building.yaml") else { return };
    let site = site_of(&map);
    let (path, before) = (site.path().join("office.building.yaml"), site.read("office.building.yaml"));
    let path = path.to_str().unwrap();
    site.adit("export", &["--to", path]).expecting(2).complains(&[
        "office.building.yaml is a file of which the site is made: it would be lost",
        "name another file",
    ]);
    assert_eq!(site.read("office.building.yaml"), before);
}

#[test]
fn what_rules_weigh_otherwise_is_written_for_nav2_and_counts_there() {
    let Some(map) = file("nav2/turtlebot3_graph.geojson") else { return };
    let site = site_of(&map);
    let lane = site.sqlite3("SELECT lane FROM lanes ORDER BY number LIMIT 1").remove(0);
    site.write(
        "rules/wet.rhai",
        format!("revise \"it is wet there\"\n    each travel in TRAVELS where travel.lane == \"{lane}\"\n    set travel.weight by * 3\n"),
    );
    site.adit("build", &[]).expect_status(0);
    let text: serde_json::Value = serde_json::from_str(&export(&site, "graph.geojson", None)).unwrap();
    let edges = text["features"].as_array().unwrap().iter().filter(|of| of["properties"]["startid"].is_u64());
    let fixed: Vec<_> = edges.filter(|of| of["properties"]["overridable"] == false).collect();
    assert_eq!(fixed.len(), 1);
    assert_eq!(fixed[0]["properties"]["id"].to_string(), lane);
    let to = site.path().join("graph.json");
    site.adit("export", &["--to", to.to_str().unwrap()])
        .expecting(2)
        .complains(&["neither .yaml, .geojson nor .lif.json"]);
}

#[test]
fn where_rules_do_not_let_a_robot_drive_is_not_written_for_it_and_told() {
    let Some(map) = file("nav2/turtlebot3_graph.geojson") else { return };
    let site = site_of(&map);
    let lane = site.sqlite3("SELECT lane FROM lanes ORDER BY number LIMIT 1").remove(0);
    site.write(
        "rules/stairs.rhai",
        format!("rule \"it cannot climb\" priority 50\n    each travel in TRAVELS where travel.lane == \"{lane}\"\n    then {{ travel.passable = false; travel.refusal = \"there are stairs\"; }}\n"),
    );
    site.adit("build", &[]).expect_status(0);
    let to = site.path().join("graph.geojson");
    let ran = site.adit("export", &["--to", to.to_str().unwrap()]).expecting(0);
    ran.complains(&["without 1 lane on which rules do not let robot drive: there are stairs"]);
    let text = std::fs::read_to_string(&to).unwrap();
    let text: serde_json::Value = serde_json::from_str(&text).unwrap();
    let ids = text["features"].as_array().unwrap().iter().filter(|of| of["properties"]["startid"].is_u64());
    let ids: Vec<String> = ids.map(|of| of["properties"]["id"].to_string()).collect();
    assert!(ids.len() > 10 && !ids.contains(&lane), "{ids:?}");
}

#[test]
fn what_is_written_is_the_same_whatever_somebody_closed() {
    let site = site_of(&repository().join("kb/worlds/ward.building.yaml"));
    let before = export(&site, "graph.geojson", None);
    for what in ["lift", "pharmacy_door", "lane 6", "node L1:0"] {
        site.adit("close", &[what]).expect_status(0);
        assert_eq!(export(&site, "graph.geojson", None), before, "{what} is closed");
    }
}
