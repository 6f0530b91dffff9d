//! An expert asks: why this, why not that way, how firm.

use crate::at_a_desk;

#[tokio::test(flavor = "multi_thread")]
async fn why_names_the_rule_and_why_not_says_what_decides() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.says("#route-title", "92.0").await;
    browser.press("#route", "Why this way?").await;
    browser.says("#why-card .sentence", "Walk-on-knee").await;
    // what rules say stands beneath what people do
    browser.press("#route .run-more", "Why?").await;
    browser.says("#why-card", "What rules say of").await;
    browser.click("#why-card summary").await;
    browser.says("#why-card", "weigh a door").await;

    // Room a is asked for by name, through the table of rooms and doors.
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", "room a").await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Why not through room a?").await;
    browser.says("#why-not-card .sentence", "a").await;
    browser.says("#why-not-card", "SQUAT does not fit").await;
    browser.screenshot("why-not").await;

    // The rule is one click away.
    browser.press("#why-card .reasons", "weigh a door").await;
    browser.says("#rules-name", "doors.rhai").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn how_firm_shows_between_which_values_the_way_stays() {
    let (_site, _service, browser) = at_a_desk("clinic", "#map?start=dock&goal=lobby").await;
    browser.click("#how-firm").await;
    browser.says("#firm", "SQUAT hardness").await;
    browser.says("#firm", "stays the best between").await;
    browser.screenshot("firm").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_click_on_the_map_sets_the_ends() {
    let (_site, service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.says("#route-title", "f to e").await;
    // Room g, in the upper middle of the floor: a point of the map's picture, found by its card in the table.
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", "room g").await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Go here").await;
    browser.until("document.getElementById('goal').value.includes(',')", "the goal is a point").await;
    browser.until("document.querySelector('#route .runs')", "there is a way").await;
    // The link says it too.
    browser.until("location.hash.includes('goal=')", "the address says it").await;
    let hash = browser.value("location.hash").await;
    let shared = format!("{}{}", service.page(""), hash.as_str().unwrap());
    let cost = browser.text("#route-title .total").await;
    browser.client.goto("about:blank").await.unwrap();
    browser.goto(&shared).await;
    assert_eq!(browser.text("#route-title .total").await, cost);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_place_that_is_not_known_is_said_beside_its_field_and_the_way_stays() {
    let (_site, _service, browser) = at_a_desk("clinic", "#map?start=dock&goal=chapel").await;
    browser.says("#route-title", "dock to chapel").await;
    browser.type_into("#goal", "pharm\u{e007}").await;
    browser.says("#ends-said", "pharm").await;
    browser.says("#route-title", "dock to chapel").await;
    assert_eq!(browser.value("document.getElementById('goal').ariaInvalid").await, "true");
    browser.press("#ends-said", "pharmacy").await;
    browser.says("#route-title", "dock to pharmacy").await;
    assert_eq!(browser.value("document.getElementById('ends-said').innerText").await, "");
}
