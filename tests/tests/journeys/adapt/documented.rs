//! What rules see and what SQL keeps is written down.

use adit::plan::rules::Kind;
use adit_tests::repository;

fn page() -> String {
    std::fs::read_to_string(repository().join("kb/ADAPT.md")).expect("kb/ADAPT.md")
}

#[test]
fn every_property_that_rules_are_told() {
    let page = page();
    for (name, _) in Kind::Adapt.classes().into_iter().flat_map(|class| class.told) {
        assert!(page.contains(&format!("`{name}`")), "{name} is not in kb/ADAPT.md");
    }
}

#[test]
fn every_table_and_column_of_experience() {
    let schema =
        std::fs::read_to_string(repository().join("db/sql/v5/50-experience.sql")).expect("the schema");
    let page = page();
    let mut row = "";
    for line in schema.lines() {
        if let Some(rest) = line.strip_prefix("CREATE TABLE IF NOT EXISTS ") {
            let table = rest.split(' ').next().expect("a name");
            row = page
                .lines()
                .find(|line| line.starts_with(&format!("| `{table}` |")))
                .unwrap_or_else(|| panic!("{table} is not in kb/ADAPT.md"));
        }
        let column = line.strip_prefix("  ").and_then(|line| line.split(' ').next());
        if let Some(column) = column.filter(|column| column.starts_with(|c: char| c.is_ascii_lowercase())) {
            assert!(row.contains(column), "{column} is not in {row}");
        }
    }
}
