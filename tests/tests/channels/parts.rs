//! A part that is taken out of another.

use serde_json::{Value, json};

use super::support::{SECTION_4, answer, expect_close, plan_text};

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
            let found = answer(&world(case, &wanted["gap"]), &[]);
            let legs = found["legs"].as_array().expect("legs");
            let of_legs = |key: &str| -> Value { legs.iter().map(|leg| leg[key].clone()).collect() };
            let moves: Value = legs.iter().map(|leg| json!([leg["mdx"], leg["mdz"]])).collect();
            expect_close(&name, &found["waypoints"], &wanted["waypoints"]);
            expect_close(&name, &found["length"], &wanted["length"]);
            expect_close(&name, &of_legs("rule"), &wanted["rules"]);
            expect_close(&name, &moves, &wanted["moves"]);
            expect_close(&name, &found["clearances"], &wanted["clearance_at_waypoints"]);
            // Those were looked for at 401 places of each leg; ours are the least of all places.
            for (leg, at_places) in
                legs.iter().zip(wanted["min_clearance_per_leg"].as_array().expect("numbers"))
            {
                let number = |value: &Value| value.as_f64().expect("a number");
                let above = number(at_places) - number(&leg["min_clearance"]);
                let between_places = number(&leg["mdx"]).hypot(number(&leg["mdz"])) / 400.0;
                assert!((-1e-6..between_places).contains(&above), "{name}: {leg}, at places {at_places}");
            }
            let mut backwards = found["waypoints"].as_array().expect("waypoints").clone();
            backwards.reverse();
            assert_eq!(
                found["assembly"],
                Value::Array(backwards),
                "{name}: the way in is the way out reversed"
            );
        }
    }
}

#[test]
fn channels_are_found_in_the_outline_of_the_female_part() {
    let female = "[assembly]\ngap = 0.2\nmale = [[4.5, 1.01], [4.5, 4.0], [6.99, 4.0], [6.99, 1.01]]\n\
                  female = [[0, 0], [0, 7], [1, 7], [1, 2], [4, 2], [4, 1], [7, 1], [7, 6], [5, 6], [5, 7], [8, 7], [8, 0]]\n";
    assert_eq!(answer(female, &[]), answer(SECTION_4, &["--gap", "0.2"]));
}

#[test]
fn the_shortest_gap_is_within_three_thousandths_of_the_shortest_translation() {
    // Corners (4, 2) and (2.51, 3.01) of the part's free space: 6.899.
    let length = answer(SECTION_4, &["--gap", "0.01"])["length"].as_f64().expect("a length");
    assert!(length <= 6.899 * 1.003, "{length}");
}

#[test]
fn the_female_part_may_be_the_one_that_moves() {
    // Section 4: f1 goes from (14, 1) to (12, -6), which is the part displaced by (2, 7).
    let world = format!("{SECTION_4}gap = 0.2\nmoves = \"female\"\nbase = [14, 1]\ndisplacement = [2, 7]\n");
    let found = answer(&world, &[]);
    let female = found["female"].as_array().expect("waypoints");
    expect_close("assembled", &female[0], &json!([14, 1]));
    expect_close("disassembled", &female[female.len() - 1], &json!([12, -6]));
    let part = found["waypoints"].as_array().expect("waypoints");
    expect_close("the part at last", &part[part.len() - 1], &json!([6.5, 8.01]));
    assert!(
        found["legs"].as_array().expect("legs").iter().all(|leg| leg["min_clearance"].as_f64() > Some(0.0))
    );
}

#[test]
fn a_gap_may_differ_by_axis_and_by_junction() {
    let each = answer(SECTION_4, &["--gap", "0.1/0.3"]);
    expect_close("by axis", &each["waypoints"][1], &json!([4.1, 2.3]));
    let one = format!("{SECTION_4}gap = 0.2\n[[assembly.junction]]\nnumber = 1\ngap = \"safest\"\n");
    let found = answer(&one, &[]);
    expect_close("junction 2 as before", &found["waypoints"][1], &json!([4.2, 2.2]));
    expect_close("junction 1 safely", &found["waypoints"][2], &json!([1.755, 2.505]));
}

#[test]
fn rules_choose_between_short_and_safe_where_the_world_does_not() {
    let safe = answer(&format!("{SECTION_4}fragile = true\n"), &[]);
    assert_eq!(safe["waypoints"], answer(SECTION_4, &["--gap", "safest"])["waypoints"]);
    let short = answer(&format!("{SECTION_4}hurry = true\n"), &[]);
    assert!(short["length"].as_f64() < answer(SECTION_4, &["--gap", "0.2"])["length"].as_f64());
}

#[test]
fn a_third_axis_is_a_matter_of_rules() {
    // Out of the pocket to the right, then to the back, then up: rules 9 to 16 know y.
    let world = "[assembly]\ngap = 0.5\nmale = [[7, 1, 1], [9, 3, 3]]\n\
                 channels = [[0, 6, 0, 4, 10, 12], [0, 0, 0, 4, 10, 4], [0, 0, 0, 10, 4, 4]]\n";
    let found = answer(world, &[]);
    let rules: Vec<&Value> = found["legs"].as_array().expect("legs").iter().map(|leg| &leg["rule"]).collect();
    assert_eq!(rules, [&json!(10), &json!(8), &json!("exit")]);
    expect_close(
        "waypoints",
        &found["waypoints"],
        &json!([[7, 1, 1], [1.5, 1.5, 1], [1.5, 6.5, 1.5], [1.5, 6.5, 12]]),
    );
    let short = plan_text(&world.replace("gap = 0.5", "gap = [0.5, 0.5, 1.5]"), &[]).expect_status(1);
    assert!(
        short.stdout.contains("the gap in z at junction 2 is 1.5, and at most 1 is possible"),
        "{}",
        short.stdout
    );
}
