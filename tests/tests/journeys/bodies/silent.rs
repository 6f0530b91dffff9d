//! Bodies that fall silent, lie or say nonsense: the mission ends in words, and what is kept of it is whole.

use std::sync::Mutex;
use std::thread;

use adit_tests::TestSite;

use super::{faulty, floor};

/// What befalls a body on its mission, and words that say what was found and what was expected.
const BEFALLS: [(&str, &[&str]); 10] = [
    ("falls_silent", &["`sense` was not answered within 2 s"]),
    ("exits", &["it ended before it answered `sense`", "exit status: 3"]),
    ("nan", &["expected value", "`{\"type\": \"sensed\", \"time_s\": NaN"]),
    ("text", &["expected value", "`I am at the door`"]),
    ("half_a_line", &["it ended within a line", "`{\"type\": \"sensed\""]),
    ("endless", &["a line is longer than 1048576 bytes", "`xxxxx"]),
    ("many_readings", &["there are 600 readings, expected at most 120", "in the line `{\"type\""]),
    ("no_such_shape", &["the shape is `LIE`, expected one of STAND, SIDE-STAND, SQUAT"]),
    ("talks", &["the body answered `sense` with `accepted`, expected `sensed`"]),
    ("wide", &["the radius of the body is 0.6 m in the shape `STAND`, and ways are found for 0.3 m"]),
];

/// Drives a mission that ends since the robot is not heard any more.
fn silent(site: &TestSite, body: &str, words: &[&str]) {
    let ran =
        site.adit("drive", &["home", "window", "--keep", "--timeout", "2", "--body", body]).expect_status(1);
    for word in words {
        assert!(
            ran.stdout.contains("it was not heard any more: ") && ran.stdout.contains(word),
            "{body}: {}",
            ran.stdout
        );
    }
    let kept = "SELECT ending, (SELECT group_concat(event) FROM (SELECT event FROM journal ORDER BY entry DESC LIMIT 2)) FROM missions";
    assert_eq!(site.sqlite3(kept), ["silent|ended,silent"], "{body}");
    assert_eq!(site.sqlite3("PRAGMA integrity_check"), ["ok"], "{body}");
    let said = site.sqlite3("SELECT json_extract(detail, '$.why') FROM journal WHERE event = 'silent'");
    assert!(words.iter().all(|word| said.concat().contains(word)), "{body}: {said:?}");
}

#[test]
fn whatever_befalls_a_body_the_mission_ends_in_words_and_its_journal_is_whole() {
    let site = floor();
    let left = Mutex::new(BEFALLS.iter());
    let drive = || {
        loop {
            let next = left.lock().expect("no mission panics with it").next();
            let Some((fault, words)) = next else { break };
            silent(&site.copied(), &faulty(&site, fault), words);
        }
    };
    thread::scope(|threads| {
        for _ in 0..4 {
            threads.spawn(drive);
        }
    });
}

#[test]
fn a_body_that_is_not_there_is_a_mission_that_was_silent_from_the_beginning() {
    let site = floor();
    silent(&site.copied(), "no-such-robot --now", &["cannot start `no-such-robot`: No such file"]);
    silent(&site.copied(), "tcp://127.0.0.1:1", &["cannot connect to tcp://127.0.0.1:1"]);
    silent(&site, "true", &["it ended before it answered `hello`"]);
    site.adit("why", &["mission 1"])
        .complains(&["had decided nothing", "it was not heard any more: it ended"]);
}

#[test]
fn why_tells_of_the_silence_and_programs_read_it() {
    let site = floor();
    let body = faulty(&site, "exits");
    let ran =
        site.adit("drive", &["home", "window", "--keep", "--json", "--body", &body]).expect_status(1).json();
    assert_eq!(ran["ending"], "silent");
    assert!(ran["silence"].as_str().expect("words").contains("exit status: 3"), "{ran}");
    let why = site.adit("why", &["mission 1"]).expect_status(0).stdout;
    assert!(
        why.contains("it was not heard any more, after")
            && why.contains("s  it was not heard any more: it ended"),
        "{why}"
    );
}
