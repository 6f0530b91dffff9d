//! What a service keeps, and how that is followed. The rest is in `requests.rs`.

mod closings;
mod disk;
mod edits;
mod events;
mod follows;
mod late;
pub mod rules;
mod shares;
mod soak;

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use adit_tests::TestSite;
use adit_tests::service::Service;

/// One of the examples, served; the site's folder goes with the first.
pub fn served(example: &str) -> (TestSite, Service) {
    let site = TestSite::example(example).built();
    let service = Service::start(&site);
    (site, service)
}

/// The cost of a route; none where there is none.
pub fn cost(service: &Service, start: &str, goal: &str) -> Option<f64> {
    let (status, answer) = service.ask("GET", &format!("/api/route?start={start}&goal={goal}"), None);
    assert_eq!(status, 200, "{answer}");
    answer["cost"].as_f64()
}

/// An edit of one cell of the paper's robot.
pub fn hardness(state: &str, value: f64) -> Value {
    json!({"edit": {"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value}})
}

/// Waits for at most a second until something is so.
#[track_caller]
pub fn within_a_second(mut is_so: impl FnMut() -> bool) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < Duration::from_secs(1), "it is not so within a second");
        std::thread::sleep(Duration::from_millis(20));
    }
}
