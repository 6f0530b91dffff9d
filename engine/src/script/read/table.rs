//! From an item's inputs to a decision table.

use rhai::{Expr, Position};

use super::item::Item;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, FileScope};
use crate::script::names::property_of;
use crate::script::syntax::Slot;
use crate::suggest::nearest;
use crate::table::{Fold, Hit, Row, Table, Test, plain, written};
use crate::value::{Type, Value};

const MAX_ROWS: usize = 10_000;

/// The functions that cells may hold, with the number of their arguments.
const TESTS: [(&str, usize); 6] =
    [("not", 1), ("below", 1), ("at_most", 1), ("above", 1), ("at_least", 1), ("between", 2)];

/// What a table does; `None` if it is wrong, and then that is on the list.
pub(super) fn table(
    item: &Item,
    clauses: &[Clause],
    file: &FileScope,
    problems: &mut Vec<Diagnostic>,
) -> Option<Action> {
    let mut reader = Reader { file, problems };
    let hit = reader.hit(item)?;
    let given = reader.given(item.input(Slot::Given)?)?;
    let set = reader.set(item.input(Slot::Set)?, clauses)?;
    let outputs = if hit == Hit::Collect(Fold::Count) { 0 } else { set.len() };
    if outputs == 0 && set.len() != 1 {
        let position = item.input(Slot::Set)?.start_position();
        reader.wrong(position, "a table that counts its rows sets one property".to_owned());
        return None;
    }
    let rows = reader.rows(item.input(Slot::Rows)?, (given.len(), outputs))?;
    let table = Table { hit, given, set, rows };
    reader.columns(&table);
    reader.ranked(&table);
    Some(Action::Table(Box::new(table)))
}

struct Reader<'r> {
    file: &'r FileScope,
    problems: &'r mut Vec<Diagnostic>,
}

