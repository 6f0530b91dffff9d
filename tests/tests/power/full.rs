//! The disk is full at the first write of an edit, then at the second, and so on, until the edit fits.

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite};
use serde_json::{Value, json};

use crate::disk::files_in;
use crate::judge::Content;
use crate::starter;
use crate::tape::Recorder;

/// What readers see, while the site is served or not.
fn content(site: &TestSite) -> Content {
    Content::of(&site.path().join("site.db")).unwrap()
}

fn set(state: &str, value: f64) -> Value {
    json!({"edit": {"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value}})
}

/// Sends something that needs room, with none from its first write on, then from its second on, and so on, until it is
/// answered by 200; gives how often it was refused. Each time all is as it was, and once there is room the next edit is made.
fn refused(site: &TestSite, disk: &Recorder, service: &Service, request: (&str, &str, &Value)) -> u64 {
    let (method, path, body) = request;
    for number in 0.. {
        let before = content(site);
        let (first, is_half) = (number / 2 + 1, number % 2 == 1);
        disk.refuse(first..u64::MAX, is_half);
        let (status, answer) = service.ask(method, path, Some(body));
        disk.make_room();
        if status == 200 {
            return number;
        }
        assert_eq!((status, &answer["error"]["status"]), (500, &json!(500)), "{answer}");
        let said = answer["error"]["message"].as_str().unwrap();
        let is_clear = ["disk", "No space left on device"].iter().any(|words| said.contains(words));
        assert!(is_clear, "{said}");
        assert!(content(site) == before, "{request:?}, refused at write {first}: {answer}");
        let next = 2.0 + number as f64 / 16.0;
        let (status, answer) = service.ask("POST", "/api/edits", Some(&set("STAND", next)));
        assert_eq!(status, 200, "the edit after {request:?} was refused at write {first}: {answer}");
    }
    unreachable!("it is answered at last")
}

#[test]
fn an_edit_that_finds_no_room_at_any_of_its_writes_changes_nothing_and_the_next_one_is_made() {
    let site = starter();
    let disk = Recorder::of(&site);
    let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
    let place = json!({"kind": "lay", "what": "place", "name": "charger", "corners": [[1.0, 1.0]]});
    let together = json!({"edit": {"kind": "together", "edits": [set("SQUAT", 7.0)["edit"], place]}});
    let close = json!({"edit": {"kind": "close", "what": "doorway 1", "for_seconds": 3_600}});
    let text = json!({"text": "revise \"draughty\"\n    each room in ROOMS where room.y0 < 4.0\n    set room.hardness by * 1.5 level 10\n"});
    for request in [
        ("POST", "/api/edits", &set("SQUAT", 3.0)),
        ("POST", "/api/edits", &together),
        ("POST", "/api/edits", &close),
        ("PUT", "/api/rules/draughty.rhai", &text),
    ] {
        let times = refused(&site, &disk, &service, request);
        assert!(times > 8, "{request:?} was refused {times} times");
    }
    service.end();
    let end =
        "SELECT hardness FROM robots WHERE state = 'SQUAT'; SELECT count(*) FROM told; SELECT name FROM laid";
    assert_eq!(site.sqlite3(end), ["7.0", "1", "charger"]);
    site.adit("doctor", &[]).expect_status(0);
}

#[test]
fn a_command_that_finds_no_room_at_any_of_its_writes_changes_nothing_and_the_next_one_is_made() {
    let site = TestSite::example("paper").built();
    let disk = Recorder::of(&site);
    let tune = |value: &str| {
        let mut program = disk.adit();
        program.arg("tune").arg(site.path()).args(["robots", "SQUAT", "hardness", value]);
        Ran::new(&program.output().unwrap())
    };
    let mut first = 1;
    loop {
        let before = content(&site);
        disk.refuse(first..u64::MAX, first % 2 == 0);
        let ran = tune("3");
        disk.make_room();
        if ran.status == 0 {
            break;
        }
        ran.complains(&["disk"]);
        assert!(content(&site) == before, "refused at write {first}: {}", ran.stderr);
        first += 1;
    }
    assert!(first > 20, "it was refused {first} times");
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["3.0"]);
    tune("5").expect_status(0);
    site.adit("doctor", &[]).expect_status(0);
}

/// What was acknowledged lies in the log beside the database then, and the next program that writes takes it in.
#[test]
fn a_service_that_ends_on_a_full_disk_loses_nothing() {
    let site = starter();
    let disk = Recorder::of(&site);
    let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
    assert_eq!(service.ask("POST", "/api/edits", Some(&set("SQUAT", 3.0))).0, 200);
    disk.refuse(1..u64::MAX, false);
    service.end();
    disk.make_room();
    let squat = || site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'");
    assert_eq!(squat(), ["3.0"]);
    site.adit("tune", &["robots", "STAND", "hardness", "2"]).expect_status(0);
    assert_eq!(files_in(site.path()).keys().filter(|name| name.starts_with("site.db")).count(), 1);
    assert_eq!(squat(), ["3.0"]);
}
