//! Bad input gets a clear error that names the place, and the database of before stays as it was.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite};

/// Builds the paper's example, spoils one of its files, and expects a build to fail with these words,
/// status 2, and an untouched database.
#[track_caller]
fn spoiled(file: &str, from: &str, to: &str, words: &[&str]) {
    let site = TestSite::example("paper").built();
    let before = fs::read(site.path().join("site.db")).unwrap();
    site.edit(file, from, to);
    site.adit("build", &["--reseed"]).expecting(2).complains(words);
    assert_eq!(fs::read(site.path().join("site.db")).unwrap(), before, "the database was touched");
}

#[test]
fn an_unknown_key_in_a_map() {
    spoiled("map.toml", "depth = ", "dept = ", &["map.toml", "dept", "depth"]);
}

#[test]
fn an_unknown_key_in_a_site() {
    spoiled("site.toml", "rooms", "room", &["site.toml", "room", "rooms"]);
}

#[test]
fn a_nan_in_a_map() {
    spoiled("map.toml", "19.1", "nan", &["map.toml", "nan", "finite"]);
}

#[test]
fn a_negative_height() {
    spoiled("map.toml", "height = 15.0", "height = -15.0", &["map.toml", "-15", "height"]);
}

#[test]
fn a_negative_width_of_a_state() {
    spoiled("robots.toml", "width = 3.0", "width = -3.0", &["robots.toml", "-3", "width"]);
}

#[test]
fn an_obstacle_outside_of_the_map() {
    spoiled("map.toml", "[19.1, 6.0, 29.5, 16.5]", "[119.1, 6.0, 129.5, 16.5]", &["map.toml", "outside"]);
}

#[test]
fn a_start_inside_an_obstacle() {
    spoiled("map.toml", "at = [9.55, 8.25]", "at = [25.0, 10.0]", &["home", "inside", "obstacle"]);
}

#[test]
fn a_place_named_like_a_room() {
    spoiled("map.toml", "name = \"home\"", "name = \"d\"", &["`d`", "room"]);
}

#[test]
fn a_rule_file_with_a_syntax_error() {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    let site = site.built();
    let before = fs::read(site.path().join("site.db")).unwrap();
    site.edit("rules/doors.rhai", "by hardness where first", "by hardness were first");
    let ran = site.adit("build", &[]).expecting(2);
    ran.complains(&["doors.rhai", "were", "where"]);
    assert_eq!(fs::read(site.path().join("site.db")).unwrap(), before);
    site.adit("check", &[]).expecting(1).complains(&["doors.rhai"]);
}

#[test]
fn a_rule_that_misspells_a_property() {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    site.edit("rules/doors.rhai", "door.distance1 *", "door.distnce1 *");
    site.adit("build", &[]).expecting(2).complains(&["doors.rhai", "distnce1", "distance1"]);
}

#[test]
fn a_rule_that_sets_a_misspelt_property_is_named_beside_the_tests_that_fail_by_it() {
    // once, ten tests failed, and nothing said why
    let site = TestSite::example("clinic").built();
    site.copy_rules_and_tests("by-state");
    site.edit("rules/doors.rhai", "door.hardness = 0.0", "door.hardnes = 0.0");
    let words = ["no rule applied", "doors.rhai", "sets DOORS.hardnes,", "did you mean `DOORS.hardness`?"];
    site.adit("build", &[]).expecting(1).complains(&words);
}

#[test]
fn a_state_that_cannot_be_read_is_one_mistake_and_not_one_in_each_change_that_names_it() {
    let site = TestSite::example("clinic").built();
    site.edit("robots.toml", "width = 0.6", "width = \"wide\"");
    let said = site.adit("build", &[]).expecting(2).stderr;
    assert_eq!(said.matches('×').count(), 1, "{said}");
    assert!(said.contains("`width` of [[robots]] must be a number"), "{said}");
}

