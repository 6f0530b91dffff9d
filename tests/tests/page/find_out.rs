//! Asking on the page: question by question, one of them not known.

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;

#[tokio::test(flavor = "multi_thread")]
async fn a_value_is_found_out_question_by_question() {
    let site = TestSite::example("shop");
    site.write(
        "rules/presents.rhai",
        "property ORDERS.present from ask \"Is order {order} a present?\"
         property ORDERS.colour from ask \"Which colour does order {order} get?\"
         rule \"presents\" each order in ORDERS where order.present && order.colour == \"red\" then { order.wrapping = \"red ribbon\"; }
         rule \"others\" each order in ORDERS where !order.present then { order.wrapping = \"none\"; }\n",
    );
    let site = site.built();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#facts"), Screen::Desktop).await;
    browser.type_into("#ask-what", "orders.2.wrapping").await;
    browser.press("#facts", "Find out").await;
    browser.says("#ask-said", "Is order 2 a present?").await;
    browser.press("#ask-said", "Yes").await;
    browser.says("#ask-said", "Which colour does order 2 get?").await;
    browser.screenshot("ask").await;
    browser.press("#ask-said", "I do not know").await;
    browser.says("#ask-said", "orders.2.wrapping stays unknown while an answer above is not known").await;

    // an answer is changed: what came after it is asked anew
    browser.press("#ask-said", "Change").await;
    browser.press("#ask-said", "No").await;
    browser.says("#ask-said", "orders.2.wrapping is none").await;
    assert!(!browser.text("#ask-said").await.contains("Which colour"), "it is not asked any more");
    browser.press("#ask-said", "Tell the site these answers").await;
    browser.says("#preview", "Told: order 2 present: no").await;
    browser.until("!document.getElementById('save').disabled", "it may be saved").await;
    browser.click("#save").await;
    browser.says("#saved", "Saved: Told").await;
    assert_eq!(
        site.sqlite3("SELECT value FROM conclusions WHERE object = 'orders.2' AND property = 'wrapping'"),
        ["none"]
    );
}
