//! A floor plan in a database and as a picture.

use crate::flat::{flat, run, sql};

#[test]
fn regions_doorways_adits_places_and_ways_are_there_by_sql() {
    let folder = flat();
    let found = run(&folder, "plan", &["bed", "bath", "--db", "flat.db", "--json"]).expect_status(0).json();
    let sql = |query: &str| sql(&folder, "flat.db", query);
    assert_eq!(sql("SELECT world, rules, radius, status FROM floor_plans"), ["flat|navigation|0.25|ok"]);
    let kept: f64 = sql("SELECT length FROM floor_plans")[0].parse().expect("metres");
    assert!((kept - found["length"].as_f64().expect("metres")).abs() < 1e-9, "{kept}");
    // Regions cover the free space: 14 x 10 m without a corner cut off.
    assert_eq!(
        sql("SELECT round(sum(area), 6) = round((SELECT area FROM floor_plans), 6) FROM floor_regions"),
        ["1"]
    );
    // Their outlines have those areas (the shoelace formula).
    let shoelace = "SELECT max(abs(area - twice / 2)) < 1e-6 FROM floor_regions JOIN (
        SELECT region, sum(x * next_y - next_x * y) AS twice FROM (
            SELECT region, x, y, coalesce(lead(x) OVER w, first_value(x) OVER w) AS next_x,
                   coalesce(lead(y) OVER w, first_value(y) OVER w) AS next_y
            FROM floor_corners WINDOW w AS (PARTITION BY region ORDER BY corner)) GROUP BY region) USING (region)";
    assert_eq!(sql(shoelace), ["1"]);
    // Twins lie in the two regions of their doorway.
    let twins = "SELECT count(*) FROM floor_adits a JOIN floor_adits b ON b.adit = a.twin JOIN floor_doorways d ON d.doorway = a.doorway
        WHERE NOT (a.twin <> a.adit AND b.twin = a.adit AND a.region IN (d.region1, d.region2) AND b.region IN (d.region1, d.region2) AND a.region <> b.region)";
    assert_eq!(sql(twins), ["0"]);
    assert_eq!(sql("SELECT count(*) > 12 FROM floor_adits"), ["1"]);
    assert_eq!(sql("SELECT count(*) FROM floor_places WHERE region IS NOT NULL"), ["7"]);
    // The shipped rules weigh a way its length.
    assert_eq!(sql("SELECT count(*) FROM floor_ways WHERE weight <> length OR weight IS NULL"), ["0"]);
    assert_eq!(
        sql("SELECT count(*) FROM floor_ways WHERE (from_adit IS NULL) = (from_place IS NULL)"),
        ["0"]
    );
    let points = found["waypoints"].as_array().expect("waypoints").len();
    assert_eq!(sql("SELECT count(*) FROM floor_waypoints"), [points.to_string()]);
    // Another path takes its place, and nothing of the old one is left.
    run(&folder, "plan", &["bed", "1.5,2.5", "--db", "flat.db"]).expect_status(0);
    assert_eq!(sql("SELECT count(*) FROM floor_waypoints"), ["2"]);
    assert_eq!(sql("SELECT count(*) FROM floor_plans"), ["1"]);
}

#[test]
fn a_plan_without_a_path_is_kept_with_the_reason() {
    let folder = flat();
    folder.edit("flat.toml", "radius = 0.25", "radius = 0.75");
    run(&folder, "plan", &["bed", "bath", "--db", "flat.db"]).expect_status(1);
    let kept = sql(&folder, "flat.db", "SELECT status, reason IS NOT NULL, length IS NULL FROM floor_plans");
    assert_eq!(kept, ["no_path|1|1"]);
}

#[test]
fn the_picture_shows_regions_doorways_adits_places_and_the_path() {
    let folder = flat();
    run(&folder, "plan", &["bed", "bath", "-o", "flat.svg"]).expect_status(0);
    let picture = folder.read("flat.svg");
    for group in ["regions", "doorways", "walls", "adits", "path", "places"] {
        assert!(picture.contains(&format!("<g id=\"{group}\">")), "{group}");
    }
    for place in ["bed", "living room", "flat: bed to bath"] {
        assert!(picture.contains(place), "{place}");
    }
    run(&folder, "plan", &["bed", "bath", "-o", "flat.png"]).expect_status(0);
    assert!(std::fs::read(folder.path().join("flat.png")).expect("a picture").starts_with(b"\x89PNG"));
    run(&folder, "plan", &["bed", "bath", "-o", "flat.gif"])
        .expect_status(2)
        .complains(&["neither .svg nor .png"]);
}
