//! The database of a site is a GeoPackage: GDAL, by which QGIS reads and writes, shows its layers and draws areas into one; DuckDB
//! reads its views; and a layer is a file of GeoJSON.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, repository};
use serde_json::{Value, json};

/// The Python that has GDAL and DuckDB (`tests/run` makes it, too).
fn python() -> &'static PathBuf {
    static PYTHON: OnceLock<PathBuf> = OnceLock::new();
    PYTHON.get_or_init(|| {
        let exe = std::env::current_exe().unwrap();
        let folder = exe.ancestors().nth(3).unwrap().join("geodata");
        let pip = folder.join("bin/pip");
        if !folder.join("whole").exists() {
            let venv = Command::new("python3").args(["-m", "venv"]).arg(&folder).status();
            assert!(venv.expect("python3 is installed").success());
            let packages = ["pyogrio==0.13.0", "duckdb==1.5.5", "duckdb-extension-sqlite-scanner==1.5.5"];
            assert!(
                Command::new(pip).args(["install", "--quiet"]).args(packages).status().unwrap().success()
            );
            std::fs::write(folder.join("whole"), "").unwrap();
        }
        folder.join("bin/python")
    })
}

/// A script of this folder, at work on the database of a site.
fn script(name: &str, site: &TestSite, args: &[&str]) -> Child {
    let mut python = Command::new(python());
    python.arg(repository().join("tests/tests/journeys/geodata").join(name));
    python.arg(site.path().join("site.db")).args(args).stdout(Stdio::piped()).stderr(Stdio::piped());
    python.spawn().unwrap()
}

#[track_caller]
fn done(script: Child) -> Ran {
    Ran::new(&script.wait_with_output().unwrap()).expecting(0)
}

/// What GDAL says of each edit of the layer `drawn`.
#[track_caller]
fn draw(site: &TestSite, edits: &[Value]) -> Vec<String> {
    let edits: Vec<String> = edits.iter().map(Value::to_string).collect();
    let edits: Vec<&str> = edits.iter().map(String::as_str).collect();
    done(script("draw.py", site, &edits)).stdout.lines().map(str::to_owned).collect()
}

fn starter() -> TestSite {
    TestSite::example("starter").with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n").built()
}

fn cost(site: &TestSite) -> Option<f64> {
    site.adit("route", &["home", "window", "--json"]).json()["cost"].as_f64()
}

/// Routes that lead from one point to another.
const LINES: &str = "(SELECT 1 FROM waypoints GROUP BY robot, start, goal HAVING count(*) > 1)";

fn count(site: &TestSite, of: &str) -> Value {
    json!(site.sqlite3(&format!("SELECT count(*) FROM {of}"))[0].parse::<u64>().unwrap())
}

#[test]
fn gdal_and_duckdb_read_all_layers_and_views_while_the_site_is_tuned() {
    let site = starter();
    site.adit("lay", &["area", "spill", "7,1 8,2", "--kind", "wet"]).expect_status(0);
    done(script("duck.py", &site, &["1"]));
    let mut readers = vec![script("layers.py", &site, &["3"]), script("duck.py", &site, &["2"])];
    let mut edits = 0;
    while edits < 2 || readers.iter_mut().any(|reader| reader.try_wait().unwrap().is_none()) {
        let hardness = (3 + edits % 5).to_string();
        let tuned = site.adit("tune", &["robots", "SQUAT", "hardness", &hardness]);
        if tuned.status != 0 {
            // a long read keeps writers waiting, and who waited too long says so and may try again
            tuned.complains(&["is locked by another program"]);
            continue;
        }
        edits += 1;
    }
    let duck = done(readers.pop().unwrap()).json();
    assert_eq!(duck["routes"], count(&site, "routes"));
    done(readers.pop().unwrap());
    let layers = done(script("layers.py", &site, &["1"])).json();
    for (layer, kind, rows) in [
        ("map_rooms", "Polygon", "rooms"),
        ("map_spaces", "Polygon", "spaces"),
        ("map_doorways", "LineString", "doorways"),
        ("map_areas", "Polygon", "laid"),
        ("map_routes", "LineString", LINES),
        ("drawn", "Polygon", "laid"),
    ] {
        let expected = json!({"kind": kind, "features": count(&site, rows), "different": 0});
        assert_eq!(layers[layer], expected, "{layer}: to the bit, the corners are those of the rows");
    }
}

