//! A part that is taken out of another.

use serde_json::{Value, json};

use super::support::{SECTION_4, answer, expect_close, maps, on, route_of, rows_of, with_gap};

fn world(case: &Value, gap: &Value) -> String {
    let [x0, z0, x1, z1]: [f64; 4] = serde_json::from_value(case["male"].clone()).expect("a box");
    let male = json!([[x0, z0], [x0, z1], [x1, z1], [x1, z0]]);
    format!("[assembly]\nchannels = {}\nmale = {male}\ngap = {gap}\n", case["channels"])
}

#[test]
fn table_1_gives_the_verified_paths_for_every_case_and_gap() {
    let cases: Vec<Value> = serde_json::from_str(include_str!("table-1.json")).expect("the cases");
    for case in &cases {
        for wanted in case["results"].as_array().expect("results") {
            let name = format!("{} at gap {}", case["name"], wanted["gap"]);
            let map = maps().with("map.toml", &world(case, &wanted["gap"]));
            let ways =
                |start, goal| on(&map, &["route", "map.toml", start, goal, "--json"]).expect_status(0).json();
            let found = ways("assembled", "disassembled");
            expect_close(&name, &Value::Array(points(&found)), &wanted["waypoints"]);
            expect_close(&name, &found["distance"], &wanted["length"]);
            let mut rules = rows_of(&found, "Lee, Table 1");
            rules.push("exit".into());
            assert_eq!(Value::Array(rules), wanted["rules"], "{name}");
            // Those were looked for at 401 places of each leg; ours are the least of all places.
            let legs = found["waypoints"].as_array().expect("waypoints").iter().skip(1);
            let at_places = wanted["min_clearance_per_leg"].as_array().expect("numbers");
            for ((leg, at_places), step) in legs.zip(at_places).zip(found["steps"].as_array().expect("steps"))
            {
                let number = |value: &Value| value.as_f64().expect("a number");
                let above = number(at_places) - number(&leg["clearance"]);
                let between_places = number(&step["hardness"]) / 400.0;
                assert!((-1e-6..between_places).contains(&above), "{name}: {leg}, at places {at_places}");
            }
            let mut in_again = points(&ways("disassembled", "assembled"));
            in_again.reverse();
            assert_eq!(in_again, points(&found), "{name}: the way in is the way out reversed");
        }
    }
}

/// The waypoints as x, z, or x, y, z where a part moves in space.
fn points(route: &Value) -> Vec<Value> {
    let at = |at: &Value| json!([at["x"], at["z"]]);
    route["waypoints"].as_array().expect("waypoints").iter().map(at).collect()
}

#[test]
fn channels_are_found_in_the_outline_of_the_female_part() {
    let female = "[assembly]\ngap = 0.2\nmale = [[4.5, 1.01], [4.5, 4.0], [6.99, 4.0], [6.99, 1.01]]\n\
                  female = [[0, 0], [0, 7], [1, 7], [1, 2], [4, 2], [4, 1], [7, 1], [7, 6], [5, 6], [5, 7], [8, 7], [8, 0]]\n";
    assert_eq!(answer(female), answer(&with_gap(SECTION_4, "0.2")));
}

#[test]
fn the_shortest_gap_is_within_three_thousandths_of_the_shortest_translation() {
    // Corners (4, 2) and (2.51, 3.01) of the part's free space: 6.899.
    let length = answer(&with_gap(SECTION_4, "0.01"))["distance"].as_f64().expect("a length");
    assert!(length <= 6.899 * 1.003, "{length}");
}

#[test]
fn the_female_part_may_be_the_one_that_moves() {
    // Section 4: f1 goes from (14, 1) to (12, -6), which is the part displaced by (2, 7).
    let world = format!("{SECTION_4}gap = 0.2\nmoves = \"female\"\nbase = [14, 1]\ndisplacement = [2, 7]\n");
    let found = answer(&world);
    let female = points(&found);
    expect_close("assembled", &female[0], &json!([14, 1]));
    expect_close("disassembled", &female[female.len() - 1], &json!([12, -6]));
    // and the way of the part against it has that length, too
    expect_close("metres", &found["distance"], &answer(&world.replace("female", "male"))["distance"]);
    let mut clearances = found["waypoints"].as_array().expect("waypoints").iter().skip(1);
    assert!(clearances.all(|leg| leg["clearance"].as_f64() > Some(0.0)));
}

#[test]
fn a_gap_may_differ_by_axis_and_by_junction() {
    let each = answer(&with_gap(SECTION_4, "[0.1, 0.3]"));
    expect_close("by axis", &points(&each)[1], &json!([4.1, 2.3]));
    let one = format!("{SECTION_4}gap = 0.2\n[[assembly.junction]]\nnumber = 1\ngap = \"safest\"\n");
    let found = points(&answer(&one));
    expect_close("junction 2 as before", &found[1], &json!([4.2, 2.2]));
    expect_close("junction 1 safely", &found[2], &json!([1.755, 2.505]));
}

#[test]
fn rules_choose_between_short_and_safe_where_the_world_does_not() {
    let safe = answer(&format!("{SECTION_4}fragile = true\n"));
    assert_eq!(safe["waypoints"], answer(&with_gap(SECTION_4, "\"safest\""))["waypoints"]);
    let short = answer(&format!("{SECTION_4}hurry = true\n"));
    assert!(short["distance"].as_f64() < answer(&with_gap(SECTION_4, "0.2"))["distance"].as_f64());
}

#[test]
fn a_third_axis_is_a_matter_of_rules() {
    // Out of the pocket to the right, then to the back, then up: rules 9 to 16 know y.
    let world = "[assembly]\ngap = 0.5\nmale = [[7, 1, 1], [9, 3, 3]]\n\
                 channels = [[0, 6, 0, 4, 10, 12], [0, 0, 0, 4, 10, 4], [0, 0, 0, 10, 4, 4]]\n";
    let folder = maps().with("map.toml", world);
    for (place, rule) in [("junction 2", 10), ("junction 1", 8)] {
        let what = format!("{place} from assembled to disassembled");
        let why = on(&folder, &["why", "map.toml", &what]).expect_status(0).stdout;
        assert!(why.contains(&format!("rule is {rule}, by rule")), "{why}");
    }
    let found = answer(world);
    let points: Value = found["waypoints"]
        .as_array()
        .expect("waypoints")
        .iter()
        .map(|at| json!([at["x"], at["y"], at["z"]]))
        .collect();
    expect_close("waypoints", &points, &json!([[7, 1, 1], [1.5, 1.5, 1], [1.5, 6.5, 1.5], [1.5, 6.5, 12]]));
    let short = route_of(&world.replace("gap = 0.5", "gap = [0.5, 0.5, 1.5]"), &[]).expect_status(1);
    assert!(
        short.stdout.contains("the gap in z at junction 2 is 1.5, and at most 1 is possible"),
        "{}",
        short.stdout
    );
}
