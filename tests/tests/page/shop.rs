//! A site of tables and rules alone, on the page.

use crate::at_a_desk;

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
    browser.says("#preview-summary", "4 conclusions would be otherwise").await;
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
