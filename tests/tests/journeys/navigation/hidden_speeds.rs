//! Hardness from driving: a robot is as fast in each state as a table says that `adit fit` does not see, and fit finds it.
//!
//! `ADIT_FIT=20x200 cargo test --test journeys hidden_speeds` makes 20 runs of 200 missions each.

use std::fmt::Write;

use adit_tests::TestSite;

/// Two rooms, joined by a gap for one who goes sideways, and by a low passage.
const MAP: &str = "width = 10.0\ndepth = 7.0\nobstacle = [\n  { rect = [4.8, 0, 5.2, 1.5] },\n  { rect = [4.8, 1.95, 5.2, 4.5] },\n  { rect = [4.8, 6.3, 5.2, 7] },\n]\n[[bridge]]\nrect = [4.6, 4.5, 5.4, 6.3]\nheight = 1.3\n[[place]]\nname = \"bench\"\nat = [1.0, 1.0]\n";

/// State, action, height, width, hardness, and between which speeds it is.
type Shape = (&'static str, &'static str, f64, f64, f64, [f64; 2]);
const SHAPES: [Shape; 3] = [
    ("STAND", "WALK", 1.7, 0.6, 1.0, [0.5, 1.2]),
    ("SIDE-STAND", "SIDE-WALK", 1.7, 0.35, 2.0, [0.2, 0.6]),
    ("SQUAT", "CRAWL", 1.1, 0.8, 2.5, [0.15, 0.5]),
];

/// Speeds that look like chance.
fn speeds(run: u64) -> [f64; 3] {
    let share = |index: u64| {
        let mixed = (run * 3 + index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (mixed >> 11) as f64 / (1_u64 << 53) as f64
    };
    [0, 1, 2].map(|index| {
        let [least, most] = SHAPES[index as usize].5;
        least + share(index) * (most - least)
    })
}

fn site(speeds: [f64; 3]) -> TestSite {
    let mut robots = String::new();
    for ((state, action, height, width, hardness, _), speed) in SHAPES.iter().zip(speeds) {
        write!(
            robots,
            "[[robots]]\nstate = \"{state}\"\naction = \"{action}\"\nheight = {height}\nwidth = {width}\nhardness = {hardness:?}\nspeed = {speed:?}\n"
        )
        .expect("written to a string");
    }
    for (from, ..) in SHAPES {
        for (to, ..) in SHAPES.iter().filter(|(to, ..)| *to != from) {
            write!(
                robots,
                "[[changes]]\nfrom_state = \"{from}\"\nto_state = \"{to}\"\nhardness = 0.3\nseconds = 2.0\n"
            )
            .expect("written to a string");
        }
    }
    let settings = "name = \"two rooms\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\nstarts = [\"bench\"]\n";
    TestSite::empty().with("map.toml", MAP).with("robots.toml", &robots).with("site.toml", settings).built()
}

#[test]
fn fit_finds_the_speeds_of_a_robot_that_drove() {
    let wanted = std::env::var("ADIT_FIT").unwrap_or_else(|_| "1x20".to_owned());
    let (runs, missions) = wanted.split_once('x').expect("runs x missions");
    let (mut held, mut ratios) = ([0, 0], [0, 0]);
    for run in 0..runs.parse().expect("a number of runs") {
        let speeds = speeds(run);
        let site = site(speeds);
        // an ending that is not right is for other tests
        site.adit("simulate", &["--missions", missions, "--seed", &run.to_string(), "--keep"]);
        let seconds = |key: &str| {
            let place = SHAPES.iter().position(|shape| key.ends_with(&format!("/{}", shape.0)));
            1.0 / speeds[place.expect("a state")]
        };
        let is_in = |cell: &serde_json::Value, truth: f64| {
            let end = |name: &str| cell[name].as_f64().expect("an interval");
            end("low") <= truth && truth <= end("high")
        };
        let fit = site.adit("fit", &["--per-metre", "--json"]).expect_status(0).json();
        for cell in fit["cells"].as_array().expect("cells") {
            let truth = seconds(cell["key"].as_str().expect("a key"));
            let (proposed, is_in) = (cell["proposed"].as_f64().expect("a proposal"), is_in(cell, truth));
            assert!((proposed / truth - 1.0).abs() < 0.02, "run {run}: {cell} is {truth}");
            held = [held[0] + usize::from(is_in), held[1] + 1];
        }
        // and how many times harder than the state that keeps its hardness
        let fit = site.adit("fit", &["--json"]).expect_status(0).json();
        let reference = fit["reference"].as_str().expect("a state").to_owned();
        let of = SHAPES.iter().position(|shape| shape.0 == reference).expect("a state");
        for cell in fit["cells"].as_array().expect("cells") {
            let key = cell["key"].as_str().expect("a key");
            if !key.ends_with(&format!("/{reference}")) {
                let truth = SHAPES[of].4 * seconds(key) * speeds[of];
                ratios = [ratios[0] + usize::from(is_in(cell, truth)), ratios[1] + 1];
            }
        }
    }
    println!("{held:?} intervals of seconds a metre hold, {ratios:?} of how many times harder");
    let share = |[held, all]: [usize; 2]| held as f64 / all as f64;
    let least = if held[1] < 30 { 0.6 } else { 0.9 };
    assert!(share(held) >= least && ratios[1] > 0, "{held:?} {ratios:?}");
}
