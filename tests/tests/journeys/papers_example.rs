//! Abou-Ali's example, Tables 2, 3 and 7, through the program and through SQL clients that know nothing of ours.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::process::Command;

use adit_tests::{Ran, TestSite};

fn example() -> TestSite {
    TestSite::example("paper").built()
}

#[test]
fn table_2_prime_areas_and_their_strings() {
    let rows = example().sqlite3("SELECT left_string || ' - ' || right_string FROM prime_areas ORDER BY 1");
    let table_2 = [
        "00001 - 11111",
        "00100 - 11111",
        "00111 - 11000",
        "10000 - 11111",
        "11100 - 00011",
        "11111 - 00001",
        "11111 - 10000",
    ];
    assert_eq!(rows, table_2);
}

#[test]
fn table_3_rooms_in_order() {
    let rows = example().sqlite3("SELECT name, x0, y0, x1, y1, height, width FROM rooms ORDER BY room");
    let table_3 = [
        "a|19.1|0.0|29.5|6.0|4.0|6.0",
        "b|29.5|9.6|44.7|16.5|15.0|6.9",
        "c|62.7|0.0|93.7|41.1||31.0",
        "d|0.0|16.5|44.7|41.1||24.6",
        "e|29.5|0.0|62.7|9.6||9.6",
        "f|0.0|0.0|19.1|16.5||16.5",
        "g|44.7|34.0|62.7|41.1||7.1",
    ];
    assert_eq!(rows, table_3);
}

#[test]
fn the_eight_doors_weigh_as_in_the_golden_file() {
    let rows = example().sqlite3(
        "SELECT door, a.name, b.name, round(d.width, 6), round(distance1, 6), round(distance2, 6),
                round(d.hardness, 6), d.action, d.passable
         FROM doors d JOIN rooms a ON a.room = room1 JOIN rooms b ON b.room = room2 ORDER BY door",
    );
    let golden = [
        "1|a|e|6.0|5.2|16.697305|10000.0|NO-ACTION|0",
        "2|a|f|6.0|5.2|10.897936|10000.0|NO-ACTION|0",
        "3|b|d|15.2|3.45|19.205533|37.005533|WALK-ON-KNEE|1",
        "4|b|e|15.2|3.45|10.2|28.0|WALK-ON-KNEE|1",
        "5|c|e|9.6|22.097794|16.6|39.697794|WALK|1",
        "6|c|g|7.1|23.005434|9.0|33.005434|WALK|1",
        "7|d|f|19.1|17.751901|8.25|27.001901|WALK|1",
        "8|d|g|7.1|24.001771|9.0|34.001771|WALK|1",
    ];
    assert_eq!(rows, golden);
}

#[test]
fn table_7_room_costs_and_the_doors_they_are_entered_by() {
    let rows = example().sqlite3(
        "SELECT name, round(cost, 6), from_door FROM routes JOIN rooms USING (room) WHERE start = 'f' ORDER BY name",
    );
    let table_7 = [
        "a||",
        "b|64.007434|3",
        "c|94.009106|6",
        "d|27.001901|7",
        "e|92.007434|4",
        "f|0.0|",
        "g|61.003672|8",
    ];
    assert_eq!(rows, table_7);
}

const SEQUENCE: &str = "SELECT step, kind, place, action, round(cost, 3) FROM action_sequence \
                        WHERE start = 'f' AND goal = 'e' ORDER BY step";
const F_TO_E: [&str; 7] = [
    "1|room|f|WALK|0.0",
    "2|door|7|WALK|27.002",
    "3|room|d|WALK|27.002",
    "4|door|3|WALK-ON-KNEE|64.007",
    "5|room|b|WALK-ON-KNEE|64.007",
    "6|door|4|WALK-ON-KNEE|92.007",
    "7|room|e|WALK|92.007",
];

