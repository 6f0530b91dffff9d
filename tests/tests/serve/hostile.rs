//! Small texts that would take much memory or time: each ends soon, in little, and leaves the service answering.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::{hardness, served};

/// What the service may come to hold while hostile texts are worked on.
const MEMORY: u64 = 700 << 20;

/// How long one of them may take: longer than their deadlines by no more than a slow machine explains.
const PATIENCE: Duration = Duration::from_secs(30);

#[track_caller]
fn expect_soon(began: Instant, what: &str) {
    assert!(began.elapsed() < PATIENCE, "{what} took {:?}", began.elapsed());
}

#[track_caller]
fn expect_little(service: &Service, what: &str) {
    let peak = service.peak_memory();
    assert!(peak < MEMORY, "the service held {} MB after {what}", peak >> 20);
    assert_eq!(service.ask("GET", "/api/route?start=f&goal=e", None).0, 200);
}

fn refused(service: &Service, query: &str) -> String {
    let began = Instant::now();
    let (status, answer) = service.ask("POST", "/api/sql", Some(&json!({"query": query})));
    let query: String = query.chars().take(100).collect();
    expect_soon(began, &query);
    assert_eq!((status, &answer["error"]["code"]), (400, &json!("sql/refused")), "{query}: {answer}");
    answer["error"]["message"].as_str().unwrap().to_owned()
}

/// Found in review: 6 KB of SQL took 8 GB, since a row was copied before it was measured.
#[test]
fn one_row_of_many_long_values_takes_little() {
    let site = TestSite::example("paper").built();
    // not the deadline is to stop them
    let service = Service::start_with(&site, &["--listen", "127.0.0.1:0", "--sql-seconds", "20"]);
    let columns = |value: &str, count: usize| format!("SELECT {}", vec![value; count].join(", "));
    assert!(refused(&service, &columns("zeroblob(15900000)", 500)).contains("too many columns"));
    assert!(refused(&service, &columns("zeroblob(15900000)", 150)).contains("too big"));
    // as much as is allowed: the row is left out of the answer, which says so
    for query in [columns("zeroblob(999000)", 200), columns("hex(zeroblob(490000))", 100)] {
        let (status, answer) = service.ask("POST", "/api/sql", Some(&json!({"query": query})));
        assert_eq!(
            (status, &answer["rows"], &answer["truncated"]),
            (200, &json!([]), &json!(true)),
            "{query}: {answer}"
        );
    }
    let heap = "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c)
                SELECT length(json_group_array(hex(zeroblob(400000)))) FROM c";
    assert!(refused(&service, heap).contains("more memory than a query may"));
    expect_little(&service, "rows of long values");
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0))).0, 200);
}

/// Found in review: one instruction of SQLite is never interrupted, and these took time with the square of a length.
#[test]
fn no_function_of_sql_outlives_its_deadline() {
    let (_site, service) = served("paper");
    let a = "replace(hex(zeroblob(240000)), '0', 'a')";
    let b = "replace(hex(zeroblob(120000)), '0', 'a') || 'b'";
    for expression in [
        "instr(zeroblob(900000), zeroblob(450000) || x'01')".to_owned(),
        format!("instr({a}, {b})"),
        format!("length(replace({a}, {b}, 'c'))"),
        format!("length(trim({a}, replace(hex(zeroblob(240000)), '0', 'b') || 'a'))"),
        format!("{a} LIKE '%{}b'", "a".repeat(90)),
        format!("{a} GLOB '*{}b'", "a".repeat(90)),
    ] {
        let began = Instant::now();
        // once, and again and again until the deadline stops it
        let query = format!("SELECT {expression}");
        let (status, answer) = service.ask("POST", "/api/sql", Some(&json!({"query": query})));
        expect_soon(began, &query);
        assert_eq!(status, 200, "{query}: {answer}");
        // what hangs on the row is not computed once for all
        let of_row = expression.replace("0000)", "0000 + x % 2)");
        let often = format!(
            "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count({of_row}) FROM c"
        );
        let began = Instant::now();
        assert!(refused(&service, &often).contains("was stopped after 1s"), "{often}");
        expect_soon(began, &often);
    }
    let many = format!("SELECT {}", vec![format!("({a} LIKE '%{}b')", "a".repeat(90)); 150].join(", "));
    assert!(refused(&service, &many).contains("a query may name"));
    for forbidden in ["json_pretty('[]')", "json_patch('{}', '{}')", "unhex('00', '1')"] {
        refused(&service, &format!("SELECT {forbidden}"));
    }
    expect_little(&service, "slow functions");
}

