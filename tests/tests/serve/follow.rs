//! Routes that are followed: whoever follows one holds the best route there is, and knows why it is another one.

use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::oracle::random::Chance;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::{hardness, served};

/// How soon after an edit a follower holds the route that is the best since.
const SOON: Duration = Duration::from_millis(500);

/// What is not heard of by then is missed.
const MISSED: Duration = Duration::from_secs(5);

/// The way that most tests follow.
pub const WAY: &str = "start=dock&goal=ward%2012";

/// What is said of a route, whatever else happened to the site.
pub fn route(answer: &Value) -> Value {
    let mut route = answer.clone();
    route.as_object_mut().unwrap().remove("generation");
    route
}

pub fn asked(service: &Service, question: &str) -> Value {
    let (status, answer) = service.ask("GET", &format!("/api/route?{question}"), None);
    assert_eq!(status, 200, "{answer}");
    route(&answer)
}

/// An edit of anna's.
fn edit(service: &Service, edit: &Value, why: &str) {
    let body = json!({"edit": edit, "why": why});
    let (status, answer) = service.ask_as(&["X-Adit-Who: anna"], "POST", "/api/edits", Some(&body));
    assert_eq!(status, 200, "{answer}");
}

fn close(service: &Service, what: &str) {
    edit(service, &json!({"kind": "close", "what": what}), "spill");
}

fn open(service: &Service, what: &str) {
    edit(service, &json!({"kind": "open", "what": what}), "mopped");
}

/// The doorways that a route says it passes.
fn doorways(route: &Value) -> Vec<String> {
    let steps = route["steps"].as_array().unwrap().iter();
    steps.filter_map(|step| step["doorway"].as_str().map(str::to_owned)).collect()
}

/// The doorway of the usual way about which there is another way.
pub fn doorway(first: &Value) -> String {
    doorways(&first["route"])[1].clone()
}

#[track_caller]
pub fn says(event: &Value, words: &[&str]) {
    let said = event["words"].as_str().unwrap();
    for word in words {
        assert!(said.contains(word), "`{said}` does not say `{word}`");
    }
}

#[test]
fn a_follower_hears_what_changed_and_why() {
    let (_site, service) = served("clinic");
    let mut follower = service.follow("from=dock&to=ward%2012");
    let first = follower.next("route");
    assert_eq!(route(&first["route"]), asked(&service, WAY), "`from` and `to` are other words");
    assert_eq!((&first["cost_before"], &first["changes"]), (&Value::Null, &json!([])));
    let door = doorway(&first);
    close(&service, &door);
    let other = follower.next("route");
    assert_eq!(other["cost_before"], first["route"]["cost"]);
    assert_eq!(route(&other["route"]), asked(&service, WAY));
    says(&other, &["another way", "instead of", &format!("{door} at ("), "is closed", "anna:", "(spill)"]);
    assert_eq!(other["changes"][0]["who"], "anna");
    close(&service, "ward 12");
    let none = follower.next("route");
    assert_eq!(none["route"]["status"], "no_route");
    says(&none, &["there is no way any more", "and ward 12, is closed", "anna: ward 12 is closed"]);
    open(&service, "ward 12");
    says(&follower.next("route"), &["there is a way again", "ward 12 is open (mopped)"]);
    open(&service, &door);
    let last = follower.next("route");
    says(&last, &["another way", "no longer: doorway "]);
    assert_eq!(route(&last["route"]), route(&first["route"]), "to the bit");
    // the same way, at another price
    let (_, edited) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 4.1)));
    let dearer = follower.next("route");
    assert_eq!(dearer["route"]["generation"], edited["generation"]);
    says(&dearer, &["costs", "instead of", "robots.robot/SQUAT.hardness: 4 → 4.1"]);
}

