//! Sites in PostgreSQL: copied either way, served by several services, asked by SQL. Each test has a cluster of its own.
#![allow(clippy::unwrap_used)]

#[path = "postgres/copies.rs"]
mod copies;
#[path = "postgres/failures.rs"]
mod failures;
#[path = "postgres/lease.rs"]
mod lease;
#[path = "postgres/safe.rs"]
mod safe;
#[path = "postgres/several.rs"]
mod several;
#[path = "postgres/storm.rs"]
mod storm;
#[path = "postgres/thousand.rs"]
mod thousand;
#[path = "postgres/upgrade.rs"]
mod upgrade;
#[path = "postgres/views.rs"]
mod views;

use std::process::Command;
use std::time::{Duration, Instant};

use adit_tests::cluster::Cluster;
use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::{Value, json};

/// Runs `adit copy` with these arguments.
fn copy(arguments: &[&str]) -> Ran {
    Ran::new(&Command::new(adit()).arg("copy").args(arguments).output().unwrap())
}

/// A cluster with one of the example sites, which is called so.
fn with_site(example: &str) -> (Cluster, TestSite) {
    let (cluster, site) = (Cluster::start(), TestSite::example(example).built());
    copy(&[&site.path().display().to_string(), &cluster.url(example)]).expect_status(0);
    (cluster, site)
}

/// A service on a site of the cluster, in a folder of its own.
struct Served {
    service: Service,
    folder: TestSite,
}

impl Served {
    fn start(url: &str) -> Self {
        let folder = TestSite::empty();
        let service = Service::start_with(&folder, &["--listen", "127.0.0.1:0", "--database", url]);
        Self { service, folder }
    }

    /// The generation that a route is of, and its cost.
    fn cost(&self, start: &str, goal: &str) -> (i64, f64) {
        let (status, answer) =
            self.service.ask("GET", &format!("/api/route?start={start}&goal={goal}"), None);
        assert_eq!(status, 200, "{answer}");
        (answer["generation"].as_i64().unwrap(), answer["cost"].as_f64().unwrap())
    }

    fn generation(&self) -> i64 {
        self.service.ask("GET", "/api/site", None).1["generation"].as_i64().unwrap()
    }

    /// Makes an edit; the generation that it made.
    #[track_caller]
    fn edit(&self, edit: &Value) -> i64 {
        let (status, done) = self.service.ask("POST", "/api/edits", Some(edit));
        assert_eq!(status, 200, "{done}");
        done["generation"].as_i64().unwrap()
    }
}

/// An edit of one cell of the paper's robot.
fn squat(value: f64) -> Value {
    json!({"edit": {"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": value}})
}

/// Waits for at most so long until something is so; how long that was.
#[track_caller]
fn soon(most: Duration, mut is_so: impl FnMut() -> bool) -> Duration {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < most, "it is not so within {most:?}");
        std::thread::sleep(Duration::from_millis(5));
    }
    began.elapsed()
}
