//! Many clients at once, for a while, and doorways that close and open by chance:
//! `ADIT_STORM_SECONDS=600 ADIT_STORM_CLIENTS=100 cargo test --workspace --test ros storm -- --nocapture`

use std::collections::BTreeSet;
use std::fs;
use std::time::{Duration, Instant};

use adit_tests::oracle::random::Chance;
use adit_tests::within;
use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose};

/// Clients at once, unless more are wanted: nodes of their own in so many programs.
const CLIENTS: usize = 20;
const PROGRAMS: usize = 4;
/// So many doorways are closed at a time at most.
const CLOSED: usize = 6;

fn wanted(variable: &str, usual: usize) -> usize {
    std::env::var(variable).map_or(usual, |text| text.parse().unwrap())
}

/// On which side of a line a point lies, as a sign.
fn side(line: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
    let [a, b] = line;
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

fn crosses(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> bool {
    let parts = |line, ends: [[f64; 2]; 2]| side(line, ends[0]) * side(line, ends[1]) < -1e-9;
    parts(one, other) && parts(other, one)
}

/// The line of a doorway from post to post.
fn line(doorway: &Value) -> [[f64; 2]; 2] {
    let [x0, y0, x1, y1] = [0, 1, 2, 3].map(|index| doorway["segment"][index].as_f64().unwrap());
    [[x0, y0], [x1, y1]]
}

/// Resident kilobytes, and open files, of a program.
fn held(pid: u32) -> (u64, usize) {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    let kilobytes = line.trim().trim_end_matches(" kB").parse().unwrap();
    (kilobytes, fs::read_dir(format!("/proc/{pid}/fd")).unwrap().count())
}

#[test]
fn many_clients_leave_memory_and_files_as_they_were_and_no_plan_leads_through_what_is_closed() {
    if is_outside(
        "storm::many_clients_leave_memory_and_files_as_they_were_and_no_plan_leads_through_what_is_closed",
    ) {
        return;
    }
    let lasts = wanted("ADIT_STORM_SECONDS", 30) as u64;
    let count = wanted("ADIT_STORM_CLIENTS", CLIENTS);
    let floor = Floor::start("clinic", &[]);
    let start = |index| Client::several(&format!("program{index}"), count / PROGRAMS);
    let map = floor.service.ask("GET", "/api/map", None).1;
    let doorways = map["doorways"].as_array().unwrap();
    let (mut closed, mut chance) = (BTreeSet::new(), Chance::new(21));
    let mut clients: Vec<Client> = (0..PROGRAMS).map(start).collect();
    let spots = [[4.7, 1.5], [53.8, 14.0], [22.2, 27.6]];
    let ends = |turn: usize| {
        let at = |index: usize| pose(spots[index % 3][0], spots[index % 3][1]);
        (at(turn), at(turn + 1))
    };
    let began = Instant::now();
    let (mut turn, mut answers, mut without, mut level) = (0, 0, 0, None);
    let mut slowest = Duration::ZERO;
    while began.elapsed() < Duration::from_secs(lasts) {
        let index = chance.below(doorways.len());
        let what = format!("doorway {}", doorways[index]["doorway"]);
        if closed.remove(&index) {
            floor.edit(&json!({"kind": "open", "what": what}));
        } else if closed.len() < CLOSED {
            floor.edit(&json!({"kind": "close", "what": what}));
            closed.insert(index);
        }
        let asked = Instant::now();
        let (start, goal) = ends(turn);
        let request = json!({"start": start, "goal": goal});
        let by_poses = json!({"start": start, "goal": goal, "use_start": true, "use_poses": true});
        let mut ids = Vec::new();
        for index in 0..count {
            let client = &mut clients[index % PROGRAMS];
            ids.push(match index % 2 {
                0 => client.order("call", "/get_plan", "nav_msgs/srv/GetPlan", &request),
                _ => client.order("goal", "/compute_route", "nav2_msgs/action/ComputeRoute", &by_poses),
            });
        }
        for (index, id) in ids.into_iter().enumerate() {
            let client = &mut clients[index % PROGRAMS];
            let said = client.until("an answer", |said| said["id"] == id && said["accepted"].is_null());
            let path =
                if said["response"].is_null() { &said["result"]["path"] } else { &said["response"]["plan"] };
            let way = points(path);
            if way.is_empty() {
                let [from, to] = [turn, turn + 1].map(|index| spots[index % 3]);
                let asked = format!("/api/route?start={},{}&goal={},{}", from[0], from[1], to[0], to[1]);
                let route = floor.service.ask("GET", &asked, None).1;
                assert_eq!(route["status"], "no_route", "{said}");
                without += 1;
            }
            for leg in way.windows(2) {
                let shut = closed.iter().find(|&&index| crosses(line(&doorways[index]), [leg[0], leg[1]]));
                assert!(shut.is_none(), "through {}, which is closed: {leg:?}", doorways[*shut.unwrap()]);
            }
            answers += 1;
        }
        slowest = slowest.max(asked.elapsed());
        turn += 1;
        if level.is_none() && began.elapsed() > Duration::from_secs(lasts / 3) {
            level = Some(held(floor.pid()));
        }
    }
    let (memory, files) = level.unwrap();
    let after = held(floor.pid());
    let seconds = began.elapsed().as_secs_f64();
    eprintln!(
        "{answers} answers in {seconds:.0} s to {count} clients ({without} times there was no way), a round at most {slowest:?}; after a third {memory} kB and {files} files, at the end {} kB and {}",
        after.0, after.1
    );
    assert!(answers > count * 10 && without < answers / 2, "{answers} answers, {without} of them no way");
    assert!(after.0 < memory + memory / 4 + 20_000, "{memory} kB became {} kB", after.0);
    assert!(after.1 <= files + 4, "{files} files became {}", after.1);

    // who is gone is forgotten, and the node answers whoever stays
    let mut last = clients.pop().unwrap();
    drop(clients);
    let (start, goal) = ends(0);
    within("it answers", || {
        (points(&last.plan(&json!({"start": start, "goal": goal}))).len() > 2).then_some(())
    });
}
