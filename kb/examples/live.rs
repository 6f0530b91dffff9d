//! Edits of one state's hardness on a large graph held in memory: `live SITE DOORS.u32 DOORS.csv EDITS...`.
//!
//! DOORS.u32 holds little-endian rows of door, room, room, hardness, one-way; DOORS.csv dimensions, a line a door.
//! An edit is `STATE=HARDNESS`. For each it prints the rows changed, the time of each stage, and rows a second.
#![allow(clippy::print_stdout, reason = "its result is for stdout")]

use std::error::Error;
use std::time::Instant;

use adit::edit::Edit;
use adit::{KnowledgeBase, Live, Outcome};
use adit_db::history::Author;
use adit_planners::facts::{Column, Facts, Table};
use adit_planners::planner::{Planner, PlannerError, Signature};
use adit_planners::world::World;

/// Rooms and doors of a graph, with dimensions joined to them.
struct Graph {
    doors: Vec<[u32; 5]>,
    /// Height, width and distance on either side, and the door's width.
    dimensions: Vec<[f64; 7]>,
}

impl Graph {
    fn read(doors: &str, dimensions: &str) -> Result<Self, Box<dyn Error>> {
        let bytes = std::fs::read(doors)?;
        let words: Vec<u32> =
            bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let doors: Vec<[u32; 5]> = words.chunks_exact(5).map(|r| [r[0], r[1], r[2], r[3], r[4]]).collect();
        let text = std::fs::read_to_string(dimensions)?;
        let mut dimensions = Vec::with_capacity(doors.len());
        for line in text.lines().skip(1).take(doors.len()) {
            let cells: Vec<f64> = line.split(',').skip(1).map(str::parse).collect::<Result<_, _>>()?;
            dimensions.push(<[f64; 7]>::try_from(cells).map_err(|_| "a line has eight cells")?);
        }
        if dimensions.len() < doors.len() {
            return Err("there are more doors than lines of dimensions".into());
        }
        Ok(Self { doors, dimensions })
    }
}

impl Planner for Graph {
    fn name(&self) -> &'static str {
        "graph"
    }

    fn signature(&self) -> Signature {
        Signature::new(&[], &["ROOMS.room", "ROOMS.name: text", "DOORS.door", "DOORS.kind: text"])
    }

    fn facts(&self, _: &World, _: &Facts) -> Result<Facts, PlannerError> {
        let rooms = self.doors.iter().flat_map(|door| [door[1], door[2]]).max().map_or(0, |last| last + 1);
        let side = f64::from(rooms).sqrt().ceil() as u32;
        let corner = |room: u32| [f64::from(room % side) * 3.0, f64::from(room / side) * 3.0];
        let room = |of: fn([f64; 2]) -> f64| (0..rooms).map(|room| of(corner(room))).collect::<Column>();
        let nobody = || Column::Text(vec![None; rooms as usize]);
        let of_rooms = Table::default()
            .with("room", (1..=rooms).map(f64::from).collect::<Column>())
            .with("name", (0..rooms).map(|room| format!("r{room}")).collect::<Column>())
            .with("robot", nobody())
            .with("state", nobody())
            .with("x0", room(|at| at[0]))
            .with("y0", room(|at| at[1]))
            .with("x1", room(|at| at[0] + 3.0))
            .with("y1", room(|at| at[1] + 3.0))
            .with("facing", Column::Number(vec![None; rooms as usize]))
            .with("height", Column::Number(vec![None; rooms as usize]))
            .with("width", vec![3.0; rooms as usize].into_iter().collect::<Column>());
        let door = |of: &dyn Fn(&[u32; 5]) -> f64| self.doors.iter().map(of).collect::<Column>();
        let size = |at: usize| self.dimensions.iter().map(|sizes| sizes[at]).collect::<Column>();
        let of_doors = Table::default()
            .with("door", door(&|door| f64::from(door[0]) + 1.0))
            .with("kind", self.doors.iter().map(|_| "door".to_owned()).collect::<Column>())
            .with("room1", door(&|door| f64::from(door[1]) + 1.0))
            .with("room2", door(&|door| f64::from(door[2]) + 1.0))
            .with("x", door(&|door| corner(door[1])[0] + 1.0))
            .with("y", door(&|door| corner(door[1])[1] + 1.0))
            .with("width", size(6))
            .with("x0", door(&|door| corner(door[1])[0] + 1.0))
            .with("y0", door(&|door| corner(door[1])[1] + 1.0))
            .with("x1", door(&|door| corner(door[1])[0] + 2.0))
            .with("y1", door(&|door| corner(door[1])[1] + 1.0))
            .with("height1", size(0))
            .with("width1", size(1))
            .with("distance1", size(2))
            .with("height2", size(3))
            .with("width2", size(4))
            .with("distance2", size(5))
            .with("one_way", self.doors.iter().map(|door| door[4] != 0).collect::<Column>());
        Ok(Facts::from([("ROOMS".to_owned(), of_rooms), ("DOORS".to_owned(), of_doors)]))
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [site, doors, dimensions, edits @ ..] = arguments.as_slice() else {
        return Err("usage: live SITE DOORS.u32 DOORS.csv STATE=HARDNESS...".into());
    };
    let mut site = KnowledgeBase::open(site.as_ref())?;
    site.register(Box::new(Graph::read(doors, dimensions)?));
    let began = Instant::now();
    let mut live = Live::open(site)?;
    println!("opened in {:.1} s", began.elapsed().as_secs_f64());
    let author = Author { who: "live".to_owned(), why: String::new() };
    let mut milliseconds = Vec::new();
    for edit in edits {
        let (state, hardness) = edit.split_once('=').ok_or("an edit is STATE=HARDNESS")?;
        let edit =
            Edit::Set("robots".to_owned(), state.to_owned(), "hardness".to_owned(), hardness.to_owned());
        let began = Instant::now();
        let outcome = live.edit(&edit, &author)?;
        let took = began.elapsed().as_secs_f64();
        milliseconds.push(took * 1e3);
        print(&format!("{state}={hardness}"), &outcome, took);
    }
    milliseconds.sort_by(f64::total_cmp);
    if let Some(best) = milliseconds.first() {
        println!("best {best:.1} ms, median {:.1} ms", milliseconds[milliseconds.len() / 2]);
    }
    Ok(())
}

fn print(edit: &str, outcome: &Outcome, took: f64) {
    let rows = outcome.rooms + outcome.doors + outcome.tree_rows;
    println!(
        "{edit}: {rows} rows changed ({} doors, {} of routes) in {:.1} ms, {:.0} rows a second{}",
        outcome.doors,
        outcome.tree_rows,
        took * 1e3,
        rows as f64 / took,
        if outcome.anew { ", all anew" } else { "" }
    );
    let stages =
        outcome.stages.iter().map(|stage| format!("{} {:.1} ms", stage.name, stage.took.as_secs_f64() * 1e3));
    println!("    {}", stages.collect::<Vec<_>>().join(", "));
}
