//! Decision tables as people read them: what is given, what is set, row by row, and what is amiss in which row.

use serde::Serialize;

use super::overlap::{Left, Space};
use super::{Fold, Hit, Row, Table};
use crate::diagnostic::{Code, Diagnostic};
use crate::lint::table;
use crate::rule::{Action, Rule};
use crate::rule_base::{on_deep_stack, read_one};
use crate::script::source::SourceFile;

/// A decision table of a rule file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Grid {
    pub name: String,
    /// The line of its name, from 1.
    pub line: usize,
    /// Which rows count where several match: `unique`, `any`, `first`, `priority`, or `collect` and what becomes of them.
    pub hit: String,
    /// What it looks at, as it is written.
    pub given: Vec<String>,
    /// What it sets.
    pub set: Vec<String>,
    pub rows: Vec<GridRow>,
    /// An example of what no row matches, one text for each of `given`, empty where any value is one; `None`: there is none,
    /// or nobody minds.
    pub missing: Option<Vec<String>>,
    pub amiss: Vec<Amiss>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GridRow {
    /// From 1.
    pub line: usize,
    /// What each of what is given has to be, in words.
    pub tests: Vec<String>,
    /// What is set, as it is written.
    pub outputs: Vec<String>,
}

/// What is amiss with a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Amiss {
    /// `gap`, `overlap` or `unreachable`.
    pub what: &'static str,
    /// The rows that it is about, from 0; none where it is about the whole table.
    pub rows: Vec<usize>,
    pub message: String,
    pub help: Option<String>,
}

impl Grid {
    /// The tables of a file, in their order; of one that does not read, none.
    pub fn of(file: &SourceFile) -> Vec<Self> {
        on_deep_stack(|| {
            read_one(file)
                .iter()
                .filter_map(|rule| match &rule.action {
                    Action::Table(table) => Some(Self::read(rule, table, file)),
                    _ => None,
                })
                .collect()
        })
    }

    fn read(rule: &Rule, table: &Table, file: &SourceFile) -> Self {
        let found = table::lint(rule, table);
        let is_missed = found.iter().any(|found| found.said.code == Code::Gap);
        let missing = match Space::new(table).gap() {
            Left::Example(example) if is_missed => Some(example),
            _ => None,
        };
        Self {
            name: rule.name().to_owned(),
            line: rule.line(),
            hit: hit(&table.hit).to_owned(),
            given: table.given.iter().map(|(_, input)| input.clone()).collect(),
            set: table
                .set
                .iter()
                .map(|(clause, property, _)| format!("{}.{property}", rule.clauses[*clause].variable))
                .collect(),
            rows: table.rows.iter().map(|row| GridRow::of(row, file)).collect(),
            missing,
            amiss: found.into_iter().map(|table::Found { rows, said }| Amiss::of(rows, said)).collect(),
        }
    }
}

impl GridRow {
    fn of(row: &Row, file: &SourceFile) -> Self {
        let written = file.cells(row.position);
        Self {
            line: file.place(row.position).line,
            tests: row.tests.iter().map(|(test, _)| test.to_string()).collect(),
            outputs: written.into_iter().skip(row.tests.len()).take(row.outputs.len()).collect(),
        }
    }
}

impl Amiss {
    fn of(rows: Vec<usize>, said: Diagnostic) -> Self {
        let what = match said.code {
            Code::Overlap => "overlap",
            Code::Unreachable => "unreachable",
            _ => "gap",
        };
        Self { what, rows, message: said.message, help: said.help }
    }
}

const fn hit(hit: &Hit) -> &'static str {
    match hit {
        Hit::Unique => "unique",
        Hit::Any => "any",
        Hit::First => "first",
        Hit::Priority(_) => "priority",
        Hit::Collect(Fold::Sum) => "collect sum",
        Hit::Collect(Fold::Min) => "collect min",
        Hit::Collect(Fold::Max) => "collect max",
        Hit::Collect(Fold::Count) => "collect count",
    }
}
