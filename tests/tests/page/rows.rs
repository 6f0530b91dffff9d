//! Rows come and go on the page: a state with the changes of shape that it lacks, previewed, saved in one go, taken back.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;

const STATES: &str = "SELECT state, height, hardness FROM robots ORDER BY position";
const CHANGES: &str = "SELECT from_state, to_state FROM changes WHERE 'KNEEL' IN (from_state, to_state)";

async fn until_it_may_be_saved(browser: &Browser) {
    browser.until("!document.getElementById('save').disabled", "it may be saved").await;
}

/// Sends the form of a table by which rows come, or the one by which they go.
async fn send(browser: &Browser, table: &str, form: usize, values: &[(&str, &str)]) {
    let field = |(css, value): &(&str, &str)| format!("form.querySelector({css:?}).value = {value:?};");
    let fields = values.iter().map(field).collect::<Vec<String>>().concat();
    let script = format!(
        "const forms = document.querySelector(\"[data-table='{table}'] .row-forms\");
         forms.open = true;
         const form = forms.querySelectorAll('form')[{form}]; {fields} form.requestSubmit()"
    );
    browser.run(&script).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_state_comes_as_another_one_with_its_changes_and_goes_again() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#map?start=home&goal=window"), Screen::Desktop).await;
    browser.says("#route-title", "home to window").await;
    let before = site.sqlite3(STATES);
    send(&browser, "robots", 0, &[("input", "KNEEL"), ("select", "robot/SQUAT")]).await;
    browser.says("#preview", "New in Robot states: KNEEL, as SQUAT, with 4 rows of Changes of shape").await;
    // the row waits among the others, and so do its changes
    browser
        .until("document.querySelectorAll(\"[data-table='changes'] tr.new\").length === 4", "its changes")
        .await;
    browser.type_into("tr.new input[aria-label^='hardness']", "soft").await;
    browser.says("#preview", "hardness needs a number").await;
    assert_eq!(browser.value("document.getElementById('save').disabled").await, true);
    browser.type_into("tr.new input[aria-label^='hardness']", "3").await;
    browser.type_into("tr.new input[aria-label^='height']", "0.9").await;
    browser.says("#preview-summary", "become cheaper").await;
    browser.screenshot("rows-new").await;
    assert_eq!(site.sqlite3(STATES), before, "nothing is saved yet");
    until_it_may_be_saved(&browser).await;
    browser.click("#save").await;
    browser.says("#saved", "Saved: New in Robot states: KNEEL").await;
    assert_eq!(site.sqlite3(STATES).last().map(String::as_str), Some("KNEEL|0.9|3.0"));
    assert_eq!(site.sqlite3(CHANGES).len(), 4);
    assert_eq!(site.sqlite3("SELECT count(DISTINCT change_set), count(*) FROM history"), ["1|5"]);
    browser.find("[data-key='robot/KNEEL']").await;

    send(&browser, "robots", 1, &[("select", "robot/KNEEL")]).await;
    browser.says("#preview", "Gone from Robot states: KNEEL, with 4 rows of Changes of shape").await;
    browser.says("#preview-summary", "become dearer").await;
    until_it_may_be_saved(&browser).await;
    browser.click("#save").await;
    browser.says("#saved", "Gone from Robot states: KNEEL").await;
    assert_eq!(site.sqlite3(STATES), before);
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    assert_eq!((site.sqlite3(STATES).len(), site.sqlite3(CHANGES).len()), (before.len() + 1, 4));
}

