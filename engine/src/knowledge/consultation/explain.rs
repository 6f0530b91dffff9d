//! Which rules, and which rows of tables, spoke of the last object, and what kept the others from it.

use std::fmt;

use super::Consultation;
use crate::class::value;
use crate::machine::scalar::{Object, Scalar, Written};
use crate::plan::{Effect, Plan};
use crate::rule::{Action, PropertyName, Rule};
use crate::symbols::Lexicon;
use crate::table::Table;
use crate::value::{Cell, Truth, Value};

/// A rule, or one row of a decision table, and whether it spoke of an object.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Considered {
    pub rule: String,
    pub file: String,
    /// The line of the rule, or of the table's row, from 1.
    pub line: usize,
    /// The row of the table, from 1.
    pub row: Option<usize>,
    /// What kept it from speaking; `None`: it spoke.
    pub miss: Option<Miss>,
}

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Miss {
    /// What is looked at, as the rule writes it; empty for a rule's whole condition.
    pub given: String,
    /// What it is; `None` is unknown.
    pub found: Option<Value>,
    /// What is asked of it; empty for a rule's whole condition.
    pub wanted: String,
}

impl fmt::Display for Miss {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.given.is_empty() {
            return out.write_str("its condition is not met");
        }
        match &self.found {
            Some(found) => write!(out, "{} is {found}, not {}", self.given, self.wanted),
            None => write!(out, "{} is unknown, and should be {}", self.given, self.wanted),
        }
    }
}

impl Consultation {
    /// The rules that set this property, tables row by row: which of them spoke of the last object, and why the others
    /// did not. Rules that look at other objects as well, and parts left to the interpreter, are not looked into:
    /// [`KnowledgeBase::why_not`] does that.
    pub fn considered(&mut self, property: &str) -> Vec<Considered> {
        self.infer();
        let name = PropertyName::new(&self.class, property);
        let mut out = vec![];
        for (rule, node) in self.rules.rules.iter().zip(&self.base.network.nodes) {
            let Some(planned) = &node.planned else { continue };
            if !rule.sets.contains_key(&name) || rule.clauses.len() != 1 || planned.interprets {
                continue;
            }
            let columns = &planned.plan.columns;
            let cell = |name| self.base.view(name, None).map_or(Cell::Unknown, |column| column.cell(0));
            let cells: Vec<Cell> = columns.iter().map(cell).collect();
            let places: Vec<usize> = (0..columns.len()).collect();
            let object = Object { columns: &places, cells: &cells, symbols: &self.base.symbols };
            out.extend(of_rule(rule, &planned.plan, &object));
        }
        out
    }
}

fn of_rule(rule: &Rule, plan: &Plan, object: &Object) -> Vec<Considered> {
    let whole = |miss| Considered {
        rule: rule.name().to_owned(),
        file: rule.file().to_owned(),
        line: rule.line,
        row: None,
        miss,
    };
    let scalar = Scalar { object, slots: &[] };
    if plan.clauses[0].own.as_ref().is_some_and(|own| scalar.truth(own) != Truth::True) {
        let miss = Miss { given: String::new(), found: None, wanted: String::new() };
        return vec![whole(Some(miss))];
    }
    let (Action::Table(table), Effect::Conclude { then, .. }) = (&rule.action, &plan.effect) else {
        return vec![whole(None)];
    };
    // The first steps of a table look at its inputs, one each.
    let mut slots = Written::default();
    slots.clear(then.slots);
    slots.act(&then.steps[..table.given.len()], object);
    let misses = rows(table, &slots.cells[..table.given.len()], object.symbols);
    let rows = table.rows.iter().zip(misses).enumerate();
    rows.map(|(number, (row, miss))| Considered {
        line: row.position.line().unwrap_or(rule.line),
        row: Some(number + 1),
        ..whole(miss)
    })
    .collect()
}

fn rows(table: &Table, inputs: &[Cell], symbols: &Lexicon) -> Vec<Option<Miss>> {
    let symbols = symbols.read();
    let miss = |(row, column): (&crate::table::Row, Option<usize>)| {
        let column = column?;
        let (given, found) = (table.given[column].1.clone(), value(inputs[column], &symbols));
        Some(Miss { given, found, wanted: row.tests[column].0.to_string() })
    };
    let mut misses: Vec<Option<Miss>> =
        table.rows.iter().zip(table.misses(inputs, &symbols)).map(miss).collect();
    // Where the first row that matches counts, those after it were not asked.
    if table.hit.takes_one() {
        let heard = table.heard();
        let spoke = heard.iter().position(|&row| misses[row].is_none());
        for &row in heard.iter().skip(spoke.map_or(heard.len(), |spoke| spoke + 1)) {
            misses[row].get_or_insert_with(|| Miss {
                given: "the first row that matches".into(),
                found: spoke.map(|spoke| Value::Number((heard[spoke] + 1) as f64)),
                wanted: format!("{}", row + 1),
            });
        }
    }
    misses
}