#[test]
fn what_does_not_change_a_route_is_not_said_of_it() {
    let (site, service) = served("clinic");
    let mut follower = service.follow(WAY);
    let first = follower.next("route");
    let passed = doorways(&first["route"]);
    let all = site
        .sqlite3("SELECT 'doorway ' || doorway FROM doorways WHERE name IS NULL OR name LIKE 'doorway %'");
    for door in all.iter().filter(|door| !passed.contains(door)).take(3) {
        close(&service, door);
    }
    assert_eq!(asked(&service, WAY), route(&first["route"]), "these doorways are elsewhere");
    close(&service, "ward 12");
    let heard = follower.next("route");
    says(&heard, &["there is no way any more"]);
    // whoever was slow to look names what it had not looked at, too
    let last = heard["changes"].as_array().unwrap().last().unwrap();
    assert!(last["what"].as_str().unwrap().starts_with("ward 12 is closed"), "{heard}");
    assert_eq!(heard["cost_before"], first["route"]["cost"]);
}

/// Rooms are cut along what is laid, and numbered anew.
#[test]
fn a_way_whose_rooms_have_other_numbers_is_the_same_way() {
    let (_site, service) = served("clinic");
    let mut follower = service.follow(WAY);
    let first = follower.next("route");
    let (x, y) = (&first["route"]["waypoints"][0]["x"], &first["route"]["waypoints"][0]["y"]);
    let (_, map) = service.ask("GET", "/api/map", None);
    let far = map["places"].as_array().unwrap().iter().max_by_key(|place| {
        let aside =
            |axis: &str, from: &serde_json::Value| place[axis].as_f64().unwrap() - from.as_f64().unwrap();
        (aside("x", x).hypot(aside("y", y)) * 100.0) as i64
    });
    let (x, y) = (far.unwrap()["x"].as_f64().unwrap(), far.unwrap()["y"].as_f64().unwrap());
    let area = json!({"name": "far", "corners": [[x, y], [x + 0.3, y + 0.3]], "properties": {"kind": "wet"}});
    let (status, laid) = service.ask("POST", "/api/areas", Some(&area));
    assert_eq!(status, 200, "{laid}");
    let heard = follower.next("route");
    assert_eq!(heard["route"]["waypoints"], first["route"]["waypoints"]);
    says(&heard, &["the same way costs", "by rooms and doors that have other numbers"]);
}

#[test]
fn a_follower_that_moves_is_led_from_where_it_is() {
    let (_site, service) = served("clinic");
    let mut follower = service.follow(WAY);
    let first = follower.next("route");
    let points = first["route"]["waypoints"].as_array().unwrap();
    let (x, y) = (points[2]["x"].as_f64().unwrap(), points[2]["y"].as_f64().unwrap());
    let here = format!("start={x},{y}&goal=ward%2012");
    let path = format!("/api/route/follow/{}", first["follower"].as_str().unwrap());
    let (status, answer) = service.ask("POST", &path, Some(&json!({"x": x, "y": y})));
    assert_eq!((status, route(&answer)), (200, asked(&service, &here)));
    // a point at which it cannot be is refused, and it is where it was
    let (status, refused) = service.ask("POST", &path, Some(&json!({"x": -50.0, "y": 3.0})));
    assert_eq!((status, &refused["error"]["code"]), (400, &json!("route/outside")));
    // nor one in the map at which none of its states fits
    let near_wall = json!({"x": 0.1, "y": 0.1});
    let (status, refused) = service.ask("POST", &path, Some(&near_wall));
    assert_eq!((status, &refused["error"]["code"]), (400, &json!("route/unfit")), "{refused:#}");
    let door = doorways(&answer).pop().unwrap();
    close(&service, &door);
    let other = follower.next("route");
    assert_eq!(route(&other["route"]), asked(&service, &here));
    assert_eq!(other["cost_before"], answer["cost"]);
    drop(follower);
    let (status, refused) = service.ask("POST", "/api/route/follow/nobody", Some(&json!({"x": x, "y": y})));
    assert_eq!((status, &refused["error"]["code"]), (404, &json!("follow/unknown")));
}

