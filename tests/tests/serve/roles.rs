//! Who may do what.

use std::fs;
use std::time::Duration;

use adit_tests::TestSite;
use adit_tests::lock::Lock;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::{hardness, served};

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
            ask("PUT", "/api/rules/own.rhai", &json!({"text": "// nothing yet\n"})),
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
    super::within_a_second(|| ask() == 401);
}

/// A token went, and with it the way in: `tokens.toml` emptied by an editor, cut off by a full disk, commented out, removed
/// with its folder's other settings, or its last token taken away. Each of them made everybody an admin.
#[test]
fn a_service_that_asked_for_tokens_stays_closed_when_none_is_left_and_says_so() {
    type Way = (&'static str, fn(&TestSite));
    let ways: [Way; 5] = [
        ("emptied", |site| site.write("tokens.toml", "")),
        ("cut off", |site| {
            let text = site.read("tokens.toml");
            site.write("tokens.toml", &text[..=text.find('\n').unwrap()]);
        }),
        ("commented out", |site| {
            let text = site.read("tokens.toml");
            site.write("tokens.toml", format!("# {}", text.replace('\n', "\n# ")));
        }),
        ("gone", |site| fs::remove_file(site.path().join("tokens.toml")).unwrap()),
        ("its last token removed", |site| {
            let said = site.adit("token", &["remove", "anna"]).expecting(0);
            said.complains(&["that was the last token", "nobody is let in"]);
        }),
    ];
    for (how, take_away) in ways {
        let site = TestSite::example("paper").built();
        let anna = token(&site, "anna", &["admin"]);
        let service = Service::start(&site);
        let as_anna = |token: &str| service.ask_as(&[token], "GET", "/api/site", None).0;
        assert_eq!(as_anna(&anna), 200);
        take_away(&site);
        super::within_a_second(|| as_anna(&anna) == 401);
        let (status, refused) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0)));
        assert_eq!((status, refused["error"]["code"].as_str()), (401, Some("auth/token-missing")), "{how}");
        super::within_a_second(|| service.log().contains("nobody is let in"));
        // a new token opens it again, to its holder
        let ben = token(&site, "ben", &["read"]);
        super::within_a_second(|| as_anna(&ben) == 200);
        assert_eq!(service.ask("GET", "/api/site", None).0, 401, "{how}");
    }
}

#[test]
fn a_service_that_got_its_first_token_while_it_ran_stays_closed_too() {
    let (site, service) = served("paper");
    let ask = || service.ask("GET", "/api/site", None).0;
    assert_eq!(ask(), 200);
    token(&site, "anna", &["read"]);
    super::within_a_second(|| ask() == 401);
    fs::remove_file(site.path().join("tokens.toml")).unwrap();
    std::thread::sleep(Duration::from_secs(1));
    assert_eq!(ask(), 401);
}

#[test]
fn a_file_of_tokens_that_cannot_be_read_lets_in_whom_it_let_in_before_and_is_said() {
    let site = TestSite::example("paper").built();
    let anna = token(&site, "anna", &["read"]);
    let service = Service::start(&site);
    let good = site.read("tokens.toml");
    site.write("tokens.toml", good.replace("sha256", "sha257"));
    super::within_a_second(|| service.log().contains("sha257"));
    let (status, seen) = service.ask_as(&[&anna], "GET", "/api/site", None);
    assert_eq!((status, &seen["problems"][0]["code"]), (200, &json!("tokens/unreadable")), "{seen}");
    assert_eq!(service.ask("GET", "/api/site", None).0, 401);
    // a map that is saved meanwhile is taken, and does not wipe out the word about the tokens
    let mut events = service.events_as(&anna);
    events.next("hello");
    site.edit("map.toml", "height = 15.0", "height = 9.0");
    events.next("changed");
    let seen = service.ask_as(&[&anna], "GET", "/api/site", None).1;
    assert_eq!(seen["problems"][0]["code"], "tokens/unreadable", "{seen}");
    site.write("tokens.toml", good);
    super::within_a_second(|| service.ask_as(&[&anna], "GET", "/api/site", None).1["problems"] == json!([]));
}

#[test]
fn what_is_wrong_with_a_file_of_tokens_is_said_where_it_stands() {
    let site = TestSite::example("paper");
    token(&site, "anna", &["read"]);
    let good = site.read("tokens.toml");
    let twice = good.repeat(2);
    let short = good.replace("sha256 = \"", "sha256 = \"0");
    let wrong: [(&str, &[&str]); 4] = [
        (
            &good.replace("sha256", "sha257"),
            &["tokens.toml:5:1", "unknown field `sha257`", "expected one of `name`"],
        ),
        (
            &good.replace("\"read\"", "\"reed\""),
            &["tokens.toml:4:", "unknown variant `reed`", "expected one of `read`"],
        ),
        (&twice, &["there are two tokens `anna`, expected one for each holder"]),
        (&short, &["`sha256` of the token `anna` is none, expected 64 hexadecimal digits"]),
    ];
    for (text, words) in wrong {
        site.write("tokens.toml", text);
        site.adit("token", &["list"]).expect_status(2).complains(words);
    }
}

