//! A robot that drives through corridors.

use serde_json::{Value, json};

use super::support::{S, answer, expect_close, plan_text};

fn verified() -> Value {
    serde_json::from_str(include_str!("table-2.json")).expect("the corridors")
}

/// A primitive as the verified ones are written.
fn bare(primitive: &Value) -> Value {
    let mut bare = json!({"kind": primitive["kind"], "a": primitive["a"], "b": primitive["b"]});
    if primitive["kind"] == "arc" {
        for key in ["centre", "radius", "turn"] {
            bare[key] = primitive[key].clone();
        }
    }
    bare
}

#[test]
fn the_corridors_of_section_5_are_driven_as_verified_at_every_gap() {
    for corridor in verified()["corridors"].as_array().expect("corridors") {
        let [width, length]: [f64; 2] = serde_json::from_value(corridor["robot"].clone()).expect("a robot");
        for wanted in corridor["paths"].as_array().expect("paths") {
            let name = format!("{} at gap {}", corridor["name"], wanted["gap_r"]);
            let world = format!(
                "[corridor]\nchannels = {}\nstart = {}\ngoal = {}\ngap = {}\nrobot = {{ width = {width}, length = {length} }}\n",
                corridor["channels"], corridor["start"], corridor["goal"], wanted["gap_r"]
            );
            let found = answer(&world, &[]);
            expect_close(&name, &found["length"], &wanted["length"]);
            expect_close(&name, &found["min_clearance"], &wanted["min_clearance"]);
            let rules: Value =
                found["turns"].as_array().expect("turns").iter().map(|turn| turn["rule"].clone()).collect();
            assert_eq!(rules, wanted["rules"], "{name}");
            let (primitives, wanted) = (found["primitives"].as_array(), wanted["primitives"].as_array());
            let (primitives, wanted) = (primitives.expect("primitives"), wanted.expect("primitives"));
            assert_eq!(primitives.len(), wanted.len(), "{name}");
            for (found, wanted) in primitives.iter().zip(wanted) {
                for (key, wanted) in wanted.as_object().expect("a primitive") {
                    expect_close(&format!("{name}, {key}"), &bare(found)[key], wanted);
                }
            }
        }
    }
}

/// Three corridors about a verified case: to the junction, on to the next one, and from there as the case says.
fn about(case: &Value, sense: &str) -> String {
    let edges = |key: &str| -> [f64; 4] { serde_json::from_value(case[key].clone()).expect("a box") };
    let ([x0, y0, x1, y1], next) = (edges("junction"), edges("next_junction"));
    let [mx, my]: [f64; 2] = serde_json::from_value(case["m0"].clone()).expect("a point");
    let along_y = case["rule"].as_u64() <= Some(4);
    let joined = [x0.min(next[0]), y0.min(next[1]), x1.max(next[2]), y1.max(next[3])];
    let first = [x0.min(mx - 1.0), y0.min(my - 1.0), x1.max(mx + 1.0), y1.max(my + 1.0)];
    // Of the corridor to the junction only what lies along it.
    let first = if along_y { [x0, first[1], x1, first[3]] } else { [first[0], y0, first[2], y1] };
    let turn = &case["leaving"][sense];
    let low = is_low(turn["next_rule"].as_u64());
    let (third, goal) = match (along_y, low) {
        (true, true) => {
            ([next[0], next[1] - 20.0, next[2], next[3]], [middle(next[0], next[2]), next[1] - 18.0])
        }
        (true, false) => {
            ([next[0], next[1], next[2], next[3] + 20.0], [middle(next[0], next[2]), next[3] + 18.0])
        }
        (false, true) => {
            ([next[0] - 20.0, next[1], next[2], next[3]], [next[0] - 18.0, middle(next[1], next[3])])
        }
        (false, false) => {
            ([next[0], next[1], next[2] + 20.0, next[3]], [next[2] + 18.0, middle(next[1], next[3])])
        }
    };
    format!(
        "[corridor]\nchannels = {}\nstart = [{mx}, {my}]\ngoal = {}\ngap = {}\nrobot = {{ width = {}, length = 0.4 }}\n",
        json!([first, joined, third]),
        json!(goal),
        case["gap_r"],
        case["robot_width"]
    )
}

fn middle(a: f64, b: f64) -> f64 {
    f64::midpoint(a, b)
}

/// Whether a rule of Table 2 leads on down, or to the left.
fn is_low(rule: Option<u64>) -> bool {
    matches!(rule, Some(3 | 4 | 7 | 8))
}

