//! Asking: a value is found out question by question, and only what it needs is weighed.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::io::Write as _;
use std::process::{Command, Stdio};

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::json;

const RULES: &str = r#"property CARS.starts from ask "Does {car} start?"
property CARS.lights from ask "Do the lights of {car} burn?"
property CARS.fuel from ask "How many litres are in the tank of {car}?"
property CARS.smell from ask "Does {car} smell of petrol?"

rule "no current" each car in CARS where !car.starts && !car.lights then { car.fault = "battery"; }
rule "flooded" each car in CARS where !car.starts && car.lights && car.smell then { car.fault = "flooded"; }
rule "no fuel" each car in CARS where !car.starts && car.lights && car.fuel < 1 then { car.fault = "tank"; }
rule "who mends it" each car in CARS some shop in SHOPS where shop.mends == car.fault then { car.shop = shop.shop; }
"#;

fn garage(cars: usize) -> TestSite {
    let site = TestSite::empty();
    for folder in ["rules", "tables"] {
        std::fs::create_dir_all(site.path().join(folder)).unwrap();
    }
    site.write("site.toml", "name = \"garage\"\nrooms = \"none\"\n");
    site.write("rules/cars.rhai", RULES);
    let rows: Vec<String> = (1..=cars).map(|car| format!("car {car},1999\n")).collect();
    site.write("tables/cars.csv", format!("car,year\n{}", rows.concat()));
    site.write("tables/shops.csv", "shop,mends\nVolt,battery\nOil,tank\n");
    site.built()
}

/// `adit ask` with somebody who types.
fn typed(site: &TestSite, arguments: &[&str], lines: &str) -> Ran {
    let mut child = Command::new(adit())
        .arg("ask")
        .arg(site.path())
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
    Ran::new(&child.wait_with_output().unwrap())
}

#[test]
fn three_questions_one_of_them_unknown_settle_it_and_the_conclusion_is_explained() {
    let site = garage(20);
    let said = typed(&site, &["cars.car 7.shop"], "no\nyes\n\n0.5\n").expecting(0).stdout;
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(
        lines[..4],
        [
            "Does car 7 start? (nothing: not known)",
            "Do the lights of car 7 burn? (nothing: not known)",
            "Does car 7 smell of petrol? (nothing: not known)",
            "How many litres are in the tank of car 7? (nothing: not known)",
        ],
        "{said}"
    );
    for part in [
        "shop is Oil, by rule \"who mends it\"",
        "fault is tank, by rule \"no fuel\"",
        "fuel is 0.5, as told",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"], "nothing is kept of the answers");
}

#[test]
fn what_was_answered_beforehand_is_not_asked_and_what_cannot_be_is_asked_again() {
    let site = garage(3);
    let beforehand =
        ["cars.car 1.shop", "--answer", "cars.car 1.starts=no", "--answer", "cars.car 1.lights=yes"];
    let said = typed(&site, &beforehand, "no\nmuch\n3\n").expecting(1);
    assert!(!said.stdout.contains("Does car 1 start"), "{}", said.stdout);
    assert!(said.stdout.contains("nothing that can be asked would settle it"), "{}", said.stdout);
    let unknown = typed(&site, &["cars.car 1.shop"], &"\n".repeat(9)).expecting(1).stdout;
    assert!(
        unknown.contains("cars.car 1.shop is unknown as long as this is: cars.car 1.starts"),
        "{unknown}"
    );
    let open = typed(&site, &["cars.car 1.shop"], "no\n").expecting(1).stdout;
    assert!(open.contains("cars.car 1.shop is not settled: Do the lights of car 1 burn?"), "{open}");
    let json = typed(&site, &["cars.car 1.shop", "--json"], "").expecting(1).json();
    assert_eq!(json["question"]["what"], "cars.car 1.starts");
    for (what, complaint) in [
        ("cars.car 1", "names no property"),
        ("carts.car 1.shop", "there is no class CARTS"),
        ("cars.car 99.shop", "car 99"),
        ("cars.car 1.shp", "CARS has no property shp"),
    ] {
        typed(&site, &[what], "").expecting(2).complains(&[complaint]);
    }
}

#[test]
fn what_is_told_of_the_answers_holds_until_it_ends() {
    let site = garage(3);
    typed(&site, &["cars.car 2.shop", "--tell", "--until", "2h"], "no\nno\n").expect_status(0);
    assert_eq!(
        site.sqlite3("SELECT value FROM conclusions WHERE object = 'cars.car 2' AND property = 'shop'"),
        ["Volt"]
    );
    assert_eq!(site.sqlite3("SELECT count(*) FROM told WHERE until IS NOT NULL"), ["2"]);
    // another one is still to be asked
    let said = typed(&site, &["cars.car 3.shop"], "").expecting(1).stdout;
    assert!(said.contains("Does car 3 start?"), "{said}");
}

#[test]
fn of_very_many_objects_only_those_are_weighed_that_a_question_needs() {
    let site = garage(20_000);
    let service = Service::start(&site);
    let answers = json!([{"what": "cars.car 9000.starts", "value": false}, {"what": "cars.car 9000.lights", "value": false}]);
    let asked =
        service.ask("POST", "/api/ask", Some(&json!({"what": "cars.car 9000.shop", "answers": answers}))).1;
    assert_eq!((&asked["status"], &asked["value"]), (&json!("known"), &json!("Volt")), "{asked:#}");
    assert!(asked["weighed"].as_u64().unwrap() <= 10, "{asked:#}");
    let next = service.ask("POST", "/api/ask", Some(&json!({"what": "cars.car 9000.shop"}))).1;
    assert_eq!(next["question"]["text"], "Does car 9000 start?");
    service.end();
}

#[test]
fn what_nothing_settles_says_what_is_missing() {
    let rule = "rule \"gait\"\n    each b in FLOORS\n    then { b.gait = if b.hard > 2.0 { \"crawl\" } else { \"walk\" }; }\n";
    let site = TestSite::example("shop").with("tables/floors.csv", "floor,hard\ngravel,3\ntiles,\n");
    let site = site.with("rules/gait.rhai", rule).built();
    let why = site.adit("why", &["floors.tiles.gait"]).expecting(0).stdout;
    assert!(
        why.contains("gait is unknown, by rule \"gait\"") && why.contains("nothing says its hard"),
        "{why}"
    );
    let asked = site.adit("ask", &["floors.tiles.gait"]).expecting(1).stdout;
    assert!(
        asked.contains("nothing that can be asked would settle it") && asked.contains("its hard"),
        "{asked}"
    );
    // what a table holds is not concluded, and is an answer all the same
    let why = site.adit("why", &["floors.gravel.hard"]).expecting(0).stdout;
    assert_eq!(why.trim(), "floors gravel hard is 3, as the table floors has it");
}
