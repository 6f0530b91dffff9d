//! Every route, setting and function of rules is documented.

use adit_tests::{Ran, adit, repository};
use serde_json::Value;

use crate::served;

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
    let manual = std::fs::read_to_string(repository().join("kb/SERVICE.md")).unwrap();
    for route in all {
        let path =
            route.split(' ').nth(1).unwrap().split('{').next().unwrap().trim_end_matches('/').to_owned();
        assert!(manual.contains(&path), "SERVICE.md does not name {route}");
    }
}

#[test]
fn every_setting_of_the_service_is_documented() {
    let help = Ran::new(&std::process::Command::new(adit()).args(["serve", "--help"]).output().unwrap())
        .expecting(0);
    let manual = std::fs::read_to_string(repository().join("kb/SERVICE.md")).unwrap();
    let words = help.stdout.split(|c: char| !(c.is_alphanumeric() || c == '-'));
    let settings: Vec<&str> = words.filter(|word| word.starts_with("--") && word.len() > 3).collect();
    assert!(settings.len() > 6);
    for setting in settings {
        assert!(
            ["--help"].contains(&setting) || manual.contains(setting),
            "SERVICE.md does not name {setting}"
        );
    }
}
