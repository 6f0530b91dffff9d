//! One caller who asks all it can leaves others what is theirs.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::lock::Lock;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::hardness;

/// A site with two callers, and the tokens of both.
fn with_two_callers(arguments: &[&str]) -> (TestSite, Service, [String; 2]) {
    let site = TestSite::example("paper").built();
    let tokens = ["crowd", "other"].map(|name| {
        let made = site.adit("token", &["add", name, "--role", "admin"]).expecting(0);
        format!("Authorization: Bearer {}", made.stdout.trim())
    });
    let service = Service::start_with(&site, &[&["--listen", "127.0.0.1:0"], arguments].concat());
    (site, service, tokens)
}

/// Once, whoever asked after 40 slow questions waited for all of them: 10 s.
#[test]
fn a_crowd_of_slow_questions_of_one_caller_holds_up_nobody_else() {
    let (_site, service, [crowd, other]) = with_two_callers(&[]);
    let endless = "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count(*) FROM c";
    for _ in 0..40 {
        let (address, crowd) = (service.address.clone(), crowd.clone());
        thread::spawn(move || {
            send(&address, &crowd, &json!({"query": endless}).to_string(), None).read(&mut [0; 9])
        });
    }
    thread::sleep(Duration::from_millis(500));
    for _ in 0..3 {
        let began = Instant::now();
        let body = json!({"query": "SELECT 1"});
        assert_eq!(service.ask_as(&[&other], "POST", "/api/sql", Some(&body)).0, 200);
        assert!(began.elapsed() < Duration::from_secs(3), "it took {:?}", began.elapsed());
    }
}

/// Once, a question in SQL on the page waited until all reasons that the same page had asked for were found.
#[test]
fn a_question_in_sql_waits_for_no_reasons_of_its_own_caller() {
    let site = TestSite::example("clinic").built();
    let service = Service::start_with(&site, &["--listen", "127.0.0.1:0"]);
    let ask_how_firm = || {
        let mut stream = TcpStream::connect(&service.address).unwrap();
        let way = "/api/firm?start=dock&goal=ward%2012";
        write!(stream, "GET {way} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", service.address)
            .unwrap();
        stream.set_nonblocking(true).unwrap();
        stream
    };
    let reasons: Vec<TcpStream> = (0..12).map(|_| ask_how_firm()).collect();
    thread::sleep(Duration::from_millis(500));
    assert_eq!(service.ask("POST", "/api/sql", Some(&json!({"query": "SELECT 1"}))).0, 200);
    let found = reasons.iter().filter(|reason| reason.peek(&mut [0]).is_ok()).count();
    assert!(found < 8, "{found} of 12 were found before");
}

/// Once, a crowd's maps and reasons took the cores from robots' questions: these were answered 21 times as late.
#[test]
#[cfg(target_os = "linux")]
fn what_takes_long_leaves_the_cores_to_robots_questions() {
    let (_site, service, [crowd, _]) = with_two_callers(&[]);
    let endless = "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count(*) FROM c";
    let _asked = send(&service.address, &crowd, &json!({"query": endless}).to_string(), None);
    // each thread with how nice it is, as proc(5) has it
    let threads = || {
        let all = std::fs::read_dir(format!("/proc/{}/task", service.pid())).unwrap();
        let stat = |task: std::io::Result<std::fs::DirEntry>| {
            let stat = std::fs::read_to_string(task.ok()?.path().join("stat")).ok()?;
            let (name, rest) = stat.split_once('(')?.1.rsplit_once(')')?;
            Some((name.to_owned(), rest.split_whitespace().nth(16)?.parse::<i32>().ok()?))
        };
        all.filter_map(stat).collect::<Vec<_>>()
    };
    let niceness = |name: &str| {
        let of_name = |(of, nice): (String, i32)| (of == name).then_some(nice);
        threads().into_iter().find_map(of_name)
    };
    assert_eq!(adit_tests::within("it is worked on", || niceness("long")), 5);
    let mut others = threads();
    others.retain(|(name, _)| ["desk", "routes", "tokio-rt-worker"].contains(&name.as_str()));
    assert!(others.len() > 3 && others.iter().all(|(_, nice)| *nice == 0), "{others:?}");
}

