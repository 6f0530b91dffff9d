//! Every route, setting, function of rules and code of a failure is documented.

use std::collections::BTreeSet;
use std::fs;

use adit::Code;
use adit_tests::{Ran, adit, repository};
use serde_json::{Value, json};

use super::served;

fn texts(value: &Value) -> bool {
    value.as_str().is_some_and(|text| !text.trim().is_empty())
}

#[test]
fn every_route_says_what_it_is_for_what_it_takes_and_what_it_gives() {
    let (_site, service) = served("paper");
    let (status, description) = service.ask("GET", "/api/openapi.json", None);
    assert_eq!(status, 200);
    let mut all = Vec::new();
    for (path, methods) in description["paths"].as_object().unwrap() {
        for (method, route) in methods.as_object().unwrap() {
            let name = format!("{method} {path}");
            assert!(texts(&route["summary"]), "{name} has no word about what it is for");
            let responses = route["responses"].as_object().unwrap();
            assert!(responses.contains_key("200"), "{name}");
            if path != "/api/health" {
                assert!(responses.contains_key("4XX"), "{name} says nothing of failures");
                assert_eq!(
                    responses["4XX"]["content"]["application/json"]["schema"]["$ref"],
                    "#/components/schemas/Failure",
                    "{name}"
                );
            }
            for parameter in route["parameters"].as_array().into_iter().flatten() {
                assert!(texts(&parameter["description"]), "{name}: {parameter}");
            }
            all.push(name);
        }
    }
    // whatever is named must be there
    let text = description.to_string();
    for (at, _) in text.match_indices("#/components/schemas/") {
        let name: String = text[at + 21..].chars().take_while(|c| *c != '"').collect();
        assert!(!description["components"]["schemas"][&name].is_null(), "there is no schema {name}");
    }
    let manual = fs::read_to_string(repository().join("manual/src/service.md")).unwrap();
    for route in all {
        let path =
            route.split(' ').nth(1).unwrap().split('{').next().unwrap().trim_end_matches('/').to_owned();
        assert!(manual.contains(&path), "service.md does not name {route}");
    }
}

/// What of an answer its schema does not have.
fn undescribed(schemas: &Value, (schema, value): (&Value, &Value), at: &str, found: &mut BTreeSet<String>) {
    let named = schema["$ref"].as_str().and_then(|name| name.rsplit('/').next());
    let schema = named.map_or(schema, |name| &schemas[name]);
    if let Some(one_of) = schema["oneOf"].as_array().or_else(|| schema["anyOf"].as_array()) {
        let each = one_of.iter().map(|one| {
            let mut found = BTreeSet::new();
            undescribed(schemas, (one, value), at, &mut found);
            found
        });
        found.extend(each.min_by_key(BTreeSet::len).unwrap_or_default());
        return;
    }
    match value {
        Value::Object(members) => {
            for (name, member) in members {
                let own = &schema["properties"][name];
                let own = if own.is_null() { &schema["additionalProperties"] } else { own };
                if own.is_null() {
                    // what may be any value says nothing of it, and is described so
                    let is_any = schema.as_object().is_some_and(|schema| !schema.contains_key("type"));
                    found.extend((!is_any).then(|| format!("{at}.{name}")));
                } else {
                    undescribed(schemas, (own, member), &format!("{at}.{name}"), found);
                }
            }
        }
        Value::Array(items) => {
            for item in items {
                undescribed(schemas, (&schema["items"], item), at, found);
            }
        }
        _ => {}
    }
}

