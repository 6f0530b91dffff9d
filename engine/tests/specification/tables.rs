//! Decision tables.

use adit_engine::{Class, Code, Diagnostic, Grid, RuleBase, Schema, Severity, SourceFile, Type};
use proptest::prelude::*;

use crate::support::{concluded, text, things};

/// Lee, Table 1, as in the architecture's example.
const LEE: &str = r#"
table "target position" unique
    each step in STEPS
    given [ step.entering, step.next_side, step.coming_from ]
    set   [ step.margin_x, step.margin_z ]
    rows  [ [ "z", "left",  any,     "left",  "down" ],
            [ "z", "right", any,     "right", "down" ],
            [ "x", any,     "right", "right", "up"   ],
            [ "x", any,     "left",  "left",  "up"   ] ]
"#;

fn steps(rows: &[[Option<&str>; 3]]) -> Class {
    let column = |nth: usize| rows.iter().map(move |row| row[nth]);
    Class::new("STEPS", &[])
        .texts("entering", column(0))
        .texts("next_side", column(1))
        .texts("coming_from", column(2))
}

fn margins(rows: &[[Option<&str>; 3]]) -> Vec<(Option<String>, Option<String>)> {
    let (base, _) = concluded(LEE, [steps(rows)]);
    let value = |row: usize, property: &str| text(&base, "STEPS", &row.to_string(), property);
    (1..=rows.len()).map(|row| (value(row, "margin_x"), value(row, "margin_z"))).collect()
}

fn both(x: &str, z: &str) -> (Option<String>, Option<String>) {
    (Some(x.to_owned()), Some(z.to_owned()))
}

#[test]
fn the_row_that_matches_gives_all_that_is_set() {
    let [z, x, left, right] = ["z", "x", "left", "right"].map(Some);
    let given = margins(&[[z, left, right], [z, right, left], [x, right, left], [Some("y"), left, left]]);
    assert_eq!(given, [both("left", "down"), both("right", "down"), both("left", "up"), (None, None)]);
}

#[test]
fn an_unknown_input_matters_only_where_a_row_that_could_match_looks_at_it() {
    let [z, x, left, right] = ["z", "x", "left", "right"].map(Some);
    let given = margins(&[[z, left, None], [x, None, right], [z, None, right], [None, left, left]]);
    assert_eq!(given, [both("left", "down"), both("right", "up"), (None, None), (None, None)]);
}

/// What a table of one input gives for each thing.
fn cells(table: &str, sizes: &[Option<f64>]) -> Vec<Option<f64>> {
    concluded(table, [things("size", sizes)]).0.numbers("THINGS", "x").unwrap()
}

#[test]
fn cells_test_numbers_against_limits_and_lists() {
    let table = r#"
        const LIMIT = 10;
        table "t" first each t in THINGS given [t.size] set [t.x] rows [
            [ [1, 2],           1 ],
            [ between(2, 4),    2 ],
            [ not([4, 5, 6]),   if t.size < 0 { -1 } else { t.size * 100 } ],
            [ at_most(4),       4 ],
            [ below(6),         5 ],
            [ 6..7,             6 ],
            [ LIMIT,           10 ] ]"#;
    let sizes = [1.0, 2.0, 3.5, -3.0, 7.0, 4.0, 5.0, 6.0].map(Some);
    let expected = [1.0, 1.0, 2.0, -1.0, 700.0, 4.0, 5.0, 6.0].map(Some);
    assert_eq!(cells(table, &sizes), expected);
}

#[test]
fn first_takes_the_first_row_that_matches() {
    let table = r#"table "t" first each t in THINGS given [t.size] set [t.x]
        rows [ [above(5), 1], [above(3), 2], [any, 3] ]"#;
    assert_eq!(
        cells(table, &[Some(6.0), Some(4.0), Some(1.0), None]),
        [Some(1.0), Some(2.0), Some(3.0), None]
    );
}

#[test]
fn priority_takes_the_row_whose_first_output_ranks_first() {
    let table = r#"table "t" priority [3, 1, 2] each t in THINGS given [t.size] set [t.x]
        rows [ [above(1), 1], [above(3), 2], [above(5), 3] ]"#;
    assert_eq!(cells(table, &[Some(6.0), Some(4.0), Some(1.0)]), [Some(3.0), Some(1.0), None]);
}

