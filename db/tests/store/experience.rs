//! What a robot learned in a cell: each task is kept as a step, whole or not at all.

use adit_db::experience::{Cell, Clearance, Edge, Experience, Pair, Removed, Step, Subgoal, Tag, Task};
use adit_db::{Error, Store};

use crate::made::{self, Led};

fn keep(store: &mut Store, step: &Step) -> Result<(), Error> {
    store.led().transaction(|tx| tx.keep_step(step))
}

fn kept(store: &mut Store) -> Option<Experience> {
    store.snapshot(|tx| tx.experience("bench")).unwrap()
}

fn cell(tasks: i64) -> Cell {
    Cell {
        cell: "bench".to_owned(),
        robot: "an arm".to_owned(),
        seed: u64::MAX.to_string(),
        tasks,
        next_subgoal: 3,
        next_edge: 2,
        configuration: vec![0.1, 1.0 / 3.0],
        stands: Some(1),
        figures: "{}".to_owned(),
        ..Cell::default()
    }
}

fn subgoal(number: i64) -> Subgoal {
    let tag = Tag { object: "a \"fixture\"; --".to_owned(), tool: [0.1, -0.2, 1e-300], branch: 1 };
    Subgoal {
        subgoal: number,
        configuration: vec![f64::from(number as i32) / 7.0],
        tag: Some(tag),
        made_task: 1,
    }
}

fn edge(number: i64, ends: [i64; 2]) -> Edge {
    Edge {
        edge: number,
        ends,
        via: vec![vec![0.1, 0.7]],
        length: 0.1 + 0.2,
        made_task: 1,
        verified_task: 1,
        times_verified: 1,
        ..Edge::default()
    }
}

/// Three subgoals, two edges, two pairs that were looked at, two clearances.
fn first() -> Step {
    let free = Clearance { object: "box".to_owned(), a: [0.0, 0.1], b: Some([1.0, 0.1]), within: 0.3 };
    let taken = Clearance { b: None, within: 0.0, ..free.clone() };
    Step {
        cell: cell(1),
        subgoals: (0..3).map(subgoal).collect(),
        edges: vec![edge(0, [0, 1]), edge(1, [1, 2])],
        subgoal_pairs: [true, false].map(|tightened| Pair { ends: [0, 2], tightened, revision: 0 }).to_vec(),
        clearances: vec![free, taken],
        tasks: vec![Task { task: 1, goal: "load".to_owned(), ..Task::default() }],
        ..Step::default()
    }
}

#[test]
fn what_a_task_taught_is_read_back_to_the_bit() {
    let (_folder, mut store) = made::worlds();
    let step = first();
    keep(&mut store, &step).unwrap();
    let found = kept(&mut store).unwrap();
    assert_eq!((found.cell, found.subgoals, found.edges), (step.cell, step.subgoals, step.edges));
    assert_eq!(found.clearances, step.clearances);
    assert_eq!(found.subgoal_pairs.len(), 2);
}

#[test]
fn a_later_task_changes_what_is_there() {
    let (_folder, mut store) = made::worlds();
    keep(&mut store, &first()).unwrap();
    let gone = |number| Removed { number, task: 2, because: "broken", revision: Some(1), object: None };
    let later = Step {
        cell: Cell { revision: 1, ..cell(2) },
        moved: vec![(1, vec![0.25, 0.5])],
        edges_changed: vec![Edge { times_verified: 2, ..edge(0, [0, 1]) }],
        edges_removed: vec![gone(1)],
        subgoals_removed: vec![gone(2)],
        subgoal_pairs: vec![Pair { ends: [0, 2], tightened: true, revision: 1 }],
        clearances_forgotten: vec!["box".to_owned()],
        ..Step::default()
    };
    keep(&mut store, &later).unwrap();
    let found = kept(&mut store).unwrap();
    assert_eq!((found.cell.tasks, found.cell.revision), (2, 1));
    let left: Vec<_> = found.subgoals.iter().map(|s| (s.subgoal, s.configuration.clone())).collect();
    assert_eq!(left, [(0, vec![0.0]), (1, vec![0.25, 0.5])]);
    assert_eq!(found.edges, later.edges_changed);
    let of_now: Vec<_> = found.subgoal_pairs.iter().filter(|pair| pair.revision == 1).collect();
    assert_eq!(of_now, later.subgoal_pairs.iter().collect::<Vec<_>>());
    assert!(found.clearances.is_empty());
}

#[test]
fn what_is_forgotten_goes_before_what_is_learned_anew() {
    let (_folder, mut store) = made::worlds();
    keep(&mut store, &first()).unwrap();
    let anew = Step {
        cell: Cell { next_subgoal: 4, ..cell(2) },
        forgotten: Some(2),
        subgoals: vec![subgoal(3)],
        ..Step::default()
    };
    keep(&mut store, &anew).unwrap();
    let found = kept(&mut store).unwrap();
    assert_eq!(found.subgoals, anew.subgoals);
    assert!(found.edges.is_empty() && found.subgoal_pairs.is_empty() && found.clearances.is_empty());
}

#[test]
fn a_step_that_is_refused_leaves_nothing_behind() {
    let (_folder, mut store) = made::worlds();
    keep(&mut store, &first()).unwrap();
    let before = kept(&mut store);

    let mut no_number = Step { cell: cell(2), edges: vec![edge(2, [0, 2])], ..Step::default() };
    no_number.edges[0].length = f64::NAN;
    let error = keep(&mut store, &no_number).unwrap_err();
    assert!(matches!(error, Error::NotANumber { table: "edges", column: "length" }), "{error}");
    assert_eq!(kept(&mut store), before);

    let no_end = Step { cell: cell(2), edges: vec![edge(2, [0, 9])], ..Step::default() };
    let error = keep(&mut store, &no_end).unwrap_err();
    assert!(error.to_string().contains("edges"), "{error}");
    assert_eq!(kept(&mut store), before);

    let twice = Step { cell: cell(2), subgoals: vec![subgoal(0)], ..Step::default() };
    let error = keep(&mut store, &twice).unwrap_err();
    assert!(error.to_string().contains("subgoals.subgoal"), "{error}");
    assert_eq!(kept(&mut store), before);
}
