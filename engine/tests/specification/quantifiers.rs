//! Counting, adding up, and what holds of all.

use adit_engine::{Class, Reason};

use crate::support::{concluded, number};

/// Rooms 1 to 3, and doors of rooms 1 and 2. `closed` and `weight` of the last door are given.
fn rooms_and_doors(last: (Option<f64>, Option<f64>, Option<bool>)) -> [Class; 2] {
    let (room, weight, closed) = last;
    [
        Class::new("ROOMS", &["room"]).numbers("room", [1.0, 2.0, 3.0].map(Some)),
        Class::new("DOORS", &["door"])
            .numbers("door", [1.0, 2.0, 3.0].map(Some))
            .numbers("room", [Some(1.0), Some(1.0), room])
            .numbers("weight", [Some(2.5), Some(4.0), weight])
            .truths("closed", [Some(true), Some(true), closed]),
    ]
}

const COUNT: &str = r#"
rule "count" each room in ROOMS
    count exits of door in DOORS where door.room == room.room && door.weight > 1
    then { room.exits = exits; }"#;

const SUM: &str = r#"
rule "sum" each room in ROOMS
    sum load of door in DOORS by weight where door.room == room.room
    then { room.load = load; }"#;

const ALL: &str = r#"
rule "all" each room in ROOMS
    all door in DOORS where door.room == room.room have door.closed
    then { room.safe = true; }"#;

#[test]
fn count_gives_the_number_of_objects_that_pass_and_0_where_there_is_none() {
    let (base, _) = concluded(COUNT, rooms_and_doors((Some(2.0), Some(1.0), None)));
    assert_eq!(base.numbers("ROOMS", "exits").unwrap(), [Some(2.0), Some(0.0), Some(0.0)]);
}

#[test]
fn an_object_of_which_it_is_unknown_whether_it_passes_makes_the_count_unknown() {
    let (base, _) = concluded(COUNT, rooms_and_doors((Some(2.0), None, None)));
    assert_eq!(base.numbers("ROOMS", "exits").unwrap(), [Some(2.0), None, Some(0.0)]);
}

#[test]
fn a_door_of_an_unknown_room_may_be_one_of_each_room_unless_something_else_decides() {
    let (base, _) = concluded(COUNT, rooms_and_doors((None, Some(3.0), None)));
    assert_eq!(base.numbers("ROOMS", "exits").unwrap(), [None; 3]);
    let (base, _) = concluded(COUNT, rooms_and_doors((None, Some(0.5), None)));
    assert_eq!(base.numbers("ROOMS", "exits").unwrap(), [Some(2.0), Some(0.0), Some(0.0)]);
}

#[test]
fn an_unknown_key_leaves_open_what_is_counted() {
    let rooms = Class::new("ROOMS", &[]).numbers("room", [Some(1.0), None]);
    let [_, doors] = rooms_and_doors((Some(2.0), Some(3.0), None));
    let (base, _) = concluded(COUNT, [rooms, doors]);
    assert_eq!(base.numbers("ROOMS", "exits").unwrap(), [Some(2.0), None]);
}

#[test]
fn sum_adds_up_and_is_unknown_with_an_unknown_amount() {
    let (base, _) = concluded(SUM, rooms_and_doors((Some(2.0), Some(1.0), None)));
    assert_eq!(base.numbers("ROOMS", "load").unwrap(), [Some(6.5), Some(1.0), Some(0.0)]);
    let (base, _) = concluded(SUM, rooms_and_doors((Some(2.0), None, None)));
    assert_eq!(base.numbers("ROOMS", "load").unwrap(), [Some(6.5), None, Some(0.0)]);
}

#[test]
fn the_order_of_rows_does_not_reach_a_sum() {
    let rule = r#"rule "sum" each room in ROOMS sum all_of_it of door in DOORS by weight
        then { room.load = all_of_it; }"#;
    let sum = |weights: [f64; 4]| {
        let doors = Class::new("DOORS", &[]).numbers("weight", weights.map(Some));
        let rooms = Class::new("ROOMS", &["room"]).numbers("room", [Some(1.0)]);
        number(&concluded(rule, [rooms, doors]).0, "ROOMS", "1", "load").unwrap().to_bits()
    };
    assert_eq!(sum([0.1, 0.2, 0.3, 1e16]), sum([1e16, 0.3, 0.1, 0.2]));
}

#[test]
fn later_clauses_and_interpreted_parts_use_the_number() {
    let rule = r#"
        rule "r" each room in ROOMS
            count exits of door in DOORS where door.room == room.room
            least other in ROOMS by abs(other.room - exits) where other.room >= exits
            then {
                room.near = other.room;
                room.word = switch exits { 0.0 => "none", 2.0 => "two", _ => "some" };
            }"#;
    let (base, _) = concluded(rule, rooms_and_doors((Some(3.0), None, None)));
    assert_eq!(base.numbers("ROOMS", "near").unwrap(), [Some(2.0), Some(1.0), Some(1.0)]);
    let words: Vec<_> =
        ["1", "2", "3"].map(|key| base.value("ROOMS", key, "word").unwrap().to_string()).into();
    assert_eq!(words, ["two", "none", "some"]);
}

#[test]
fn an_unknown_number_reaches_nothing_but_what_uses_it() {
    let rule = r#"
        rule "r" each room in ROOMS
            count exits of door in DOORS where door.closed
            then { room.exits = exits; room.word = switch exits { 0.0 => "none", _ => "some" }; room.there = 1; }"#;
    let (base, _) = concluded(rule, rooms_and_doors((Some(3.0), None, None)));
    assert_eq!(number(&base, "ROOMS", "1", "exits"), None);
    assert_eq!(base.value("ROOMS", "1", "word"), None);
}

#[test]
fn all_needs_every_object_that_passes_to_have_it() {
    let (base, _) = concluded(ALL, rooms_and_doors((Some(2.0), None, Some(false))));
    assert_eq!(base.truths("ROOMS", "safe").unwrap(), [Some(true), None, Some(true)]);
}

#[test]
fn all_is_undecided_where_an_unknown_decides() {
    let (base, report) = concluded(ALL, rooms_and_doors((Some(2.0), None, None)));
    assert_eq!(base.truths("ROOMS", "safe").unwrap(), [Some(true), None, Some(true)]);
    let [(Reason::Undecided { variable, .. }, 1)] = report.gaps[0].reasons.as_slice() else {
        panic!("{:?}", report.gaps)
    };
    assert_eq!(variable, "door");
    // Of which room the closed door is does not matter.
    let (base, _) = concluded(ALL, rooms_and_doors((None, None, Some(true))));
    assert_eq!(base.truths("ROOMS", "safe").unwrap(), [Some(true); 3]);
}

#[test]
fn all_that_is_not_met_leads_to_else() {
    let rule = ALL.to_owned() + " else { room.safe = false; }";
    let (base, _) = concluded(&rule, rooms_and_doors((Some(2.0), None, Some(false))));
    assert_eq!(base.truths("ROOMS", "safe").unwrap(), [Some(true), Some(false), Some(true)]);
}
