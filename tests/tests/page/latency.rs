//! How soon an edit is seen: a measurement, run by hand:
//! `cargo test --release -p adit-tests --test page latency -- --ignored --nocapture`.

use std::fmt::Write as _;

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use serde_json::json;

/// A floor of about 10,000 doors: pillars in rows.
fn large_floor() -> TestSite {
    let site = TestSite::empty();
    let (columns, rows) = (108, 46);
    let mut map = format!("width = {}.0\ndepth = {}.0\n", columns * 4, rows * 4);
    for column in 0..columns {
        for row in 0..rows {
            let (x, y) = (f64::from(column * 4 + 1) + f64::from(row % 3) * 0.1, f64::from(row * 4 + 1));
            writeln!(map, "[[obstacle]]\nrect = [{x:.1}, {y:.1}, {:.1}, {:.1}]", x + 2.0, y + 2.0).unwrap();
        }
    }
    map.push_str(
        "[[place]]\nname = \"west\"\nat = [0.5, 0.5]\n[[place]]\nname = \"east\"\nat = [431.5, 183.5]\n",
    );
    site.write("map.toml", map);
    site.write("site.toml", "name = \"large floor\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"minimum\"\nstarts = [\"west\"]\n");
    site.write(
        "robots.toml",
        "[[robots]]\nstate = \"STAND\"\naction = \"WALK\"\nheight = 1.7\nwidth = 0.4\nhardness = 1.0\n\
         [[robots]]\nstate = \"SQUAT\"\naction = \"WALK-ON-KNEE\"\nheight = 1.1\nwidth = 0.3\nhardness = 4.0\n",
    );
    site.built()
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "a measurement"]
async fn latency_from_a_saved_cell_to_the_screen() {
    let site = large_floor();
    let service = Service::start(&site);
    let (_, about) = service.ask("GET", "/api/site", None);
    let browser = Browser::open(&service.page("#map?start=west&goal=east"), Screen::Desktop).await;
    browser.says("#route-title", "west to east").await;
    let mut taken = Vec::new();
    for n in 0..60 {
        let value = 1.0 + f64::from(n % 7 + 1) * 0.1;
        // From the press on Save to the frame that shows the new generation, by the page's own clock.
        let script = format!(
            "const done = arguments[arguments.length - 1]; \
             const cell = document.querySelector(\"[data-key='robot/STAND'] input[aria-label^=hardness]\"); \
             cell.value = '{value}'; cell.dispatchEvent(new Event('input', {{ bubbles: true }})); \
             const before = Number(document.getElementById('canvas').dataset.generation); \
             const wait = () => document.getElementById('save').disabled ? setTimeout(wait, 50) : save(); setTimeout(wait, 600); \
             const save = () => {{ const began = performance.now(); document.getElementById('save').click(); \
             const look = () => Number(document.getElementById('canvas').dataset.generation) > before \
                 ? done(performance.now() - began) : requestAnimationFrame(look); look(); }};"
        );
        let took = browser.client.execute_async(&script, Vec::new()).await.unwrap();
        taken.push(took.as_f64().unwrap());
    }
    taken.sort_by(f64::total_cmp);
    let at = |share: f64| taken[((taken.len() - 1) as f64 * share) as usize];
    eprintln!(
        "{}",
        json!({ "doors": about["doors"], "saved_cell_on_screen_ms": { "median": at(0.5), "p95": at(0.95), "max": at(1.0) } })
    );
    assert!(
        at(0.95) <= 150.0,
        "a saved cell is seen within 150 ms at the 95th percentile, not {:.0}",
        at(0.95)
    );
}
