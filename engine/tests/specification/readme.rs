//! The table of features in the README promises nothing that no test shows.

use std::fs;
use std::path::{Path, PathBuf};

fn engine() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The rows of the table, each in its three cells.
fn features(readme: &str) -> Vec<[&str; 3]> {
    let table = readme.split("| feature | here | shown by |").nth(1).expect("the table of features");
    table
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            <[&str; 3]>::try_from(cells).unwrap_or_else(|cells| panic!("{cells:?}"))
        })
        .collect()
}

/// What stands in a cell as `file.rs::test`.
fn tests_named(cell: &str) -> Vec<(&str, &str)> {
    cell.split('`').skip(1).step_by(2).filter_map(|code| code.split_once("::")).collect()
}

fn source(file: &str) -> PathBuf {
    let specification = engine().join("tests/specification");
    if Path::new(file).components().count() == 1 {
        specification.join(file)
    } else {
        engine().join("..").join(file)
    }
}

#[test]
fn every_yes_names_a_test_that_is_there() {
    let readme = fs::read_to_string(engine().join("README.md")).unwrap();
    let features = features(&readme);
    assert_eq!(features.len(), 22);
    for [feature, answer, shown_by] in features {
        let tests = tests_named(shown_by);
        assert_eq!(answer.starts_with("yes"), !tests.is_empty(), "{feature}");
        assert!(answer.starts_with("yes") || answer.starts_with("left out: "), "{feature}: {answer}");
        for (file, test) in tests {
            let text = fs::read_to_string(source(file)).unwrap_or_else(|_| panic!("{feature}: {file}"));
            let (before, _) = text
                .split_once(&format!("fn {test}("))
                .unwrap_or_else(|| panic!("{feature}: {file}::{test}"));
            let attribute = before.trim_end().lines().last().unwrap_or_default().trim();
            assert!(
                attribute.starts_with("#["),
                "{feature}: {file}::{test} is no test but follows `{attribute}`"
            );
        }
    }
}
