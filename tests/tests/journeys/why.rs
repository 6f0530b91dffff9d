//! Why something is as it is, and why no route leads another way.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

#[test]
fn why_names_the_rule_and_what_it_chose() {
    let site = TestSite::example("paper").built();
    let said = site.adit("why", &["doors.3.hardness"]).expecting(0).stdout;
    assert!(said.starts_with("door 3 hardness is 37.0055"), "{said}");
    assert!(
        said.contains("by rule \"weigh a door\" (rules/rooms/paper/doors.rhai, line 7, version "),
        "{said}"
    );
    assert!(said.contains("first = ROBOTS robot/SQUAT"), "{said}");
    assert_eq!(site.adit("why", &["door 3"]).expecting(0).stdout.lines().count(), 3);
    let room = site.adit("why", &["room b", "--json"]).expecting(0).json();
    assert_eq!((&room["object"], &room["generation"]), (&"rooms.2".into(), &1.into()));
    assert_eq!(room["conclusions"][0]["witness"]["state"], "ROBOTS robot/SQUAT");
    let bridge = site.adit("why", &["BRIDGES.2.low", "--json"]).expecting(0).json();
    assert_eq!(
        bridge["conclusions"][0]["rule"],
        "a bridge is low where the tallest state does not fit under it"
    );
}

#[test]
fn why_of_something_that_is_not_there_says_what_is() {
    let site = TestSite::example("paper").built();
    site.adit("why", &["room bb"]).expecting(2).complains(&["there is no room `bb`", "did you mean `b`?"]);
    site.adit("why", &["door 99"]).expecting(2).complains(&["there are 8 doors"]);
    site.adit("why", &["doors.3.hardnes"]).expecting(2).complains(&["did you mean `hardness`?"]);
    site.adit("why", &["nonsense"]).expecting(2).complains(&["names no object", "door 7"]);
}

#[test]
fn why_follows_an_edit_from_outside() {
    let site = TestSite::example("paper").built();
    site.outside_edit("UPDATE robots SET hardness = 9 WHERE state = 'SQUAT'");
    let answer = site.adit("why", &["doors.4.hardness", "--json"]).expecting(0).json();
    assert_eq!(answer["generation"], 2);
    assert_eq!(answer["conclusions"][0]["witness"]["first"], "ROBOTS robot/LIE-FACE-DOWN");
}

#[test]
fn why_not_gives_the_price_of_another_way() {
    let site = TestSite::example("paper").built();
    let answer = site.adit("why-not", &["f", "e", "--through", "room c", "--json"]).expecting(0).json();
    let (best, cost) = (answer["best"].as_f64().unwrap(), answer["cost"].as_f64().unwrap());
    assert!((best - 92.007_434).abs() < 1e-6, "{best}");
    // Table 7: room c is entered at 94.009; from there door 5 leads to e.
    assert!((cost - (94.009_106 + 39.697_794)).abs() < 1e-5, "{cost}");
    assert!(answer["reason"].as_str().unwrap().contains("41.699 more"), "{answer:#}");
    let on = site.adit("why-not", &["f", "e", "--through", "door 3"]).expecting(0).stdout;
    assert!(on.starts_with("the best route from f to e leads through door 3"), "{on}");
}

#[test]
fn why_not_names_for_each_state_the_test_that_failed() {
    let site = TestSite::example("paper").built();
    let args = ["f", "e", "--through", "door 1", "--json"];
    let answer = site.adit("why-not", &args).expecting(0).json();
    assert_eq!((&answer["cost"], &answer["reason"]), (&().into(), &"door 1 lets no state through".into()));
    let rejected = answer["rejected"].as_array().unwrap();
    let lying = rejected
        .iter()
        .find(|one| one["variable"] == "first" && one["key"] == "robot/LIE-FACE-DOWN")
        .unwrap();
    assert_eq!(lying["reason"], "failed");
    assert_eq!(lying["test"], "first.height < door.height1");
    assert_eq!((&lying["left"], &lying["right"]), (&5.0.into(), &4.0.into()));
    let lost = rejected.iter().find(|one| one["variable"] == "second" && one["reason"] == "lost").unwrap();
    assert_eq!((&lost["value"], &lost["winner"]), (&2.0.into(), &"robot/STAND".into()));
}

#[test]
fn why_not_works_where_rooms_are_by_state() {
    let site = TestSite::example("clinic").built();
    let route = site.adit("route", &["dock", "ward 12", "--json"]).expecting(0).json();
    let steps = route["steps"].as_array().unwrap();
    let passed = steps.iter().find(|step| step["kind"] == "room").unwrap()["place"].as_str().unwrap();
    let through = format!("room {passed}");
    let answer =
        site.adit("why-not", &["dock", "ward 12", "--through", &through, "--json"]).expecting(0).json();
    let (best, cost) = (answer["best"].as_f64().unwrap(), answer["cost"].as_f64().unwrap());
    assert!((best - route["cost"].as_f64().unwrap()).abs() < 1e-9);
    assert!(
        cost < best * 1.001,
        "the way through a room of the route costs what the route costs: {cost}, {best}"
    );
}

