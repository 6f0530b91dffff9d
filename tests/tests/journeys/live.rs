//! A site held in memory writes what a plain edit writes.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::process::Command;

use adit::edit::Edit;
use adit::{KnowledgeBase, Live, Silent, Tell};
use adit_db::history::Author;
use adit_tests::{Ran, TestSite};

fn author() -> Author {
    Author { who: "test".to_owned(), why: String::new() }
}

fn set(state: &str, column: &str, value: &str) -> Edit {
    Edit::Set("robots".to_owned(), state.to_owned(), column.to_owned(), value.to_owned())
}

/// What is told stands there with its time: both sites are asked about the same moment.
fn at_one_moment(site: &TestSite) -> KnowledgeBase {
    KnowledgeBase::open(site.path()).unwrap().at(Some("2030-01-01T00:00:00Z")).unwrap()
}

/// Every row of every table, but for the times in the history.
fn content(site: &TestSite) -> Vec<String> {
    let dump =
        Command::new("sqlite3").arg("-readonly").arg(site.path().join("site.db")).arg(".dump").output();
    let dump = Ran::new(&dump.unwrap()).expecting(0).stdout;
    let rows = dump.lines().filter(|line| line.starts_with("INSERT INTO"));
    let mut rows: Vec<String> =
        rows.filter(|line| !line.starts_with("INSERT INTO history")).map(str::to_owned).collect();
    rows.extend(site.sqlite3("SELECT id, table_name, key, column_name, old, new, who, why FROM history"));
    rows
}

/// Does the same edits in memory and as a plain edit does, and compares the databases after each.
fn same_after(example: &str, edits: &[Edit]) {
    same_for((TestSite::example(example).built(), TestSite::example(example).built()), example, edits);
}

fn same_for((plain, held): (TestSite, TestSite), example: &str, edits: &[Edit]) {
    let site = at_one_moment(&plain);
    let mut live = Live::open(at_one_moment(&held)).unwrap();
    for edit in edits {
        let expected = site.edit(edit, &author(), false, &Silent);
        let found = live.edit(edit, &author());
        match (expected, found) {
            (Ok((_, report)), Ok(outcome)) => {
                assert_eq!(outcome.generation, report.generation, "{edit:?}");
                assert!(outcome.doors >= report.doors.changed, "{edit:?}: {outcome:?}");
            }
            (Err(expected), Err(found)) => assert_eq!(found.to_string(), expected.to_string()),
            (expected, found) => panic!("{edit:?}: plain {expected:?}, held {found:?}"),
        }
        live.renew_routes().unwrap();
        let (expected, found) = (content(&plain), content(&held));
        let differ: Vec<_> = expected.iter().filter(|row| !found.contains(row)).take(5).collect();
        let more: Vec<_> = found.iter().filter(|row| !expected.contains(row)).take(5).collect();
        assert!(differ.is_empty() && more.is_empty(), "{example}, {edit:?}:\n{differ:#?}\nfound:\n{more:#?}");
        assert_eq!(found.len(), expected.len(), "{example}, {edit:?}");
    }
}

#[test]
fn values_that_go_up_and_down_in_the_papers_example() {
    same_after(
        "paper",
        &[
            set("SQUAT", "hardness", "3"),
            set("SQUAT", "hardness", "3"),
            set("LIE-FACE-DOWN", "hardness", "2.5"),
            set("LIE-FACE-DOWN", "hardness", "9"),
            set("SIDE-STAND", "hardness", "0.5"),
            set("SQUAT", "action", "HOP"),
            Edit::Undo(None),
            set("SIDE-STAND", "hardness", "-2"),
            set("SQUAT", "hardness", "soft"),
            set("IMPOSSIBLE", "hardness", "500"),
            Edit::Undo(None),
        ],
    );
}

#[test]
fn dimensions_and_states_that_planners_look_at() {
    let new = [("action", "ROLL"), ("height", "3"), ("width", "2"), ("hardness", "6")];
    let cells = new.map(|(column, value)| (column.to_owned(), value.to_owned())).to_vec();
    same_after(
        "paper",
        &[
            set("SQUAT", "height", "16"),
            Edit::Add("robots".to_owned(), "ROLL".to_owned(), cells),
            set("ROLL", "hardness", "1.5"),
            Edit::Remove("robots".to_owned(), "ROLL".to_owned()),
            set("STAND", "width", "4"),
        ],
    );
}

