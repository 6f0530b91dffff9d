//! A site of tables and rules alone, on the page.

use crate::at_a_desk;

/// A decision table is read as one: its cells in words, where two rows say different things, and what no row says anything of.
#[tokio::test(flavor = "multi_thread")]
async fn a_decision_table_is_a_grid_in_which_gaps_and_overlaps_are_marked() {
    let (_site, _service, browser) = at_a_desk("shop", "#rules?file=orders.rhai").await;
    browser.says("#rules-tables", "The first row that matches counts.").await;
    browser.says("#rules-tables td", "from 50 to below 100").await;
    assert_eq!(browser.value("document.querySelectorAll('#rules-tables :is(.amiss, .gap)').length").await, 0);
    let typed = |from: &str, to: &str| {
        format!(
            "const area = document.querySelector('#rules textarea'); if (!area.value.includes({from:?})) throw new Error('not there'); \
             area.value = area.value.replaceAll({from:?}, {to:?}); area.dispatchEvent(new Event('input', {{ bubbles: true }}))"
        )
    };
    browser.run(&typed("at_least(100.0)", "at_least(120.0)")).await;
    browser.says("#rules-tables .gap", "no row").await;
    browser.says("#rules-tables .problems", "No row matches where order.goods").await;
    browser.run(&typed("\"discount\" first", "\"discount\" unique")).await;
    browser.run(&typed("between(50.0, 100.0)", "between(40.0, 100.0)")).await;
    browser.says("#rules-tables .amiss", "overlaps").await;
    browser.says("#rules-tables .problems", "Rows 2 and 3 both match where").await;
    browser.run("document.getElementById('rules-tables').scrollIntoView()").await;
    browser.screenshot("rules-grid").await;
    browser.press("#rules-tables", "3").await;
    let line = "(({ value, selectionStart }) => value.slice(0, selectionStart).split('\\n').length)(document.querySelector('#rules textarea'))";
    let row = browser.value(line).await;
    let text = browser.value("document.querySelector('#rules textarea').value").await;
    let line = text.as_str().unwrap().lines().nth(row.as_u64().unwrap() as usize - 1).unwrap();
    assert!(line.contains("below(50.0),          true"), "{line}");
    browser.press("#preview", "Discard").await;
    browser.until("!document.querySelector('#rules-tables :is(.amiss, .gap)')", "all is right again").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_price_is_tuned_with_what_follows_beside_it() {
    let (site, _service, browser) = at_a_desk("shop", "#map").await;
    for table in ["orders", "products"] {
        browser.run(&format!("document.querySelector(\"[data-table='{table}']\").open = true")).await;
    }
    browser.says("[data-table='orders'] [data-key='2']", "49.36").await;
    browser.screenshot("shop").await;
    let price = "[data-table='products'] [data-key='tea'] input[aria-label^='price']";
    browser.type_into(price, "5").await;
    browser.says("#preview-summary", "4 conclusions would change").await;
    browser.says("#preview", "orders 2: total").await;
    browser.screenshot("shop-preview").await;
    browser.click("#save").await;
    browser.says("#saved", "Saved").await;
    browser.says("[data-table='orders'] [data-key='2']", "58").await;
    assert_eq!(site.sqlite3("SELECT price FROM products WHERE product = 'tea'"), ["5.0"]);
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("[data-table='orders'] [data-key='2']", "49.36").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_order_that_goes_takes_what_follows_of_it_along_and_one_of_nobody_is_said() {
    let (_site, service, browser) = at_a_desk("shop", "#map").await;
    let ask = |edit: serde_json::Value| {
        service.ask("POST", "/api/preview", Some(&serde_json::json!({"edits": [edit]}))).1
    };
    let gone = ask(serde_json::json!({"kind": "remove", "table": "orders", "key": "1"}));
    let gone = gone["conclusions"].as_array().unwrap().clone();
    let of = |name: &str| gone.iter().find(|of| of["property"] == name).unwrap().clone();
    assert!(gone.iter().all(|of| of["what"] == "orders 1" && of["new"].is_null()), "{gone:#?}");
    assert_eq!((&of("goes_out")["old"], gone.len()), (&serde_json::json!(true), 7));
    let new = serde_json::json!({"kind": "add", "table": "orders", "key": "9",
                                 "cells": {"customer": "Adda", "product": "tea", "pieces": "3"}});
    let notes = ask(new)["notes"].clone();
    assert!(notes.to_string().contains("Adda"), "{notes}");
    drop(browser);
}

/// What rules may speak of stands beside the editor, and is written where the cursor is.
#[tokio::test(flavor = "multi_thread")]
async fn classes_and_properties_stand_beside_the_editor_and_are_written_by_a_click() {
    let (_site, _service, browser) = at_a_desk("shop", "#rules?file=orders.rhai").await;
    browser.says("#rules-name", "orders.rhai").await;
    browser.click("#vocabulary summary").await;
    browser.says("#vocabulary", "CUSTOMERS").await;
    browser.type_into("#vocabulary input", "club").await;
    browser.says("#vocabulary", "club").await;
    browser
        .until(
            "!document.querySelector('.vocabulary').innerText.includes('PRODUCTS')",
            "the rest is not shown",
        )
        .await;
    browser.screenshot("rules-vocabulary").await;
    browser
        .run("const area = document.querySelector('#rules textarea'); area.focus(); area.setSelectionRange(0, 0)")
        .await;
    browser.press(".vocabulary", "club").await;
    browser
        .until("document.querySelector('#rules textarea').value.startsWith('club')", "it is written")
        .await;
    browser.says("#preview", "orders.rhai: 1 line changed").await;
}
