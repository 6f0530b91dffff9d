//! A vehicle that others wrote drives the depot's routes.

use std::time::Duration;

use adit_tests::within;
use serde_json::{Value, json};

use adit_fleet::site::Fleet;
use adit_tests::adit;
use adit_tests::service::Service;

use crate::yard::{Broker, FleetProgram, Vehicle, cell, close, depot, keep, send};

const CART: &str = "vehicle,manufacturer,robot,goal,doing\ncart-1,acme,cart,,\n";

/// Whether a node of the order in which it is has such an id.
fn has_node(state: &Value, of: &str) -> bool {
    state["nodeStates"]
        .as_array()
        .unwrap()
        .iter()
        .any(|node| node["nodeId"].as_str().unwrap().starts_with(of))
}

#[test]
fn a_vehicle_drives_to_its_goal_and_its_goal_is_taken_out_of_the_table() {
    for version in ["2.0.0", "2.1.0"] {
        let broker = Broker::start();
        let (_site, service) = depot(CART, "");
        let program = FleetProgram::start(&service, &broker);
        let mut cart = Vehicle::start(&broker, version, "cart-1", [2.0, 6.0, 6.0]);
        send(&service, "cart-1", "gate");
        let seen = within("it is seen on its way", || {
            let (_, answer) = service.ask("GET", "/api/whereabouts", None);
            let cart = answer["robots"].as_array()?.iter().find(|robot| robot["name"] == "cart-1")?.clone();
            let is_on_its_way =
                cart["x"].as_f64()? > 3.0 && cart["way"]["goal"] == "gate" && cart["doing"] != Value::Null;
            is_on_its_way.then_some(cart)
        });
        assert_eq!((&seen["robot"], &seen["who"]), (&json!("cart"), &json!("http")), "{seen}");
        assert!(seen["way"]["told"][0]["words"].as_str().unwrap().starts_with("the way costs"), "{seen}");
        cart.arrives("gate");
        let position = &cart.state["agvPosition"];
        let at = [&position["x"], &position["y"]].map(|v| v.as_f64().unwrap().to_string());
        assert_eq!(at, ["22", "6"], "{}", program.log());
        within("the goal is reached", || (cell(&service, "cart-1", "goal") == Value::Null).then_some(()));
        within("it is said", || (cell(&service, "cart-1", "doing") == "at gate").then_some(()));
        assert_eq!(cart.state["errors"], json!([]));
    }
}

#[test]
fn a_doorway_closed_beyond_the_base_changes_the_order_before_the_vehicle_gets_there() {
    for version in ["2.0.0", "2.1.0"] {
        let broker = Broker::start();
        let (_site, service) = depot("vehicle,manufacturer,robot,goal\ncrawler-1,acme,crawler,\n", "");
        let program = FleetProgram::start(&service, &broker);
        let mut crawler = Vehicle::start(&broker, version, "crawler-1", [2.0, 6.0, 1.5]);
        send(&service, "crawler-1", "gate");
        let state = crawler.until("it has its order", |state| state["driving"] == true);
        assert!(has_node(&state, "doorway 2"), "{state:#}");
        let order = state["orderId"].clone();
        close(&service, "doorway 2");
        let state = crawler.until("it goes another way", |state| has_node(state, "doorway 3"));
        assert_eq!(state["orderId"], order, "the same order goes on");
        assert!(state["orderUpdateId"].as_u64().unwrap() > 0);
        assert!(!has_node(&state, "doorway 2"), "{state:#}");
        assert!(state["agvPosition"]["x"].as_f64().unwrap() < 11.0, "it has not got there: {state:#}");
        crawler.arrives("gate");
        assert_eq!(crawler.state["orderId"], order, "{}", program.log());
        assert_eq!(crawler.state["errors"], json!([]));
    }
}