#[test]
fn rooms_by_state() {
    same_after(
        "hospital",
        &[set("SQUAT", "hardness", "9"), set("SQUAT", "hardness", "2"), set("SQUAT", "hardness", "4")],
    );
}

#[test]
fn by_state_the_next_route_knows_the_edit_and_kept_routes_follow_when_they_are_asked_to() {
    let (site, plain) = (TestSite::example("hospital").built(), TestSite::example("hospital").built());
    let mut live = Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap();
    let ward = ["ward 6".to_owned()];
    let status = || site.sqlite3("SELECT status FROM route WHERE start = 'dock' AND goal = 'ward 6'");
    for (state, hardness) in [("SIDE-STAND", "8"), ("STAND", "1.5"), ("SIDE-STAND", "2")] {
        let edit = set(state, "hardness", hardness);
        assert!(live.edit(&edit, &author()).unwrap().routes_due);
        KnowledgeBase::open(plain.path()).unwrap().edit(&edit, &author(), false, &Silent).unwrap();
        let expected = KnowledgeBase::open(plain.path()).unwrap().route("dock", "ward 6", None).unwrap();
        let found = live.route("dock", &ward, None).unwrap();
        let cost = expected.cost.unwrap();
        // a search for one goal and one for all may settle on stops some centimetres apart, which cost alike
        assert!((found.cost.unwrap() - cost).abs() < 1e-4 * cost, "{} and {cost}", found.cost.unwrap());
        assert_eq!(found.generation, expected.generation);
        assert_eq!(status(), ["stale"]);
    }
    assert!(live.renew_routes().unwrap() > 0);
    assert_eq!(status(), ["ok"]);
    assert_eq!(live.renew_routes().unwrap(), 0, "nothing is due");
}

fn tell(class: &str, object: &str, property: &str, value: &str) -> Edit {
    let [class, object, property, value] = [class, object, property, value].map(str::to_owned);
    Edit::Tell(Tell { class, object, property, value, ..Tell::default() })
}

#[test]
fn facts_that_are_told_and_retracted() {
    same_after(
        "paper",
        &[
            tell("doors", "door 7", "passable", "false"),
            tell("doors", "door 7", "passable", "false"),
            tell("doors", "door 3", "hardness", "99"),
            Edit::Retract(1),
            Edit::Retract(2),
            tell("rooms", "room d", "action", "TIPTOE"),
            tell("robots", "SQUAT", "hardness", "3"),
            set("SQUAT", "hardness", "8"),
            Edit::Retract(5),
            tell("doors", "door 7", "passable", "perhaps"),
            tell("doors", "door 3", "hardness", "-1"),
            tell("robots", "SQUAT", "height", "16"),
            Edit::Undo(None),
            Edit::Retract(99),
            Edit::Undo(Some(1)),
            Edit::Retract(3),
            Edit::Retract(4),
        ],
    );
    same_after(
        "hospital",
        &[
            tell("rooms", "5,5", "hardness", "30"),
            tell("rooms", "5,5", "hardness", "2"),
            Edit::Retract(1),
            Edit::Undo(None),
            Edit::Retract(2),
        ],
    );
}

/// The paper's rooms have no hardness by themselves.
const ROOMS_BY_HARDNESS: &str = r#"
revise "rooms of the middle are harder"
    each room in ROOMS where room.x1 < 60.0
    set room.hardness by * 2.0 level 10

rule "hard rooms are not entered, and those of which nothing is known"
    each room in ROOMS where !known(room.hardness) || room.hardness > 20.0
    then { room.passable = false; }
"#;

/// The paper's example with these rules about what facts give, and what of it is there before anything is told.
fn with_rules_of_what_is_told() -> (TestSite, Vec<String>) {
    let site = TestSite::example("paper");
    site.copy_rules("paper");
    site.write("rules/told.rhai", ROOMS_BY_HARDNESS);
    let site = site.built();
    let before = derived(&site);
    (site, before)
}

/// What follows from all that is told.
fn derived(site: &TestSite) -> Vec<String> {
    ["rooms", "doors", "witnesses", "derivations"]
        .iter()
        .flat_map(|table| site.sqlite3(&format!("SELECT * FROM {table}")))
        .collect()
}

#[test]
fn a_property_of_which_nothing_is_told_any_more_is_as_if_it_had_never_been_told() {
    let (site, before) = with_rules_of_what_is_told();
    let mut live = Live::open(at_one_moment(&site)).unwrap();
    live.edit(&tell("rooms", "room d", "hardness", "9"), &author()).unwrap();
    assert_ne!(derived(&site), before);
    live.edit(&Edit::Retract(1), &author()).unwrap();
    assert_eq!(derived(&site), before);
}

