//! From an empty building's scan to a site with places, areas, a closed doorway, a new state, a rule with its test, tuned,
//! explained and taken back: on the page alone, by keys alone, at a desk and on a phone. How many keys and seconds each step takes is
//! printed (`--nocapture`).

use std::process::Command;
use std::time::{Duration, Instant};

use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};

const TAB: char = '\u{e004}';
const ENTER: &str = "\u{e007}";
const ESCAPE: &str = "\u{e00c}";
/// With Ctrl, A; and Ctrl is let go.
const ALL: &str = "\u{e009}a\u{e000}";

/// Somebody who has a keyboard and nothing else, and who counts.
struct Hands {
    browser: Browser,
    keys: usize,
    began: Instant,
    told: Vec<String>,
}

impl Hands {
    async fn press(&mut self, keys: &str) {
        self.keys += keys.chars().filter(|key| *key != '\u{e000}').count();
        let began = Instant::now();
        // what has the focus may just be put in the place of another
        while let Err(error) = self.browser.client.active_element().await.unwrap().send_keys(keys).await {
            assert!(began.elapsed() < Duration::from_secs(5), "{keys:?} cannot be pressed: {error}");
        }
    }

    /// Presses Tab until the focus is on what this expression finds in `e`.
    async fn to(&mut self, test: &str) {
        for _ in 0..150 {
            let script = format!("((e) => Boolean({test}))(document.activeElement)");
            if self.browser.value(&script).await == true {
                return;
            }
            self.press(&TAB.to_string()).await;
        }
        panic!("Tab never comes to {test}");
    }

    /// To a button or a link with such a text, from the top of what is shown, and presses it.
    async fn push(&mut self, text: &str) {
        self.to(&format!(
            "['BUTTON', 'A', 'SUMMARY'].includes(e.tagName) && e.textContent.trim().startsWith({text:?})"
        ))
        .await;
        self.press(ENTER).await;
    }

    async fn write(&mut self, id: &str, text: &str) {
        self.to(&format!("e.id === {id:?}")).await;
        self.press(&format!("{ALL}{text}")).await;
    }

    /// To a tab of the page.
    async fn open(&mut self, tab: &str) {
        self.to("e.id === 'skip' || e.tagName === 'BODY' || e === document.querySelector('nav a')").await;
        self.to(&format!("e.matches('nav a[href=\"#{tab}\"]')")).await;
        self.press(ENTER).await;
    }

    /// Saves what waits, once it was previewed; a preview that is out of sight comes into it by the first press.
    async fn save(&mut self, said: &str) {
        self.browser.until("!document.getElementById('save').disabled", "it may be saved").await;
        let is_saved = format!("document.getElementById('saved').innerText.includes({said:?})");
        for _ in 0..2 {
            self.press(&format!("\u{e009}{ENTER}\u{e000}")).await;
            let began = Instant::now();
            while began.elapsed() < Duration::from_millis(1_500) {
                if self.browser.value(&is_saved).await == true {
                    return;
                }
                tokio::time::sleep(Duration::from_millis(30)).await;
            }
        }
        self.browser.says("#saved", said).await;
    }

    fn step(&mut self, what: &str) {
        self.told.push(format!("{what}: {} keys, {:.1} s", self.keys, self.began.elapsed().as_secs_f64()));
        (self.keys, self.began) = (0, Instant::now());
    }
}

/// What a scanner saw: a hall of 12 m and three rooms above it, each with a doorway; 5 cm a pixel.
fn scan() -> (Vec<u8>, &'static str) {
    let (columns, rows) = (240, 160);
    let is_wall = |x: usize, y: usize| {
        let rim = x < 3 || y < 3 || x >= columns - 3 || y >= rows - 3;
        let across = (90..93).contains(&y) && !(30..54).contains(&(x % 80));
        rim || across || (y < 90 && (79..82).contains(&(x % 80)) && x < 200)
    };
    let pixel = |at: usize| if is_wall(at % columns, at / columns) { 0 } else { 254 };
    let mut image = format!("P5\n{columns} {rows}\n255\n").into_bytes();
    image.extend((0..columns * rows).map(pixel));
    let about = "image: scan.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    (image, about)
}

