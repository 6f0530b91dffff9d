//! What the answers that an expert asks cost: `insight SIDE` makes a floor of the paper's kind with SIDE x SIDE obstacles
//! (three rooms and about six doors each), `insight offices COLUMNS ROWS` one by state, and prints a line a question.

#![allow(clippy::print_stdout, reason = "a program's output")]

use std::fmt::Write;
use std::time::{Duration, Instant};

use adit::edit::Edit;
use adit::preview::Wanted;
use adit::{KnowledgeBase, Live, Silent};
use adit_tests::floor::{Floor, Kind};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = tempfile::tempdir()?;
    let (start, goal, state) = if let [side] = arguments.as_slice() {
        std::fs::write(folder.path().join("map.toml"), papers_floor(side.parse()?)?)?;
        std::fs::write(folder.path().join("robots.toml"), STATES)?;
        let site = "name = \"large\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"paper\"\nstarts = [\"place 0\"]\n";
        std::fs::write(folder.path().join("site.toml"), site)?;
        ("place 0".to_owned(), "place 9".to_owned(), "SQUAT")
    } else if let [_, columns, rows] = arguments.as_slice() {
        let floor = Floor::new(Kind::Offices, columns.parse()?, rows.parse()?, 7);
        floor.write_site(folder.path(), 3)?;
        let (width, depth) = (floor.width(), floor.depth());
        let live = Live::open(KnowledgeBase::open(folder.path())?)?;
        let points = (0..400).map(|n| {
            let share = (f64::from(n) * 0.618_034).fract();
            format!(
                "{:.3},{:.3}",
                width * (0.02 + 0.96 * share),
                depth * (0.05 + 0.9 * (share * 7.3).fract())
            )
        });
        let points: Vec<String> =
            points.filter(|at| live.route(at, std::slice::from_ref(at), None).is_ok()).collect();
        let far = points.iter().find(|at| {
            let answer = live.route(&points[0], &[(*at).clone()], None);
            answer.is_ok_and(|answer| answer.distance.is_some_and(|metres| metres > width / 2.0))
        });
        (points[0].clone(), far.ok_or("no two points are far apart")?.clone(), "WALK")
    } else {
        return Err("insight SIDE, or insight offices COLUMNS ROWS".into());
    };
    let knowledge = KnowledgeBase::open(folder.path())?;
    let report = knowledge.build(&Silent)?;
    let live = Live::open(knowledge)?;
    println!("{} rooms, {} doors, {} stages", report.rooms.total, report.doors.total, report.stages.len());
    let set = |value: f64| {
        let [table, key, column] = ["robots", state, "hardness"].map(str::to_owned);
        Edit::Set(table, key, column, value.to_string())
    };
    let wanted = Wanted { start: &start, goal: &goal, robot: None };
    let mut times = Vec::new();
    let mut changed = 0;
    for round in 0..11 {
        let began = Instant::now();
        let preview = live.preview(&[set(2.0 + f64::from(round) / 10.0)], Some(wanted))?;
        times.push(began.elapsed());
        changed = preview.doors.changed + preview.rooms.changed;
    }
    let first = times[0];
    println!("preview: first {first:.1?}, then median {:.1?}; {changed} changed", median(&mut times));
    let widen = |metres: f64| {
        let [table, key, column] = ["robots", state, "width"].map(str::to_owned);
        Edit::Set(table, key, column, metres.to_string())
    };
    let mut times = Vec::new();
    for round in 0..3 {
        let began = Instant::now();
        live.preview(&[widen(0.7 + f64::from(round) / 100.0)], Some(wanted))?;
        times.push(began.elapsed());
    }
    println!("preview of a width: median {:.1?}", median(&mut times));
    let mut times: Vec<Duration> = (0..11)
        .map(|_| {
            let began = Instant::now();
            drop(live.fork());
            began.elapsed()
        })
        .collect();
    println!("fork: {:.1?}", median(&mut times));
    let began = Instant::now();
    let firm = live.firm(&start, &goal, None)?;
    println!("firm: {:.1?}, {} cells, truncated {}", began.elapsed(), firm.cells.len(), firm.truncated);
    for cell in &firm.cells {
        let end = |end: &Option<adit::why::firm::Beyond>| {
            end.as_ref().map_or("-".to_owned(), |end| end.way.clone())
        };
        println!(
            "  {}.{} {} in {:?} to {:?}, exact {}: {} | {}",
            cell.key,
            cell.column,
            cell.value,
            cell.low,
            cell.high,
            cell.exact,
            end(&cell.below),
            end(&cell.above)
        );
    }
    Ok(())
}

const STATES: &str =
    "[[robots]]\nstate = \"STAND\"\naction = \"WALK\"\nheight = 1.7\nwidth = 0.6\nhardness = 1.0
[[robots]]\nstate = \"SIDE-STAND\"\naction = \"SIDE-WALK\"\nheight = 1.7\nwidth = 0.35\nhardness = 2.0
[[robots]]\nstate = \"SQUAT\"\naction = \"WALK-ON-KNEE\"\nheight = 1.1\nwidth = 0.8\nhardness = 4.0
[[robots]]\nstate = \"SIDE-SQUAT\"\naction = \"SIDE-KNEE\"\nheight = 1.1\nwidth = 0.05\nhardness = 6.0
[[robots]]\nstate = \"IMPOSSIBLE\"\naction = \"NO-ACTION\"\nheight = 0.0\nwidth = 0.0\nhardness = 10000.0\n";

fn median(times: &mut [Duration]) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}

/// Obstacles of a jittered grid, a low bridge beside every fifth one, ten places.
fn papers_floor(side: usize) -> Result<String, std::fmt::Error> {
    let mut text = format!("width = {0}\ndepth = {0}\n", side * 5);
    let mut seed = 1_u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut bridges = String::new();
    text.push_str("obstacle = [\n");
    for column in 0..side {
        for row in 0..side {
            let (x, y) =
                ((column * 5) as f64 + 0.2 + 1.5 * random(), (row * 5) as f64 + 0.2 + 1.5 * random());
            let (x1, y1) = (x + 0.5 + 2.5 * random(), y + 0.5 + 2.5 * random());
            writeln!(text, "  {{ rect = [{x:.9}, {y:.9}, {x1:.9}, {y1:.9}] }},")?;
            if (column * side + row) % 50 == 7 {
                writeln!(
                    bridges,
                    "  {{ rect = [{:.9}, {y:.9}, {:.9}, {y1:.9}], height = 1.3 }},",
                    x1 + 0.1,
                    x1 + 0.4
                )?;
            }
        }
    }
    write!(text, "]\nbridge = [\n{bridges}]\n")?;
    for place in 0..10 {
        let at = 0.1 + (side as f64 * 5.0 - 0.2) * f64::from(place) / 9.0;
        let x = if place % 2 == 0 { 0.1 } else { side as f64 * 5.0 - 0.1 };
        writeln!(text, "[[place]]\nname = \"place {place}\"\nat = [{x:.3}, {at:.3}]")?;
    }
    Ok(text)
}
