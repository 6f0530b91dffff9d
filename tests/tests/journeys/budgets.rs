//! What would take minutes and gigabytes is refused before it does, with what it would take.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::json;

/// Builds; fails unless that is refused soon, with these words.
#[track_caller]
fn refused(site: &TestSite, words: &[&str]) {
    let began = Instant::now();
    site.adit("build", &[]).expecting(2).complains(words);
    assert!(began.elapsed() < Duration::from_mins(1), "it took {:?}", began.elapsed());
}

fn rooms_by_state() -> TestSite {
    TestSite::example("paper").with(
        "site.toml",
        "name = \"paper\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
    )
}

/// Passages grow with the square of the states: 200 states on a floor of 81 walls took 7 GB and more than 150 s, without a word.
#[test]
fn very_many_states() {
    let mut states = String::new();
    for state in 0..600 {
        let width = 0.3 + f64::from(state) / 1e3;
        write!(
            states,
            "[[robots]]\nstate = \"S{state}\"\nwidth = {width}\nheight = 1.7\naction = \"walk\"\nhardness = {}\n\n",
            state + 1
        )
        .unwrap();
    }
    refused(&rooms_by_state().with("robots.toml", &states), &["the rooms of 600 states", "million passages"]);
}

fn ring(count: usize) -> Vec<[f64; 2]> {
    let corner = |at: usize| {
        let (sin, cos) = (std::f64::consts::TAU * at as f64 / count as f64).sin_cos();
        [20.0 + 2.0 * cos, 10.0 + 2.0 * sin]
    };
    (0..count).map(corner).collect()
}

/// Whether an outline crosses itself takes a time that grows with the square of its corners.
#[test]
fn a_polygon_of_very_many_corners() {
    let site = rooms_by_state();
    let polygon = json!(ring(200_000));
    site.write("map.toml", format!("{}\n[[obstacle]]\npolygon = {polygon}\n", site.read("map.toml")));
    refused(&site, &["map.toml", "this polygon has 200000 corners; 10000 are the most"]);
}

/// Found in review: a robot that told an area of 60,000 corners kept every edit waiting for minutes.
#[test]
fn an_area_of_very_many_corners_that_somebody_tells() {
    let site = rooms_by_state().built();
    let service = Service::start(&site);
    let lay = |name: &str, count: usize| {
        let area = json!({"name": name, "corners": ring(count)});
        service.ask("POST", "/api/areas", Some(&area))
    };
    let (status, answer) = lay("large", 30_000);
    assert_eq!((status, &answer["error"]["code"]), (400, &json!("laid/corners")), "{answer}");
    assert_eq!(lay("small", 30).0, 200);
}
