//! All of it without a mouse.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;

use crate::at_a_desk;

const TAB: &str = "\u{e004}";
const ENTER: &str = "\u{e007}";
const ESCAPE: &str = "\u{e00c}";

async fn press(browser: &Browser, keys: &str) {
    browser.client.active_element().await.unwrap().send_keys(keys).await.unwrap();
}

/// Presses Tab until the focus is on what this expression finds in `e`.
async fn tab_to(browser: &Browser, test: &str) {
    for _ in 0..80 {
        press(browser, TAB).await;
        if browser.value(&format!("((e) => Boolean({test}))(document.activeElement)")).await == true {
            return;
        }
    }
    panic!("Tab never comes to {test}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_way_is_asked_a_cell_tuned_and_taken_back_by_keys_alone() {
    let (_site, _service, browser) = at_a_desk("paper", "").await;
    browser.says("#route", "Now say where to").await;
    // The first Tab offers to skip what stands on every page.
    press(&browser, TAB).await;
    assert_eq!(browser.value("document.activeElement.id").await, "skip");
    press(&browser, ENTER).await;
    tab_to(&browser, "e.id === 'goal'").await;
    press(&browser, "c").await;
    press(&browser, ENTER).await;
    browser.says("#route-title", "home to c").await;

    // The map moves and answers.
    tab_to(&browser, "e.id === 'canvas'").await;
    assert_ne!(
        browser.value("getComputedStyle(document.activeElement).outlineStyle").await,
        "none",
        "the focus is seen"
    );
    press(&browser, "+").await;
    press(&browser, "\u{e012}\u{e012}").await;
    press(&browser, ENTER).await;
    browser.says("#popover", "Start here").await;
    press(&browser, ESCAPE).await;
    browser.until("document.activeElement.id === 'canvas'", "the focus is back on the map").await;

    tab_to(&browser, "e.getAttribute('aria-label') === 'hardness of SQUAT'").await;
    press(&browser, "\u{e009}a\u{e000}3").await;
    browser.says("#preview", "SQUAT hardness 4 → 3").await;
    browser.says("#preview-summary", "would change").await;
    tab_to(&browser, "e.id === 'save'").await;
    press(&browser, ENTER).await;
    browser.says("#saved", "4 → 3").await;
    browser.run("document.getElementById('content').focus()").await;
    tab_to(&browser, "e.id === 'undo'").await;
    press(&browser, ENTER).await;
    browser.says("dialog", "would change.").await;
    tab_to(&browser, "e.textContent === 'Take it back'").await;
    press(&browser, ENTER).await;
    browser.says("#saved", "Taken back").await;
}

/// By the first link of the page, which leads past the map.
#[tokio::test(flavor = "multi_thread")]
async fn the_first_number_is_a_few_keys_away() {
    for screen in [Screen::Desktop, Screen::Phone] {
        let site = TestSite::example("clinic").built();
        let service = Service::start(&site);
        let browser = Browser::open(&service.page(""), screen).await;
        browser.says("#tables", "SQUAT").await;
        let mut tabs = 0;
        while browser.value("document.activeElement.matches('#tables td.number input')").await != true {
            press(&browser, TAB).await;
            tabs += 1;
            assert!(tabs <= 8, "more than 8 Tabs lead to the first number");
            if browser.value("document.activeElement.id").await == "to-tables" {
                press(&browser, ENTER).await;
                browser
                    .until("document.activeElement.closest('#tables')", "the link leads to the tables")
                    .await;
            }
        }
    }
}
