//! Edits and what follows from them at once.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::{cost, hardness, served};

#[test]
fn a_saved_cell_is_in_the_next_route_in_sql_in_the_history_and_undone_again() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let before = cost(&service, "f", "e").unwrap();
    let (status, edited) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 2.5)));
    assert_eq!((status, &edited["done"]["old"], &edited["done"]["new"]), (200, &json!(4.0), &json!(2.5)));
    let after = cost(&service, "f", "e").unwrap();
    assert!(after < before);
    // the public view says the same to the plain shell, while the service runs
    let stored: f64 =
        site.sqlite3("SELECT cost FROM route WHERE start = 'f' AND goal = 'e'")[0].parse().unwrap();
    assert!((stored - after).abs() < 1e-9);
    let (_, history) = service.ask("GET", "/api/history", None);
    assert_eq!(
        (&history["edits"][0]["key"], &history["edits"][0]["who"]),
        (&json!("robot/SQUAT"), &json!("http"))
    );
    let (status, _) = service.ask("POST", "/api/edits", Some(&json!({"edit": {"kind": "undo"}})));
    assert_eq!((status, cost(&service, "f", "e")), (200, Some(before)));
}

#[test]
fn of_two_experts_the_later_one_is_told_and_nothing_is_lost() {
    let (_site, service) = served("paper");
    let set = |who: &str, value: f64| {
        let edit = json!({"edit": {"kind": "set", "table": "robots", "key": "robot/SQUAT", "column": "hardness", "value": value, "old": 4}});
        service.ask_as(&[&format!("X-Adit-Who: {who}")], "POST", "/api/edits", Some(&edit))
    };
    assert_eq!(set("anna", 3.0).0, 200);
    let (status, refused) = set("ben", 5.0);
    let error = &refused["error"];
    assert_eq!((status, &error["code"], &error["current"]), (409, &json!("edit/conflict"), &json!(3.0)));
    assert!(error["message"].as_str().unwrap().contains("set by anna"), "{error}");
    let (_, history) = service.ask("GET", "/api/history", None);
    assert_eq!(history["edits"].as_array().unwrap().len(), 1, "the refused edit left no trace");
}

#[test]
fn several_edits_are_made_together_or_not_at_all_and_taken_back_in_one_go() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let content = || site.sqlite3("SELECT * FROM robots; SELECT name FROM laid");
    let before = content();
    let set = |state: &str, value: f64| hardness(state, value)["edit"].clone();
    let charger = json!({"kind": "lay", "what": "place", "name": "charger", "corners": [[1.0, 1.0]]});
    let together = |edits: &[serde_json::Value]| {
        let body = json!({"edit": {"kind": "together", "edits": edits}, "why": "a new charger"});
        service.ask("POST", "/api/edits", Some(&body))
    };
    for refused in [&[set("SQUAT", 2.5), set("LIE-FACE-DOWN", -1.0)][..], &[]] {
        assert_eq!(together(refused).0, 400);
        assert_eq!(
            (content(), site.sqlite3("SELECT count(*) FROM history")),
            (before.clone(), vec!["0".to_owned()])
        );
    }
    let (status, edited) = together(&[set("SQUAT", 2.5), set("LIE-FACE-DOWN", 9.0), charger]);
    assert_eq!((status, edited["done"]["parts"].as_array().map(Vec::len)), (200, Some(3)), "{edited}");
    assert_eq!(site.sqlite3("SELECT count(DISTINCT change_set), count(*) FROM history"), ["1|3"]);
    assert!(cost(&service, "f", "charger").is_some());
    let undo = json!({"edit": {"kind": "undo", "edit": edited["done"]["id"]}});
    let (status, undone) = service.ask("POST", "/api/edits", Some(&undo));
    assert_eq!((status, &undone["done"]["with"]), (200, &json!(2)), "{undone}");
    assert_eq!(content(), before);
}