#[test]
fn a_change_to_no_state_is_marked_where_it_stands_below_others_that_are_wrong() {
    // once, the line of another change was shown where one above was wrong
    let site = TestSite::example("clinic").built();
    let changes = "[[changes]]\nfrom_state = \"STAND\"\nto_state = \"SQUAT\"\nhardness = \"much\"\n\
                   [[changes]]\nfrom_state = \"SQAT\"\nto_state = \"STAND\"\nhardness = 1.0\n";
    let text = site.read("robots.toml");
    let states = text.split("[[changes]]").next().unwrap();
    site.write("robots.toml", states.to_owned() + changes);
    let said = site.adit("build", &[]).expecting(2).stderr;
    assert_eq!(said.matches('×').count(), 2, "{said}");
    let from = states.lines().count() + 6;
    for words in
        ["`SQAT` is not a state of robot `robot`", "did you mean `SQUAT`?", &format!("robots.toml:{from}:")]
    {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn an_empty_robot_table() {
    let site = TestSite::example("paper").with("robots.toml", "");
    site.adit("build", &[]).expecting(2).complains(&["robots.toml", "[[robots]]"]);
}

#[test]
fn a_start_inside_an_obstacle_on_the_command_line() {
    let site = TestSite::example("paper").built();
    site.adit("route", &["25,10", "e"]).expecting(2).complains(&["25", "obstacle"]);
}

#[test]
fn a_start_outside_of_the_map() {
    let site = TestSite::example("paper").built();
    site.adit("route", &["-3.5,2", "e"]).expecting(2).complains(&["-3.5", "outside"]);
}

fn ros_site(image: &str) -> TestSite {
    TestSite::example("paper")
        .with("site.toml", "name = \"ros\"\nmap = \"map.yaml\"\nrobots = \"robots.toml\"\n")
        .with(
            "map.yaml",
            &format!(
                "image: {image}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n\
                 occupied_thresh: 0.65\nfree_thresh: 0.196\n"
            ),
        )
}

#[test]
fn a_missing_image() {
    ros_site("floor.pgm").adit("build", &[]).expecting(2).complains(&["map.yaml", "floor.pgm"]);
}

#[test]
fn a_16_bit_pgm() {
    let site = ros_site("floor.pgm");
    site.write("floor.pgm", [b"P5\n4 4\n65535\n".as_slice(), &[255; 32]].concat());
    site.adit("build", &[]).expecting(2).complains(&["floor.pgm", "16"]);
}

#[test]
fn a_truncated_image() {
    let site = ros_site("floor.pgm");
    site.write("floor.pgm", [b"P5\n40 40\n255\n".as_slice(), &[255; 100]].concat());
    site.adit("build", &[]).expecting(2).complains(&["floor.pgm"]);
}

#[test]
fn an_image_of_sixty_thousand_pixels_squared() {
    let site = ros_site("floor.pgm");
    site.write("floor.pgm", b"P5\n60000 60000\n255\n");
    site.adit("build", &[]).expecting(2).complains(&["floor.pgm", "60000"]);
}

#[test]
fn a_database_of_a_newer_version() {
    let site = TestSite::example("paper").built();
    site.outside_edit("PRAGMA user_version = 999");
    for verb in ["build", "history"] {
        site.adit(verb, &[]).expecting(2).complains(&["site.db", "newer"]);
    }
}

#[test]
fn a_file_that_is_no_database() {
    let site = TestSite::example("paper").with("site.db", "this is a shopping list, not a database, is it?");
    site.adit("build", &[]).expecting(2).complains(&["site.db"]);
    assert!(site.read("site.db").starts_with("this is a shopping list"));
}

#[test]
fn a_locked_database() {
    let site = TestSite::example("paper").built();
    let mut holder = Command::new("python3")
        .args([
            "-c",
            "import sqlite3, sys, time
db = sqlite3.connect(sys.argv[1], isolation_level=None)
db.execute('BEGIN EXCLUSIVE')
print('held', flush=True)
time.sleep(60)",
        ])
        .arg(site.path().join("site.db"))
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = [0; 5];
    std::io::Read::read_exact(holder.stdout.as_mut().unwrap(), &mut line).unwrap();
    let ran = site.adit("tune", &["robots", "SQUAT", "hardness", "3"]);
    holder.kill().unwrap();
    holder.wait().unwrap();
    ran.expecting(2).complains(&["site.db", "locked"]);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);
}

#[test]
fn a_read_only_folder() {
    let site = TestSite::example("paper").built();
    Command::new("chmod").args(["-R", "a=rX"]).arg(site.path()).status().unwrap();
    let mut build = if Command::new("id").arg("-u").output().unwrap().stdout == b"0\n" {
        let mut setpriv = Command::new("setpriv");
        setpriv.args(["--reuid=65534", "--regid=65534", "--clear-groups"]).arg(adit_tests::adit());
        setpriv
    } else {
        Command::new(adit_tests::adit())
    };
    let ran = adit_tests::Ran::new(&build.arg("build").arg(site.path()).output().unwrap());
    Command::new("chmod").args(["-R", "u+w"]).arg(site.path()).status().unwrap();
    ran.expecting(2).complains(&["site.db"]);
}

/// Beyond some size a coordinate loses its centimetres and a sum of hardness its end; once, SQLite said so, of no file.
#[test]
fn a_number_beyond_all_measure() {
    spoiled("map.toml", "93.7", "1e308", &["map.toml", "1e308", "1e15"]);
    spoiled("robots.toml", "width = 3.0", "width = 1e308", &["robots.toml", "1e308", "1e15"]);
}

#[test]
fn a_name_with_a_control_character() {
    spoiled("map.toml", "\"home\"", "\"ho\\u0000me\"", &["map.toml", "control character"]);
    spoiled("robots.toml", "\"SQUAT\"", "\"SQ\\u001bUAT\"", &["robots.toml", "control character"]);
}

#[test]
fn a_change_of_shape_that_stands_there_twice() {
    let site = TestSite::example("clinic");
    let again = "[[changes]]\nfrom_state = \"STAND\"\nto_state = \"LIE\"\nhardness = 5.0\n";
    site.write("robots.toml", site.read("robots.toml") + "\n" + again);
    site.adit("build", &[]).expecting(2).complains(&["robots.toml", "STAND/LIE", "twice"]);
}

/// Keys of rows are joined by `/`: robot `x/A` in state `B` would be robot `x` in state `A/B`.
#[test]
fn a_robot_with_a_slash_in_its_name() {
    let site = TestSite::example("paper");
    site.write("robots.toml", site.read("robots.toml").replace("[[robots]]", "[[robots]]\nrobot = \"x/A\""));
    site.adit("build", &[]).expecting(2).complains(&["robots.toml", "x/A", "`/`"]);
}

#[test]
fn a_negate_that_is_neither_0_nor_1() {
    let site = ros_site("floor.pgm");
    site.edit("map.yaml", "negate: 0", "negate: \"1\"");
    site.adit("build", &[]).expecting(2).complains(&["map.yaml", "`negate` must be 0 or 1"]);
}

/// The image is all wall. Once, that built a site of no rooms without a word.
#[test]
fn a_map_without_a_room_is_remarked() {
    let site = ros_site("floor.pgm");
    site.write("floor.pgm", [b"P5\n40 40\n255\n".as_slice(), &[0; 1600]].concat());
    site.adit("build", &[]).expecting(0).complains(&["there is no room"]);
}

#[test]
fn a_state_that_cannot_be_drawn() {
    let site = TestSite::example("clinic").built();
    let file = site.path().join("floor.svg").display().to_string();
    site.adit("draw", &["-o", &file, "--state", "FLY"]).expecting(2).complains(&["FLY", "STAND"]);
}

#[test]
fn a_clearance_that_no_room_would_keep_is_refused() {
    for rooms in ["paper", "minimum"] {
        let site = TestSite::example("paper");
        let text = site.read("site.toml").replace("rooms = \"paper\"", &format!("rooms = \"{rooms}\""));
        site.write("site.toml", format!("clearance = 0.5\n{text}"));
        let said = format!("`clearance` is not kept where `rooms` is \"{rooms}\"");
        site.adit("build", &[]).expecting(2).complains(&[&said, "site.toml:1"]);
    }
    let site = TestSite::example("paper");
    site.write("site.toml", format!("clearance = 0.0\n{}", site.read("site.toml")));
    site.adit("build", &[]).expect_status(0);
}

#[test]
fn a_robot_that_there_is_not_is_not_drawn_for() {
    let site = TestSite::example("paper").built();
    let picture = site.path().join("picture.svg");
    let picture = picture.to_str().expect("a path in letters");
    site.adit("draw", &["-o", picture, "--robot", "nobody"])
        .expecting(2)
        .complains(&["there is no robot `nobody`"]);
}

#[test]
fn what_is_amiss_with_a_map_is_noted_at_each_build_and_with_its_place() {
    let site = TestSite::example("starter");
    let more = "\n[[place]]\nname = \"edge\"\nat = [0.05, 0.05]\n\n[[area]]\nname = \"spill\"\nkind = \"wet\"\nrect = [-1, 1, 2, 2]\n";
    let settings =
        "name = \"floor\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n".to_owned();
    site.write("site.toml", settings + more);
    for _ in 0..2 {
        let built = site.adit("build", &[]).expecting(0);
        let said = built.stdout + &*built.stderr;
        assert!(said.contains("no state of the robot fits at `edge`"), "{said}");
        assert!(said.contains("site.toml:11:8: this area is cut at the edge"), "{said}");
    }
}

#[test]
fn an_area_that_makes_rooms_less_than_nothing_is_named_with_the_rule() {
    let site = TestSite::example("starter");
    let area = "[[area]]\nname = \"slope\"\nrect = [1.0, 1.0, 2.0, 2.0]\nhardness_factor = -1\n";
    site.write("site.toml", format!("map = \"map.toml\"\nrobots = \"robots.toml\"\n{area}"));
    let said = ["overlays.rhai", "has the hardness -", "for AREAS slope"];
    site.adit("build", &[]).expecting(2).complains(&said);
}

#[test]
fn a_mission_into_an_obstacle_is_refused_as_a_route_is() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    for asked in ["route", "simulate"] {
        site.adit(asked, &["home", "6,0.5"]).expecting(2).complains(&["6,0.5 is inside an obstacle"]);
    }
}

