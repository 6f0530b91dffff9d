//! The paper's example, read through the public views.

use adit_db::query::Limits;
use adit_db::{Cell, Store};

use crate::paper::{self, ROBOT};

#[test]
fn from_f_to_e_the_robot_kneels_under_the_bridge() {
    let (_folder, mut store) = paper::site();
    let steps = store.snapshot(|tx| tx.action_sequence(ROBOT, "f", "e")).unwrap();
    let read: Vec<_> =
        steps.iter().map(|s| (s.step, &*s.kind, &*s.place, s.action.as_deref().unwrap())).collect();
    assert_eq!(
        read,
        [
            (1, "room", "f", "WALK"),
            (2, "door", "7", "WALK"),
            (3, "room", "d", "WALK"),
            (4, "door", "3", "WALK-ON-KNEE"),
            (5, "room", "b", "WALK-ON-KNEE"),
            (6, "door", "4", "WALK-ON-KNEE"),
            (7, "room", "e", "WALK"),
        ]
    );
    let costs: Vec<String> = steps.iter().map(|s| format!("{:.3}", s.cost)).collect();
    assert_eq!(costs, ["0.000", "27.002", "27.002", "64.007", "64.007", "92.007", "92.007"]);
}

#[test]
fn what_the_steps_add_sums_up_to_the_cost() {
    let (_folder, mut store) = paper::site();
    let steps = store.snapshot(|tx| tx.action_sequence(ROBOT, "f", "c")).unwrap();
    let mut sum = 0.0;
    for step in &steps {
        sum += step.hardness.unwrap();
        assert_eq!(sum.to_bits(), step.cost.to_bits(), "step {}", step.step);
    }
}

#[test]
fn each_step_says_where_it_ends_and_which_rule_spoke() {
    let (_folder, mut store) = paper::site();
    let steps = store.snapshot(|tx| tx.action_sequence(ROBOT, "f", "e")).unwrap();
    let first = &steps[0];
    assert_eq!((first.x, first.y, first.heading), (Some(9.55), Some(16.5), Some(90.0)));
    assert_eq!(first.rule.as_deref(), Some("walk in a room"));
    assert_eq!(steps[1].rule.as_deref(), Some("weigh a door"));
    let last = &steps[6];
    assert_eq!((last.x, last.y, last.heading), (Some(37.1), Some(9.6), None));
    assert!(steps.iter().all(|step| step.state.is_none()));
}

#[test]
fn every_room_has_its_cost_and_entering_door_and_room_a_has_none() {
    let (_folder, mut store) = paper::site();
    let routes = store.snapshot(|tx| tx.routes(ROBOT, "f")).unwrap();
    let read: Vec<_> = routes
        .iter()
        .map(|r| (r.room, r.cost.map(|cost| format!("{cost:.6}")), r.from_door, r.from_room))
        .collect();
    let row = |room, cost: &str, door, from| (room, Some(cost.to_owned()), Some(door), Some(from));
    assert_eq!(
        read,
        [
            (1, None, None, None),
            row(2, "64.007434", 3, 4),
            row(3, "94.009106", 6, 7),
            row(4, "27.001901", 7, 6),
            row(5, "92.007434", 4, 2),
            (6, Some("0.000000".into()), None, None),
            row(7, "61.003672", 8, 4),
        ]
    );
}

fn status(store: &mut Store, start: &str, goal: &str) -> Option<(String, Option<i64>)> {
    let route = store.snapshot(|tx| tx.route(ROBOT, start, goal)).unwrap();
    route.map(|route| (route.status, route.steps))
}

#[test]
fn a_route_says_why_there_is_none() {
    let (_folder, mut store) = paper::site();
    let is = |status: &str, steps| Some((status.to_owned(), steps));
    assert_eq!(status(&mut store, "f", "e"), is("ok", Some(7)));
    assert_eq!(status(&mut store, "home", "e"), is("ok", Some(7)));
    assert_eq!(status(&mut store, "f", "home"), is("same_room", Some(1)));
    assert_eq!(status(&mut store, "f", "a"), is("no_route", None));
    assert_eq!(status(&mut store, "e", "f"), is("not_kept", None));
    assert_eq!(status(&mut store, "f", "nowhere"), None);
}

#[test]
fn prime_areas_print_the_strings_of_table_2() {
    let (_folder, store) = paper::site();
    let answer = store.query(
        "SELECT left_string || ' - ' || right_string FROM prime_areas ORDER BY area",
        &Limits::default(),
    );
    let strings: Vec<Cell> = answer.unwrap().rows.into_iter().flatten().collect();
    let table_2 = [
        "00001 - 11111",
        "00100 - 11111",
        "00111 - 11000",
        "10000 - 11111",
        "11100 - 00011",
        "11111 - 00001",
        "11111 - 10000",
    ];
    assert_eq!(strings, table_2.map(Cell::from));
}

#[test]
fn what_was_written_is_read_back() {
    let (_folder, mut store) = paper::site();
    store
        .snapshot(|tx| {
            assert_eq!(tx.rooms()?, paper::rooms());
            assert_eq!(tx.doors()?, paper::doors());
            assert_eq!(tx.areas()?.len(), 7);
            assert_eq!(tx.states()?.len(), 5);
            Ok::<_, adit_db::Error>(())
        })
        .unwrap();
}
