//! A change costs what depends on it, whatever else there is.

use adit_engine::{Changes, Class, KnowledgeBase};

use crate::support::{robots, rules};

const WEIGH: &str = r#"
    rule "the way through"
        each door in DOORS
        least state in ROBOTS by hardness where state.height < door.height && state.width < door.width
        then { door.hardness = state.hardness; }
    rule "hard doors"
        each door in DOORS where door.hardness > 2
        then { door.hard = true; }
"#;

/// Doors of which one in ten is so low that only who lies fits.
fn doors(count: usize) -> KnowledgeBase {
    let mut base = KnowledgeBase::new();
    base.assert(robots()).unwrap();
    base.assert(
        Class::new("DOORS", &["door"])
            .numbers("door", (1..=count).map(|n| Some(n as f64)))
            .numbers("height", (1..=count).map(|n| Some(if n % 10 == 0 { 6.0 } else { 30.0 })))
            .numbers("width", (1..=count).map(|_| Some(30.0))),
    )
    .unwrap();
    base
}

fn objects(changes: &Changes, rule: &str) -> usize {
    changes.evaluated.iter().filter(|(name, _)| name == rule).map(|(_, objects)| objects).sum()
}

#[test]
fn a_change_is_paid_for_by_what_depends_on_it() {
    let rules = rules(WEIGH);
    let mut base = doors(2_000);
    base.conclude(&rules);

    base.tell("DOORS", "7", "width", Some(25.0.into())).unwrap();
    let changes = base.update(&rules);
    assert_eq!(objects(&changes, "the way through"), 1, "one door's width");
    assert_eq!(objects(&changes, "hard doors"), 0, "its hardness is what it was");

    base.tell("ROBOTS", "robot/LIE-FACE-DOWN", "hardness", Some(9.0.into())).unwrap();
    let changes = base.update(&rules);
    assert_eq!(changes.rows("DOORS", "hardness").len(), 200);
    assert_eq!(objects(&changes, "the way through"), 200, "the low doors");
    assert_eq!(objects(&changes, "hard doors"), 200);

    assert!(base.update(&rules).evaluated.is_empty(), "nothing has changed");
}
