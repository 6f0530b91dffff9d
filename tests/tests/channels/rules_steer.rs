//! The tables are rules: who edits one changes the path, without a build.

use serde_json::json;

use super::support::{S, SECTION_4, answer, copy_rules, expect_close, plan, worlds};

#[test]
fn the_table_as_printed_gives_the_papers_slip() {
    let printed = answer(SECTION_4, &["--gap", "0.01", "--rules", "printed"]);
    let length = printed["length"].as_f64().expect("a length");
    assert!((length - 8.273).abs() < 5e-4, "{length}");
    assert_eq!(printed["legs"][1]["rule"], 4, "rule 3 can never fire");
    expect_close("as meant", &answer(SECTION_4, &["--gap", "0.01"])["length"], &json!(6.9192));
    // A world may name it, too.
    let named = answer(&format!("rules = \"printed\"\n{SECTION_4}"), &["--gap", "0.01"]);
    assert_eq!(named, printed);
}

#[test]
fn a_margin_that_is_swapped_sends_the_part_elsewhere() {
    let folder = worlds().with("world.toml", &format!("rules = \"rules\"\n{SECTION_4}gap = 0.2\n"));
    copy_rules(&folder, "corrected");
    folder.edit("rules/table-1.rhai", "3,    \"right\",  \"up\"", "3,    \"left\",  \"up\"");
    let found = plan(&folder, "world.toml", &["--json"]).expect_status(0).json();
    expect_close("left instead of right", &found["waypoints"][2], &json!([1.2, 2.81]));
}

#[test]
fn a_ninth_rule_may_turn_otherwise() {
    let folder = worlds().with("world.toml", &format!("rules = \"rules\"\n{S}"));
    copy_rules(&folder, "corrected");
    let table = folder
        .read("rules/table-2.rhai")
        .replace("[ \"up\",     \"right\",  1, ", "[ \"up\",     \"right\",  9, ");
    folder.write("rules/table-2.rhai", table);
    let found = plan(&folder, "world.toml", &["--json"]).expect_status(0).json();
    assert_eq!(found["turns"][0]["rule"], 9);
    // And a rule of one's own, beside the tables: a wider berth where the robot goes down.
    folder.write(
        "rules/own.rhai",
        "rule \"a wide berth\" priority 1 each turn in TURNS where turn.junction == 1 then { turn.gap = 0.5; }\n",
    );
    let found = plan(&folder, "world.toml", &["--json"]).expect_status(0).json();
    assert_eq!((&found["turns"][0]["gap"], &found["turns"][1]["gap"]), (&json!(0.5), &json!(0.2)));
}

#[test]
fn each_step_says_which_rule_spoke_and_why_the_others_did_not() {
    let found = answer(SECTION_4, &["--gap", "0.2", "--explain"]);
    let rows = found["said"][0]["considered"].as_array().expect("rows");
    let of_table: Vec<_> = rows.iter().filter(|row| row["rule"] == "Lee, Table 1").collect();
    assert_eq!(of_table.len(), 4);
    assert_eq!((&of_table[0]["spoke"], &of_table[0]["row"]), (&json!(true), &json!(1)));
    assert_eq!(of_table[1]["because"], "step.next_side is left, not \"right\"");
    assert_eq!(of_table[2]["because"], "step.entering is z, not \"x\"");
    let said = plan(&worlds().with("s.toml", S), "s.toml", &["--explain"]).expect_status(0).stdout;
    assert!(said.contains("Lee, Table 2, row 5 (line"), "{said}");
    assert!(said.contains("Lee, Table 2, row 7: turn.onward is up, not \"down\""), "{said}");
}

#[test]
fn rules_that_say_nothing_or_disagree_are_named_with_the_junction() {
    let folder = worlds().with("world.toml", &format!("rules = \"rules\"\n{SECTION_4}gap = 0.2\n"));
    copy_rules(&folder, "corrected");
    let whole = folder.read("rules/table-1.rhai");
    let shorter: Vec<&str> = whole.lines().filter(|line| !line.contains("3,    \"right\"")).collect();
    let without_rule_3 = shorter.join("\n");
    folder.write("rules/table-1.rhai", &without_rule_3);
    let ran = plan(&folder, "world.toml", &[]).expect_status(1);
    assert!(ran.stdout.contains("at junction 1 no rule gives margin_x"), "{}", ran.stdout);
    assert!(ran.stdout.contains("row 3: step.coming_from is right, not \"left\""), "{}", ran.stdout);
    folder.write("rules/table-1.rhai", &whole);
    folder.write(
        "rules/own.rhai",
        "rule \"never left\" each step in STEPS then { step.margin_x = \"right\"; }\n",
    );
    let ran = plan(&folder, "world.toml", &[]).expect_status(1);
    assert!(ran.stdout.contains("rules disagree on margin_x"), "{}", ran.stdout);
    folder.write(
        "rules/own.rhai",
        "rule \"slip\" priority 9 each step in STEPS then { step.margin_x = \"rihgt\"; }\n",
    );
    let ran = plan(&folder, "world.toml", &[]).expect_status(1);
    assert!(ran.stdout.contains("\"rihgt\"; expected \"left\", \"right\" or \"keep\""), "{}", ran.stdout);
}