#[test]
fn the_eight_rules_of_table_2_arrive_and_leave_as_verified_for_both_senses_of_the_next_turn() {
    for case in verified()["cases"].as_array().expect("cases") {
        for sense in ["same_sense", "opposite_sense"] {
            let name = format!("rule {}, {sense}", case["rule"]);
            let found = answer(&about(case, sense), &[]);
            let (first, second) = (&found["turns"][0], &found["turns"][1]);
            let leaving = &case["leaving"][sense];
            assert_eq!(first["rule"], case["rule"], "{name}");
            assert_eq!(first["turn"], case["turn"], "{name}");
            expect_close(&name, &first["corner"], &case["corner"]);
            expect_close(&name, &first["theta"], &case["theta_a_deg"]);
            expect_close(&name, &first["arriving"], &case["arriving_point"]);
            expect_close(&name, &first["leaving"], &leaving["leaving_point"]);
            assert_eq!(second["rule"], leaving["next_rule"], "{name}");
            expect_close(&name, &second["arriving"], &leaving["next_arriving_point"]);
            let heading = found["primitives"][2]["heading"].as_f64().expect("a heading");
            let turned = (heading - leaving["heading_deg"].as_f64().expect("degrees")).rem_euclid(360.0);
            assert!(!(1e-5..=360.0 - 1e-5).contains(&turned), "{name}: heading {heading}");
        }
    }
}

#[test]
fn table_2_as_printed_ends_where_its_point_is_off_the_circle_and_says_by_how_much() {
    for case in verified()["cases"].as_array().expect("cases") {
        let ran = plan_text(&about(case, "same_sense"), &["--rules", "printed", "--json"]);
        if case["rule"] == 1 {
            // Only rule 1 is right; the next one that speaks is not.
            let reason = ran.expect_status(1).json()["reason"].as_str().expect("a reason").to_owned();
            assert!(reason.contains("junction 2"), "{reason}");
            continue;
        }
        let refused = ran.expect_status(1).json();
        let reason = refused["reason"].as_str().expect("a reason");
        let [x, y]: [f64; 2] = serde_json::from_value(case["as_printed_in_paper"].clone()).expect("a point");
        assert!(reason.contains(&format!("junction 1 (rule {})", case["rule"])), "{reason}");
        assert!(reason.contains(&format!("({x}, {y})")), "{reason}\nexpected ({x}, {y})");
    }
}

#[test]
fn a_gap_beyond_the_safest_is_driven_and_remarked_on_and_where_a_wall_would_be_hit_the_safest_is() {
    let found = answer(S, &["--gap", "1.0"]);
    expect_close("clearance", &found["min_clearance"], &json!(0.864_009));
    let remark = found["remarks"][0].as_str().expect("a remark");
    assert!(remark.contains("beyond the safest one, 0.929688"), "{remark}");
    assert_eq!(answer(S, &["--gap", "safest"])["remarks"], json!([]));
    let hit = answer(S, &["--gap", "1.6"]);
    let said = "at junction 1 the gap of 1.6 m cannot be kept; the safest, 0.93 m, is driven";
    assert!(hit["remarks"].as_array().expect("remarks").contains(&json!(said)), "{hit}");
    expect_close("clearance", &hit["min_clearance"], &json!(0.929_688));
}

#[test]
fn in_a_network_rules_weigh_the_corridors_and_the_tables_steer_through_the_best() {
    // Two ways round a block from the left corridor to the right one: over the top, or along the bottom, which is narrow.
    let network = |bottom: f64| {
        format!(
            "[corridor]\nchannels = [[0, 0, 3, 20], [0, 17, 30, 20], [27, 0, 30, 20], [0, 3, 30, {}]]\n\
             robot = {{ width = 1.0, length = 1.5 }}\nstart = [1.5, 10]\ngoal = [28.5, 9]\ngap = 0.3\n",
            3.0 + bottom
        )
    };
    assert_eq!(answer(&network(3.0), &[])["channels"], json!([1, 4, 3]), "the bottom is shorter");
    assert_eq!(
        answer(&network(1.5), &[])["channels"],
        json!([1, 2, 3]),
        "it leaves less room than is asked for"
    );
    assert_eq!(
        answer(&network(1.5), &["--gap", "0.01"])["channels"],
        json!([1, 4, 3]),
        "it is enough for that"
    );
    assert_eq!(answer(&network(0.9), &[])["channels"], json!([1, 2, 3]), "the robot does not fit");
    let between = answer(&network(3.0), &["28.5,1.5", "1.5,18"]);
    assert_eq!(between["status"], "ok", "any start and any goal");
    expect_close("its start", &between["primitives"][0]["a"], &json!([28.5, 1.5]));
}

#[test]
fn a_given_heading_is_turned_from_while_the_first_line_is_driven() {
    let world = S.replace("gap   = 0.2", "gap = 0.2\nheading = 90.0");
    let found = answer(&world, &[]);
    expect_close("from", &found["primitives"][0]["from_heading"], &json!(90.0));
    expect_close("the rest is the same", &found["length"], &answer(S, &[])["length"]);
    // Across the corridor a robot longer than it is wide cannot stand.
    let across = world.replace("90.0", "0.0").replace("length = 1.5", "length = 3.5");
    let refused = plan_text(&across, &[]).expect_status(1);
    assert!(refused.stdout.contains("no path"), "{}", refused.stdout);
}
