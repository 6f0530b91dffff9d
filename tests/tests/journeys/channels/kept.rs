//! What is kept of a map alone, for SQL, and its picture.

use super::support::{S, SECTION_4, maps, on, route, with_gap};

fn sqlite3(folder: &adit_tests::TestSite, query: &str) -> Vec<String> {
    let mut command = std::process::Command::new("sqlite3");
    command.args(["-readonly", "s4.db", query]).current_dir(folder.path());
    let output = command.output().expect("sqlite3 runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()
}

const ROUTE: &str = "SELECT status, reason FROM route WHERE start = 'assembled'";

#[test]
fn a_map_alone_leaves_nothing_but_the_database_that_is_asked_for() {
    let folder = maps().with("s4.toml", &with_gap(SECTION_4, "0.2"));
    route(&folder, "s4.toml", &[]).expect_status(0);
    let files = || std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(files(), 1);
    route(&folder, "s4.toml", &["--db", "s4.db"]).expect_status(0);
    assert_eq!(
        sqlite3(
            &folder,
            "SELECT step, kind, place, rule, round(x, 3), round(z, 3) FROM action_sequence WHERE start = 'assembled'
             ORDER BY step"
        ),
        [
            "1|move|junction 2|Lee, Table 1, row 1|4.2|2.2",
            "2|move|junction 1|Lee, Table 1, row 3|2.31|2.81",
            "3|move|outside||2.31|7.0"
        ]
    );
    assert_eq!(
        sqlite3(&folder, "SELECT x0, z0, x1, z1 FROM junctions"),
        ["1.0|2.0|5.0|6.0", "4.0|2.0|7.0|6.0"]
    );
    let by_shell = on(&folder, &["sql", "s4.toml", ROUTE]).expect_status(0).stdout;
    assert!(by_shell.contains("ok|"), "{by_shell}");
}

#[test]
fn the_file_is_what_counts_and_what_cannot_be_edited_says_so() {
    let folder = maps().with("s4.toml", &with_gap(SECTION_4, "0.2"));
    route(&folder, "s4.toml", &["--db", "s4.db"]).expect_status(0);
    let edit = ["tune", "s4.toml", "parts", "part", "gap_x", "0.1"];
    on(&folder, &[&edit[..], &["--db", "s4.db"]].concat())
        .expect_status(2)
        .complains(&["s4.toml is a map alone", "adit new DIR --map s4.toml"]);
    let preview = on(&folder, &[&edit[..], &["--dry-run"]].concat()).expect_status(0).stdout;
    assert!(preview.contains("assembled to disassembled (part): 7.403 → 7.242"), "{preview}");
    for verb in ["serve", "watch", "undo", "close"] {
        let what: &[&str] = if verb == "close" { &["junction 1"] } else { &[] };
        on(&folder, &[&[verb, "s4.toml"], what].concat()).expect_status(2).complains(&["s4.toml"]);
    }
    folder.edit("s4.toml", "gap = 0.2", "gap = 0.3");
    route(&folder, "s4.toml", &["--db", "s4.db"]).expect_status(1);
    assert_eq!(
        sqlite3(&folder, ROUTE),
        ["no_route|the gap in x at junction 2 is 0.3, and at most 0.255 is possible"]
    );
    let not_ours = maps().with("s4.toml", &with_gap(SECTION_4, "0.2")).with("s4.db", "no database");
    route(&not_ours, "s4.toml", &["--db", "s4.db"]).expect_status(2);
    assert_eq!(not_ours.read("s4.db"), "no database");
}

#[test]
fn a_map_alone_is_checked_tested_and_drawn() {
    let folder = maps().with("s4.toml", &with_gap(SECTION_4, "0.2")).with("s.toml", S);
    for (map, ends) in [("s4.toml", ["assembled", "disassembled"]), ("s.toml", ["start", "goal"])] {
        on(&folder, &["check", map]).expect_status(0);
        on(&folder, &["test", map]).expect_status(0);
        on(&folder, &["build", map]).expect_status(0);
        on(&folder, &["draw", map, "-o", "figure.svg", "--route", ends[0], ends[1]]).expect_status(0);
        assert!(folder.read("figure.svg").contains(&format!("{} to {}", ends[0], ends[1])), "{map}");
        on(&folder, &["draw", map, "-o", "figure.gif"])
            .expect_status(2)
            .complains(&["neither .svg nor .png"]);
    }
    on(&folder, &["route", "figure.svg", "start", "goal"]).expect_status(2).complains(&["is no site"]);
}