#[test]
fn a_doorway_closed_in_the_base_stops_the_vehicle_and_it_goes_another_way() {
    let broker = Broker::start();
    let (_site, service) = depot("vehicle,manufacturer,robot,goal\ncrawler-1,acme,crawler,\n", "");
    let program = FleetProgram::start(&service, &broker);
    let mut crawler = Vehicle::start(&broker, "2.0.0", "crawler-1", [8.5, 6.7, 0.5]);
    send(&service, "crawler-1", "gate");
    let released =
        |state: &Value| {
            state["nodeStates"].as_array().unwrap().iter().any(|node| {
                node["nodeId"].as_str().unwrap().starts_with("doorway 2") && node["released"] == true
            })
        };
    let before =
        crawler.until("the doorway is released", |state| released(state) && state["driving"] == true);
    close(&service, "doorway 2");
    let stopped =
        crawler.until("it stops", |state| state["nodeStates"] == json!([]) && state["driving"] == false);
    assert!(stopped["agvPosition"]["x"].as_f64().unwrap() < 11.9, "{stopped:#}");
    let after = crawler.until("it has another order", |state| has_node(state, "doorway 3"));
    assert_ne!(after["orderId"], before["orderId"]);
    assert!(program.log().contains("crawler-1 stops: the way ahead is closed"), "{}", program.log());
}

#[test]
fn a_broker_that_is_killed_and_comes_back_loses_nothing() {
    let mut broker = Broker::start();
    let (_site, service) = depot(CART, "");
    let program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [2.0, 6.0, 2.0]);
    send(&service, "cart-1", "gate");
    cart.until("it drives", |state| state["driving"] == true);
    broker.kill();
    within("it is noticed", || program.log().contains("the broker is away").then_some(()));
    // what is said meanwhile counts
    close(&service, "doorway 2");
    send(&service, "cart-1", "shelf");
    broker.again();
    cart.arrives("shelf");
    within("the goal is reached", || (cell(&service, "cart-1", "goal") == Value::Null).then_some(()));
}

#[test]
fn a_vehicle_that_reports_an_obstacle_closes_the_way_ahead_for_its_kind_and_goes_another() {
    let broker = Broker::start();
    let (site, service) = depot("vehicle,manufacturer,robot,goal,errors\ncrawler-1,acme,crawler,,\n", "");
    let program = FleetProgram::start(&service, &broker);
    let mut crawler = Vehicle::start(&broker, "2.0.0", "crawler-1", [10.5, 6.0, 0.5]);
    let of_dog = "/api/route?start=10.5,6&goal=gate&robot=dog";
    let dog = service.ask("GET", of_dog, None).1["cost"].clone();
    send(&service, "crawler-1", "gate");
    crawler.until("it drives", |state| state["driving"] == true);
    crawler.tell("obstacle");
    crawler.until("it goes another way", |state| has_node(state, "doorway 3"));
    let log = program.log();
    assert!(
        log.contains("crawler-1 reports obstacle [WARNING]: a pallet: the way ahead is closed for 120 s"),
        "{log}"
    );
    assert_eq!(service.ask("GET", of_dog, None).1["cost"], dog, "for crawlers only");
    let why = site.sqlite3("SELECT DISTINCT why FROM facts_told");
    assert!(why[0].contains("crawler-1 reports obstacle"), "{why:?}");
    let noted = site.sqlite3("SELECT count(*) > 0 FROM history WHERE column_name = 'errors'");
    assert_eq!(noted, ["1"]);
}

#[test]
fn nothing_is_released_to_a_vehicle_that_does_not_know_where_it_is() {
    let broker = Broker::start();
    let (_site, service) = depot(CART, "");
    let _program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [2.0, 6.0, 2.0]);
    cart.until("it is there", |_| true);
    cart.tell("lost");
    cart.until("it is lost", |state| state["agvPosition"]["positionInitialized"] == false);
    send(&service, "cart-1", "gate");
    within("it is said", || {
        (cell(&service, "cart-1", "doing") == "waits: it does not know where it is").then_some(())
    });
    assert_eq!(cart.state["orderId"], "");
}

#[test]
fn a_vehicle_that_vanishes_is_known_to_be_gone_and_drives_on_when_it_is_back() {
    let broker = Broker::start();
    let (_site, service) = depot("vehicle,manufacturer,robot,goal,connection\ncart-1,acme,cart,,\n", "");
    let _program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [2.0, 6.0, 2.0]);
    send(&service, "cart-1", "gate");
    cart.until("it drives", |state| state["driving"] == true);
    cart.tell("vanish");
    within("it is gone", || (cell(&service, "cart-1", "connection") == "connection broken").then_some(()));
    // switched on again where it was: it has forgotten its order
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [6.0, 8.0, 6.0]);
    cart.arrives("gate");
}

