//! How time, rooms and memory grow with pixels and states: `size KIND COLUMNS ROWS STATES [SEED]` makes a floor, builds
//! a site of it into a new database, without routes, and prints one line of a table; `size --head` prints its head.

#![allow(clippy::print_stdout, reason = "a program's output")]

use std::time::Instant;

use adit::{KnowledgeBase, Silent};
use adit_tests::floor::{Floor, Kind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, columns, rows, states, seed @ ..] = arguments.as_slice() else {
        println!(
            "| floor | pixels | states | rooms | doors | cut | rules | database | all | database | memory |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|---|");
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
    let took = |name: &str| {
        let stage = report.stages.iter().find(|stage| stage.name == name);
        stage.map_or(String::new(), |stage| format!("{:.2} s", stage.took.as_secs_f64()))
    };
    println!(
        "| {kind} | {columns} x {rows} | {states} | {} | {} | {} | {} | {} | {:.2} s | {:.1} MB | {} |",
        report.rooms.total,
        report.doors.total,
        took("rooms by state"),
        took("rules"),
        took("database"),
        all.as_secs_f64(),
        std::fs::metadata(knowledge.database())?.len() as f64 / 1e6,
        most_memory().map_or("?".to_owned(), |bytes| format!("{:.0} MB", bytes / 1e6)),
    );
    Ok(())
}

/// The most memory that this process has held, where the system says so (Linux).
fn most_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kilobytes * 1024.0)
}
