//! Areas, obstacles and places that people lay over the map while a site is in use: ways heed them at once, until they end or
//! are lifted, and the map's files stay as they are.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

fn starter() -> TestSite {
    TestSite::example("starter").with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n").built()
}

fn cost(site: &TestSite, at: &[&str]) -> Option<f64> {
    let answer = site.adit("route", &[&["home", "window", "--json"], at].concat()).json();
    answer["cost"].as_f64()
}

/// Rooms, doors and kept routes, and what was laid.
fn content(site: &TestSite) -> Vec<String> {
    ["rooms", "doors", "tree_rows", "laid"]
        .iter()
        .flat_map(|table| site.sqlite3(&format!("SELECT * FROM {table}")))
        .collect()
}

#[test]
fn an_obstacle_is_driven_around_until_it_ends_or_is_lifted() {
    let site = starter();
    let (free, before) = (cost(&site, &[]).unwrap(), content(&site));
    let rooms = site.sqlite3("SELECT count(*) FROM rooms");
    // beside the way through the doorway
    site.adit("lay", &["obstacle", "pallets", "6.6,2 9,5.5", "--until", "2h", "--why", "delivery"])
        .expect_status(0);
    assert_ne!(site.sqlite3("SELECT count(*) FROM rooms"), rooms, "rooms are cut about it");
    assert!(cost(&site, &[]).unwrap() > free + 0.01);
    assert_eq!(cost(&site, &["--at", "3h"]), Some(free));
    // beyond the doorway, from wall to wall
    site.adit("lay", &["obstacle", "shelves", "6.2,2.5 6.4,4.5"]).expect_status(0);
    assert_eq!(cost(&site, &[]), None);
    site.adit("lift", &["shelves"]).expect_status(0);
    site.adit("lift", &["pallets"]).expect_status(0);
    assert_eq!(cost(&site, &[]), Some(free));
    assert_eq!(content(&site), before);
    let history = site.adit("history", &[]).expecting(0).stdout;
    assert!(history.contains("pallets") && history.contains("delivery"), "{history}");
}

#[test]
fn an_area_is_weighed_by_the_rules_as_one_of_the_map_is_and_taken_back_by_undo() {
    let site = starter();
    let (free, before) = (cost(&site, &[]).unwrap(), content(&site));
    let wet = ["area", "wet floor", "6.5,0.1 9,0.1 9,7.9 6.5,7.9", "--with", "hardness_factor=3"];
    let shown = site.adit("lay", &[&wet[..], &["--dry-run"]].concat()).expecting(0).stdout;
    assert!(shown.contains("wet floor"), "{shown}");
    assert_eq!((cost(&site, &[]), content(&site)), (Some(free), before.clone()), "nothing was changed");
    site.adit("lay", &wet).expect_status(0);
    assert!(cost(&site, &[]).unwrap() > free + 2.0, "two and a half metres weigh three times as much");
    site.adit("close", &["wet floor"]).expect_status(0);
    assert_eq!(cost(&site, &[]), None, "an area that was laid is closed by its name, too");
    site.adit("undo", &[]).expect_status(0);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!((cost(&site, &[]), content(&site)), (Some(free), before));
}

