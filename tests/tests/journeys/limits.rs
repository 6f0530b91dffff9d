//! The table of limits in SECURITY.md says what the code says.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fs;

use adit_tests::repository;

/// 1024 as `1,024`.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).unwrap()).collect();
    groups.join(",")
}

/// A value of the code as people read it: `2 << 20` as `2 MB`.
fn said(value: &str) -> String {
    let value = value.trim().replace('_', "");
    if let Some(both) = value.strip_prefix('(').and_then(|value| value.strip_suffix(')')) {
        return both.split(", ").map(said).collect::<Vec<_>>().join(", ");
    }
    if let Some(seconds) =
        value.split_once("fromsecs(").map(|(_, rest)| rest.trim_end_matches(')').to_owned())
    {
        return format!("{seconds} s");
    }
    let value = value.replace("64 * 1024", "64 << 10");
    match value.split_once(" << ") {
        Some((count, "20")) => format!("{count} MB"),
        Some((count, "10")) => format!("{count} kB"),
        _ => grouped(value.parse().unwrap_or_else(|_| panic!("`{value}` is no number"))),
    }
}

#[test]
fn each_limit_that_is_told_is_the_one_that_holds() {
    let page = fs::read_to_string(repository().join("SECURITY.md")).unwrap();
    let (_, table) = page.split_once("| of | at most | in |").unwrap();
    let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let mut count = 0;
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let (told, named) = (cells[1], cells[2].replace('`', ""));
        let (file, name) = named.split_once(' ').unwrap();
        let text =
            fs::read_to_string(repository().join(file)).unwrap_or_else(|_| panic!("{file} is not there"));
        let (_, rest) =
            text.split_once(&format!("const {name}: ")).unwrap_or_else(|| panic!("{file} has no {name}"));
        let (value, _) = rest.split_once(" = ").unwrap().1.split_once(';').unwrap();
        assert_eq!(told, said(value), "{named}");
        count += 1;
    }
    assert!(count > 30, "{count} limits");
}
