//! The history on the page: what was done in one go is one entry in words, taken back once it was seen what that does.

use adit_tests::browser::{Browser, Screen};
use serde_json::json;

use crate::at_a_desk;

#[tokio::test(flavor = "multi_thread")]
async fn what_was_done_in_one_go_is_one_entry_in_words_and_taken_back_with_a_preview() {
    let (site, service, browser) = at_a_desk("paper", "#history").await;
    browser.says("#history", "Nothing was edited yet").await;
    let edits = [
        json!({"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 3}),
        json!({"kind": "lay", "name": "wet floor", "corners": [[1.0, 1.0], [2.0, 2.0]], "properties": {"kind": "wet"}}),
        json!({"kind": "tell", "class": "DOORS", "object": "3", "property": "passable", "value": false}),
        json!({"kind": "set_in_tuning", "tuning": "night", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 9}),
        json!({"kind": "switch", "tuning": "night", "on": true}),
    ];
    let body = json!({"edit": {"kind": "together", "edits": edits}, "why": "a spill"});
    assert_eq!(service.ask("POST", "/api/edits", Some(&body)).0, 200);
    for words in ["A cell, an area, a fact, a tuned cell and a tuning", "a spill", "All 5"] {
        browser.says("#history", words).await;
    }
    browser.run("document.querySelector('#history details').open = true").await;
    for words in [
        "Robot states, SQUAT hardness 4 → 3",
        "New on the map: the area “wet floor” (wet)",
        "Told: door at ",
        "passable: no",
        "Tuning “night”: SQUAT hardness 9",
        "Tuning “night” on",
    ] {
        browser.says("#history", words).await;
    }
    let text = browser.text("#history").await;
    assert!(!text.contains(['{', '_']), "no row as JSON, no name of a column: {text}");
    browser.screenshot("history-together").await;
    let undos = "[...document.querySelectorAll('#history button')].filter((b) => b.textContent.includes('Undo')).length";
    assert_eq!(browser.value(undos).await, 1);

    browser.press("#history", "Undo").await;
    browser.says("dialog", "Take back “a cell, an area, a fact, a tuned cell and a tuning”?").await;
    browser.says("dialog", "would change.").await;
    browser.press("dialog", "Keep").await;
    assert_eq!(site.sqlite3("SELECT count(*) FROM laid"), ["1"], "nothing is taken back yet");
    browser.press("#history", "Undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#history", "Taken back: a cell, an area").await;
    assert_eq!(site.sqlite3("SELECT count(*) FROM laid UNION ALL SELECT count(*) FROM told UNION ALL SELECT count(*) FROM active_tunings"), ["0", "0", "0"]);

    // on a phone the way back stands beside what it takes back
    let phone = Browser::open(&service.page("#history"), Screen::Phone).await;
    phone.says("#history", "Taken back").await;
    let wide = phone.value("document.querySelector('#history .scroll').scrollWidth - document.querySelector('#history .scroll').clientWidth").await;
    assert!(wide.as_f64().unwrap() <= 0.0, "{wide} pixels are out of sight");
}
