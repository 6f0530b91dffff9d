//! Nothing is saved that was not previewed on the screen, and nothing is done twice by one press.

use std::time::Duration;

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::lock::Lock;
use adit_tests::oracle::random::Chance;
use adit_tests::service::{Service, request};
use serde_json::json;

use crate::rules::own_rules;
use crate::{at_a_desk, hardness_of};

const ENTER: &str = "\u{e007}";
const ESCAPE: &str = "\u{e00c}";

const SQUAT: &str = "SELECT hardness FROM robots WHERE state = 'SQUAT'";
const EDITS: &str = "SELECT count(*) FROM history";

async fn press(browser: &Browser, keys: &str) {
    browser.client.active_element().await.unwrap().send_keys(keys).await.unwrap();
}

/// Types a number in place of what a cell holds, without a pause after it.
async fn type_over(browser: &Browser, css: &str, text: &str) {
    browser.find(css).await.click().await.unwrap();
    press(browser, &format!("\u{e009}a\u{e000}{text}")).await;
}

async fn focused(browser: &Browser) -> String {
    let what = "document.activeElement.getAttribute('aria-label') ?? document.activeElement.id";
    browser.value(what).await.as_str().unwrap_or_default().to_owned()
}

/// The state in the row below the one with this state.
async fn below(browser: &Browser, state: &str) -> String {
    let key =
        format!("document.querySelector(\"[data-key='robot/{state}']\").nextElementSibling.dataset.key");
    browser.value(&key).await.as_str().unwrap().replace("robot/", "")
}

async fn until_it_may_be_saved(browser: &Browser) {
    browser.until("!document.getElementById('save').disabled", "it may be saved").await;
}

/// Enter moved the focus to Save within the key press, which pressed Save; the next one pressed Undo.
#[tokio::test(flavor = "multi_thread")]
async fn enter_goes_down_a_row_and_saves_nothing() {
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    let next = below(&browser, "SQUAT").await;
    type_over(&browser, &hardness_of("SQUAT"), &format!("3{ENTER}")).await;
    assert_eq!(focused(&browser).await, format!("hardness of {next}"));
    browser.says("#preview-summary", "would change").await;
    for _ in 0..8 {
        press(&browser, ENTER).await;
    }
    browser.hold_enter().await;
    browser.says("#preview", "SQUAT hardness 4 → 3").await;
    assert_eq!((site.sqlite3(EDITS), site.sqlite3(SQUAT)), (vec!["0".to_owned()], vec!["4.0".to_owned()]));
}

#[tokio::test(flavor = "multi_thread")]
async fn ctrl_enter_saves_what_was_previewed_and_no_further_enter_takes_it_back() {
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    type_over(&browser, &hardness_of("SQUAT"), "3").await;
    until_it_may_be_saved(&browser).await;
    browser.ctrl_enter();
    browser.says("#saved", "Saved: SQUAT hardness 4 → 3").await;
    assert_eq!(focused(&browser).await, "hardness of SQUAT", "the hand stays where it is");
    press(&browser, ENTER).await;

    // the same by the button: its place is taken by the word of what was saved, not by the way back
    type_over(&browser, &hardness_of("SQUAT"), "5").await;
    until_it_may_be_saved(&browser).await;
    browser.run("document.getElementById('save').focus()").await;
    browser.hold_enter().await;
    browser.says("#saved", "Saved: SQUAT hardness 3 → 5").await;
    press(&browser, ENTER).await;
    browser.hold_enter().await;
    browser.says("#saved", "Saved: SQUAT hardness 3 → 5").await;
    assert_eq!((site.sqlite3(EDITS), site.sqlite3(SQUAT)), (vec!["2".to_owned()], vec!["5.0".to_owned()]));
    // Undo is one Tab away
    press(&browser, "\u{e004}").await;
    assert_eq!(focused(&browser).await, "undo");
}