#[test]
fn a_place_that_is_laid_is_one_of_the_map_until_it_ends_is_lifted_or_taken_back() {
    let site = starter();
    let before = content(&site);
    let asked = |more: &[&str]| site.adit("route", &[&["home", "charger"], more].concat());
    asked(&[]).expecting(2).complains(&["charger"]);
    let shown = site.adit("lay", &["place", "charger", "9,2", "--dry-run"]).expecting(0).stdout;
    assert!(shown.contains("charger"), "{shown}");
    assert_eq!(content(&site), before, "nothing was changed");
    let unchanged = "between places none costs anything else";
    assert!(shown.contains(unchanged), "{shown}");
    site.adit("lay", &["place", "charger", "9,2", "--until", "2h", "--why", "a new robot"]).expect_status(0);
    let way = asked(&["--json"]).json();
    assert_eq!(way["waypoints"].as_array().unwrap().last().unwrap()["x"], 9.0);
    let kept = "SELECT status, round(cost, 6) FROM route WHERE start = 'home' AND goal = 'charger'";
    assert_eq!(site.sqlite3(kept), [format!("ok|{}", (way["cost"].as_f64().unwrap() * 1e6).round() / 1e6)]);
    assert_eq!(site.sqlite3("SELECT x, y FROM places WHERE place = 'charger'"), ["9.0|2.0"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM drawn"), ["0"], "a layer of polygons has no points");
    asked(&["--at", "3h"]).expecting(2).complains(&["charger"]);
    // a pallet is put down where it is put down: nobody gets there until it is lifted
    site.adit("lay", &["obstacle", "crate", "8.5,1.5 9.5,2.5"])
        .expecting(0)
        .complains(&["no state of the robot fits at `charger`"]);
    let unreached = asked(&[]).expecting(1).stdout;
    assert!(unreached.contains("no state of the robot fits at the goal"), "{unreached}");
    site.adit("undo", &[]).expect_status(0);
    site.adit("lay", &["area", "charger", "1,1 2,2"])
        .expecting(2)
        .complains(&["the place `charger` lies there already"]);
    let lifted = site.adit("lift", &["charger"]).expecting(0).stdout;
    assert!(lifted.contains(unchanged), "{lifted}");
    assert_eq!(content(&site), before);
    site.adit("undo", &[]).expect_status(0);
    asked(&[]).expect_status(0);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(content(&site), before);
}

#[test]
fn a_place_more_changes_no_route_between_the_others() {
    let starts = "map = \"map.toml\"\nrobots = \"robots.toml\"\nstarts = [\"window\"]\n";
    let site = TestSite::example("starter").with("site.toml", starts).built();
    let unchanged = "no route between places costs anything else or leads another way";
    // one that is numbered before the others
    let laid = site.adit("lay", &["place", "charger", "9,2"]).expecting(0).stdout;
    assert!(laid.contains(unchanged), "{laid}");
    site.write("site.toml", format!("{starts}[[place]]\nname = \"basin\"\nat = [9, 3]\n"));
    let built = site.adit("build", &["--json"]).json();
    assert_eq!(built["routes"]["changes"], serde_json::json!([]), "{built:#}");
    let undone = site.adit("undo", &[]).expecting(0).stdout;
    assert!(undone.contains(unchanged), "{undone}");
    site.write("site.toml", starts);
    let built = site.adit("build", &["--json"]).json();
    assert_eq!(built["routes"]["changes"], serde_json::json!([]), "{built:#}");
}

#[test]
fn what_was_laid_lies_there_after_the_map_changes_and_counts_for_nothing_where_it_no_longer_fits() {
    let site = starter();
    site.adit("lay", &["obstacle", "shelves", "6.2,2.5 6.4,4.5"]).expect_status(0);
    site.edit("map.toml", "rect = [5.9, 0.0, 6.1, 3.0]", "rect = [5.8, 0.0, 6.2, 2.9]");
    assert_eq!(cost(&site, &[]), None);
    site.outside_edit("UPDATE laid SET outline = '[[50,50],[51,50],[51,51]]'");
    let built = site.adit("build", &[]);
    let said = format!("{}{}", built.stdout, built.stderr);
    assert!(said.contains("the obstacle `shelves`, laid over the map, counts for nothing"), "{said}");
    assert!(cost(&site, &[]).is_some());
}

#[test]
fn what_cannot_be_laid_is_refused_in_words_and_nothing_is_kept() {
    let site = starter();
    let before = content(&site);
    for (args, said) in [
        (&["area", "bow", "1,1 3,3 3,1 1,3"][..], "crosses itself"),
        (&["area", "line", "1,1 3,1 2,1"], "no area"),
        (&["area", "away", "50,50 51,51"], "lies outside of the environment"),
        (&["area", "home", "1,1 2,2"], "the map has a place `home` already"),
        (&["area", "wet", "1,1 2,2", "--with", "hardnes_factor=2"], "did you mean `hardness_factor`?"),
        (&["area", "wet", "1,1 2,2", "--with", "hardness_factor=much"], "holds numbers"),
        (&["area", "wet", "1,1 2,2", "--with", "zone_factor=1.5"], "must be from 0 to 1, not 1.5"),
        (&["area", "wet", "1,1 2,2", "--with", "speed_limit=0"], "must be more than 0"),
        (
            &["area", "wet", "1,1 2,2", "--with", "zone=BLOCKED"],
            "an area of the kind `keep-out` is not entered",
        ),
        (&["area", "wet", "1,1 2,2", "--with", "zone=FOO"], "must be one of RELEASE, COORDINATED_REPLANNING"),
        (&["area", "wet", "1,1 2,2", "--until", "2020-01-01"], "that is over"),
        (&["obstacle", "crate", "1,1 2,2", "--kind", "wet"], "only an area or a door has a kind"),
        (&["obstacle", "crate", "1,1"], "two corners or more"),
        (&["place", "shelf", "1,1 2,2"], "one point"),
        (&["place", "shelf", "1,1", "--kind", "wet"], "only an area or a door has a kind"),
        (&["place", "home", "2,2"], "the map has a place `home` already"),
        (&["place", "shelf", "6,1"], "lies inside an obstacle of the map"),
        (&["obstacle", "crate", "1,1 2,x"], "is no corner"),
        (&["wall", "crate", "1,1 2,2"], "invalid value 'wall'"),
    ] {
        site.adit("lay", args).expecting(2).complains(&[said]);
    }
    assert_eq!(content(&site), before);
    site.adit("lay", &["obstacle", "crate", "1,1 1.5,1.5"]).expect_status(0);
    site.adit("lay", &["area", "crate", "1,1 2,2"])
        .expecting(2)
        .complains(&["the obstacle `crate` lies there already"]);
    site.adit("lift", &["crates"]).expecting(2).complains(&["did you mean `crate`?"]);
}

#[test]
fn a_picture_tells_apart_what_is_closed_and_areas_of_each_kind() {
    let site = starter();
    let drawn = || {
        let file = site.path().join("floor.svg");
        site.adit("draw", &["-o", file.to_str().unwrap()]).expect_status(0);
        std::fs::read_to_string(file).unwrap()
    };
    let open = drawn();
    assert!(!open.contains(">closed<") && !open.contains("url(#hatch-45)"), "nothing is closed or named");
    site.adit("lay", &["area", "puddle", "3.5,1 4.5,2", "--kind", "wet"]).expect_status(0);
    site.adit("lay", &["area", "stairs", "9,1 10,2", "--kind", "keep-out"]).expect_status(0);
    site.adit("close", &["doorway 1"]).expect_status(0);
    let shut = drawn();
    for words in [">closed<", ">wet<", ">keep-out<", "url(#hatch-45)"] {
        assert!(shut.contains(words), "{words}");
    }
    site.adit("open", &["doorway 1"]).expect_status(0);
    assert!(!drawn().contains(">closed<"));
}

/// Between a wall and the rooms there is next to nothing: where a body just touches the wall, it is beside them.
#[test]
fn whoever_touches_a_wall_is_in_an_area_to_keep_out_of_as_well_as_beside_it() {
    let site = starter();
    site.adit("lay", &["area", "stairs", "0.5,3.5 1.5,4.5", "--kind", "keep-out"]).expect_status(0);
    // squatting it is 0.8 m wide, and 0.3 m of that would be in the area
    let refused = site.adit("route", &["window", "0.4,4"]).expecting(1).stdout;
    assert!(refused.contains("the nearest point from which ways lead on is (0.325, 4)"), "{refused}");
    site.adit("tune", &["laid", "stairs", "kind", "wet"])
        .expecting(2)
        .complains(&["`laid` is not edited row by row", "`adit lay` and `adit lift`"]);
    // sideways it is 0.35 m wide, and passes
    let beside = site.adit("route", &["window", "0.3,4", "--json"]).expecting(0).json();
    assert_eq!(beside["waypoints"].as_array().unwrap().last().unwrap()["state"], "SIDE-STAND", "{beside:#}");
}

#[test]
fn a_bridge_is_passed_under_by_who_fits_until_it_is_lifted() {
    let site = starter();
    let (free, before) = (cost(&site, &[]).unwrap(), content(&site));
    let pipe = ["bridge", "pipe", "8,0 9,8", "--with", "height=1.3"];
    site.adit("lay", &pipe).expect_status(0);
    assert!(cost(&site, &[]).unwrap() > free + 1.0, "one squats beneath it");
    let way = site.adit("why", &["home", "window"]).expecting(0).stdout;
    assert!(way.contains("in window, from (7.7, 6.3)") && way.contains("leaves 1.3 m"), "{way}");
    // one that is lower than all states is a wall
    site.adit("lay", &["bridge", "beam", "9.5,0 10,8", "--with", "height=0.2"]).expect_status(0);
    assert_eq!(cost(&site, &[]), None);
    site.adit("lift", &["beam"]).expect_status(0);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(cost(&site, &[]), None, "the beam is back");
    site.adit("lift", &["beam"]).expect_status(0);
    site.adit("lift", &["pipe"]).expect_status(0);
    assert_eq!(content(&site), before);
}

#[test]
fn a_doorway_gets_a_name_and_a_hardness_by_which_it_is_closed_too() {
    let site = starter();
    let (free, before) = (cost(&site, &[]).unwrap(), content(&site));
    let door = ["door", "ward door", "6,3 6,4", "--kind", "swing", "--with", "hardness=2"];
    let said = site.adit("lay", &door).expecting(0).stdout;
    assert!(said.contains("the door `ward door` lies over the map"), "{said}");
    assert_eq!(site.sqlite3("SELECT name FROM doorways WHERE name IS NOT NULL"), ["ward door"]);
    // rooms end at the doorway now, so the way is another one by a hair
    assert!((cost(&site, &[]).unwrap() - free - 2.0).abs() < 0.1, "its hardness is paid");
    site.adit("close", &["ward door"]).expect_status(0);
    assert_eq!(cost(&site, &[]), None);
    site.adit("open", &["ward door"]).expect_status(0);
    site.adit("lift", &["ward door"]).expect_status(0);
    assert_eq!(content(&site), before);
}

#[test]
fn of_bridges_and_doors_what_is_missing_or_too_much_is_said() {
    let site = starter();
    let before = content(&site);
    let only_height = "how high it is, and nothing else, is said of it, as `height=1.3`";
    for (args, said) in [
        (&["bridge", "pipe", "8,0 9,8"][..], only_height),
        (&["bridge", "pipe", "8,0 9,8", "--with", "heigth=2"], only_height),
        (&["bridge", "pipe", "8,0 9,8", "--with", "height=low"], "is a number of metres, not `low`"),
        (&["bridge", "pipe", "8,0 9,8", "--with", "height=-1"], "must be more than 0"),
        (&["bridge", "pipe", "8,0 9,8 7,9", "--with", "height=1"], "is said by two corners, not by 3"),
        (&["bridge", "pipe", "8,0 9,1 8,2 7,1", "--with", "height=1"], "a rectangle along the axes"),
        (&["door", "ward door", "6,3 6,4 7,4"], "is said by two points, the posts, not by 3"),
        (&["door", "home", "6,3 6,4"], "home"),
    ] {
        site.adit("lay", args).expecting(2).complains(&[said]);
        assert_eq!(content(&site), before, "{args:?}");
    }
}
