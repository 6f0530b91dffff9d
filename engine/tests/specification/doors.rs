//! The rules of the shape-changeable robot, as a domain expert writes them.

use adit_engine::{Class, Value};

use crate::support::{concluded, number, robots, rules, text};

const WEIGH: &str = r#"
rule "weigh a door"
    each  door    in DOORS
    least first   in ROBOTS by first.hardness where first.height < door.height1 && first.width < door.width1
    least second  in ROBOTS by hardness where second.height < door.height2 && second.width < door.width2
    least through in ROBOTS by through.hardness where through.height < door.height1 && through.height < door.height2
                                                   && through.width < door.width
    then {
        if first.state == "IMPOSSIBLE" || second.state == "IMPOSSIBLE" || through.state == "IMPOSSIBLE" {
            door.hardness = max(first.hardness, second.hardness, through.hardness);
            door.action   = "NO-ACTION";
            door.passable = false;
        } else {
            door.hardness = door.distance1 * first.hardness + door.distance2 * second.hardness + through.hardness;
            door.action   = through.action;
            door.passable = true;
        }
    }
"#;

fn doors() -> Class {
    Class::new("DOORS", &["door"])
        .numbers("door", [1.0, 2.0, 3.0].map(Some))
        .numbers("height1", [None, Some(15.0), Some(4.0)])
        .numbers("width1", [4.0, 6.0, 6.0].map(Some))
        .numbers("distance1", [10.0, 2.0, 1.0].map(Some))
        .numbers("height2", [None, None, None])
        .numbers("width2", [2.0, 6.0, 6.0].map(Some))
        .numbers("distance2", [5.0, 3.0, 1.0].map(Some))
        .numbers("width", [1.5, 5.5, 5.5].map(Some))
        .null_means("height1", f64::INFINITY)
        .null_means("height2", f64::INFINITY)
}

#[test]
fn table_6_weighs_a_door_by_three_choices() {
    let (base, _) = concluded(WEIGH, [robots(), doors()]);
    // 10 m standing (1), 5 m sideways (2), through sideways (2).
    assert_eq!(number(&base, "DOORS", "1", "hardness"), Some(10.0 + 5.0 * 2.0 + 2.0));
    assert_eq!(text(&base, "DOORS", "1", "action").as_deref(), Some("SIDE-WALK"));
    // 2 m squatting (4) under the bridge, 3 m standing, through squatting.
    assert_eq!(number(&base, "DOORS", "2", "hardness"), Some(2.0 * 4.0 + 3.0 + 4.0));
    assert_eq!(text(&base, "DOORS", "2", "action").as_deref(), Some("WALK-ON-KNEE"));
}

#[test]
fn an_impossible_state_makes_a_door_impassable() {
    let (base, report) = concluded(WEIGH, [robots(), doors()]);
    assert_eq!(number(&base, "DOORS", "3", "hardness"), Some(10000.0));
    assert_eq!(base.truths("DOORS", "passable").unwrap(), [Some(true), Some(true), Some(false)]);
    assert!(report.gaps.is_empty());
}

#[test]
fn of_equal_states_the_first_of_the_table_is_taken() {
    let twins = Class::new("ROBOTS", &["state"])
        .texts("state", [Some("B"), Some("A")])
        .numbers("hardness", [Some(0.0), Some(-0.0)]);
    let things = crate::support::things("size", &[Some(1.0)]);
    let rule = r#"rule "r" each t in THINGS least s in ROBOTS by hardness then { t.state = s.state; }"#;
    let (base, _) = concluded(rule, [twins, things]);
    assert_eq!(text(&base, "THINGS", "1", "state").as_deref(), Some("B"));
}

const BY_STATE: &str = r#"
rule "change of shape"
    each door in DOORS where door.kind == "change"
    some from in ROOMS where from.room == door.room1
    some to in ROOMS where to.room == door.room2
    least change in CHANGES by change.hardness where change.robot == from.robot
        && change.from_state == from.state && change.to_state == to.state
    then { door.hardness = change.hardness; door.action = to.action; }
    else { door.hardness = 0.0; door.action = to.action; }

rule "weigh a room"
    each room in ROOMS
    some state in ROBOTS where state.robot == room.robot && state.state == room.state
    then { room.hardness = state.hardness; room.action = state.action; }
"#;

fn layers() -> [Class; 3] {
    [
        Class::new("ROOMS", &["room"])
            .texts("room", [Some("a"), Some("b"), Some("c")])
            .texts("robot", [Some("robot"); 3])
            .texts("state", [Some("STAND"), Some("SQUAT"), Some("SIDE-STAND")]),
        Class::new("CHANGES", &["robot", "from_state", "to_state"])
            .texts("robot", [Some("robot")])
            .texts("from_state", [Some("STAND")])
            .texts("to_state", [Some("SQUAT")])
            .numbers("hardness", [Some(7.0)]),
        Class::new("DOORS", &["door"])
            .numbers("door", [1.0, 2.0, 3.0].map(Some))
            .texts("kind", [Some("change"), Some("change"), Some("door")])
            .texts("room1", [Some("a"), Some("a"), Some("a")])
            .texts("room2", [Some("b"), Some("c"), Some("c")]),
    ]
}

#[test]
fn a_rule_waits_for_what_another_concludes_whatever_their_order_in_the_file() {
    let [rooms, changes, doors] = layers();
    let (base, _) = concluded(BY_STATE, [robots(), rooms, changes, doors]);
    assert_eq!(number(&base, "DOORS", "1", "hardness"), Some(7.0));
    assert_eq!(text(&base, "DOORS", "1", "action").as_deref(), Some("WALK-ON-KNEE"));
}

