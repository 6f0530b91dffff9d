//! What the usual commands say, word for word: a session at a terminal, and one of slips. Read `usual/*.txt` as somebody who has never
//! seen the program; `ADIT_SAID=write cargo test --workspace --test journeys usual` writes them anew, to be read before they are kept.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use adit_tests::{adit, repository};

/// A text in which what differs from run to run is the same: moments, milliseconds, where the program lies.
fn settled(text: &str, folder: &Path) -> String {
    let program = adit().display().to_string();
    let text = text.replace(&program, "adit").replace(&folder.display().to_string(), "…");
    let mut settled = String::new();
    for line in text.split_inclusive('\n') {
        let words: Vec<&str> = line.split(' ').collect();
        for (index, word) in words.iter().enumerate() {
            if index > 0 {
                settled.push(' ');
            }
            let next = words.get(index + 1).map(|next| next.trim_end_matches([',', '\n']));
            let is_measured = next == Some("ms") && word.parse::<f64>().is_ok();
            settled.push_str(&if is_measured { "…".to_owned() } else { without_moment(word) });
        }
    }
    settled
}

/// `2026-11-24T08:00:00.123Z`, which is now, as `now` as wide as it.
fn without_moment(word: &str) -> String {
    let is_moment = word.starts_with("202") && word.get(10..11) == Some("T") && word.contains('Z');
    let Some(end) = word.find('Z').filter(|_| is_moment) else { return word.to_owned() };
    format!("{:<1$}{2}", "now", end + 1, &word[end + 1..])
}

/// Types the commands of a session, and compares what is said with what stands there.
fn session(name: &str) {
    let file = repository().join("tests/tests/journeys/usual").join(name);
    let written = fs::read_to_string(&file).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let programs = adit().parent().unwrap().display();
    let path = format!("{programs}:{}", std::env::var("PATH").unwrap());
    let mut said = String::new();
    for command in written.lines().filter_map(|line| line.strip_prefix("$ ")) {
        let mut bash = Command::new("bash");
        bash.arg("-c").arg(format!("{command} 2>&1")).current_dir(folder.path());
        let ran = bash.env("PATH", &path).env("NO_COLOR", "1").env("USER", "anna").output().unwrap();
        let text = settled(&String::from_utf8(ran.stdout).unwrap(), folder.path());
        writeln!(said, "$ {command}\n{}", text.trim_end()).unwrap();
        match ran.status.code() {
            Some(0) => said.push('\n'),
            status => writeln!(said, "[status {}]\n", status.unwrap_or(-1)).unwrap(),
        }
    }
    if std::env::var("ADIT_SAID").is_ok_and(|what| what == "write") {
        fs::write(&file, &said).unwrap();
        return;
    }
    let differ = written.lines().zip(said.lines()).find(|(written, said)| written != said);
    assert!(written == said, "{name}: first {differ:?}, in all:\n{said}");
}

#[test]
fn the_usual_commands_say_what_is_written_there() {
    session("session.txt");
}

#[test]
fn slips_are_answered_with_what_may_be_meant() {
    session("slips.txt");
}
