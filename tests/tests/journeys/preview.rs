//! A preview says what an edit would change, before it is made, and changes nothing.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::collections::BTreeMap;
use std::time::Duration;

use adit::edit::Edit;
use adit::preview::{Preview, Wanted};
use adit::{KnowledgeBase, Live, Tell};
use adit_db::history::Author;
use adit_tests::TestSite;

fn author() -> Author {
    Author { who: "test".to_owned(), why: String::new() }
}

fn set(table: &str, key: &str, column: &str, value: &str) -> Edit {
    Edit::Set(table.to_owned(), key.to_owned(), column.to_owned(), value.to_owned())
}

fn live(site: &TestSite) -> Live {
    Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap()
}

type Weight = (Option<String>, Option<String>, Option<String>);

/// What the database says of all rooms or all doors, by number.
fn weights(site: &TestSite, table: &str, key: &str) -> BTreeMap<i64, Weight> {
    let rows = site.sqlite3(&format!(
        "SELECT {key}, quote(hardness), quote(action), quote(passable) FROM {table} ORDER BY {key}"
    ));
    let word = |text: &str| Some(text.trim_matches('\'').to_owned()).filter(|text| text != "NULL");
    let row = |row: &String| {
        let parts: Vec<&str> = row.split('|').collect();
        (parts[0].parse().unwrap(), (word(parts[1]), word(parts[2]), word(parts[3])))
    };
    rows.iter().map(row).collect()
}

fn said(weight: &adit::preview::Weight) -> (Option<f64>, Option<String>, Option<bool>) {
    (weight.hardness, weight.action.clone(), weight.passable)
}

fn read(weight: &Weight) -> (Option<f64>, Option<String>, Option<bool>) {
    let number = weight.0.as_ref().map(|text| text.parse().unwrap());
    (number, weight.1.clone(), weight.2.as_ref().map(|text| text == "1"))
}

/// Previews the edits, makes them, and compares what was said with what came.
fn foretells(site: &TestSite, edits: &[Edit], (start, goal): (&str, &str)) -> Preview {
    let mut live = live(site);
    let places = site.sqlite3("SELECT place FROM places ORDER BY place");
    let costs = |live: &Live| -> BTreeMap<(String, String), Option<f64>> {
        let pairs = places.iter().flat_map(|a| places.iter().map(move |b| (a.clone(), b.clone())));
        let cost = |(a, b): (String, String)| {
            let cost = live.route(&a, std::slice::from_ref(&b), None).unwrap().cost;
            ((a, b), cost)
        };
        pairs.filter(|(a, b)| a != b).map(cost).collect()
    };
    let before = (weights(site, "rooms", "room"), weights(site, "doors", "door"), costs(&live));
    let wanted = Wanted { start, goal, robot: None };
    let preview = live.fork().with_patience(Duration::from_mins(1)).preview(edits, Some(wanted)).unwrap();
    assert_eq!(before.0, weights(site, "rooms", "room"), "a preview writes nothing");
    assert_eq!(before.2, costs(&live), "a preview leaves what is answered as it is");
    assert_eq!(preview.before, Some(live.route(start, &[goal.to_owned()], None).unwrap()));
    for edit in edits {
        live.edit(edit, &author()).unwrap();
    }
    let now = (weights(site, "rooms", "room"), weights(site, "doors", "door"), costs(&live));
    let answer = live.route(start, &[goal.to_owned()], None).unwrap();
    let foretold = preview.route.clone().unwrap();
    assert_eq!((foretold.cost, &foretold.steps), (answer.cost, &answer.steps));
    if !preview.layout_changed {
        let rooms: BTreeMap<i64, _> = preview.rooms.list.iter().map(|room| (room.room, &room.new)).collect();
        let doors: BTreeMap<i64, _> = preview.doors.list.iter().map(|door| (door.door, &door.new)).collect();
        for (foretold, before, now) in [(rooms, &before.0, &now.0), (doors, &before.1, &now.1)] {
            let changed = now.iter().filter(|(key, _)| before[key] != now[key]);
            let changed: BTreeMap<i64, _> = changed.map(|(key, weight)| (*key, read(weight))).collect();
            let foretold: BTreeMap<i64, _> = foretold.iter().map(|(key, to)| (*key, said(to))).collect();
            assert_eq!(foretold, changed);
        }
    }
    let routes: BTreeMap<(String, String), (Option<f64>, Option<f64>)> = preview
        .routes
        .list
        .iter()
        .map(|route| ((route.start.clone(), route.goal.clone()), (route.old, route.new)))
        .collect();
    assert!(!preview.routes.truncated);
    let is_measured = answer.distance.is_some();
    for (pair, cost) in &now.2 {
        let (old, new) = routes.get(pair).copied().unwrap_or((before.2[pair], before.2[pair]));
        // where ways are measured, a search for one goal and one for all may end a little apart
        let is_near = |one: Option<f64>, two: Option<f64>| match (one, two) {
            (Some(one), Some(two)) => (one - two).abs() <= if is_measured { 0.02 * two } else { 0.0 },
            (one, two) => one == two,
        };
        assert!(is_near(old, before.2[pair]), "{pair:?}: {old:?} said, {:?} was", before.2[pair]);
        assert!(is_near(new, *cost), "{pair:?}: {new:?} foretold, {cost:?} came");
    }
    preview
}