#[test]
fn a_rule_says_what_a_vehicle_does_to_change_its_shape_and_how_fast_it_drives() {
    let rules = r#"rule "the dog's side-step is an action of the vehicle"
    each state in ROBOTS where state.state == "SIDE-STEP"
    then { state.vehicle_action = "noop"; state.vehicle_blocking = "HARD"; state.speed = 3.0; }
"#;
    let broker = Broker::start();
    let (_site, service) = depot("vehicle,manufacturer,robot,goal\ndog-1,acme,dog,shelf\n", rules);
    let (_client, orders) = broker.client(&["uagv/v2/acme/dog-1/order"]);
    let _program = FleetProgram::start(&service, &broker);
    let _dog = Vehicle::start(&broker, "2.1.0", "dog-1", [9.0, 1.2, 6.0]);
    let (_, order) = orders.recv_timeout(Duration::from_secs(20)).expect("an order");
    let nodes = order["nodes"].as_array().unwrap();
    let actions: Vec<&Value> = nodes.iter().flat_map(|node| node["actions"].as_array().unwrap()).collect();
    assert_eq!(actions[0]["actionType"], "noop", "{order:#}");
    assert_eq!(actions[0]["blockingType"], "HARD");
    assert_eq!(actions[0]["actionParameters"][0], json!({"key": "state", "value": "SIDE-STEP"}));
    let edges = order["edges"].as_array().unwrap();
    assert!(edges.iter().any(|edge| edge["maxSpeed"] == 3.0), "{order:#}");
}

#[test]
fn a_vehicle_that_is_wider_than_its_robot_gets_no_order() {
    let broker = Broker::start();
    let (_site, service) = depot(CART, "");
    let factsheet =
        json!({"version": "2.1.0", "physicalParameters": {"width": 1.3, "length": 1.0, "heightMax": 1.0}});
    keep(&broker, "uagv/v2/acme/cart-1/factsheet", &factsheet);
    let _program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.1.0", "cart-1", [2.0, 6.0, 6.0]);
    send(&service, "cart-1", "gate");
    let words = "waits: by its factsheet it is 1.3 m wide, robot cart at most 1.1 m";
    within("it is said", || (cell(&service, "cart-1", "doing") == words).then_some(()));
    cart.until("it says so", |_| true);
    assert_eq!(cart.state["orderId"], "");
}

#[test]
fn a_way_that_vanishes_stops_the_vehicle_and_it_drives_on_when_there_is_one_again() {
    let broker = Broker::start();
    let (_site, service) = depot(CART, "");
    let program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.1.0", "cart-1", [2.0, 6.0, 1.5]);
    send(&service, "cart-1", "gate");
    cart.until("it drives", |state| state["driving"] == true);
    // the only doorway that is wide enough for it
    close(&service, "doorway 3");
    cart.until("it stops", |state| state["nodeStates"] == json!([]) && state["driving"] == false);
    within("it is said why", || {
        let doing = cell(&service, "cart-1", "doing");
        doing.as_str().is_some_and(|doing| doing.starts_with("no way to gate: ")).then_some(())
    });
    let edit = json!({"edit": {"kind": "open", "what": "doorway 3"}});
    assert_eq!(service.ask("POST", "/api/edits", Some(&edit)).0, 200);
    cart.until("it drives on", |state| has_node(state, "doorway 3") && state["driving"] == true);
    assert!(program.log().contains("cart-1 stops: "), "{}", program.log());
}

#[test]
fn a_goal_that_nobody_knows_is_said_and_another_is_driven_to() {
    let broker = Broker::start();
    let (_site, service) = depot(CART, "");
    let _program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [9.0, 3.0, 6.0]);
    send(&service, "cart-1", "chargr");
    within("it is said", || {
        let doing = cell(&service, "cart-1", "doing");
        doing.as_str().is_some_and(|doing| doing.contains("did you mean `charger`")).then_some(())
    });
    send(&service, "cart-1", "charger");
    cart.arrives("charger");
}

#[test]
fn without_the_program_beside_it_adit_says_where_it_is_to_be_had() {
    let folder = tempfile::tempdir_in(adit().parent().unwrap()).unwrap();
    let lonely = folder.path().join("adit");
    std::fs::hard_link(adit(), &lonely).unwrap();
    let ran =
        adit_tests::Ran::new(&std::process::Command::new(lonely).args(["fleet", "--help"]).output().unwrap());
    ran.expecting(2).complains(&[
        "program/missing",
        "`adit-fleet` does not lie beside `adit`",
        "bridges/fleet",
    ]);
}

