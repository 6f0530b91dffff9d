//! What rules prove and refute.

use adit_engine::{Class, PropertyName};

use crate::support::{concluded, rules};

fn rooms(lit: [Option<bool>; 3]) -> Class {
    Class::new("ROOMS", &["room"]).numbers("room", [1.0, 2.0, 3.0].map(Some)).truths("lit", lit)
}

/// Doors of rooms 1, 1, 2 with these widths.
fn doors(rooms: [Option<f64>; 3], widths: [Option<f64>; 3]) -> Class {
    Class::new("DOORS", &["door"])
        .numbers("door", [1.0, 2.0, 3.0].map(Some))
        .numbers("room", rooms)
        .numbers("width", widths)
}

fn proved(rule: &str, classes: impl IntoIterator<Item = Class>) -> Vec<Option<bool>> {
    concluded(rule, classes).0.truths("ROOMS", "good").unwrap()
}

const LIT: [Option<bool>; 3] = [Some(true); 3];
const OF_ROOMS: [Option<f64>; 3] = [Some(1.0), Some(1.0), Some(2.0)];

#[test]
fn a_hypothesis_is_true_where_all_clauses_are_met_and_false_where_one_is_not() {
    for quantifier in ["each door in DOORS", "some door in DOORS", "least door in DOORS by width"] {
        let rule = format!(
            r#"rule "r" each room in ROOMS where room.lit {quantifier} where door.room == room.room
               hypothesis room.good"#
        );
        let classes = [rooms([Some(true), Some(false), Some(true)]), doors(OF_ROOMS, [Some(1.0); 3])];
        assert_eq!(proved(&rule, classes), [Some(true), Some(false), Some(false)], "{quantifier}");
    }
}

#[test]
fn a_hypothesis_is_unknown_where_a_clause_is_undecided() {
    for quantifier in ["each door in DOORS", "some door in DOORS", "most door in DOORS by width"] {
        let rule = format!(
            r#"rule "r" each room in ROOMS {quantifier} where door.room == room.room && door.width > 2
               hypothesis room.good"#
        );
        let good = |rooms_of, widths| proved(&rule, [rooms(LIT), doors(rooms_of, widths)]);
        let [one, three, unknown] = [Some(1.0), Some(3.0), None];
        assert_eq!(
            good(OF_ROOMS, [three, unknown, unknown]),
            [Some(true), None, Some(false)],
            "{quantifier}"
        );
        assert_eq!(good([one, one, None], [three, one, one]), [Some(true), Some(false), Some(false)]);
        assert_eq!(good([one, one, None], [three, one, three]), [Some(true), None, None]);
    }
}

#[test]
fn an_undecided_first_clause_leaves_the_hypothesis_unknown() {
    let rule = r#"rule "r" each room in ROOMS where room.lit && room.room != 2 hypothesis room.good"#;
    assert_eq!(proved(rule, [rooms([None, None, Some(true)])]), [None, Some(false), Some(true)]);
}

#[test]
fn a_test_over_several_objects_may_be_undecided_too() {
    let rule = r#"rule "r" each room in ROOMS
        each door in DOORS where door.width > room.room
        hypothesis room.good"#;
    let classes = [rooms(LIT), doors(OF_ROOMS, [Some(1.5), None, Some(2.5)])];
    assert_eq!(proved(rule, classes), [Some(true), Some(true), None]);
}

#[test]
fn all_decides_a_hypothesis() {
    let rule = r#"rule "r" each room in ROOMS
        all door in DOORS where door.room == room.room have door.width > 2
        hypothesis room.good"#;
    let classes = [rooms(LIT), doors(OF_ROOMS, [Some(3.0), Some(1.0), None])];
    assert_eq!(proved(rule, classes), [Some(false), None, Some(true)]);
}

#[test]
fn a_rule_with_a_hypothesis_may_act_where_it_is_proved() {
    let rule = r#"
        rule "good" each room in ROOMS where room.lit
            hypothesis room.good
            then { room.colour = "green"; }
        rule "better" each room in ROOMS where room.good then { room.better = true; }"#;
    let (base, report) = concluded(rule, [rooms([Some(true), None, Some(false)])]);
    assert_eq!(base.texts("ROOMS", "colour").unwrap().iter().flatten().count(), 1);
    assert_eq!(base.truths("ROOMS", "good").unwrap(), [Some(true), None, Some(false)]);
    assert_eq!(base.truths("ROOMS", "better").unwrap(), [Some(true), None, None]);
    assert_eq!(report.evaluated, ["good", "better"]);
}

#[test]
fn a_rule_base_names_its_hypotheses() {
    let base = rules(
        r#"rule "a" each room in ROOMS where room.lit hypothesis room.good
           rule "b" each room in ROOMS where room.room > 2 hypothesis room.good
           rule "c" each room in ROOMS hypothesis room.there then { room.x = 1; }"#,
    );
    let names = ["good", "there"].map(|property| PropertyName::new("ROOMS", property));
    assert_eq!(base.hypotheses().into_iter().collect::<Vec<_>>(), names);
    assert_eq!(base.rules()[1].hypothesis(), Some(names[0].clone()));
}

#[test]
fn what_one_part_of_a_condition_refutes_no_other_part_leaves_open_through_a_link_either() {
    let rule = r#"property DOORS.room names ROOMS;
        rule "r" each door in DOORS where door.ok && door.room.lit hypothesis door.good"#;
    let rooms = rooms([Some(true), Some(false), None]);
    let doors = |ok: [Option<bool>; 5]| {
        Class::new("DOORS", &["door"])
            .numbers("door", [1.0, 2.0, 3.0, 4.0, 5.0].map(Some))
            .numbers("room", [Some(1.0), Some(2.0), Some(3.0), None, Some(1.0)])
            .truths("ok", ok)
    };
    let good = |ok| concluded(rule, [rooms.clone(), doors(ok)]).0.truths("DOORS", "good").unwrap();
    let (yes, no) = (Some(true), Some(false));
    assert_eq!(good([None; 5]), [None, no, None, None, None]);
    assert_eq!(good([yes; 5]), [yes, no, None, None, yes]);
    assert_eq!(good([no; 5]), [no; 5]);
}
