//! What cannot be used is said with its file, its place, what was found and what is expected; nothing panics.

use adit_tests::TestSite;

use super::flat::{flat, on, run};

/// Both verbs refuse the world, and say all of this.
fn refused(folder: &TestSite, said: &[&str]) {
    for (verb, args) in [("route", &["bed", "bath"][..]), ("simulate", &[][..])] {
        let ran = run(folder, verb, args).expect_status(2);
        assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
        ran.complains(said);
    }
}

fn plan(from: &str, to: &str) -> TestSite {
    let folder = flat();
    folder.edit("flat.json", from, to);
    folder
}

fn world(from: &str, to: &str) -> TestSite {
    let folder = flat();
    folder.edit("flat.toml", from, to);
    folder
}

fn told(text: &str) -> TestSite {
    let folder = flat();
    folder.write("flat.toml", format!("{}\n{text}\n", folder.read("flat.toml")));
    folder
}

#[test]
fn walls_that_are_none() {
    refused(&plan("[[14, 10], [0, 10]]", "[[14, 10], [1, 10]]"), &["flat.json", "its outline is open"]);
    refused(
        &plan("[[9, 2.2], [9, 4]]", "[[9, 2.2], [9, 5]]"),
        &["flat.json:16", "crosses the wall", "may end on one another"],
    );
    refused(&plan("[[9, 2.2], [9, 4]]", "[[9, 4], [9, 4]]"), &["flat.json:16", "has no length"]);
    refused(&plan("[[9, 2.2], [9, 4]]", "[[9, 2.2], [9, 4, 1]]"), &["flat.json"]);
    refused(&plan("[[9, 2.2], [9, 4]]", "[[9, 2.2], [9, NaN]]"), &["flat.json:16"]);
    refused(
        &plan("[[9, 2.2], [9, 4]]", "[[9, 2.2], [9, .inf]]"),
        &["flat.json:16", "finite numbers up to 1e6"],
    );
    refused(
        &plan("[[9, 2.2], [9, 4]]", "[[9, 2.2], [9, 1e300]]"),
        &["flat.json:16", "finite numbers up to 1e6"],
    );
    refused(&plan("\"walls\"", "\"wals\""), &["flat.json", "walls"]);
}

#[test]
fn places_in_walls_and_outside() {
    refused(
        &plan("\"at\": [1.5, 1.5]", "\"at\": [0, 1.5]"),
        &["flat.json:29", "the place `bed` at (0, 1.5) lies on the wall"],
    );
    refused(
        &plan("\"at\": [1.5, 1.5]", "\"at\": [99, 1.5]"),
        &["flat.json:29", "outside of every closed outline"],
    );
    refused(&plan("\"name\": \"desk\"", "\"name\": \"bed\""), &["flat.json", "two places `bed`"]);
}

#[test]
fn robots_that_are_none() {
    for (radius, said) in [
        ("5.0", "too wide for every doorway"),
        ("1e14", "no floor is so wide"),
        ("1e300", "numbers up to 1e15"),
        ("nan", "must be a finite number"),
        ("inf", "must be a finite number"),
        ("0", "must be more than 0"),
        ("-1", "must be more than 0"),
        ("\"wide\"", "must be a number"),
    ] {
        refused(&world("radius = 0.25", &format!("radius = {radius}")), &["flat.toml:6", "radius", said]);
    }
    refused(&world("margin = 0.0", "margin = -0.1"), &["flat.toml:6", "must not be negative"]);
    refused(&told("[floor_plan.navigation]\nspeed = 0"), &["flat.toml:9", "must be more than 0"]);
    for (times, found) in [("1.5", "is 1.5 and"), ("-1", "is -1 and"), ("1e10", "is 10000000000 and")] {
        for key in ["most_waits", "most_detours", "most_retries", "most_back_offs"] {
            refused(
                &told(&format!("[floor_plan.navigation]\n{key} = {times}")),
                &["flat.toml:9", key, found, "must be a whole number from 0 on"],
            );
        }
    }
    refused(&told("[floor_plan.navigation]\nno_way_after = -1"), &["flat.toml:9", "must not be negative"]);
    refused(&told("[floor_plan.navigation]\nspeeed = 1"), &["flat.toml:9", "did you mean `speed`"]);
}