#[test]
fn what_cannot_be_a_site_or_a_broker_is_said_at_once() {
    let wrong = [
        (["fleet", "my-site", "--mqtt", "mqtt://127.0.0.1"], "`my-site` is no address of a served site"),
        (["fleet", "http://127.0.0.1:1", "--mqtt", "mqtt://127.0.0.1"], "the site's service does not answer"),
        (["fleet", "http://127.0.0.1:1", "--before", "-3"], "error"),
    ];
    let interfaces = ["a/#", "a/+/b", "/a", "a//b", "a/", ""];
    for interface in interfaces {
        let args = ["fleet", "http://127.0.0.1:1", "--mqtt", "mqtt://127.0.0.1", "--interface", interface];
        let ran = adit_tests::Ran::new(&std::process::Command::new(adit()).args(args).output().unwrap());
        ran.expecting(2)
            .complains(&[&format!("`--interface` is `{interface}`, with which no topic can begin")]);
    }
    for (args, words) in wrong {
        let ran = adit_tests::Ran::new(&std::process::Command::new(adit()).args(args).output().unwrap());
        ran.expecting(2).complains(&[words]);
    }
}

#[test]
fn a_service_that_is_killed_and_comes_back_loses_nothing() {
    let broker = Broker::start();
    let (site, service) = depot(CART, "");
    let program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [2.0, 6.0, 2.0]);
    send(&service, "cart-1", "gate");
    cart.until("it drives", |state| state["driving"] == true);
    let address = service.address.clone();
    service.kill();
    within("it is noticed", || program.log().contains("the site's service does not answer").then_some(()));
    let service = Service::start_on(&site, &address);
    cart.arrives("gate");
    within("the goal is reached", || (cell(&service, "cart-1", "goal") == Value::Null).then_some(()));
}

#[test]
fn rows_say_that_nobody_drives_the_vehicles_when_the_program_was_ended() {
    let broker = Broker::start();
    let (_site, service) = depot(
        "vehicle,manufacturer,robot,goal,doing,connection\ncart-1,acme,cart,,,\ncart-2,acme,cart,,,\n",
        "",
    );
    let program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [2.0, 6.0, 0.5]);
    send(&service, "cart-1", "gate");
    cart.until("it drives", |state| state["driving"] == true);
    within("it is said", || (cell(&service, "cart-1", "doing") == "drives to gate").then_some(()));
    let log = program.ends();
    for vehicle in ["cart-1", "cart-2"] {
        assert_eq!(cell(&service, vehicle, "doing"), "nobody drives it: adit fleet was ended", "{log}");
        assert_eq!(cell(&service, vehicle, "connection"), Value::Null);
    }
    assert_eq!(cell(&service, "cart-1", "goal"), "gate", "it is still to go there");
}

/// The blocks of the manual that are written in this language.
fn blocks(language: &str) -> Vec<String> {
    let manual = include_str!("../../README.md");
    let fence = format!("```{language}\n");
    manual.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

#[test]
fn the_table_and_the_rules_of_the_manual_do_what_it_says() {
    let (_site, service) = depot(&blocks("csv")[0], &blocks("rhai").join("\n"));
    let edit = json!({"kind": "set", "table": "vehicles", "key": "cart-1", "column": "battery", "value": 15});
    assert_eq!(service.ask("POST", "/api/edits", Some(&json!({"edit": edit}))).0, 200);
    assert_eq!(cell(&service, "cart-1", "goal"), "charger");
    let tables = Fleet::read(&service.ask("GET", "/api/tables", None).1).unwrap();
    let folded = tables.state("crawler", "FOLDED").unwrap();
    assert_eq!(folded.action.as_deref(), Some("foldMast"));
    assert_eq!(tables.meaning("blockedBy", "WARNING").closes_for, Some(120));
    assert!(tables.meaning("motor", "FATAL").stops);
}

#[test]
fn a_site_says_itself_what_errors_mean() {
    let site = adit_tests::TestSite::example("depot");
    std::fs::create_dir_all(site.path().join("tables")).unwrap();
    site.write("tables/vehicles.csv", CART);
    site.write("tables/vehicle_errors.csv", "error,closes_for,stops\npallet,30,\nmotor,,true\n");
    let site = site.built();
    let service = Service::start(&site);
    let tables = Fleet::read(&service.ask("GET", "/api/tables", None).1).unwrap();
    assert_eq!(tables.meaning("pallet", "WARNING").closes_for, Some(30));
    assert!(tables.meaning("motor", "WARNING").stops);
    assert!(!tables.meaning("other", "FATAL").stops, "its own table stands instead of ours");
}
