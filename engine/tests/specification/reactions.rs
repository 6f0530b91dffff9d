//! Rules that react: what they tell, when they come again, and in which order.

use adit_engine::{Class, KnowledgeBase};

use crate::support::{number, rules, text};

const CLOSURES: &str = r#"
    on "a door reported closed stays closed for an hour"
        each report in REPORTS where report.kind == "closed"
        none other in CLOSURES where other.door == report.door
        then {
            tell("CLOSURES", #{ door: report.door, ends: report.time + 3600 });
            report.handled = true;
            forget(report);
        }
    rule "closed doors are impassable"
        each door in DOORS
        none closure in CLOSURES where closure.door == door.door
        then { door.passable = true; }
        else { door.passable = false; }
"#;

fn doors() -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    base.assert(Class::new("DOORS", &["door"]).texts("door", ["front", "back"].map(Some))).unwrap();
    let reports = Class::new("REPORTS", &[])
        .texts("kind", [Some("open"), Some("closed"), Some("closed")])
        .texts("door", [Some("front"), Some("back"), Some("back")])
        .numbers("time", [Some(10.0), Some(20.0), Some(30.0)]);
    base.assert(reports).unwrap();
    base
}

#[test]
fn what_on_tells_is_read_by_rules() {
    let (mut base, rules) = (doors(), rules(CLOSURES));
    let run = base.react(&rules);
    assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
    assert_eq!(run.firings.len(), 1, "{:?}", run.firings);
    assert_eq!(base.len("CLOSURES"), Some(1));
    assert_eq!(number(&base, "CLOSURES", "1", "ends"), Some(3620.0));
    assert_eq!(base.len("REPORTS"), Some(2));
    assert_eq!(text(&base, "DOORS", "back", "passable").as_deref(), Some("false"));
    assert_eq!(text(&base, "DOORS", "front", "passable").as_deref(), Some("true"));
    assert_eq!(base.generation(), 1);
    assert!(base.react(&rules).firings.is_empty());
}
