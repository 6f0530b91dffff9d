//! Paths and missions on a flat of our own.

use serde_json::{Value, json};

use super::flat::{copy_rules, flat, run, sql};

#[test]
fn a_path_leads_from_place_to_place_and_is_pulled_tight() {
    let found = run(&flat(), "route", &["bed", "bath", "--json"]).expect_status(0).json();
    let (first, metres) = (&found["waypoints"][0], found["distance"].as_f64().expect("metres"));
    assert_eq!((&first["x"], &first["y"]), (&json!(1.5), &json!(1.5)));
    // A point instead of a place, and the way back.
    let back = run(&flat(), "route", &["bath", "1.5,1.5", "--json"]).expect_status(0).json();
    assert!((back["distance"].as_f64().expect("metres") - metres).abs() < 1e-6);
}

#[test]
fn missions_that_are_written_anew_are_said_to_be() {
    let folder = flat();
    let simulate =
        |count| run(&folder, "simulate", &["--missions", count, "--db", "flat.db"]).expect_status(0);
    let first = simulate("2");
    assert!(!first.stderr.contains("written anew"), "{}", first.stderr);
    simulate("1").complains(&["missions of flat from an earlier run are written anew, 1 to 1"]);
    assert_eq!(sql(&folder, "flat.db", "SELECT count(*) FROM missions"), ["2"]);
}

#[test]
fn missions_are_the_same_from_the_same_seed_and_end_as_they_should() {
    let rows =
        run(&flat(), "simulate", &["--missions", "6", "--seed", "3", "--json"]).expect_status(0).json();
    let again =
        run(&flat(), "simulate", &["--missions", "6", "--seed", "3", "--json"]).expect_status(0).json();
    let without_time = |rows: &Value| -> Vec<Value> {
        let mut rows = rows.as_array().expect("rows").clone();
        for row in &mut rows {
            row["milliseconds"] = Value::Null;
        }
        rows
    };
    assert_eq!(without_time(&rows), without_time(&again));
    assert_eq!(rows.as_array().map(Vec::len), Some(6));
    for row in rows.as_array().expect("rows") {
        assert_eq!((&row["right"], &row["collided"]), (&json!(true), &json!(false)), "{row}");
    }
}

#[test]
fn the_journal_says_where_the_robot_was_and_by_which_rule_it_went_on() {
    let folder = flat();
    run(&folder, "simulate", &["bed", "desk", "--db", "missions.db"]).expect_status(0);
    let sql = |query: &str| sql(&folder, "missions.db", query);
    assert_eq!(sql("SELECT world, mission, ending FROM missions"), ["flat|1|arrived"]);
    assert_eq!(
        sql("SELECT state, next, rule FROM journal WHERE event = 'state' ORDER BY entry LIMIT 1"),
        ["hold|decide|hold"]
    );
    assert_eq!(sql("SELECT count(*) FROM journal WHERE event = 'state' AND rule IS NULL"), ["0"]);
    assert_eq!(sql("SELECT detail FROM journal ORDER BY entry DESC LIMIT 1"), ["{\"ending\":\"arrived\"}"]);
    // It thinks that it is where it is, to some centimetres.
    assert_eq!(sql("SELECT max(abs(x - true_x) + abs(y - true_y)) < 0.3 FROM journal"), ["1"]);
}

#[test]
fn a_film_is_made_of_a_mission() {
    let folder = flat();
    run(&folder, "simulate", &["bed", "bath", "--film", "film.svg"]).expect_status(0);
    let film = folder.read("film.svg");
    assert!(film.starts_with("<svg") && film.contains("<animate"), "{}", &film[..200.min(film.len())]);
}

#[test]
fn a_film_of_a_mission_that_is_not_there_is_refused_before_any_is_run() {
    for (wrong, said) in [
        (["--mission", "0"], "there is no mission 0; they are numbered 1 to 1"),
        (["--mission", "2"], "there is no mission 2"),
        (["--speed", "0"], "expected more than 0"),
    ] {
        let folder = flat();
        let args = [["--film", "film.svg"], wrong].concat();
        run(&folder, "simulate", &args).expect_status(2).complains(&[said]);
        assert!(!folder.path().join("film.svg").exists());
    }
}