impl Reader<'_> {
    fn wrong(&mut self, position: Position, message: String) -> &mut Diagnostic {
        self.problems.push(self.file.error(Code::Table, position, message));
        let last = self.problems.len() - 1;
        &mut self.problems[last]
    }

    fn list<'e>(&mut self, expr: &'e Expr, what: &str) -> Option<&'e [Expr]> {
        match expr {
            Expr::Array(elements, _) => Some(elements),
            other => {
                self.wrong(other.start_position(), format!("{what} belongs here, in square brackets"));
                None
            }
        }
    }

    fn hit(&mut self, item: &Item) -> Option<Hit> {
        Some(match item.text(Slot::Hit)?.0 {
            "unique" => Hit::Unique,
            "any" => Hit::Any,
            "first" => Hit::First,
            "priority" => {
                let values = self.list(item.input(Slot::HitValues)?, "a list of values, best first,")?;
                Hit::Priority(values.iter().map(|value| self.literal(value)).collect::<Option<_>>()?)
            }
            _ => Hit::Collect(match item.text(Slot::HitFold)?.0 {
                "sum" => Fold::Sum,
                "min" => Fold::Min,
                "max" => Fold::Max,
                _ => Fold::Count,
            }),
        })
    }

    fn given(&mut self, expr: &Expr) -> Option<Vec<(Expr, String)>> {
        let inputs = self.list(expr, "a list of what the table looks at")?;
        if inputs.is_empty() {
            self.wrong(expr.start_position(), "a table looks at one input at least".to_owned());
            return None;
        }
        let written = self.file.source.cells(expr.start_position());
        let named = |(input, written): (&Expr, String)| match property_of(input) {
            Some((variable, property, _)) => format!("{variable}.{property}"),
            None => written,
        };
        Some(inputs.iter().zip(written).map(|both| (both.0.clone(), named(both))).collect())
    }

    fn set(&mut self, expr: &Expr, clauses: &[Clause]) -> Option<Vec<(usize, String, Position)>> {
        let mut set: Vec<(usize, String, Position)> = vec![];
        for target in self.list(expr, "a list of the properties that the table sets")? {
            let found = property_of(target).and_then(|(variable, property, position)| {
                let bound = |clause: &Clause| clause.quantifier.binds() && clause.variable == variable;
                Some((clauses.iter().position(bound)?, property.to_owned(), position))
            });
            let Some(found) = found else {
                let message = "a table sets properties of its variables, as in `set [ door.hardness ]`";
                self.wrong(target.start_position(), message.to_owned());
                return None;
            };
            if set.iter().any(|(clause, property, _)| (clause, property) == (&found.0, &found.1)) {
                self.wrong(found.2, format!("`{}` stands twice in this list", found.1));
                return None;
            }
            set.push(found);
        }
        if set.is_empty() {
            self.wrong(expr.start_position(), "a table sets one property at least".to_owned());
            return None;
        }
        Some(set)
    }

    fn rows(&mut self, expr: &Expr, (inputs, outputs): (usize, usize)) -> Option<Vec<Row>> {
        let listed = self.list(expr, "a list of rows, each a list of cells,")?;
        if listed.len() > MAX_ROWS {
            self.wrong(expr.start_position(), format!("a table has at most {MAX_ROWS} rows"));
            return None;
        }
        let mut rows = vec![];
        let mut right = true;
        for (nth, row) in (1..).zip(listed) {
            let Some(cells) = self.list(row, "a row, that is a list of cells,") else {
                right = false;
                continue;
            };
            if cells.len() != inputs + outputs {
                let plural = if cells.len() == 1 { "" } else { "s" };
                let message = format!(
                    "row {nth} has {} cell{plural}; it needs {inputs} for what is given and {outputs} for what is set",
                    cells.len()
                );
                self.wrong(row.start_position(), message);
                right = false;
                continue;
            }
            let tests: Vec<_> = cells[..inputs]
                .iter()
                .filter_map(|cell| Some((self.test(cell)?, cell.start_position())))
                .collect();
            right &= tests.len() == inputs;
            let outputs = cells[inputs..].to_vec();
            rows.push(Row { position: row.start_position(), tests, outputs });
        }
        if listed.is_empty() {
            self.wrong(expr.start_position(), "a table has one row at least".to_owned());
        }
        (right && !rows.is_empty()).then_some(rows)
    }

    fn test(&mut self, cell: &Expr) -> Option<Test> {
        match cell {
            Expr::Variable(name, ..) if name.1 == "any" => Some(Test::Any),
            Expr::Array(elements, _) => Some(Test::OneOf(
                elements.iter().map(|element| self.literal(element)).collect::<Option<_>>()?,
            )),
            Expr::FnCall(call, _) if plain(cell).is_none() => {
                let number = |reader: &mut Self, nth: usize| reader.number(&call.args[nth]);
                Some(match (call.name.as_str(), call.args.len()) {
                    ("not", 1) => Test::Not(Box::new(self.test(&call.args[0])?)),
                    ("below", 1) => Test::Below(number(self, 0)?),
                    ("at_most", 1) => Test::AtMost(number(self, 0)?),
                    ("above", 1) => Test::Above(number(self, 0)?),
                    ("at_least", 1) => Test::AtLeast(number(self, 0)?),
                    ("between" | "..", 2) => self.between(cell, &call.args[0], &call.args[1])?,
                    _ => {
                        self.no_cell(cell, &call.name);
                        return None;
                    }
                })
            }
            _ => Some(Test::OneOf(vec![self.literal(cell)?])),
        }
    }

    fn between(&mut self, cell: &Expr, from: &Expr, to: &Expr) -> Option<Test> {
        let (from, to) = (self.number(from)?, self.number(to)?);
        if from < to {
            return Some(Test::Between(from, to));
        }
        let message = format!("nothing is at least {from} and below {to}");
        self.wrong(cell.start_position(), message);
        None
    }

    fn number(&mut self, expr: &Expr) -> Option<f64> {
        match self.literal(expr)? {
            Value::Number(number) => Some(number),
            other => {
                let message = format!("a number belongs here, not {}", written(&other));
                self.wrong(expr.start_position(), message);
                None
            }
        }
    }

    fn literal(&mut self, expr: &Expr) -> Option<Value> {
        if let Some(literal) = plain(expr) {
            return Some(literal);
        }
        let Expr::Variable(name, _, position) = expr else {
            self.no_cell(expr, "");
            return None;
        };
        if let Some(constant) = self.file.constants.get(name.1.as_str()) {
            return Some(constant.clone());
        }
        let names = self.file.constants.keys().map(String::as_str).chain(["any"]);
        let meant = nearest(&name.1, names).map(str::to_owned);
        let message = format!("nothing here is called `{}`", name.1);
        let problem = self.file.error(Code::UnknownVariable, *position, message);
        self.problems.push(problem.did_you_mean(meant.as_deref()));
        None
    }

    fn no_cell(&mut self, expr: &Expr, name: &str) {
        let meant = nearest(name, TESTS.iter().map(|(name, _)| *name)).map(str::to_owned);
        let known = TESTS.iter().find(|(test, _)| *test == name);
        let help = match (known, meant) {
            (Some((test, wanted)), _) => {
                let plural = if *wanted == 1 { "" } else { "s" };
                format!("`{test}` takes {wanted} value{plural}")
            }
            (None, Some(meant)) => format!("did you mean `{meant}`?"),
            (None, None) => {
                "as in \"z\", 3, any, [\"a\", \"b\"], not(\"z\"), below(3), at_most(3), above(3), \
                             at_least(3), between(1, 3)"
                    .to_owned()
            }
        };
        let message = "a cell holds a value, a list of values, `any`, or one of the tests of tables";
        let problem = self.wrong(expr.start_position(), message.to_owned());
        *problem = problem.clone().help(help);
    }

    /// One input is compared with values of one type.
    fn columns(&mut self, table: &Table) {
        for column in 0..table.given.len() {
            let mut first: Option<Type> = None;
            for row in &table.rows {
                let (test, position) = &row.tests[column];
                for literal in test.literals() {
                    let expected = *first.get_or_insert(literal.kind());
                    if literal.kind() != expected {
                        let message = format!(
                            "{} stand in this column, and {} is none of them",
                            expected.plural(),
                            written(&literal)
                        );
                        self.wrong(*position, message);
                        break;
                    }
                }
            }
        }
    }

    /// Every row of a table with priorities has one.
    fn ranked(&mut self, table: &Table) {
        let Hit::Priority(values) = &table.hit else { return };
        for row in &table.rows {
            let first = &row.outputs[0];
            if plain(first).is_none_or(|value| !values.contains(&value)) {
                let listed: Vec<String> = values.iter().map(written).collect();
                let message = format!("the first output is one of {}", listed.join(", "));
                self.wrong(first.start_position(), message);
            }
        }
    }
}
