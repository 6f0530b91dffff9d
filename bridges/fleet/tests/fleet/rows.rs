//! What is written into the table of vehicles: each value once, whatever the column is for.

use adit_fleet::site::Vehicle;
use adit_tests::within;
use serde_json::{Value, json};

use crate::alone::Alone;
use crate::yard::{Broker, FleetProgram, cell, depot};

#[test]
fn what_is_on_its_way_into_the_table_is_not_written_again_for_a_table_of_before() {
    let mut alone = Alone::new();
    let before = alone.driver.row.clone();
    alone.says();
    let first = std::mem::take(&mut alone.writes);
    assert!(first.contains(&("battery", json!(80.0))), "{first:?}");
    // a table that was asked for before, while the edits are on their way and after they were done
    alone.driver.read(before.clone());
    alone.says();
    for (number, (column, _)) in (1..).zip(&first) {
        alone.driver.wrote(column, number);
    }
    alone.driver.read(before.clone());
    alone.says();
    assert_eq!(alone.writes, []);
    // what somebody else wrote over it since is another thing
    alone.driver.read(Vehicle { answers: first.len() as u64, ..before });
    alone.says();
    assert_eq!(alone.writes.len(), first.len(), "{:?}", alone.writes);
}

#[test]
fn a_cell_that_says_the_same_in_another_type_is_not_written() {
    let mut alone = Alone::new();
    let cells = [
        ("localized", json!("1")),
        ("battery", json!("80")),
        ("errors", Value::Null),
        ("doing", json!("asks for the way to gate")),
    ];
    let written = cells.map(|(column, value)| (column.to_owned(), value)).into();
    alone.driver.read(Vehicle { written, ..alone.driver.row.clone() });
    alone.says();
    assert_eq!(alone.writes, []);
    alone.state["agvPosition"]["positionInitialized"] = json!(false);
    alone.says();
    assert!(alone.writes.contains(&("localized", json!(false))), "{:?}", alone.writes);
}

#[test]
fn a_charge_that_cannot_be_is_said_once_and_not_written() {
    let mut alone = Alone::new();
    for charge in [-999.0, 50.0, 100.5, -1.0, 100.0, 0.0] {
        alone.state["batteryState"]["batteryCharge"] = json!(charge);
        alone.says();
    }
    let written: Vec<_> = alone.writes.iter().filter(|(column, _)| *column == "battery").collect();
    assert_eq!(written, [&("battery", json!(50.0)), &("battery", json!(100.0)), &("battery", json!(0.0))]);
    assert_eq!(alone.log, ["v says that its battery is at -999 per cent, which is not believed"]);
}

#[test]
fn a_table_with_empty_columns_is_written_only_where_something_is_another() {
    let broker = Broker::start();
    let (site, service) =
        depot("vehicle,manufacturer,robot,goal,doing,battery,errors,localized\ncart-1,acme,cart,,,,,\n", "");
    let program = FleetProgram::start(&service, &broker);
    within("it hears", || program.hears("cart-1").then_some(()));
    let (client, _) = broker.client(&[]);
    for battery in 70..80 {
        let mut state = Alone::new().state;
        state["agvPosition"]["mapId"] = json!("depot");
        state["batteryState"]["batteryCharge"] = json!(battery);
        let topic = "uagv/v2/acme/cart-1/state";
        client.publish(topic, rumqttc::QoS::AtLeastOnce, false, state.to_string()).unwrap();
        within("it is written", || {
            // a column that was empty is one of texts
            let written = cell(&service, "cart-1", "battery");
            let number = written.as_str().and_then(|text| text.parse::<f64>().ok());
            (number == Some(f64::from(battery))).then_some(())
        });
    }
    let again = "SELECT column_name, old, new FROM history WHERE table_name = 'vehicles' AND CAST(old AS TEXT) IS CAST(new AS TEXT)";
    assert_eq!(site.sqlite3(again), Vec::<String>::new(), "{}", program.log());
    let localized = "SELECT count(*) FROM history WHERE column_name = 'localized'";
    assert_eq!(site.sqlite3(localized), ["1"]);
}