#[tokio::test(flavor = "multi_thread")]
async fn cells_rows_and_drawings_are_saved_in_one_go_and_taken_back_in_one_click() {
    let (site, _service, browser) = crate::at_a_desk("paper", "#map?start=f&goal=e").await;
    let content = || site.sqlite3("SELECT * FROM robots; SELECT * FROM laid; SELECT * FROM hours");
    let before = content();
    browser.type_into(&crate::hardness_of("SQUAT"), "3").await;
    send(&browser, "robots", 1, &[("select", "robot/LIE-FACE-DOWN")]).await;
    browser.click("#draw").await;
    browser.type_into("#draw-name", "wet floor").await;
    browser.type_into("#draw-corners", "1,1 2,2").await;
    browser.says("#preview", "Gone from Robot states: LIE-FACE-DOWN").await;
    browser.says("#preview", "an area “wet floor”").await;
    browser.says("#save", "Save all 3").await;
    // what was drawn stays for another time
    browser.press("#preview li:last-child", "Drop it").await;
    browser.says("#save", "Save all 2").await;
    browser.client.refresh().await.unwrap();
    browser.says("#preview", "SQUAT hardness 4 → 3").await;
    until_it_may_be_saved(&browser).await;
    browser.screenshot("rows-together").await;
    browser.type_into("#save-why", "new knees").await;
    browser.click("#save").await;
    browser.says("#saved", "Saved: SQUAT hardness 4 → 3 and Gone from Robot states: LIE-FACE-DOWN").await;
    assert_eq!(
        site.sqlite3("SELECT count(DISTINCT change_set), min(why), max(why) FROM history"),
        ["1|new knees|new knees"]
    );
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    assert_eq!(content(), before);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_table_goes_to_a_file_and_the_rows_of_a_file_are_previewed_before_they_are_taken() {
    let (site, _service, browser) = crate::at_a_desk("paper", "#map?start=f&goal=e").await;
    browser
        .run(
            "const make = URL.createObjectURL;
             URL.createObjectURL = (blob) => { blob.text().then((text) => { window.went = text; }); return make(blob); };
             document.querySelectorAll(\"[data-table='robots'] details\").forEach((of) => { of.open = true; })",
        )
        .await;
    browser.press("[data-table=robots]", "Download CSV").await;
    browser.until("window.went?.includes('hardness')", "the file").await;
    let before = site.adit("table", &["robots"]).expecting(0).stdout;
    assert_eq!(browser.value("window.went").await.as_str().unwrap().trim_end(), before.trim_end());
    let give = |name: &str, text: &str| {
        format!(
            "const input = document.querySelector(\"[data-table='robots'] input[type=file]\");
             const transfer = new DataTransfer();
             transfer.items.add(new File([{text:?}], {name:?}));
             input.files = transfer.files;
             input.dispatchEvent(new Event('change'))"
        )
    };
    browser.run(&give("states.csv", &before.replace("hardness", "hardnes"))).await;
    browser.says("#preview", "did you mean `hardness`?").await;
    let robots = site.sqlite3("SELECT state || ',' || action || ',' FROM robots ORDER BY position");
    let row = before.lines().find(|line| line.contains(&robots[0])).unwrap();
    browser.run(&give("states.csv", &before.replace(&format!("{row}\n"), ""))).await;
    browser.says("#preview", "Robot states as in states.csv").await;
    browser.says("#preview-cells", "cells would change").await;
    browser.screenshot("rows-of-a-file").await;
    // somebody else edits the table meanwhile
    site.adit("tune", &["robots", &robots_last(&site), "hardness", "7"]).expect_status(0);
    browser.says("#preview", "somebody else edited these rows since states.csv was taken").await;
    let is_listed =
        "[...document.querySelectorAll('#preview-cells li')].some((of) => / 7 /.test(of.textContent))";
    browser.until(is_listed, "what the file would set back is listed").await;
    assert_eq!(browser.value("document.querySelector('#save').disabled").await, true);
    browser.screenshot("rows-of-a-file-of-before").await;
    browser.press("#preview", "Take it all the same").await;
    until_it_may_be_saved(&browser).await;
    browser.click("#save").await;
    browser.says("#saved", "Saved: Robot states as in states.csv").await;
    assert_eq!(site.sqlite3("SELECT count(*) FROM robots"), [(robots.len() - 1).to_string()]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM robots WHERE hardness = 7"), ["0"]);
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#saved", "Taken back").await;
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.adit("table", &["robots"]).expecting(0).stdout, before);
}

/// The state of the paper's robot that stands last.
fn robots_last(site: &TestSite) -> String {
    site.sqlite3("SELECT state FROM robots ORDER BY position DESC").remove(0)
}
