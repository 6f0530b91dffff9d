//! What a robot senses, and how its navigator is set, is said by the site.

use adit_tests::TestSite;
use serde_json::Value;

const SONAR: &str = "\n[sensors]\ndirections = 120\nat_once = 1\nperiod = 0.05\nrange = 8.0\n\n[navigation]\npatience = 1800\n";

fn said(more: &str) -> TestSite {
    let site = TestSite::example("clinic");
    let text = site.read("site.toml");
    site.write("site.toml", &(text + more));
    site
}

fn mission(site: &TestSite) -> Value {
    site.adit("simulate", &["dock", "lobby", "--json"]).json()[0].clone()
}

#[test]
fn a_sonar_that_turns_takes_longer_to_look_around_than_a_lidar_and_both_arrive() {
    let [by_sonar, by_lidar] = [SONAR, ""].map(|more| mission(&said(more).built()));
    for mission in [&by_sonar, &by_lidar] {
        assert_eq!((&mission["ending"], &mission["right"]), (&"arrived".into(), &true.into()), "{mission}");
    }
    let seconds = |mission: &Value| mission["seconds"].as_f64().expect("seconds");
    assert!(seconds(&by_sonar) > 1.3 * seconds(&by_lidar), "{by_sonar} {by_lidar}");
}

#[test]
fn figures_are_cells_of_tables_that_are_tuned_and_undone() {
    let site = said(SONAR).built();
    let figures =
        "SELECT figure, value, unit FROM sensors WHERE figure IN ('at_once', 'range', 'skirt') ORDER BY 1";
    assert_eq!(site.sqlite3(figures), ["at_once|1.0|", "range|8.0|m", "skirt|1.0|"]);
    assert_eq!(site.sqlite3("SELECT value FROM navigation WHERE figure = 'patience'"), ["1800.0"]);
    site.adit("tune", &["navigation", "patience", "value", "3"]).expect_status(0);
    assert_eq!(mission(&site)["ending"], "gave_up");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(mission(&site)["ending"], "arrived");
    for (figure, value, expected) in
        [("noise", "2", "at most 1"), ("directions", "0", "from 1 on"), ("skirt", "2", "1 (yes) or 0 (no)")]
    {
        site.adit("tune", &["sensors", figure, "value", value]).expecting(2).complains(&[figure, expected]);
    }
    // more directions at once than there are
    site.adit("tune", &["sensors", "at_once", "value", "121"])
        .expecting(2)
        .complains(&["at_once", "121", "120"]);
}

#[test]
fn a_figure_that_is_none_is_shown_where_it_stands() {
    for (more, said_of_it) in [
        ("\n[sensors]\nrnage = 8\n", &["site.toml", "rnage", "range"][..]),
        ("\n[sensors]\nrange = -1\n", &["site.toml", "range", "more than 0"]),
        ("\n[navigation]\nspeed = 1\n", &["site.toml", "speed"]),
    ] {
        said(more).adit("build", &[]).expecting(2).complains(said_of_it);
    }
}
