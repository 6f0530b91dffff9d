//! Everybody at once for a long time: who asks, edits, tells, reloads, listens, and reads slowly or never. Memory, descriptors and
//! threads stay level. `ADIT_SOAK=3600` has it last so many seconds, and judges them; a few show that it still runs.

use std::collections::BTreeMap;
use std::io::Read;
use std::net::TcpStream;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::service::{Service, try_request};
use serde_json::{Value, json};

use super::hardness;

/// What the program holds at one moment.
#[derive(Clone, Copy, Debug)]
struct Held {
    kilobytes: usize,
    threads: usize,
    files: usize,
}

impl Held {
    fn by(service: &Service) -> Self {
        let folder = format!("/proc/{}", service.pid());
        let status = std::fs::read_to_string(format!("{folder}/status")).unwrap();
        let of = |name: &str| {
            let line = status.lines().find_map(|line| line.strip_prefix(name)).unwrap();
            line.trim_matches(|c: char| !c.is_ascii_digit()).parse().unwrap()
        };
        let files = std::fs::read_dir(format!("{folder}/fd")).unwrap().count();
        Self { kilobytes: of("VmRSS:"), threads: of("Threads:"), files }
    }
}

/// Medians of some moments.
fn median(held: &[Held]) -> Held {
    let of = |get: fn(&Held) -> usize| {
        let mut values: Vec<usize> = held.iter().map(get).collect();
        values.sort_unstable();
        values[values.len() / 2]
    };
    Held {
        kilobytes: of(|held| held.kilobytes),
        threads: of(|held| held.threads),
        files: of(|held| held.files),
    }
}

struct Soak<'s> {
    site: &'s TestSite,
    service: &'s Service,
    over: AtomicBool,
    /// By what was asked and how it was answered.
    answers: Mutex<BTreeMap<(&'static str, u16), u64>>,
}

const PLACES: [&str; 6] = ["dock", "lobby", "pharmacy", "ward%209", "ward%2012", "archive"];

impl Soak<'_> {
    fn count(&self, what: &'static str, status: u16) {
        *self.answers.lock().unwrap().entry((what, status)).or_default() += 1;
    }

    fn ask(&self, what: &'static str, method: &str, path: &str, body: Option<&Value>) -> Value {
        let answer = try_request(&self.service.address, method, path, body);
        let (status, answer) = answer.unwrap_or_default();
        self.count(what, status);
        // a crowd may be told to come back, and an edit that it is overtaken; nothing else goes wrong
        assert!([200, 409, 429, 503].contains(&status), "{what}: {status} {answer}");
        answer
    }

    /// Does something again and again until it is over; the first turn is of this number.
    fn repeat(&self, pause: u64, first: usize, work: impl Fn(usize)) {
        for turn in first.. {
            if self.over.load(Ordering::Relaxed) {
                break;
            }
            work(turn);
            thread::sleep(Duration::from_millis(pause));
        }
    }

    fn asks(&self, turn: usize) {
        let (start, goal) = (PLACES[turn % 6], PLACES[(turn / 6 + turn + 1) % 6]);
        let between = format!("start={start}&goal={goal}");
        match turn % 12 {
            0 => drop(self.ask("why", "GET", &format!("/api/why?{between}"), None)),
            3 => drop(self.ask("firm", "GET", &format!("/api/firm?{between}"), None)),
            6 => drop(self.ask("map", "GET", "/api/map", None)),
            9 => {
                let sql = json!({"query": "SELECT * FROM action_sequence LIMIT 500"});
                self.ask("sql", "POST", "/api/sql", Some(&sql));
            }
            _ => drop(self.ask("route", "GET", &format!("/api/route?{between}"), None)),
        }
    }

    fn edits(&self, turn: usize) {
        match turn % 5 {
            0 => {
                let blocked =
                    json!({"x": 21.0, "y": 3.0, "heading": 90.0, "for_seconds": 2, "why": "a trolley"});
                self.ask("blocked", "POST", "/api/blocked", Some(&blocked));
            }
            1 => {
                let preview = json!({"edits": [hardness("SQUAT", 9.0)["edit"]]});
                self.ask("preview", "POST", "/api/preview", Some(&preview));
            }
            2 => drop(self.ask("undo", "POST", "/api/edits", Some(&json!({"edit": {"kind": "undo"}})))),
            _ => {
                let value = 4.0 + (turn % 32) as f64 / 16.0;
                self.ask("edit", "POST", "/api/edits", Some(&hardness("SQUAT", value)));
            }
        }
    }

    /// Somebody saves a file, half of the time a broken one.
    fn reloads(&self, turn: usize) {
        let text = if turn.is_multiple_of(2) { "rule \"of mine\" {" } else { "// nothing" };
        self.site.write("rules/mine.rhai", text);
        self.count("file saved", 200);
    }

    fn listens(&self, turn: usize) {
        let mut events = if turn.is_multiple_of(2) {
            self.service.events()
        } else {
            self.service.follow(&format!("start={}&goal=lobby", PLACES[turn % 6].replace("lobby", "dock")))
        };
        events.next(if turn.is_multiple_of(2) { "hello" } else { "route" });
        thread::sleep(Duration::from_millis(100 + (turn % 17) as u64 * 150));
        self.count("listened", 200);
    }

    /// Reads a little of a long answer, or sends half a question, and is gone after a while.
    fn dawdles(&self, turn: usize) {
        let query = json!({"query": "SELECT hex(zeroblob(400000))"}).to_string();
        let body = if turn.is_multiple_of(2) { &query[..4] } else { query.as_str() };
        let mut stream: TcpStream =
            super::shares::send(&self.service.address, "X-Slow: 1", body, Some(query.len()));
        stream.set_read_timeout(Some(Duration::from_millis(500))).unwrap();
        // what does not come is what is tried here
        let read = stream.read(&mut [0; 512]).unwrap_or(0);
        thread::sleep(Duration::from_millis((turn % 7) as u64 * 400));
        self.count("dawdled", if read == 0 { 0 } else { 200 });
    }
}

