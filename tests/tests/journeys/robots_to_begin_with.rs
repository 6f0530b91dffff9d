//! `adit new --robot`: machines of the sizes that they have, each with a first route; and what `new` asks a person.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::Path;
use std::process::Command;

use adit_tests::{Ran, TestSite, adit};

fn ran(folder: &Path, args: &[&str]) -> Ran {
    Ran::new(&Command::new(adit()).current_dir(folder).args(args).output().unwrap())
}

#[test]
fn each_robot_has_a_route_over_the_floor_that_it_begins_with() {
    let empty = TestSite::empty();
    for (robot, action) in
        [("cart", "DRIVE"), ("forklift", "DRIVE"), ("quadruped", "SIDE-STEP"), ("humanoid", "WALK-ON-KNEE")]
    {
        let made = ran(empty.path(), &["new", robot, "--robot", robot]).expecting(0);
        assert!(made.stdout.contains(&format!("robots.toml  {robot}")), "{}", made.stdout);
        ran(empty.path(), &["build", robot]).expect_status(0);
        ran(empty.path(), &["check", robot]).expect_status(0);
        let route = ran(empty.path(), &["route", robot, "home", "window"]).expecting(0);
        assert!(route.stdout.contains(action), "{robot}: {}", route.stdout);
    }
    // a load is a cell away: with a high one the truck leaves the aisle under the pipe
    let bare = ran(empty.path(), &["route", "forklift", "2,2", "19,2", "--json"]).expecting(0).json();
    let loaded = ["route", "forklift", "2,2", "19,2", "--load", "pallet", "--json"];
    let loaded = ran(empty.path(), &loaded).expecting(0).json();
    assert!(loaded["cost"].as_f64() > bare["cost"].as_f64(), "{bare} {loaded}");
}

#[test]
fn several_robots_are_a_fleet() {
    let empty = TestSite::empty();
    ran(empty.path(), &["new", "fleet", "--robot", "cart", "--robot", "quadruped"]).expect_status(0);
    ran(empty.path(), &["build", "fleet"]).expect_status(0);
    for robot in ["cart", "quadruped"] {
        ran(empty.path(), &["route", "fleet", "home", "window", "--robot", robot]).expect_status(0);
    }
    ran(empty.path(), &["new", "other", "--robot", "crat"])
        .expecting(2)
        .complains(&["there is no robot `crat`", "did you mean `cart`?"]);
    assert!(!empty.path().join("other").exists(), "nothing is left of it");
}

/// Types lines at a terminal, and says what was answered.
fn typed(folder: &Path, args: &[&str], lines: &str) -> String {
    const AT_A_TERMINAL: &str = "
import os, pty, sys
lines, command = sys.argv[1], sys.argv[2:]
pid, terminal = pty.fork()
if pid == 0:
    os.execv(command[0], command)
os.write(terminal, lines.encode())
said = b''
while True:
    try:
        part = os.read(terminal, 4096)
    except OSError:
        break
    if not part:
        break
    said += part
_, status = os.waitpid(pid, 0)
print(said.decode())
sys.exit(os.waitstatus_to_exitcode(status))
";
    let mut command = Command::new("python3");
    command.current_dir(folder).args(["-c", AT_A_TERMINAL, lines]).arg(adit()).args(args);
    let ran = command.output().unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8_lossy(&ran.stdout).into_owned()
}

#[test]
fn a_person_who_says_nothing_is_asked_and_enter_is_an_answer() {
    let empty = TestSite::empty();
    let said = typed(empty.path(), &["new"], "hall\n\nhorse\nquadruped\n");
    for expected in
        ["Folder of the site [my-site]", "Map: ", "there is no robot `horse`", "hall is a site now"]
    {
        assert!(said.contains(expected), "`{expected}` is not in:\n{said}");
    }
    ran(empty.path(), &["build", "hall"]).expect_status(0);
    assert!(std::fs::read_to_string(empty.path().join("hall/robots.toml")).unwrap().contains("CREEP"));
    let said = typed(empty.path(), &["new"], "\n\n\n");
    assert!(said.contains("my-site is a site now"), "{said}");
    // a program is asked nothing
    ran(empty.path(), &["new", "quiet"]).expect_status(0);
}
