//! What robots measured proposes values, which are taken cell by cell, with the preview.

use std::fmt::Write as _;

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
