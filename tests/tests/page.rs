//! Journeys of an expert on the page, in a real browser.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

#[path = "page/accessible.rs"]
mod accessible;
#[path = "page/ask.rs"]
mod ask;
#[path = "page/draw.rs"]
mod draw;
#[path = "page/drawn.rs"]
mod drawn;
#[path = "page/experience.rs"]
mod experience;
#[path = "page/find_out.rs"]
mod find_out;
#[path = "page/history.rs"]
mod history;
#[path = "page/keyboard.rs"]
mod keyboard;
#[path = "page/large.rs"]
mod large;
#[path = "page/latency.rs"]
mod latency;
#[path = "page/live.rs"]
mod live;
#[path = "page/robots.rs"]
mod robots;
#[path = "page/rows.rs"]
mod rows;
#[path = "page/rules.rs"]
mod rules;
#[path = "page/sentences.rs"]
mod sentences;
#[path = "page/shop.rs"]
mod shop;
#[path = "page/spoken.rs"]
mod spoken;
#[path = "page/sql.rs"]
mod sql;
#[path = "page/tune.rs"]
mod tune;
#[path = "page/tunings.rs"]
mod tunings;
#[path = "page/two.rs"]
mod two;
#[path = "page/unseen.rs"]
mod unseen;
#[path = "page/workbench.rs"]
mod workbench;

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use serde_json::{Value, json};

/// An example site, its service and its page at a desk.
async fn at_a_desk(example: &str, hash: &str) -> (TestSite, Service, Browser) {
    let site = TestSite::example(example).built();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page(hash), Screen::Desktop).await;
    (site, service, browser)
}

/// An edit of the hardness of one of the paper's states.
fn set(state: &str, value: f64) -> Value {
    json!({"edit": {"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value}})
}

/// The cell of the table of robots with this state's hardness.
fn hardness_of(state: &str) -> String {
    format!("[data-table='robots'] [data-key='robot/{state}'] input[aria-label^='hardness']")
}
