//! What `adit conform` says of bodies that are sound, and of such as have a fault.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::thread;

use adit_tests::{TestSite, adit};
use serde_json::Value;

use super::{conform, faulty, floor, in_python, simulated};

/// The checks that a body did not pass, and those that could not be tried.
fn failed(body: &str, more: &[&str]) -> [Vec<String>; 2] {
    let ran = conform(body, &[&["--json"], more].concat());
    let said = ran.json();
    let checks = said["checks"].as_array().expect("checks");
    assert!(checks.len() > 20, "{said}");
    let of = |held: Value| {
        let found = checks.iter().filter(|check| check["held"] == held);
        found.map(|check| check["check"].as_str().expect("a name").to_owned()).collect::<Vec<_>>()
    };
    let [not_held, not_tried] = [of(false.into()), of(Value::Null)];
    assert_eq!((ran.status, &said["held"]), (i32::from(!not_held.is_empty()), &not_held.is_empty().into()));
    [not_held, not_tried]
}

#[test]
fn our_simulator_and_the_body_in_python_do_all_that_the_protocol_asks() {
    let site = floor();
    let none = [Vec::new(), vec!["aside".to_owned()]];
    assert_eq!(failed(&simulated(&site, "home", "--seed 7"), &[]), none);
    assert_eq!(failed(&in_python(&site, ""), &[]), none);
    let words = conform(&in_python(&site, ""), &[]).expect_status(0).stdout;
    assert!(
        words.contains(" contact     held       felt at ") && words.contains("23 held, 0 not held"),
        "{words}"
    );
}

#[test]
fn a_body_that_is_longer_than_wide_goes_aside_and_keeps_its_facing() {
    let site = TestSite::example("depot");
    let robots = site.read("robots.toml");
    let (first, last) = (robots.find("state    = \"SIDE-STEP\""), robots.find("# On tracks"));
    let (Some(first), Some(last)) = (first, last) else { panic!("the dog side-steps: {robots}") };
    site.write("robots.toml", format!("[[robots]]\nrobot = \"dog\"\n{}", &robots[first..last]));
    let site = site.built();
    for start in ["2,2", "3,3", "5,2"] {
        let outcome = failed(&simulated(&site, start, "--seed 7"), &[]);
        assert_eq!(outcome, [Vec::new(), vec!["change".to_owned()]], "from {start}");
    }
}

#[test]
fn a_body_at_a_socket_is_checked_as_one_that_is_started() {
    let site = floor();
    let mut body = Command::new(adit())
        .arg("body")
        .arg(site.path())
        .args(["home", "--listen", "127.0.0.1:0"])
        .stderr(Stdio::piped())
        .spawn()
        .expect("adit runs");
    let mut said = String::new();
    BufReader::new(body.stderr.take().expect("its words")).read_line(&mut said).expect("a line");
    let address = said.trim().strip_prefix("listening at ").expect("an address").to_owned();
    // one after the other, each anew
    let outcomes = [failed(&address, &[]), failed(&address, &[])];
    body.kill().expect("ended");
    body.wait().expect("ended");
    assert_eq!(outcomes, [(); 2].map(|()| [Vec::new(), vec!["aside".to_owned()]]));
}

/// Each fault, the check that is about it, and what cannot but fail with it.
const FAULTS: [(&str, &str, &[&str]); 26] = [
    ("degrees", "angles", &["left", "right", "anew", "contact", "readings"]),
    ("clockwise_turns", "left", &["right", "bearings", "anew", "contact"]),
    ("half_turns", "right", &[]),
    ("clockwise_bearings", "bearings", &["contact"]),
    ("looks_back", "nearer", &["contact"]),
    ("half_blind", "directions", &["contact"]),
    ("millimetres", "ahead", &["back", "speed"]),
    ("never_back", "back", &[]),
    ("too_fast", "speed", &[]),
    ("never_idle", "busy", &["change"]),
    ("ignores_stop", "stop", &[]),
    ("queues", "anew", &[]),
    ("other_shape", "change", &[]),
    ("through_contact", "contact", &[]),
    ("feels_nothing", "contact", &[]),
    ("time_goes_back", "time", &[]),
    ("stale_readings", "readings", &[]),
    ("too_far", "ranges", &[]),
    ("begins_elsewhere", "rest", &[]),
    ("other_version", "hello", &[]),
    ("any_version", "version", &[]),
    ("late", "answers", &[]),
    ("mute", "answers", &[]),
    ("talks", "answers", &[]),
    ("dies_of_the_unknown", "unknown", &["answers"]),
    ("stays", "bye", &[]),
];

#[test]
fn each_fault_of_an_adapter_is_found_by_the_check_that_is_about_it_and_by_hardly_any_other() {
    let site = floor();
    // most of them wait; who is late is so by more than the others ever are
    let left = Mutex::new(FAULTS.iter());
    let check = || {
        loop {
            let next = left.lock().expect("no check panics with it").next();
            let Some((fault, by, with)) = next else { break };
            let [not_held, _] = failed(&faulty(&site, fault), &["--timeout", "3"]);
            assert!(not_held.iter().any(|check| check == by), "{fault}: {not_held:?}");
            let is_of_it = |check: &String| check == by || with.contains(&check.as_str());
            assert!(not_held.iter().all(is_of_it), "{fault}: {not_held:?}");
        }
    };
    thread::scope(|threads| {
        for _ in 0..4 {
            threads.spawn(check);
        }
    });
}

#[test]
fn what_cannot_be_started_is_said() {
    conform("no-such-adapter --fast", &[])
        .expect_status(2)
        .complains(&["body/unheard", "cannot start `no-such-adapter`"]);
    conform("'open", &[]).expect_status(2).complains(&["`'open` is no command", "quotes closed"]);
    conform("tcp://127.0.0.1:1", &[]).expect_status(2).complains(&["cannot connect to tcp://127.0.0.1:1"]);
    conform("python3", &["--timeout", "0"]).expect_status(2).complains(&["body/timeout", "more than 0"]);
}
