//! What is kept of a plan, for SQL.

use super::support::{S, SECTION_4, plan, worlds};

fn sqlite3(folder: &adit_tests::TestSite, query: &str) -> Vec<String> {
    let mut command = std::process::Command::new("sqlite3");
    command.args(["-readonly", "plans.db", query]).current_dir(folder.path());
    let output = command.output().expect("sqlite3 runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()
}

#[test]
fn the_path_its_facts_and_what_rules_said_are_one_query_away() {
    let folder = worlds().with("s4.toml", &format!("{SECTION_4}gap = 0.2\n")).with("s.toml", S);
    for world in ["s4.toml", "s.toml"] {
        plan(&folder, world, &["--db", "plans.db"]).expect_status(0);
    }
    assert_eq!(
        sqlite3(
            &folder,
            "SELECT step, kind, junction, rule, round(x, 3), round(z, 3) FROM path_steps WHERE plan = 's4'"
        ),
        ["1|start|||4.5|1.01", "2|line|2|1.0|4.2|2.2", "3|line|1|3.0|2.31|2.81", "4|line|||2.31|7.0"]
    );
    assert_eq!(
        sqlite3(
            &folder,
            "SELECT kind, turn, rule, round(heading, 2) FROM path_steps WHERE plan = 's' AND step IN (3, 5)"
        ),
        ["arc|right|1.0|14.52", "arc|left|5.0|83.52"]
    );
    assert_eq!(
        sqlite3(&folder, "SELECT channel1, channel2, x0, z0, x1, z1 FROM junctions WHERE plan = 's4'"),
        ["1|2|1.0|2.0|5.0|6.0", "2|3|4.0|2.0|7.0|6.0"]
    );
    assert_eq!(
        sqlite3(&folder, "SELECT junction, x, y FROM corners WHERE plan = 's' AND turned"),
        ["1|3.0|6.0", "2|9.0|9.0"]
    );
    assert_eq!(
        sqlite3(
            &folder,
            "SELECT value, rule FROM step_facts WHERE plan = 's4' AND junction = 1 AND property = 'margin_x'"
        ),
        ["right|Lee, Table 1"]
    );
    assert_eq!(
        sqlite3(
            &folder,
            "SELECT table_row, because FROM step_rules
             WHERE plan = 's4' AND junction = 1 AND rule = 'Lee, Table 1' AND NOT spoke AND table_row = 4"
        ),
        ["4|step.coming_from is right, not \"left\""]
    );
}

#[test]
fn a_plan_replaces_the_earlier_one_of_its_world_and_no_path_is_kept_with_its_reason() {
    let folder = worlds().with("s4.toml", &format!("{SECTION_4}gap = 0.2\n"));
    plan(&folder, "s4.toml", &["--db", "plans.db"]).expect_status(0);
    folder.edit("s4.toml", "gap = 0.2", "gap = 0.3");
    plan(&folder, "s4.toml", &["--db", "plans.db"]).expect_status(1);
    assert_eq!(
        sqlite3(&folder, "SELECT plan, status, reason FROM plans"),
        ["s4|no_path|the gap in x at junction 2 is 0.3, and at most 0.255 is possible"]
    );
    assert_eq!(sqlite3(&folder, "SELECT count(*) FROM path_steps"), ["0"]);
    let not_ours =
        worlds().with("s4.toml", &format!("{SECTION_4}gap = 0.2\n")).with("plans.db", "no database");
    plan(&not_ours, "s4.toml", &["--db", "plans.db"]).expect_status(2);
    assert_eq!(not_ours.read("plans.db"), "no database");
}

#[test]
fn figures_5_and_8_are_drawn_with_the_gaps_side_by_side() {
    let folder = worlds().with("s4.toml", &format!("{SECTION_4}gap = 0.2\n")).with("s.toml", S);
    for (world, gaps) in [("s4.toml", "0.01,0.2,safest"), ("s.toml", "0.2,0.6,1.0")] {
        plan(&folder, world, &["--gap", gaps, "-o", "figure.svg"]).expect_status(0);
        let svg = folder.read("figure.svg");
        for panel in ["panel-a", "panel-b", "panel-c"] {
            assert!(svg.contains(panel), "{world} has no {panel}");
        }
        assert!(!svg.contains("panel-d"), "{world} has as many panels as gaps");
    }
    plan(&folder, "s.toml", &["-o", "figure.gif"]).expect_status(2).complains(&["neither .svg nor .png"]);
    plan(&folder, "s4.toml", &["--gap", "0.3", "-o", "none.svg"])
        .expect_status(1)
        .complains(&["is not drawn"]);
    assert!(!folder.path().join("none.svg").exists());
}
