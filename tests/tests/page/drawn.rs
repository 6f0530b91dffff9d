//! Maps that are not cut into rooms, on the page: drawn, tuned beside the picture, asked why.

use std::path::Path;

use adit_tests::TestSite;
use adit_tests::browser::{Browser, Screen};
use adit_tests::service::Service;

/// A site of a world of channels.
fn site_of(world: &str) -> TestSite {
    let site = TestSite::empty();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds").join(world);
    site.write(world, std::fs::read(file).unwrap());
    site.write("site.toml", format!("name = \"halls\"\nmap = \"{world}\"\n"));
    site.built()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_corridor_is_closed_beside_its_picture_and_the_way_is_drawn_anew() {
    let site = site_of("corridors.toml");
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#map"), Screen::Desktop).await;
    browser.find("#picture svg path").await;
    browser.says("#route-card", "junction 3").await;
    let drawn = "document.querySelector('#picture svg').outerHTML";
    browser.run(&format!("window.before = {drawn}")).await;
    browser.screenshot("corridors").await;
    browser.run("document.querySelector(\"[data-table='channels']\").open = true").await;
    let choose = "const choice = document.querySelector(\"[data-table='channels'] [data-key='2'] select\");
         choice.value = 'true';
         for (const kind of ['input', 'change']) choice.dispatchEvent(new Event(kind, { bubbles: true }));";
    browser.run(choose).await;
    browser.says("#preview-summary", "2 become dearer").await;
    browser.screenshot("corridors-preview").await;
    browser.click("#save").await;
    browser.says("#saved", "Saved").await;
    browser.says("#route-card", "channel 4").await;
    browser.until(&format!("{drawn} !== window.before"), "the way drawn anew").await;
    assert_eq!(site.sqlite3("SELECT closed FROM channels WHERE channel = 2"), ["1"]);
    browser.click("#undo").await;
    browser.press("dialog", "Take it back").await;
    browser.says("#route-card", "channel 2").await;
    let why = "[...document.querySelectorAll('#route-card button')].find((one) => one.ariaLabel?.startsWith('Why turn')).click()";
    browser.run(why).await;
    browser.says("#why-card", "Lee, Table 2").await;
    browser.screenshot("corridors-why").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_part_is_drawn_on_its_way_out_and_in() {
    let site = site_of("part.toml");
    let service = Service::start(&site);
    let browser =
        Browser::open(&service.page("#map?start=disassembled&goal=assembled"), Screen::Desktop).await;
    browser.find("#picture svg rect").await;
    browser.says("#route-card", "junction 1").await;
    browser.says("#picture", "disassembled to assembled").await;
    browser.screenshot("part").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_arm_and_a_flat_are_drawn() {
    let site = site_of("cell.toml");
    let service = Service::start(&site);
    let browser = Browser::open(&service.page("#map?start=load&goal=unload"), Screen::Desktop).await;
    browser.find("#picture svg polygon, #picture svg path").await;
    browser.says("#route-card", "to unload").await;
    browser.screenshot("cell").await;
    let flat = TestSite::empty();
    let world = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kb/worlds");
    for file in ["flat.toml", "flat.json"] {
        flat.write(file, std::fs::read(world.join(file)).unwrap());
    }
    flat.write("site.toml", "name = \"flat\"\nmap = \"flat.toml\"\n");
    let flat = flat.built();
    let service = Service::start(&flat);
    let browser = Browser::open(&service.page("#map?start=bed&goal=bath"), Screen::Phone).await;
    browser.says("#route-card", "region 1").await;
    let legs = "[...document.querySelectorAll('#route .run')].map((leg) => leg.innerText).join()";
    let legs = browser.value(legs).await;
    assert!(!legs.as_str().unwrap().contains("0.0 m"), "a doorway as thin as a line is no leg: {legs}");
    browser.screenshot("flat").await;
}
