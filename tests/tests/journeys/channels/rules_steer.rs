//! The tables are rules: who edits one changes the path, without a build.

use serde_json::json;

use super::support::{
    S, SECTION_4, answer, copy_rules, expect_close, maps, on, primitives, route, rows_of, with_gap,
};

#[test]
fn the_table_as_printed_gives_the_papers_slip() {
    let short = with_gap(SECTION_4, "0.01");
    let printed = answer(&format!("rules = \"printed\"\n{short}"));
    let length = printed["distance"].as_f64().expect("a length");
    assert!((length - 8.273).abs() < 5e-4, "{length}");
    assert_eq!(rows_of(&printed, "Lee, Table 1, as printed"), [1, 4], "rule 3 can never fire");
    expect_close("as meant", &answer(&short)["distance"], &json!(6.9192));
}

#[test]
fn a_margin_that_is_swapped_sends_the_part_elsewhere() {
    let folder = maps().with("map.toml", &format!("rules = \"rules\"\n{SECTION_4}gap = 0.2\n"));
    copy_rules(&folder, "corrected");
    folder.edit("rules/table-1.rhai", "3,    \"right\",  \"up\"", "3,    \"left\",  \"up\"");
    let found = route(&folder, "map.toml", &["--json"]).expect_status(0).json();
    expect_close(
        "left instead of right",
        &json!([found["waypoints"][2]["x"], found["waypoints"][2]["z"]]),
        &json!([1.2, 2.81]),
    );
}

#[test]
fn a_ninth_rule_may_turn_otherwise() {
    let folder = maps().with("map.toml", &format!("rules = \"rules\"\n{S}"));
    copy_rules(&folder, "corrected");
    let table = folder
        .read("rules/table-2.rhai")
        .replace("[ \"up\",     \"right\",  1, ", "[ \"up\",     \"right\",  9, ");
    folder.write("rules/table-2.rhai", table);
    let found = route(&folder, "map.toml", &["--json"]).expect_status(0).json();
    assert_eq!(found["status"], "ok");
    let why = on(&folder, &["why", "map.toml", "junction 1 from start to goal"]).expect_status(0).stdout;
    assert!(why.contains("rule is 9, by rule \"Lee, Table 2, row 1\""), "{why}");
    // And a rule of one's own, beside the tables: a wider berth where the robot goes down.
    folder.write(
        "rules/own.rhai",
        "rule \"a wide berth\" priority 1 each turn in TURNS where turn.junction == 1 then { turn.gap = 0.5; }\n",
    );
    let found = route(&folder, "map.toml", &["--json"]).expect_status(0).json();
    let arcs = primitives(&found);
    // the corner, the robot's half width, the gap
    expect_close("at junction 1", &arcs[1]["radius"], &json!(0.5 + 0.5));
    expect_close("at junction 2", &arcs[3]["radius"], &json!(0.5 + 0.2));
}

#[test]
fn each_step_says_which_rule_spoke_and_why_the_others_did_not() {
    let folder = maps().with("map.toml", &with_gap(SECTION_4, "0.2")).with("s.toml", S);
    let why = |map: &str, what: &str| on(&folder, &["why", map, what]).expect_status(0).stdout;
    let of_part = why("map.toml", "junction 2 from assembled to disassembled");
    for said in [
        "by rule \"Lee, Table 1, row 1\"",
        "Lee, Table 1, row 2 did not speak: step.next_side is left, not \"right\"",
        "Lee, Table 1, row 3 did not speak: step.entering is z, not \"x\"",
    ] {
        assert!(of_part.contains(said), "{of_part}");
    }
    let of_robot = why("s.toml", "junction 2 from start to goal");
    assert!(of_robot.contains("Lee, Table 2, row 5"), "{of_robot}");
    assert!(
        of_robot.contains("Lee, Table 2, row 7 did not speak: turn.onward is up, not \"down\""),
        "{of_robot}"
    );
}

#[test]
fn rules_that_say_nothing_or_disagree_are_named_with_the_junction() {
    let folder = maps().with("map.toml", &format!("rules = \"rules\"\n{SECTION_4}gap = 0.2\n"));
    copy_rules(&folder, "corrected");
    let whole = folder.read("rules/table-1.rhai");
    let shorter: Vec<&str> = whole.lines().filter(|line| !line.contains("3,    \"right\"")).collect();
    let without_rule_3 = shorter.join("\n");
    folder.write("rules/table-1.rhai", &without_rule_3);
    let ran = route(&folder, "map.toml", &[]).expect_status(1);
    assert!(ran.stdout.contains("at junction 1 no rule gives margin_x"), "{}", ran.stdout);
    let why = on(&folder, &["why", "map.toml", "junction 1 from assembled to disassembled"]).expect_status(0);
    assert!(
        why.stdout.contains("row 3 did not speak: step.coming_from is right, not \"left\""),
        "{}",
        why.stdout
    );
    folder.write("rules/table-1.rhai", &whole);
    folder.write(
        "rules/own.rhai",
        "rule \"never left\" each step in STEPS then { step.margin_x = \"right\"; }\n",
    );
    let ran = route(&folder, "map.toml", &[]).expect_status(1);
    assert!(ran.stdout.contains("rules disagree on margin_x"), "{}", ran.stdout);
    folder.write(
        "rules/own.rhai",
        "rule \"slip\" priority 9 each step in STEPS then { step.margin_x = \"rihgt\"; }\n",
    );
    let ran = route(&folder, "map.toml", &[]).expect_status(1);
    assert!(ran.stdout.contains("\"rihgt\"; expected \"left\", \"right\" or \"keep\""), "{}", ran.stdout);
}
