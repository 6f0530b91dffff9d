//! One stored route through the public view, and rows of trees written: `cargo bench -p adit-db`.

use std::cell::RefCell;

use adit_db::Store;
use adit_db::tree::TreeRow;
use divan::Bencher;
use divan::counter::ItemsCount;
use sqlx::{Connection, Row, SqliteConnection};
use tempfile::TempDir;

#[path = "support/building.rs"]
mod building;
#[path = "support/graph.rs"]
mod graph;

use building::{Chance, building};
use graph::{name, root};

fn main() {
    divan::main();
}

fn site() -> (TempDir, Store) {
    let folder = tempfile::tempdir().expect("the temporary folder can be written");
    let store = Store::create(folder.path().join("site.db")).expect("a new database can be made");
    (folder, store)
}

/// All columns of `SELECT * FROM action_sequence WHERE start = ? AND goal = ? ORDER BY step`, through sqlx.
#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 200)]
fn one_route(bencher: Bencher, rooms: usize) {
    let (_folder, mut store) = site();
    let mut chance = Chance(7);
    let starts: Vec<usize> = (0..5).map(|_| chance.below(rooms)).collect();
    building(rooms).fill(&mut store, &starts).expect("the building is consistent");
    let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime starts");
    let url = format!("sqlite://{}", store.path().display());
    let connection = runtime.block_on(SqliteConnection::connect(&url)).expect("the database opens");
    let shared = RefCell::new((runtime, connection));
    bencher.with_inputs(|| (name(starts[chance.below(5)]), name(chance.below(rooms)))).bench_local_values(
        |(start, goal)| {
            let (runtime, connection) = &mut *shared.borrow_mut();
            let query =
                sqlx::query("SELECT * FROM action_sequence WHERE start = ? AND goal = ? ORDER BY step");
            let rows = runtime.block_on(query.bind(start).bind(goal).fetch_all(connection));
            rows.expect("the view answers").iter().map(Row::len).sum::<usize>()
        },
    );
}

/// Trees of 1,000 rooms in one transaction, as a build writes them.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn tree_rows(bencher: Bencher) {
    const TREES: usize = 500;
    const ROOMS: usize = 1_000;
    bencher.counter(ItemsCount::new(TREES * ROOMS)).with_inputs(site).bench_values(|(folder, mut store)| {
        let rows = (0..TREES).flat_map(|tree| (0..ROOMS).map(move |room| (tree as i64, row(room))));
        let written = store.transaction(|tx| tx.put_trees(rows)).expect("the rows are written");
        assert_eq!(written, (TREES * ROOMS) as u64);
        (folder, store)
    });
}

fn row(room: usize) -> TreeRow {
    TreeRow {
        prev: Some(room as i64 * 7 % 1_000),
        door: Some(room as i64 * 13 % 1_250),
        hops: room as i64 % 60,
        reach: room as f64 * 1.25,
        heading: Some((room % 360) as f64),
        ..root(room)
    }
}
