//! The service is killed while many edit.

use std::sync::Mutex;
use std::thread;
use std::time::Duration;

use adit_tests::oracle::random::Chance;
use adit_tests::service::Service;

use crate::people::People;
use crate::starter;

/// Kills it so often, at any moment; each time a service begins with what the one before has left.
fn killed(times: usize, seed: u64) {
    let site = starter();
    let (mut chance, acknowledged) = (Chance::new(seed), Mutex::new(Vec::<String>::new()));
    let note = |edit: i64| acknowledged.lock().unwrap().push(edit.to_string());
    for round in 0..times {
        let service = Service::start(&site);
        let address = service.address.clone();
        thread::scope(|scope| {
            let people = People { address: &address, day: format!("day {round}"), acknowledged: &note };
            scope.spawn(move || people.edit(usize::MAX));
            thread::sleep(Duration::from_millis(100 + chance.below(600) as u64));
            service.kill();
        });
        let there = site.sqlite3("SELECT id FROM history");
        let lost: Vec<_> =
            acknowledged.lock().unwrap().iter().filter(|edit| !there.contains(edit)).cloned().collect();
        assert_eq!(lost, [""; 0], "round {round}");
        assert_eq!(site.sqlite3("PRAGMA integrity_check; PRAGMA foreign_key_check"), ["ok"], "round {round}");
        // the cell that one of them edits has the value of the last edit of it that is there
        let cell = "SELECT hardness FROM robots WHERE state = 'SQUAT'";
        let last = "SELECT ifnull((SELECT new FROM history WHERE key = 'robot/SQUAT' ORDER BY id DESC LIMIT 1), 4.0)";
        assert_eq!(site.sqlite3(cell), site.sqlite3(last), "round {round}");
    }
    let edits = acknowledged.into_inner().unwrap().len();
    eprintln!("{edits} edits were acknowledged, and {times} services killed");
    assert!(edits > times, "{edits} edits in {times} rounds");
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn a_service_that_is_killed_while_many_edit_loses_nothing_acknowledged() {
    killed(3, 7);
}

#[test]
#[ignore = "takes two minutes; by hand: cargo test --workspace --test power -- --ignored"]
fn two_hundred_kills_lose_nothing_acknowledged() {
    killed(200, 8);
}
