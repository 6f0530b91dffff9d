//! An expert draws on the map: areas, obstacles and places, previewed before they are saved, taken back in a click.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;

const WAY: &str = "#map?start=home&goal=window";
const LAID: &str = "SELECT what, name, kind, outline FROM laid ORDER BY name";

async fn starter() -> (TestSite, Service, Browser) {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page(WAY), Screen::Desktop).await;
    (site, service, browser)
}

async fn choose(browser: &Browser, css: &str, value: &str) {
    let script = format!(
        "const choice = document.querySelector({css:?}); choice.value = {value:?};
         choice.dispatchEvent(new Event('change', {{ bubbles: true }}));"
    );
    browser.run(&script).await;
}

async fn until_it_may_be_saved(browser: &Browser) {
    browser.until("!document.getElementById('save').disabled", "it may be saved").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_area_is_dragged_named_where_it_lies_previewed_saved_and_taken_back() {
    let (site, _service, browser) = starter().await;
    browser.says("#route-title", "home to window").await;
    let cost = browser.text("#route-title .total").await;
    browser.click("#draw").await;
    browser.until("document.querySelector('#draw-kinds option')", "kinds are offered").await;
    let kinds = "[...document.querySelectorAll('#draw-kinds option')].map((of) => of.value).join()";
    assert_eq!(browser.value(kinds).await, "keep-out", "only those of which rules speak");
    // beside the doorway, from wall to wall but for a gap
    browser.drag_on_map([7.0, 1.5], [9.0, 5.5]).await;
    assert_eq!(browser.value("document.activeElement.id").await, "draw-name");
    browser.says("#draw-size", "wide").await;
    browser.client.active_element().await.unwrap().send_keys("wet floor").await.unwrap();
    browser.type_into("#draw-kind", "keep-out").await;
    browser.says("#preview", "New on the map: an area “wet floor” (keep-out)").await;
    browser.says("#preview-summary", "cut into rooms anew").await;
    browser.says("#preview", "The way that you look at").await;
    browser.screenshot("draw-area").await;
    assert_eq!(site.sqlite3(LAID), Vec::<String>::new(), "nothing is saved yet");
    until_it_may_be_saved(&browser).await;
    browser.click("#save").await;
    browser.says("#saved", "Saved: New on the map: an area “wet floor”").await;
    browser.until("!document.getElementById('draw-form')", "the pen is put away").await;
    let laid = site.sqlite3(LAID);
    assert!(laid.len() == 1 && laid[0].starts_with("area|wet floor|keep-out|[[7.0,1.5],"), "{laid:?}");
    browser
        .until(
            &format!("document.querySelector('#route-title .total').innerText !== {cost:?}"),
            "the way goes around it",
        )
        .await;
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    browser.says("#route-title .total", &cost).await;
    assert_eq!(site.sqlite3(LAID), Vec::<String>::new());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_place_is_made_by_keys_alone_and_ways_lead_there_as_soon_as_it_is_saved() {
    let (site, _service, browser) = starter().await;
    let press = async |keys: &str| {
        browser.client.active_element().await.unwrap().send_keys(keys).await.unwrap();
    };
    let is_on = async |id: &str| browser.value("document.activeElement.id").await == id;
    while !is_on("draw").await {
        press("\u{e004}").await;
    }
    press("\u{e007}").await;
    assert!(is_on("draw-what").await);
    press("a p").await;
    while !is_on("draw-name").await {
        press("\u{e004}").await;
    }
    press("charger").await;
    while !is_on("draw-corners").await {
        press("\u{e004}").await;
    }
    press("9,2").await;
    browser.says("#preview", "New on the map: a place “charger”").await;
    browser.says("#preview-summary", "possible at all").await;
    until_it_may_be_saved(&browser).await;
    press("\u{e007}").await;
    assert!(is_on("save").await, "Enter puts the pen away, and saves nothing");
    assert_eq!(site.sqlite3(LAID), Vec::<String>::new());
    press("\u{e007}").await;
    browser.says("#saved", "Saved: New on the map: a place “charger”").await;
    assert_eq!(site.sqlite3(LAID), ["place|charger||[[9.0,2.0]]"]);
    browser.type_into("#goal", "charger\u{e007}").await;
    browser.says("#route-title", "home to charger").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_outline_of_many_corners_snaps_to_walls_and_outlives_a_reload() {
    let (site, _service, browser) = starter().await;
    browser.click("#draw").await;
    choose(&browser, "#draw-what", "obstacle").await;
    choose(&browser, "#draw-shape", "polygon").await;
    // the first one a few pixels from the corner of the floor
    for corner in [[0.06, 0.05], [2.0, 0.0], [2.0, 1.0], [1.0, 1.5]] {
        browser.tap_on_map(corner).await;
    }
    browser.says("#preview", "an obstacle “obstacle 1”").await;
    let corners = browser.value("document.getElementById('draw-corners').value").await;
    assert_eq!(corners, "0,0 2,0 2,1 1,1.5");
    // a corner is moved, and so is the shape
    browser.drag_on_map([1.0, 1.5], [0.5, 1.2]).await;
    let corners = browser.value("document.getElementById('draw-corners').value").await;
    assert_eq!(corners, "0,0 2,0 2,1 0.5,1.2");
    browser.client.refresh().await.unwrap();
    browser.says("#preview", "an obstacle “obstacle 1”").await;
    // what waits is taken up again
    browser.press("#preview", "Change").await;
    browser.type_into("#draw-name", "crates").await;
    browser.click("#draw-done").await;
    browser.says("#preview", "an obstacle “crates”").await;
    until_it_may_be_saved(&browser).await;
    browser.click("#save").await;
    browser.says("#saved", "an obstacle “crates”").await;
    assert_eq!(site.sqlite3(LAID), ["obstacle|crates||[[0.0,0.0],[2.0,0.0],[2.0,1.0],[0.5,1.2]]"]);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_lies_over_the_map_is_taken_away_or_moved_from_the_map_with_a_preview() {
    let (site, service, browser) = starter().await;
    let lay = serde_json::json!({"what": "obstacle", "name": "pallets", "corners": [[7.0, 2.0], [9.0, 5.5]]});
    assert_eq!(service.ask("POST", "/api/areas", Some(&lay)).0, 200);
    browser.until("document.getElementById('canvas').dataset.generation === '2'", "it is seen").await;
    let open = async || {
        browser.tap_on_map([8.0, 3.0]).await;
        browser.says("#popover", "pallets").await;
    };
    open().await;
    browser.press("#popover", "Take away the obstacle “pallets”").await;
    browser.says("#preview", "Taken away: the obstacle “pallets”").await;
    browser.says("#preview", "The way that you look at").await;
    browser.screenshot("draw-taken-away").await;
    browser.press("#preview", "Discard").await;
    open().await;
    browser.press("#popover", "Move or change").await;
    browser.type_into("#draw-corners", "7,2 8,3").await;
    browser.says("#preview", "Moved or changed: an obstacle “pallets”").await;
    until_it_may_be_saved(&browser).await;
    browser.click("#save").await;
    browser.says("#saved", "Saved").await;
    assert_eq!(site.sqlite3(LAID), ["obstacle|pallets||[[7.0,2.0],[8.0,2.0],[8.0,3.0],[7.0,3.0]]"]);
    assert_eq!(site.sqlite3("SELECT count(DISTINCT change_set) FROM history"), ["2"], "one edit, one undo");
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    assert_eq!(site.sqlite3(LAID), ["obstacle|pallets||[[7.0,2.0],[9.0,2.0],[9.0,5.5],[7.0,5.5]]"]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_phone_draws_with_a_finger_and_says_how_large_things_are() {
    let (_site, service, desk) = starter().await;
    desk.says("#scale-bar", "m").await;
    desk.hover_on_map([3.0, 2.0]).await;
    // as near as a pixel is, and half of one where the middle of the canvas is between two
    let at = "Math.abs(Number(/x ([^,]+)/.exec(document.getElementById('at').textContent)[1]) - 3) < 0.03";
    desk.until(at, "it says where one points").await;
    let phone = phone(&service).await;
    phone.click("#draw").await;
    phone.drag_on_map([7.0, 1.5], [9.0, 3.5]).await;
    phone.says("#preview", "an area “area 1”").await;
    phone.screenshot("draw-phone").await;
    let wide = phone.value("document.documentElement.scrollWidth - innerWidth").await;
    assert!(wide.as_f64().unwrap() <= 0.0, "{wide} pixels too wide");
}

async fn phone(service: &Service) -> Browser {
    Browser::open(&service.page(WAY), Screen::Phone).await
}

#[tokio::test(flavor = "multi_thread")]
async fn what_lies_over_the_map_is_listed_among_the_facts_and_taken_away_from_there() {
    let (_site, _service, browser) = starter().await;
    browser.click("nav a[href='#facts']").await;
    browser.says("#laid-list", "Nothing lies over the map").await;
    browser.press("#facts", "Draw on the map").await;
    for (field, text) in [("name", "wet floor"), ("kind", "wet"), ("corners", "4,0.5 6,1.5"), ("until", "2h")]
    {
        browser.type_into(&format!("#draw-{field}"), text).await;
    }
    save(&browser, "an area “wet floor” (wet) for 2 h").await;
    browser.click("nav a[href='#facts']").await;
    browser.says("#laid-list", "wet floor").await;
    browser.press("#laid-list", "Take away").await;
    save(&browser, "Taken away: the area “wet floor” (wet)").await;
    browser.click("nav a[href='#facts']").await;
    browser.says("#laid-list", "Nothing lies over the map").await;
}

/// Saves what waits, once it says this and what it would change.
async fn save(browser: &Browser, words: &str) {
    browser.says("#preview", words).await;
    until_it_may_be_saved(browser).await;
    browser.click("#save").await;
    browser.says("#saved", words).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_bridge_and_a_named_doorway_are_drawn_and_what_lies_there_is_measured() {
    let (site, _service, browser) = starter().await;
    browser.says("#route-title", "home to window").await;
    let cost = browser.text("#route-title .total").await;
    browser.click("#draw").await;
    choose(&browser, "#draw-what", "bridge").await;
    browser.drag_on_map([8.0, 0.0], [9.0, 8.0]).await;
    browser.says("#preview", "needs a height").await;
    browser.client.active_element().await.unwrap().send_keys("pipe").await.unwrap();
    browser.type_into("#draw-height", "1.3").await;
    browser.says("#preview", "New on the map: a bridge “pipe” (1.3 m high)").await;
    browser.click("#draw-done").await;
    browser.click("#draw").await;
    choose(&browser, "#draw-what", "door").await;
    browser.drag_on_map([6.0, 3.0], [6.0, 4.0]).await;
    browser.says("#draw-size", "1.00 m wide").await;
    browser.client.active_element().await.unwrap().send_keys("ward door").await.unwrap();
    browser.says("#preview", "New on the map: a named doorway “ward door”").await;
    browser.click("#draw-done").await;
    browser.screenshot("draw-bridge").await;
    save(&browser, "a bridge “pipe”").await;
    assert_eq!(
        site.sqlite3("SELECT what, name, outline, properties FROM laid ORDER BY name"),
        [
            "bridge|pipe|[[8.0,0.0],[9.0,0.0],[9.0,8.0],[8.0,8.0]]|{\"height\":1.3}",
            "door|ward door|[[6.0,3.0],[6.0,4.0]]|{}"
        ]
    );
    browser
        .until(&format!("document.querySelector('#route-title .total').innerText !== {cost:?}"), "one squats")
        .await;

    // from wall to wall of the doorway
    browser.click("#measuring").await;
    browser.tap_on_map([6.0, 3.0]).await;
    browser.tap_on_map([6.0, 4.0]).await;
    browser.says("#measured", "1.00 m").await;
    browser.screenshot("measured").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn on_a_phone_what_is_said_of_a_point_does_not_cover_it() {
    let (_site, service, _desk) = starter().await;
    let phone = Browser::open(&service.page(WAY), Screen::Phone).await;
    phone.says("#route-title", "home to window").await;
    let note = "document.addEventListener('pointerup', (event) => { window.pressed = event.clientY; }, true)";
    phone.run(note).await;
    for y in [0.5, 2.0, 4.0, 6.0, 7.5] {
        phone.tap_on_map([8.0, y]).await;
        phone.until("!document.getElementById('popover').hidden", "the card is there").await;
        let covers = "(({ top, bottom }) => top <= window.pressed && window.pressed <= bottom)(document.getElementById('popover').getBoundingClientRect())";
        assert_eq!(phone.value(covers).await, false, "at {y}");
        phone.run("document.querySelector('#popover .shut').click()").await;
    }
}
