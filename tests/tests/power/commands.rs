//! The power goes while commands are at work.

use adit_tests::{Ran, TestSite};

use crate::judge::Recording;
use crate::starter;
use crate::tape::Recorder;

const EDITS: [&[&str]; 6] = [
    &["tune", "robots", "SQUAT", "hardness", "3"],
    &["close", "doorway 1"],
    &["tune", "robots", "SQUAT", "hardness", "5"],
    &["undo"],
    &["open", "doorway 1"],
    &["tune", "robots", "STAND", "speed", "0.75"],
];

/// Runs `adit VERB SITE ARGUMENTS…` on the disk.
fn run(disk: &Recorder, site: &TestSite, command: &[&str]) -> Ran {
    let mut program = disk.adit();
    let program = program.arg(command[0]).arg(site.path()).args(&command[1..]);
    Ran::new(&program.output().unwrap()).expecting(0)
}

/// Edits by commands, each acknowledged when the command has ended.
fn edited() -> Recording {
    let site = starter();
    let disk = Recorder::of(&site);
    Recording::of(&site, &disk, || {
        for edit in EDITS {
            run(&disk, &site, edit);
            disk.acknowledged(site.sqlite3("SELECT max(id) FROM history")[0].parse().unwrap());
        }
    })
}

/// An edit is done when SQLite has removed its journal. That was not synced: the journal came back, and with it all as it was.
#[test]
fn a_power_cut_loses_no_edit_of_a_command_that_has_ended() {
    let recording = edited();
    assert_eq!(recording.acknowledged(), EDITS.len());
    assert_eq!(recording.faults_of_cuts(12, 2), []);
}

#[test]
#[ignore = "200 power cuts take a minute; by hand: cargo test --workspace --test power -- --ignored"]
fn two_hundred_power_cuts_lose_no_edit_of_a_command() {
    for seed in 0..5 {
        assert_eq!(edited().faults_of_cuts(40, 1_000 * (1 + seed)), []);
    }
}

fn built() -> Recording {
    let site = TestSite::example("paper");
    let disk = Recorder::of(&site);
    Recording::of(&site, &disk, || drop(run(&disk, &site, &["build"])))
}

#[test]
fn what_a_power_cut_leaves_of_a_first_build_is_built_again() {
    assert_eq!(built().faults_of_cuts(5, 3), []);
}

/// Nothing of it was synced before it took the place of the one before.
#[test]
fn a_power_cut_leaves_the_file_of_tokens_whole() {
    let site = TestSite::example("paper");
    let disk = Recorder::of(&site);
    let mut files = vec![None];
    let recording = Recording::of(&site, &disk, || {
        for (number, name) in (1..).zip(["anna", "ben", "cleo"]) {
            run(&disk, &site, &["token", "add", name]);
            disk.acknowledged(number);
            files.push(Some(site.read("tokens.toml").into_bytes()));
        }
    });
    recording.after_cuts(200, |acknowledged, left| {
        let first = acknowledged as usize;
        let is_right = files[first..].iter().take(2).any(|file| left.get("tokens.toml") == file.as_ref());
        assert!(is_right, "after {acknowledged}: {:?}", left.get("tokens.toml").map(Vec::len));
    });
}
