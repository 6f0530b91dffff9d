//! A robot learns a flat that it does not know; what it learned is kept, and used by missions and by hand.

use std::fs;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

fn flat() -> TestSite {
    let folder = TestSite::empty();
    for name in ["flat.toml", "flat.json"] {
        folder.write(name, fs::read(repository().join("kb/worlds").join(name)).expect("the flat"));
    }
    folder
}

fn simulate(folder: &TestSite, args: &[&str]) -> Ran {
    let mut command = Command::new(adit());
    command.current_dir(folder.path()).args(["simulate", "flat.toml"]).args(args);
    Ran::new(&command.output().expect("adit runs"))
}

fn sql(folder: &TestSite, query: &str) -> String {
    let mut command = Command::new("sqlite3");
    let output =
        command.args(["-readonly", "flat.db", query]).current_dir(folder.path()).output().expect("runs");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

#[test]
fn a_flat_is_learned_kept_and_driven_in() {
    let folder = flat();
    let row = simulate(&folder, &["--learn", "bed", "--db", "flat.db", "--film", "film.svg", "--json"])
        .expect_status(0)
        .json();
    assert_eq!(row["ending"], "learned");
    assert!(row["share"].as_f64().expect("a share") >= 0.95, "{row}");
    assert!(folder.read("film.svg").contains("<animate"));
    assert_eq!(sql(&folder, "SELECT world, learned FROM learned_buildings"), "flat|flat (learned)");
    let regions = "SELECT count(*) > 6 FROM floor_regions WHERE world = 'flat (learned)'";
    assert_eq!(sql(&folder, regions), "1");
    assert_eq!(sql(&folder, "SELECT count(*) > 20 FROM learned_walls WHERE world = 'flat'"), "1");

    // Another process, and every place of the flat, named by where it is.
    for goal in ["desk", "store", "hall", "kitchen", "living room", "bath"] {
        let rows = simulate(&folder, &["bed", goal, "--learned", "--db", "flat.db", "--json"])
            .expect_status(0)
            .json();
        assert_eq!(rows[0]["ending"], "arrived", "{goal}: {rows}");
    }

    folder.write("orders.txt", "start 1.5,1.5 90 # looks north\nturn -90\nforward 1\nplace by the wall\n");
    simulate(&folder, &["--learned", "--db", "flat.db", "--drive", "orders.txt"]).expect_status(0);
    assert_eq!(sql(&folder, "SELECT place, abs(x - 2.5) < 0.2 FROM learned_places"), "by the wall|1");
    let rows = simulate(&folder, &["desk", "by the wall", "--learned", "--db", "flat.db", "--json"])
        .expect_status(0)
        .json();
    assert_eq!(rows[0]["ending"], "arrived", "{rows}");

    // Learned again, it knows nothing of that name, and says so.
    simulate(&folder, &["--learn", "bed", "--db", "flat.db"])
        .expect_status(0)
        .complains(&["places that were named in what was learned before are gone: by the wall"]);
}

#[test]
fn a_drive_stops_at_the_first_order_that_fails_and_names_its_line() {
    let folder = flat();
    simulate(&folder, &["--learn", "bed", "--db", "flat.db"]).expect_status(0);
    let drive = |orders: &str, args: &[&str]| {
        folder.write("orders.txt", orders);
        simulate(&folder, &[&["--learned", "--db", "flat.db", "--drive", "orders.txt"], args].concat())
    };
    // A robot that is where it is to go has a way.
    let there = drive("start 1,1 0\ngo 1,1\n", &["--json"]).expect_status(0).json();
    assert!(there["in_vain"].is_null(), "{there}");

    let orders = "# by hand\n\nstart 1.5,1.5\nplace before\n\ngo 99,99 # far out\nplace after\n";
    let ran = drive(orders, &[]).expect_status(1);
    let said = "orders.txt:6: the robot found no way; the orders after it were not followed";
    assert!(ran.stdout.contains(said), "{}", ran.stdout);
    assert_eq!(sql(&folder, "SELECT group_concat(place) FROM learned_places"), "before");
    let ran = drive(orders, &["--json"]).expect_status(1).json();
    assert_eq!((&ran["in_vain"]["line"], &ran["in_vain"]["ending"]), (&6.into(), &"no_way".into()), "{ran}");
}

#[test]
fn orders_that_are_wrong_are_shown_with_what_was_expected() {
    let folder = flat();
    simulate(&folder, &["--learn", "bed", "--db", "flat.db"]).expect_status(0);
    folder.write("orders.txt", "start 1.5,1.5\nforward far\nfly 2\ngo nowhere\nplace\n");
    simulate(&folder, &["--learned", "--db", "flat.db", "--drive", "orders.txt"]).expect_status(2).complains(
        &[
            "found `far`, expected metres",
            "found `fly`, expected one of start",
            "found `nowhere`, expected a place (bath, ",
            "found no name",
            "orders.txt:2",
        ],
    );
}

#[test]
fn nothing_is_learned_from_within_a_wall_and_nothing_known_without_learning() {
    let folder = flat();
    simulate(&folder, &["--learn", "0,0"]).expect_status(2).complains(&["wall"]);
    simulate(&folder, &["--learn", "bedroom"]).expect_status(2).complains(&["`bedroom` is no place"]);
    simulate(&folder, &["bed", "desk", "--db", "flat.db"]).expect_status(0);
    simulate(&folder, &["bed", "desk", "--learned", "--db", "flat.db"])
        .expect_status(2)
        .complains(&["no building that was learned of the world `flat`"]);
}