/// SQLite's own are replaced for users, and must mean the same.
#[test]
fn functions_of_texts_mean_what_they_mean_elsewhere() {
    let (site, service) = served("paper");
    let arguments = ["NULL", "''", "'aäa'", "'ä'", "'abcabc'", "'bc'", "12.5", "'.'", "x'61c3a4'", "x'c3a4'"];
    let mut expressions = Vec::new();
    for one in arguments {
        for other in arguments {
            expressions.push(format!("instr({one}, {other})"));
            for function in ["trim", "ltrim", "rtrim"] {
                expressions.push(format!("quote({function}({one}, {other}))"));
            }
            for by in ["NULL", "''", "'öö'"] {
                // a number of which nothing is replaced stayed one in older versions
                expressions.push(format!("quote(replace(CAST({one} AS TEXT), {other}, {by}))"));
            }
        }
    }
    for part in expressions.chunks(100) {
        let query = format!("SELECT {}", part.join(", "));
        let (status, answer) = service.ask("POST", "/api/sql", Some(&json!({"query": query})));
        assert_eq!(status, 200, "{answer}");
        let ours = answer["rows"][0].as_array().unwrap().iter().map(|value| match value {
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            number => number.to_string(),
        });
        let theirs = site.sqlite3(&query).join("\n");
        for ((expression, ours), theirs) in part.iter().zip(ours).zip(theirs.split('|')) {
            assert_eq!(ours, theirs, "{expression}");
        }
    }
}

/// A served copy of the paper's example with rules of its own.
fn with_rules() -> (TestSite, Service) {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    let service = Service::start(&site);
    (site, service)
}

fn check(service: &Service, text: &str) -> Value {
    let began = Instant::now();
    let body = json!({"file": "hostile.rhai", "text": text});
    let (status, answer) = service.ask("POST", "/api/rules/check", Some(&body));
    expect_soon(began, text);
    assert_eq!(status, 200, "{answer}");
    answer
}

/// Found in review: `replace` on two texts of 60,000 letters took 3.6 GB, since rhai measures what a function gave.
#[test]
fn a_rule_that_makes_much_of_little_takes_little() {
    let (_site, service) = with_rules();
    let grow = "while false { } let t = \"\"; t.pad(60000, \"y\"); let u = \"\"; u.pad(60000, \"z\");";
    for body in [
        "t.replace(\"y\", u);",
        "t.replace('y', u);",
        "t.replace(\"\", u);",
        "t.pad(60000000000, u);",
        "let a = []; a.pad(5000, [[1, 2, 3], t]);",
        "let a = [[]]; a.pad(9000, 1); let b = []; b.pad(9000, a);",
        "let t = [t, u]; let s = \"\"; for i in 0..30 { s += t; s += s; }",
    ] {
        let rule = format!("rule \"hostile\" each door in DOORS then {{ {grow} {body} door.colour = 1; }}");
        let answer = check(&service, &rule);
        let failures = answer["tests"]["failures"].to_string();
        assert!(failures.contains("rule \\\"hostile\\\""), "{body}: {answer}");
    }
    expect_little(&service, "rules that grow");
}

