//! A robot that drives through corridors.

use serde_json::{Value, json};

use super::support::{S, answer, clearance, expect_close, maps, on, primitives, route_of, rows_of, with_gap};

fn verified() -> Value {
    serde_json::from_str(include_str!("table-2.json")).expect("the corridors")
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
            let found = answer(&world);
            expect_close(&name, &found["distance"], &wanted["length"]);
            expect_close(&name, &clearance(&found), &wanted["min_clearance"]);
            assert_eq!(Value::Array(rows_of(&found, "Lee, Table 2")), wanted["rules"], "{name}");
            expect_close(&name, &Value::Array(primitives(&found)), &wanted["primitives"]);
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
            let found = answer(&about(case, sense));
            let (rules, primitives) = (rows_of(&found, "Lee, Table 2"), primitives(&found));
            let (arc, next) = (&primitives[1], &primitives[3]);
            let leaving = &case["leaving"][sense];
            assert_eq!((&rules[0], &rules[1]), (&case["rule"], &leaving["next_rule"]), "{name}");
            assert_eq!(arc["turn"], case["turn"], "{name}");
            expect_close(&name, &arc["centre"], &case["corner"]);
            expect_close(&name, &arc["a"], &case["arriving_point"]);
            expect_close(&name, &arc["b"], &leaving["leaving_point"]);
            expect_close(&name, &next["a"], &leaving["next_arriving_point"]);
            let heading = found["waypoints"][3]["heading"].as_f64().expect("a heading");
            let turned = (heading - leaving["heading_deg"].as_f64().expect("degrees")).rem_euclid(360.0);
            assert!(!(1e-5..=360.0 - 1e-5).contains(&turned), "{name}: heading {heading}");
        }
    }
}

#[test]
fn table_2_as_printed_ends_where_its_point_is_off_the_circle_and_says_by_how_much() {
    for case in verified()["cases"].as_array().expect("cases") {
        let printed = format!("rules = \"printed\"\n{}", about(case, "same_sense"));
        let ran = route_of(&printed, &["--json"]);
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
    let found = answer(&with_gap(S, "1.0"));
    expect_close("clearance", &clearance(&found), &json!(0.864_009));
    let remark = found["remarks"][0].as_str().expect("a remark");
    assert!(remark.contains("beyond the safest one, 0.929688"), "{remark}");
    assert!(answer(&with_gap(S, "\"safest\"")).get("remarks").is_none());
    let hit = answer(&with_gap(S, "1.6"));
    let said = "at junction 1 the gap of 1.6 m cannot be kept; the safest, 0.93 m, is driven";
    assert!(hit["remarks"].as_array().expect("remarks").contains(&json!(said)), "{hit}");
    expect_close("clearance", &clearance(&hit), &json!(0.929_688));
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
    let channels = |map: &str| -> Vec<String> {
        let steps = answer(map)["steps"].as_array().expect("steps").clone();
        let lines = steps.iter().filter(|step| step["kind"] == "line");
        lines.map(|step| step["place"].as_str().expect("a channel").to_owned()).collect()
    };
    let (over, along) = (["channel 1", "channel 2", "channel 3"], ["channel 1", "channel 4", "channel 3"]);
    assert_eq!(channels(&network(3.0)), along, "the bottom is shorter");
    assert_eq!(channels(&network(1.5)), over, "it leaves less room than is asked for");
    assert_eq!(channels(&with_gap(&network(1.5), "0.01")), along, "it is enough for that");
    assert_eq!(channels(&network(0.9)), over, "the robot does not fit");
    let folder = maps().with("map.toml", &network(3.0));
    let between = on(&folder, &["route", "map.toml", "28.5,1.5", "1.5,18", "--json"]).expect_status(0).json();
    assert_eq!(between["status"], "ok", "any start and any goal");
    expect_close("its start", &primitives(&between)[0]["a"], &json!([28.5, 1.5]));
}

#[test]
fn a_given_heading_is_turned_from_while_the_first_line_is_driven() {
    let world = S.replace("gap   = 0.2", "gap = 0.2\nheading = 90.0");
    let found = answer(&world);
    expect_close("from", &found["waypoints"][0]["heading"], &json!(90.0));
    expect_close("the rest is the same", &found["distance"], &answer(S)["distance"]);
    // Across the corridor a robot longer than it is wide cannot stand.
    let across = world.replace("90.0", "0.0").replace("length = 1.5", "length = 3.5");
    let refused = route_of(&across, &[]).expect_status(1);
    assert!(refused.stdout.contains("no route"), "{}", refused.stdout);
}
