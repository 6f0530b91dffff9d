//! An accessibility checker (axe-core) finds nothing serious: each tab, light and dark, at a desk and on a phone.

use std::path::PathBuf;

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;
use serde_json::Value;

pub fn axe() -> String {
    let exe = std::env::current_exe().unwrap();
    let file: PathBuf = exe.ancestors().nth(3).unwrap().join("axe/node_modules/axe-core/axe.min.js");
    std::fs::read_to_string(file).expect("axe-core is installed (tests/run installs it)")
}

/// Violations of impact serious or critical: rule and elements.
pub async fn violations(browser: &Browser, axe: &str) -> Vec<String> {
    let script = format!(
        "const done = arguments[arguments.length - 1]; {axe}; \
         window.axe.run(document, {{ resultTypes: ['violations'] }}).then((r) => done(r.violations \
         .filter((v) => ['serious', 'critical'].includes(v.impact)) \
         .map((v) => v.id + ': ' + v.nodes.map((n) => n.html.slice(0, 120) + ' ' + (n.any[0]?.message ?? '')).join(' | '))), (e) => done(['axe: ' + e]));"
    );
    let found = browser.client.execute_async(&script, Vec::new()).await.unwrap();
    found.as_array().unwrap().iter().filter_map(Value::as_str).map(str::to_owned).collect()
}

async fn every_tab(screen: Screen) {
    let site = TestSite::example("clinic").built();
    let service = Service::start(&site);
    let axe = axe();
    let mut all = Vec::new();
    let browser = Browser::open(&service.page(""), screen).await;
    for theme in ["light", "dark"] {
        browser.run(&format!("localStorage.setItem('adit-theme', '{theme}'); location.reload()")).await;
        browser.until("document.querySelector('#route .runs')", "the way is there").await;
        for tab in [
            "map?start=dock&goal=ward%2012",
            "rules",
            "sql?q=SELECT%20*%20FROM%20robots",
            "facts",
            "experience",
            "history",
        ] {
            let name = tab.split('?').next().unwrap();
            browser.run(&format!("location.hash = '#{tab}'")).await;
            browser.find(&format!("[data-tab='{name}']")).await;
            match name {
                "map" => {
                    browser.type_into(&crate::hardness_of("SQUAT"), "7").await;
                    browser.says("#preview-summary", "would change").await;
                    browser.press("#route .run-more", "Why?").await;
                    browser.click("#why-card summary").await;
                    browser.find("#why-card .reasons").await;
                    browser.run("document.querySelector('.row-forms').open = true").await;
                    // on a phone the sheet goes down where the map is meant
                    browser.run("document.getElementById('canvas').focus()").await;
                    browser.click("#draw").await;
                    browser.type_into("#draw-corners", "1,1 2,2").await;
                    browser.says("#preview", "needs a name").await;
                }
                "rules" => browser.says("#rules .under", "rule").await,
                "sql" => browser.says("#sql-answer", "rows").await,
                _ => {}
            }
            tokio::time::sleep(std::time::Duration::from_millis(150)).await;
            browser.screenshot(&format!("{screen:?}-{theme}-{name}").to_lowercase()).await;
            for found in violations(&browser, &axe).await {
                all.push(format!("{screen:?} {theme} {name}: {found}"));
            }
            let wide = browser.value("document.documentElement.scrollWidth - innerWidth").await;
            if wide.as_f64().unwrap() > 0.0 {
                all.push(format!("{screen:?} {theme} {name}: {wide} pixels too wide"));
            }
        }
        browser.run("location.hash = '#map'").await;
        browser.press("#preview", "Discard").await;
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[tokio::test(flavor = "multi_thread")]
async fn nothing_serious_at_a_desk() {
    every_tab(Screen::Desktop).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn nothing_serious_on_a_phone() {
    every_tab(Screen::Phone).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_touched_is_as_large_as_a_finger() {
    let site = TestSite::example("clinic").built();
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#map?start=dock&goal=ward%2012"), Screen::Phone).await;
    browser.says("#route", "walk").await;
    let small = "[...document.querySelectorAll('button, nav a, select, input, summary')].filter((e) => e.checkVisibility() \
        && e.getBoundingClientRect().height < 43.5).map((e) => e.outerHTML.slice(0, 100) + ' ' + e.getBoundingClientRect().height)";
    let small = browser.value(small).await;
    assert!(small.as_array().unwrap().is_empty(), "{small:#}");
}

/// The grids of decision tables, with all that may be amiss marked, and the classes beside the editor.
#[tokio::test(flavor = "multi_thread")]
async fn nothing_serious_about_grids_and_classes() {
    let site = TestSite::example("shop").built();
    let service = Service::start(&site);
    let (axe, mut all) = (axe(), Vec::new());
    for screen in [Screen::Desktop, Screen::Phone] {
        let browser = Browser::open(&service.page("#rules?file=orders.rhai"), screen).await;
        for theme in ["light", "dark"] {
            browser.run(&format!("localStorage.setItem('adit-theme', '{theme}'); location.reload()")).await;
            browser.says("#rules-tables", "order.goods").await;
            browser
                .run("const area = document.querySelector('#rules textarea'); area.value = area.value.replace('\"discount\" first', '\"discount\" unique').replace('at_least(100.0)', 'at_least(120.0)').replace('between(50.0', 'between(40.0'); area.dispatchEvent(new Event('input', { bubbles: true }))")
                .await;
            browser.says("#rules-tables .amiss", "overlaps").await;
            browser.click("#vocabulary summary").await;
            browser.type_into("#vocabulary input", "price").await;
            browser.says(".vocabulary", "price").await;
            browser.run("document.getElementById('rules-tables').scrollIntoView()").await;
            browser.screenshot(&format!("{screen:?}-{theme}-grids").to_lowercase()).await;
            for found in violations(&browser, &axe).await {
                all.push(format!("{screen:?} {theme}: {found}"));
            }
            let wide = browser.value("document.documentElement.scrollWidth - innerWidth").await;
            if wide.as_f64().unwrap() > 0.0 {
                all.push(format!("{screen:?} {theme}: {wide} pixels too wide"));
            }
            browser.press("#preview", "Discard").await;
        }
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}