#[test]
fn a_closing_that_ends_by_itself_is_heard_when_it_ends() {
    let (_site, service) = served("clinic");
    let mut follower = service.follow(WAY);
    let first = follower.next("route");
    let door = doorway(&first);
    edit(&service, &json!({"kind": "close", "what": door, "for_seconds": 2}), "");
    let ends = Instant::now() + Duration::from_secs(2);
    follower.next("route");
    let again = follower.next("route");
    let late = Instant::now().saturating_duration_since(ends);
    assert!(late < SOON, "{late:?}");
    says(&again, &["clock: fact 1 (DOORWAYS ", "closed = true) has ended", "no longer: doorway "]);
    assert_eq!(route(&again["route"]), route(&first["route"]));
}

#[test]
fn what_cannot_be_followed_is_refused_before_a_stream_begins() {
    let (_site, service) = served("paper");
    for (question, status, code) in [
        ("start=f", 400, "service/question"),
        ("start=f&goal=e&at=3", 400, "service/question"),
        ("start=f&goal=nowhere", 404, "route/unknown-goal"),
        ("start=f&goal=e&robot=cart", 404, "route/unknown-robot"),
        ("start=f&goal=e&within=-1", 400, "route/within"),
    ] {
        let (was, refused) = service.ask("GET", &format!("/api/route/follow?{question}"), None);
        assert_eq!((was, &refused["error"]["code"]), (status, &json!(code)), "{question}");
    }
    let full = TestSite::example("paper").built();
    let full = Service::start_with(&full, &["--listen", "127.0.0.1:0", "--subscribers", "2"]);
    let (mut events, mut follower) = (full.events(), full.follow("start=f&goal=e"));
    events.next("hello");
    follower.next("route");
    let (status, refused) = full.ask("GET", "/api/route/follow?start=f&goal=e", None);
    assert_eq!((status, &refused["error"]["code"]), (503, &json!("service/busy")));
}

/// It once read what had been the best some hundred routes ago.
#[test]
fn a_follower_that_reads_late_hears_of_the_newest_route_soon() {
    let (_site, service) = served("paper");
    let question = "start=f&goal=e";
    let follower = service.follow(question);
    let edits = 600;
    for round in 0..edits {
        let (status, _) =
            service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 3.0 + f64::from(round % 2) + 0.01)));
        assert_eq!(status, 200);
    }
    let (_, edited) = service.ask("POST", "/api/edits", Some(&hardness("SQUAT", 9.0)));
    let now = asked(&service, question);
    let heard = follower.heard("route");
    let mut words = 0;
    loop {
        let (_, event) = heard.recv_timeout(MISSED).unwrap();
        words += 1;
        if route(&event["route"]) == now {
            break;
        }
    }
    assert!(edited["generation"].as_u64().unwrap() > edits as u64);
    assert!(words < edits / 2, "{words} words were read of {edits} edits");
}

#[test]
fn a_follower_of_random_closings_always_holds_the_best_route() {
    let (site, service) = served("clinic");
    let delays = follow_closings(&site, &service, (WAY, 60, 1));
    assert!(delays.len() > 20, "{} of the closings changed the route", delays.len());
    let soon = delays.iter().filter(|delay| **delay < SOON).count();
    assert!(soon * 2 > delays.len(), "{soon} of {} were heard of soon", delays.len());
}

/// On a machine that has nothing else to do.
#[test]
#[ignore = "minutes; cargo test --workspace --test serve thousand -- --ignored --nocapture"]
fn followers_of_a_thousand_random_closings_always_hold_the_best_route() {
    for (example, question, seed) in [("clinic", WAY, 2), ("hospital", "start=dock&goal=ward%206", 3)] {
        let (site, service) = served(example);
        let mut delays = follow_closings(&site, &service, (question, 1_000, seed));
        delays.sort();
        let at = |share: usize| delays[(delays.len() - 1) * share / 100].as_secs_f64() * 1e3;
        println!(
            "{example}: 1,000 closings, {} other routes, heard {:.1} ms (median), {:.1} ms (p99), {:.1} ms (most) \
             after the edit was made",
            delays.len(),
            at(50),
            at(99),
            at(100)
        );
        assert!(at(100) < SOON.as_secs_f64() * 1e3);
    }
}