#[test]
fn a_property_of_which_nothing_is_told_any_more_may_hold_values_of_another_type() {
    let site = TestSite::example("paper").built();
    let mut live = Live::open(at_one_moment(&site)).unwrap();
    for (value, id) in ["true", "7", "gum"].into_iter().zip(1..) {
        let Edit::Tell(told) = tell("rooms", "room d", "sticks", value) else { unreachable!() };
        live.edit(&Edit::Tell(Tell { new_property: true, ..told }), &author()).unwrap();
        live.edit(&Edit::Retract(id), &author()).unwrap();
    }
}

#[test]
fn a_refused_fact_about_a_new_property_leaves_no_trace() {
    let (site, _) = with_rules_of_what_is_told();
    let mut live = Live::open(at_one_moment(&site)).unwrap();
    live.edit(&tell("rooms", "room d", "hardness", "-9"), &author()).unwrap_err();
    live.edit(&set("SQUAT", "hardness", "3"), &author()).unwrap();
    let held = derived(&site);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(held, derived(&site));
}

#[test]
fn facts_about_named_doors_and_areas() {
    let named = "name = \"named\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\n[[door]]\nname = \"gate\"\nfrom = [6.0, 3.0]\n\
                 to = [6.0, 4.0]\nhardness = 3.0\n[[area]]\nname = \"east\"\nrect = [6.5, 0.0, 12.0, 8.0]\n";
    let edits = [
        tell("named_doors", "gate", "closed", "true"),
        tell("areas", "east", "hardness_factor", "3"),
        tell("named_doors", "gate", "hardness", "9"),
        Edit::Retract(1),
        Edit::Retract(3),
        Edit::Retract(2),
    ];
    let site = || TestSite::example("starter").with("site.toml", named).built();
    same_for((site(), site()), "starter", &edits);
    let held = site();
    let mut live = Live::open(at_one_moment(&held)).unwrap();
    assert!(!live.edit(&edits[0], &author()).unwrap().anew, "a door is closed without a build");
    assert!(!live.edit(&Edit::Retract(1), &author()).unwrap().anew);
}

#[test]
fn tunings_that_are_switched() {
    let night = |value: &str| {
        let cell = ["robots", "SQUAT", "hardness", value].map(str::to_owned);
        Edit::SetInTuning("night".to_owned(), cell)
    };
    let switch = |on| Edit::Switch("night".to_owned(), on);
    same_after(
        "paper",
        &[
            night("3"),
            switch(true),
            night("2.5"),
            set("SQUAT", "hardness", "9"),
            switch(false),
            Edit::Undo(None),
        ],
    );
}

/// A commit that fails, since another program holds the file for reading, leaves database and memory as before.
#[test]
fn a_commit_that_fails_leaves_everything_as_it_was() {
    let (plain, held) = (TestSite::example("paper").built(), TestSite::example("paper").built());
    let mut live = Live::open(at_one_moment(&held)).unwrap();
    let before = content(&held);
    let mut reader = adit_db::Store::open_read_only(held.path().join("site.db")).unwrap();
    let failed = reader.snapshot(|tx| -> adit_db::Result<_> {
        tx.rooms()?;
        Ok(live.edit(&tell("doors", "door 7", "passable", "false"), &author()))
    });
    assert!(failed.unwrap().unwrap_err().to_string().contains("locked"));
    assert_eq!(content(&held), before);
    let edits =
        [set("SQUAT", "hardness", "3"), tell("doors", "door 3", "passable", "false"), Edit::Undo(None)];
    let site = at_one_moment(&plain);
    for edit in edits {
        site.edit(&edit, &author(), false, &Silent).unwrap();
        assert!(!live.edit(&edit, &author()).unwrap().anew, "{edit:?}");
        assert_eq!(content(&held), content(&plain), "{edit:?}");
    }
}

#[test]
fn an_edit_by_another_program_is_seen() {
    let site = TestSite::example("paper").built();
    let mut live = Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap();
    site.adit("tune", &["robots", "SQUAT", "hardness", "3"]).expect_status(0);
    let outcome = live.edit(&set("LIE-FACE-DOWN", "hardness", "2.5"), &author()).unwrap();
    assert!(outcome.anew);
    assert!(!live.edit(&set("LIE-FACE-DOWN", "hardness", "8"), &author()).unwrap().anew);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["3.0"]);
}