#[test]
fn routes_as_a_layer_ask_of_each_route_its_own_waypoints() {
    let plan = starter().sqlite3("EXPLAIN QUERY PLAN SELECT * FROM map_routes");
    assert!(
        plan.iter().any(|line| line.contains("tree_rows") || line.contains("SEARCH g USING PRIMARY KEY")),
        "{plan:?}"
    );
    // an index that is made for the query holds the waypoints of all routes
    let all = plan.iter().find(|line| line.contains("AUTOMATIC") || line.contains("SCAN course_waypoints"));
    assert_eq!(all, None, "{plan:?}");
}

#[test]
fn what_is_drawn_in_a_geographic_program_is_laid_moved_and_lifted() {
    let site = starter();
    let free = cost(&site).unwrap();
    let keep_out = |wkt: &str| json!({"wkt": wkt, "fields": {"name": "shelves", "kind": "keep-out"}});
    let across = "POLYGON ((6.2 2.5, 6.4 2.5, 6.4 4.5, 6.2 4.5, 6.2 2.5))";
    assert_eq!(draw(&site, &[keep_out(across)]), [""]);
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'home' AND goal = 'window'"), ["stale"]);
    assert_eq!(cost(&site), None, "the doorway is kept out of");
    assert_eq!(
        site.sqlite3("SELECT name, what, kind, outline FROM laid"),
        ["shelves|area|keep-out|[[6.2,2.5],[6.4,2.5],[6.4,4.5],[6.2,4.5]]"]
    );
    let aside = json!({"was": "shelves", "wkt": "POLYGON ((7 0.5, 7.5 0.5, 7.5 1, 7 0.5))"});
    assert_eq!(draw(&site, &[aside]), [""]);
    assert!(cost(&site).is_some(), "it was moved out of the way");
    assert_eq!(draw(&site, &[json!({"gone": "shelves"})]), [""]);
    assert_eq!((cost(&site), count(&site, "laid")), (Some(free), json!(0)));
    // what has no name is named, and more can be said of it
    let wet = json!({"wkt": "POLYGON ((6.5 0.1, 9 0.1, 9 7.9, 6.5 7.9, 6.5 0.1))",
        "fields": {"properties": "{\"hardness_factor\": 3}", "until": "2100-01-01T00:00:00Z"}});
    assert_eq!(draw(&site, &[wet]), [""]);
    assert!(cost(&site).unwrap() > free + 2.0);
    let name = site.sqlite3("SELECT name FROM laid");
    assert!(name[0].starts_with("area "), "{name:?}");
    site.adit("lift", &[&name[0]]).expect_status(0);
    assert_eq!((cost(&site), count(&site, "drawn")), (Some(free), json!(0)));
}

#[test]
fn what_is_laid_by_a_command_is_drawn_and_taken_back_by_undo_with_its_shape() {
    let site = starter();
    site.adit("lay", &["obstacle", "crate", "1,1 1.5,1.5", "--why", "delivery"]).expect_status(0);
    let drawn = || site.sqlite3("SELECT name, what, why, outline FROM drawn JOIN drawn_outlines USING (fid)");
    let crate_drawn = ["crate|obstacle|delivery|[[1.0,1.0],[1.5,1.0],[1.5,1.5],[1.0,1.5]]"];
    assert_eq!(drawn(), crate_drawn);
    site.adit("lift", &["crate"]).expect_status(0);
    assert!(drawn().is_empty());
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(drawn(), crate_drawn);
}

#[test]
fn corners_keep_each_bit_and_their_sign_on_the_way_to_a_shape_and_back() {
    let site = starter();
    let corners = "[[-1.5,0.1],[1.0e-17,123456.78901234567],[3.0,-0.30000000000000004],[0.0,-1000000.0]]";
    site.outside_edit(&format!("INSERT INTO laid (name, what, outline) VALUES ('far', 'area', '{corners}')"));
    assert_eq!(site.sqlite3("SELECT outline FROM drawn_outlines"), [corners]);
}