/// Closes and opens doorways at random, and compares what the follower holds with what the service answers; how long after
/// the edit was answered the follower heard of it, where it led to another route.
fn follow_closings(
    site: &TestSite,
    service: &Service,
    (question, count, seed): (&str, usize, u64),
) -> Vec<Duration> {
    let all = site.sqlite3("SELECT coalesce(name, 'doorway ' || doorway) FROM doorways ORDER BY doorway");
    let heard = service.follow(question).heard("route");
    let (_, first) = heard.recv_timeout(MISSED).unwrap();
    let mut held = route(&first["route"]);
    let mut chance = Chance::new(seed);
    let (mut closed, mut delays): (Vec<String>, Vec<Duration>) = (Vec::new(), Vec::new());
    for round in 0..count {
        let passed = doorways(&held);
        let is_shut = held["status"] == "no_route";
        if !closed.is_empty() && (is_shut || chance.is(0.3 + closed.len() as f64 / 50.0)) {
            open(service, &closed.remove(chance.below(closed.len())));
        } else {
            let on_way = !passed.is_empty() && chance.is(0.8);
            let from = if on_way { &passed } else { &all };
            let what = from[chance.below(from.len())].clone();
            close(service, &what);
            closed.retain(|known| *known != what);
            closed.push(what);
        }
        let made = Instant::now();
        let now = asked(service, question);
        if let Some(at) = hold(&heard, &mut held, &now) {
            delays.push(at.saturating_duration_since(made));
        }
        assert_eq!(held, now, "round {round}: {closed:?} is closed");
    }
    delays
}

/// Hears until the route that is held is that of now; when it was. What is heard is another route than before.
fn hold(heard: &Receiver<(Instant, Value)>, held: &mut Value, now: &Value) -> Option<Instant> {
    let mut came = None;
    while held != now {
        let (at, event) = heard.recv_timeout(MISSED).expect("another route is heard of");
        assert_ne!(route(&event["route"]), *held, "the same route is heard of twice: {}", event["words"]);
        assert!(!event["changes"].as_array().unwrap().is_empty(), "{}", event["words"]);
        *held = route(&event["route"]);
        came = Some(at);
    }
    came
}

#[test]
fn an_edit_that_touches_no_way_says_so_and_followers_go_on_from_there() {
    let site = TestSite::example("starter").with(
        "site.toml",
        "name = \"ward\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
    );
    std::fs::create_dir_all(site.path().join("tables")).unwrap();
    site.write("tables/vehicles.csv", "vehicle,goal\nv1,home\n");
    let site = site.built();
    let service = Service::start(&site);
    let mut events = service.events();
    events.next("hello");
    let mut follower = service.follow("start=home&goal=window");
    let first = follower.next("route");
    let goal = json!({"kind": "set", "table": "vehicles", "key": "v1", "column": "goal", "value": "window"});
    edit(&service, &goal, "an errand");
    let changed = events.next("changed");
    assert_eq!((&changed["ways"], &changed["rooms"]), (&false.into(), &0.into()), "{changed}");
    close(&service, "doorway 1");
    assert_eq!(events.next("changed")["ways"], true);
    let lost = follower.next("route");
    assert_eq!(lost["route"]["status"], "no_route", "{lost}");
    open(&service, "doorway 1");
    let again = follower.next("route");
    assert_eq!(route(&again["route"]), route(&first["route"]));
    let faster =
        json!({"kind": "set", "table": "robots", "key": "robot/STAND", "column": "speed", "value": 0.4});
    edit(&service, &faster, "a careful day");
    for _ in 0..2 {
        let changed = events.next("changed");
        assert_eq!(changed["ways"], true, "{changed}");
    }
    assert_ne!(follower.next("route")["route"]["measures"], first["route"]["measures"]);
}