#[test]
fn answers_have_what_the_description_says_and_no_more() {
    let (_site, service) = served("clinic");
    let close = json!({"edit": {"kind": "close", "what": "ward 12", "until": "2h"}, "why": "a spill"});
    let tuning = json!({"edit": {"kind": "set_in_tuning", "tuning": "night", "table": "robots", "key": "robot/SQUAT",
                                 "column": "hardness", "value": 9}});
    let driven = json!({"traversals": [{"robot": "robot", "state": "STAND", "distance": 3.0, "measured": 2.0}],
                        "measure": "seconds"});
    let set =
        json!({"kind": "set", "table": "robots", "key": "robot/SQUAT", "column": "hardness", "value": 3});
    let preview = json!({"edits": [set], "start": "dock", "goal": "ward 9"});
    let asked = [
        ("post", "/api/edits", Some(close)),
        ("post", "/api/edits", Some(tuning)),
        ("post", "/api/traversals", Some(driven)),
        ("post", "/api/preview", Some(preview)),
        ("get", "/api/site", None),
        ("get", "/api/tables", None),
        ("get", "/api/tunings", None),
        ("get", "/api/facts", None),
        ("get", "/api/history", None),
        ("get", "/api/traversals", None),
        ("get", "/api/route?start=dock&goal=ward%209", None),
        ("get", "/api/why?start=dock&goal=ward%209", None),
        ("get", "/api/firm?start=dock&goal=ward%209", None),
    ];
    let (_, description) = service.ask("GET", "/api/openapi.json", None);
    let mut found = BTreeSet::new();
    for (method, question, body) in asked {
        let (status, answer) = service.ask(&method.to_uppercase(), question, body.as_ref());
        assert_eq!(status, 200, "{question}: {answer:#}");
        let path = question.split('?').next().unwrap();
        let content = &description["paths"][path][method]["responses"]["200"]["content"];
        let schema = &content["application/json"]["schema"];
        assert!(!schema.is_null(), "{path}");
        undescribed(&description["components"]["schemas"], (schema, &answer), path, &mut found);
    }
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn every_setting_of_the_service_is_documented() {
    let help = Ran::new(&std::process::Command::new(adit()).args(["serve", "--help"]).output().unwrap())
        .expecting(0);
    let manual = fs::read_to_string(repository().join("manual/src/service.md")).unwrap();
    let words = help.stdout.split(|c: char| !(c.is_alphanumeric() || c == '-'));
    let settings: Vec<&str> = words.filter(|word| word.starts_with("--") && word.len() > 3).collect();
    assert!(settings.len() > 6);
    for setting in settings {
        assert!(
            ["--help"].contains(&setting) || manual.contains(setting),
            "service.md does not name {setting}"
        );
    }
}

/// With `WRITE_CODES=1` in the environment the page is written instead.
#[test]
fn the_page_of_codes_lists_every_code_with_its_statuses_and_no_other() {
    const HEAD: &str = "| code | HTTP | exit | what it means |\n|---|---|---|---|\n";
    let mut codes: Vec<Code> = Code::all().collect();
    codes.sort_by_key(|code| code.as_str());
    let row = |code: Code| {
        format!("| `{code}` | {} | {} | {} |\n", code.http().as_u16(), code.exit(), code.meaning())
    };
    let table: String = codes.into_iter().map(row).collect();
    let file = repository().join("manual/src/codes.md");
    let page = fs::read_to_string(&file).unwrap();
    let (before, written) = page.split_once(HEAD).expect("the head of the table");
    if std::env::var_os("WRITE_CODES").is_some() {
        fs::write(&file, format!("{before}{HEAD}{table}")).unwrap();
    } else {
        assert_eq!(written, table, "`WRITE_CODES=1 tests/run --test serve` writes manual/src/codes.md anew");
    }
}

#[test]
fn no_two_codes_have_one_name_and_each_says_what_it_means() {
    let mut names = BTreeSet::new();
    for code in Code::all() {
        assert!(names.insert(code.as_str()), "{code} stands twice");
        assert!(code.meaning().ends_with('.') && !code.meaning().contains('|'), "{code}");
        assert!(code.http().as_u16() >= 400 && [1, 2].contains(&code.exit()), "{code}");
    }
}

#[test]
fn the_description_lists_the_codes_that_a_failure_may_have() {
    let (_site, service) = served("paper");
    let (_, description) = service.ask("GET", "/api/openapi.json", None);
    let schemas = &description["components"]["schemas"];
    let listed: Vec<&str> =
        schemas["Code"]["enum"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert_eq!(listed, Code::all().map(Code::as_str).collect::<Vec<_>>());
    assert_eq!(schemas["Fault"]["properties"]["code"]["$ref"], "#/components/schemas/Code");
}

#[test]
fn prometheus_reads_what_was_counted() {
    let (site, service) = served("paper");
    for _ in 0..3 {
        assert_eq!(service.ask("GET", "/api/site", None).0, 200);
    }
    let (status, text) = service.ask("GET", "/metrics", None);
    let text = text.as_str().unwrap();
    assert_eq!(status, 200, "{text}");
    let rooms = &site.sqlite3("SELECT count(*) FROM rooms")[0];
    for line in [
        r#"adit_requests_total{route="/api/site",status="2xx"} 3"#,
        r#"adit_request_seconds_bucket{route="/api/site",le="+Inf"} 3"#,
        r#"adit_request_seconds_count{route="/api/site"} 3"#,
        "# TYPE adit_request_seconds histogram",
        "# TYPE adit_generation gauge",
        &format!("adit_rooms {rooms}"),
    ] {
        assert!(text.lines().any(|found| found == line), "no line `{line}`:\n{text}");
    }
}
