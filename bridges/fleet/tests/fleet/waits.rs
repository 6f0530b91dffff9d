//! What keeps a vehicle from driving is said, and nothing is sent to it meanwhile.

use adit_fleet::driver::Effect;
use adit_fleet::site::Vehicle;
use serde_json::json;

use crate::alone::Alone;

const WAY: [[f64; 2]; 2] = [[1.0, 1.0], [9.0, 1.0]];

/// Ways for a vehicle to be stopped, with what is said of it.
fn stops() -> Vec<(&'static str, serde_json::Value, &'static str)> {
    let manual = "waits: it is stopped by its emergency stop (MANUAL)";
    let remote = "waits: it is stopped by its emergency stop (REMOTE)";
    vec![
        ("safetyState", json!({"eStop": "MANUAL", "fieldViolation": false}), manual),
        ("safetyState", json!({"activeEmergencyStop": "REMOTE", "fieldViolation": false}), remote),
        ("paused", json!(true), "waits: it is paused"),
    ]
}

#[test]
fn a_vehicle_that_is_stopped_keeps_its_order_and_hears_of_no_other_until_it_is_released() {
    for (key, value, words) in stops() {
        let mut alone = Alone::new();
        alone.says();
        alone.led(&WAY);
        alone.says();
        alone.takes_its_order();
        alone.says();
        assert_eq!((alone.orders.len(), alone.doing.as_str()), (1, "drives to gate"));
        let free = std::mem::replace(&mut alone.state[key], value);
        alone.driver.read(Vehicle { goal: Some("shelf".to_owned()), ..alone.driver.row.clone() });
        for _ in 0..20 {
            alone.says();
        }
        alone.led(&[WAY[1], [9.0, 5.0]]);
        alone.says();
        assert_eq!((alone.orders.len(), alone.doing.as_str()), (1, words));
        alone.state[key] = free;
        alone.says();
        assert_eq!((alone.orders.len(), alone.doing.as_str()), (2, "drives to shelf"));
        assert_eq!(alone.orders[1]["orderId"], alone.orders[0]["orderId"], "the same order goes on");
    }
}

#[test]
fn a_vehicle_that_is_stopped_gets_no_order() {
    for (key, value, words) in stops() {
        let mut alone = Alone::new();
        let free = std::mem::replace(&mut alone.state[key], value);
        alone.says();
        assert_eq!((alone.follows, alone.doing.as_str()), (None, words));
        alone.state[key] = free;
        alone.says();
        alone.led(&WAY);
        alone.says();
        assert_eq!(alone.orders.len(), 1);
    }
}

#[test]
fn an_order_that_was_not_taken_is_not_said_again_to_a_vehicle_that_is_stopped() {
    for (key, value, words) in stops() {
        let mut alone = Alone::new();
        alone.says();
        alone.led(&WAY);
        alone.says();
        alone.state[key] = value;
        for _ in 0..20 {
            alone.says();
        }
        assert_eq!((alone.orders.len(), alone.doing.as_str()), (1, words));
    }
}

#[test]
fn a_vehicle_inside_of_a_wall_gets_no_order_and_one_that_is_parked_tightly_does() {
    // it is 0.7 m wide
    let mut alone = Alone::new();
    alone.says();
    alone.led(&[[1.4, 1.0], [9.0, 1.0]]);
    for _ in 0..3 {
        alone.says();
    }
    let words = "waits: it stands where it does not fit; the nearest point at which it does is 0.40 m away";
    assert_eq!((alone.orders.len(), alone.doing.as_str()), (0, words));
    // it is somewhere else by a little, and asks anew
    alone.state["agvPosition"]["x"] = json!(0.95);
    alone.says();
    alone.says();
    assert_eq!(alone.follows.map(|(_, start)| start[0].to_string()).unwrap(), "0.95");
    alone.led(&[[1.254, 1.0], [9.0, 1.0]]);
    alone.says();
    let start = &alone.orders[0]["nodes"][0]["nodePosition"];
    assert_eq!(start["allowedDeviationXY"], 0.31, "{start:#}");
}

