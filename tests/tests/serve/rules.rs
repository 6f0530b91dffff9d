//! Rules over HTTP, and in any editor.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::{cost, within_a_second};

/// A served copy of the paper's example with rules of its own.
pub fn served() -> (TestSite, Service) {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    let service = Service::start(&site);
    (site, service)
}

pub fn file(service: &Service, name: &str) -> (String, Value) {
    let (_, rules) = service.ask("GET", "/api/rules", None);
    let all = rules["files"].as_array().unwrap().iter().chain(rules["tests"].as_array().unwrap());
    let found =
        all.clone().find(|file| file["file"] == name).unwrap_or_else(|| panic!("{name} is not in {rules}"));
    (found["text"].as_str().unwrap().to_owned(), found["version"].clone())
}

fn save(service: &Service, name: &str, text: &str, version: &Value) -> (u16, Value) {
    service.ask("PUT", &format!("/api/rules/{name}"), Some(&json!({"text": text, "version": version})))
}

#[test]
fn a_saved_rule_counts_at_once_and_a_broken_one_never_does() {
    let (site, service) = served();
    let before = cost(&service, "f", "e").unwrap();
    let (text, version) = file(&service, "doors.rhai");
    let broken = text.replacen("door.distance1", "door.distanc1", 1);
    let (status, refused) = save(&service, "doors.rhai", &broken, &version);
    let problem = &refused["error"]["problems"][0];
    assert_eq!(
        (status, &problem["code"], &problem["file"]),
        (422, &json!("rule/unknown-property"), &json!("doors.rhai"))
    );
    let line = broken.lines().position(|line| line.contains("distanc1")).unwrap() + 1;
    assert_eq!(problem["line"], json!(line));
    let underlined = problem["end_column"].as_u64().unwrap() - problem["column"].as_u64().unwrap();
    assert!(underlined >= 8, "{problem}");
    assert_eq!((site.read("rules/doors.rhai"), cost(&service, "f", "e")), (text.clone(), Some(before)));

    // a text that is right, but against a test beside the rules
    let doubled = text.replacen("= door.distance1 *", "= 2.0 * door.distance1 *", 1);
    let (status, refused) = save(&service, "doors.rhai", &doubled, &version);
    assert_eq!((status, &refused["error"]["code"]), (422, &json!("rules/tests")), "{refused}");
    assert_eq!(site.read("rules/doors.rhai"), text);

    let (tests, of_tests) = file(&service, "tests/doors.toml");
    assert!(tests.contains("[[test]]"));
    let (status, gone) = service.ask(
        "DELETE",
        &format!("/api/rules/tests/doors.toml?version={}", of_tests.as_str().unwrap()),
        None,
    );
    assert_eq!(status, 200, "{gone}");
    let (status, saved) = save(&service, "doors.rhai", &doubled, &version);
    assert_eq!(status, 200, "{saved}");
    assert!(cost(&service, "f", "e").unwrap() > before);
}

#[test]
fn whoever_saves_over_anothers_work_is_told() {
    let (site, service) = served();
    let (text, version) = file(&service, "doors.rhai");
    site.write("rules/doors.rhai", format!("// anna was here\n{text}"));
    let (status, refused) = save(&service, "doors.rhai", &format!("// ben was here\n{text}"), &version);
    assert_eq!((status, &refused["error"]["code"]), (409, &json!("rules/conflict")));
    assert!(site.read("rules/doors.rhai").starts_with("// anna"));
    assert_eq!(save(&service, "doors.rhai", "// new", &Value::Null).0, 409, "nor as if it were new");
}

#[test]
fn a_file_saved_in_any_editor_counts_within_a_second() {
    let (site, service) = served();
    let mut events = service.events();
    events.next("hello");
    let before = cost(&service, "f", "e");
    site.edit("rules/doors.rhai", "= door.distance1 *", "= door.distanc1 *");
    let said = events.next("problems");
    assert_eq!(said["problems"][0]["code"], "rule/unknown-property", "{said}");
    assert_eq!(cost(&service, "f", "e"), before, "the old rules stay in force");
    std::fs::remove_file(site.path().join("rules/tests/doors.toml")).unwrap();
    site.edit("rules/doors.rhai", "= door.distanc1 *", "= 2.0 * door.distance1 *");
    within_a_second(|| cost(&service, "f", "e") > before);
    assert_eq!(events.next("problems")["problems"], json!([]), "mended");
    events.next("changed");
}

