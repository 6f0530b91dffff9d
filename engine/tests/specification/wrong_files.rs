//! Wrong rule files and what is said about them: `tests/wrong/NAME.rhai` beside `NAME.txt`.
//! `BLESS=1 cargo test -p adit-engine wrong` writes the messages anew.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use adit_engine::{Diagnostic, RuleBase, Schema, SourceFile, Type};

fn schema() -> Schema {
    use Type::{Number, Text, Truth};
    Schema::default()
        .class(
            "DOORS",
            &[("door", Number), ("kind", Text), ("height1", Number), ("width", Number), ("open", Truth)],
        )
        .class("ROBOTS", &[("state", Text), ("height", Number), ("hardness", Number)])
        .class("ROOMS", &[("room", Text), ("height", Number)])
}

fn said(file: &SourceFile) -> Vec<Diagnostic> {
    match RuleBase::compile(std::slice::from_ref(file)) {
        Ok(base) => base.check(&schema()),
        Err(wrong) => wrong.0,
    }
}

/// As a terminal would show it, without the frame.
fn rendered(file: &SourceFile) -> String {
    let mut out = String::new();
    for problem in said(file) {
        let Diagnostic { code, severity, message, line, column, .. } = &problem;
        let word = format!("{severity:?}").to_lowercase();
        writeln!(out, "{word}[{code}]: {message}\n  {}:{line}:{column}", problem.file).unwrap();
        let source = file.text().lines().nth(line - 1).unwrap_or("");
        let (start, len) = problem.span;
        let caret = file.text()[start..start + len].chars().count().max(1);
        let label = problem.label.as_deref().unwrap_or("");
        let marks = format!("{}{} {label}", " ".repeat(column - 1), "^".repeat(caret));
        writeln!(out, "  | {source}\n  | {}", marks.trim_end()).unwrap();
        if let Some(help) = &problem.help {
            writeln!(out, "  help: {help}").unwrap();
        }
        writeln!(out).unwrap();
    }
    out
}

#[test]
fn every_wrong_file_gets_its_message() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/wrong");
    let mut names: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rhai"))
        .collect();
    names.sort();
    assert!(names.len() >= 20);
    let mut different = vec![];
    for path in names {
        let name = path.file_name().unwrap().to_str().unwrap();
        let now = rendered(&SourceFile::new(name, fs::read_to_string(&path).unwrap()));
        assert!(!now.is_empty(), "{name} is not wrong");
        let kept = path.with_extension("txt");
        if env::var_os("BLESS").is_some() {
            fs::write(&kept, &now).unwrap();
        } else if fs::read_to_string(&kept).unwrap_or_default() != now {
            different.push(format!("{name} now says:\n{now}"));
        }
    }
    assert!(different.is_empty(), "{}", different.join("\n"));
}

#[test]
fn right_rules_are_not_complained_about() {
    let right = r#"
        rule "a" each d in DOORS least r in ROBOTS by hardness where r.height < d.height1
            then { d.hardness = r.hardness; d.state = r.state; }
        rule "b" each d in DOORS where d.hardness > 3 && d.state == "STAND" then { d.hard = true; }
    "#;
    assert!(said(&SourceFile::new("right.rhai", right)).is_empty());
}

#[test]
fn a_message_is_json_too() {
    let file = SourceFile::new("a.rhai", "rule \"r\" each d in DORS then { d.x = 1; }");
    let json = serde_json::to_value(said(&file)).unwrap();
    let expected = serde_json::json!([{
        "code": "rule/unknown-class", "severity": "error", "message": "there is no class DORS",
        "file": "a.rhai", "span": [19, 4], "line": 1, "column": 20, "label": null,
        "help": "did you mean `DOORS`?",
    }]);
    assert_eq!(json, expected);
}
