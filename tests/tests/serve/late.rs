//! Nobody is told no of what is done all the same.

use std::thread;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::lock::Lock;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::hardness;

const PATIENCE: &[&str] = &["--listen", "127.0.0.1:0", "--answer-seconds", "1.5"];

/// Edits that wait for the desk while another program holds the database: the first has begun, the second has not when
/// its time is over, and the third one's caller hangs up. All three were made, later, and two of their callers were told 503.
#[test]
fn an_edit_is_answered_by_what_became_of_it_however_long_it_takes() {
    let site = TestSite::example("paper").built();
    let service = Service::start_with(&site, PATIENCE);
    let lock = Lock::hold(&site);
    let edit = |value: f64| service.ask("POST", "/api/edits", Some(&hardness("SQUAT", value)));
    let (begun, queued) = thread::scope(|scope| {
        let begun = scope.spawn(|| edit(3.0));
        thread::sleep(Duration::from_millis(300));
        let queued = scope.spawn(|| edit(5.0));
        service.hang_up("POST", "/api/edits", &hardness("SQUAT", 6.0), Duration::from_millis(300));
        let queued = queued.join().unwrap();
        thread::sleep(Duration::from_millis(600));
        assert!(!begun.is_finished(), "it has begun, so its end is waited for");
        drop(lock);
        (begun.join().unwrap(), queued)
    });
    assert_eq!((begun.0, &begun.1["done"]["new"]), (200, &json!(3.0)), "{}", begun.1);
    let error = &queued.1["error"];
    assert_eq!((queued.0, &error["code"]), (503, &json!("service/late")), "{}", queued.1);
    assert!(error["message"].as_str().unwrap().contains("nothing was changed"), "{error}");
    // whatever was left at the desk has been looked at before this edit
    assert_eq!(edit(7.0).0, 200);
    assert_eq!(site.sqlite3("SELECT new FROM history ORDER BY id"), ["3.0", "7.0"]);
}

/// The other edits that pass the desk: facts, what was measured, kept queries, rules.
#[test]
fn nothing_that_waited_too_long_for_its_turn_is_done_later() {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    let service = Service::start_with(&site, PATIENCE);
    let (_, rules) = service.ask("GET", "/api/rules", None);
    let file = rules["files"].as_array().unwrap().iter().find(|file| file["file"] == "doors.rhai").unwrap();
    let before = site.read("rules/doors.rhai");
    let fact = json!({"class": "DOORS", "object": "door 7", "property": "hardness", "value": 9});
    let measured =
        json!({"traversals": [{"state": "SQUAT", "distance": 2.0, "measured": 8.0}], "measure": "seconds"});
    let rule = json!({"text": format!("{before}\n// late\n"), "version": file["version"]});
    let query = json!({"query": "SELECT 1"});
    let late: [(&str, &str, &Value); 4] = [
        ("POST", "/api/facts", &fact),
        ("POST", "/api/traversals", &measured),
        ("PUT", "/api/queries/late", &query),
        ("PUT", "/api/rules/doors.rhai", &rule),
    ];
    let lock = Lock::hold(&site);
    thread::scope(|scope| {
        let begun = scope.spawn(|| service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0))));
        thread::sleep(Duration::from_millis(300));
        let began = Instant::now();
        let late = late.map(|(method, path, body)| {
            let service = &service;
            (path, scope.spawn(move || service.ask(method, path, Some(body))))
        });
        for (path, answer) in late {
            let (status, answer) = answer.join().unwrap();
            assert_eq!((status, &answer["error"]["code"]), (503, &json!("service/late")), "{path}: {answer}");
        }
        assert!(began.elapsed() < Duration::from_secs(3), "each was told in time");
        drop(lock);
        assert_eq!(begun.join().unwrap().0, 200);
    });
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 7.0))).0, 200);
    let (_, facts) = service.ask("GET", "/api/facts", None);
    let (_, traversals) = service.ask("GET", "/api/traversals", None);
    let (_, queries) = service.ask("GET", "/api/queries", None);
    assert_eq!(
        (&facts["facts"], &traversals["traversals"], &queries["queries"], site.read("rules/doors.rhai")),
        (&json!([]), &json!([]), &json!([]), before)
    );
}
