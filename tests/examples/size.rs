//! How time, rooms and memory grow with pixels and states: `size KIND COLUMNS ROWS STATES [SEED]` makes a floor, builds
//! a site of it into a new database, without routes, and prints one line of a table; `size --head` prints its head.

#![allow(clippy::print_stdout, reason = "a program's output")]

use std::time::{Duration, Instant};

use adit::edit::{Edit, Lay, Thing};
use adit::{Answer, KnowledgeBase, Live, Silent, Status};
use adit_db::history::Author;
use adit_tests::floor::{Floor, Kind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, columns, rows, states, seed @ ..] = arguments.as_slice() else {
        println!(
            "| floor | pixels | states | rooms | doors | cut | rules | database | all | database | memory | a route | an edit and the next route | an area and the next route |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
        return Ok(());
    };
    let made = match kind.as_str() {
        "offices" => Kind::Offices,
        "warehouse" => Kind::Warehouse,
        other => return Err(format!("`{other}` is no floor: offices or warehouse").into()),
    };
    let seed = seed.first().map_or(Ok(7), |seed| seed.parse())?;
    let floor = Floor::new(made, columns.parse()?, rows.parse()?, seed);
    let folder = tempfile::tempdir()?;
    floor.write_site(folder.path(), states.parse()?)?;
    let began = Instant::now();
    let knowledge = KnowledgeBase::open(folder.path())?;
    let report = knowledge.build(&Silent)?;
    let all = began.elapsed();
    if std::env::var_os("STAGES").is_some() {
        let stages = report.stages.iter().map(|stage| format!("{} {:.0?}", stage.name, stage.took));
        eprintln!("{}", stages.collect::<Vec<_>>().join(", "));
    }
    let took = |name: &str| {
        let stage = report.stages.iter().find(|stage| stage.name == name);
        stage.map_or(String::new(), |stage| format!("{:.2} s", stage.took.as_secs_f64()))
    };
    println!(
        "| {kind} | {columns} x {rows} | {states} | {} | {} | {} | {} | {} | {:.2} s | {:.1} MB | {} | {} |",
        report.rooms.total,
        report.doors.total,
        took("rooms by state"),
        took("rules"),
        took("database"),
        all.as_secs_f64(),
        std::fs::metadata(knowledge.database())?.len() as f64 / 1e6,
        most_memory().map_or("?".to_owned(), |bytes| format!("{:.0} MB", bytes / 1e6)),
        driven(Live::open(knowledge)?, (floor.width(), floor.depth()))?,
    );
    Ok(())
}

/// How long a route takes in a program that holds the site, how long it is from an edit of one hardness to the next
/// route, and from an area that is drawn: the median and the most of 20 each (of areas 6), across the floor.
fn driven(mut live: Live, (width, depth): (f64, f64)) -> Result<String, Box<dyn std::error::Error>> {
    let mut pairs: Vec<[String; 2]> = Vec::new();
    let mut share = 0.0_f64;
    // points of a lattice that has no lines in common with walls
    let mut point = |from: f64, to: f64| {
        share = (share + 0.618_034).fract();
        format!(
            "{:.3},{:.3}",
            width * (from + (to - from) * share),
            depth * (0.05 + 0.9 * (share * 7.3).fract())
        )
    };
    for _ in 0..2_000 {
        let pair = [point(0.02, 0.3), point(0.7, 0.98)];
        let is_way = |answer: Answer| answer.status == Status::Ok;
        if live.route(&pair[0], &pair[1..], None).is_ok_and(is_way) {
            pairs.push(pair);
        }
        if pairs.len() == 20 {
            break;
        }
    }
    let (mut asked, mut edited) = (Vec::new(), Vec::new());
    for (number, [start, goal]) in pairs.iter().enumerate() {
        let goals = std::slice::from_ref(goal);
        let began = Instant::now();
        live.route(start, goals, None)?;
        asked.push(began.elapsed());
        let hardness = (1.0 + 0.01 * (number + 1) as f64).to_string();
        let cell = ["robots", "WALK", "hardness"].map(str::to_owned);
        let [table, key, column] = cell;
        let edit = Edit::Set(table, key, column, hardness);
        let author = Author { who: "size".to_owned(), why: "measured".to_owned() };
        let began = Instant::now();
        let outcome = live.edit(&edit, &author)?;
        live.route(start, goals, None)?;
        edited.push(began.elapsed());
        if std::env::var_os("STAGES").is_some() {
            let stages = outcome.stages.iter().map(|stage| format!("{} {:.1?}", stage.name, stage.took));
            let again = Instant::now();
            live.route(start, goals, None)?;
            eprintln!(
                "route {:.1?}; edit and route {:.1?}: {}; again {:.1?}",
                asked.last(),
                edited.last(),
                stages.collect::<Vec<_>>().join(", "),
                again.elapsed()
            );
        }
    }
    let told = |times: &mut Vec<Duration>| {
        times.sort_unstable();
        match (times.get(times.len() / 2), times.last()) {
            (Some(median), Some(most)) => {
                format!("{:.1} ms (most {:.1})", median.as_secs_f64() * 1e3, most.as_secs_f64() * 1e3)
            }
            _ => "no way found".to_owned(),
        }
    };
    let mut drawn = drawn(&mut live, (width, depth), &pairs)?;
    Ok(format!("{} | {} | {}", told(&mut asked), told(&mut edited), told(&mut drawn)))
}

/// How long it is from an area that is laid over the floor to the next route.
fn drawn(
    live: &mut Live,
    (width, depth): (f64, f64),
    pairs: &[[String; 2]],
) -> Result<Vec<Duration>, Box<dyn std::error::Error>> {
    let mut took = Vec::new();
    for (number, [start, goal]) in pairs.iter().take(6).enumerate() {
        let (x, y) = (width * (0.2 + 0.1 * number as f64), depth * (0.25 + 0.1 * number as f64));
        let edit = Edit::Lay(Lay {
            what: Thing::Area,
            name: format!("spill {number}"),
            corners: vec![[x, y], [x + 3.0, y], [x + 3.0, y + 2.0], [x, y + 2.5]],
            kind: Some("wet".to_owned()),
            properties: vec![("hardness_factor".to_owned(), "2".to_owned())],
            until: None,
        });
        let author = Author { who: "size".to_owned(), why: "measured".to_owned() };
        let began = Instant::now();
        let outcome = live.edit(&edit, &author)?;
        live.route(start, std::slice::from_ref(goal), None)?;
        took.push(began.elapsed());
        if std::env::var_os("STAGES").is_some() {
            let stages = outcome.stages.iter().map(|stage| format!("{} {:.1?}", stage.name, stage.took));
            eprintln!("an area and route {:.1?}: {}", took.last(), stages.collect::<Vec<_>>().join(", "));
        }
    }
    Ok(took)
}

/// The most memory that this process has held, where the system says so (Linux).
fn most_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kilobytes * 1024.0)
}
