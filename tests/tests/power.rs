//! What is left when the power goes, and when the disk is full: every file that the program writes goes over a disk of the
//! tests, which writes down what comes, and what of it is synced.
#![allow(clippy::unwrap_used)]

#[path = "power/commands.rs"]
mod commands;
#[path = "power/disk.rs"]
mod disk;
#[path = "power/full.rs"]
mod full;
#[path = "power/judge.rs"]
mod judge;
#[path = "power/kills.rs"]
mod kills;
#[path = "power/migrations.rs"]
mod migrations;
#[path = "power/people.rs"]
mod people;
#[path = "power/serving.rs"]
mod serving;
#[path = "power/tape.rs"]
mod tape;

use adit_tests::TestSite;

/// The small floor that sites begin with, built: two spaces with a doorway, and three states.
fn starter() -> TestSite {
    let site = TestSite::example("starter");
    site.with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n").built()
}
