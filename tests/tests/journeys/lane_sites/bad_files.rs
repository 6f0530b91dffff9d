//! Files that are cut, of wrong types, with ids that lead nowhere, or numbers beyond all measure: each is refused with the file,
//! the place, what was found and what was expected.

use std::process::Command;

use adit_tests::{Ran, TestSite, adit};

const NODE: &str =
    r#"{"type":"Feature","properties":{"id":1},"geometry":{"type":"Point","coordinates":[0,0]}}"#;

fn route_graph(features: &str) -> String {
    format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#)
}

fn edge(properties: &str) -> String {
    let line = r#"{"type":"MultiLineString","coordinates":[[[0,0],[1,0]]]}"#;
    route_graph(&format!(r#"{NODE},{{"type":"Feature","properties":{properties},"geometry":{line}}}"#))
}

#[test]
fn a_file_that_cannot_be_is_refused_in_a_sentence() {
    let meta = r#""metaInformation":{"projectIdentification":"p","creator":"c","exportTimestamp":"t","lifVersion":"1.0.0"}"#;
    let levels = |level: &str| format!("levels:\n  L1:\n{level}");
    let cases: Vec<(&str, String, Vec<&str>)> = vec![
        ("cut.geojson", route_graph(NODE)[..60].to_owned(), vec!["cut.geojson:1:60", "not JSON"]),
        ("list.geojson", "[]".to_owned(), vec!["list.geojson", "expected an object"]),
        ("deep.geojson", "[".repeat(100_000), vec!["deep.geojson", "recursion"]),
        ("other.json", r#"{"a":1}"#.to_owned(), vec!["is no lane graph that Adit reads", "a route graph of Nav2 `features`"]),
        (
            "dangling.geojson",
            edge(r#"{"id":2,"startid":1,"endid":7}"#),
            vec!["dangling.geojson:1:", "lane `2` from `1` to `7`: there is no node `7`"],
        ),
        (
            "no-end.geojson",
            edge(r#"{"id":2,"startid":1}"#),
            vec!["features[1].properties has no `endid`"],
        ),
        (
            "twice.geojson",
            route_graph(&format!("{NODE},{NODE}")),
            vec!["twice.geojson:1:", "two nodes are called `1`; expected an id for each"],
        ),
        (
            "huge.geojson",
            route_graph(&NODE.replace("[0,0]", "[1e300,0]")),
            vec!["features[0].geometry.coordinates[0] is 1e300, expected at most 1e9"],
        ),
        (
            "text.geojson",
            route_graph(&NODE.replace("[0,0]", "[\"a\",0]")),
            vec!["coordinates[0] is the text \"a\", expected a number"],
        ),
        (
            "cost.geojson",
            edge(r#"{"id":2,"startid":1,"endid":7,"cost":-3}"#),
            vec!["features[1].properties.cost is -3, expected 0 or more"],
        ),
        (
            "fast.geojson",
            edge(r#"{"id":2,"startid":1,"endid":7,"metadata":{"speed_limit":850}}"#),
            vec!["speed_limit is 850, expected a part of the speed up to 1, or up to 100 %"],
        ),
        (
            "cut.building.yaml",
            levels("    vertices:\n      - [0, 0, 0, \"a\"\n"),
            vec!["cut.building.yaml:", "not YAML"],
        ),
        (
            "vertex.building.yaml",
            levels("    vertices:\n      - [0, 0, 0, \"\"]\n    lanes:\n      - [0, 9, {}]\n"),
            vec!["levels.L1.lanes[0][1] is 9, and the number of vertices is 1, counted from 0"],
        ),
        (
            "typed.building.yaml",
            levels("    vertices:\n      - [0, 0, 0, \"\"]\n      - [1, 0, 0, \"\"]\n    lanes:\n      - [0, 1, {bidirectional: 1}]\n"),
            vec!["levels.L1.lanes[0][2].bidirectional is 1, expected a list"],
        ),
        (
            "scale.building.yaml",
            levels("    vertices:\n      - [0, 0, 0, \"\"]\n      - [0, 0, 0, \"\"]\n    measurements:\n      - [0, 1, {distance: [3, 4]}]\n"),
            vec!["is measured between two vertices at one point"],
        ),
        (
            "anchor.site.json",
            r#"{"format_version":"0.1","levels":{"1":{"properties":{"name":"L1"},"anchors":{},"walls":{"5":{"anchors":[8,9]}}}}}"#.to_owned(),
            vec!["levels.1.walls.5.anchors[0] is 8, and there is no anchor of this number"],
        ),
        (
            "version.lif.json",
            format!(r#"{{{},"layouts":[]}}"#, meta.replace("1.0.0", "9.0.0")),
            vec!["metaInformation.lifVersion is the text \"9.0.0\", expected a version of LIF up to 2"],
        ),
        (
            "station.lif.json",
            format!(
                r#"{{{meta},"layouts":[{{"layoutId":"l","layoutVersion":"1","nodes":[],"edges":[],"stations":[{{"stationId":"s","interactionNodeIds":["n"]}}]}}]}}"#
            ),
            vec!["station `s`: there is no node `n`"],
        ),
        (
            "no-name.tmap2",
            "name: m\nnodes:\n- node: {pose: {position: {x: 0, y: 0}}}\n".to_owned(),
            vec!["nodes[0].node has no `name`"],
        ),
    ];
    let site = TestSite::empty();
    for (name, text, words) in cases {
        site.write(name, &text);
        let route =
            Command::new(adit()).arg("route").arg(site.path().join(name)).args(["1", "7"]).output().unwrap();
        Ran::new(&route).expecting(2).complains(&words);
        let folder = site.path().join("new");
        let new =
            Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(site.path().join(name)).output();
        Ran::new(&new.unwrap()).expecting(2).complains(&words);
        assert!(!folder.exists(), "{name}: nothing half-made is left");
    }
}

/// Words that are close to those that are read, and lines that lie elsewhere than their nodes.
#[test]
fn what_a_file_says_by_mistake_is_noted() {
    const TWO: &str =
        r#"{"type":"Feature","properties":{"id":2},"geometry":{"type":"Point","coordinates":[5,0]}}"#;
    let graph = |line: &str, metadata: &str| {
        let edge = format!(
            r#"{{"type":"Feature","properties":{{"id":7,"startid":1,"endid":2,"metadata":{metadata}}},"geometry":{{"type":"MultiLineString","coordinates":{line}}}}}"#
        );
        route_graph(&format!("{NODE},{TWO},{edge}"))
    };
    let straight = "[[[0,0],[5,0]]]";
    let building = "levels:\n  L1:\n    vertices: [[0, 0, 0, a], [9, 0, 0, b]]\n    lane: [[0, 1, {}]]\n    x_meters: 9\n    y_meters: 9\n";
    let cases = [
        (
            "elsewhere.geojson",
            graph("[[[100,100],[50,0]]]", "{}"),
            "far from their nodes, so that they count as straight: 1",
        ),
        (
            "word.geojson",
            graph(straight, r#"{"sped_limit":50}"#),
            "`sped_limit`, which stands there once, is not read; did you mean `speed_limit`?",
        ),
        ("look.geojson", graph(straight, r#"{"orientation":"forwrd"}"#), "look `forwrd`, which is neither"),
        ("empty.geojson", route_graph(NODE), "the file has no lanes"),
        ("list.building.yaml", building.to_owned(), "`lane` of level L1 is not read; did you mean `lanes`?"),
    ];
    let site = TestSite::empty();
    for (name, text, note) in cases {
        site.write(name, &text);
        let folder = site.path().join("new");
        let new =
            Command::new(adit()).arg("new").arg(&folder).arg("--map").arg(site.path().join(name)).output();
        Ran::new(&new.unwrap()).expect_status(0);
        let built = Ran::new(&Command::new(adit()).arg("build").arg(&folder).output().unwrap()).expecting(0);
        assert!(built.stderr.replace("\n  ", " ").contains(note), "{name}: {}", built.stderr);
        std::fs::remove_dir_all(folder).unwrap();
    }
    site.write("type.geojson", route_graph(NODE).replace("FeatureCollection", "FeatureColection"));
    let read = Command::new(adit()).arg("build").arg(site.path().join("type.geojson")).output().unwrap();
    Ran::new(&read).expecting(2).complains(&["type.geojson:1:", "expected `FeatureCollection`"]);
}

#[test]
fn wherever_a_file_is_cut_there_is_no_panic() {
    let Some(map) = super::file("lif/example.lif.json") else { return };
    let (site, text) = (TestSite::empty(), std::fs::read_to_string(map).unwrap());
    for part in 1..12 {
        site.write("cut.lif.json", &text[..text.len() * part / 12]);
        let map = site.path().join("cut.lif.json");
        let ran =
            Command::new(adit()).arg("draw").arg(map).arg("-o").arg(site.path().join("cut.svg")).output();
        Ran::new(&ran.unwrap()).expecting(2).complains(&["cut.lif.json:", "not JSON"]);
    }
}