#[test]
fn who_edits_a_rule_changes_what_the_robot_does() {
    let folder = flat();
    copy_rules(&folder);
    // A robot that holds instead of going.
    folder.edit(
        "rules/execution.rhai",
        "any,   \"move\",    \"none\" ] ]",
        "any,   \"hold\",    \"no way\" ] ]",
    );
    let rows = run(&folder, "simulate", &["bed", "bath", "--json"]).json();
    assert_eq!(rows[0]["ending"], "no_way");
    // One doorway is not to be used: the path goes another way, or there is none.
    let folder = flat();
    let before = run(&folder, "route", &["bed", "desk", "--json"]).expect_status(0).json();
    copy_rules(&folder);
    let doorways = |route: &Value| -> Vec<String> {
        let places =
            route["steps"].as_array().into_iter().flatten().filter_map(|step| step["place"].as_str());
        places.filter_map(|place| place.strip_prefix("doorway ")).map(str::to_owned).collect()
    };
    let doorway = doorways(&before)[0].clone();
    folder.write(
        "rules/own.rhai",
        format!("rule \"that door squeaks\" priority 2 each way in WAYS where way.doorway == {doorway} then {{ way.passable = false; }}\n"),
    );
    let ran = run(&folder, "route", &["bed", "desk", "--json"]);
    assert_ne!(doorways(&ran.json()), doorways(&before));
}

#[test]
fn what_cannot_be_is_said() {
    let folder = flat();
    run(&folder, "route", &["bed", "attic"]).expect_status(2).complains(&["`attic` is no place"]);
    run(&folder, "simulate", &["bed", "attic"])
        .expect_status(2)
        .complains(&["`attic` is no place", "places: bath"]);
    folder.edit("flat.toml", "radius = 0.25", "radius = 0.75");
    let too_wide = run(&folder, "route", &["bed", "bath"]).expect_status(1);
    assert!(too_wide.stdout.contains("no route from bed to bath"), "{}", too_wide.stdout);
    folder.edit("flat.toml", "radius = 0.75", "radius = 0.25");
    folder.edit("flat.json", "[[0, 0], [12, 0]]", "[[0, 0], [12, 9]]");
    run(&folder, "route", &["bed", "bath"]).expect_status(2).complains(&["flat.json"]);
    folder.edit("flat.toml", "flat.json", "nowhere.json");
    run(&folder, "simulate", &[]).expect_status(2).complains(&["nowhere.json"]);
}

#[test]
fn a_robot_that_is_at_its_goal_arrives_at_once() {
    let folder = flat();
    for (start, goal) in [("bed", "bed"), ("6.5,1.5", "desk")] {
        let rows = run(&folder, "simulate", &[start, goal, "--json"]).expect_status(0).json();
        let row = &rows[0];
        assert_eq!((&row["ending"], &row["right"]), (&json!("arrived"), &json!(true)), "{row}");
        assert!(row["seconds"].as_f64().is_some_and(|seconds| seconds < 60.0), "{row}");
        assert_eq!(row["optimum"].to_string(), "0.0");
        let table = run(&folder, "simulate", &[start, goal]).expect_status(0).stdout;
        assert!(!table.contains("NaN") && !table.contains("inf"), "{table}");
        let path = run(&folder, "route", &[start, goal, "--json"]).expect_status(0).json();
        assert_eq!(path["distance"].to_string(), "0.0");
    }
}

#[test]
fn a_film_is_an_svg_or_it_is_refused_before_anything_is_run() {
    let folder = flat();
    for args in [&["bed", "bath"][..], &["--learn", "bed"]] {
        let args = [args, &["--film", "film.png", "--db", "missions.db"]].concat();
        run(&folder, "simulate", &args).expect_status(2).complains(&["film.png is no .svg"]);
        for file in ["film.png", "missions.db"] {
            assert!(!folder.path().join(file).exists(), "{file} was made");
        }
    }
}

#[test]
fn a_robot_may_be_told_never_to_wait_nor_to_begin_anew() {
    let folder = flat();
    let figures = "most_waits = 0\nmost_detours = 0\nmost_retries = 0\nmost_back_offs = 0\nno_way_after = 0";
    folder.write("flat.toml", format!("{}\n[floor_plan.navigation]\n{figures}\n", folder.read("flat.toml")));
    run(&folder, "simulate", &["bath", "0,0", "--db", "missions.db"]).expect_status(0);
    let count = |event: &str| {
        sql(&folder, "missions.db", &format!("SELECT count(*) FROM journal WHERE event = '{event}'"))
    };
    assert_eq!((count("begun anew"), count("ended")), (vec!["0".to_owned()], vec!["1".to_owned()]));
}
