//! Tests of rules, written as data beside them.

use adit_engine::{Code, Diagnostics, RuleTests, Schema, SourceFile, TestOutcome, Type, Value};

use crate::support::rules;

const RULES: &str = r#"
rule "who waters"
    each  plant  in PLANTS where plant.days_dry > 2
    least person in PEOPLE by busy where person.can_carry >= plant.litres
    then { plant.waterer = person.name; plant.litres_each = plant.litres / 3; }
"#;

const PEOPLE: &str = r#"
[keys]
PLANTS = ["pot"]
PEOPLE = ["name"]
[given]
PEOPLE = [
    { name = "Ann", busy = 7, can_carry = 0.2 },
    { name = "Bob", busy = 9, can_carry = 5.0 },
]
"#;

fn read(text: &str) -> Result<RuleTests, Diagnostics> {
    RuleTests::read(&[SourceFile::new("garden.toml", format!("{PEOPLE}{text}"))])
}

fn outcomes(text: &str) -> Vec<TestOutcome> {
    read(text).unwrap().run(&rules(RULES), &Schema::default()).unwrap()
}

/// What is said of a file that cannot be right, with the text at the caret.
fn wrong(text: &str) -> Vec<(Code, String, String)> {
    let run = |tests: RuleTests| tests.run(&rules(RULES), &Schema::default()).map(|_| ());
    let problems = read(text).and_then(run).unwrap_err().0;
    let text = format!("{PEOPLE}{text}");
    let caret = |(start, len): (usize, usize)| text[start..start + len].to_owned();
    problems.into_iter().map(|problem| (problem.code, problem.message, caret(problem.span))).collect()
}

#[test]
fn a_test_passes_where_all_that_it_expects_is_concluded() {
    let found = outcomes(
        r#"
[[test]]
name = "who can carry it waters it"
given.PLANTS = [{ pot = "fern", days_dry = 3, litres = 0.5 }, { pot = "wet", days_dry = 1, litres = 1 }]
conclude.PLANTS.fern = { waterer = "Bob", litres = 0.5 }
conclude.PLANTS.wet.waterer = { unknown = true }
"#,
    );
    assert!(found[0].passed, "{:?}", found[0].failures);
    assert_eq!((found[0].test.as_str(), found[0].line), ("who can carry it waters it", 12));
}

#[test]
fn a_wrong_value_comes_with_what_was_expected_found_and_why() {
    let found = outcomes(
        r#"
[[test]]
name = "Ann waters"
given.PLANTS = [{ pot = "fern", days_dry = 3, litres = 0.5 }]
conclude.PLANTS.fern.waterer = "Ann"
"#,
    );
    let failure = &found[0].failures[0];
    assert_eq!((&failure.expected, &failure.found), (&Some(Value::from("Ann")), &Some(Value::from("Bob"))));
    assert!(failure.why.starts_with("PLANTS fern waterer is Bob, by rule \"who waters\" (test.rhai, line 2"));
    assert!(failure.why.ends_with("person = PEOPLE Bob"), "{failure}");
    assert_eq!(
        failure.diagnostic.message,
        "test \"Ann waters\": PLANTS fern waterer is Bob and should be Ann"
    );
    assert_eq!((failure.diagnostic.line, failure.diagnostic.column), (14, 32));
    let json = serde_json::to_value(&found).unwrap();
    assert_eq!(json[0]["failures"][0]["expected"], "Ann");
}

#[test]
fn a_value_that_is_missing_comes_with_why_there_is_none() {
    let found = outcomes(
        r#"
[[test]]
name = "too heavy"
given.PLANTS = [{ pot = "oak", days_dry = 3, litres = 50 }]
conclude.PLANTS.oak.waterer = "Bob"
conclude.PLANTS.elm.waterer = "Bob"
"#,
    );
    let why: Vec<&str> = found[0].failures.iter().map(|failure| failure.why.as_str()).collect();
    assert!(why[0].contains("\"who waters\"") && why[0].contains("person"), "{why:?}");
    assert_eq!(why[1], "there is no object elm of class PLANTS");
}

#[test]
fn numbers_are_equal_to_the_bit_unless_a_tolerance_is_given() {
    let test = |tolerance: &str| {
        let text = format!(
            r#"
[[test]]
name = "a third"
{tolerance}
given.PLANTS = [{{ pot = "fern", days_dry = 3, litres = 0.1 }}]
conclude.PLANTS.fern.litres_each = 0.0333
"#
        );
        outcomes(&text)[0].passed
    };
    assert!(!test(""));
    assert!(test("tolerance = 0.001"));
}

#[test]
fn a_text_that_looks_like_a_number_is_told_from_it() {
    let found = outcomes(
        r#"
[[test]]
name = "thirds"
given.PLANTS = [{ pot = "fern", days_dry = 3, litres = 4.5 }]
conclude.PLANTS.fern.litres_each = "1.5"
"#,
    );
    let message = &found[0].failures[0].diagnostic.message;
    assert!(message.ends_with("litres_each is 1.5 and should be \"1.5\""), "{message}");
}

