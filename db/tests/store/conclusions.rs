//! Who concluded what.

use adit_db::conclusion::Derivation;
use adit_db::{Cell, Error};

use crate::made::Led;
use crate::paper;

#[test]
fn a_door_s_values_name_rule_version_and_witness() {
    let (_folder, mut store) = paper::site();
    let conclusions = store.snapshot(|tx| tx.conclusions("doors", &Cell::Integer(7))).unwrap();
    let read: Vec<_> = conclusions.iter().map(|c| (&*c.object, &*c.property, &c.value)).collect();
    assert_eq!(
        read,
        [
            ("doors.7", "action", &Cell::from("WALK")),
            ("doors.7", "hardness", &Cell::Real(27.001_901)),
            ("doors.7", "passable", &Cell::Integer(1)),
        ]
    );
    let hardness = &conclusions[1];
    assert_eq!(hardness.rule.as_deref(), Some("weigh a door"));
    assert_eq!(hardness.version.as_deref(), Some("1"));
    assert_eq!(hardness.witness.as_deref(), Some(r#"{"through":"STAND"}"#));
    assert_eq!((hardness.file.as_deref(), hardness.line), (Some("doors.rhai"), Some(3)));
}

#[test]
fn what_is_concluded_of_other_classes_stands_beside_it() {
    let (_folder, mut store) = paper::site();
    let spill = Derivation {
        class: "spills".into(),
        key: Cell::from("hall"),
        property: "urgent".into(),
        value: Cell::Integer(1),
        rule: paper::WEIGH,
        witness: None,
    };
    store
        .led()
        .transaction(|tx| {
            tx.replace_derivations(&[spill])?;
            let found = tx.conclusions("spills", &Cell::from("hall"))?;
            assert_eq!((&*found[0].object, &found[0].value), ("spills.hall", &Cell::Integer(1)));
            Ok::<_, Error>(())
        })
        .unwrap();
}