#[test]
fn else_may_use_what_the_clauses_before_have_bound() {
    let [rooms, changes, doors] = layers();
    let (base, report) = concluded(BY_STATE, [robots(), rooms, changes, doors]);
    assert_eq!(number(&base, "DOORS", "2", "hardness"), Some(0.0));
    assert_eq!(text(&base, "DOORS", "2", "action").as_deref(), Some("SIDE-WALK"));
    // Door 3 is no change of shape: no rule speaks of it.
    assert_eq!(report.gaps[0].rows, [2]);
}

#[test]
fn a_site_is_concluded_in_steps_as_facts_come_in() {
    let base_rules = rules(BY_STATE);
    let mut base = adit_engine::KnowledgeBase::new();
    base.assert(robots()).unwrap();
    let report = base.conclude(&base_rules);
    let waiting: Vec<(&str, String)> =
        report.waiting.iter().map(|waiting| (waiting.rule.as_str(), waiting.needs.join(" "))).collect();
    assert_eq!(
        waiting,
        [("weigh a room", "ROOMS".to_owned()), ("change of shape", "CHANGES DOORS ROOMS".to_owned())]
    );
    let [rooms, changes, doors] = layers();
    base.assert(rooms).unwrap();
    assert_eq!(base.conclude(&base_rules).evaluated, ["weigh a room"]);
    base.assert(changes).unwrap();
    base.assert(doors).unwrap();
    assert_eq!(base.conclude(&base_rules).evaluated, ["change of shape"]);
    assert!(base.conclude(&base_rules).evaluated.is_empty(), "nothing is new");
}

#[test]
fn a_class_asserted_anew_renews_what_rests_on_it_and_nothing_else() {
    let base_rules = rules(BY_STATE);
    let [rooms, changes, doors] = layers();
    let (mut base, _) = concluded(BY_STATE, [robots(), rooms, changes, doors]);
    let [_, _, doors] = layers();
    base.assert(doors).unwrap();
    assert!(base.conclude(&base_rules).evaluated.is_empty(), "it is what it was");
    base.tell("ROBOTS", "robot/STAND", "action", Some("STROLL".into())).unwrap();
    assert_eq!(base.conclude(&base_rules).evaluated, ["weigh a room"], "no change of shape ends in STAND");
    base.tell("ROBOTS", "robot/STAND", "height", Some(19.0.into())).unwrap();
    assert!(base.conclude(&base_rules).evaluated.is_empty(), "no rule reads it");
}

#[test]
fn what_rests_on_a_retracted_class_is_taken_back() {
    let base_rules = rules(BY_STATE);
    let [rooms, changes, doors] = layers();
    let (mut base, _) = concluded(BY_STATE, [robots(), rooms, changes, doors]);
    base.retract("ROBOTS");
    let report = base.conclude(&base_rules);
    assert_eq!(report.waiting.len(), 2);
    assert_eq!(base.value("ROOMS", "a", "action"), None);
    assert_eq!(base.value("DOORS", "1", "hardness"), None);
}

#[test]
fn an_edited_rule_alone_is_evaluated_again() {
    let (mut base, _) = concluded(WEIGH, [robots(), doors()]);
    let edited = WEIGH.replace("+ through.hardness;", "+ 2 * through.hardness;");
    let report = base.conclude(&rules(&edited));
    assert_eq!(report.evaluated, ["weigh a door"]);
    assert_eq!(number(&base, "DOORS", "1", "hardness"), Some(24.0));
    let report = base.conclude(&rules(""));
    assert!(report.evaluated.is_empty());
    assert_eq!(base.value("DOORS", "1", "hardness"), None, "no rule, no hardness");
}

#[test]
fn a_told_value_stands_before_a_concluded_one() {
    let told = doors().numbers("hardness", [None, Some(99.0), None]);
    let (base, _) = concluded(WEIGH, [robots(), told]);
    assert_eq!(number(&base, "DOORS", "1", "hardness"), Some(22.0));
    assert_eq!(number(&base, "DOORS", "2", "hardness"), Some(99.0));
    assert_eq!(base.value("DOORS", "2", "passable"), Some(Value::Truth(true)));
}

#[test]
fn a_rule_tells_what_it_reads_and_sets() {
    let base = rules(WEIGH);
    let rule = &base.rules()[0];
    let sets: Vec<String> = rule.sets().map(ToString::to_string).collect();
    assert_eq!(sets, ["DOORS.action", "DOORS.hardness", "DOORS.passable"]);
    let reads: Vec<String> = rule.reads().map(ToString::to_string).collect();
    assert_eq!(
        reads.join(" "),
        "DOORS.distance1 DOORS.distance2 DOORS.height1 DOORS.height2 DOORS.width DOORS.width1 DOORS.width2 \
         ROBOTS.action ROBOTS.hardness ROBOTS.height ROBOTS.state ROBOTS.width"
    );
    assert_eq!((rule.file(), rule.line()), ("test.rhai", 2));
    assert_eq!(rule.version().len(), 8);
}

#[test]
fn a_version_changes_with_the_text_of_the_rule_and_not_with_its_neighbours() {
    let versions = |text: &str| -> Vec<String> {
        rules(text).rules().iter().map(|rule| rule.version().to_owned()).collect()
    };
    let (one, two) = (versions(WEIGH), versions(&format!("// a note\n{BY_STATE}\n// another\n{WEIGH}")));
    assert_eq!(one[0], two[2]);
    assert_ne!(one, versions(&WEIGH.replace("max(", "min(")));
    let limit = |value: &str| {
        format!("const LIMIT = {value};\nrule \"r\" each t in T where t.x < LIMIT then {{ t.y = 1; }}")
    };
    assert_ne!(versions(&limit("1")), versions(&limit("2")));
}
