//! Rules that react, in sites: what they tell is kept, logged, explained and undone like any edit.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::json;

const REPORTS: &str = r#"property DOORWAYS.blocked from table, default false

on "a doorway that a robot found blocked is closed for an hour"
    each doorway in DOORWAYS where doorway.blocked
    then { doorway.closed = lasting(true, 3600); doorway.blocked = (); }
"#;

/// The depot, built, with rules of its own over the shipped ones.
fn depot(rules: &str) -> TestSite {
    let site = TestSite::example("depot");
    std::fs::create_dir_all(site.path().join("rules")).unwrap();
    site.write("rules/own.rhai", rules);
    site.built()
}

/// A doorway on the way from the dock to the shelf.
fn doorway_on_the_way(site: &TestSite) -> String {
    let on_the_way = "SELECT doorway FROM action_sequence WHERE robot = 'cart' AND start = 'dock' AND goal = 'shelf' \
                      AND doorway IS NOT NULL LIMIT 1";
    site.sqlite3(on_the_way).first().expect("a way through a doorway").clone()
}

#[test]
fn a_robot_that_reports_a_doorway_closes_it_for_an_hour() {
    let site = depot(REPORTS);
    let doorway = doorway_on_the_way(&site);
    let service = Service::start(&site);
    let question = "/api/route?start=dock&goal=shelf&robot=cart";
    let before = service.ask("GET", question, None).1;
    let mut events = service.events();
    let fact = json!({"class": "DOORWAYS", "object": doorway, "property": "blocked", "value": true, "why": "a pallet"});
    let told = service.ask("POST", "/api/facts", Some(&fact));
    assert_eq!(told.0, 200, "{told:?}");

    let passes = |route: &serde_json::Value| {
        route["steps"].as_array().unwrap().iter().any(|step| step["doorway"] == doorway.as_str())
    };
    assert!(passes(&before));
    let after = service.ask("GET", question, None).1;
    assert!(!passes(&after), "{after:#}");
    assert!(after["cost"].as_f64().unwrap_or(f64::INFINITY) > before["cost"].as_f64().unwrap());

    assert!(told.1["reacted"][0].as_str().unwrap().contains("closed = true until"), "{:#}", told.1);
    let said = events.next("changed");
    let what = said["what"].as_str().unwrap();
    assert!(
        what.contains("by rule \"a doorway that a robot found blocked is closed for an hour\""),
        "{what}"
    );

    let facts =
        site.sqlite3("SELECT property, value, who, (julianday(until) - julianday(at)) * 24 FROM facts_told");
    assert_eq!(facts.len(), 1, "the report is done with: {facts:?}");
    let parts: Vec<&str> = facts[0].split('|').collect();
    assert_eq!(parts[..2], ["closed", "true"]);
    assert_eq!(parts[2], "rule \"a doorway that a robot found blocked is closed for an hour\"");
    assert!((parts[3].parse::<f64>().unwrap() - 1.0).abs() < 0.01, "{facts:?}");

    // it is the newest edit, and taken back like any other; what was carried out does not come again
    let undone = service.ask("POST", "/api/edits", Some(&json!({"edit": {"kind": "undo"}}))).1;
    assert_eq!(service.ask("GET", question, None).1["cost"], before["cost"], "{undone:#}");
    service.end();
    assert_eq!(site.sqlite3("SELECT property FROM facts_told"), ["blocked"], "the report stands");
}

#[test]
fn what_was_carried_out_is_known_to_the_next_program_and_comes_again_when_it_is_met_again() {
    let site = depot(REPORTS);
    let doorway = doorway_on_the_way(&site);
    let report =
        |site: &TestSite| site.adit("tell", &["DOORWAYS", &doorway, "blocked", "true"]).expecting(0).stdout;
    let said = report(&site);
    assert!(said.contains("closed = true until"), "{said}");
    let why = site.adit("why", &[&doorway]).expecting(0).stdout;
    assert!(why.contains("told by rule \"a doorway that a robot found blocked"), "{why}");
    assert!(why.contains("blocked = true"), "{why}");
    for _ in 0..2 {
        site.adit("undo", &[]).expect_status(0);
    }
    assert_eq!(site.sqlite3("SELECT count(*) FROM facts_told"), ["0"], "what the rule told, and the report");
    site.adit("build", &[]).expect_status(0);
    report(&site);
    assert_eq!(
        site.sqlite3("SELECT count(*) FROM facts_told WHERE property = 'closed'"),
        ["1"],
        "it is met anew"
    );
}

#[test]
fn an_edit_that_is_taken_back_takes_back_what_rules_did_of_it() {
    let site = depot(REPORTS);
    let doorway = doorway_on_the_way(&site);
    site.adit("tell", &["DOORWAYS", &doorway, "blocked", "true"]).expect_status(0);
    let report = site.sqlite3("SELECT min(id) FROM history").remove(0);
    site.adit("undo", &[&report]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM facts_told"), ["0"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM history WHERE undone IS NOT NULL"), ["3"], "all of it");
}

const CHARGING: &str = r#"property ROUTES.charges from rule, default false

rule "a route that ends at a charger"
    each route in ROUTES
    some charger in CHARGERS where charger.place == route.goal
    then { route.charges = true; }

on "a cart below a fifth is sent to the nearest charger"
    each cart in CARTS where cart.battery < 0.2 && cart.errand == "work"
    least route in ROUTES by cost where route.robot == "cart" && route.start == cart.at && route.charges
    then { cart.goal = route.goal; cart.errand = "charge"; }
"#;

