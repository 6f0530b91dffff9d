//! Many robots, ten orders a second for a while, and doorways that close and open by chance:
//! `ADIT_STORM_SECONDS=600 ADIT_STORM_ROBOTS=100 cargo test --workspace --test ros storm -- --nocapture`

use std::collections::BTreeMap;
use std::fs;
use std::time::{Duration, Instant};

use adit_tests::oracle::random::Chance;
use adit_tests::within;
use serde_json::{Value, json};

use crate::floor::{Client, Floor, is_outside, points, pose};

/// Robots, unless more are wanted: nodes of their own in so many programs.
const ROBOTS: usize = 20;
const PROGRAMS: usize = 4;
/// From where to where orders lead.
const SPOTS: [[f64; 2]; 3] = [[4.7, 1.5], [53.8, 14.0], [22.2, 27.6]];
/// An order comes as often.
const TICK: Duration = Duration::from_millis(100);
/// How long an answer may take.
const PATIENCE: Duration = Duration::from_secs(20);
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
pub fn held(pid: u32) -> (u64, usize) {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    let kilobytes = line.trim().trim_end_matches(" kB").parse().unwrap();
    (kilobytes, fs::read_dir(format!("/proc/{pid}/fd")).unwrap().count())
}

/// A plan that a client waits for.
struct Asked {
    id: u64,
    at: Instant,
    turn: usize,
}

#[test]
fn many_robots_leave_memory_and_files_as_they_were_and_no_plan_leads_through_what_is_closed() {
    if is_outside(
        "storm::many_robots_leave_memory_and_files_as_they_were_and_no_plan_leads_through_what_is_closed",
    ) {
        return;
    }
    let lasts = Duration::from_secs(wanted("ADIT_STORM_SECONDS", 30) as u64);
    let count = wanted("ADIT_STORM_ROBOTS", ROBOTS);
    let floor = Floor::start("clinic", &[]);
    let start = |index| Client::several(&format!("program{index}"), count / PROGRAMS);
    let map = floor.service.ask("GET", "/api/map", None).1;
    let doorways = map["doorways"].as_array().unwrap();
    let mut closed: BTreeMap<usize, Instant> = BTreeMap::new();
    let mut chance = Chance::new(21);
    let mut clients: Vec<Client> = (0..PROGRAMS).map(start).collect();
    let mut asked: Vec<Vec<Asked>> = (0..PROGRAMS).map(|_| Vec::new()).collect();
    let ends = |turn: usize| [SPOTS[turn % 3], SPOTS[(turn + 1) % 3]];
    let began = Instant::now();
    let (mut turn, mut answers, mut without, mut level) = (0, 0, 0, None);
    let mut slowest = Duration::ZERO;
    while began.elapsed() < lasts || asked.iter().any(|asked| !asked.is_empty()) {
        let tick = Instant::now();
        if began.elapsed() < lasts {
            if turn % 5 == 0 {
                let index = chance.below(doorways.len());
                let what = format!("doorway {}", doorways[index]["doorway"]);
                if closed.remove(&index).is_some() {
                    floor.edit(&json!({"kind": "open", "what": what}));
                } else if closed.len() < CLOSED {
                    floor.edit(&json!({"kind": "close", "what": what}));
                    closed.insert(index, Instant::now());
                }
            }
            let [from, to] = ends(turn).map(|[x, y]| pose(x, y));
            let program = turn % PROGRAMS;
            let id = if turn % 8 < PROGRAMS {
                let request = json!({"start": from, "goal": to});
                clients[program].order("call", "/get_plan", "nav_msgs/srv/GetPlan", &request)
            } else {
                let goal = json!({"start": from, "goal": to, "use_start": true, "use_poses": true});
                clients[program].order("goal", "/compute_route", "nav2_msgs/action/ComputeRoute", &goal)
            };
            asked[program].push(Asked { id, at: Instant::now(), turn });
            turn += 1;
        }
        for (client, asked) in clients.iter_mut().zip(&mut asked) {
            while let Some(said) = client.heard(|said| said["accepted"].is_null()) {
                let found = asked.iter().position(|asked| said["id"] == asked.id).unwrap();
                let of = asked.remove(found);
                answers += 1;
                slowest = slowest.max(of.at.elapsed());
                let is_plan = said["result"].is_null();
                let way = points(if is_plan { &said["response"]["plan"] } else { &said["result"]["path"] });
                without += usize::from(way.is_empty());
                assert!(!way.is_empty() || !closed.is_empty(), "no way, and nothing is closed: {said}");
                // what closed while it was on the way may or may not be known to it
                let known = closed.iter().filter(|(_, since)| **since < of.at);
                for (index, _) in known {
                    let doorway = line(&doorways[*index]);
                    let through = way.windows(2).find(|leg| crosses(doorway, [leg[0], leg[1]]));
                    assert!(through.is_none(), "through {}, which is closed: {through:?}", doorways[*index]);
                }
            }
            let late = asked.iter().find(|asked| asked.at.elapsed() > PATIENCE);
            assert!(late.is_none(), "order {} was not answered", late.unwrap().turn);
        }
        if level.is_none() && began.elapsed() > lasts / 3 {
            level = Some(held(floor.pid()));
        }
        std::thread::sleep(TICK.saturating_sub(tick.elapsed()));
    }
    let (memory, files) = level.unwrap();
    let after = held(floor.pid());
    let seconds = began.elapsed().as_secs_f64();
    eprintln!(
        "{answers} answers in {seconds:.0} s to {count} robots ({without} times there was no way), the slowest after {slowest:?}; after a third {memory} kB and {files} files, at the end {} kB and {}",
        after.0, after.1
    );
    assert_eq!(answers, turn);
    assert!(answers as f64 > 5.0 * lasts.as_secs_f64() && without < answers / 2, "{answers} answers");
    assert!(after.0 < memory + memory / 4 + 20_000, "{memory} kB became {} kB", after.0);
    assert!(after.1 <= files + 4, "{files} files became {}", after.1);

    // who is gone is forgotten, and the node answers whoever stays
    let mut last = clients.pop().unwrap();
    drop(clients);
    for index in closed.keys() {
        floor.edit(&json!({"kind": "open", "what": format!("doorway {}", doorways[*index]["doorway"])}));
    }
    let [from, to] = ends(0).map(|[x, y]| pose(x, y));
    within("it answers", || {
        (points(&last.plan(&json!({"start": from, "goal": to}))).len() > 2).then_some(())
    });
}
