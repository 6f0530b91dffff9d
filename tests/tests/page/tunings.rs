//! Named tunings on the page: begun, filled, switched on with a preview; cells say what counts, and why.

use crate::{at_a_desk, hardness_of};

#[tokio::test(flavor = "multi_thread")]
async fn a_tuning_is_begun_filled_and_switched_on_and_cells_say_what_counts() {
    let (site, _service, browser) = at_a_desk("clinic", "#map?start=dock&goal=ward%2012").await;
    browser.says("#route", "walk-on-knee").await;
    let edit_in = async |value: &str| {
        let script = format!(
            "const choice = document.getElementById('edit-in'); choice.value = {value:?};
             choice.dispatchEvent(new Event('change'))"
        );
        browser.run(&script).await;
    };
    edit_in("/").await;
    browser.type_into("#new-tuning", "night\u{e007}").await;
    browser.type_into(&hardness_of("SQUAT"), "9").await;
    browser.says("#preview", "SQUAT hardness 4 → 9 in the tuning “night”, which is off").await;
    browser.says("#preview-summary", "No room or door would change").await;
    browser.until("!document.getElementById('save').disabled", "it may be saved").await;
    browser.click("#save").await;
    browser.says("#saved", "in the tuning “night”").await;
    assert_eq!(site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'"), ["4.0"]);

    // it is in the header from now on, and is switched there
    browser.click("#tunings input").await;
    browser.says("#preview", "Tuning “night” on").await;
    browser.says("#preview-summary", "rooms would change").await;
    assert_eq!(site.sqlite3("SELECT count(*) FROM active_tunings"), ["0"], "nothing is saved yet");
    browser.until("!document.getElementById('save').disabled", "it may be saved").await;
    browser.click("#save").await;
    browser.says("#saved", "Tuning “night” on").await;
    browser
        .until(
            "!document.querySelector('#route').innerText.includes('walk-on-knee')",
            "the way is another one",
        )
        .await;

    // the table's own value stands beside what counts
    edit_in("").await;
    let cell = "document.querySelector(\"[data-key='robot/SQUAT'] input[aria-label^=hardness]\").value";
    browser.until(&format!("{cell} === '4'"), "the value of the table").await;
    browser.says("[data-key='robot/SQUAT']", "9 counts: night is on").await;
    browser.screenshot("tunings").await;
    browser.type_into(&hardness_of("SQUAT"), "5").await;
    browser.says("#preview", "SQUAT hardness 4 → 5").await;
    browser.says("#preview-summary", "No room or door would change").await;
    browser.press("#preview", "Discard").await;
    edit_in("night").await;
    browser.until(&format!("{cell} === '9'"), "the value of the tuning").await;
}
