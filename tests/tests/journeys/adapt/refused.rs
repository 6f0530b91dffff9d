//! What cannot be: said with file, line and caret.

use adit_tests::TestSite;

use super::support::{cell, learn, run, sql};

const TWO_LINK: &str = include_str!("two-link.json");

/// The scenario file with one text in another's stead is refused, with its place and these words.
#[track_caller]
fn scenario(from: &str, to: &str, wanted: &[&str]) {
    assert!(TWO_LINK.contains(from), "no `{from}`");
    let folder = TestSite::empty().with("two-link.json", &TWO_LINK.replacen(from, to, 1));
    let ran = run(&folder, &["experiment", "two-link.json", "--runs", "1"]).expect_status(2);
    ran.complains(&["two-link.json:"]);
    ran.complains(wanted);
}

/// The cell with one text in another's stead is refused.
#[track_caller]
fn world(from: &str, to: &str, wanted: &[&str]) {
    let folder = cell();
    folder.edit("cell.toml", from, to);
    let ran = run(&folder, &["tasks", "cell.toml", "load"]).expect_status(2);
    ran.complains(&["cell.toml:"]);
    ran.complains(wanted);
}

#[test]
fn links_of_zero_length() {
    scenario("[1.0, 0.9]", "[1.0, 0.0]", &[":5:", "link 2 is 0 m long, and must be longer than 0"]);
    world("[0.9, 0.8]", "[-0.9, 0.8]", &[":4:", "link 1 is -0.9 m long"]);
    world("link_radius  = 0.03", "link_radius = -0.03", &["the radius of the links is -0.03 m"]);
}

#[test]
fn polygons_that_cross_themselves_or_enclose_nothing() {
    scenario(
        "[[-1.3, 0.7], [-0.85, 0.55], [-0.9, 0.95]]",
        "[[0, 0], [1, 1], [1, 0], [0, 1]]",
        &[":13:", "the polygon of obstacle 3 crosses itself", "(0, 0) to (1, 1)", "(1, 0) to (0, 1)"],
    );
    scenario(
        "[[-1.3, 0.7], [-0.85, 0.55], [-0.9, 0.95]]",
        "[[-1.3, 0.7], [-0.85, 0.55]]",
        &[":13:", "obstacle 3 has 2 corners, and needs three at least"],
    );
    world("[0.15, 0.1], [-0.15, 0.1]", "[-0.15, 0.1], [0.15, 0.1]", &["the polygon of bin crosses itself"]);
    world(
        "[[-0.06, -0.06], [0.06, -0.06]",
        "[[-0.06, -0.06], [-0.06, -0.06]",
        &["corners 1 and 2 of post are at the same place"],
    );
}

#[test]
fn other_versions_of_the_format() {
    scenario(
        "\"scenarios\"",
        "\"version\": 2, \"scenarios\"",
        &[":2:", "version 2 of the format; this program reads version 1"],
    );
    scenario("\"wrap\": false", "\"wrap\": true", &["joints that turn on for ever are not planned for"]);
    scenario("\"goals\"", "\"targets\"", &["`targets` is not a key of a scenario"]);
    scenario("   \"home\": [2.09, 2.519],\n", "", &["a scenario needs `home`"]);
    scenario("\"tasks\": 100", "\"tasks\": 1.5", &["`tasks` is 1.5; expected a whole number"]);
    scenario("{", "[", &["not a scenario"]);
    // A file that says its version is read as one that does not.
    let folder = TestSite::empty()
        .with("two-link.json", &TWO_LINK.replacen("\"scenarios\"", "\"version\": 1, \"scenarios\"", 1));
    run(&folder, &["experiment", "two-link.json", "--runs", "1", "--strategy", "a3", "--only", "two-link-A"])
        .expect_status(0);
}

#[test]
fn configurations_beyond_the_limits() {
    scenario(
        "[2.09, 2.519]",
        "[2.09, 2.8]",
        &["`home` has joint 2 at 2.8, outside of its limits -2.7 to 2.7"],
    );
    scenario("[1.722, -0.463]", "[1.722]", &["goal 1 has 1 number, and the robot 2 joints"]);
    world("[2.9, -0.9]", "[3.2, -0.9]", &["goal inspect has joint 1 at 3.2"]);
    world("[[-3.1, 3.1], [-2.6, 2.6]]", "[[-3.1, 3.1]]", &["1 joint limits for 2 links"]);
    world("[[-3.1, 3.1]", "[[3.1, -3.1]", &["joint 1 goes from 3.1 to -3.1"]);
    scenario("[1.722, -0.463]", "[1.722, .inf]", &["not a scenario", "non-finite"]);
}

