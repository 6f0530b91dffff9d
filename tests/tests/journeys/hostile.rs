//! A folder of sites that nobody means well with (`tests/tests/hostile/sites`): each ends soon, in little memory, built or refused
//! in words.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use adit_tests::{Ran, TestSite, adit, repository};

/// How long a command may take, and how much memory it may ask for.
const PATIENCE: Duration = Duration::from_mins(1);
const MEMORY_KB: u64 = 4 << 20;

/// Runs a command of adit in a folder on a site or a map, killed after its time.
fn run((here, site): (&Path, &Path), words: &[&str]) -> Ran {
    let seconds = PATIENCE.as_secs();
    let limited = format!("ulimit -v {MEMORY_KB} && exec timeout -s KILL {seconds} \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &limited]).arg(adit()).arg(words[0]).arg(site).args(&words[1..]);
    let ran = command.current_dir(here).stdin(Stdio::null()).output();
    Ran::new(&ran.expect("sh runs"))
}

#[test]
fn each_of_the_hostile_sites_is_built_or_refused_soon_and_in_little() {
    let all = fs::read_dir(repository().join("tests/tests/hostile/sites")).expect("hostile sites");
    let mut names: Vec<String> =
        all.map(|entry| entry.expect("a site").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert!(names.len() > 20, "{names:?}");
    let mut wrong = Vec::new();
    for name in names {
        let site = TestSite::hostile(&name);
        for words in [&["build"][..], &["check"], &["draw", "-o", "map.svg"]] {
            wrong.extend(amiss(&name, words[0], &run((site.path(), site.path()), words)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn so_is_each_of_the_hostile_maps_of_the_other_kinds() {
    let folder = repository().join("tests/tests/hostile/worlds");
    let mut wrong = Vec::new();
    let mut count = 0;
    for entry in fs::read_dir(&folder).expect("hostile maps") {
        let file = entry.expect("a map").path();
        if file.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        count += 1;
        let here = TestSite::empty();
        for words in [&["check"][..], &["draw", "-o", "map.svg"]] {
            let ran = run((here.path(), &file), words);
            wrong.extend(amiss(&file.display().to_string(), words[0], &ran));
        }
    }
    assert!(count > 5 && wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is amiss about how a command ended; nothing where it succeeded, or said why not.
fn amiss(of: &str, verb: &str, ran: &Ran) -> Option<String> {
    let is_said = ran.status == 0 || matches!(ran.status, 1..=2) && !ran.stderr.trim().is_empty();
    let is_wrong = !is_said || ran.stderr.contains("panicked") || ran.stderr.contains("memory allocation");
    let said: String = ran.stderr.chars().take(300).collect();
    is_wrong.then(|| format!("{of}: {verb} ended with {}: {said}", ran.status))
}
