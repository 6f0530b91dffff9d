//! A site of tables and rules alone.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::process::Command;

use adit_tests::service::Service;
use adit_tests::{Ran, TestSite, adit};
use serde_json::json;

/// The shop of `adit new --no-map`, built.
fn shop() -> TestSite {
    let site = TestSite::empty();
    let folder = site.path().join("new");
    let made = Command::new(adit()).args(["new", "--no-map"]).arg(&folder).output().unwrap();
    Ran::new(&made).expect_status(0);
    for file in [
        "site.toml",
        "tables/customers.csv",
        "tables/products.csv",
        "tables/orders.csv",
        "tables/zones.csv",
        "rules/orders.rhai",
        "rules/tests/orders.toml",
    ] {
        site.write(file, std::fs::read(folder.join(file)).unwrap());
    }
    site
}

const TOTALS: &str =
    "SELECT object, round(value, 2) FROM conclusions WHERE property = 'total' ORDER BY object";

#[test]
fn what_rules_conclude_of_tables_is_one_query_away() {
    let site = shop();
    let built = site.adit("build", &[]).expecting(0);
    assert!(built.stdout.contains("values concluded (generation 1)"), "{}", built.stdout);
    let rows = site.sqlite3(TOTALS);
    // 39.90 less 5 %, and 7 to the UK; 12 teas at 10 % off, and 4 within Germany
    assert!(rows.contains(&"orders.1|44.91".to_owned()), "{rows:?}");
    assert!(rows.contains(&"orders.2|49.36".to_owned()), "{rows:?}");
    assert_eq!(rows.len(), 5);
    let late = "SELECT object FROM conclusions WHERE property = 'goes_out' AND NOT value";
    assert_eq!(site.sqlite3(late), ["orders.3"], "there are no cups");
    site.adit("test", &[]).expect_status(0);
    site.adit("check", &[]).expect_status(0);
    let why = site.adit("why", &["orders.2.total"]).expecting(0).stdout;
    assert!(why.contains("what an order costs"), "{why}");
}

#[test]
fn a_cell_that_is_tuned_says_what_follows_and_is_undone() {
    let site = shop().built();
    let before = site.sqlite3(TOTALS);
    let tuned = site.adit("tune", &["products", "tea", "price", "5"]).expecting(0).stdout;
    assert!(tuned.contains("orders 2: total 49.36 → 58"), "{tuned}");
    assert!(!tuned.contains("room") && !tuned.contains("door") && !tuned.contains("route"), "{tuned}");
    assert_ne!(site.sqlite3(TOTALS), before);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3(TOTALS), before);
    site.adit("tell", &["CUSTOMERS", "Dara", "club", "true"]).expect_status(0);
    let json =
        site.adit("tune", &["customers", "Bruno", "club", "true", "--dry-run", "--json"]).expecting(0).json();
    assert!(json.to_string().contains("conclusions"), "{json}");
}

#[test]
fn a_file_seeds_its_table_once() {
    let site = shop().built();
    site.edit("tables/products.csv", "tea,4.20", "tea,9.99");
    let said = site.adit("build", &[]).expecting(0);
    let said = format!("{}{}", said.stdout, said.stderr);
    assert!(said.contains("differs from the table products"), "{said}");
    let price = "SELECT price FROM products WHERE product = 'tea'";
    assert_eq!(site.sqlite3(price), ["4.2"]);
    site.adit("build", &["--reseed"]).expect_status(0);
    assert_eq!(site.sqlite3(price), ["9.99"]);
}

#[test]
fn a_site_with_a_map_takes_tables_too() {
    let site = TestSite::example("paper")
        .with("tables/lamps.csv", "lamp,watts\nnorth,40\nsouth,60\n")
        .with(
            "rules/lamps.rhai",
            "rule \"warm\" each lamp in LAMPS then { lamp.warm = lamp.watts > 50.0; }\n",
        )
        .built();
    let warm = "SELECT object FROM conclusions WHERE property = 'warm' AND value";
    assert_eq!(site.sqlite3(warm), ["lamps.south"]);
}

#[test]
fn files_that_are_no_tables_are_refused_with_their_place() {
    for (file, text, words) in [
        ("tables/a.csv", "", "it is empty"),
        ("tables/a.csv", "lamp,watts\nnorth\n", "this row has 1 cell, expected 2"),
        ("tables/a.csv", "lamp,watts\nnorth,1\nnorth,2\n", "two rows are called north"),
        ("tables/a.csv", "lamp,watts\n1,4\n1.0,2\n", "two rows are called 1"),
        ("tables/Products.csv", "product,price\ntea,1\n", "is table `products`, and so is"),
        ("tables/a.csv", "lamp,watts\n,1\n", "this row has no `lamp`"),
        ("tables/a.csv", "lamp,lamp\n", "two columns are called `lamp`"),
        ("tables/a.csv", "lamp,two words\n", "`two words` is no name of a column"),
        ("tables/two words.csv", "lamp\n", "`two words` is no name of a table"),
        ("tables/robots.csv", "robot\nx\n", "the table robots is one of Adit's own"),
    ] {
        let site = shop().with(file, text);
        let ran = site.adit("build", &[]).expecting(2);
        ran.complains(&[words]);
        assert!(!site.path().join("site.db").exists(), "{file}: nothing is left half done");
    }
}

#[test]
fn what_needs_a_map_says_that_there_is_none() {
    let site = shop().built();
    site.adit("route", &["a", "b"]).expecting(2).complains(&[" has no map: it has tables and rules"]);
    site.write("site.toml", format!("{}map = \"map.toml\"\n", site.read("site.toml")));
    site.adit("build", &[]).expecting(2).complains(&["`map` is not a key of site.toml"]);
}

