//! A large floor on the page: what is sent of it, that it moves along while it is painted, and, run by hand, how fast:
//! `cargo test --release -p adit-tests --test page forty_two_thousand -- --ignored --nocapture`.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::floor::{Floor, Kind};
use adit_tests::service::Service;
use serde_json::{Value, json};

/// Offices of so many pixels, a robot of five states, and two places at the ends of the lowest corridor.
fn offices(columns: usize, rows: usize) -> (TestSite, Service) {
    let site = TestSite::empty();
    let floor = Floor::new(Kind::Offices, columns, rows, 7);
    floor.write_site(site.path(), 5).unwrap();
    let places = format!(
        "[[place]]\nname = \"west\"\nat = [1.0, 6.3]\n[[place]]\nname = \"east\"\nat = [{:.1}, 6.3]\n",
        floor.width() - 5.0
    );
    let text = site.read("site.toml").replace("starts = []", "starts = [\"west\"]");
    site.write("site.toml", format!("{text}{places}"));
    let site = site.built();
    let service = Service::start(&site);
    (site, service)
}

const SENT: &str = "Object.fromEntries(performance.getEntriesByType('resource').map(({ name, decodedBodySize }) => [name.replace(location.origin, ''), decodedBodySize]))";

const PIXELS: &str = "(({ width, height }, pen) => pen.getImageData(0, 0, width, height).data)(document.getElementById('canvas'), document.getElementById('canvas').getContext('2d'))";

/// How many parts of pixels are others than they were, by more than edges are that are smoothed otherwise.
async fn others(browser: &Browser) -> u64 {
    let script = format!("{PIXELS}.filter((now, at) => Math.abs(now - window.before[at]) > 64).length");
    browser.value(&script).await.as_u64().unwrap()
}

const STILL: &str =
    "document.getElementById('canvas').dataset.painted === document.getElementById('canvas').dataset.view";

#[tokio::test(flavor = "multi_thread")]
async fn a_floor_is_sent_packed_and_looks_the_same_however_it_was_reached() {
    let (_site, service) = offices(640, 420);
    let (_, map) = service.ask("GET", "/api/map", None);
    let browser = Browser::open(&service.page("#map?start=west&goal=east"), Screen::Desktop).await;
    browser.says("#route-title", "west to east").await;
    let sent = browser.value(SENT).await;
    assert!(sent["/api/map"].is_null(), "{sent:#}");
    let packed = sent["/api/floor"].as_f64().unwrap();
    let rooms = map["rooms"].as_array().unwrap().len();
    assert!(rooms > 2_000, "{rooms}");
    assert!(packed * 8.0 < map.to_string().len() as f64, "{packed} bytes of {rooms} rooms");

    let press = |keys: &'static str| {
        let script = format!(
            "for (const key of {keys:?}.split(' ')) document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', {{ key, bubbles: true }}))"
        );
        let browser = &browser;
        async move { browser.run(&script).await }
    };
    // as wide as the page is by now
    press("0").await;
    browser.until(STILL, "all is painted").await;
    browser.run(&format!("window.before = {PIXELS}")).await;
    press("+ + + ArrowLeft ArrowUp").await;
    browser.until(STILL, "what is near is painted").await;
    assert!(others(&browser).await > 10_000, "another part is seen");
    browser.screenshot("large-near").await;
    press("ArrowDown ArrowRight - 0").await;
    browser.until(STILL, "the whole is painted again").await;
    assert_eq!(others(&browser).await, 0, "the whole floor looks as it did");
    browser.screenshot("large").await;

    // a room is found by its packed shape, and called as the service calls it
    browser.click("#pieces").await;
    browser.until(STILL, "pieces are painted").await;
    let room = map["rooms"].as_array().unwrap().iter().find(|room| room["layer"] == 0).unwrap();
    let name = room["name"].as_str().unwrap();
    let corner = |axis: usize| room["rect"][axis].as_f64().unwrap();
    let outline: Vec<f64> = match room["outline"].as_array() {
        Some(outline) => outline.iter().map(|value| value.as_f64().unwrap()).collect(),
        None => vec![corner(0), corner(1), corner(2), corner(3)],
    };
    let corners = outline.len() as f64 / 2.0;
    let middle = [0, 1].map(|axis| outline.iter().skip(axis).step_by(2).sum::<f64>() / corners);
    browser.run("document.getElementById('layer').value = '0'; document.getElementById('layer').dispatchEvent(new Event('change'))").await;
    browser.until(STILL, "one layer is painted").await;
    browser.hover_on_map(middle).await;
    browser.says("#tip", &format!("room {name} ")).await;
}