#[test]
fn a_file_without_tokens_is_no_open_door_at_the_next_start() {
    let site = TestSite::example("paper").built();
    token(&site, "anna", &["read"]);
    site.adit("token", &["remove", "anna"]).expect_status(0);
    for text in [site.read("tokens.toml"), String::new()] {
        site.write("tokens.toml", text);
        let refused = Service::refused(&site, &["--listen", "127.0.0.1:0"]).expecting(2);
        refused.complains(&["there is no token in", "tokens.toml", "nobody is let in", "adit token"]);
    }
    site.write("tokens.toml", "[[token]\n");
    Service::refused(&site, &["--listen", "127.0.0.1:0"]).expecting(2).complains(&["tokens.toml"]);
}

/// A service that is called by another name is reached through a proxy on this machine: who listens is not who asks.
#[test]
fn without_tokens_it_is_not_called_by_other_names() {
    let site = TestSite::example("paper").built();
    let refused =
        Service::refused(&site, &["--listen", "127.0.0.1:0", "--host", "adit.example"]).expecting(2);
    refused.complains(&["adit.example", "the site has no tokens", "adit token"]);
}

#[test]
fn who_may_come_in_does_not_wait_for_an_edit_that_takes_long() {
    let site = TestSite::example("paper").built();
    let anna = token(&site, "anna", &["tune"]);
    let service = Service::start(&site);
    let lock = Lock::hold(&site);
    std::thread::scope(|scope| {
        let edit =
            scope.spawn(|| service.ask_as(&[&anna], "POST", "/api/edits", Some(&hardness("SQUAT", 3.0))));
        std::thread::sleep(Duration::from_millis(300));
        site.adit("token", &["remove", "anna"]).expect_status(0);
        super::within_a_second(|| service.ask_as(&[&anna], "GET", "/api/site", None).0 == 401);
        assert!(!edit.is_finished(), "the edit still waits for the database");
        drop(lock);
        assert_eq!(edit.join().unwrap().0, 200, "what was begun with a good token is done");
    });
}

#[test]
fn a_token_that_is_taken_away_while_rules_are_saved_is_void_all_the_same() {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    let (anna, ben) = (token(&site, "anna", &["rules"]), token(&site, "ben", &["read"]));
    let service = Service::start(&site);
    let (_, rules) = service.ask_as(&[&anna], "GET", "/api/rules", None);
    let file = rules["files"].as_array().unwrap().iter().find(|file| file["file"] == "doors.rhai").unwrap();
    let text = format!("{}\n// saved once more\n", file["text"].as_str().unwrap());
    let save = json!({"text": text, "version": file["version"]});
    site.adit("token", &["remove", "ben"]).expect_status(0);
    assert_eq!(service.ask_as(&[&anna], "PUT", "/api/rules/doors.rhai", Some(&save)).0, 200);
    super::within_a_second(|| service.ask_as(&[&ben], "GET", "/api/site", None).0 == 401);
}

#[test]
fn a_stream_of_events_ends_with_the_token_that_opened_it() {
    let site = TestSite::example("paper").built();
    let anna = token(&site, "anna", &["read"]);
    token(&site, "ben", &["read"]);
    let service = Service::start(&site);
    let mut events = service.events_as(&anna);
    events.next("hello");
    let mut follower = service.stream(&anna, "/api/route/follow?start=f&goal=e");
    follower.next("route");
    site.adit("token", &["remove", "anna"]).expect_status(0);
    events.end();
    follower.end();
    let (status, _) = service.ask("GET", "/api/route/follow?start=f&goal=e", None);
    assert_eq!(status, 401);
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
fn whoever_asks_from_the_same_machine_is_sent_everything_unpacked_and_a_proxy_there_packed() {
    let site = TestSite::example("paper").built();
    let anna = token(&site, "anna", &["read"]);
    let service = Service::start_with(&site, &["--host", "adit.example"]);
    let is_packed = |headers: &[&str]| {
        let headers = [&["Accept-Encoding: gzip", anna.as_str()], headers].concat();
        // gzip begins so, after the length of a chunk
        service.bytes_as(&headers, "/api/map").windows(2).take(16).any(|two| two == [0x1f, 0x8b])
    };
    assert!(!is_packed(&[]));
    assert!(is_packed(&["Host: adit.example"]));
    assert!(is_packed(&["X-Forwarded-For: 192.0.2.1"]));
    assert!(is_packed(&["Via: 1.1 gate"]));
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
