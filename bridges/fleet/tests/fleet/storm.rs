//! A hundred vehicles, ten errands a second, closings at random. By hand:
//! `ADIT_STORM_SECONDS=600 cargo test --workspace --test fleet storm -- --ignored --nocapture`

use std::collections::BTreeMap;
use std::fs;
use std::time::{Duration, Instant};

use adit_fleet::wire::Version;
use adit_tests::within;
use serde_json::{Value, json};

use crate::judge::{Chance, Judge, schemas};
use crate::yard::{Broker, FleetProgram, depot};

const PLACES: [&str; 4] = ["dock", "gate", "charger", "shelf"];

/// What the program hears of a closing after this may not be contradicted by an order that goes out later.
const HEARD: Duration = Duration::from_secs(2);

/// Memory in bytes and descriptors of a program.
fn burden(pid: u32) -> (u64, usize) {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    let memory = line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() * 1024;
    (memory, fs::read_dir(format!("/proc/{pid}/fd")).unwrap().count())
}

/// The released points of an order.
fn released(nodes: &[Value]) -> Vec<[f64; 2]> {
    let of = |node: &Value| ["x", "y"].map(|axis| node["nodePosition"][axis].as_f64().unwrap());
    nodes.iter().filter(|node| node["released"] == true).map(of).collect()
}

/// The doorway of the depot's wall through which a leg leads.
fn doorway(leg: &[[f64; 2]]) -> Option<&'static str> {
    let [a, b] = [leg[0], leg[1]];
    let share = (11.9 - a[0]) / (b[0] - a[0]);
    let crossed = (share > 0.0 && share < 1.0).then(|| a[1] + share * (b[1] - a[1]))?;
    Some(if crossed < 2.0 {
        "doorway 1"
    } else if crossed < 7.0 {
        "doorway 2"
    } else {
        "doorway 3"
    })
}

#[test]
#[ignore = "minutes; by hand"]
#[allow(clippy::print_stdout)] // its figures
fn a_storm_leaves_memory_level_and_no_order_contradicts_what_is_known() {
    let asked = std::env::var("ADIT_STORM_SECONDS").ok().and_then(|seconds| seconds.parse().ok());
    let lasts = Duration::from_secs(asked.unwrap_or(60));
    let count = 100;
    let rows: Vec<String> = (0..count).map(|n| format!("v{n},acme,{},", ["dog", "crawler"][n % 2])).collect();
    let broker = Broker::start();
    let (_site, service) = depot(&format!("vehicle,manufacturer,robot,goal\n{}\n", rows.join("\n")), "");
    let program = FleetProgram::start(&service, &broker);
    within("it hears", || program.hears(&format!("v{}", count - 1)).then_some(()));
    let (client, heard) = broker.client(&["uagv/v2/acme/+/order", "uagv/v2/acme/+/instantActions"]);
    let all = schemas();
    let schema = all.as_ref().map(|all| &all["2.1.0"]);
    let mut chance = Chance(21);
    let mut vehicles: BTreeMap<String, Judge> = (0..count)
        .map(|n| {
            let point = [1.0 + chance.below(8) as f64, 2.0 + chance.below(2) as f64];
            (format!("v{n}"), Judge::new(Version::V2_1, schema, point))
        })
        .collect();
    let mut closed: BTreeMap<String, Instant> = BTreeMap::new();
    let (began, mut burdens) = (Instant::now(), Vec::new());
    let (mut errands, mut orders, mut ticks) = (0, 0, 0_u64);
    while began.elapsed() < lasts {
        let tick = Instant::now();
        ticks += 1;
        while let Ok((topic, message)) = heard.try_recv() {
            let name = topic.split('/').nth(3).unwrap().to_owned();
            let vehicle = vehicles.get_mut(&name).unwrap();
            let known = released(&vehicle.nodes);
            vehicle.hears(topic.rsplit('/').next().unwrap(), &message);
            orders += 1;
            for leg in released(message["nodes"].as_array().map_or(&[], Vec::as_slice)).windows(2) {
                let shut = doorway(leg).and_then(|doorway| Some((doorway, closed.get(doorway)?.elapsed())));
                let shut =
                    shut.filter(|(_, since)| *since > HEARD && !known.windows(2).any(|old| old == leg));
                assert!(shut.is_none(), "{name} is let through what is closed: {shut:?}: {message:#}");
            }
        }
        for (name, vehicle) in &mut vehicles {
            vehicle.drives();
            let mut state = vehicle.says(&mut chance);
            state["errors"] = json!([]);
            state["newBaseRequest"] = json!(false);
            let position = &mut state["agvPosition"];
            position["positionInitialized"] = json!(true);
            position["mapId"] = json!("depot");
            client
                .publish(
                    format!("uagv/v2/acme/{name}/state"),
                    rumqttc::QoS::AtMostOnce,
                    false,
                    state.to_string(),
                )
                .unwrap();
        }
        for _ in 0..5 {
            let (name, goal) = (format!("v{}", chance.below(count as u64)), PLACES[chance.below(4) as usize]);
            let edit =
                json!({"kind": "set", "table": "vehicles", "key": name, "column": "goal", "value": goal});
            assert_eq!(service.ask("POST", "/api/edits", Some(&json!({"edit": edit}))).0, 200);
            errands += 1;
        }
        if ticks % 4 == 0 {
            let doorway = format!("doorway {}", 1 + chance.below(3));
            let kind = if closed.contains_key(&doorway) { "open" } else { "close" };
            assert_eq!(
                service.ask("POST", "/api/edits", Some(&json!({"edit": {"kind": kind, "what": doorway}}))).0,
                200
            );
            if closed.remove(&doorway).is_none() {
                closed.insert(doorway, Instant::now());
            }
        }
        if ticks % 20 == 0 {
            burdens.push(burden(program.pid()));
        }
        std::thread::sleep(Duration::from_millis(500).saturating_sub(tick.elapsed()));
    }
    let third = burdens.len() / 3;
    let most = |part: &[(u64, usize)]| {
        (part.iter().map(|b| b.0).max().unwrap(), part.iter().map(|b| b.1).max().unwrap())
    };
    let (early, late) = (most(&burdens[..third.max(1)]), most(&burdens[2 * third..]));
    println!(
        "{count} vehicles, {errands} errands, {orders} messages in {:.0} s; memory {:.1} MB in the first third, {:.1} MB in the last; \
         descriptors {} and {}",
        began.elapsed().as_secs_f64(),
        early.0 as f64 / 1e6,
        late.0 as f64 / 1e6,
        early.1,
        late.1
    );
    assert!(orders > count, "{orders}");
    assert!((late.0 as f64) < 1.3 * early.0 as f64 + 5e6, "memory grows: {burdens:?}");
    assert!(late.1 <= early.1 + 50, "descriptors grow: {burdens:?}");
}
