//! Several robots on one site at once: each drives in the way of the others, and heeds what they tell the site.

use std::collections::BTreeSet;

use adit_tests::TestSite;
use serde_json::Value;

const ARGS: [&str; 11] =
    ["--robot", "crawler", "--robots", "3", "--minutes", "4", "--doors", "3", "--seed", "3", "--tell"];

/// For each time that one told the site something while another was under way, and went on being so for a second, the seconds until
/// the other had heard of it, or asked for a way itself (after it told something, even if there was none); a minute, where it took longer. Who goes to where it can tell where it is does not listen.
const HEARD: &str = "WITH spans AS (SELECT mission, min(time) AS since, max(time) AS until FROM journal GROUP BY mission)
    SELECT min(coalesce((SELECT min(heard.time) FROM journal AS heard
        WHERE heard.event IN ('heard', 'planned', 'told') AND heard.mission = spans.mission AND heard.time >= told.time), 1e9) - told.time, 60)
    FROM journal AS told
    JOIN spans ON spans.mission <> told.mission AND spans.since <= told.time AND spans.until >= told.time + 1
    WHERE told.event = 'told'
        AND NOT EXISTS (SELECT 1 FROM journal AS sought WHERE sought.event = 'sought' AND sought.mission = spans.mission)";

fn rows(site: &TestSite) -> Vec<Value> {
    let ran = site.adit("simulate", &[&ARGS[..], &["--keep", "--json"]].concat());
    ran.expect_status(0).json().as_array().expect("rows").clone()
}

#[test]
fn three_drive_together_hear_of_each_other_and_touch_nothing_and_the_same_seed_gives_the_same() {
    let site = TestSite::example("depot").built();
    let first = rows(&site);
    let robots: BTreeSet<&str> = first.iter().filter_map(|row| row["robot"].as_str()).collect();
    assert_eq!(robots, BTreeSet::from(["crawler 1", "crawler 2", "crawler 3"]));
    assert!(first.iter().all(|row| row["collided"] == false && row["right"] != false), "{first:?}");
    assert!(first.iter().filter(|row| row["ending"] == "arrived").count() > 5, "{first:?}");
    // what one told, the others heard at once, by the clock of the simulation
    let heard = site.sqlite3(HEARD);
    assert!(!heard.is_empty(), "nobody met anything");
    assert!(heard.iter().all(|late| late.parse::<f64>().expect("seconds") <= 1.0), "{heard:?}");
    let who = site.sqlite3("SELECT DISTINCT who FROM history WHERE who LIKE 'crawler %' ORDER BY 1");
    assert!(!who.is_empty(), "nobody told the site");
    // each of them is explained, and the database is whole
    for row in &first {
        let why = site.adit("why", &[&format!("mission {}", row["mission"])]).expect_status(0).stdout;
        let by = format!(" by {}, from", row["robot"].as_str().expect("a robot"));
        assert!(why.contains(&by) && why.contains("it "), "{why}");
    }
    site.adit("doctor", &[]).expect_status(0);
    let kept: BTreeSet<String> = site.sqlite3("SELECT robot FROM missions").into_iter().collect();
    assert!(kept.iter().map(String::as_str).eq(robots.iter().copied()), "{kept:?}");
    let again = rows(&TestSite::example("depot").built());
    let ends = |rows: &[Value]| {
        rows.iter().map(|row| (row["ending"].clone(), row["length"].clone())).collect::<Vec<_>>()
    };
    assert_eq!(ends(&first), ends(&again));
}

#[test]
fn what_cannot_be_done_together_is_said() {
    let site = TestSite::example("depot").built();
    for (more, said) in [
        (&["--robots", "3"][..], &["--tell"][..]),
        (&["--minutes", "3"], &["--robots"]),
        (&["--robots", "1", "--tell"], &["1", "2"]),
        (&["--robots", "32", "--tell"], &["no room for so many robots"]),
    ] {
        site.adit("simulate", &[&["--robot", "crawler"], more].concat()).expecting(2).complains(said);
    }
}
