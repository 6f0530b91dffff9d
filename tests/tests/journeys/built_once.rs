//! What the demo built is not built again for the tests: each crate has the features that the tests' crates want, too.

use std::collections::BTreeSet;

use adit_tests::{Ran, cargo};

/// The crates of others in what is built, with version and features.
fn crates(of: &[&str]) -> BTreeSet<String> {
    let mut cargo = cargo();
    cargo.args(["tree", "--locked", "--prefix", "none", "--format", "{p} [{f}]"]).args(of);
    let ran = cargo.output().expect("cargo runs");
    let said = Ran::new(&ran).expecting(0).stdout;
    // a crate that was shown before is marked so; our own have a path behind their version
    let lines = said.lines().map(|line| line.trim_end_matches(" (*)"));
    lines.filter(|line| !line.contains(" (/")).map(str::to_owned).collect()
}

#[test]
fn each_crate_of_the_program_has_the_features_that_it_has_in_tests() {
    let program = crates(&["--package", "adit", "--edges", "normal,build"]);
    let all = crates(&["--workspace", "--edges", "normal,build,dev"]);
    assert!(program.len() > 200, "{program:#?}");
    let twice: Vec<&String> = program.difference(&all).collect();
    assert!(
        twice.is_empty(),
        "tests turn on more features of these, so that they and all that stands on them are built twice; name the features \
         in kb/Cargo.toml, below `Used by others`: {twice:#?}"
    );
}