/// Found in review: each of 300 rules had its own 10 s, in each of the tests.
#[test]
fn all_rules_of_a_check_together_have_one_deadline() {
    let (_site, service) = with_rules();
    let slow = "fn slow(x) { let n = 0; for i in 0..240000 { n += i; } n }\n";
    let rule = |number: usize| {
        format!("rule \"slow {number}\" each door in DOORS then {{ door.p{number} = slow(door.door); }}\n")
    };
    let text: String = std::iter::once(slow.to_owned()).chain((0..300).map(rule)).collect();
    let answer = check(&service, &text);
    assert!(answer["tests"]["failures"].to_string().contains("took longer"), "{answer}");
    expect_little(&service, "slow rules");
}

/// What is tried runs: whoever may only read cannot have the service run anything.
#[test]
fn rules_are_tried_by_those_who_may_edit_them() {
    let (site, _) = with_rules();
    let token = |name: &str, role: &str| {
        let made = site.adit("token", &["add", name, "--role", role]).expecting(0);
        format!("Authorization: Bearer {}", made.stdout.trim())
    };
    let (reader, author) = (token("reader", "read"), token("author", "rules"));
    let service = Service::start(&site);
    let body = json!({"file": "doors.rhai", "text": site.read("rules/doors.rhai")});
    let ask = |token: &str| service.ask_as(&[token], "POST", "/api/rules/check", Some(&body)).0;
    assert_eq!((ask(&reader), ask(&author)), (403, 200));
}

/// The files of a folder beside this one, by name.
fn folder(name: &str) -> Vec<(String, Vec<u8>)> {
    let folder = adit_tests::repository().join("tests/tests/hostile").join(name);
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            let file = entry.unwrap().path();
            (file.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(file).unwrap())
        })
        .collect();
    files.sort();
    assert!(files.len() > 5, "{name}");
    files
}

/// The time of a question that everybody asks, as far as nothing else on the machine keeps it waiting: the least of many.
fn usual(service: &Service) -> Duration {
    let times = (0..31).map(|_| {
        let began = Instant::now();
        assert_eq!(service.ask("GET", "/api/route?start=f&goal=e", None).0, 200);
        began.elapsed()
    });
    times.min().unwrap()
}

/// Sends bytes that are no request, or hardly one, and reads what comes until the service hangs up, or for a moment.
fn send(service: &Service, bytes: &[u8]) -> String {
    let mut stream = TcpStream::connect(&service.address).unwrap();
    stream.set_read_timeout(Some(Duration::from_millis(500))).unwrap();
    // who is refused at once may be hung up on while it still speaks
    stream.write_all(bytes).ok();
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).ok();
    String::from_utf8_lossy(&answer).into_owned()
}

#[test]
fn the_folder_of_hostile_texts_leaves_the_service_answering_at_its_usual_speed() {
    let (_site, service) = with_rules();
    let before = usual(&service);
    for (name, text) in folder("rules") {
        let text = String::from_utf8_lossy(&text).into_owned();
        let began = Instant::now();
        let body = json!({"file": "hostile.rhai", "text": text});
        let (status, answer) = service.ask("POST", "/api/rules/check", Some(&body));
        expect_soon(began, &name);
        assert!(matches!(status, 200 | 400 | 413), "{name}: {status} {answer}");
    }
    for (name, query) in folder("sql") {
        let query = String::from_utf8_lossy(&query).into_owned();
        let began = Instant::now();
        let (status, answer) = service.ask("POST", "/api/sql", Some(&json!({"query": query})));
        expect_soon(began, &name);
        assert!(matches!(status, 200 | 400), "{name}: {status} {answer}");
    }
    for (name, request) in folder("requests") {
        let began = Instant::now();
        let answer = send(&service, &request);
        expect_soon(began, &name);
        assert!(answer.is_empty() || answer.starts_with("HTTP/1.1 4"), "{name}: {answer}");
    }
    expect_little(&service, "a folder of hostile texts");
    let after = usual(&service);
    assert!(after <= 3 * before + Duration::from_millis(5), "{after:?}, and {before:?} before");
    assert_eq!(service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0))).0, 200);
}
