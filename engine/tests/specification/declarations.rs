//! Classes by condition, links, and where properties come from.

use adit_engine::{Class, Code, KnowledgeBase, PropertyName, RuleBase, Source, SourceFile};

use crate::support::{concluded, rules, text};

fn doors() -> Class {
    Class::new("DOORS", &["door"])
        .numbers("door", [1.0, 2.0, 3.0, 4.0].map(Some))
        .numbers("height", [Some(2.0), Some(1.2), Some(0.5), None])
        .texts("room", [Some("hall"), Some("attic"), None, Some("nowhere")])
}

fn rooms() -> Class {
    Class::new("ROOMS", &["room"])
        .texts("room", [Some("hall"), Some("attic")])
        .numbers("height", [Some(3.0), Some(1.8)])
        .texts("floor", [Some("ground"), Some("top")])
}

fn floors() -> Class {
    Class::new("FLOORS", &["floor"])
        .texts("floor", [Some("ground"), Some("top")])
        .numbers("level", [0.0, 3.0].map(Some))
}

const LINKS: &str = "
property DOORS.room names ROOMS
property ROOMS.floor names FLOORS.floor;
";

const CLASSES: &str = "
const LOW = 1.5;
class LOW_DOORS of DOORS where height < LOW
class TINY_DOORS of LOW_DOORS where height < 1
";

#[test]
fn a_class_by_condition_stands_for_the_objects_that_pass() {
    let rule = r#"
        rule "low" each door in LOW_DOORS then { door.kind = "low"; }
        rule "tiny" each door in TINY_DOORS where door.door > 0 then { door.tiny = true; }
        rule "count" each door in DOORS where door.door == 1
            count low of other in LOW_DOORS where known(other.height)
            then { door.low = low; }"#;
    let (base, _) = concluded(&format!("{CLASSES}{rule}"), [doors()]);
    let kinds: Vec<_> = base.texts("DOORS", "kind").unwrap().iter().map(Option::is_some).collect();
    assert_eq!(kinds, [false, true, true, false]);
    assert_eq!(base.truths("DOORS", "tiny").unwrap(), [None, None, Some(true), None]);
    assert_eq!(
        base.numbers("DOORS", "low").unwrap()[0],
        Some(2.0),
        "the unknown one is not known to be counted"
    );
}

#[test]
fn a_class_of_one_file_counts_in_another_with_the_constants_of_its_own() {
    let files = [
        SourceFile::new(
            "rules.rhai",
            "const LOW = 100; rule \"r\" each d in LOW_DOORS then { d.low = LOW; }",
        ),
        SourceFile::new("classes.rhai", CLASSES),
    ];
    let mut base = KnowledgeBase::new();
    base.assert(doors()).unwrap();
    base.conclude(&RuleBase::compile(&files).unwrap());
    assert_eq!(base.numbers("DOORS", "low").unwrap(), [None, Some(100.0), Some(100.0), None]);
}

#[test]
fn what_a_class_means_is_part_of_the_version_of_rules_over_it() {
    let version = |classes: &str| {
        rules(&format!("{classes} rule \"r\" each d in LOW_DOORS then {{ d.low = 1; }}")).rules()[0]
            .version()
            .to_owned()
    };
    assert_ne!(version(CLASSES), version(&CLASSES.replace("height < LOW", "height <= LOW")));
}

#[test]
fn a_path_reads_through_links() {
    let rule = r#"rule "r" each door in DOORS then {
        door.clearance = door.room.height - door.height;
        door.level = door.room.floor.level;
        door.there = known(door.room.height);
    }"#;
    let (base, _) = concluded(&format!("{LINKS}{rule}"), [doors(), rooms(), floors()]);
    let [a, b] = [3.0 - 2.0, 1.8 - 1.2].map(Some);
    assert_eq!(base.numbers("DOORS", "clearance").unwrap(), [a, b, None, None]);
    assert_eq!(base.numbers("DOORS", "level").unwrap(), [Some(0.0), Some(3.0), None, None]);
    assert_eq!(base.truths("DOORS", "there").unwrap(), [Some(true), Some(true), Some(false), Some(false)]);
}