#[test]
fn a_text_is_tried_without_being_saved() {
    let (site, service) = served();
    let (text, _) = file(&service, "doors.rhai");
    let check = |text: &str| {
        service.ask("POST", "/api/rules/check", Some(&json!({"file": "doors.rhai", "text": text}))).1
    };
    let fine = check(&text);
    assert_eq!((&fine["problems"], &fine["tests"]["failed"]), (&json!([]), &json!(0)), "{fine}");
    assert!(fine["tests"]["passed"].as_u64().unwrap() > 0);
    assert_eq!(check("rule \"half")["problems"][0]["code"], "rule/syntax");
    let failing = check(&text.replacen("= door.distance1 *", "= 2.0 * door.distance1 *", 1));
    assert!(
        failing["tests"]["failed"].as_u64().unwrap() > 0
            && !failing["tests"]["failures"][0]["line"].is_null()
    );
    assert_eq!(site.read("rules/doors.rhai"), text);
}

#[test]
fn a_rule_of_the_site_replaces_the_shipped_one_of_its_name() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let before = cost(&service, "f", "e");
    let (_, rules) = service.ask("GET", "/api/rules", None);
    let shipped =
        rules["files"].as_array().unwrap().iter().find(|file| file["file"] == "rooms/paper/doors.rhai");
    let shipped = shipped.unwrap_or_else(|| panic!("{rules}"));
    assert_eq!((&shipped["own"], &rules["folder"]), (&json!(false), &json!("rules")));

    // the text of the shipped file, saved as the site's own, changes nothing
    let text = shipped["text"].as_str().unwrap();
    let (status, saved) = save(&service, "doors.rhai", text, &Value::Null);
    assert_eq!(status, 200, "{saved}");
    assert_eq!((cost(&service, "f", "e"), site.read("rules/doors.rhai").as_str()), (before, text));
    let (own, version) = file(&service, "doors.rhai");
    assert_eq!(own, text);
    let doubled = text.replacen("= door.distance1 *", "= 2.0 * door.distance1 *", 1);
    assert_eq!(save(&service, "doors.rhai", &doubled, &version).0, 200);
    assert!(cost(&service, "f", "e") > before);
    let (_, version) = file(&service, "doors.rhai");
    let path = format!("/api/rules/doors.rhai?version={}", version.as_str().unwrap());
    assert_eq!(service.ask("DELETE", &path, None).0, 200, "the shipped rules count again");
    assert_eq!(cost(&service, "f", "e"), before);
}

#[test]
fn a_first_rule_that_is_refused_leaves_no_folder_behind() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let (status, refused) = save(&service, "slip.rhai", "rule \"slip\" each room in", &Value::Null);
    assert_eq!(status, 422, "{refused}");
    assert!(!site.path().join("rules").exists());
}

#[test]
fn only_files_of_the_rule_base_are_written() {
    let (site, service) = served();
    for name in [
        "../site.toml",
        "..%2fsite.toml",
        "x.toml",
        ".hidden.rhai",
        "tests/../x.toml",
        "a/b.rhai",
        "%2e%2e/x.rhai",
        ".rhai",
    ] {
        let (status, answer) = save(&service, name, "x", &Value::Null);
        assert!([400, 404, 405].contains(&status), "{name}: {answer}");
    }
    assert!(site.read("site.toml").contains("name"));
}

pub fn write(file: &str, text: Option<&str>, version: &Value) -> Value {
    json!({"kind": "write", "file": file, "text": text, "version": version})
}

pub fn edit(service: &Service, edits: &[Value]) -> (u16, Value) {
    service.ask(
        "POST",
        "/api/edits",
        Some(&json!({"edit": {"kind": "together", "edits": edits}, "why": "a try"})),
    )
}

