//! An expert asks by SQL.

use crate::at_a_desk;

#[tokio::test(flavor = "multi_thread")]
async fn a_query_gives_a_table_a_link_and_can_be_kept() {
    let (_site, service, browser) = at_a_desk("paper", "#sql").await;
    let write = |text: &str| {
        format!(
            "const area = document.querySelector('#sql textarea'); area.value = {text:?}; \
             area.dispatchEvent(new Event('input', {{ bubbles: true }}));"
        )
    };
    browser.find("#sql textarea").await;
    browser.run(&write("SELECT state, hardness FROM robots ORDER BY position")).await;
    browser.find("#sql textarea").await.send_keys("\u{e009}\u{e007}").await.unwrap();
    browser.says("#sql-answer", "5 rows").await;
    browser.says("#sql-answer", "LIE-FACE-DOWN").await;
    browser.screenshot("sql").await;

    browser.type_into("#query-name", "states").await;
    browser.press("#sql", "Save the query").await;
    browser.says("#sql-saved", "states").await;

    browser.run(&write("DELETE FROM robots")).await;
    browser.click("#sql-run").await;
    browser.until("document.querySelector('#sql-answer .wrong')", "it only reads").await;

    browser.press("#sql-saved", "states").await;
    browser.says("#sql-answer", "5 rows").await;
    let hash = browser.value("location.hash").await;
    browser.client.goto("about:blank").await.unwrap();
    browser.goto(&format!("{}{}", service.page(""), hash.as_str().unwrap())).await;
    browser.says("#sql-answer", "LIE-FACE-DOWN").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_users_name_is_text_and_never_html() {
    let (_site, _service, browser) =
        at_a_desk("paper", "#sql?q=SELECT%20'<img%20src%3Dx%20onerror%3D\"window.hit%3D1\">'%20AS%20name")
            .await;
    browser.says("#sql-answer", "<img").await;
    assert_eq!(browser.value("window.hit === undefined").await, true);
}
