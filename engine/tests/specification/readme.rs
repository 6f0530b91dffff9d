//! The README promises nothing that no test shows, and the rules in it are rules. Its example runs as a test of the
//! documentation.

use std::fs;
use std::path::{Path, PathBuf};

use adit_engine::{RuleBase, Schema, SourceFile, Type};

fn engine() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn readme() -> String {
    fs::read_to_string(engine().join("README.md")).unwrap()
}

/// The rows of the table with this head, each in its three cells.
fn table<'r>(readme: &'r str, head: &str) -> Vec<[&'r str; 3]> {
    let (_, table) = readme.split_once(head).unwrap_or_else(|| panic!("no table {head}"));
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
    let readme = readme();
    let features = table(&readme, "| feature | here | shown by |");
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

#[test]
fn every_form_that_it_shows_can_be_read() {
    let readme = readme();
    let forms = table(&readme, "| form | what it is for | it looks like |");
    let shown: Vec<&str> = forms
        .iter()
        .flat_map(|[_, _, example]| example.split('`').skip(1).step_by(2))
        .filter(|example| !example.contains('…'))
        .collect();
    assert!(shown.len() >= 8, "{shown:?}");
    for example in shown {
        RuleBase::compile(&[SourceFile::new("form.rhai", example)])
            .unwrap_or_else(|wrong| panic!("{example}\n{wrong}"));
    }
}

#[test]
fn the_decision_table_that_it_shows_has_no_faults() {
    let readme = readme();
    let (_, block) = readme.split_once("```rhai\n").unwrap();
    let (block, _) = block.split_once("```").unwrap();
    let rules = RuleBase::compile(&[SourceFile::new("table.rhai", block)]).unwrap();
    let plants = Schema::default().class("PLANTS", &[("kind", Type::Text), ("days_dry", Type::Number)]);
    let problems = rules.check(&plants);
    assert!(problems.is_empty(), "{problems:?}");
}
