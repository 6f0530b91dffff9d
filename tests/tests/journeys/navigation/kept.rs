//! A floor plan in the database of a site, and as a picture.

use super::flat::{flat, on, run, sql};

#[test]
fn regions_doorways_and_adits_are_there_by_sql() {
    let folder = flat();
    run(&folder, "build", &["--db", "flat.db"]).expect_status(0);
    let sql = |query: &str| sql(&folder, "flat.db", query);
    let area = "SELECT sum(area) FROM regions";
    let free: f64 = sql(area)[0].parse().expect("square metres");
    assert!((free - 138.0).abs() < 1e-6, "14 x 10 m without a corner cut off: {free}");
    // Twins lie on either side of one doorway.
    let twins = "SELECT count(*) FROM adits a JOIN adits b ON b.adit = a.twin
        WHERE NOT (b.twin = a.adit AND a.doorway = b.doorway AND a.region <> b.region)";
    assert_eq!(sql(twins), ["0"]);
    assert_eq!(sql("SELECT count(*) > 12 FROM adits"), ["1"]);
    assert_eq!(sql("SELECT count(*) FROM places"), ["7"]);
    assert_eq!(sql("SELECT count(*) FROM route WHERE status = 'ok'"), ["42"]);
}

#[test]
fn a_route_that_there_is_not_is_kept_with_the_reason() {
    let folder = flat();
    folder.edit("flat.toml", "radius = 0.25", "radius = 0.75");
    run(&folder, "route", &["bed", "bath", "--db", "flat.db"]).expect_status(1);
    let kept =
        "SELECT status, reason IS NOT NULL, cost IS NULL FROM route WHERE start = 'bed' AND goal = 'bath'";
    assert_eq!(sql(&folder, "flat.db", kept), ["no_route|1|1"]);
}

#[test]
fn the_picture_shows_regions_doorways_adits_places_and_the_path() {
    let folder = flat();
    let draw = |file: &str| on(&folder, "draw", "flat.toml", &["-o", file, "--route", "bed", "bath"]);
    draw("flat.svg").expect_status(0);
    let picture = folder.read("flat.svg");
    for group in ["regions", "doorways", "walls", "adits", "path", "places"] {
        assert!(picture.contains(&format!("<g id=\"{group}\">")), "{group}");
    }
    for place in ["bed", "living room", "bath"] {
        assert!(picture.contains(place), "{place}");
    }
    draw("flat.png").expect_status(0);
    assert!(std::fs::read(folder.path().join("flat.png")).expect("a picture").starts_with(b"\x89PNG"));
    draw("flat.gif").expect_status(2).complains(&["neither .svg nor .png"]);
}

#[test]
fn missions_on_a_site_are_kept_with_it_and_explained() {
    let folder = flat();
    let new = |site: &str| on(&folder, "new", site, &["--map", "flat.toml"]).expect_status(0);
    new("home");
    on(&folder, "build", "home", &[]).expect_status(0);
    on(&folder, "simulate", "home", &["bed", "desk", "--keep"]).expect_status(0);
    assert_eq!(
        sql(&folder, "home/site.db", "SELECT mission, ending, rules FROM missions")[0],
        "1|arrived|navigation"
    );
    let why = on(&folder, "why", "home", &["mission 1"]).expect_status(0).stdout;
    assert!(why.contains("it arrived"), "{why}");
    // what is tuned is what is driven on: a wall where there was a doorway
    let doorways = "SELECT x0, y0, x1, y1 FROM doorways";
    let all = sql(&folder, "home/site.db", doorways);
    for doorway in 0..all.len() {
        on(&folder, "close", "home", &[&format!("doorway {doorway}")]).expect_status(0);
    }
    let ends = on(&folder, "simulate", "home", &["bed", "bath", "--json"]).expect_status(0).json();
    // whether that is right, geometry alone does not say
    assert_eq!(
        (&ends[0]["ending"], &ends[0]["right"]),
        (&"no_way".into(), &serde_json::Value::Null),
        "{ends}"
    );
}
