//! Many clients at once, for a while.

use std::fs;
use std::time::{Duration, Instant};

use serde_json::json;

use crate::floor::{Client, Floor, is_outside, points, pose, within};

/// Clients at once: nodes of their own in so many programs.
const CLIENTS: usize = 20;
const PROGRAMS: usize = 4;

/// Resident kilobytes, and open files, of a program.
fn held(pid: u32) -> (u64, usize) {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    let kilobytes = line.trim().trim_end_matches(" kB").parse().unwrap();
    (kilobytes, fs::read_dir(format!("/proc/{pid}/fd")).unwrap().count())
}

#[test]
fn twenty_clients_for_half_a_minute_leave_memory_and_files_as_they_were() {
    if is_outside("storm::twenty_clients_for_half_a_minute_leave_memory_and_files_as_they_were") {
        return;
    }
    let lasts = std::env::var("ADIT_STORM_SECONDS").map_or(30, |seconds| seconds.parse().unwrap());
    let floor = Floor::start("clinic", &[]);
    let start = |index| Client::several(&format!("program{index}"), CLIENTS / PROGRAMS);
    let mut clients: Vec<Client> = (0..PROGRAMS).map(start).collect();
    let spots = [[4.7, 1.5], [53.8, 14.0], [22.2, 27.6]];
    let ends = |turn: usize| {
        let at = |index: usize| pose(spots[index % 3][0], spots[index % 3][1]);
        (at(turn), at(turn + 1))
    };
    let began = Instant::now();
    let (mut turn, mut answers, mut level) = (0, 0, None);
    let mut slowest = Duration::ZERO;
    while began.elapsed() < Duration::from_secs(lasts) {
        if turn % 7 == 0 {
            let kind = if turn % 14 == 0 { "close" } else { "open" };
            floor.edit(&json!({"kind": kind, "what": "doorway 30"}));
        }
        let asked = Instant::now();
        let (start, goal) = ends(turn);
        let request = json!({"start": start, "goal": goal});
        let by_poses = json!({"start": start, "goal": goal, "use_start": true, "use_poses": true});
        let mut ids = Vec::new();
        for index in 0..CLIENTS {
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
            assert!(points(path).len() > 2, "{said}");
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
        "{answers} answers in {seconds:.0} s to {CLIENTS} clients, a round at most {slowest:?}; after a third {memory} kB and {files} files, at the end {} kB and {}",
        after.0, after.1
    );
    assert!(answers > CLIENTS * 10, "{answers} answers");
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