/// Edits are made one after the other; once, in the order in which they came.
#[test]
fn an_edit_waits_for_no_crowd_of_edits() {
    let (site, service, [crowd, other]) = with_two_callers(&[]);
    let lock = Lock::hold(&site);
    thread::scope(|scope| {
        let edit = |token: &str, value: f64| {
            service.ask_as(&[token], "POST", "/api/edits", Some(&hardness("SQUAT", value))).0
        };
        let crowd: Vec<_> = (0..30)
            .map(|count| {
                let crowd = crowd.as_str();
                scope.spawn(move || edit(crowd, 10.0 + f64::from(count)))
            })
            .collect();
        thread::sleep(Duration::from_millis(500));
        let other = other.as_str();
        let late = scope.spawn(move || edit(other, 3.0));
        thread::sleep(Duration::from_millis(300));
        drop(lock);
        assert_eq!(late.join().unwrap(), 200);
        assert!(crowd.into_iter().all(|edit| edit.join().unwrap() == 200));
    });
    let who = site.sqlite3("SELECT who FROM history ORDER BY id");
    assert_eq!(who.len(), 31);
    assert!(who.iter().position(|who| who == "other").unwrap() < 3, "{who:?}");
}

#[test]
fn what_is_more_than_a_share_is_refused_and_others_are_answered() {
    let (_site, service, [crowd, other]) = with_two_callers(&["--requests", "8"]);
    // bodies that never come: these are at work until their time is over
    let held: Vec<TcpStream> = (0..6).map(|_| send(&service.address, &crowd, "{", Some(9))).collect();
    thread::sleep(Duration::from_millis(300));
    let (status, refused) = service.ask_as(&[&crowd], "GET", "/api/health", None);
    assert_eq!((status, &refused["error"]["code"]), (429, &json!("service/share")), "{refused}");
    assert_eq!(service.ask_as(&[&other], "GET", "/api/health", None).0, 200);
    drop(held);
    let is_answered = || service.ask_as(&[&crowd], "GET", "/api/health", None).0 == 200;
    adit_tests::within("its share is free again", || is_answered().then_some(()));
}

/// Once, each of 4,096 clients that read nothing could hold 16 MB for ever.
#[test]
fn who_does_not_read_is_hung_up_on() {
    let (_site, service, [crowd, other]) = with_two_callers(&["--answer-seconds", "4"]);
    let long = "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c WHERE x < 16)
                SELECT hex(zeroblob(490000)) FROM c";
    let body = json!({"query": long}).to_string();
    let connections = || open_connections(&service.address);
    let before = connections();
    let unread: Vec<TcpStream> = (0..6).map(|_| send(&service.address, &crowd, &body, None)).collect();
    adit_tests::within("all are let in", || (connections() == before + unread.len()).then_some(()));
    let began = Instant::now();
    let question = json!({"query": "SELECT 1"});
    assert_eq!(service.ask_as(&[&other], "POST", "/api/sql", Some(&question)).0, 200);
    // some are refused at once, since their caller leaves too much unread; the rest go when their time is over
    while connections() > before {
        assert!(began.elapsed() < Duration::from_secs(40), "{} still hold on", connections() - before);
        thread::sleep(Duration::from_millis(100));
    }
    let peak = service.peak_memory();
    assert!(peak < 600 << 20, "the service held {} MB", peak >> 20);
}

/// How many connections the service at an address has taken and not closed. Those that it has itself to a database
/// come and go, and are no caller's.
pub fn open_connections(address: &str) -> usize {
    let port = address.parse::<std::net::SocketAddr>().unwrap().port();
    let local = format!(":{port:04X}");
    let all = std::fs::read_to_string("/proc/net/tcp").unwrap();
    // number, local address, other address, state, …, inode: none before it is taken and after it is closed
    let fields = all.lines().skip(1).map(|line| line.split_whitespace().collect::<Vec<_>>());
    fields.filter(|each| each[1].ends_with(&local) && each[3] != "0A" && each[9] != "0").count()
}

/// A question in SQL, of which no answer is read; of so many bytes, if more are announced than sent.
pub fn send(address: &str, token: &str, body: &str, announced: Option<usize>) -> TcpStream {
    let mut stream = TcpStream::connect(address).unwrap();
    let length = announced.unwrap_or(body.len());
    write!(
        stream,
        "POST /api/sql HTTP/1.1\r\nHost: {address}\r\n{token}\r\nContent-Type: application/json\r\nConnection: close\r\n\
         Content-Length: {length}\r\n\r\n{body}"
    )
    .unwrap();
    stream
}

/// An answer in portions is the same answer.
#[test]
fn a_long_answer_comes_whole() {
    let (_site, service, [_, other]) = with_two_callers(&[]);
    let query = "SELECT hex(zeroblob(400000)) AS a, 'end' AS b";
    let (status, answer) = service.ask_as(&[&other], "POST", "/api/sql", Some(&json!({"query": query})));
    assert_eq!((status, &answer["rows"][0][1]), (200, &Value::from("end")));
    assert_eq!(answer["rows"][0][0].as_str().unwrap().len(), 800_000);
}