#[test]
fn a_where_may_read_through_the_link_of_its_own_object() {
    let rule = r#"
        rule "high" each door in DOORS where door.door < 4 && door.room.height > 2 && door.room.floor.level == 0
            then { door.high = true; }
        rule "same" each door in DOORS
            some room in ROOMS where room.height == door.room.height
            then { door.same = room.room; }"#;
    let (base, _) = concluded(&format!("{LINKS}{rule}"), [doors(), rooms(), floors()]);
    assert_eq!(base.truths("DOORS", "high").unwrap(), [Some(true), None, None, None]);
    assert_eq!(text(&base, "DOORS", "2", "same").as_deref(), Some("attic"));
}

#[test]
fn interpreted_parts_and_revisions_read_through_links_too() {
    let rule = r#"
        fn twice(x) { x * 2 }
        rule "r" each door in DOORS then { door.twice = twice(door.room.height); door.hardness = 1.0; }
        revise "v" each door in DOORS where door.room.height > 1 set door.hardness by * door.room.height"#;
    let (base, _) = concluded(&format!("{LINKS}{rule}"), [doors(), rooms(), floors()]);
    assert_eq!(base.numbers("DOORS", "twice").unwrap(), [Some(6.0), Some(3.6), None, None]);
    assert_eq!(base.numbers("DOORS", "hardness").unwrap(), [Some(3.0), Some(1.8), Some(1.0), Some(1.0)]);
}

#[test]
fn what_is_read_through_a_link_may_be_concluded() {
    let rule = r#"
        rule "door" each door in DOORS where door.room.big then { door.wide = true; }
        rule "room" each room in ROOMS then { room.big = room.height > 2; }"#;
    let (base, report) = concluded(&format!("{LINKS}{rule}"), [doors(), rooms(), floors()]);
    assert_eq!(report.evaluated, ["room", "door"]);
    assert_eq!(base.truths("DOORS", "wide").unwrap(), [Some(true), None, None, None]);
    let why = base.why(&rules(&format!("{LINKS}{rule}")), "DOORS", "1", "wide").unwrap();
    assert!(format!("{why:?}").contains("hall"), "{why:?}");
}

#[test]
fn sources_are_declared_in_their_order() {
    let base = rules(
        r#"
        class LOW_DOORS of DOORS where height < 1.5
        property DOORS.passable from table, rule, default true
        property LOW_DOORS.passable from default height * 2 > 1, ask "Can one pass door {door}?";
        property DOORS.width from table, planner, ask "How wide is door {door}?"
        rule "r" each door in DOORS then { door.passable = false; }"#,
    );
    let sources =
        |class: &str, property: &str| base.declared().sources[&PropertyName::new(class, property)].clone();
    assert_eq!(sources("DOORS", "passable"), [Source::Table, Source::Rule, Source::Default("true".into())]);
    assert_eq!(
        sources("LOW_DOORS", "passable"),
        [Source::Default("height * 2 > 1".into()), Source::Ask("Can one pass door {door}?".into())]
    );
    assert_eq!(
        sources("DOORS", "width"),
        [Source::Table, Source::Planner, Source::Ask("How wide is door {door}?".into())]
    );
    assert_eq!(base.declared().root("LOW_DOORS"), "DOORS");
}

#[test]
fn the_words_that_begin_items_are_names_elsewhere() {
    let rule = r#"
        class OLD of LAMPS where class == "old"
        rule "r" each table in LAMPS where table.class == "old" && table.on
            then { table.property = table.rule; }"#;
    let lamps = Class::new("LAMPS", &[])
        .texts("class", [Some("old")])
        .truths("on", [Some(true)])
        .numbers("rule", [Some(3.0)]);
    let (base, _) = concluded(rule, [lamps]);
    assert_eq!(base.numbers("LAMPS", "property").unwrap(), [Some(3.0)]);
}

#[test]
fn an_item_that_ends_in_no_block_may_end_in_a_semicolon() {
    let base = rules(
        r#"property DOORS.height from table;
           fn twice(x) { 2 * x }
           class LOW of DOORS where twice(height) < 3;
           const LIMIT = 4;
           revise "a" each d in LOW set d.x by * LIMIT;
           fn thrice(x) { 3 * x }"#,
    );
    assert_eq!(base.declared().subclasses().collect::<Vec<_>>(), [("LOW", "DOORS")]);
    let wrong = RuleBase::compile(&[SourceFile::new("a", "property DOORS.height from table\nfn f(x) { x }")]);
    let wrong = wrong.unwrap_err().0;
    assert_eq!((wrong[0].code, wrong[0].message.as_str()), (Code::Syntax, "a `;` belongs before `fn` here"));
}
