//! Kept routes follow while edits and questions go on.

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
