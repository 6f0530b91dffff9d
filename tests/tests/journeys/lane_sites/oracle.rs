//! What routes cost is what Floyd and Warshall's algorithm makes of the files themselves, read by nobody but the test.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{file, site_of};

/// The least lengths between all nodes of a route graph of Nav2 by straight lanes.
fn least(graph: &Value) -> BTreeMap<(u64, u64), f64> {
    let features = graph["features"].as_array().unwrap();
    let mut at = BTreeMap::new();
    for feature in features.iter().filter(|feature| feature["geometry"]["type"] == "Point") {
        let place = &feature["geometry"]["coordinates"];
        at.insert(
            feature["properties"]["id"].as_u64().unwrap(),
            [place[0].as_f64().unwrap(), place[1].as_f64().unwrap()],
        );
    }
    let mut least: BTreeMap<(u64, u64), f64> = at.keys().map(|node| ((*node, *node), 0.0)).collect();
    for feature in features.iter().filter(|feature| feature["properties"]["startid"].is_u64()) {
        let end = |key: &str| feature["properties"][key].as_u64().unwrap();
        let (from, to) = (end("startid"), end("endid"));
        let length = (at[&from][0] - at[&to][0]).hypot(at[&from][1] - at[&to][1]);
        let known = least.entry((from, to)).or_insert(f64::INFINITY);
        *known = known.min(length);
    }
    for via in at.keys() {
        for from in at.keys() {
            for to in at.keys() {
                let legs = least.get(&(*from, *via)).zip(least.get(&(*via, *to)));
                let Some(sum) = legs.map(|(one, other)| one + other) else { continue };
                let known = least.entry((*from, *to)).or_insert(f64::INFINITY);
                *known = known.min(sum);
            }
        }
    }
    least
}

#[test]
fn all_routes_over_nav2s_graphs_are_the_shortest() {
    for name in ["turtlebot3_graph", "depot_graph", "aws_graph"] {
        let Some(map) = file(&format!("nav2/{name}.geojson")) else { return };
        let graph: Value = serde_json::from_str(&std::fs::read_to_string(&map).unwrap()).unwrap();
        let least = least(&graph);
        let site = site_of(&map);
        let rows = site.sqlite3("SELECT start, goal, status, ifnull(cost, -1) FROM route");
        assert!(rows.len() > 300, "{name}: {} routes", rows.len());
        for row in rows {
            let [start, goal, status, cost] = row.split('|').collect::<Vec<_>>()[..] else { panic!("{row}") };
            let known = least.get(&(start.parse().unwrap(), goal.parse().unwrap()));
            match known {
                Some(length) => {
                    let cost: f64 = cost.parse().unwrap();
                    assert!((cost - length).abs() < 1e-6, "{name}, {row}: expected {length}");
                }
                None => assert_eq!(status, "no_route", "{name}, {row}"),
            }
        }
    }
}

#[test]
fn one_building_lies_in_the_same_place_in_both_of_open_rmfs_formats() {
    let (Some(building), Some(newer)) =
        (file("open-rmf/office.building.yaml"), file("open-rmf/office.site.json"))
    else {
        return;
    };
    let places = |map| {
        let rows = site_of(map).sqlite3("SELECT place, x, y FROM places");
        let place = |row: &String| {
            let [name, x, y] = row.split('|').collect::<Vec<_>>()[..] else { panic!("{row}") };
            (name.to_owned(), [x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap()])
        };
        rows.iter().map(place).collect::<BTreeMap<_, _>>()
    };
    let (one, other) = (places(&building), places(&newer));
    let both: Vec<&String> = one.keys().filter(|name| other.contains_key(*name)).collect();
    assert!(both.len() >= 6, "{one:?} {other:?}");
    let off = |name: &String| {
        let [a, b] = [one[name], other[name]];
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    // the one was drawn on after the other was made of it, so that two were moved since
    assert!(both.iter().filter(|name| off(name) < 1e-3).count() >= 5, "{one:?} {other:?}");
    assert!(both.iter().all(|name| off(name) < 1.0), "{one:?} {other:?}");
}