#[test]
fn collect_brings_all_rows_that_match_together() {
    let table = |fold: &str, rows: &str| {
        format!("table \"t\" collect {fold} each t in THINGS given [t.size] set [t.x] rows {rows}")
    };
    let rows = "[ [above(1), 10], [above(3), -2], [above(5), 4] ]";
    let sizes = [Some(6.0), Some(4.0), Some(1.0), None];
    assert_eq!(cells(&table("sum", rows), &sizes), [Some(12.0), Some(8.0), Some(0.0), None]);
    assert_eq!(cells(&table("min", rows), &sizes), [Some(-2.0), Some(-2.0), None, None]);
    assert_eq!(cells(&table("max", rows), &sizes), [Some(10.0), Some(10.0), None, None]);
    let rows = "[ [above(1)], [above(3)], [above(5)] ]";
    assert_eq!(cells(&table("count", rows), &sizes), [Some(3.0), Some(2.0), Some(0.0), None]);
}

#[test]
fn a_table_may_have_a_priority_several_clauses_and_outputs_that_are_computed() {
    let table = r#"
        fn twice(x) { 2 * x }
        table "t" any priority 4
            each t in THINGS
            least u in THINGS by size
            given [t.size > u.size, twice(t.size)]
            set [t.x]
            rows [ [true, at_least(6), t.size - u.size], [true, below(6), twice(u.size)], [false, any, 0] ]"#;
    assert_eq!(cells(table, &[Some(1.0), Some(2.0), Some(3.0)]), [Some(0.0), Some(2.0), Some(2.0)]);
    let base = RuleBase::compile(&[SourceFile::new("t", table)]).unwrap();
    assert_eq!((base.rules()[0].name(), base.rules()[0].priority()), ("t", 4));
}

fn said(table: &str) -> Vec<Diagnostic> {
    let schema = Schema::default().class("THINGS", &[("a", Type::Number), ("b", Type::Number)]);
    match RuleBase::compile(&[SourceFile::new("t", table)]) {
        Ok(base) => base.check(&schema),
        Err(wrong) => wrong.0,
    }
}

#[test]
fn a_large_table_is_looked_through_and_run_without_ado() {
    let rows: Vec<String> = (0..2000).map(|n| format!("[between({n}, {}), {n}]", n + 1)).collect();
    let table = format!(
        "table \"t\" first each t in THINGS given [t.size] set [t.x] rows [{}, [any, -1]]",
        rows.join(", ")
    );
    assert_eq!(cells(&table, &[Some(1234.5), Some(-3.0), None]), [Some(1234.0), Some(-1.0), None]);
}

/// A cell of small numbers.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        Just("any".to_owned()),
        (0..4_i32).prop_map(|n| n.to_string()),
        (0..4_i32).prop_map(|n| format!("below({n})")),
        (0..4_i32).prop_map(|n| format!("at_least({n})")),
        (0..3_i32, 1..3_i32).prop_map(|(n, more)| format!("between({n}, {})", n + more)),
        (0..4_i32).prop_map(|n| format!("not({n})")),
        (0..3_i32).prop_map(|n| format!("[{n}, {}]", n + 1)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 48, ..ProptestConfig::default() })]

    /// The analysis agrees with trying all inputs: halves stand for the values between the limits.
    #[test]
    fn gaps_overlaps_and_rows_never_reached_are_those_that_trying_finds(
        rows in prop::collection::vec((cell(), cell()), 1..5)
    ) {
        let inputs: Vec<f64> = (-1..9).map(|n| f64::from(n) / 2.0).collect();
        let pairs: Vec<(f64, f64)> =
            inputs.iter().flat_map(|&a| inputs.iter().map(move |&b| (a, b))).collect();
        // Which rows match which input, by a table of one row each.
        let alone = |(nth, (a, b)): (usize, &(String, String))| {
            let head = format!("table \"{nth}\" first each t in THINGS given [t.a, t.b]");
            format!("{head} set [t.m{nth}] rows [[{a}, {b}, true]]\n")
        };
        let tables: Vec<String> = rows.iter().enumerate().map(alone).collect();
        let tables = tables.concat();
        let class = Class::new("THINGS", &[])
            .numbers("a", pairs.iter().map(|pair| Some(pair.0)))
            .numbers("b", pairs.iter().map(|pair| Some(pair.1)));
        let (base, _) = concluded(&tables, [class]);
        let matches: Vec<Vec<bool>> = (0..rows.len())
            .map(|nth| base.truths("THINGS", &format!("m{nth}")).unwrap().iter().map(Option::is_some).collect())
            .collect();
        let count = |input: usize| matches.iter().filter(|row| row[input]).count();
        let table = |hit: &str| {
            let rows: Vec<String> =
                rows.iter().enumerate().map(|(nth, (a, b))| format!("[{a}, {b}, {nth}]")).collect();
            said(&format!(
                "table \"t\" {hit} each t in THINGS given [t.a, t.b] set [t.x] rows [{}]",
                rows.join(", ")
            ))
        };
        let has = |found: &[Diagnostic], code: Code| found.iter().any(|problem| problem.code == code);
        let unique = table("unique");
        prop_assert_eq!(has(&unique, Code::Overlap), (0..pairs.len()).any(|input| count(input) > 1), "{:?}", unique);
        let first = table("first");
        prop_assert_eq!(has(&first, Code::Gap), (0..pairs.len()).any(|input| count(input) == 0), "{:?}", first);
        let reached = |row: usize| {
            (0..pairs.len()).any(|input| matches[row][input] && !(0..row).any(|before| matches[before][input]))
        };
        let unreached = (0..rows.len()).filter(|&row| !reached(row)).count();
        let said = first.iter().filter(|problem| problem.code == Code::Unreachable).count();
        prop_assert_eq!(said, unreached, "{:?}", first);
        prop_assert!(first.iter().all(|problem| problem.severity == Severity::Warning));
    }
}