/// Places, areas, a doorway that is closed, and a state.
async fn furnish(hands: &mut Hands, site: &TestSite) {
    for (name, at) in [("dock", "2,2"), ("ward", "6,6"), ("store", "10,6")] {
        hands.to("e.id === 'draw'").await;
        hands.press(ENTER).await;
        hands.to("e.id === 'draw-what'").await;
        hands.press("a p").await;
        hands.write("draw-name", name).await;
        hands.write("draw-corners", at).await;
        hands.press(ENTER).await;
        hands.browser.says("#preview", &format!("a place “{name}”")).await;
    }
    hands.save("Saved").await;
    hands.step("three places");
    assert_eq!(site.sqlite3("SELECT count(*) FROM laid WHERE what = 'place'"), ["3"]);

    for (name, kind, at) in [("crates", "keep-out", "7,5.5 8,7"), ("spill", "wet", "4.5,1 5.5,3")] {
        hands.to("e.id === 'draw'").await;
        hands.press(ENTER).await;
        hands.write("draw-name", name).await;
        hands.write("draw-kind", kind).await;
        hands.write("draw-corners", at).await;
        hands.press(ENTER).await;
        hands.browser.says("#preview", &format!("an area “{name}” ({kind})")).await;
    }
    hands.save("Saved").await;
    hands.step("two areas");

    hands.write("start", "dock").await;
    hands.press(ENTER).await;
    hands.write("goal", "ward").await;
    hands.press(ENTER).await;
    hands.browser.says("#route-title", "dock to ward").await;
    hands.step("a way");

    hands.open("facts").await;
    hands.write("fact-object", "2,3.4").await;
    hands.browser.says("#fact-would", "doorway").await;
    hands.push("Tell it").await;
    hands.browser.says("#preview", "Told: doorway at 2,3.4 closed: yes").await;
    hands.save("Saved: Told").await;
    assert_eq!(site.sqlite3("SELECT count(*) FROM doorways WHERE closed"), ["1"]);
    hands.step("a closed doorway");

    hands.open("map").await;
    hands
        .to("e.tagName === 'SUMMARY' && e.closest('[data-table=robots]') && e.textContent.startsWith('Add')")
        .await;
    hands.press(ENTER).await;
    hands.to("e.tagName === 'INPUT' && e.closest('[data-table=robots] .row-forms')").await;
    hands.press("CROUCH").await;
    hands.to("e.tagName === 'SELECT' && e.closest('[data-table=robots] .row-forms')").await;
    hands.press("SQUAT").await;
    hands.push("Add").await;
    hands.browser.says("#preview", "New in Robot states: CROUCH, as SQUAT").await;
    hands.to("e.matches('tr.new input[aria-label^=height]')").await;
    hands.press(&format!("{ALL}1.2")).await;
    hands.browser.says("#preview-summary", "").await;
    hands.save("Saved: New in Robot states: CROUCH").await;
    hands.step("a new state");
}

/// A rule and its test.
async fn rule(hands: &mut Hands) {
    hands.open("rules").await;
    hands.write("new-name", "spill").await;
    hands.press(ENTER).await;
    hands.browser.says("#rules-name", "spill.rhai").await;
    hands.to("e.matches('#rules textarea')").await;
    let rule = "revise \"wet floors are slippery\" each room in ROOMS each spot in AREA_ROOMS where spot.room == room.room && spot.area.kind == \"wet\" set room.hardness by * 1.5 level 10";
    hands.press(&format!("{ALL}{rule}")).await;
    hands.press(ESCAPE).await;
    hands.browser.says("#preview-rules", "wet floors are slippery").await;
    hands.save("spill.rhai: new").await;
    hands.step("a new rule");

    hands.open("map").await;
    hands.to("e.id === 'to-outline'").await;
    hands.press(ENTER).await;
    hands.press("hardness 1.5").await;
    hands.push("Show").await;
    hands.browser.says("#popover", "hardness 1.5 a metre").await;
    hands.push("Why is it so?").await;
    hands.browser.says("#why-card", "wet floors are slippery").await;
    hands.push("Make a test of it").await;
    hands.browser.says("#why-card", "It is in the tray").await;
    hands.browser.says("#preview-rules", "pass").await;
    hands.save("tests/made.toml: new").await;
    hands.step("its test");
}