#[test]
fn why_gives_the_values_that_the_rule_read() {
    let site = TestSite::example("paper").built();
    let answer = site.adit("why", &["doors.3.hardness", "--json"]).expecting(0).json();
    let facts = answer["facts"].as_array().unwrap();
    let squat = facts.iter().find(|one| one["key"] == "robot/SQUAT").unwrap();
    let hardness: f64 = site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'")[0].parse().unwrap();
    assert_eq!(
        (&squat["class"], squat["properties"]["hardness"].as_f64()),
        (&"ROBOTS".into(), Some(hardness))
    );
    let door = facts.iter().find(|one| one["class"] == "DOORS").unwrap();
    assert!(door["properties"]["width"].as_f64().unwrap() > 0.0, "{door}");
    let said = site.adit("why", &["doors.3.hardness"]).expecting(0).stdout;
    assert!(said.contains("first = ROBOTS robot/SQUAT ("), "{said}");
    assert!(said.contains(&format!("hardness {hardness}")), "{said}");
}

#[test]
fn a_door_that_was_told_shut_is_not_said_to_be_narrow() {
    let site = TestSite::example("paper").built();
    site.adit("tell", &["DOORS", "door 3", "passable", "false"]).expect_status(0);
    let why = site.adit("why", &["door 3"]).expecting(0).stdout;
    assert!(why.contains("door 3 passable is false, as fact 1 tells"), "{why}");
    let why_not = site.adit("why-not", &["f", "e", "--through", "door 3"]).expecting(0).stdout;
    assert!(why_not.starts_with("door 3 is told to let nobody through"), "{why_not}");
    for door in 1..=8 {
        site.adit("tell", &["DOORS", &format!("door {door}"), "passable", "false"]).expect_status(0);
    }
    let route = site.adit("route", &["f", "e"]).expecting(1).stdout;
    assert!(route.contains("is told to let nobody through") && !route.contains("narrower"), "{route}");
}

#[test]
fn why_not_says_what_would_be_done_instead_and_which_number_would_turn_it() {
    let site = TestSite::example("paper").built();
    let args = ["f", "e", "--through", "room c", "--json"];
    let answer = site.adit("why-not", &args).expecting(0).json();
    let sentence = answer["sentence"].as_str().unwrap();
    assert!(
        sentence.starts_with("Through room c it would cost 41.699 more (133.707 instead of 92.007): "),
        "{sentence}"
    );
    assert!(sentence.contains(" instead of "), "{sentence}");
    assert!((answer["route"]["cost"].as_f64().unwrap() - answer["cost"].as_f64().unwrap()).abs() < 1e-9);
    let rooms: Vec<&str> = answer["route"]["steps"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|step| step["place"].as_str())
        .collect();
    assert!(rooms.contains(&"c"), "{rooms:?}");
    let cell = &answer["would_win"];
    if let (Some(key), Some(at)) = (cell["key"].as_str(), cell["wins_at"].as_f64()) {
        // a hair beyond, the route leads through room c
        let beyond = at + (at - cell["value"].as_f64().unwrap()).signum() * 1e-6;
        site.adit("tune", &["robots", key, cell["column"].as_str().unwrap(), &beyond.to_string()])
            .expect_status(0);
        let again = site.adit("why-not", &args).expecting(0).json();
        assert!(
            again["cost"].as_f64().unwrap() <= again["best"].as_f64().unwrap() * (1.0 + 1e-6),
            "{again:#}"
        );
    } else {
        assert!(
            sentence.ends_with(
                "No single number of the tables that says how hard something is makes it the best way."
            ),
            "{sentence}"
        );
    }
}

#[test]
fn why_not_names_by_how_much_each_state_fails() {
    let site = TestSite::example("paper").built();
    let answer = site.adit("why-not", &["f", "e", "--through", "door 1", "--json"]).expecting(0).json();
    let deciding: Vec<&str> =
        answer["deciding"].as_array().unwrap().iter().filter_map(|one| one.as_str()).collect();
    assert!(
        deciding
            .contains(&"robots robot/LIE-FACE-DOWN fails first.height < door.height1: 5 against 4, 1 apart"),
        "{deciding:#?}"
    );
}

#[test]
fn a_name_that_the_building_has_means_the_same_wherever_one_is_asked_for() {
    let site = TestSite::example("clinic").built();
    // cell 25 of the floor is another room, `room y`
    let why = site.adit("why", &["room 25"]).expecting(0).stdout;
    assert!(why.starts_with("room 25 kind is room"), "{why}");
    let closed = site.adit("close", &["room 25", "--dry-run"]).expecting(0).stdout;
    assert!(closed.starts_with("would be: room 25 is closed"), "{closed}");
    let route = site.adit("route", &["room 25", "corridor 15", "--json"]).expecting(0).json();
    let ends = route["waypoints"].as_array().unwrap();
    let at = |end: &serde_json::Value| ["x", "y"].map(|axis| end[axis].as_f64().unwrap());
    for (end, space) in [&ends[0], &ends[ends.len() - 1]].into_iter().zip(["room 25", "corridor 15"]) {
        let widest = site.sqlite3(&format!("SELECT x, y FROM spaces WHERE name = '{space}'")).concat();
        let widest: Vec<f64> = widest.split('|').map(|number| number.parse().unwrap()).collect();
        assert!(at(end).iter().zip(widest).all(|(one, other)| (one - other).abs() < 1e-9), "{end}");
    }
    // a room as answers call it
    let from_room = site.adit("route", &["room y", "lobby"]).expecting(0).stdout;
    assert!(from_room.starts_with("room y to lobby"), "{from_room}");
    let unknown = "`roon 25` is no place, no space, no room and no point `x,y`; did you mean `room 25`?";
    site.adit("route", &["roon 25", "lobby"]).expecting(2).complains(&[unknown]);
    let picture = site.path().join("x.svg");
    let draw = ["-o", picture.to_str().unwrap(), "--route", "roon 25", "lobby"];
    site.adit("draw", &draw).expecting(2).complains(&[unknown]);
}