#[test]
fn a_preview_of_a_place_compares_the_ways_to_it_and_of_an_end_that_goes_says_that_the_way_is_lost() {
    let (_site, service) = served("paper");
    let charger = json!({"kind": "lay", "what": "place", "name": "charger", "corners": [[1.0, 1.0]]});
    let preview = |edit: &serde_json::Value, goal: &str| {
        let body = json!({"edits": [edit], "start": "f", "goal": goal, "patience_ms": 10_000});
        service.ask("POST", "/api/preview", Some(&body))
    };
    let (status, shown) = preview(&charger, "charger");
    assert_eq!((status, &shown["before"]["status"]), (200, &json!("unknown_goal")), "{shown}");
    assert!(shown["route"]["cost"].is_number(), "{shown}");
    let routes = &shown["routes"];
    assert_eq!(
        (&routes["total"], &routes["changed"], &routes["found"]),
        (&json!(2), &json!(2), &json!(2)),
        "{routes}"
    );
    assert_eq!(service.ask("POST", "/api/edits", Some(&json!({"edit": charger}))).0, 200);
    let (status, shown) = preview(&json!({"kind": "lift", "name": "charger"}), "charger");
    assert_eq!((status, &shown["route"]["status"]), (200, &json!("unknown_goal")), "{shown}");
    assert_eq!(shown["routes"]["changed"], 0, "that it goes is no change of other routes: {shown}");
}

#[test]
fn what_is_refused_changes_nothing() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let before = site.sqlite3("SELECT * FROM robots; SELECT count(*) FROM history");
    let refused = [
        (json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": -1}), 400),
        (
            json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": "soft"}),
            400,
        ),
        (json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": null}), 400),
        (json!({"kind": "set", "table": "robots", "key": "SQAT", "column": "hardness", "value": 1}), 400),
        (json!({"kind": "set", "table": "robts", "key": "SQUAT", "column": "hardness", "value": 1}), 404),
        (json!({"kind": "set", "table": "rooms", "key": "1", "column": "hardness", "value": 1}), 400),
        (json!({"kind": "retract", "fact": 7}), 404),
        (json!({"kind": "undo"}), 404),
        (json!({"kind": "unheard of"}), 422),
    ];
    for (edit, expected) in refused {
        let (status, answer) = service.ask("POST", "/api/edits", Some(&json!({"edit": edit})));
        assert_eq!(status, expected, "{edit}: {answer}");
    }
    assert_eq!(site.sqlite3("SELECT * FROM robots; SELECT count(*) FROM history"), before);
}

#[test]
fn a_preview_says_what_would_change_and_saves_nothing() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let edit = json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 2.5});
    let body = json!({"edits": [edit], "start": "f", "goal": "e"});
    let (status, preview) = service.ask("POST", "/api/preview", Some(&body));
    assert_eq!(status, 200, "{preview}");
    let before = cost(&service, "f", "e").unwrap();
    assert_eq!(preview["before"]["cost"], json!(before));
    assert!(preview["route"]["cost"].as_f64().unwrap() < before);
    assert_eq!(preview["doors"]["changed"], json!(2));
    service.ask("POST", "/api/edits", Some(&json!({"edit": body["edits"][0]})));
    assert_eq!(Some(preview["route"]["cost"].as_f64().unwrap()), cost(&service, "f", "e"), "and so it came");
}

#[test]
fn a_fact_closes_a_door_until_its_time_is_over() {
    let (_site, service) = served("paper");
    let open = cost(&service, "f", "e");
    let fact = json!({"class": "DOORS", "object": "door 7", "property": "passable", "value": false, "for_seconds": 2});
    let (status, told) = service.ask("POST", "/api/facts", Some(&fact));
    assert_eq!((status, &told["fact"], told["doors"].as_u64()), (200, &json!(1), Some(1)), "{told}");
    assert_eq!(cost(&service, "f", "e"), None);
    std::thread::sleep(std::time::Duration::from_millis(3_500));
    assert_eq!(cost(&service, "f", "e"), open, "it is open again by itself");
}

#[test]
fn what_was_acknowledged_outlives_a_power_cut() {
    let site = TestSite::example("paper").built();
    let mut acknowledged = Vec::new();
    for round in 0..4 {
        let service = Service::start(&site);
        for edit in 0..6 {
            let value = f64::from(round * 10 + edit) + 0.5;
            let (status, _) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", value)));
            assert_eq!(status, 200);
            acknowledged.push(value);
        }
        service.kill();
    }
    let kept: Vec<f64> = site
        .sqlite3("SELECT new FROM history ORDER BY id")
        .iter()
        .map(|value| value.parse().unwrap())
        .collect();
    assert_eq!(kept, acknowledged);
    assert_eq!(site.sqlite3("PRAGMA integrity_check"), ["ok"]);
}

