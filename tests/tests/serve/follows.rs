//! Kept routes follow while edits and questions go on.

use std::process::Command;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::service::Service;

use super::{cost, hardness};

#[test]
fn by_state_an_answer_is_right_at_once_and_sql_soon_after() {
    let site = TestSite::example("clinic").built();
    let service = Service::start(&site);
    let before = cost(&service, "dock", "ward%2012").unwrap();
    service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 4.4)));
    let now = cost(&service, "dock", "ward%2012").unwrap();
    assert!(now > before);
    let query = "SELECT status, cost FROM route WHERE start = 'dock' AND goal = 'ward 12'";
    let began = Instant::now();
    loop {
        let row = site.sqlite3(query).remove(0);
        let (status, stored) = row.split_once('|').unwrap();
        if status == "ok" {
            assert!((stored.parse::<f64>().unwrap() - now).abs() < 1e-6, "{row} is not {now}");
            break;
        }
        assert_eq!(status, "stale");
        assert!(began.elapsed() < Duration::from_mins(1), "kept routes never follow");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_map_that_is_edited_while_it_is_served_is_cut_anew() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let (_, before) = service.ask("GET", "/api/site", None);
    let mut events = service.events();
    events.next("hello");
    site.edit("map.toml", "height = 15.0", "height = 9.0");
    let changed = events.next("changed");
    let (_, now) = service.ask("GET", "/api/site", None);
    assert!(now["generation"].as_u64() > before["generation"].as_u64() && changed["anew"] == true);
    site.edit("map.toml", "height = 9.0", "hight = 9.0");
    let said = events.next("problems");
    assert_eq!(said["problems"][0]["code"], "map/unknown-key", "{said}");
    let (_, still) = service.ask("GET", "/api/site", None);
    assert_eq!(
        (&still["generation"], still["problems"].as_array().unwrap().len()),
        (&now["generation"], said["problems"].as_array().unwrap().len())
    );
}

/// A table that no rule reads is somebody's all the same: a program that drives vehicles waits for its goals.
#[test]
fn an_edit_from_the_shell_from_which_nothing_follows_is_heard_of() {
    let site = TestSite::example("paper");
    site.write("tables/vehicles.csv", "vehicle,goal\nv1,e\n");
    let site = site.built();
    let service = Service::start(&site);
    let mut events = service.events();
    let hello = events.next("hello");
    site.adit("tune", &["vehicles", "v1", "goal", "f"]).expect_status(0);
    let changed = events.next("changed");
    assert_eq!((&changed["who"], &changed["rooms"]), (&"cli".into(), &0.into()), "{changed}");
    assert!(changed["generation"].as_u64() > hello["generation"].as_u64(), "{changed}");
    site.adit("undo", &[]).expect_status(0);
    assert!(events.next("changed")["generation"].as_u64() > changed["generation"].as_u64());
}

#[test]
fn a_database_is_served_by_one_service_at_a_time() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    Service::refused(&site, &["--listen", "127.0.0.1:0"])
        .expect_status(2)
        .complains(&["database/served", "site.db already"]);
    // whoever edits from the shell is no service
    site.adit("tune", &["robots", "SQUAT", "hardness", "3"]).expect_status(0);
    service.kill();
    Service::start(&site).end();
}

/// What another program wrote keeps the site from being derived: whoever edits over HTTP can take it away, and nothing is lost.
#[test]
fn an_edit_mends_what_another_program_wrote_and_rules_cannot_take() {
    let site =
        TestSite::example("starter").with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n");
    let site = site.built();
    let service = Service::start(&site);
    let before = cost(&service, "home", "window");
    let mut events = service.events();
    let wrong = "INSERT INTO laid (name, what, kind, outline, properties, why) VALUES \
                 ('bad', 'area', 'floor', '[[7,1],[8,1],[8,2],[7,2]]', '{\"hardness_factor\":-3}', '')";
    let wrote = Command::new("sqlite3").arg(site.path().join("site.db")).arg(wrong).status();
    assert!(wrote.unwrap().success());
    let said = events.next("problems");
    assert_eq!(said["problems"][0]["code"], "rule/hardness", "{said}");
    assert_eq!(
        service.ask("POST", "/api/edits", Some(&hardness("STAND", 1.5))).0,
        422,
        "it cannot be derived"
    );
    let (status, lifted) = service.ask("DELETE", "/api/areas/bad", None);
    assert_eq!(status, 200, "{lifted}");
    assert_eq!(cost(&service, "home", "window"), before);
    loop {
        let said = events.next("problems");
        if said["problems"].as_array().unwrap().is_empty() {
            break;
        }
    }
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("STAND", 1.5))).0, 200);
}
