//! An expert breaks a rule and mends it; the working rules stay in force.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use serde_json::Value;

/// The open file's text, with a part of it replaced as if it were typed.
async fn replace(browser: &Browser, from: &str, to: &str) {
    let script = format!(
        "const area = document.querySelector('#rules textarea'); \
         if (!area.value.includes({from:?})) throw new Error('not there'); \
         area.value = area.value.replace({from:?}, {to:?}); area.dispatchEvent(new Event('input', {{ bubbles: true }}));"
    );
    browser.run(&script).await;
}

fn own_rules() -> (TestSite, Service) {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    let service = Service::start(&site);
    (site, service)
}

#[tokio::test(flavor = "multi_thread")]
async fn a_broken_rule_is_underlined_and_never_replaces_the_working_one() {
    let (site, service) = own_rules();
    let browser = Browser::open(&service.page("#rules?file=doors.rhai"), Screen::Desktop).await;
    browser.says("#rules-name", "doors.rhai").await;
    replace(&browser, "through.hardness;", "through.hardnes;").await;
    browser.says("#rules-result", "hardnes").await;
    browser.until("document.querySelector('#rules .under .problem')", "the mistake is underlined").await;
    browser.screenshot("rules-broken").await;
    browser.click("#rules-save").await;
    browser.says("#rules-result", "Not saved").await;
    assert!(!site.read("rules/doors.rhai").contains("through.hardnes;"));

    replace(&browser, "through.hardnes;", "through.hardness;").await;
    browser.until("document.getElementById('rules-save').disabled", "mended: nothing is left to save").await;
    replace(&browser, "door.hardness = door.distance1", "door.hardness = 1.0 + door.distance1").await;
    browser
        .until("document.querySelector('#rules-result .wrong, #rules-result .right')", "it was checked")
        .await;
    browser.screenshot("rules-tested").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_saved_rule_is_in_force_and_a_file_edited_elsewhere_is_followed() {
    let (site, service) = own_rules();
    let browser = Browser::open(&service.page("#rules?file=rooms.rhai"), Screen::Desktop).await;
    browser.says("#rules-name", "rooms.rhai").await;
    replace(&browser, "// How the robot moves", "// Tuned on the page. How the robot moves").await;
    browser.says("#rules-result", "Looks right").await;
    browser.click("#rules-save").await;
    browser.says("#rules-result", "Saved and in force").await;
    assert!(site.read("rules/rooms.rhai").contains("Tuned on the page"));

    // With a text editor: a mistake is said, and mended by mending the file.
    let good = site.read("rules/doors.rhai");
    site.write("rules/doors.rhai", good.replace("weigh a door\"", "weigh a door"));
    browser.says("[data-banner='problems']", "stay in force").await;
    browser.screenshot("rules-banner").await;
    site.write("rules/doors.rhai", &good);
    browser
        .until("!document.querySelector('[data-banner=problems]')", "the banner goes once it is mended")
        .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_shipped_file_is_written_over_by_one_of_the_site() {
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#rules?file=rooms/paper/rooms.rhai"), Screen::Desktop).await;
    browser.says("#rules-note", "lies beneath the rules of this site").await;
    assert_eq!(browser.value("document.querySelector('#rules textarea').readOnly").await, Value::Bool(true));
    browser.click("#write-over").await;
    browser.says("#rules-name", "rooms.rhai").await;
    browser.until("!document.querySelector('#rules textarea').readOnly", "the rules may be edited").await;
    assert!(!site.path().join("rules").exists(), "nothing is saved yet");
    replace(&browser, "// How the robot moves", "// Mine. How the robot moves").await;
    browser.says("#rules-result", "Looks right").await;
    browser.click("#rules-save").await;
    browser.says("#rules-result", "Saved and in force").await;
    assert!(site.read("rules/rooms.rhai").contains("// Mine."));
}