/// A number is tuned, the way explained, and the number taken back.
async fn tune(hands: &mut Hands) {
    let before = hands.browser.text("#route-title .total").await;
    hands.to("e.getAttribute('aria-label') === 'hardness of STAND'").await;
    hands.press(&format!("{ALL}2")).await;
    hands.browser.says("#preview-summary", "would change").await;
    hands.save("Saved").await;
    hands
        .browser
        .until(
            &format!("document.querySelector('#route-title .total').innerText !== {before:?}"),
            "another cost",
        )
        .await;
    hands.step("tuned");

    hands.push("Why this way?").await;
    hands.browser.says("#why-card .sentence", "Without SIDE-STAND the best way costs").await;
    hands.step("explained");

    hands.to("e.id === 'undo'").await;
    hands.press(ENTER).await;
    hands.browser.says("dialog", "would change.").await;
    hands.push("Take it back").await;
    hands.browser.says("#saved", "Taken back").await;
    hands.browser.says("#route-title .total", &before).await;
    hands.step("undone");
}

/// A site of that scan, as `adit new` begins one.
fn scanned() -> TestSite {
    let site = TestSite::empty();
    let (image, about) = scan();
    std::fs::create_dir(site.path().join("scans")).unwrap();
    std::fs::write(site.path().join("scans/scan.pgm"), image).unwrap();
    site.write("scans/scan.yaml", about);
    let new = |args: &[&str]| {
        let mut adit = Command::new(adit());
        Ran::new(&adit.current_dir(site.path()).args(args).output().unwrap()).expecting(0)
    };
    new(&["new", ".", "--map", "scans/scan.yaml", "--robot", "humanoid"]);
    new(&["build", "."]);
    site
}

async fn from_a_scan_to_a_tuned_site(screen: Screen) {
    let site = scanned();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page(""), screen).await;
    let mut hands = Hands { browser, keys: 0, began: Instant::now(), told: Vec::new() };

    furnish(&mut hands, &site).await;
    rule(&mut hands).await;
    tune(&mut hands).await;
    eprintln!("{screen:?}: {}", hands.told.join("; "));
}

#[tokio::test(flavor = "multi_thread")]
async fn at_a_desk_by_keys_alone() {
    from_a_scan_to_a_tuned_site(Screen::Desktop).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn on_a_phone_by_keys_alone() {
    from_a_scan_to_a_tuned_site(Screen::Phone).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_was_scanned_lies_beneath_the_map() {
    let site = scanned();
    let service = Service::start(&site);
    let (_, map) = service.ask("GET", "/api/map", None);
    assert_eq!(map["scan"], serde_json::json!([0.0, 0.0, 12.0, 8.0]));
    let drawn = TestSite::example("paper").built();
    let (status, refused) = Service::start(&drawn).ask("GET", "/api/scan", None);
    assert_eq!(
        (status, &refused["error"]["message"]),
        (404, &"the map is drawn: nothing was scanned".into())
    );
    let browser = Browser::open(&service.page("#map"), Screen::Desktop).await;
    let painted = "document.getElementById('canvas').dataset.painted === document.getElementById('canvas').dataset.view";
    // a pixel within a wall is black where it was scanned, and as black as walls are painted where it was not
    let shades = "(() => { const canvas = document.getElementById('canvas'); const of = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data; \
                  let black = 0; for (let at = 0; at < of.length; at += 4) black += of[at] + of[at + 1] + of[at + 2] === 0; return black; })()";
    browser.until(painted, "all is painted").await;
    let before = browser.value(shades).await.as_u64().unwrap();
    browser.click("#scan").await;
    browser.until(&format!("{painted} && {shades} > {before} + 1000"), "the scan is seen").await;
    browser.screenshot("scan").await;
    browser.click("#scan").await;
    browser.until(&format!("{painted} && {shades} === {before}"), "the scan is gone").await;
}
