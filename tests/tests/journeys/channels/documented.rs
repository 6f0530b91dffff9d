//! What rules see, what SQL keeps and what the command takes is written down.

use adit::plan::rules::Kind;

fn documented() -> String {
    std::fs::read_to_string(adit_tests::repository().join("kb/PLAN.md")).expect("kb/PLAN.md")
}

#[test]
fn every_property_that_rules_are_told() {
    let page = documented();
    for (name, _) in Kind::Channels.classes().into_iter().flat_map(|class| class.told) {
        // Of three axes the first, or first and last, stand for all.
        let first =
            |axis: &str| name.strip_suffix(axis).map_or_else(|| name.to_owned(), |stem| format!("{stem}_x"));
        let named = [
            name.to_owned(),
            first("_y"),
            first("_z"),
            first("_x").replace("_max_", "_min_"),
            first("_z").replace("_max_", "_min_"),
            first("_y").replace("_max_", "_min_"),
        ];
        assert!(named.iter().any(|name| page.contains(&format!("`{name}`"))), "{name} is not in kb/PLAN.md");
    }
}