#[test]
fn what_cannot_be_laid_is_refused_in_words_when_it_is_drawn_or_built() {
    let site = starter();
    let shape = |wkt: &str, name: &str| json!({"wkt": wkt, "fields": {"name": name}});
    let square = "POLYGON ((1 1, 2 1, 2 2, 1 2, 1 1))";
    let said = draw(
        &site,
        &[
            shape("POLYGON ((1 1, 5 1, 5 5, 1 5, 1 1), (2 2, 3 2, 3 3, 2 2))", "ring"),
            shape("POLYGON EMPTY", "nothing"),
            shape(square, ""),
            json!({"wkt": square, "fields": {"name": "wet", "properties": "slippery"}}),
            json!({"wkt": square, "fields": {"name": "wet", "what": "castle"}}),
            json!({"wkt": square, "fields": {"name": "wet", "until": "tomorrow"}}),
            shape(square, "wet"),
            shape(square, "wet"),
            shape("POLYGON ((1 1, 3 3, 3 1, 1 3, 1 1))", "bow"),
        ],
    );
    for (said, expected) in said.iter().zip([
        "one polygon without holes",
        "one polygon without holes",
        "name must not be empty",
        "properties must be a JSON object",
        "what must be area, obstacle, place, bridge or door",
        "until must be a time in UTC",
        "",
        "UNIQUE constraint failed: drawn.name",
        "",
    ]) {
        assert!(said.contains(expected) && said.is_empty() == expected.is_empty(), "{said}, not {expected}");
    }
    assert_eq!(
        site.sqlite3("SELECT name FROM laid ORDER BY name"),
        ["bow", "wet"],
        "what was refused is not there"
    );
    let built = site.adit("build", &[]).expecting(0);
    let said = format!("{}{}", built.stdout, built.stderr);
    assert!(said.contains("the area `bow`, laid over the map, counts for nothing"), "{said}");
    assert!(said.contains("crosses itself"), "{said}");
    assert_eq!(site.sqlite3("SELECT name FROM map_areas"), ["wet"]);
}

#[test]
fn a_service_follows_what_is_drawn() {
    let site = starter();
    let service = Service::start(&site);
    let status = || service.ask("GET", "/api/route?start=home&goal=window", None).1["status"].clone();
    assert_eq!(status(), "ok");
    let across = "POLYGON ((6.2 2.5, 6.4 2.5, 6.4 4.5, 6.2 4.5, 6.2 2.5))";
    assert_eq!(draw(&site, &[json!({"wkt": across, "fields": {"kind": "keep-out"}})]), [""]);
    let began = Instant::now();
    while status() == "ok" {
        assert!(began.elapsed() < Duration::from_secs(30), "it did not follow");
        std::thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(status(), "no_route");
}

#[test]
fn a_layer_is_written_as_geojson() {
    let site = starter();
    let heading = ["--with", "heading=90"];
    site.adit("lay", &[&["area", "spill", "1,1 2,1 2,2.5", "--kind", "wet"][..], &heading].concat())
        .expect_status(0);
    let file = site.path().join("layer.geojson");
    let export = |layer: &str| {
        site.adit("export", &[layer, "--to", file.to_str().unwrap()]).expect_status(0);
        serde_json::from_str::<Value>(&site.read("layer.geojson")).unwrap()
    };
    assert_eq!(
        export("areas"),
        json!({"type": "FeatureCollection", "name": "areas", "features": [{"type": "Feature",
            "geometry": {"type": "Polygon", "coordinates": [[[1.0, 1.0], [2.0, 1.0], [2.0, 2.5], [1.0, 1.0]]]},
            "properties": {"name": "spill", "kind": "wet", "heading": 90.0}}]})
    );
    for (layer, kind, rows) in [
        ("rooms", "Polygon", "rooms"),
        ("map_spaces", "Polygon", "spaces"),
        ("doorways", "LineString", "doorways"),
        ("routes", "LineString", LINES),
    ] {
        let features = export(layer)["features"].as_array().unwrap().clone();
        assert_eq!(json!(features.len()), count(&site, rows), "{layer}");
        assert!(features.iter().all(|feature| feature["geometry"]["type"] == kind), "{layer}");
    }
    site.adit("export", &["spaced", "--to", "x.geojson"])
        .expecting(2)
        .complains(&["no layer `spaced`", "did you mean `spaces`?"]);
    site.adit("export", &["rooms", "--to", "x.shp"])
        .expecting(2)
        .complains(&["x.shp is neither .geojson nor .json"]);
}