#[test]
fn a_battery_below_a_fifth_sends_the_cart_to_the_nearest_charger() {
    let site = TestSite::example("depot");
    for folder in ["rules", "tables"] {
        std::fs::create_dir_all(site.path().join(folder)).unwrap();
    }
    site.write("rules/own.rhai", CHARGING);
    site.write(
        "tables/carts.csv",
        "cart,at,battery,goal,errand\ncart 1,dock,0.9,shelf,work\ncart 2,gate,0.5,shelf,work\n",
    );
    site.write("tables/chargers.csv", "place\ncharger\ngate\n");
    let site = site.built();
    let costs = site.sqlite3(
        "SELECT goal FROM route WHERE robot = 'cart' AND start = 'dock' AND goal IN ('gate', 'charger') ORDER BY cost",
    );
    let service = Service::start(&site);
    let edit = json!({"kind": "set", "table": "carts", "key": "cart 1", "column": "battery", "value": 0.15});
    let preview = service.ask("POST", "/api/preview", Some(&json!({"edits": [edit]}))).1;
    assert!(preview["cells"].as_array().unwrap().iter().any(|cell| cell["column"] == "goal"), "{preview:#}");
    let done = service.ask("POST", "/api/edits", Some(&json!({"edit": edit})));
    assert_eq!(done.0, 200, "{done:?}");
    let row = site.sqlite3("SELECT goal, errand FROM carts WHERE cart = 'cart 1'");
    assert_eq!(row, [format!("{}|charge", costs[0])], "the nearest of {costs:?}");
    assert_eq!(site.sqlite3("SELECT goal, errand FROM carts WHERE cart = 'cart 2'"), ["shelf|work"]);
    let log =
        site.sqlite3("SELECT who, why FROM history WHERE table_name = 'carts' AND column_name = 'goal'");
    assert!(log[0].starts_with("rule \"a cart below a fifth"), "{log:?}");
    assert!(log[0].contains("battery = 0.15"), "{log:?}");
    service.end();
    let why = site.adit("why", &["carts.cart 1.goal"]).expecting(0).stdout;
    assert!(why.contains("goal is charger, told by rule \"a cart below a fifth"), "{why}");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT goal, errand FROM carts WHERE cart = 'cart 1'"), ["shelf|work"]);
    assert_eq!(
        site.sqlite3("SELECT battery FROM carts WHERE cart = 'cart 1'"),
        ["0.15"],
        "what was reported stands"
    );
}

#[test]
fn rules_that_fire_in_turn_are_named_and_the_edit_stands() {
    let site = depot(
        r#"property DOORWAYS.lamp from table, default 0
           on "on"  each doorway in DOORWAYS where doorway.lamp == 1 then { doorway.lamp = 2; }
           on "off" each doorway in DOORWAYS where doorway.lamp == 2 then { doorway.lamp = 1; }"#,
    );
    let doorway = doorway_on_the_way(&site);
    let told = site.adit("tell", &["DOORWAYS", &doorway, "lamp", "1"]).expecting(0);
    told.complains(&["rules \"on\" and \"off\" fire in turn", "nothing of this run was kept"]);
    assert_eq!(site.sqlite3("SELECT property, value, who != '' FROM facts_told"), ["lamp|1.0|1"]);
}

#[test]
fn a_rule_that_cannot_do_what_it_says_is_named_and_nothing_is_half_done() {
    let site = depot(
        r#"property DOORWAYS.lamp from table, default 0
           on "gone" each doorway in DOORWAYS where doorway.lamp == 1 then { doorway.lamp = 2; forget(doorway); }"#,
    );
    let doorway = doorway_on_the_way(&site);
    let told = site.adit("tell", &["DOORWAYS", &doorway, "lamp", "1"]).expecting(2);
    told.complains(&["rule \"gone\" cannot do what it says", "DOORWAYS is no table of the site's own"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM facts_told"), ["0"]);
}

#[test]
fn what_is_told_of_a_table_of_ones_own_is_taken_back_by_a_rule_like_anything_else() {
    let site = TestSite::example("depot");
    for folder in ["rules", "tables"] {
        std::fs::create_dir_all(site.path().join(folder)).unwrap();
    }
    site.write("tables/carts.csv", "cart,at,battery\ncart 1,dock,0.9\n");
    site.write(
        "rules/own.rhai",
        r#"property CARTS.stuck from table, default false
           on "a stuck cart is noted" each cart in CARTS where cart.stuck
           then { tell("NOTES", #{ cart: cart.cart }); cart.stuck = (); cart.at = "here"; }"#,
    );
    let site = site.built();
    // one cell is told, too: what the rule sets counts from then on
    site.adit("tell", &["CARTS", "cart 1", "at", "gate"]).expect_status(0);
    let told = site.adit("tell", &["CARTS", "cart 1", "stuck", "true"]).expecting(0).stdout;
    assert!(!told.contains("→ nothing"), "what is told is not what rules no longer say: {told}");
    assert_eq!(site.sqlite3("SELECT cart FROM notes"), ["cart 1"]);
    assert_eq!(site.sqlite3("SELECT at FROM carts"), ["here"]);
    assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"]);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT at FROM carts"), ["dock"]);
    assert_eq!(site.sqlite3("SELECT property FROM told ORDER BY id"), ["at", "stuck"]);
}

#[test]
fn check_says_of_a_rule_that_tells_for_ever_that_something_is_wrong_and_no_more() {
    let rule = "property ROOMS.spill from table, default 0.0;\n\
        on \"more\" each r in ROOMS where r.spill < 1000000.0 then { r.spill = r.spill + 1.0; }\n";
    let site = TestSite::example("paper").with("rules/more.rhai", rule);
    let checked = site.adit("check", &[]);
    checked.complains(&["rule \"more\" fires again and again", "more.rhai:2:4"]);
    assert!(checked.stdout.contains("something looks wrong"), "{}", checked.stdout);
    assert!(!checked.stderr.contains("does not hold"), "{}", checked.stderr);
}
