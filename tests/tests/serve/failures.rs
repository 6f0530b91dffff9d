//! Every failure has one shape.

use adit::Code;
use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::served;

/// Fails unless an answer is a failure as the description says it.
#[track_caller]
fn expect_shape(status: u16, answer: &Value, asked: &str) {
    let error = &answer["error"];
    assert!(status >= 400, "{asked} did not fail: {answer}");
    assert_eq!(error["status"], json!(status), "{asked}: {answer}");
    let code = Code::all().find(|code| error["code"] == code.as_str());
    assert_eq!(code.map(|code| code.http().as_u16()), Some(status), "{asked}: {answer}");
    assert!(error["message"].as_str().is_some_and(|message| !message.is_empty()), "{asked}: {answer}");
    assert!(error.get("help").is_some() && error["problems"].is_array(), "{asked}: {answer}");
    assert_eq!(answer.as_object().unwrap().len(), 1, "{asked}: {answer}");
}

/// All routes with their methods, with something in the place of their parameters.
fn routes(service: &Service) -> Vec<(String, String)> {
    let (_, description) = service.ask("GET", "/api/openapi.json", None);
    let mut routes = Vec::new();
    for (path, methods) in description["paths"].as_object().unwrap() {
        for method in methods.as_object().unwrap().keys() {
            let path = path.split('{').next().unwrap().to_owned() + if path.contains('{') { "9" } else { "" };
            routes.push((method.to_uppercase(), path));
        }
    }
    assert!(routes.len() > 20);
    routes
}

#[test]
fn without_a_token_and_with_a_wrong_one_on_every_route() {
    let site = TestSite::example("paper").built();
    site.adit("token", &["add", "anna", "--role", "read"]).expect_status(0);
    let service = Service::start(&site);
    let (_open_site, open) = served("paper");
    for (method, path) in routes(&open) {
        if ["/api/health", "/api/ready"].contains(&path.as_str()) {
            assert_eq!(
                service.ask_as(&[], &method, &path, None).0,
                200,
                "who watches the service has no token"
            );
            continue;
        }
        for (headers, code) in
            [(&[][..], "auth/token-missing"), (&["Authorization: Bearer adit_x"][..], "auth/token-unknown")]
        {
            let (status, answer) = service.ask_as(headers, &method, &path, None);
            expect_shape(status, &answer, &format!("{method} {path}"));
            assert_eq!((status, answer["error"]["code"].as_str()), (401, Some(code)), "{method} {path}");
        }
    }
}

#[test]
fn broken_bodies_questions_and_methods_on_every_route() {
    let (_site, service) = served("paper");
    for (method, path) in routes(&service) {
        let asked = format!("{method} {path}");
        if ["POST", "PUT"].contains(&method.as_str()) {
            for body in ["{", "[]", "{\"nonsense\": 1}", ""] {
                let (status, answer) = service.ask(&method, &path, Some(&Value::String(body.to_owned())));
                expect_shape(status, &answer, &format!("{asked} {body}"));
            }
            let (status, answer) =
                service.ask_as(&["Content-Type: text/html"], &method, &path, Some(&json!({})));
            expect_shape(status, &answer, &asked);
            let long = Value::String(format!("\"{}\"", "x".repeat(3 << 20)));
            let (status, answer) = service.ask(&method, &path, Some(&long));
            expect_shape(status, &answer, &asked);
            assert_eq!(status, 413, "{asked}");
        }
        let (status, answer) = service.ask("PATCH", &path, None);
        expect_shape(status, &answer, &format!("PATCH {path}"));
        assert_eq!(status, 405, "{path}");
    }
    for path in ["/api", "/api/rooms", "/assets/none.js", "/assets/..%2f..%2fCargo.toml", "/%00"] {
        let (status, answer) = service.ask("GET", path, None);
        expect_shape(status, &answer, path);
        assert_eq!(status, 404, "{path}");
    }
}

#[test]
fn routes_that_cannot_be_asked() {
    let (_site, service) = served("clinic");
    let cases = [
        ("", 400, "service/question"),
        ("start=dock", 400, "service/question"),
        ("start=dock&goal=ward%206&by=foot", 400, "service/question"),
        ("start=dok&goal=ward%206", 404, "route/unknown-start"),
        ("start=dock&goal=nowhere", 404, "route/unknown-goal"),
        ("start=dock&goal=1e9,1e9", 400, "route/outside"),
        ("start=dock&goal=ward%206&robot=cart", 404, "route/unknown-robot"),
    ];
    for (question, expected, code) in cases {
        let (status, answer) = service.ask("GET", &format!("/api/route?{question}"), None);
        expect_shape(status, &answer, question);
        assert_eq!(
            (status, answer["error"]["code"].as_str()),
            (expected, Some(code)),
            "{question}: {answer}"
        );
    }
    let (_, answer) = service.ask("GET", "/api/route?start=dok&goal=ward%206", None);
    assert!(answer["error"]["message"].as_str().unwrap().contains("did you mean `dock`"), "{answer}");
}

#[test]
fn what_stands_behind_a_question_mark_where_nothing_is_read_of_it_is_refused_and_nothing_is_done() {
    let (site, service) = served("clinic");
    let close = serde_json::json!({"edit": {"kind": "close", "what": "doorway 5"}});
    let cases = [
        ("POST", "/api/edits?dry_run=true", Some(&close), "dry_run"),
        ("POST", "/api/areas?for_seconds=1", Some(&close), "for_seconds"),
        ("GET", "/api/map?x=1&y=2", None, "x"),
        ("GET", "/api/events?since=1", None, "since"),
        ("GET", "/api/tables?table=robots", None, "table"),
    ];
    for (method, path, body, name) in cases {
        let (status, answer) = service.ask(method, path, body);
        expect_shape(status, &answer, path);
        assert_eq!((status, answer["error"]["code"].as_str()), (400, Some("service/question")), "{answer}");
        assert!(
            answer["error"]["message"].as_str().unwrap().starts_with(&format!("`{name}` means nothing here")),
            "{answer}"
        );
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM history"), ["0"]);
    assert_eq!(service.ask("GET", "/api/map?", None).0, 200);
}