/// The times between frames while something is done in each, the longest that 95 of 100 take.
async fn frames(browser: &Browser, act: &str) -> f64 {
    let script = format!(
        "const done = arguments[arguments.length - 1]; const canvas = document.getElementById('canvas'); \
         const taken = []; let last = performance.now(); let n = 0; \
         const frame = (now) => {{ taken.push(now - last); last = now; n += 1; if (n > 150) return done(taken.slice(1).sort((a, b) => a - b)[Math.floor(0.95 * (taken.length - 1))]); \
         {act}; requestAnimationFrame(frame); }}; requestAnimationFrame(frame);"
    );
    browser.client.execute_async(&script, Vec::new()).await.unwrap().as_f64().unwrap()
}

/// Milliseconds from a number that is typed until the screen says what it would change.
async fn preview(browser: &Browser, column: &str, value: f64) -> f64 {
    let script = format!(
        "const done = arguments[arguments.length - 1]; \
         const cell = document.querySelector(\"[data-key='robot/WALK'] input[aria-label^={column}]\"); \
         cell.value = '{value}'; const began = performance.now(); cell.dispatchEvent(new Event('input', {{ bubbles: true }})); \
         const look = () => document.querySelector('#preview-told[aria-busy=false] #preview-summary') ? done(performance.now() - began) : requestAnimationFrame(look); \
         setTimeout(look, 20);"
    );
    let took = browser.client.execute_async(&script, Vec::new()).await.unwrap();
    browser.click("#discard").await;
    browser.until("document.getElementById('preview-card').hidden", "nothing waits").await;
    took.as_f64().unwrap()
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "a measurement"]
async fn a_floor_of_forty_two_thousand_rooms_is_worked_with_at_ease() {
    let (_site, service) = offices(2_240, 1_276);
    let (_, about) = service.ask("GET", "/api/site", None);
    let browser = Browser::open(&service.page("#map?start=west&goal=east"), Screen::Desktop).await;
    browser.says("#route-title", "west to east").await;
    browser.until(STILL, "all is painted").await;
    let first = browser.value("performance.getEntriesByName('first picture')[0].startTime").await;
    let key = |keys: &str| {
        format!(
            "canvas.dispatchEvent(new KeyboardEvent('keydown', {{ key: {keys}[Math.floor(n / 8) % 4], bubbles: true }}))"
        )
    };
    let pan = frames(&browser, &key("['ArrowLeft', 'ArrowUp', 'ArrowRight', 'ArrowDown']")).await;
    let zoom = frames(
        &browser,
        "canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: n % 60 < 30 ? -40 : 40, clientX: 500, clientY: 500, cancelable: true }))",
    )
    .await;
    browser.run("document.getElementById('zoom-fit').click()").await;
    browser.until(STILL, "all is painted").await;
    let hover = "const done = arguments[arguments.length - 1]; const canvas = document.getElementById('canvas'); const box = canvas.getBoundingClientRect(); const taken = []; \
        const next = (n) => { if (n === 60) return done(taken.sort((a, b) => a - b)[57]); const began = performance.now(); \
        canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: box.x + box.width * (0.1 + (0.8 * n * 0.618) % 0.8), clientY: box.y + box.height * (0.2 + (0.6 * n * 0.37) % 0.6), bubbles: true })); \
        requestAnimationFrame(() => setTimeout(() => { taken.push(performance.now() - began); setTimeout(() => next(n + 1), 50); })); }; next(0);";
    let hover = browser.client.execute_async(hover, Vec::new()).await.unwrap().as_f64().unwrap();
    let hardness = preview(&browser, "hardness", 2.5).await.min(preview(&browser, "hardness", 2.75).await);
    let width = preview(&browser, "width", 0.7).await;
    let limits: [f64; 6] = [1_500.0, 1_000.0 / 30.0, 1_000.0 / 30.0, 20.0, 500.0, 2_000.0];
    let taken: [f64; 6] = [first.as_f64().unwrap(), pan, zoom, hover, hardness, width];
    let names = ["first picture", "pan", "zoom", "hover", "preview of a hardness", "preview of a width"];
    let told: Vec<Value> = std::iter::zip(names, std::iter::zip(taken, limits))
        .map(|(name, (took, most))| json!({ "what": name, "ms": took.round(), "most": most.round() }))
        .collect();
    eprintln!("{}", json!({ "rooms": about["rooms"], "doors": about["doors"], "taken": told }));
    for (name, (took, most)) in std::iter::zip(names, std::iter::zip(taken, limits)) {
        assert!(took <= most, "{name}: {took:.0} ms, and at most {most:.0}");
    }
}