/// Where what a change of shape costs is lost in rounding, a search went round and round for ever.
#[test]
fn a_hardness_beside_which_all_others_are_lost_in_rounding_is_searched_as_any_other() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    let cost = || site.adit("route", &["home", "window", "--json"]).json()["cost"].as_f64().unwrap();
    let easy = cost();
    for hardness in ["1e16", "1e17", "1e100", "1e299"] {
        site.adit("tune", &["robots", "SQUAT", "hardness", hardness]).expect_status(0);
        assert!(cost() >= easy);
    }
    let said = site.adit("tune", &["robots", "SQUAT", "hardness", "4"]).expecting(0).stdout;
    assert!(said.contains("1e299 → 4"), "{said}");
    assert!((cost() - easy).abs() < 1e-9);
}

#[test]
fn files_that_are_not_utf_8_text_are_named_with_what_to_do() {
    let utf_16 = b"\xff\xfea\x00 \x00=\x00 \x001\x00";
    for file in ["robots.toml", "map.toml", "site.toml", "rules/mine.rhai"] {
        let site = TestSite::example("paper").built();
        fs::create_dir_all(site.path().join("rules")).unwrap();
        fs::write(site.path().join(file), utf_16).unwrap();
        let said = [file, "it is not UTF-8 text", "save it as plain text in UTF-8"];
        site.adit("build", &["--reseed"]).expecting(2).complains(&said);
    }
}

#[test]
fn a_database_where_a_site_is_asked_for_is_told_from_a_map() {
    let site = TestSite::example("paper").built();
    let database = site.path().join("site.db");
    let asked = |file: &std::path::Path| {
        let command = Command::new(adit_tests::adit()).arg("sql").arg(file).arg("SELECT 1").output();
        Ran::new(&command.unwrap()).expecting(2)
    };
    asked(&database).complains(&["is a database", &format!("say {}", site.path().display())]);
    let copy = site.path().join("kept.db");
    std::fs::copy(&database, &copy).unwrap();
    asked(&copy).complains(&["is a database", "say the site's folder, and --db"]);
}
