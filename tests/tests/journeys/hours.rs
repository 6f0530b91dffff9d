//! Opening hours are facts with times: rules read what is open, and routes go stale when that changes.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test
#![allow(clippy::float_cmp)] // the same site at the same moment answers to the bit

use adit_tests::TestSite;

const RULE: &str = "revise \"out of hours, the corridor is hard\"\n    each room in ROOMS\n    \
                    some hours in HOURS where hours.name == \"corridor\" && !hours.open\n    \
                    set room.hardness by * 10.0 level 10\n";

const HOURS: &str = "timezone = \"Europe/Berlin\"\n[[hours]]\nname = \"corridor\"\ndays = \"mon-fri\"\n\
                     opens = \"08:00\"\ncloses = \"18:00\"\n";

/// A site whose rooms are ten times as hard out of hours.
fn with_hours(hours: &str) -> TestSite {
    let site = TestSite::example("starter");
    let [map, robots] = ["map.toml", "robots.toml"];
    site.write("site.toml", format!("map = \"{map}\"\nrobots = \"{robots}\"\n{hours}"));
    site.copy_rules("by-state");
    site.write("rules/hours.rhai", RULE);
    site
}

fn cost(site: &TestSite, at: &str) -> f64 {
    let answer = site.adit("route", &["home", "window", "--json", "--at", at]).expecting(0).json();
    answer["cost"].as_f64().unwrap()
}

#[test]
fn what_is_open_then_is_what_counts_then() {
    let site = with_hours(HOURS).built();
    // 2026-11-20 is a Friday
    let (open, shut) = (cost(&site, "2026-11-20T08:00"), cost(&site, "2026-11-20T18:00"));
    assert!(shut > 5.0 * open, "{open} {shut}");
    // a kept route and one found for the question may differ in where a shape is changed
    let same = |one: f64, other: f64| (one / other - 1.0).abs() < 0.01;
    assert!(same(cost(&site, "2026-11-20T07:59"), shut));
    assert!(same(cost(&site, "2026-11-21T12:00"), shut), "Saturday");
    assert!(same(cost(&site, "2026-11-20T07:00:00Z"), open), "07:00 in UTC is 08:00 there");
}

#[test]
fn a_build_holds_up_to_the_next_change() {
    let site = with_hours(HOURS);
    site.adit("build", &["--at", "2026-11-20T12:00"]).expect_status(0);
    let until = "SELECT value FROM site WHERE key = 'valid_until'";
    assert_eq!(site.sqlite3(until), ["2026-11-20T17:00:00Z"]);
    site.adit("build", &["--at", "2026-11-20T18:00"]).expect_status(0);
    assert_eq!(site.sqlite3(until), ["2026-11-23T07:00:00Z"]);
    site.adit("build", &["--at", "2020-01-06T12:00"]).expect_status(0);
    let status = "SELECT status FROM route WHERE start = 'home' AND goal = 'window'";
    assert_eq!(site.sqlite3(status), ["stale"], "what held in 2020 is over");
    site.adit("route", &["home", "window"]).expect_status(0);
    assert_eq!(site.sqlite3(status), ["ok"]);
    site.adit("build", &["--at", "3 days"]).expect_status(0);
    assert_eq!(site.sqlite3(status), ["stale"], "what will hold in three days does not hold yet");
}

#[test]
fn hours_are_also_a_table_that_is_tuned_and_undone() {
    let site = with_hours("").built();
    let open = cost(&site, "2026-11-21T12:00");
    let add = ["hours", "corridor/mon-sun/13:00", "--add", "closes=14:00"];
    site.adit("tune", &add).expect_status(0);
    assert!(cost(&site, "2026-11-21T12:00") > 5.0 * open);
    assert_eq!(cost(&site, "2026-11-21T13:30"), open);
    let hours = "SELECT name, days, opens, closes, source FROM opening_hours";
    assert_eq!(site.sqlite3(hours), ["corridor|mon-sun|13:00|14:00|hours"]);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(cost(&site, "2026-11-21T12:00"), open);
    let backwards = ["hours", "corridor/mon-sun/22:00", "--add", "closes=06:00"];
    site.adit("tune", &backwards).expecting(2).complains(&["hours end before they begin", "two rows"]);
    let someday = ["hours", "corridor/someday/12:00", "--add", "closes=13:00"];
    site.adit("tune", &someday).expecting(2).complains(&["`corridor`", "`someday` is no day"]);
    assert!(site.sqlite3("SELECT * FROM hours").is_empty());
}