/// A rule and the test that it changes blocked each other: each file was checked and saved alone.
#[test]
fn rules_tests_and_cells_are_edited_whole_or_not_at_all() {
    let (site, service) = served();
    let before = cost(&service, "f", "e");
    let ((text, version), (tests, of_tests)) =
        (file(&service, "doors.rhai"), file(&service, "tests/doors.toml"));
    let doubled = text.replacen("= door.distance1 *", "= 2.0 * door.distance1 *", 1);
    let rule = write("doors.rhai", Some(&doubled), &version);
    let gone = write("tests/doors.toml", None, &of_tests);
    let new = write("own.rhai", Some("// Nothing yet.\n"), &Value::Null);
    let cell = json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 3});

    // the rule alone fails its test: nothing of it is kept, the cell neither; a preview says so
    let (status, refused) = edit(&service, &[cell.clone(), rule.clone()]);
    assert_eq!((status, &refused["error"]["code"]), (422, &json!("rules/tests")), "{refused}");
    let preview = |edits: &[Value]| {
        service.ask("POST", "/api/preview", Some(&json!({"edits": edits, "start": "f", "goal": "e"}))).1
    };
    let tried = preview(std::slice::from_ref(&rule));
    assert!(tried["rules"]["failed"].as_u64().unwrap() > 0, "{tried}");
    assert_eq!(tried["rules"]["failures"][0]["file"], "tests/doors.toml");
    assert!(tried["route"]["cost"].as_f64() > tried["before"]["cost"].as_f64());
    let mistaken = write("doors.rhai", Some("rule \"half"), &version);
    let (status, refused) = edit(&service, &[cell.clone(), mistaken]);
    assert_eq!((status, &refused["error"]["problems"][0]["file"]), (422, &json!("doors.rhai")), "{refused}");
    let impossible =
        json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": -1});
    assert_eq!(edit(&service, &[rule.clone(), gone.clone(), impossible]).0, 400);
    assert_eq!(
        (site.read("rules/doors.rhai"), site.read("rules/tests/doors.toml")),
        (text.clone(), tests.clone())
    );
    assert_eq!(
        (cost(&service, "f", "e"), site.sqlite3("SELECT count(*) FROM history")),
        (before, vec!["0".to_owned()])
    );

    let all = [cell, rule, gone, new];
    let tried = preview(&all);
    assert_eq!(tried["rules"]["failed"], 0, "{tried}");
    let (status, done) = edit(&service, &all);
    assert_eq!(status, 200, "{done}");
    assert_eq!(done["tests"]["failed"], 0);
    let now = cost(&service, "f", "e");
    assert_eq!((now, now > before), (tried["route"]["cost"].as_f64(), true), "as it was previewed");
    assert_eq!(site.read("rules/own.rhai"), "// Nothing yet.\n");
    assert!(!site.path().join("rules/tests/doors.toml").exists());
    assert_eq!(site.sqlite3("SELECT count(DISTINCT change_set), count(*) FROM history"), ["1|4"]);
    assert!(!site.path().join("site.db-files").exists(), "nothing is left to be done");

    let undo = json!({"edit": {"kind": "undo", "edit": done["done"]["id"]}});
    assert_eq!(service.ask("POST", "/api/edits", Some(&undo)).0, 200);
    assert_eq!((site.read("rules/doors.rhai"), site.read("rules/tests/doors.toml")), (text, tests));
    assert!(!site.path().join("rules/own.rhai").exists());
    assert_eq!(cost(&service, "f", "e"), before);
}

#[test]
fn a_file_has_its_versions_and_none_is_taken_back_over_what_somebody_saved_since() {
    let (site, service) = served();
    let (text, version) = file(&service, "rooms.rhai");
    let first = format!("// One.\n{text}");
    assert_eq!(edit(&service, &[write("rooms.rhai", Some(&first), &version)]).0, 200);
    // in an editor
    site.write("rules/rooms.rhai", format!("// Two.\n{text}"));
    within_a_second(|| file(&service, "rooms.rhai").0.starts_with("// Two."));
    let (_, version) = file(&service, "rooms.rhai");
    assert_eq!(edit(&service, &[write("rooms.rhai", Some(&text), &version)]).0, 200);
    let (status, answer) = service.ask("GET", "/api/rules/versions?file=rooms.rhai", None);
    assert_eq!(status, 200, "{answer}");
    let texts: Vec<_> =
        answer["versions"].as_array().unwrap().iter().map(|of| of["text"].as_str().unwrap()).collect();
    assert_eq!(texts, [&text, &format!("// Two.\n{text}"), &first, &text]);
    assert_eq!(
        (&answer["versions"][0]["why"], &answer["versions"][1]["who"]),
        (&json!("a try"), &Value::Null)
    );

    let undo = json!({"edit": {"kind": "undo", "edit": 1}});
    let (status, refused) = service.ask("POST", "/api/edits", Some(&undo));
    assert_eq!((status, &refused["error"]["code"]), (409, &json!("rules/conflict")), "{refused}");
    assert_eq!(service.ask("GET", "/api/rules/versions?file=../site.toml", None).0, 400);
}

#[test]
fn decision_tables_are_read_as_grids_as_they_are_saved_and_as_they_are_typed() {
    let (site, service) = super::served("shop");
    let ask = |body: Value| service.ask("POST", "/api/rules/tables", Some(&body));
    let (status, saved) = ask(json!({"file": "orders.rhai"}));
    let grid = &saved["tables"][0];
    assert_eq!((status, &grid["name"], &grid["hit"]), (200, &json!("discount"), &json!("first")), "{saved}");
    assert_eq!(grid["given"], json!(["order.goods", "order.customer.club ?? false"]));
    assert_eq!(grid["rows"][1]["tests"], json!(["from 50 to below 100", "any"]));
    assert_eq!((&grid["amiss"], &grid["missing"]), (&json!([]), &Value::Null));
    let typed = site.read("rules/orders.rhai").replace("at_least(100.0)", "at_least(120.0)");
    let (_, typed) = ask(json!({"file": "orders.rhai", "text": typed}));
    let grid = &typed["tables"][0];
    assert_eq!(grid["amiss"][0]["what"], "gap", "{grid}");
    assert_eq!(grid["missing"][1], "", "{grid}");
    let (status, refused) = ask(json!({"file": "nothing.rhai"}));
    assert_eq!((status, &refused["error"]["code"]), (400, &json!("service/path")), "{refused}");
}