#[test]
fn names_that_mean_two_things_or_nothing() {
    world("name    = \"post\"", "name    = \"press\"", &["two are called `press`"]);
    world(
        "object = \"bin\"",
        "object = \"bni\"",
        &["goal load is at object `bni`, which is not in the cell", "press, bin, post, rack"],
    );
    world("name   = \"shelf\"", "name   = \"home\"", &["`home` is a goal already"]);
    world("movable = true", "movabel = true", &["`movabel` is not a key", "did you mean `movable`?"]);
    let folder = cell();
    run(&folder, &["tasks", "cell.toml", "laod"])
        .expect_status(2)
        .complains(&["`laod` is no goal of cell", "load"]);
    run(&folder, &["tasks", "cell.toml", "0.1,0.2,0.3"])
        .expect_status(2)
        .complains(&["has 3 numbers, and a configuration 2"]);
    run(&folder, &["tasks", "cell.toml", "0.1,9"])
        .expect_status(2)
        .complains(&["`0.1,9` lies outside of the robot's limits: -3.1 to 3.1 and -2.6 to 2.6"]);
}

#[test]
fn a_goal_or_a_start_in_collision_is_a_clear_no() {
    let folder = cell();
    // Into the press.
    let ran = learn(&folder, &["0.6,0.0"]).expect_status(1);
    assert!(ran.stdout.contains("no path: the robot would touch"), "{}", ran.stdout);
    assert!(ran.stdout.contains("at goal 0.6,0.0"), "{}", ran.stdout);
    folder.edit("cell.toml", "at      = [-0.9, 0.6]", "at      = [0.0, 0.9]");
    let ran = learn(&folder, &["load"]).expect_status(1);
    assert!(ran.stdout.contains("where it is"), "{}", ran.stdout);
    let status = learn(&folder, &["load", "--json"]).expect_status(1).json();
    assert_eq!(status["tasks"][0]["status"], "no_path");
}

#[test]
fn experience_of_another_robot() {
    let folder = cell();
    learn(&folder, &["load"]).expect_status(0);
    folder.edit("cell.toml", "[0.9, 0.8]", "[0.9, 0.85]");
    learn(&folder, &["load"])
        .expect_status(2)
        .complains(&["the experience of cell is of another robot", "0.85"]);
}

#[test]
fn experience_of_another_robot_is_not_begun_with() {
    let folder = cell();
    learn(&folder, &["load"]).expect_status(0);
    folder.write("other.toml", folder.read("cell.toml").replacen("[0.9, 0.8]", "[0.9, 0.85]", 1));
    let other =
        |args: &[&str]| run(&folder, &[&["tasks", "other.toml", "load", "--db", "cell.db"], args].concat());
    other(&["--from", "cell"]).expect_status(2).complains(&["the experience of cell is of another robot"]);
    // Nothing of it was written, so the cell begins by itself.
    assert_eq!(sql(&folder, "cell.db", "SELECT cell FROM cells"), ["cell"]);
    other(&[]).expect_status(0);
}

#[test]
fn cells_larger_than_any() {
    scenario(
        "[1.0, 0.9]",
        "[1e300, 0.9]",
        &[":5:", "the sum of the links in metres has 1e300; expected numbers up to 100"],
    );
    scenario("[-1.3, 0.7]", "[-1.3, 1e6]", &["a corner of obstacle 3 has 1e6"]);
    world("[0.9, 0.8]", "[1e6, 0.8]", &["the sum of the links in metres has"]);
    world(
        "[[-3.1, 3.1]",
        "[[-3.1, 1e9]",
        &["`joint_limits` in radians has 1e9; expected numbers up to 25.133"],
    );
}

#[test]
fn rules_that_say_nothing_end_an_experiment() {
    let folder = TestSite::empty().with("two-link.json", TWO_LINK);
    folder.write("rules/empty.rhai", "// nothing\n");
    let args = ["experiment", "two-link.json", "--only", "two-link-A", "--runs", "1", "--rules", "rules"];
    run(&folder, &args).expect_status(2).complains(&["rules do not say"]);
}

#[test]
fn taught_paths_that_are_none() {
    let folder = cell();
    for (text, wanted) in [
        ("[[0.1, 0.2]]", "has two configurations at least, and this one 1"),
        ("[[0.1, 0.2],\n [9.0, 0.2]]", "configuration 2 of the path has joint 1 at 9"),
        ("{}", "not a taught path"),
        ("[[0.1, 0.2], [0.1]]", "configuration 2 of the path has 1 number,"),
    ] {
        folder.write("taught.json", text);
        let ran = learn(&folder, &["load", "--teach", "taught.json"]).expect_status(2);
        ran.complains(&["taught.json:", wanted]);
    }
}

#[test]
fn tasks_are_for_cells_and_copies_for_what_is_kept() {
    let folder = cell();
    let flat = adit_tests::repository().join("kb/worlds/flat.toml").display().to_string();
    run(&folder, &["tasks", &flat, "bed"]).expect_status(2).complains(&["is no cell"]);
    run(&folder, &["tasks", "cell.toml", "load", "--scenario", "one"])
        .expect_status(2)
        .complains(&["it is no .json"]);
    run(&folder, &["tasks", "cell.toml", "load", "--from", "cell"])
        .expect_status(2)
        .complains(&["nothing is kept here without --db"]);
    learn(&folder, &["load", "--from", "nowhere"])
        .expect_status(2)
        .complains(&["there is no experience of nowhere"]);
}