#[test]
fn it_is_served() {
    let site = shop().built();
    let service = Service::start(&site);
    let (status, tables) = service.ask("GET", "/api/tables", None);
    assert_eq!(status, 200, "{tables}");
    assert!(
        tables["tables"].as_array().unwrap().iter().any(|table| table["table"] == "products"),
        "{tables}"
    );
    let edit =
        json!({"edit": {"kind": "set", "table": "products", "key": "tea", "column": "price", "value": 5}});
    assert_eq!(service.ask("POST", "/api/edits", Some(&edit)).0, 200);
    let query = json!({"query": "SELECT round(value) FROM conclusions WHERE object = 'orders.2' AND property = 'total'"});
    let (status, rows) = service.ask("POST", "/api/sql", Some(&query));
    assert_eq!((status, &rows["rows"][0][0]), (200, &json!(58.0)), "{rows}");
    let (status, why) = service.ask("GET", "/api/why?what=orders.2.total", None);
    assert_eq!(status, 200, "{why}");
    let (status, route) = service.ask("GET", "/api/route?start=a&goal=b", None);
    assert!(status >= 400 && route["error"]["message"].is_string(), "{route}");
}

#[test]
fn a_cell_that_names_a_row_of_another_table_that_is_not_there_is_noted() {
    let site = shop();
    site.edit("tables/orders.csv", "Bruno", "Brunno");
    let said = "ORDERS 2 has customer \"Brunno\", and CUSTOMERS has no such row: did you mean \"Bruno\"?";
    for verb in ["build", "check"] {
        let ran = site.adit(verb, &[]);
        let words = format!("{}{}", ran.stdout, ran.stderr).replace("\n  │ ", " ");
        assert!(words.contains(said), "{words}");
    }
    let add = ["orders", "9", "--add", "customer=Ada", "product=teaa", "pieces=2"];
    let added = site.adit("tune", &add).expecting(0).stderr;
    assert!(added.contains("ORDERS 9 has product \"teaa\", and PRODUCTS has no such row"), "{added}");
    site.adit("tune", &["orders", "2", "customer", "Bruno"]).expect_status(0);
    let mended = site.adit("tune", &["orders", "9", "product", "tea"]).expecting(0).stderr;
    assert_eq!(mended, "");
}

#[test]
fn tests_of_rules_run_before_anything_is_built() {
    let site = shop();
    let tested = site.adit("test", &[]).expecting(0).stdout;
    assert!(tested.contains("1 test, which holds"), "{tested}");
}

#[test]
fn a_build_says_what_rules_told_and_conclude_otherwise() {
    let site = shop().built();
    let rule = |factor: &str| {
        format!("rule \"twice\" each p in PRODUCTS then {{ p.price2 = p.price * {factor}; }}\n")
    };
    site.write("rules/twice.rhai", rule("2.0"));
    let built = site.adit("build", &["--json"]).expecting(0).json();
    let conclusions = built["conclusions"].as_array().unwrap();
    assert!(conclusions.iter().all(|of| of["property"] == "price2" && of["old"].is_null()), "{built}");
    site.write("rules/twice.rhai", rule("3.0"));
    let built = site.adit("build", &["--json"]).expecting(0).json();
    let conclusions = built["conclusions"].as_array().unwrap();
    assert!(!conclusions.is_empty() && conclusions.iter().all(|of| !of["old"].is_null()), "{built}");
    site.write(
        "rules/sell.rhai",
        "on \"sell\" each p in PRODUCTS where p.stock > 100 then { p.stock = 90; }\n",
    );
    let built = site.adit("build", &[]).expecting(0).stdout;
    assert!(built.contains("sell") && built.contains("→ 90"), "{built}");
}

#[test]
fn a_rule_that_says_several_things_of_one_object_is_said_to_take_them_from_several() {
    let rule = "rule \"fee\" each o in ORDERS each z in ZONES where z.country == o.customer.country\n\
        \x20   then { o.fee = z.fee; }\n";
    let site = shop().with("rules/fee.rhai", rule).built();
    let why = site.adit("why", &["orders.1.fee"]).expecting(0).stdout;
    let said = ["since one rule says several things", "`least` or `most` in place of `each`"];
    assert!(said.iter().all(|words| why.contains(words)) && !why.contains("priority"), "{why}");
}

/// In a test as in the database: what rules tell objects of has numbered rows.
#[test]
fn what_a_reaction_orders_again_is_tested_as_it_is_told() {
    let rules = "on \"low stock\" each p in PRODUCTS where p.stock < 5 then { tell(\"REORDER\", #{ product: p.product, pieces: 50 }); }\n\
                 rule \"urgent\" each r in REORDER then { r.urgent = r.pieces > 40.0; }\n";
    let test = "[given]\nPRODUCTS = [{ product = \"kettle\", price = 40.0, grams = 1200.0, stock = 1 }]\n\
                [[test]]\nname = \"what runs out is ordered again\"\n[test.conclude]\nREORDER.1 = { urgent = true }\n";
    let site = shop().with("rules/reorder.rhai", rules).with("rules/tests/reorder.toml", test).built();
    site.adit("test", &[]).expect_status(0);
    let urgent = "SELECT object, value FROM conclusions WHERE property = 'urgent'";
    assert!(site.sqlite3(urgent).contains(&"reorder.1|1".to_owned()), "{:?}", site.sqlite3(urgent));
    site.write("rules/tests/reorder.toml", test.replace("urgent = true", "urgent = false"));
    site.adit("test", &[]).expect_status(1);
}
