//! The disk is full at the first write of an edit, then at the second, and so on, until the edit fits.

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, within};
use serde_json::{Value, json};

use crate::disk::{Files, files_in};
use crate::judge::Content;
use crate::starter;
use crate::tape::Recorder;

/// [`content`], once the routes that are kept have followed the last edit.
fn settled(site: &TestSite) -> (Content, Files) {
    within("kept routes follow", || {
        let stale = site.sqlite3("SELECT count(*) FROM stale_marks");
        (stale == ["0"]).then(|| content(site))
    })
}

/// What readers see, and the files beside the database.
fn content(site: &TestSite) -> (Content, Files) {
    let mut files = files_in(site.path());
    files.retain(|name, _| !name.starts_with("site.db"));
    (Content::of(&site.path().join("site.db")).unwrap(), files)
}

fn set(state: &str, value: f64) -> Value {
    json!({"edit": {"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value}})
}

/// A rule's file, over the one of this version.
fn rule(factor: f64, version: &Value) -> Value {
    let rule = format!("set room.hardness by * {factor} level 10");
    let text = format!("revise \"draughty\"\n    each room in ROOMS where room.y0 < 4.0\n    {rule}\n");
    json!({"text": text, "version": version})
}

/// So often an attempt is made again, since something else changed meanwhile.
const MOST_FOLLOWED: usize = 4;

type Request<'r> = (&'r str, &'r str, &'r Value);

const EDIT: (&str, &str) = ("POST", "/api/edits");
const RULE: (&str, &str) = ("PUT", "/api/rules/draughty.rhai");

/// Sends something that needs room, with none from its first write on, then from its second on, and so on, until it is
/// answered by 200; gives how often it was refused. Each time all is as it was, and once there is room the next edit is made.
/// Of every other first write, or of every one in a second turn, half is still written.
fn refused(site: &TestSite, disk: &Recorder, service: &Service, request: Request<'_>, turns: u64) -> u64 {
    let (method, path, body) = request;
    for number in 0.. {
        let (first, is_half) = (number / turns + 1, number % 2 == 1);
        let attempt = || {
            disk.refuse(first..u64::MAX, is_half);
            let answered = service.ask(method, path, Some(body));
            disk.make_room();
            answered
        };
        let mut before = content(site);
        let (mut status, mut answer) = attempt();
        let mut after = content(site);
        // on a busy machine routes follow the edit before, meanwhile
        for _ in 0..MOST_FOLLOWED {
            if status == 200 || after == before {
                break;
            }
            before = settled(site);
            (status, answer) = attempt();
            after = content(site);
        }
        if status == 200 {
            return number;
        }
        assert_eq!((status, &answer["error"]["status"]), (500, &json!(500)), "{answer}");
        let said = answer["error"]["message"].as_str().unwrap();
        let is_clear = ["disk", "No space left on device"].iter().any(|words| said.contains(words));
        assert!(is_clear, "{said}");
        let changed = before.0.text.lines().zip(after.0.text.lines()).find(|(before, after)| before != after);
        assert!(
            after == before,
            "{request:?}, refused at write {first}: {answer}; first of what changed: {changed:?}"
        );
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
    let times = refused(&site, &disk, &service, (EDIT.0, EDIT.1, &set("SQUAT", 3.0)), 1);
    assert!(times > 10, "it was refused {times} times");
    service.end();
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["3.0"]);
    site.adit("doctor", &[]).expect_status(0);
}

/// Where the database had no room for what follows from a rule, there was none for the rule's file of before, either: the new
/// one stayed, and was taken up once there was room.
#[test]
fn a_rule_that_finds_no_room_at_any_of_its_writes_changes_nothing_and_the_next_edit_is_made() {
    let site = starter();
    let disk = Recorder::of(&site);
    let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
    let (status, saved) = service.ask(RULE.0, RULE.1, Some(&rule(1.5, &Value::Null)));
    assert_eq!(status, 200, "{saved}");
    let times = refused(&site, &disk, &service, (RULE.0, RULE.1, &rule(2.0, &saved["version"])), 1);
    assert!(times > 10, "it was refused {times} times");
    assert!(site.read("rules/draughty.rhai").contains("* 2"));
    let rules = files_in(&site.path().join("rules"));
    assert_eq!(rules.keys().collect::<Vec<_>>(), ["draughty.rhai"]);
}

#[test]
#[ignore = "takes a minute; by hand: cargo test --workspace --test power -- --ignored"]
fn edits_of_every_kind_that_find_no_room_at_any_of_their_writes_change_nothing() {
    let site = starter();
    let disk = Recorder::of(&site);
    let service = Service::start_by(disk.adit(), &site, &["--listen", "127.0.0.1:0"]);
    let place = json!({"kind": "lay", "what": "place", "name": "charger", "corners": [[1.0, 1.0]]});
    let set_in_tuning = json!({"kind": "set_in_tuning", "tuning": "guests", "table": "robots", "key": "STAND", "column": "speed", "value": 0.75});
    let edits = [
        set("SQUAT", 7.0)["edit"].clone(),
        json!({"kind": "together", "edits": [set("SQUAT", 7.5)["edit"], place]}),
        json!({"kind": "close", "what": "doorway 1", "for_seconds": 3_600}),
        json!({"kind": "open", "what": "doorway 1"}),
        set_in_tuning,
        json!({"kind": "switch", "tuning": "guests", "on": true}),
    ];
    for edit in edits {
        let edit = json!({"edit": edit});
        let times = refused(&site, &disk, &service, (EDIT.0, EDIT.1, &edit), 2);
        assert!(times > 10, "{edit} was refused {times} times");
    }
    assert!(refused(&site, &disk, &service, (RULE.0, RULE.1, &rule(1.5, &Value::Null)), 2) > 10);
    service.end();
    let end =
        "SELECT hardness FROM robots WHERE state = 'SQUAT'; SELECT count(*) FROM told; SELECT name FROM laid";
    assert_eq!(site.sqlite3(end), ["7.5", "0", "charger"]);
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
    // the last of all is that the folder is synced, which no longer has the journal: the edit is made then, and whole
    loop {
        let before = content(&site);
        disk.refuse(first..u64::MAX, first % 2 == 0);
        let ran = tune("3");
        disk.make_room();
        if ran.status == 0 {
            break;
        }
        ran.complains(&["database", "disk"]);
        if content(&site) != before {
            break;
        }
        first += 1;
    }
    assert!(first > 20, "it was refused {first} times");
    let made = "SELECT hardness, (SELECT count(*) FROM history) FROM robots WHERE state = 'SQUAT'";
    assert_eq!(site.sqlite3(made), ["3.0|1"]);
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
