//! An expert tunes a cell: sees what it would change, saves it, takes it back.

use adit_tests::browser::{Browser, Screen};

use crate::{at_a_desk, hardness_of};

#[tokio::test(flavor = "multi_thread")]
async fn a_cell_is_previewed_saved_and_taken_back() {
    let (site, _service, browser) = at_a_desk("clinic", "#map?start=dock&goal=ward%2012").await;
    browser.says("#route", "walk-on-knee").await;
    let cost = browser.text("#route-title .total").await;

    browser.type_into(&hardness_of("SQUAT"), "7").await;
    browser.says("#preview", "SQUAT hardness 4 → 7").await;
    browser.says("#preview-summary", "rooms would change").await;
    browser.says("#preview", "another way").await;
    browser
        .until(
            "Number(document.getElementById('canvas').dataset.changed) > 0",
            "the map shows what would change",
        )
        .await;
    browser.screenshot("tune-preview").await;
    // Nothing is saved: the way is what it was, and so is the table.
    assert_eq!(browser.text("#route-title .total").await, cost);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);

    browser.type_into("#save-why", "knees wear out").await;
    browser.click("#save").await;
    browser.says("#saved", "Saved: SQUAT hardness 4 → 7").await;
    browser
        .until(
            "!document.querySelector('#route').innerText.includes('walk-on-knee')",
            "the way avoids the knees",
        )
        .await;
    assert_ne!(browser.text("#route-title .total").await, cost);
    let kept = site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'");
    assert_eq!(kept, ["7.0"]);

    browser.click("#undo").await;
    browser
        .until(
            "document.querySelector('dialog[open]') && Number(document.getElementById('canvas').dataset.changed) > 0",
            "what taking it back would change is marked on the map",
        )
        .await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    browser.says("#route", "walk-on-knee").await;
    assert_eq!(browser.text("#route-title .total").await, cost);
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);

    browser.click("nav a[href='#history']").await;
    browser.says("#history", "knees wear out").await;
    browser.says("#history", "taken back").await;
    browser.screenshot("history").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_edit_is_discarded_by_escape_and_a_word_is_no_number() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    let cell = hardness_of("SQUAT");
    browser.type_into(&cell, "soft").await;
    browser.says("#preview", "needs a number").await;
    browser.until("document.getElementById('save').disabled", "what is no number cannot be saved").await;
    browser.type_into(&cell, "2,5").await;
    browser.says("#preview", "SQUAT hardness 4 → 2.5").await;
    browser.find(&cell).await.send_keys("\u{e00c}").await.unwrap();
    browser.until("document.getElementById('preview-card').hidden", "the edit is gone").await;
    assert_eq!(
        browser
            .value("document.querySelector(\"[data-key='robot/SQUAT'] input[aria-label^=hardness]\").value")
            .await,
        "4"
    );
}

/// How firm the way is stands back while a preview is waited for.
#[tokio::test(flavor = "multi_thread")]
async fn what_stands_back_for_a_preview_goes_on_where_that_is_discarded_before_it_comes() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    let slow = "const real = window.fetch; window.fetch = (at, how) => String(at).includes('/api/preview') \
        ? new Promise((_, refuse) => { window.isAsked = true; how.signal.addEventListener('abort', () => refuse(new DOMException('', 'AbortError'))); }) \
        : real(at, how)";
    browser.run(slow).await;
    let cell = hardness_of("SQUAT");
    browser.type_into(&cell, "2.5").await;
    browser.until("window.isAsked", "a preview is asked for").await;
    browser.find(&cell).await.send_keys("\u{e00c}").await.unwrap();
    browser.until("document.getElementById('preview-card').hidden", "the edit is gone").await;
    browser.click("#how-firm").await;
    browser.says("#firm", "STAND hardness is 1; the way stays the best").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn of_two_experts_the_later_one_is_told_and_nothing_is_lost() {
    let (site, service, anna) = at_a_desk("paper", "#map?start=f&goal=e").await;
    let bert = Browser::open(&service.page("#map?start=f&goal=e"), Screen::Desktop).await;
    let cell = hardness_of("SQUAT");
    // Bert types while Anna saves.
    bert.type_into(&cell, "6").await;
    bert.says("#preview", "SQUAT hardness 4 → 6").await;
    anna.type_into(&cell, "3").await;
    anna.says("#preview-summary", "would change").await;
    anna.click("#save").await;
    anna.says("#saved", "4 → 3").await;
    bert.says("[data-key='robot/SQUAT']", "meanwhile 3").await;
    // he is told at once, and saves nothing over it unseen
    bert.says(".conflict", "SQUAT hardness is 3 by now, edited on the page; it was 4 when you began.").await;
    assert_eq!(bert.value("document.getElementById('save').disabled").await, true);
    bert.screenshot("conflict").await;
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["3.0"]);

    // He insists; both see it.
    bert.click(".set-mine").await;
    bert.says("#preview", "SQUAT hardness 3 → 6").await;
    bert.until("!document.getElementById('save').disabled", "what that would change is shown").await;
    bert.click("#save").await;
    bert.says("#saved", "3 → 6").await;
    let shown =
        "document.querySelector(\"[data-key='robot/SQUAT'] input[aria-label^=hardness]\").value === '6'";
    anna.until(shown, "Anna sees what Bert saved").await;
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["6.0"]);
}
