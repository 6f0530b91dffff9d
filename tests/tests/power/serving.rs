//! The power goes while a service is edited by many.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::json;

use crate::disk::files_in;
use crate::judge::{Fault, Recording, laid_out};
use crate::people::People;
use crate::starter;
use crate::tape::Recorder;

/// A service that begins, is edited, ends, begins again, is edited, and is killed.
fn recorded(disk: impl Fn(&TestSite) -> Recorder, rounds: usize) -> Recording {
    let site = starter();
    let disk = disk(&site);
    let serve = |day: &str| {
        let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
        let acknowledged = |edit| disk.acknowledged(edit);
        let people = People { address: &service.address, day: day.to_owned(), acknowledged: &acknowledged };
        assert_eq!(people.edit(rounds), 0, "of the edits some were refused");
        service
    };
    Recording::of(&site, &disk, || {
        serve("monday").end();
        serve("tuesday").kill();
    })
}

#[test]
fn a_power_cut_loses_nothing_that_a_service_acknowledged_and_leaves_no_edit_by_half() {
    let recording = recorded(Recorder::of, 3);
    assert!(recording.acknowledged() > 40, "{}", recording.acknowledged());
    assert_eq!(recording.faults_of_cuts(20, 1), []);
}

/// The same with a disk that has synced nothing of what it says it has: the judge sees it.
#[test]
fn of_a_disk_that_only_says_that_it_syncs_acknowledged_edits_are_found_lost() {
    let faults = recorded(Recorder::deaf, 1).faults_of_cuts(8, 1);
    assert!(faults.iter().any(|(fault, _)| *fault == Fault::Lost), "{faults:?}");
}

#[test]
#[ignore = "200 power cuts take a minute; by hand: cargo test --workspace --test power -- --ignored"]
fn two_hundred_power_cuts_lose_nothing() {
    let mut acknowledged = 0;
    for seed in 0..5 {
        let recording = recorded(Recorder::of, 5 + 5 * seed);
        acknowledged += recording.acknowledged();
        assert_eq!(recording.faults_of_cuts(40, 1_000 * (1 + seed as u64)), []);
    }
    eprintln!("{acknowledged} edits were acknowledged");
    assert!(acknowledged > 1_000, "{acknowledged}");
}

/// A rule's file is no part of the database: it was renamed into its place, and neither file nor folder were synced.
#[test]
fn a_power_cut_leaves_a_rule_that_was_saved_whole_and_none_older_than_acknowledged() {
    let site = starter();
    let disk = Recorder::of(&site);
    let text = |number: i64| {
        let rule = "each room in ROOMS where room.y0 < 4.0\n    set room.hardness by * 1.5 level 10\n";
        format!("revise \"draughty\"\n    {rule}// {number} {}\n", "of many ".repeat(600))
    };
    let recording = Recording::of(&site, &disk, || {
        let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
        let mut version = json!(null);
        for number in 1..=4 {
            let body = json!({"text": text(number), "version": version});
            let (status, saved) = service.ask("PUT", "/api/rules/draughty.rhai", Some(&body));
            assert_eq!(status, 200, "{saved}");
            version = saved["version"].clone();
            disk.acknowledged(number);
        }
        let path = format!("/api/rules/draughty.rhai?version={}", version.as_str().unwrap());
        assert_eq!(service.ask("DELETE", &path, None).0, 200);
        disk.acknowledged(5);
    });
    recording.after_cuts(200, |acknowledged, files| {
        let known = |number: &i64| files.get("rules/draughty.rhai") == Some(&text(*number).into_bytes());
        let is_gone = !files.contains_key("rules/draughty.rhai");
        let (first, last) = (acknowledged, acknowledged + 1);
        let is_right = (first..=last).any(|number| match number {
            0 | 5.. => is_gone,
            number => known(&number),
        });
        assert!(
            is_right,
            "after {acknowledged} were acknowledged: {:?}",
            files.get("rules/draughty.rhai").map(Vec::len)
        );
    });
}

/// What is left is opened by the program, which goes on where the power went: the rule and the cell are both of before, or both
/// of then.
#[test]
fn a_power_cut_leaves_rules_and_cells_that_were_saved_together_whole_or_not_at_all() {
    let site = starter();
    let disk = Recorder::of(&site);
    let text = |number: i64| {
        let rule = "each room in ROOMS where room.y0 < 4.0\n    set room.hardness by * 1.5 level 10\n";
        format!("revise \"draughty\"\n    {rule}// {number}\n")
    };
    let recording = Recording::of(&site, &disk, || {
        let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
        let mut version = json!(null);
        for number in 1..=4 {
            let cell = json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 10 + number});
            let rule =
                json!({"kind": "write", "file": "draughty.rhai", "text": text(number), "version": version});
            let together = json!({"edit": {"kind": "together", "edits": [cell, rule]}});
            let (status, saved) = service.ask("POST", "/api/edits", Some(&together));
            assert_eq!(status, 200, "{saved}");
            let (_, rules) = service.ask("GET", "/api/rules", None);
            let files = rules["files"].as_array().unwrap();
            version = files.iter().find(|file| file["file"] == "draughty.rhai").unwrap()["version"].clone();
            disk.acknowledged(number);
        }
    });
    recording.after_cuts(60, |acknowledged, files| {
        let left = laid_out(files);
        left.adit("check", &[]).expect_status(0);
        let cell = left.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'").join("");
        let rule = files_in(left.path()).remove("rules/draughty.rhai");
        let number =
            |number: i64| (cell == format!("{}.0", 10 + number), rule == Some(text(number).into_bytes()));
        let is_whole = match (1..=4).find(|&of| number(of) == (true, true)) {
            Some(of) => of == acknowledged || of == acknowledged + 1,
            None => acknowledged == 0 && rule.is_none() && !cell.starts_with('1'),
        };
        assert!(
            is_whole,
            "after {acknowledged} were acknowledged: {cell}, {:?}",
            rule.map(String::from_utf8)
        );
    });
}
