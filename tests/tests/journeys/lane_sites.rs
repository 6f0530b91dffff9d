//! Lane graphs of Open-RMF, Nav2, LIF and topological navigation as sites: built, routed, closed, asked, drawn, and written for
//! others.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

mod bad_files;
mod exported;
mod oracle;
mod ward;

use std::path::{Path, PathBuf};
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, shared};

/// The files of others, with the nodes and lanes that are in each.
const FILES: [(&str, usize, usize); 13] = [
    ("open-rmf/office.building.yaml", 31, 60),
    ("open-rmf/hotel.building.yaml", 0, 0),
    ("open-rmf/battle_royale.building.yaml", 20, 40),
    ("open-rmf/reroute_demo.building.yaml", 0, 0),
    ("open-rmf/door_madness.building.yaml", 0, 0),
    ("open-rmf/office.site.json", 0, 64),
    ("open-rmf/office_nav.yaml", 24, 48),
    ("nav2/aws_graph.geojson", 0, 84),
    ("nav2/depot_graph.geojson", 0, 78),
    ("nav2/sample_graph.geojson", 9, 12),
    ("nav2/turtlebot3_graph.geojson", 0, 65),
    ("lif/example.lif.json", 3, 2),
    ("topological_navigation/test.tmap2", 0, 0),
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