#[test]
fn the_action_sequence_in_the_plain_sqlite3_shell() {
    assert_eq!(example().sqlite3(SEQUENCE), F_TO_E);
}

const PYTHON: &str = "import sqlite3, sys
db = sqlite3.connect('file:' + sys.argv[1] + '?mode=ro', uri=True)
for row in db.execute(sys.argv[2]):
    print('|'.join('' if v is None else str(v) for v in row))";

#[test]
fn the_action_sequence_from_python() {
    let site = example();
    let mut python = Command::new("python3");
    python.args(["-c", PYTHON]).arg(site.path().join("site.db")).arg(SEQUENCE);
    let ran = Ran::new(&python.output().unwrap()).expecting(0);
    assert_eq!(ran.stdout.lines().collect::<Vec<_>>(), F_TO_E);
}

#[test]
fn the_action_sequence_from_a_folder_that_nobody_may_write() {
    let site = example();
    let db = site.path().join("site.db");
    Command::new("chmod").args(["-R", "a=rX"]).arg(site.path()).status().unwrap();
    for mut client in [
        {
            let mut shell = as_nobody("sqlite3");
            shell.arg("-readonly").arg(&db).arg(SEQUENCE);
            shell
        },
        {
            let mut python = as_nobody("/usr/bin/python3");
            python.args(["-c", PYTHON]).arg(&db).arg(SEQUENCE);
            python
        },
        {
            let mut adit = as_nobody(adit_tests::adit().to_str().unwrap());
            adit.arg("sql").arg(site.path()).arg(SEQUENCE);
            adit
        },
    ] {
        let ran = Ran::new(&client.output().unwrap()).expecting(0);
        let rows: Vec<_> = ran.stdout.lines().filter(|line| line.contains('|')).collect();
        assert_eq!(rows.iter().rev().take(7).rev().copied().collect::<Vec<_>>(), F_TO_E);
    }
    Command::new("chmod").args(["-R", "u+w"]).arg(site.path()).status().unwrap();
}

/// A program without root's right to write everywhere.
fn as_nobody(program: &str) -> Command {
    let root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout == b"0\n");
    if !root {
        return Command::new(program);
    }
    let mut command = Command::new("setpriv");
    command.args(["--reuid=65534", "--regid=65534", "--clear-groups", program]);
    command
}

#[test]
fn room_a_is_unreachable_and_the_reason_names_the_door_and_what_would_fit() {
    let site = example();
    assert_eq!(site.sqlite3("SELECT status FROM route WHERE start = 'f' AND goal = 'a'"), ["no_route"]);
    let ran = site.adit("route", &["f", "a", "--json"]).expecting(1);
    let answer = ran.json();
    assert_eq!(answer["status"], "no_route");
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.contains("door 2") && reason.contains('4'), "{reason}");
}

#[test]
fn a_route_from_a_room_to_itself_says_so() {
    let answer = example().adit("route", &["f", "f", "--json"]).expecting(0).json();
    assert_eq!(answer["status"], "same_room");
}

#[test]
fn a_start_that_does_not_exist_is_an_error_with_a_suggestion() {
    let ran = example().adit("route", &["hme", "e", "--json"]).expecting(2);
    assert_eq!(ran.json()["status"], "unknown_start");
    ran.complains(&["hme", "home"]);
}

#[test]
fn the_view_reaches_its_rows_by_key() {
    let plan = example().sqlite3(&format!("EXPLAIN QUERY PLAN {SEQUENCE}"));
    let scans: Vec<_> = plan
        .iter()
        .filter(|line| {
            line.contains("SCAN") && !line.contains("VIRTUAL TABLE") && !line.contains("CONSTANT ROW")
        })
        .filter(|line| {
            !["SCAN w", "SCAN walk", "SCAN step", "SCAN s"].iter().any(|own| line.trim_end().ends_with(own))
        })
        .collect();
    assert!(scans.is_empty(), "{scans:?}\nin\n{}", plan.join("\n"));
}
