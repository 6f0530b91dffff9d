//! Loads a graph of the routing peers into a database: `load_graph DOORS.u32 ROOMS OUT.db START...`, and says how long
//! the rows of its trees took.
#![allow(clippy::print_stdout, reason = "its result is for stdout")]

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use adit_db::Store;

#[path = "../benches/support/graph.rs"]
mod graph;

use graph::{Edge, Graph};

/// Little-endian u32 rows: door, a, b, hardness, one-way.
fn read(path: &Path, rooms: usize) -> std::io::Result<Graph> {
    let bytes = std::fs::read(path)?;
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let edge = |row: &[u32]| Edge {
        a: row[1] as usize,
        b: row[2] as usize,
        hardness: f64::from(row[3]),
        one_way: row[4] != 0,
    };
    Ok(Graph { rooms, edges: words.chunks_exact(5).map(edge).collect() })
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [doors, rooms, out, starts @ ..] = arguments.as_slice() else {
        return Err("usage: load_graph DOORS.u32 ROOMS OUT.db START...".into());
    };
    let graph = read(Path::new(doors), rooms.parse()?)?;
    let starts: Vec<usize> = starts.iter().map(|start| start.parse()).collect::<Result<_, _>>()?;
    let mut store = Store::create(out)?;
    graph.fill(&mut store, &[])?;

    let neighbours = graph.neighbours();
    let trees: Vec<_> = starts.iter().map(|&start| graph.tree(&neighbours, start)).collect();
    let begin = Instant::now();
    let rows = store.transaction(|tx| {
        let name = |&start: &usize| adit_db::tree::Start {
            name: graph::name(start),
            robot: "robot".into(),
            tree: start as i64 + 1,
        };
        tx.replace_starts(&starts.iter().map(name).collect::<Vec<_>>())?;
        let rows = starts.iter().zip(&trees);
        tx.put_trees(rows.flat_map(|(&start, tree)| tree.iter().map(move |row| (start as i64 + 1, *row))))
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    println!("{rows} tree rows in {seconds:.2} s, {:.0} a second", rows as f64 / seconds);
    Ok(())
}
