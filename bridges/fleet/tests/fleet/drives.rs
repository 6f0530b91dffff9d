//! A vehicle that others wrote drives the depot's routes.

use serde_json::Value;

use crate::yard::{Bridge, Broker, Vehicle, cell, close, depot, send, within};

const CART: &str = "vehicle,manufacturer,robot,goal,doing\ncart-1,acme,cart,,\n";

#[test]
fn a_vehicle_drives_to_its_goal_and_its_goal_is_taken_out_of_the_table() {
    for version in ["2.0.0", "2.1.0"] {
        let broker = Broker::start();
        let (_site, service) = depot(CART, "");
        let bridge = Bridge::start(&service, &broker);
        let mut cart = Vehicle::start(&broker, version, "cart-1", [2.0, 6.0, 6.0]);
        send(&service, "cart-1", "gate");
        cart.arrives("gate");
        let position = &cart.state["agvPosition"];
        assert_eq!(
            [&position["x"], &position["y"]].map(|v| v.as_f64().unwrap()),
            [22.0, 6.0],
            "{}",
            bridge.log()
        );
        within("the goal is reached", || (cell(&service, "cart-1", "goal") == Value::Null).then_some(()));
        within("it is said", || (cell(&service, "cart-1", "doing") == "at gate").then_some(()));
        assert_eq!(cart.state["errors"], serde_json::json!([]));
    }
}
