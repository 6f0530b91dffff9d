//! The scripts beside peers run, at their smallest size: what they measure is not judged here.

use std::process::Command;

use adit_tests::{Ran, adit, repository, untold};

/// Runs a script. What it needs may be missing here: that is said loudly, and nothing is tested.
fn runs(script: &str, words: &[&str]) {
    // so that two of them do not build it at once
    adit();
    let work = tempfile::tempdir().expect("a temporary folder");
    let mut bash = untold(Command::new("bash"));
    bash.arg(repository().join("tests/peers").join(script));
    if ["routing.sh", "postgres.sh"].contains(&script) {
        let shared =
            std::env::var_os("ADIT_SHARED").map_or_else(|| repository().join("../shared"), Into::into);
        bash.arg(shared.join("peers/routing"));
    }
    let ran = bash.arg(work.path()).env("SMALLEST", "1").current_dir(repository()).output();
    let ran = Ran::new(&ran.expect("bash runs")).expecting(0);
    if let Some(missing) = ran.stderr.lines().find(|line| line.starts_with("SKIPPED")) {
        eprintln!("\n!!! {script}: {missing}: this test has tested nothing !!!\n");
        return;
    }
    for word in words {
        assert!(ran.stdout.contains(word), "{script}: `{word}` is not in\n{}\n{}", ran.stdout, ran.stderr);
    }
}

#[test]
fn rooms() {
    runs("rooms.sh", &["primes_ms", "greedy_ms", "prime areas grow"]);
}

#[test]
fn spaces() {
    runs("spaces.sh", &["empty plans: 1; MCC", "the slowest took"]);
}

#[test]
fn rules() {
    runs("rules.sh", &["Full weighting", "sum of hardness, 1,000 doors"]);
}

#[test]
fn live() {
    runs("live.sh", &["opened in", "FLAT=10000", "rows changed"]);
}

#[test]
fn routing() {
    runs("routing.sh", &["1000 rooms: the view takes"]);
}

#[test]
fn postgres() {
    runs("postgres.sh", &["1000 rooms: a stored route"]);
}

#[test]
fn planning() {
    runs("planning.sh", &["RRTConnect", "assembly: length"]);
}

#[test]
fn adapt() {
    runs("adapt.sh", &["two-link-A", "two-link-B"]);
}

#[test]
fn serve() {
    runs("serve.sh", &["a saved cell, in the next answer", "median ratio"]);
}

#[test]
fn crowd() {
    runs("crowd.sh", &["routes: p99 alone", "maps: p99 alone"]);
}

#[test]
fn size() {
    runs("size.sh", &["| offices |"]);
}

#[test]
fn no_script_is_left_out() {
    let source = std::fs::read_to_string(repository().join("tests/tests/peers.rs")).expect("this file");
    for entry in std::fs::read_dir(repository().join("tests/peers")).expect("the scripts").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_script = entry.path().extension().is_some_and(|ending| ending == "sh");
        assert!(!is_script || source.contains(&format!("runs(\"{name}\"")), "{name} is run by no test");
    }
}