#[tokio::test(flavor = "multi_thread")]
async fn save_waits_for_the_preview_of_what_is_typed() {
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    let cell = hardness_of("SQUAT");
    type_over(&browser, &cell, "3").await;
    until_it_may_be_saved(&browser).await;
    // what an edit would do cannot be found out while another program writes
    let lock = Lock::hold(&site);
    type_over(&browser, &cell, "7").await;
    browser.ctrl_enter();
    browser.run("document.getElementById('save').click()").await;
    assert_eq!(browser.value("document.getElementById('save').disabled").await, true);
    browser
        .until("document.querySelector('#preview [aria-busy=true]')", "the old counts are marked as such")
        .await;
    tokio::time::sleep(Duration::from_millis(500)).await;
    drop(lock);
    until_it_may_be_saved(&browser).await;
    assert_eq!(site.sqlite3(EDITS), ["0"]);
    browser.ctrl_enter();
    browser.says("#saved", "Saved: SQUAT hardness 4 → 7").await;
    assert_eq!(site.sqlite3(SQUAT), ["7.0"]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_preview_out_of_sight_comes_into_sight_before_ctrl_enter_saves() {
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.client.set_window_size(1_380, 380).await.unwrap();
    let cell = hardness_of("SQUAT");
    type_over(&browser, &cell, "3").await;
    until_it_may_be_saved(&browser).await;
    let is_seen = "(({ top }, card) => top >= card.top)(document.getElementById('preview-summary').getBoundingClientRect(), document.getElementById('preview-card').getBoundingClientRect())";
    browser
        .run("document.getElementById('preview-card').scrollTo({ top: 9_999, behavior: 'instant' })")
        .await;
    assert_eq!(browser.value(is_seen).await, false);
    browser.ctrl_enter();
    browser.until(is_seen, "the preview is seen").await;
    assert_eq!(site.sqlite3(EDITS), ["0"]);
    browser.ctrl_enter();
    browser.says("#saved", "Saved: SQUAT hardness 4 → 3").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_cannot_be_previewed_is_saved_only_by_who_says_so() {
    let site = TestSite::example("paper").built();
    let service = Service::start_with(&site, &["--listen", "127.0.0.1:0", "--answer-seconds", "2"]);
    let browser = Browser::open(&service.page("#map?start=f&goal=e"), Screen::Desktop).await;
    let lock = Lock::hold(&site);
    type_over(&browser, &hardness_of("SQUAT"), "7").await;
    browser.says("#preview", "the answer took too long").await;
    drop(lock);
    browser.ctrl_enter();
    assert_eq!(browser.value("document.getElementById('save').disabled").await, true);
    assert_eq!(site.sqlite3(EDITS), ["0"]);
    browser.press("#preview", "Save without a preview").await;
    browser.says("#saved", "Saved: SQUAT hardness 4 → 7").await;
}

/// An edit that the service refuses is said beside the preview, which comes right after it.
#[tokio::test(flavor = "multi_thread")]
async fn what_was_refused_is_said_until_it_is_edited_again() {
    let site = TestSite::example("paper").built();
    let service = Service::start_with(&site, &["--listen", "127.0.0.1:0", "--answer-seconds", "2"]);
    let browser = Browser::open(&service.page("#map?start=f&goal=e"), Screen::Desktop).await;
    type_over(&browser, &hardness_of("SQUAT"), "7").await;
    until_it_may_be_saved(&browser).await;
    let lock = Lock::hold(&site);
    let address = service.address.clone();
    let before = std::thread::spawn(move || {
        request(&address, "POST", "/api/edits", Some(&crate::set("LIE-FACE-DOWN", 9.0)))
    });
    tokio::time::sleep(Duration::from_millis(300)).await;
    browser.click("#save").await;
    browser.says("#preview", "nothing was changed").await;
    drop(lock);
    assert_eq!(before.join().unwrap().0, 200);
    browser.says("#preview-summary", "would change").await;
    until_it_may_be_saved(&browser).await;
    browser.says("#preview", "nothing was changed").await;
    assert_eq!(site.sqlite3(SQUAT), ["4.0"]);
    type_over(&browser, &hardness_of("SQUAT"), "6").await;
    browser
        .until(
            "!document.getElementById('preview').innerText.includes('nothing was changed')",
            "it is another edit",
        )
        .await;
}

/// The row that moved up under the pointer was taken back, too.
#[tokio::test(flavor = "multi_thread")]
async fn a_double_click_takes_back_one_fact() {
    let (_site, service, browser) = at_a_desk("paper", "#facts").await;
    for door in ["3", "5", "7"] {
        let fact = json!({ "class": "DOORS", "object": door, "property": "hardness", "value": 9 });
        assert_eq!(service.ask("POST", "/api/facts", Some(&fact)).0, 200);
    }
    browser.until("document.querySelectorAll('#facts-list button').length === 3", "three are told").await;
    // the list follows each fact; the buttons are to be those of the last one
    tokio::time::sleep(Duration::from_millis(500)).await;
    browser.double_click("#facts-list button").await;
    tokio::time::sleep(Duration::from_millis(500)).await;
    until_it_may_be_saved(&browser).await;
    browser.press("#preview", "Save").await;
    browser.until("document.querySelectorAll('#facts-list button').length === 2", "one is taken back").await;
    let (_, facts) = service.ask("GET", "/api/facts", None);
    assert_eq!(facts["facts"].as_array().unwrap().len(), 2, "{facts}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_form_that_is_sent_twice_tells_once() {
    let (_site, service, browser) = at_a_desk("paper", "#facts").await;
    browser.type_into("#fact-object", "3").await;
    // what is not seen yet is not told
    browser.run("document.querySelector('.fact-form').requestSubmit()").await;
    browser.says("#fact-would", "would change.").await;
    assert_eq!(service.ask("GET", "/api/facts", None).1["facts"], json!([]));
    browser
        .run("const form = document.querySelector('.fact-form'); form.requestSubmit(); form.requestSubmit()")
        .await;
    browser.says("#preview", "Told: door 3 passable: no").await;
    until_it_may_be_saved(&browser).await;
    browser.run("const save = document.getElementById('save'); save.click(); save.click()").await;
    browser.says("#saved", "Saved: Told").await;
    browser.click("nav a[href='#map']").await;
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", "door 5").await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Close door 5").await;
    browser.says("#close-preview", "would change.").await;
    browser.run("const form = document.querySelector('#tell-card form'); form.requestSubmit(); form.requestSubmit()").await;
    browser.says("#saved", "done").await;
    tokio::time::sleep(Duration::from_millis(500)).await;
    let (_, facts) = service.ask("GET", "/api/facts", None);
    assert_eq!(facts["facts"].as_array().unwrap().len(), 2, "{facts}");
}

/// The second of two saves met the version that the first had made, and the page said that somebody else had saved.
#[tokio::test(flavor = "multi_thread")]
async fn rules_are_saved_once_however_often_the_keys_are_pressed() {
    let (site, service) = own_rules();
    let browser = Browser::open(&service.page("#rules?file=rooms.rhai"), Screen::Desktop).await;
    browser.says("#rules-name", "rooms.rhai").await;
    browser.run("const area = document.querySelector('#rules textarea'); area.focus(); area.setSelectionRange(0, 0)").await;
    press(&browser, &format!("// A word.{ENTER}")).await;
    until_it_may_be_saved(&browser).await;
    for _ in 0..3 {
        browser.ctrl_enter();
    }
    browser.says("#saved", "Saved: rooms.rhai").await;
    tokio::time::sleep(Duration::from_millis(500)).await;
    browser.says("#saved", "Saved: rooms.rhai").await;
    assert_eq!(site.sqlite3(EDITS), ["1"]);
    assert!(site.read("rules/rooms.rhai").contains("// A word."));
}

#[tokio::test(flavor = "multi_thread")]
async fn what_cannot_be_brought_back_is_asked_about_before_it_is_deleted() {
    let (_site, service, browser) = at_a_desk("paper", "#experience").await;
    let measured =
        json!({"traversals": [{"state": "SQUAT", "distance": 2.0, "measured": 8.0}], "measure": "seconds"});
    assert_eq!(service.ask("POST", "/api/traversals", Some(&measured)).0, 200);
    let kept = || service.ask("GET", "/api/traversals", None).1["traversals"].as_array().map(Vec::len);
    browser.press("#experience", "Delete all measurements").await;
    browser.says("dialog", "cannot be brought back").await;
    browser.hold_enter().await;
    browser.until("!document.querySelector('dialog[open]')", "it is kept").await;
    assert_eq!(kept(), Some(1));
    browser.press("#experience", "Delete all measurements").await;
    browser.press("dialog", "Delete them").await;
    browser.says("#experience-said", "deleted").await;
    assert_eq!(kept(), Some(0));
}

/// Notes of each edit that the page sends what of it is on the screen then.
const WATCH: &str = "
    window.sent = [];
    const send = window.fetch;
    window.fetch = async (path, options) => {
        if (path === '/api/edits' && options?.method === 'POST') {
            const { edit } = JSON.parse(options.body);
            const told = document.getElementById('preview-told');
            const summary = document.getElementById('preview-summary');
            const noted = {
                kind: edit.kind,
                values: (edit.edits ?? [edit]).map((one) => String(one.value)),
                isSeen: Boolean(told?.checkVisibility() && summary && told.getAttribute('aria-busy') === 'false'),
                typed: document.querySelector('#preview .typed')?.innerText ?? '',
            };
            window.sent.push(noted);
            const answer = await send(path, options);
            noted.isMade = answer.ok;
            return answer;
        }
        return send(path, options);
    }";

/// Whatever is typed and pressed, and however fast: what is sent was on the screen, with what it would change; what was sent is
/// what the history has.
#[tokio::test(flavor = "multi_thread")]
async fn keys_at_random_save_nothing_that_was_not_previewed() {
    const ACTIONS: usize = 200;
    const SAVE: &str = "document.getElementById('save')?.click()";
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.run(WATCH).await;
    let mut chance = Chance::new(23);
    for _ in 0..ACTIONS {
        let state = ["SQUAT", "LIE-FACE-DOWN", "STAND"][chance.below(3)];
        let number = (1 + chance.below(9)).to_string();
        match chance.below(12) {
            of @ 0..=3 => {
                let script = format!("document.querySelector({:?})?.focus()", hardness_of(state));
                browser.run(&script).await;
                if of > 0 {
                    press(&browser, &format!("\u{e009}a\u{e000}{number}")).await;
                }
            }
            4 => press(&browser, ENTER).await,
            5 => press(&browser, "\u{e004}").await,
            6 => press(&browser, "\u{e008}\u{e004}\u{e000}").await,
            7 => press(&browser, "\u{e00c}").await,
            8 => press(&browser, "\u{e003}").await,
            9 => drop(browser.run(SAVE).await),
            10 => browser.ctrl_enter(),
            // sometimes one looks before one goes on
            _ => {
                tokio::time::sleep(Duration::from_millis(400)).await;
                browser.run(SAVE).await;
                // what cannot be saved, as a cell that is no number, would be in the way of all that follows
                tokio::time::sleep(Duration::from_millis(200)).await;
                browser.run("document.getElementById('discard')?.click()").await;
            }
        }
    }
    tokio::time::sleep(Duration::from_millis(500)).await;
    let sent = browser.value("window.sent").await;
    let sent: Vec<_> =
        sent.as_array().expect("the page was not left").iter().filter(|of| of["kind"] != "undo").collect();
    assert!(!sent.is_empty(), "some of it was saved");
    for edit in &sent {
        assert_eq!(edit["isSeen"], true, "{edit:#}");
        for value in edit["values"].as_array().unwrap() {
            let arrow = format!("→ {}", value.as_str().unwrap());
            assert!(edit["typed"].as_str().unwrap().contains(&arrow), "{edit:#}");
        }
    }
    // what the service refused stands nowhere
    let made = sent.iter().filter(|edit| edit["isMade"] == true);
    let values: usize = made.map(|edit| edit["values"].as_array().unwrap().len()).sum();
    let kept = site.sqlite3(
        "SELECT count(*) FROM history WHERE id NOT IN (SELECT undone FROM history WHERE undone IS NOT NULL)",
    );
    assert_eq!(kept, [values.to_string()], "{sent:#?}");
}

/// What Escape threw away was all that waited, in *Why* too.
#[tokio::test(flavor = "multi_thread")]
async fn escape_throws_nothing_away_and_what_is_discarded_can_be_brought_back() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    for (state, value) in [("SQUAT", "3"), ("STAND", "2"), ("LIE-FACE-DOWN", "9")] {
        type_over(&browser, &hardness_of(state), value).await;
    }
    browser.says("#save", "Save all 3").await;
    browser.click("#save-why").await;
    press(&browser, "knees").await;
    press(&browser, ESCAPE).await;
    assert_eq!(browser.value("document.getElementById('save-why').value").await, "");
    browser.run("document.getElementById('discard').focus()").await;
    press(&browser, ESCAPE).await;
    browser.says("#save", "Save all 3").await;

    // a cell has again what waited when somebody came to it
    type_over(&browser, &hardness_of("SQUAT"), "8").await;
    browser.says("#preview", "SQUAT hardness 4 → 8").await;
    press(&browser, ESCAPE).await;
    browser.says("#preview", "SQUAT hardness 4 → 3").await;
    browser.says("#save", "Save all 3").await;

    browser.press("#preview", "Discard").await;
    browser.says("#saved", "Discarded: 3 changes").await;
    assert_eq!(focused(&browser).await, "saved-said");
    browser.press("#saved", "Undo").await;
    browser.says("#save", "Save all 3").await;
    browser.says("#preview", "SQUAT hardness 4 → 3").await;
    assert_eq!(focused(&browser).await, "preview-title");
}

/// What is drawn waits, too: Escape puts the pen away.
#[tokio::test(flavor = "multi_thread")]
async fn escape_puts_the_pen_away_and_keeps_what_was_drawn() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.click("#draw").await;
    browser.type_into("#draw-name", "wet floor").await;
    browser.type_into("#draw-corners", "1,1 2,2").await;
    press(&browser, ESCAPE).await;
    browser.until("!document.getElementById('draw-form')", "the pen is put away").await;
    browser.says("#preview", "an area “wet floor”").await;
}

/// Holds answers of the service back until `window.goOn` is called.
fn held_back(path: &str) -> String {
    format!(
        "const real = window.fetch; const gate = new Promise((open) => {{ window.goOn = open; }});
         window.fetch = async (at, how) => {{ if (String(at).startsWith({path:?})) await gate; return real(at, how); }}"
    )
}

/// Digits that were typed meanwhile went astray.
#[tokio::test(flavor = "multi_thread")]
async fn a_late_answer_takes_the_focus_from_nobody_who_has_gone_on() {
    let (_site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", "room a").await;
    browser.run(&held_back("/api/why-not")).await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Why not through room a?").await;
    browser.says("#why-not-card", "Looking").await;
    browser.click(&hardness_of("SQUAT")).await;
    let scrolled = browser.value("window.scrollY").await;
    browser.run("window.goOn()").await;
    browser.until("document.querySelector('#why-not-card .sentence')", "the answer").await;
    assert_eq!(focused(&browser).await, "hardness of SQUAT");
    assert_eq!(browser.value("window.scrollY").await, scrolled);

    // who waits for it goes on with it
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Why not through room a?").await;
    browser.until("document.querySelector('#why-not-card .sentence')", "the answer").await;
    let is_there = "document.activeElement.closest('#why-not-card') !== null";
    assert_eq!(browser.value(is_there).await, true);
}

/// A press that came before the preview was lost, and the button looked as if it could be pressed.
#[tokio::test(flavor = "multi_thread")]
async fn a_closing_cannot_be_pressed_before_its_preview_and_is_said_where_one_goes_on() {
    let (site, _service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    browser.click("#outline summary").await;
    browser.type_into("#outline-search", "door 5").await;
    browser.press("#outline-list", "Show").await;
    browser.press("#popover", "Close door 5").await;
    browser.says("#close-preview", "would change.").await;
    browser.run(&held_back("/api/preview")).await;
    browser.click("#close-until").await;
    press(&browser, "2h").await;
    let send = "document.querySelector('#tell-card [type=submit]')";
    assert_eq!(browser.value(&format!("{send}.disabled")).await, true);
    assert_eq!(browser.value("document.getElementById('close-preview').ariaBusy").await, "true");
    press(&browser, ENTER).await;
    tokio::time::sleep(Duration::from_millis(400)).await;
    assert_eq!(site.sqlite3(EDITS), ["0"]);
    browser.run("window.goOn()").await;
    browser.until(&format!("!{send}.disabled"), "the preview is on the screen").await;
    browser.press("#tell-card", "Close door 5").await;
    browser.says("#saved", "done").await;
    assert_eq!(focused(&browser).await, "saved-said");
    let is_seen = "(({ top, bottom }) => top >= 0 && bottom <= innerHeight)(document.getElementById('saved').getBoundingClientRect())";
    assert_eq!(browser.value(is_seen).await, true);
}

#[tokio::test(flavor = "multi_thread")]
async fn ctrl_enter_saves_wherever_the_focus_is() {
    let (site, service, browser) = at_a_desk("paper", "#map?start=f&goal=e").await;
    let tuned = json!({ "edit": { "kind": "set_in_tuning", "tuning": "night", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 9 } });
    let (status, answer) = service.ask("POST", "/api/edits", Some(&tuned));
    assert_eq!(status, 200, "{answer}");
    browser.client.refresh().await.unwrap();
    browser.click("#tunings input").await;
    until_it_may_be_saved(&browser).await;
    assert_eq!(browser.value("document.activeElement.closest('#tunings') !== null").await, true);
    browser.ctrl_enter();
    browser.says("#saved", "Tuning “night” on").await;
    assert_eq!(site.sqlite3("SELECT tuning FROM active_tunings"), ["night"]);

    browser.until("document.querySelector('#tunings input').checked", "it is on").await;
    // so soon again it would count as the second half of a double click
    tokio::time::sleep(std::time::Duration::from_millis(700)).await;
    browser.click("#tunings input").await;
    until_it_may_be_saved(&browser).await;
    browser.run("document.activeElement.blur()").await;
    browser.ctrl_enter();
    browser.says("#saved", "Tuning “night” off").await;
}