#[test]
fn hours_may_be_told_otherwise_for_a_while() {
    let site = with_hours(HOURS).built();
    let open = cost(&site, "2026-11-20T12:00");
    let tell = ["HOURS", "corridor", "open", "false", "--at", "2026-11-20T10:00", "--until", "13:00"];
    site.adit("tell", &tell).expect_status(0);
    assert!(cost(&site, "2026-11-20T12:00") > 5.0 * open);
    assert_eq!(cost(&site, "2026-11-20T13:00"), open);
}

#[test]
fn hours_that_cannot_be_are_shown_at_their_place() {
    for (wrong, said) in [
        (
            "closes = \"07:00\"",
            "the hours of `corridor` end before they begin: they open at 08:00 and close at 07:00",
        ),
        ("closes = \"08:00\"", "end before they begin"),
        ("closes = \"25:00\"", "`25:00` is no time from 00:00 to 24:00"),
        ("closes = 18", "must be a text in quotes"),
        ("shuts = \"18:00\"", "`shuts` is not a key of [[hours]]"),
    ] {
        let site = with_hours(&HOURS.replace("closes = \"18:00\"", wrong));
        let ran = site.adit("build", &["--json"]).expecting(2);
        ran.complains(&[said]);
        assert_eq!(ran.json()["error"][0]["line"], 9, "{wrong}");
    }
    with_hours(&HOURS.replace("mon-fri", "mon-fry"))
        .adit("build", &[])
        .expecting(2)
        .complains(&["`fry` is no day"]);
    let zone = HOURS.replace("Europe/Berlin", "Europe/Berlim");
    with_hours(&zone).adit("build", &[]).expecting(2).complains(&["did you mean `Europe/Berlin`?"]);
}

#[test]
fn a_site_with_hours_and_without_a_time_zone_says_how_they_are_read() {
    let site = with_hours(&HOURS.replace("timezone = \"Europe/Berlin\"\n", ""));
    site.adit("build", &[]).expecting(0).complains(&["opening hours are read in UTC"]);
}

#[test]
fn a_named_door_and_a_named_area_are_shut_out_of_hours() {
    for (named, kind) in [
        ("[[door]]\nname = \"corridor\"\nfrom = [6.0, 3.0]\nto = [6.0, 4.0]\n", "NAMED_DOORS"),
        ("[[area]]\nname = \"corridor\"\nrect = [6.5, 0.0, 12.0, 8.0]\n", "AREAS"),
    ] {
        let site = TestSite::example("starter");
        site.write("site.toml", format!("map = \"map.toml\"\nrobots = \"robots.toml\"\n{HOURS}{named}"));
        let site = site.built();
        let route = |at: &str| site.adit("route", &["home", "11,2", "--at", at]).status;
        assert_eq!((route("2026-11-20T12:00"), route("2026-11-20T19:00")), (0, 1), "{kind}");
    }
}

#[test]
fn who_opens_what_its_hours_shut_is_told_that_they_count_no_more() {
    let site = TestSite::example("starter");
    let door = "[[door]]\nname = \"ward door\"\nfrom = [6.0, 3.0]\nto = [6.0, 4.0]\n";
    let hours = "[[hours]]\nname = \"ward door\"\ndays = \"sun\"\nopens = \"00:00\"\ncloses = \"00:01\"\n";
    site.write(
        "site.toml",
        format!("map = \"map.toml\"\nrobots = \"robots.toml\"\ntimezone = \"UTC\"\n{door}{hours}"),
    );
    let site = site.built();
    let status = || site.sqlite3("SELECT status FROM route WHERE start = 'home' AND goal = 'window'");
    assert_eq!(status(), ["no_route"]);
    let opened = site.adit("open", &["ward door"]).expecting(0);
    opened.complains(&[
        "ward door is open from now on whatever its opening hours say",
        "once fact 1 is taken back",
    ]);
    assert_eq!(status(), ["ok"]);
    site.adit("tell", &["--retract", "1"]).expect_status(0);
    assert_eq!(status(), ["no_route"]);
}