#[test]
fn an_undo_that_cannot_be_is_the_callers_mistake() {
    let (_site, service) = served("paper");
    service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0)));
    for (edit, expected) in [(1, 200), (1, 409), (99, 404), (-1, 404)] {
        let undo = json!({"edit": {"kind": "undo", "edit": edit}});
        let (status, answer) = service.ask("POST", "/api/edits", Some(&undo));
        assert_eq!(status, expected, "{edit}: {answer}");
    }
}

#[test]
fn a_table_goes_out_as_a_file_and_comes_back_as_one_edit() {
    let files = "map = \"map.toml\"\nrobots = \"robots.toml\"\n";
    let site = TestSite::example("starter").with("site.toml", files).built();
    let service = Service::start(&site);
    let text = String::from_utf8(service.bytes("/api/tables/robots.csv")).unwrap();
    assert!(text.starts_with("robot*,state*,action,height,width,hardness"), "{text}");
    let take = |file: &str, content: Value| {
        let mut edit = json!({"kind": "take", "table": "robots", "file": file});
        edit.as_object_mut().unwrap().extend(content.as_object().unwrap().clone());
        service.ask("POST", "/api/edits", Some(&json!({ "edit": edit })))
    };
    let softer = text.replace("WALK-ON-KNEE,1.1,0.8,4", "WALK-ON-KNEE,1.1,0.8,3");
    let (status, edited) = take("robots.csv", json!({"text": softer}));
    assert_eq!((status, &edited["done"]["new"]), (200, &json!("1 cell set\n  robot/SQUAT.hardness: 4 → 3")));
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["3.0"]);
    for (file, content, said) in [
        ("robots.csv", json!({"text": softer}), "the table robots holds what robots.csv says already"),
        (
            "robots.csv",
            json!({"text": softer.replace(",3,", ",soft,")}),
            "robots.csv: `hardness` of `robots` holds numbers, and `soft` is none",
        ),
        ("robots.txt", json!({"text": softer}), "robots.txt is neither .csv nor .xlsx"),
        ("robots.xlsx", json!({"text": softer}), "robots.xlsx is no workbook"),
        ("robots.csv", json!({"base64": "?"}), "`base64` is not Base64"),
        ("robots.csv", json!({}), "is in `text` or in `base64`"),
    ] {
        let (status, refused) = take(file, content);
        let message = refused["error"]["message"].as_str().unwrap();
        assert!(status >= 400 && message.contains(said), "{refused}");
    }
    // one that was taken for the rows of before
    let versions = |service: &Service| {
        let (_, answer) = service.ask("GET", "/api/tables", None);
        let of = answer["tables"].as_array().unwrap().iter().find(|of| of["table"] == "robots").unwrap();
        of["version"].clone()
    };
    let seen = versions(&service);
    let (status, _) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.5)));
    assert_eq!(status, 200);
    let (status, refused) = take("robots.csv", json!({"text": softer, "version": seen}));
    let message = refused["error"]["message"].as_str().unwrap();
    assert_eq!((status, &refused["error"]["code"]), (409, &json!("edit/conflict")), "{refused}");
    assert!(message.starts_with("the table robots has changed since the file was taken for it, edited by "));
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["3.5"]);
    let (status, _) = take("robots.csv", json!({"text": softer, "version": versions(&service)}));
    assert_eq!(status, 200);
    // a small one that unpacks to much
    let zeros = "import base64, io, sys, zipfile
packed = io.BytesIO()
with zipfile.ZipFile(packed, 'w', zipfile.ZIP_DEFLATED) as to: to.writestr('xl/sharedStrings.xml', bytes(33 << 20))
sys.stdout.write(base64.b64encode(packed.getvalue()).decode())";
    let made = std::process::Command::new("python3").args(["-c", zeros]).output().unwrap();
    let (status, refused) = take("robots.xlsx", json!({"base64": String::from_utf8(made.stdout).unwrap()}));
    let message = refused["error"]["message"].as_str().unwrap();
    assert!(status >= 400 && message.contains("unpacks to more than 32 MB"), "{refused}");
    assert!(service.bytes("/api/tables/robots.xlsx").starts_with(b"PK"));
    let (status, _) = service.ask("GET", "/api/tables/x%2Frobots.csv", None);
    assert_eq!(status, 404);
    let (status, unknown) = service.ask("GET", "/api/tables/robot.csv", None);
    assert_eq!((status, &unknown["error"]["help"]), (404, &json!("did you mean `robots`?")), "{unknown}");
}