#[test]
fn a_hardness_of_the_papers_example() {
    let site = TestSite::example("paper").built();
    let preview = foretells(&site, &[set("robots", "SQUAT", "hardness", "2.5")], ("a", "j"));
    assert!(preview.doors.changed > 0 && !preview.layout_changed, "{preview:?}");
    let cell = &preview.cells[0];
    assert_eq!((&*cell.table, &*cell.key, &*cell.column), ("robots", "robot/SQUAT", "hardness"));
    assert_eq!((cell.old.to_string(), cell.new.to_string()), ("4".to_owned(), "2.5".to_owned()));
    assert_eq!(preview.cells.len(), 1);
}

#[test]
fn several_cells_at_once_and_a_fact() {
    let site = TestSite::example("paper").built();
    let tell = Tell {
        class: "DOORS".to_owned(),
        object: "3".to_owned(),
        property: "passable".to_owned(),
        value: "false".to_owned(),
        until: None,
        new_property: false,
    };
    let edits = [
        set("robots", "SQUAT", "hardness", "2.5"),
        set("robots", "SIDE-STAND", "hardness", "1.2"),
        Edit::Tell(tell),
    ];
    let preview = foretells(&site, &edits, ("a", "j"));
    assert_eq!(preview.cells.len(), 3, "{:?}", preview.cells);
    assert!(preview.doors.list.iter().any(|door| door.door == 3 && door.new.passable == Some(false)));
}

#[test]
fn a_site_by_state_and_a_width_that_cuts_rooms_anew() {
    let site = TestSite::example("starter")
        .with(
            "site.toml",
            "name = \"starter\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
        )
        .with("robots.toml", include_str!("../../../kb/sites/hospital/robots.toml"))
        .built();
    let places = site.sqlite3("SELECT place FROM places ORDER BY place");
    let pair = (&*places[0], &*places[1]);
    let state = &site.sqlite3("SELECT state FROM robots ORDER BY position LIMIT 1")[0];
    let preview = foretells(&site, &[set("robots", state, "hardness", "1.5")], pair);
    assert!(preview.rooms.changed > 0 && !preview.layout_changed);
    assert!(preview.routes.longer > 0 && preview.routes.shorter == 0, "{:?}", preview.routes);
    let preview = foretells(&site, &[set("robots", state, "width", "0.5")], pair);
    assert!(preview.layout_changed);
    assert_eq!(preview.rooms.changed, preview.rooms.total);
}

#[test]
fn an_edit_that_would_be_refused_is_refused_by_the_preview_in_the_same_words() {
    let site = TestSite::example("paper").built();
    let mut live = live(&site);
    for edit in [
        set("robots", "SQUAT", "hardness", "-2"),
        set("robots", "SQUAT", "hardness", "soft"),
        set("robots", "SQAT", "hardness", "2"),
        set("doors", "3", "hardness", "2"),
    ] {
        let foretold = live.preview(std::slice::from_ref(&edit), None).unwrap_err();
        assert_eq!(foretold.to_string(), live.edit(&edit, &author()).unwrap_err().to_string());
    }
}

#[test]
fn what_changes_nothing_is_said_to_change_nothing() {
    let site = TestSite::example("paper").built();
    let present = &site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'")[0];
    let preview = live(&site).preview(&[set("robots", "SQUAT", "hardness", present)], None).unwrap();
    assert!(preview.cells.is_empty());
    assert_eq!((preview.rooms.changed, preview.doors.changed, preview.routes.changed), (0, 0, 0));
    assert_eq!(preview.routes.compared, preview.routes.total);
}

#[test]
fn places_that_would_go_are_named_since_no_route_of_theirs_is_left_to_change() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    for (name, at) in [("charger", "9,2"), ("shelf", "2,6")] {
        site.adit("lay", &["place", name, at]).expect_status(0);
    }
    let would = |edits: &[Edit]| live(&site).preview(edits, None).unwrap().notes;
    let gone = would(&[Edit::Undo(Some(2))]);
    assert_eq!(gone, ["the place `shelf` would be gone, and with it the routes from and to it"]);
    let gone = would(&[Edit::Undo(Some(2)), Edit::Undo(Some(1))]);
    assert_eq!(
        gone,
        ["the places `charger` and `shelf` would be gone, and with them the routes from and to them"]
    );
    assert_eq!(would(&[set("robots", "SQUAT", "hardness", "3")]), [""; 0]);
}
