//! Robots on the map: where they are, what they were told; and missions that are looked at again.

use std::path::Path;
use std::time::Duration;

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use serde_json::{Value, json};

use crate::accessible::{axe, violations};
use crate::at_a_desk;

fn is_at(service: &Service, x: f64, y: f64) {
    let robots =
        json!({"robots": [{"name": "cart-1", "x": x, "y": y, "heading": 0.0, "doing": "drives to ward 12"}]});
    let (status, answer) = service.ask("POST", "/api/whereabouts", Some(&robots));
    assert_eq!(status, 200, "{answer}");
}

const ENTER: &str = "\u{e007}";
const END: &str = "\u{e010}";
const HOME: &str = "\u{e011}";

/// Presses keys on what can have the focus.
async fn keys(browser: &Browser, css: &str, keys: &str) {
    browser.find(css).await.send_keys(keys).await.unwrap();
}

/// Where a mark of the map stands, pixels.
async fn mark(browser: &Browser, of: &str) -> [f64; 2] {
    let at = browser.value(&format!("['cx', 'cy'].map((name) => Number(document.querySelector('#marks {of} circle')?.getAttribute(name)))")).await;
    let at: Vec<f64> = serde_json::from_value(at).expect("two numbers");
    [at[0], at[1]]
}

#[tokio::test(flavor = "multi_thread")]
async fn a_robot_is_seen_where_it_is_and_what_it_is_told_is_read_beside() {
    let (_site, service, browser) = at_a_desk("clinic", "#map").await;
    browser.until("document.querySelector('#robots-card').hidden", "nobody said where it is").await;
    is_at(&service, 20.0, 8.0);
    let mut follower = service.follow("start=20,8&goal=ward%2012&name=cart-1");
    follower.next("route");
    browser.says("#robots", "in corridor 15 · drives to ward 12 · on its way to ward 12, hardness").await;
    let before = mark(&browser, ".robot").await;
    is_at(&service, 25.0, 8.0);
    browser
        .until(
            &format!(
                "document.querySelector('#marks .robot circle').getAttribute('cx') > {} + 20",
                before[0]
            ),
            "the mark goes where the robot goes",
        )
        .await;
    // the map is moved, and the mark with it
    let there = mark(&browser, ".robot").await;
    browser.click("#zoom-in").await;
    browser
        .until(
            &format!(
                "Math.abs(document.querySelector('#marks .robot circle').getAttribute('cx') - {}) > 5",
                there[0]
            ),
            "the mark stays where the robot is on the map",
        )
        .await;
    browser.press("#robots", "cart-1").await;
    browser.says("#robots .told", "the way costs").await;
    browser.until("document.querySelectorAll('#marks .robot-way').length === 1", "its way is drawn").await;
    let (status, _) = service.ask(
        "POST",
        "/api/edits",
        Some(&json!({"edit": {"kind": "close", "what": "ward 12"}, "why": "painting"})),
    );
    assert_eq!(status, 200);
    browser.says("#robots", "no way to ward 12").await;
    browser.says("#robots .told", "there is no way any more").await;
    browser.screenshot("robots").await;
    let (status, _) = service.ask("DELETE", "/api/whereabouts/cart-1", None);
    assert_eq!(status, 200);
    drop(follower);
    browser
        .until(
            "document.querySelector('#robots-card').hidden && !document.querySelector('#marks .robot')",
            "it is gone",
        )
        .await;
}

fn apart(one: [f64; 2], other: [f64; 2]) -> f64 {
    (one[0] - other[0]).hypot(one[1] - other[1])
}

/// By keys alone: from the list to the end of a mission, and back.
async fn look_again(screen: Screen) {
    let site = TestSite::example("clinic").built();
    site.adit("simulate", &["--missions", "1", "--seed", "5", "--keep"]).expect_status(0);
    let service = Service::start(&site);
    let (_, mission) = service.ask("GET", "/api/missions/1", None);
    let browser = Browser::open(&service.page("#map"), screen).await;
    browser.until("document.querySelector('#canvas').dataset.generation", "the map is there").await;
    keys(&browser, "#missions-card summary", ENTER).await;
    browser.says("#missions", "arrived").await;
    keys(&browser, "#missions li button", ENTER).await;
    browser.says("#replay-card h2", "Mission 1: ").await;
    let start = mark(&browser, ".replayed").await;
    keys(&browser, "#replay-card input", END).await;
    let end = mark(&browser, ".replayed").await;
    assert!(apart(start, end) > 30.0, "{start:?} to {end:?}");
    let metres = browser.run("const [a, b] = document.querySelectorAll('#marks :is(.replay-from, .replay-to)'); return Math.hypot(a.getAttribute('cx') - b.getAttribute('cx'), a.getAttribute('cy') - b.getAttribute('cy'))").await;
    let far = |of: &Value| of.as_f64().unwrap();
    let truly = (far(&mission["start"][0]) - far(&mission["goal"][0]))
        .hypot(far(&mission["start"][1]) - far(&mission["goal"][1]));
    let scale = metres.as_f64().unwrap() / truly;
    let drawn = apart(start, end) / scale;
    assert!(
        (drawn - truly).abs() < 1.0,
        "it goes from where it began to where it ended: {drawn} and {truly} m"
    );
    keys(&browser, "#replay-card input", HOME).await;
    assert!(apart(mark(&browser, ".replayed").await, start) < 0.01);
    browser.press("#replay-card", "Play").await;
    browser.until(&format!("Math.abs(document.querySelector('#marks .replayed circle').getAttribute('cx') - {}) + Math.abs(document.querySelector('#marks .replayed circle').getAttribute('cy') - {}) > 4", start[0], start[1]), "it goes").await;
    browser.press("#replay-card", "Pause").await;
    tokio::time::sleep(Duration::from_millis(100)).await;
    let paused = mark(&browser, ".replayed").await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    assert!(apart(mark(&browser, ".replayed").await, paused) < 0.01);
    browser.says("#replay-card", "What it does: ").await;
    browser.screenshot("replay").await;
    is_at(&service, 20.0, 8.0);
    browser.says("#robots", "cart-1").await;
    for theme in ["light", "dark"] {
        browser.run(&format!("document.documentElement.dataset.theme = '{theme}'")).await;
        assert_eq!(violations(&browser, &axe()).await, Vec::<String>::new(), "{theme}");
    }
    keys(&browser, "#replay-card .shut", ENTER).await;
    browser.until("!document.querySelector('#marks .replayed') && document.activeElement.matches('#missions-card summary')", "it is put away").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_mission_is_looked_at_again_at_a_desk() {
    look_again(Screen::Desktop).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_mission_is_looked_at_again_on_a_phone() {
    look_again(Screen::Phone).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn on_a_floor_plan_too() {
    let flat = TestSite::empty();
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds");
    for file in ["flat.toml", "flat.json"] {
        flat.write(file, std::fs::read(world.join(file)).unwrap());
    }
    flat.write("site.toml", "name = \"flat\"\nmap = \"flat.toml\"\n");
    let site = flat.built();
    site.adit("simulate", &["bed", "bath", "--keep"]).expect_status(0);
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#map"), Screen::Desktop).await;
    browser.until("document.querySelector('#picture svg #metres')", "the plan is drawn").await;
    keys(&browser, "#missions-card summary", ENTER).await;
    browser.press("#missions", "Look again").await;
    browser
        .until("document.querySelector('#picture .marks .replayed')", "the robot stands on the plan")
        .await;
}
