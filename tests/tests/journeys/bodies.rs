//! Robots that are heard by lines of JSON: ours and others' drive the routes of sites, adapters are checked, and what is wrong with
//! one is found.

mod checked;
mod driven;
mod silent;

use std::path::Path;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

/// A small floor with a pipe across it: who goes from `home` to `window` has to squat beneath that.
fn floor() -> TestSite {
    TestSite::example("starter")
        .with(
            "site.toml",
            "name = \"floor\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
        )
        .built()
}

fn quoted(path: &Path) -> String {
    format!("'{}'", path.display())
}

/// Our simulated robot at a place of a site.
fn simulated(site: &TestSite, start: &str, more: &str) -> String {
    format!("{} body {} '{start}' {more}", quoted(adit()), quoted(site.path()))
}

/// The body that is written in Python, at `home`.
fn in_python(site: &TestSite, more: &str) -> String {
    let program = repository().join("kb/bodies/disc.py");
    format!("python3 {} {} 1 4 {more}", quoted(&program), quoted(site.path()))
}

/// The same with a fault.
fn faulty(site: &TestSite, fault: &str) -> String {
    let program = repository().join("tests/bodies/faulty.py");
    format!("python3 {} {fault} {} 1 4", quoted(&program), quoted(site.path()))
}

/// Checks a body.
fn conform(body: &str, more: &[&str]) -> Ran {
    let ran = Command::new(adit()).arg("conform").arg(body).args(more).output();
    Ran::new(&ran.expect("adit runs"))
}
