//! Who may do what.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use crate::{hardness, served};

fn token(site: &TestSite, name: &str, roles: &[&str]) -> String {
    let mut arguments = vec!["add", name];
    for role in roles {
        arguments.extend(["--role", role]);
    }
    let made = site.adit("token", &arguments).expecting(0);
    format!("Authorization: Bearer {}", made.stdout.trim())
}

#[test]
fn a_token_allows_what_its_roles_say_and_no_more() {
    let site = TestSite::example("paper").built();
    let holders = [
        ("reader", token(&site, "reader", &["read"]), [false, false, false, false]),
        ("analyst", token(&site, "analyst", &["query"]), [true, false, false, false]),
        ("robot", token(&site, "robot", &["tell"]), [false, true, false, false]),
        ("anna", token(&site, "anna", &["tune"]), [false, true, true, false]),
        ("ben", token(&site, "ben", &["rules"]), [false, false, false, true]),
        ("boss", token(&site, "boss", &["admin"]), [true, true, true, true]),
    ];
    let service = Service::start(&site);
    let fact = json!({"class": "DOORS", "object": "door 7", "property": "hardness", "value": 9});
    for (name, token, may) in holders {
        let ask =
            |method: &str, path: &str, body: &Value| service.ask_as(&[&token], method, path, Some(body)).0;
        assert_eq!(service.ask_as(&[&token], "GET", "/api/route?start=f&goal=e", None).0, 200, "{name}");
        let did = [
            ask("POST", "/api/sql", &json!({"query": "SELECT 1"})),
            ask("POST", "/api/facts", &fact),
            ask("POST", "/api/edits", &hardness("SQUAT", 3.0)),
            ask("POST", "/api/rules/adopt", &json!({})),
        ];
        for (status, may) in did.into_iter().zip(may) {
            assert_eq!(status != 403, may, "{name}: {did:?}");
        }
        let (_, seen) = service.ask_as(&[&token], "GET", "/api/site", None);
        assert_eq!(seen["who"], name);
    }
    let (_, history) = service.ask_as(&[&token(&site, "auditor", &["read"])], "GET", "/api/history", None);
    assert!(history["error"]["code"] == "auth/token-unknown" || history["edits"][0]["who"] == "boss");
}

#[test]
fn a_token_that_is_taken_away_is_void_within_a_second() {
    let site = TestSite::example("paper").built();
    let anna = token(&site, "anna", &["tune"]);
    token(&site, "ben", &["tune"]);
    let service = Service::start(&site);
    let ask = || service.ask_as(&[&anna], "GET", "/api/site", None).0;
    assert_eq!(ask(), 200);
    site.adit("token", &["remove", "anna"]).expect_status(0);
    crate::within_a_second(|| ask() == 401);
}

#[test]
fn pages_from_elsewhere_cannot_call_it() {
    let (_site, service) = served("paper");
    let ask = |headers: &[&str]| service.ask_as(headers, "POST", "/api/edits", Some(&hardness("SQUAT", 3.0)));
    assert_eq!(ask(&["Host: rebound.example:80"]).1["error"]["code"], "auth/host");
    assert_eq!(ask(&["Origin: http://elsewhere.example"]).1["error"]["code"], "auth/origin");
    assert_eq!(ask(&["Origin: null"]).1["error"]["code"], "auth/origin");
    assert_eq!(ask(&[&format!("Origin: http://{}", service.address)]).0, 200);
}

#[test]
fn without_tokens_it_is_not_reached_from_elsewhere() {
    let site = TestSite::example("paper").built();
    let refused = site.adit("serve", &["--listen", "0.0.0.0:0"]).expecting(2);
    refused.complains(&["0.0.0.0:0 can be reached from elsewhere, and the site has no tokens", "adit token"]);
}

#[test]
fn the_file_of_tokens_does_not_hold_them() {
    let site = TestSite::example("paper").built();
    let anna = token(&site, "anna", &["tune"]);
    let text = site.read("tokens.toml");
    assert!(text.contains("anna") && !text.contains(anna.rsplit(' ').next().unwrap()));
    let told_twice = site.adit("token", &["add", "anna"]).expecting(2);
    told_twice.complains(&["there is a token `anna` already"]);
    let listed = site.adit("token", &["list"]).expecting(0);
    assert!(listed.stdout.contains("anna") && !listed.stdout.contains("adit_"));
}
