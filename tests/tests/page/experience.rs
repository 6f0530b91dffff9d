//! What robots measured proposes values, which are taken cell by cell, with the preview.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::at_a_desk;

#[tokio::test(flavor = "multi_thread")]
async fn measurements_propose_a_value_that_is_previewed_before_it_is_saved() {
    let (_site, _service, browser) = at_a_desk("clinic", "#experience").await;
    let mut rows = String::from("state,distance,measured\n");
    for n in 1..=12 {
        let (far, noise) = (f64::from(n), if n % 2 == 0 { 0.02 } else { -0.02 });
        writeln!(rows, "STAND,{far},{:.3}", far * (1.0 + noise)).unwrap();
        // Twice as many on foot: the state with most data keeps its value, the others follow.
        writeln!(rows, "STAND,{far},{:.3}", far * (1.0 - noise)).unwrap();
        writeln!(rows, "SQUAT,{far},{:.3}", far * (5.0 + noise)).unwrap();
    }
    browser.find("#traversals").await;
    browser.run(&format!("document.getElementById('traversals').value = {rows:?}")).await;
    browser.click("#traversals-add").await;
    browser.says("#experience-said", "36 rows").await;
    browser.says("#fit", "SQUAT").await;
    browser.screenshot("experience").await;
    browser.click("#fit button[aria-label*='SQUAT']").await;
    browser.press("#fit", "See on the map").await;
    browser.says("#preview", "SQUAT hardness 4 → ").await;
    browser.says("#preview-summary", "would change").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn where_two_things_were_measured_one_of_them_is_chosen() {
    let (_site, service, browser) = at_a_desk("clinic", "#experience").await;
    for (measure, squat) in [("seconds", 5.0), ("joules", 9.0)] {
        let row = |state: &str, far: f64, each: f64| json!({"state": state, "distance": far, "measured": far * each});
        let far = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
        let rows: Vec<Value> =
            far.iter().flat_map(|&far| [row("STAND", 2.0 * far, 1.0), row("SQUAT", far, squat)]).collect();
        let body = json!({"traversals": rows, "measure": measure});
        let (status, answer) = service.ask("POST", "/api/traversals", Some(&body));
        assert_eq!(status, 200, "{answer}");
    }
    browser.goto(&service.page("#experience")).await;
    browser.run("location.reload()").await;
    browser.says("#fit", "By what was measured in").await;
    browser.says("#fit tbody", "9").await;
    browser
        .run("const choice = document.querySelector('#fit select'); choice.value = 'seconds'; choice.dispatchEvent(new Event('change'))")
        .await;
    browser.until("[...document.querySelectorAll('#fit tbody tr')].some((row) => row.textContent.includes('SQUAT') && row.querySelector('b').textContent === '5')", "seconds are fitted").await;
}