#[test]
fn memory_descriptors_and_threads_stay_level() {
    let seconds: u64 = std::env::var("ADIT_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(6);
    let site = TestSite::example("clinic").built();
    let service = Service::start(&site);
    let soak =
        Soak { site: &site, service: &service, over: AtomicBool::new(false), answers: Mutex::default() };
    let before = Held::by(&service);
    let mut held = Vec::new();
    thread::scope(|scope| {
        let soak = &soak;
        for first in [0, 4, 8] {
            scope.spawn(move || soak.repeat(40, first, |turn| soak.asks(turn)));
            scope.spawn(move || soak.repeat(50, first, |turn| soak.listens(turn)));
            scope.spawn(move || soak.repeat(50, first + first / 4, |turn| soak.dawdles(turn)));
        }
        // an edit before the first undo
        scope.spawn(move || soak.repeat(400, 3, |turn| soak.edits(turn)));
        scope.spawn(move || soak.repeat(3_000, 0, |turn| soak.reloads(turn)));
        let began = Instant::now();
        let looked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            while began.elapsed() < Duration::from_secs(seconds) {
                thread::sleep(Duration::from_secs(1));
                held.push(Held::by(&service));
            }
        }));
        soak.over.store(true, Ordering::Relaxed);
        looked.unwrap();
    });
    let answers = soak.answers.into_inner().unwrap();
    let sixth = held.len() / 6;
    let (early, late) = (median(&held[sixth..=2 * sixth]), median(&held[held.len() - 1 - sixth..]));
    println!(
        "{seconds} s: {answers:?}; before {before:?}, in the second sixth {early:?}, in the last {late:?}"
    );
    for what in
        ["route", "why", "firm", "map", "sql", "blocked", "preview", "undo", "edit", "listened", "dawdled"]
    {
        let well: u64 =
            answers.iter().filter(|((of, status), _)| *of == what && *status == 200).map(|(_, n)| n).sum();
        assert!(well > 0 || seconds < 60, "nobody was answered: {what}");
    }
    // whoever is gone holds nothing any more
    let open = || super::shares::open_connections(&service.address);
    adit_tests::within("connections are given back", || (open() == 0).then_some(()));
    if seconds >= 300 {
        assert!(late.kilobytes * 10 <= early.kilobytes * 11, "memory grows: {early:?} {late:?}");
        assert!(late.threads <= early.threads + 4 && late.files <= early.files + 12, "{early:?} {late:?}");
    }
    assert_eq!(service.ask("GET", "/api/health", None).0, 200);
}