#[test]
fn what_follows_from_an_edit_is_tested_step_by_step() {
    let found = outcomes(
        r#"
[[test]]
name = "people come and go"
given.PLANTS = [{ pot = "fern", days_dry = 3, litres = 0.5 }]
conclude.PLANTS.fern.waterer = "Bob"
[[test.then]]
tell.PLANTS.fern.litres = 0.1
conclude.PLANTS.fern.waterer = "Ann"
[[test.then]]
remove.PEOPLE = ["Ann"]
add.PEOPLE = [{ name = "Cid", busy = 1, can_carry = 1 }]
conclude.PLANTS.fern.waterer = "Cid"
[[test.then]]
tell.PLANTS.fern.days_dry = { unknown = true }
conclude.PLANTS.fern.waterer = "Cid"
"#,
    );
    let failed: Vec<usize> = found[0].failures.iter().map(|failure| failure.step).collect();
    assert_eq!(failed, [3], "{:?}", found[0].failures);
    assert!(found[0].failures[0].diagnostic.message.ends_with("should be Cid, after edit 3"));
}

#[test]
fn a_class_that_only_another_test_gives_is_empty_and_one_that_nobody_gives_is_waited_for() {
    let nobody = r#"
[[test]]
name = "nobody"
given.PEOPLE = []
given.PLANTS = [{ pot = "fern", days_dry = 3, litres = 0.5 }]
conclude.PLANTS.fern.waterer = { unknown = true }
"#;
    assert!(outcomes(nobody)[0].passed);
    let alone = r#"
[[test]]
name = "a plant alone"
given.PLANTS = [{ pot = "fern", days_dry = 3, litres = 0.5 }]
conclude.PLANTS.fern.waterer = "Bob"
"#;
    let tests = RuleTests::read(&[SourceFile::new("alone.toml", format!("keys.PLANTS = ['pot']\n{alone}"))]);
    let found = tests.unwrap().run(&rules(RULES), &Schema::default()).unwrap();
    assert!(found[0].failures[0].why.starts_with("rule \"who waters\" waits for PEOPLE"), "{found:?}");
    let mut schema = Schema::default()
        .class("PEOPLE", &[("name", Type::Text), ("busy", Type::Number), ("can_carry", Type::Number)]);
    schema.set_key("PLANTS", &["pot"]);
    let found = RuleTests::read(&[SourceFile::new("alone.toml", alone)]).unwrap().run(&rules(RULES), &schema);
    assert!(found.unwrap()[0].failures[0].why.contains("person"), "the class is there, and empty");
}

#[test]
fn what_null_means_holds_in_tests_too() {
    let mut schema = Schema::default().class("PLANTS", &[("litres", Type::Number)]);
    schema.set_null("PLANTS", "litres", 0.0);
    let text = r#"
[[test]]
name = "no litres are no weight"
given.PLANTS = [{ pot = "fern", days_dry = 3 }]
conclude.PLANTS.fern.waterer = "Ann"
"#;
    let found = read(text).unwrap().run(&rules(RULES), &schema).unwrap();
    assert!(found[0].passed, "{:?}", found[0].failures);
}

#[test]
fn files_that_cannot_be_right_are_refused_at_the_place() {
    let test = "[[test]]\nname = \"t\"\n";
    let said = |text: &str| wrong(&format!("{test}{text}"));
    let names = said("given.PLANT = []\nconclude.PLANTS.fern.watere = 1\n");
    assert_eq!(names[0].0, Code::UnknownClass);
    assert_eq!((names[1].0, names[1].2.as_str()), (Code::UnknownProperty, "watere"));
    let types = said(
        "given.PLANTS = [{pot = \"a\", litres = 1}, {pot = \"b\", litres = \"two\"}]\nconclude.PLANTS.a.litres = 1",
    );
    assert_eq!(
        types,
        [(Code::Type, "PLANTS.litres holds numbers, and this is none".to_owned(), "\"two\"".to_owned())]
    );
    let keyless = said("given.PLANTS = [{litres = 1}]\nconclude.PLANTS.a.litres = 1");
    assert!(keyless[0].1.contains("needs its key `pot`"), "{keyless:?}");
    let date = said("conclude.PLANTS.a.litres = 2026-11-21");
    assert_eq!((date[0].0, date[0].2.as_str()), (Code::TestSyntax, "2026-11-21"));
    let misspelt = said("givn.PLANTS = []\nconclude.PLANTS.a.litres = 1");
    assert_eq!(misspelt[0].2, "givn");
    let nothing = said("given.PLANTS = []");
    assert!(nothing[0].1.contains("expects nothing"), "{nothing:?}");
    let broken = said("conclude = [");
    assert_eq!(broken[0].0, Code::TestSyntax);
}
