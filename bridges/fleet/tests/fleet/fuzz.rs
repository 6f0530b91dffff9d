//! What vehicles may send, made of what they do send piece by piece: nothing of it stops the program, and what it says to them
//! goes by the published schemas all the same. Longer than two seconds: `ADIT_FUZZ_SECONDS=60`.

use adit_fleet::driver::{Clock, Driver, Effect, World};
use adit_fleet::site::Vehicle;
use adit_fleet::way::Margins;
use adit_fleet::wire::{self, Version};
use adit_tests::fuzz::Fuzz;
use serde_json::{Value, json};

use crate::judge::{Chance, Judge, expect_valid, schemas};
use crate::messages::{fleet, route};

/// Hands a vehicle's message on, after its topic; whether it is one.
fn hear(driver: &mut Driver, line: &str) -> bool {
    let (topic, message) = line.split_once(' ').unwrap_or((line, ""));
    let message = message.as_bytes();
    match topic {
        "connection" => {
            wire::connection(message).map(|said| driver.linked(said.connection_state, &said.version))
        }
        "factsheet" => wire::factsheet(message).map(|said| driver.described(said)),
        _ => wire::state(message).map(|said| driver.reported(said)),
    }
    .is_ok()
}

/// A vehicle that is sent to `gate`, and says this, a message a line; whether it was understood to the end.
fn drive(text: &str, see: &mut impl FnMut(&'static str, &Value)) -> bool {
    let (fleet, chance) = (fleet(), &mut Chance(7));
    let mut driver = Driver::new(Vehicle { goal: Some("gate".to_owned()), ..fleet.vehicles[0].clone() });
    let margins = Margins { before: 0.3, ahead: 3.0 };
    let mut is_understood = true;
    for (second, line) in text.lines().take(300).enumerate() {
        is_understood &= hear(&mut driver, line);
        let clock = Clock { seconds: second as f64, words: "2026-11-24T08:00:00.000Z".to_owned() };
        let world = World {
            fleet: &fleet,
            margins: &margins,
            bridges: &[],
            areas: &[],
            bounds: Some([-20.0, -20.0, 20.0, 20.0]),
            map: "m",
            clock: &clock,
        };
        for effect in driver.think(&world) {
            match effect {
                Effect::Send { topic, message, .. } => see(topic, &message),
                Effect::Follow { epoch, start, .. } => driver.routed(epoch, route(chance, start)),
                Effect::Ask { epoch, start, .. } => driver.answered(epoch, route(chance, start)),
                Effect::Arrived { .. } => driver.is_written(),
                _ => {}
            }
        }
    }
    is_understood
}

/// What a vehicle says on its way to `gate`.
fn said(version: Version) -> Vec<u8> {
    let (chance, mut judge) = (&mut Chance(3), Judge::new(version, None, [0.0, 0.0]));
    let mut lines = vec![
        format!("connection {}", json!({"version": version.full(), "connectionState": "ONLINE"})),
        format!(
            "factsheet {}",
            json!({"physicalParameters": {"heightMax": 1.2, "width": 0.7, "length": 1.0}})
        ),
    ];
    for _ in 0..12 {
        lines.push(format!("state {}", judge.says(chance)));
        // what it is told depends on what it has said so far
        let mut told = Vec::new();
        drive(&lines.join("\n"), &mut |topic, message| told.push((topic, message.clone())));
        if let Some((topic, message)) = told.last() {
            judge.hears(topic, message);
        }
        judge.drives();
    }
    lines.join("\n").into_bytes()
}

#[test]
fn messages_of_vehicles() {
    let all = schemas();
    let seeds = [Version::V2_0, Version::V2_1, Version::V3_0].map(said);
    Fuzz::new("vehicles", seeds.into()).run(move |text| {
        drive(&String::from_utf8_lossy(text), &mut |topic, message| {
            let version = message["version"].as_str().unwrap_or_default();
            let Some(of) = all.as_ref().and_then(|all| all.get(version)) else { return };
            match topic {
                "order" => expect_valid(&of.order, message),
                "instantActions" => expect_valid(&of.instant, message),
                _ => {}
            }
        })
    });
}