/// What an editor shows beside the text: each cell in words, and what is amiss in which row.
#[test]
fn a_table_is_read_as_a_grid_with_what_is_amiss_in_its_rows() {
    let text = r#"
const LIMIT = 10;

rule "no table" each thing in THINGS then { thing.z = LIMIT; }

table "fine [, so to say" unique
    each thing in THINGS
    given [ thing.size, thing.colour ?? "none" ]
    set   [ thing.x, thing.y ]
    rows  [ [ below(LIMIT),        any,            1.0, thing.size * max(2.0, 3.0) ],
            [ between(10.0, 20.0), not("red"),     2.0, "a, b" ],
            [ at_least(15.0),      ["red", "blue"], -3.0, true ] ]

table "last" first
    each thing in THINGS
    given [ thing.size ]
    set   [ thing.z ]
    rows  [ [ any, 1.0 ],
            [ above(3.0), 2.0 ] ]
"#;
    let grids = Grid::of(&SourceFile::new("grid.rhai", text));
    let [fine, last] = &grids[..] else { panic!("{grids:#?}") };
    assert_eq!((fine.name.as_str(), fine.line, fine.hit.as_str()), ("fine [, so to say", 6, "unique"));
    assert_eq!(fine.given, ["thing.size", "thing.colour ?? \"none\""]);
    assert_eq!(fine.set, ["thing.x", "thing.y"]);
    let texts = |of: &[String]| of.join(" | ");
    let rows: Vec<(usize, String, String)> =
        fine.rows.iter().map(|row| (row.line, texts(&row.tests), texts(&row.outputs))).collect();
    let row = |line: usize, tests: &str, outputs: &str| (line, tests.to_owned(), outputs.to_owned());
    assert_eq!(
        rows,
        [
            row(10, "below 10 | any", "1.0 | thing.size * max(2.0, 3.0)"),
            row(11, "from 10 to below 20 | other than \"red\"", "2.0 | \"a, b\""),
            row(12, "at least 15 | \"red\" or \"blue\"", "-3.0 | true"),
        ]
    );
    let amiss: Vec<(&str, &[usize])> = fine.amiss.iter().map(|amiss| (amiss.what, &*amiss.rows)).collect();
    assert_eq!(amiss, [("overlap", &[1, 2][..]), ("gap", &[])]);
    assert!(fine.amiss[0].message.contains("rows 2 and 3 both match where thing.size"), "{:?}", fine.amiss);
    let missing = fine.missing.as_ref().unwrap();
    assert!(
        fine.amiss[1]
            .message
            .ends_with(&format!("thing.size {} and thing.colour ?? \"none\" {}", missing[0], missing[1])),
        "{fine:#?}"
    );

    assert_eq!((last.hit.as_str(), &last.missing), ("first", &None));
    let amiss: Vec<(&str, &[usize])> = last.amiss.iter().map(|amiss| (amiss.what, &*amiss.rows)).collect();
    assert_eq!(amiss, [("unreachable", &[1][..])]);
}

#[test]
fn what_does_not_read_has_no_grids() {
    for text in ["", "table", "table \"t\" unique each", "not rules at all ("] {
        assert_eq!(Grid::of(&SourceFile::new("wrong.rhai", text)), []);
    }
}