#[test]
fn files_that_are_none() {
    for name in ["flat.json", "flat.toml"] {
        let folder = flat();
        folder.write(name, "");
        refused(&folder, &[name]);
        folder.write(name, "\u{0}\u{1}{[");
        refused(&folder, &[name]);
    }
    refused(&world("\"flat.json\"", "\".\""), &["is no file"]);
    on(&flat(), "route", "missing.toml", &["bed", "bath"]).expect_status(2).complains(&["missing.toml"]);
}

#[test]
fn maps_that_are_none() {
    refused(&world("file  = \"flat.json\"", "map = \"flat.json\""), &["of no known format", ".toml"]);
    refused(
        &world("file  = \"flat.json\"", "file = \"flat.json\"\nmap = \"map.toml\""),
        &["it has one of them"],
    );
    refused(
        &world("file  = \"flat.json\"", "file = \"flat.json\"\nunknown = \"free\""),
        &["flat.toml:6", "goes with `map`"],
    );
    refused(&told("[[place]]\nname = \"door\"\nat = [1, 1]"), &["goes with `map`"]);
}

#[test]
fn doorways_and_regions_that_are_none() {
    refused(
        &told("[[doorway]]\nat = [3.0, 1.0]"),
        &["flat.toml:9", "no doorway is within 0.5 m of (3, 1); the nearest one is about (2.00, 4.00)"],
    );
    refused(&told("[[region]]\nat = [99.0, 1.0]"), &["flat.toml:9", "lies in no region"]);
    refused(&told("[[doorway]]\nsqueaks = true"), &["flat.toml:8", "needs a `at`"]);
    refused(&told("[[doorway]]\nat = [nan, 1]"), &["flat.toml:9", "finite"]);
    refused(
        &told("[[doorway]]\nat = [6.5, 4.0]\nsqueaks = 3"),
        &["flat.toml:10", "`squeaks` is a number here, and true or false elsewhere"],
    );
    refused(
        &told("[[doorway]]\nat = [6.5, 4.0]\nlength = 3"),
        &["flat.toml:10", "follows from the floor plan"],
    );
    refused(
        &told("[[doorway]]\nat = [6.5, 4.0]\nrust = [1]"),
        &["flat.toml:10", "a number, a text in quotes, true or false"],
    );
    refused(&told("[[dorway]]\nat = [6.5, 4.0]"), &["flat.toml:8", "did you mean `doorway`"]);
}

#[test]
fn ends_and_headings_that_are_none() {
    let folder = flat();
    for point in ["nan,1", "1,inf", "1", "1,2,3", ",", ""] {
        run(&folder, "route", &[point, "bath"]).expect_status(2).complains(&["is no place and no point"]);
        run(&folder, "simulate", &[point, "bath"]).expect_status(2).complains(&["is no place of the plan"]);
    }
    // Points in walls and far outside are points: there is no path.
    for point in ["0,0", "1e300,0", "-1e300,-1e300"] {
        run(&folder, "route", &[point, "bath"]).expect_status(1);
        run(&folder, "route", &["bath", point]).expect_status(1);
        run(&folder, "simulate", &[point, "bath"]).expect_status(2);
        let ends = run(&folder, "simulate", &["bath", point, "--json"]).expect_status(0).json();
        assert_eq!(ends[0]["ending"], "no_way", "{point}");
    }
    for heading in ["nan", "inf", "-inf", "1e300", "361"] {
        run(&folder, "simulate", &["bed", "bath", "--heading", heading])
            .expect_status(2)
            .complains(&["is no heading; expected degrees from -360 to 360"]);
    }
}

#[test]
fn a_plan_of_one_room_without_a_doorway_has_missions_too() {
    let folder = flat();
    folder.write("flat.json", "{\"walls\": [[[0,0],[9,0]], [[9,0],[9,9]], [[9,9],[0,9]], [[0,9],[0,0]]]}");
    run(&folder, "simulate", &["--missions", "12"]).expect_status(0);
    // One without room for a mission says so.
    folder.write("flat.json", "{\"walls\": [[[0,0],[1,0]], [[1,0],[1,1]], [[1,1],[0,1]], [[0,1],[0,0]]]}");
    run(&folder, "simulate", &[]).expect_status(2).complains(&["no room for missions"]);
    run(&folder, "simulate", &["--curve", "curve.svg"]).expect_status(2).complains(&["no room for a drive"]);
}
