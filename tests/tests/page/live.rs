//! The page follows what others do: robots, other programs, a restart.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use serde_json::json;

use crate::{at_a_desk, hardness_of};

/// Waits until the way's steps, which are folded up, name door 5: round by the east.
async fn leads_through_door_5(browser: &Browser) {
    browser
        .until("document.querySelector('#route').textContent.includes('door 5')", "a way round by door 5")
        .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_door_that_a_robot_closes_sends_the_way_round() {
    let (_site, service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.says("#route-title", "92.0").await;
    let fact =
        json!({ "class": "DOORS", "object": "3", "property": "passable", "value": false, "why": "stuck" });
    let (status, told) = service.ask("POST", "/api/facts", Some(&fact));
    assert_eq!(status, 200, "{told}");
    browser
        .until(
            "!document.querySelector('#route-title').innerText.includes('92.0')",
            "the way changes by itself",
        )
        .await;
    leads_through_door_5(&browser).await;
    browser.screenshot("door-closed").await;

    browser.click("nav a[href='#facts']").await;
    browser.says("#facts-list", "stuck").await;
    browser.press("#facts-list", "Take back").await;
    browser.says("#facts-list", "Nothing is told").await;
    browser.click("nav a[href='#map']").await;
    browser.says("#route-title", "92.0").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_expert_closes_a_door_from_the_map() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", "door 3").await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Close door 3").await;
    browser.press("#tell-card", "Tell it").await;
    leads_through_door_5(&browser).await;
    browser.press("#saved", "Take it back").await;
    browser.says("#route-title", "92.0").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_page_left_open_over_a_restart_recovers_by_itself() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let address = service.address.clone();
    let browser = Browser::open(&service.page("#map?start=f&goal=e"), Screen::Desktop).await;
    browser.type_into(&hardness_of("SQUAT"), "5").await;
    browser.says("#preview-summary", "otherwise").await;
    drop(service);
    browser.says("[data-banner='connection']", "trying again").await;
    browser.screenshot("connection-lost").await;
    site.adit("tune", &["robots", "LIE-FACE-DOWN", "hardness", "9"]).expect_status(0);
    let _service = Service::start_on(&site, &address);
    browser.until("!document.querySelector('[data-banner=connection]')", "the connection is back").await;
    let lie = "document.querySelector(\"[data-key='robot/LIE-FACE-DOWN'] input[aria-label^=hardness]\").value === '9'";
    browser.until(lie, "what changed meanwhile is shown").await;
    // What was typed before is still there.
    browser.says("#preview", "SQUAT hardness 4 → 5").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_another_program_writes_is_seen() {
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.says("#route-title", "92.0").await;
    site.outside_edit("UPDATE robots SET hardness = 1.5 WHERE state = 'SQUAT'");
    browser
        .until("!document.querySelector('#route-title').innerText.includes('92.0')", "the way follows")
        .await;
}
