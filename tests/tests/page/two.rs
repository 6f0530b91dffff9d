//! Two people edit at once, at random: nothing is lost, and nothing is saved over what nobody saw.

use std::time::{Duration, Instant};

use adit_tests::browser::{Browser, Screen};
use adit_tests::oracle::random::Chance;
use adit_tests::service::Service;
use serde_json::{Value, json};

use crate::rules::own_rules;

/// Notes each edit that the page sends, and what became of it.
const WATCH: &str = "
    window.sent = [];
    const send = window.fetch;
    window.fetch = async (path, options) => {
        if (path !== '/api/edits' || options?.method !== 'POST') return send(path, options);
        const { edit } = JSON.parse(options.body);
        const told = document.getElementById('preview-told');
        const noted = { edits: edit.edits ?? [edit], isSeen: told?.getAttribute('aria-busy') === 'false' && Boolean(document.getElementById('preview-summary')) };
        window.sent.push(noted);
        const answer = await send(path, options);
        noted.status = answer.status;
        return answer;
    };";

/// Types a line at the end of the file that is open, as if by hand.
fn type_line(line: &str) -> String {
    format!(
        "const area = document.querySelector('#rules textarea'); if (!area.readOnly) {{ area.focus(); area.value += {line:?}; area.dispatchEvent(new Event('input', {{ bubbles: true }})); }}"
    )
}

const PRESS: &str = "const found = [...document.querySelectorAll('#preview button')].find((of) => !of.disabled && of.checkVisibility() && of.textContent.startsWith(WHAT)); found?.click();";

fn press(what: &str) -> String {
    PRESS.replace("WHAT", &format!("{what:?}"))
}

/// The other one edits over HTTP, from what is there, and says what that was.
fn other(service: &Service, chance: &mut Chance, number: usize) -> u16 {
    let edit = if chance.is(0.5) {
        let state = ["SQUAT", "STAND"][chance.below(2)];
        let value = 1 + chance.below(9);
        json!({"kind": "set", "table": "robots", "key": state, "column": "hardness", "value": value})
    } else {
        let (_, rules) = service.ask("GET", "/api/rules", None);
        let name = ["rooms.rhai", "areas.rhai"][chance.below(2)];
        let file = rules["files"].as_array().unwrap().iter().find(|file| file["file"] == name).unwrap();
        let text = format!("{}// theirs {number}\n", file["text"].as_str().unwrap());
        json!({"kind": "write", "file": name, "text": text, "version": file["version"]})
    };
    service.ask("POST", "/api/edits", Some(&json!({"edit": edit, "why": "other"}))).0
}

/// For so long; `ADIT_MINUTES` says otherwise.
fn how_long() -> Duration {
    let minutes = std::env::var("ADIT_MINUTES").ok().and_then(|text| text.parse().ok());
    minutes.map_or(Duration::from_secs(12), |minutes: u64| Duration::from_secs(60 * minutes))
}

#[tokio::test(flavor = "multi_thread")]
async fn of_random_edits_of_two_people_none_is_lost_and_none_saved_over_unseen() {
    let (site, service) = own_rules();
    let browser = Browser::open(&service.page("#rules?file=rooms.rhai"), Screen::Desktop).await;
    browser.says("#rules-name", "rooms.rhai").await;
    browser.run(WATCH).await;
    let seed = std::env::var("ADIT_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(23);
    let (mut chance, began) = (Chance::new(seed), Instant::now());
    let (mut number, mut made) = (0, 0);
    while began.elapsed() < how_long() {
        number += 1;
        match chance.below(12) {
            0..=2 => drop(browser.run(&type_line(&format!("// mine {number}\n"))).await),
            3 => {
                let name = ["rooms.rhai", "areas.rhai"][chance.below(2)];
                let open = format!(
                    "[...document.querySelectorAll('#rules-files button')].find((of) => of.textContent === {name:?})?.click()"
                );
                browser.run(&open).await;
            }
            4 => {
                let value = 1 + chance.below(9);
                let cell = format!(
                    "const cell = document.querySelector({:?}); cell.value = '{value}'; cell.dispatchEvent(new Event('input', {{ bubbles: true }}));",
                    crate::hardness_of("SQUAT")
                );
                browser.run(&cell).await;
            }
            5 | 6 => {
                if chance.is(0.7) {
                    browser.run(&press("Keep mine")).await;
                    browser.run(&press("Set ")).await;
                }
                tokio::time::sleep(Duration::from_millis(chance.below(1_500) as u64)).await;
                browser.run(&press("Save")).await;
            }
            7 => browser.ctrl_enter(),
            8 => drop(
                browser.run(&press(["Keep mine", "Take theirs", "Set ", "Take "][chance.below(4)])).await,
            ),
            _ => made += usize::from(other(&service, &mut chance, number) == 200),
        }
    }
    tokio::time::sleep(Duration::from_secs(1)).await;
    let sent = browser.value("window.sent").await;
    let sent: Vec<&Value> = sent.as_array().expect("the page was not left").iter().collect();
    let saved: Vec<&&Value> = sent.iter().filter(|of| of["status"] == 200).collect();
    let clashes = sent.iter().filter(|of| of["status"] == 409).count();
    assert!(!saved.is_empty() && made > 0, "some of it was saved: {sent:#?}");
    for of in &sent {
        assert_eq!(of["isSeen"], true, "{of:#}");
        for edit in of["edits"].as_array().unwrap() {
            let says_what_was_seen = !edit["old"].is_null() || !edit["version"].is_null();
            assert!(says_what_was_seen, "it says what it is saved over: {edit}");
        }
    }

    // what each entry of the history was saved over is what the one before it left: nothing is lost in between
    let (_, history) = service.ask("GET", "/api/history?limit=1000", None);
    let entries = history["edits"].as_array().unwrap();
    let parts: usize = saved.iter().map(|of| of["edits"].as_array().unwrap().len()).sum();
    if entries.len() < 1_000 {
        assert_eq!(entries.len(), parts + made, "what was acknowledged is what there is");
    }
    let mut last = std::collections::BTreeMap::new();
    for entry in entries.iter().rev() {
        let of = (entry["table"].to_string(), entry["key"].to_string());
        let before = last.insert(of, entry["new"].clone());
        assert!(before.is_none_or(|before| before == entry["old"]), "{entry}");
    }
    for name in ["rooms.rhai", "areas.rhai"] {
        let left = last.get(&(json!("rule files").to_string(), json!(name).to_string()));
        let is_left = left.is_none_or(|text| text.as_str() == Some(&site.read(&format!("rules/{name}"))));
        assert!(is_left, "{name} is what the history says");
    }
    eprintln!(
        "{number} actions, {} saved on the page, {made} by the other, {clashes} refused since somebody else had saved",
        saved.len()
    );
}
