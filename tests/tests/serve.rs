//! The service as an integrator, a robot and an attacker meet it.
#![allow(clippy::unwrap_used)]

#[path = "serve/closings.rs"]
mod closings;
#[path = "serve/described.rs"]
mod described;
#[path = "serve/disk.rs"]
mod disk;
#[path = "serve/edits.rs"]
mod edits;
#[path = "serve/errands.rs"]
mod errands;
#[path = "serve/events.rs"]
mod events;
#[path = "serve/failures.rs"]
mod failures;
#[path = "serve/floor.rs"]
mod floor;
#[path = "serve/follow.rs"]
mod follow;
#[path = "serve/follows.rs"]
mod follows;
#[path = "serve/hostile.rs"]
mod hostile;
#[path = "serve/late.rs"]
mod late;
#[path = "serve/roles.rs"]
mod roles;
#[path = "serve/rules.rs"]
mod rules;
#[path = "serve/shares.rs"]
mod shares;
#[path = "serve/sql.rs"]
mod sql;

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use adit_tests::TestSite;
use adit_tests::service::Service;

/// One of the examples, served; the site's folder goes with the first.
fn served(example: &str) -> (TestSite, Service) {
    let site = TestSite::example(example).built();
    let service = Service::start(&site);
    (site, service)
}

/// The cost of a route; none where there is none.
fn cost(service: &Service, start: &str, goal: &str) -> Option<f64> {
    let (status, answer) = service.ask("GET", &format!("/api/route?start={start}&goal={goal}"), None);
    assert_eq!(status, 200, "{answer}");
    answer["cost"].as_f64()
}

/// An edit of one cell of the paper's robot.
fn hardness(state: &str, value: f64) -> Value {
    json!({"edit": {"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value}})
}

/// Waits for at most a second until something is so.
#[track_caller]
fn within_a_second(mut is_so: impl FnMut() -> bool) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < Duration::from_secs(1), "it is not so within a second");
        std::thread::sleep(Duration::from_millis(20));
    }
}
