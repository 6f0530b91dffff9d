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
    browser.says("#preview", "No longer told").await;
    browser.says("#preview-summary", "would change").await;
    browser.press("#preview", "Save").await;
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
    browser.says("#close-preview", "The way that you look at").await;
    browser.press("#tell-card", "Close door 3").await;
    leads_through_door_5(&browser).await;
    // what is closed is opened from where it was closed
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Open door 3 again").await;
    browser.says("#close-preview", "The way that you look at").await;
    browser.press("#tell-card", "Open door 3 again").await;
    browser.says("#route-title", "92.0").await;
    browser.press("#saved", "Undo").await;
    browser.press("dialog", "Take it back").await;
    leads_through_door_5(&browser).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_nurse_closes_a_doorway_on_the_page() {
    let (_site, service, browser) = at_a_desk("clinic", "#map?start=dock&goal=ward%2012").await;
    let route = || service.ask("GET", "/api/route?start=dock&goal=ward%2012", None).1;
    let before = route();
    let steps = before["steps"].as_array().unwrap();
    // one beside which another way leads
    let leads_elsewhere = |doorway: &&str| {
        let avoid = doorway.replace(' ', "%20");
        let question = format!("/api/route?start=dock&goal=ward%2012&avoid={avoid}");
        service.ask("GET", &question, None).1["status"] == "ok"
    };
    let mut doorways = steps.iter().filter_map(|step| step["doorway"].as_str());
    let doorway = doorways.find(leads_elsewhere).expect("a doorway that can be gone around").to_owned();
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", &format!("{doorway} ")).await;
    browser.press("#outline-list", "Show").await;
    browser.says("#popover h3", &doorway).await;
    browser.says("#popover", "wide, between").await;
    browser.screenshot("doorway").await;
    browser.press("#popover", &format!("Close {doorway}")).await;
    browser.says("#close-preview", &format!("{doorway} at")).await;
    browser.says("#close-preview", "another way (hatched in amber)").await;
    browser.says("#legend", "would change").await;
    assert_eq!(route()["cost"], before["cost"], "nothing is done before it is said");
    browser.press("#tell-card", &format!("Close {doorway}")).await;
    browser.says("#saved", "done").await;
    assert!(route()["cost"].as_f64() > before["cost"].as_f64());
    browser.screenshot("doorway-closed").await;
    browser.press("#saved", "Undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    assert_eq!(route()["cost"], before["cost"]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_doorway_is_closed_from_one_side_on_the_page() {
    let (_site, service, browser) = at_a_desk("clinic", "#map?start=dock&goal=ward%2012").await;
    let status = |from: &str, to: &str| {
        service.ask("GET", &format!("/api/route?start={from}&goal={to}"), None).1["status"].clone()
    };
    let route = service.ask("GET", "/api/route?start=dock&goal=ward%2012", None).1;
    let steps = route["steps"].as_array().unwrap();
    let doorway = steps.iter().rev().find_map(|step| step["doorway"].as_str()).unwrap().to_owned();
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", &format!("{doorway} ")).await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", &format!("Close {doorway}")).await;
    browser
        .run(
            "const from = document.querySelector('#close-from');
             from.value = [...from.options].map(({ value }) => value).find((name) => name && name !== 'ward 12');
             from.dispatchEvent(new Event('input', { bubbles: true }));",
        )
        .await;
    browser.says("#close-preview", "is closed from").await;
    assert_eq!(status("dock", "ward%2012"), "ok", "nothing is done before it is said");
    browser.press("#tell-card", &format!("Close {doorway}")).await;
    browser.says("#saved", "done").await;
    assert_eq!((status("dock", "ward%2012"), status("ward%2012", "dock")), ("no_route".into(), "ok".into()));
    browser.screenshot("doorway-one-way").await;
    browser.run("document.getElementById('outline').open = true").await;
    browser.type_into("#outline-search", &format!("{doorway} ")).await;
    browser.press("#outline-list", "Show").await;
    browser.says("#popover", "closed from").await;
    browser.press("#popover", &format!("Open {doorway}")).await;
    browser.says("#close-preview", "would be found").await;
    browser.press("#tell-card", &format!("Open {doorway}")).await;
    browser.says("#saved", &format!("Open {doorway} again: done")).await;
    assert_eq!(status("dock", "ward%2012"), "ok");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_page_left_open_over_a_restart_recovers_by_itself() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let address = service.address.clone();
    let browser = Browser::open(&service.page("#map?start=f&goal=e"), Screen::Desktop).await;
    browser.type_into(&hardness_of("SQUAT"), "5").await;
    browser.says("#preview-summary", "would change").await;
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

#[tokio::test(flavor = "multi_thread")]
async fn what_stands_against_an_opening_is_said() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    site.adit("lay", &["area", "stairs", "1,1 2,2", "--kind", "keep-out"]).expect_status(0);
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#map?start=home&goal=window"), Screen::Desktop).await;
    browser.says("#route-title", "home to window").await;
    for (title, said) in [
        ("Close stairs", "Close stairs: done."),
        ("Open stairs again", "But stairs stays shut all the same: ask why about"),
    ] {
        browser.tap_on_map([1.5, 1.5]).await;
        browser.press("#popover", title).await;
        browser.press("#tell-card", title).await;
        browser.says("#saved", said).await;
    }
}
