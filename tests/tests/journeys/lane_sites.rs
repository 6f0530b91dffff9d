//! Lane graphs of Open-RMF, Nav2, LIF and topological navigation as sites: built, routed, closed, asked, drawn, and written for
//! others.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

mod bad_files;
mod exported;
mod oracle;
mod stations;
mod ward;

use std::path::{Path, PathBuf};
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, shared};

/// The files of others, with the nodes and lanes that are in each.
const FILES: [(&str, usize, usize); 13] = [
    ("open-rmf/office.building.yaml", 29, 60),
    ("open-rmf/hotel.building.yaml", 75, 268),
    ("open-rmf/battle_royale.building.yaml", 21, 40),
    ("open-rmf/reroute_demo.building.yaml", 14, 52),
    ("open-rmf/door_madness.building.yaml", 0, 0),
    ("open-rmf/office.site.json", 29, 64),
    ("open-rmf/office_nav.yaml", 24, 54),
    ("nav2/aws_graph.geojson", 40, 84),
    ("nav2/depot_graph.geojson", 34, 78),
    ("nav2/sample_graph.geojson", 9, 24),
    ("nav2/turtlebot3_graph.geojson", 20, 65),
    ("lif/example.lif.json", 3, 2),
    ("topological_navigation/test.tmap2", 2, 2),
];

/// A site of a file, as `adit new --map` makes it, built.
fn site_of(map: &Path) -> TestSite {
    let site = TestSite::empty();
    let folder = site.path().join("new");
    let made = Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(map).output().unwrap();
    Ran::new(&made).expect_status(0);
    let name = map.file_name().unwrap().to_str().unwrap();
    for file in ["site.toml", "rules/own.rhai", name] {
        site.write(file, std::fs::read(folder.join(file)).unwrap());
    }
    std::fs::remove_dir_all(folder).unwrap();
    site.built()
}

fn file(name: &str) -> Option<PathBuf> {
    shared(&format!("data/{name}"))
}

#[test]
fn every_file_of_others_is_built_drawn_and_routed() {
    for (name, nodes, lanes) in FILES {
        let Some(map) = file(name) else { return };
        let site = site_of(&map);
        let counted = site.sqlite3("SELECT count(*) FROM nodes; SELECT count(*) FROM lanes");
        assert_eq!(counted, [nodes.to_string(), lanes.to_string()], "{name}");
        let picture = site.path().join("map.svg");
        site.adit("draw", &["-o", picture.to_str().unwrap()]).expect_status(0);
        // one of them has walls and doors alone
        assert!(std::fs::metadata(&picture).unwrap().len() > 1000, "{name}");
        let ways = site
            .sqlite3("SELECT robot, start, goal FROM route WHERE status = 'ok' ORDER BY cost DESC LIMIT 1");
        let Some(way) = ways.first() else {
            assert_eq!(lanes, 0, "{name} has lanes, and no route");
            continue;
        };
        let [robot, start, goal] = way.split('|').collect::<Vec<_>>()[..] else { panic!("{way}") };
        let sum = site.sqlite3(
            "SELECT count(*) FROM route JOIN (SELECT robot, start, goal, sum(hardness) AS cost, count(*) AS steps \
             FROM action_sequence GROUP BY 1, 2, 3) AS s USING (robot, start, goal) \
             WHERE abs(s.cost - route.cost) > 1e-6 OR s.steps <> route.steps",
        );
        assert_eq!(sum, ["0"], "{name}: what steps weigh adds up");
        // the file alone answers the same
        let ran = Command::new(adit())
            .arg("route")
            .arg(&map)
            .args([start, goal, "--robot", robot, "--json"])
            .output();
        let alone = Ran::new(&ran.unwrap()).expecting(0).json();
        let of_site = site.adit("route", &[start, goal, "--robot", robot, "--json"]).expecting(0).json();
        assert_eq!(alone["steps"], of_site["steps"], "{name}");
        let png = site.path().join("map.png");
        let route = ["-o", png.to_str().unwrap(), "--route", start, goal, "--robot", robot];
        site.adit("draw", &route).expect_status(0);
    }
}
