//! Messages that are none: each is said in words, and the program goes on.

use adit_tests::within;
use serde_json::{Value, json};

use crate::yard::{Broker, FleetProgram, Vehicle, cell, depot, keep, send};

#[test]
fn a_vehicle_of_the_table_is_not_said_to_be_a_stranger_before_the_table_was_read() {
    let broker = Broker::start();
    let (_site, service) = depot("vehicle,manufacturer,robot,goal,connection\ncart-1,acme,cart,,\n", "");
    let connection = json!({"version": "2.0.0", "connectionState": "ONLINE"});
    keep(&broker, "uagv/v2/acme/cart-1/connection", &connection);
    // each time it is by chance what comes first
    for _ in 0..5 {
        let program = FleetProgram::start(&service, &broker);
        within("it hears", || program.hears("cart-1").then_some(()));
        within("it is online", || (cell(&service, "cart-1", "connection") == "online").then_some(()));
        assert!(!program.log().contains("not in table"), "{}", program.log());
        // in a way that leaves the next nothing but what the broker has kept
        drop(program);
        let empty = json!({"kind": "set", "table": "vehicles", "key": "cart-1", "column": "connection", "value": null});
        assert_eq!(service.ask("POST", "/api/edits", Some(&json!({"edit": empty}))).0, 200);
    }
}

#[test]
fn messages_that_cannot_be_read_are_said_in_words_and_vehicles_drive_on() {
    let broker = Broker::start();
    let (_site, service) =
        depot("vehicle,manufacturer,robot,goal\ncart-1,acme,cart,\ncart-2,acme,cart,\n", "");
    let program = FleetProgram::start(&service, &broker);
    let mut cart = Vehicle::start(&broker, "2.0.0", "cart-1", [2.0, 6.0, 6.0]);
    let (client, _) = broker.client(&[]);
    within("it hears", || program.hears("cart-2").then_some(()));
    let state = json!({
        "headerId": 1, "timestamp": "2026-11-24T08:00:00Z", "version": "2.0.0", "manufacturer": "acme", "serialNumber": "cart-2",
        "orderId": "", "orderUpdateId": 0, "lastNodeId": "", "lastNodeSequenceId": 0, "nodeStates": [], "edgeStates": [],
        "driving": false, "actionStates": [], "batteryState": {"batteryCharge": 80, "charging": false},
        "operatingMode": "AUTOMATIC", "errors": [], "safetyState": {"eStop": "NONE", "fieldViolation": false},
        "agvPosition": {"x": 2.0, "y": 9.0, "theta": 0.0, "mapId": "depot", "positionInitialized": true},
    });
    let with = |key: &str, value: Value| {
        let mut state = state.clone();
        state[key] = value;
        state.to_string()
    };
    let whole = state.to_string();
    let far = with(
        "agvPosition",
        json!({"x": 1e300, "y": 0, "theta": 0, "mapId": "m", "positionInitialized": true}),
    );
    let deep = "[".repeat(100_000);
    let bad: [(&str, &[u8], &str); 12] = [
        (
            "state",
            with("serialNumber", json!("cart-1")).leak().as_bytes(),
            "cart-2: a message on the topics of acme/cart-2 says that it is of acme/cart-1; what it says is not believed",
        ),
        (
            "connection",
            b"{\"connectionState\": \"OFFLINE\", \"manufacturer\": \"emca\"}",
            "it is of emca/cart-2",
        ),
        ("state", &whole.as_bytes()[..100], "its state cannot be read: EOF while parsing"),
        ("state", b"", "its state cannot be read: EOF"),
        ("state", b"\xff\xfe", "its state cannot be read: expected value at line 1 column 1"),
        ("state", deep.as_bytes(), "its state cannot be read: "),
        (
            "state",
            with("driving", json!("perhaps")).leak().as_bytes(),
            "invalid type: string \"perhaps\", expected a boolean",
        ),
        (
            "state",
            with("nodeStates", json!([{"sequenceId": -4}])).leak().as_bytes(),
            "invalid value: integer `-4`, expected u32",
        ),
        ("state", with("orderUpdateId", json!(1e18)).leak().as_bytes(), "expected u32"),
        ("state", far.as_bytes(), "farther off than ten thousand kilometres"),
        ("connection", b"{\"connectionState\": \"SLEEPY\"}", "unknown variant `SLEEPY`"),
        (
            "factsheet",
            b"{\"physicalParameters\": {\"width\": []}}",
            "its factsheet cannot be read: invalid type",
        ),
    ];
    for (topic, message, words) in bad {
        client
            .publish(format!("uagv/v2/acme/cart-2/{topic}"), rumqttc::QoS::AtLeastOnce, false, message)
            .unwrap();
        within(words, || program.log().contains(words).then_some(()));
    }
    for topic in ["uagv/v2/acme/nobody/state", "uagv/state", "uagv/v2/acme/cart-2/thing"] {
        client.publish(topic, rumqttc::QoS::AtLeastOnce, false, whole.clone()).unwrap();
    }
    within("it is a stranger", || {
        program.log().contains("vehicle acme/nobody is on the broker").then_some(())
    });

    // an order is given to the one, and it says that it is where it was never sent
    let (_second, orders) = broker.client(&["uagv/v2/acme/cart-2/order"]);
    client.publish("uagv/v2/acme/cart-2/state", rumqttc::QoS::AtLeastOnce, false, whole).unwrap();
    send(&service, "cart-2", "gate");
    let order = orders.recv_timeout(std::time::Duration::from_secs(20)).expect("an order").1;
    let mut dangling = state.clone();
    dangling["orderId"] = order["orderId"].clone();
    dangling["lastNodeId"] = json!("nowhere");
    dangling["lastNodeSequenceId"] = json!(4_000_000_000_u32);
    client
        .publish("uagv/v2/acme/cart-2/state", rumqttc::QoS::AtLeastOnce, false, dangling.to_string())
        .unwrap();
    let words = "cart-2 is at node `nowhere`, sequence 4000000000, which was not released to it";
    within(words, || program.log().contains(words).then_some(()));

    send(&service, "cart-1", "gate");
    cart.arrives("gate");
}