#[test]
fn what_is_closed_lies_where_the_way_leads_and_not_where_its_first_step_does() {
    let headings = |way: &[[f64; 2]]| {
        let mut alone = Alone::new();
        alone.says();
        alone.led(way);
        alone.says();
        alone.takes_its_order();
        alone.says();
        alone.state["errors"] = json!([{"errorType": "blocked", "errorLevel": "WARNING"}]);
        let blocked = alone.says().into_iter().find_map(|effect| match effect {
            Effect::Block { heading, .. } => Some(heading),
            _ => None,
        });
        blocked.unwrap()
    };
    // a step of 4 cm to the east, then to the west
    let heading = headings(&[[1.0, 1.0], [1.04, 1.0], [0.9, 1.0], [-5.0, 1.0]]);
    assert!((heading - 180.0).abs() < 1e-6, "{heading}");
    // around a corner that is nearer than the vehicle is large
    let heading = headings(&[[1.0, 1.0], [1.1, 1.0], [1.1, 6.0]]);
    assert!((60.0..90.0).contains(&heading), "{heading}");
    // a way that is shorter
    let heading = headings(&[[1.0, 1.0], [1.0, 0.8]]);
    assert!((heading - 270.0).abs() < 1e-6, "{heading}");
}

#[test]
fn a_vehicle_that_reports_to_be_off_the_map_in_the_middle_of_its_order_hears_of_no_other() {
    let mut alone = Alone::new();
    alone.says();
    alone.led(&WAY);
    alone.says();
    alone.takes_its_order();
    alone.says();
    alone.driver.doubted();
    for x in [-50.0, -51.0, -52.0] {
        alone.state["agvPosition"]["x"] = json!(x);
        let effects = alone.says();
        assert!(!effects.iter().any(|effect| matches!(effect, Effect::Check { .. })), "{effects:?}");
        alone.led(&[WAY[1], [9.0, 5.0]]);
    }
    let words = "waits: it says that it is off the map, which goes from -20,-20 to 20,20";
    assert_eq!((alone.orders.len(), alone.doing.as_str()), (1, words));
    assert_eq!(alone.log, ["v says that it is at -50.00,1.00, off the map"], "once");
    alone.state["agvPosition"]["x"] = json!(1.0);
    alone.says();
    assert_eq!((alone.orders.len(), alone.doing.as_str()), (2, "drives to gate"));
}

#[test]
fn a_vehicle_of_a_version_that_nobody_here_speaks_is_said_to_be_one() {
    let cases = [
        ("v2", "1.1.0", "speaks 1.1.0, which this program does not (2.0, 2.1, 3.0)"),
        ("v2", "two", "speaks two, which this program does not (2.0, 2.1, 3.0)"),
        ("v2", "3.0.0", "speaks 3.0 on topics of v2; orders would go to those of v3"),
        (
            "v2",
            "",
            "does not say which version of VDA 5050 it speaks; say it in a column `version` (2.0, 2.1, 3.0)",
        ),
    ];
    for (topic, version, words) in cases {
        let mut alone = Alone::new();
        alone.driver.topical(topic);
        alone.state["version"] = json!(version);
        for _ in 0..3 {
            alone.says();
        }
        assert_eq!(alone.doing, words);
        assert_eq!(alone.log, [format!("v {words}")], "once");
        alone.state["version"] = json!("2.1.0");
        alone.says();
        assert_eq!(alone.doing, "asks for the way to gate");
    }
}

#[test]
fn a_stop_that_ends_by_itself_is_none() {
    let mut alone = Alone::new();
    alone.state["safetyState"]["eStop"] = json!("AUTOACK");
    alone.says();
    assert_eq!(alone.doing, "asks for the way to gate");
}
