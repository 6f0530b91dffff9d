//! Rows of a table that overlap, that are never reached, and inputs without a row.

use rhai::Expr;

use crate::diagnostic::{Code, Diagnostic};
use crate::rule::Rule;
use crate::script::names::property_of;
use crate::table::overlap::{Left, MAX_REGIONS, Space};
use crate::table::{Hit, Table, plain};

const MAX_FOUND: usize = 20;

const TOO_LARGE: &str = "the table is too large for all its rows to be compared";

/// Something amiss, with the rows that it is about; none where it is about the table.
pub(crate) struct Found {
    pub(crate) rows: Vec<usize>,
    pub(crate) said: Diagnostic,
}

pub(crate) fn lint(rule: &Rule, table: &Table) -> Vec<Found> {
    let lint = Lint { rule, table, space: Space::new(table) };
    let mut found = vec![];
    for row in 0..table.rows.len() {
        if lint.space.is_empty(row) {
            let message = format!("row {} matches nothing", row + 1);
            found.push(Found {
                rows: vec![row],
                said: lint.of_row(Code::Unreachable, row, message).warning(),
            });
        }
    }
    match &table.hit {
        Hit::Unique | Hit::Any => found.extend(lint.overlaps()),
        Hit::First | Hit::Priority(_) => found.extend(lint.shadowed()),
        Hit::Collect(_) => return found,
    }
    found.extend(lint.gap());
    found
}

struct Lint<'l> {
    rule: &'l Rule,
    table: &'l Table,
    space: Space,
}

impl Lint<'_> {
    fn of_row(&self, code: Code, row: usize, message: String) -> Diagnostic {
        self.rule.file.error(code, self.table.rows[row].position, message).label(format!("row {}", row + 1))
    }

    fn overlaps(&self) -> Vec<Found> {
        let rows = self.table.rows.len();
        let mut pairs = (0..rows).flat_map(|second| (0..second).map(move |first| (first, second)));
        let mut found = vec![];
        while found.len() < MAX_FOUND
            && self.space.may_go_on()
            && let Some((first, second)) = pairs.next()
        {
            let same = self.same(first, second);
            if self.table.hit == Hit::Any && same == Some(true) {
                continue;
            }
            let Some(example) = self.space.both(first, second) else { continue };
            let example = self.in_words(&example);
            let (a, b) = (first + 1, second + 1);
            let line = self.rule.file.source.place(self.table.rows[first].position).line;
            let there = format!("row {a} is in line {line}");
            let said = if self.table.hit == Hit::Unique {
                let message = format!("rows {a} and {b} both match where {example}");
                self.of_row(Code::Overlap, second, message)
                    .help(format!("{there}; a table of `first` would take the first that matches"))
            } else {
                let message = format!("rows {a} and {b} say different things where {example}");
                let problem = self.of_row(Code::Overlap, second, message).help(there);
                // What is computed may turn out the same.
                if same.is_none() { problem.warning() } else { problem }
            };
            found.push(Found { rows: vec![first, second], said });
        }
        if !self.space.may_go_on() {
            found.push(self.of_table(TOO_LARGE.to_owned()));
        }
        found
    }

    /// Whether two rows give the same; `None` if only running tells.
    fn same(&self, first: usize, second: usize) -> Option<bool> {
        let outputs = self.table.rows[first].outputs.iter().zip(&self.table.rows[second].outputs);
        let outputs: Vec<Option<bool>> = outputs.map(|(a, b)| same(a, b)).collect();
        if outputs.contains(&Some(false)) {
            return Some(false);
        }
        (!outputs.contains(&None)).then_some(true)
    }

    fn shadowed(&self) -> Vec<Found> {
        let order = self.table.heard();
        let mut found = vec![];
        for (nth, &row) in order.iter().enumerate() {
            if self.space.is_empty(row) {
                continue;
            }
            match self.space.left_of(row, &order[..nth]) {
                Left::Nothing => {}
                Left::Example(_) => continue,
                Left::GaveUp => {
                    found.push(self.of_table(TOO_LARGE.to_owned()));
                    break;
                }
            }
            let message = format!("row {} is never reached: rows before it match all that it does", row + 1);
            let said = self.of_row(Code::Unreachable, row, message).warning();
            found.push(Found { rows: vec![row], said });
        }
        found
    }

    fn gap(&self) -> Option<Found> {
        let message = match self.space.gap() {
            Left::Nothing => return None,
            Left::Example(example) => format!("no row matches where {}", self.in_words(&example)),
            Left::GaveUp => {
                format!("the table is too large: the search for gaps ended after {MAX_REGIONS} regions")
            }
        };
        let Found { rows, said } = self.of_table(message);
        Some(Found { rows, said: said.help("a last row of `any` catches the rest") })
    }

    fn of_table(&self, message: String) -> Found {
        let said = self.rule.file.error(Code::Gap, self.rule.position, message).warning();
        Found { rows: vec![], said }
    }

    /// What is given in an example; an input of which every value will do is not worth a word.
    fn in_words(&self, example: &[String]) -> String {
        let inputs = self.table.given.iter().zip(example).filter(|(_, reads)| !reads.is_empty());
        let parts: Vec<String> = inputs.map(|((_, input), reads)| format!("{input} {reads}")).collect();
        if parts.is_empty() { "anything is given".to_owned() } else { parts.join(" and ") }
    }
}

fn same(a: &Expr, b: &Expr) -> Option<bool> {
    match (plain(a), plain(b)) {
        (Some(a), Some(b)) => Some(a == b),
        (None, None) => {
            let (a, b) = (property_of(a)?, property_of(b)?);
            ((a.0, a.1) == (b.0, b.1)).then_some(true)
        }
        _ => None,
    }
}
