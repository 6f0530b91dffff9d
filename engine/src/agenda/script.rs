//! Runs the parts of conditions that stay with the interpreter.

use std::cell::RefCell;
use std::time::Instant;

use rhai::{Dynamic, Engine, ImmutableString, Map, Scope};

use super::evaluate::{Bound, Evaluator};
use crate::diagnostic::{Code, Diagnostic};
use crate::plan::fragment::{Fragment, Source};
use crate::rule::Rule;
use crate::script::failure::failure;
use crate::script::interpreter::start_run;
use crate::symbols::Symbols;
use crate::value::{Cell, Value};

/// The interpreter for one rule.
pub(crate) struct Scripts<'s> {
    pub(crate) rule: &'s Rule,
    pub(crate) runner: &'s Engine,
    pub(crate) deadline: Instant,
    /// The first failure.
    pub(crate) trouble: RefCell<Option<Diagnostic>>,
}

impl Scripts<'_> {
    /// What a part gives: unknown where anything that it looks at is unknown.
    pub(crate) fn value(&self, fragment: &Fragment, evaluator: &Evaluator, bound: &Bound) -> Cell {
        let stopped = self.trouble.borrow().as_ref().is_some_and(|trouble| trouble.code == Code::Deadline);
        if stopped {
            return Cell::Unknown;
        }
        let Some(mut scope) = scope(fragment, evaluator, bound) else { return Cell::Unknown };
        start_run(self.deadline);
        match self.runner.eval_ast_with_scope::<Dynamic>(&mut scope, &fragment.script) {
            Ok(result) => match plain(&result) {
                Ok(value) => value.map_or(Cell::Unknown, |value| evaluator.symbols.borrow_mut().cell(&value)),
                Err(kind) => {
                    let place = self.rule.file.source.place(fragment.position);
                    let message =
                        format!("rule \"{}\": a condition cannot use a value of type {kind}", self.rule.name);
                    self.failed(Diagnostic::error(Code::Evaluation, &place, message));
                    Cell::Unknown
                }
            },
            Err(error) => {
                self.failed(failure(self.rule, fragment.position, &error).0);
                Cell::Unknown
            }
        }
    }

    fn failed(&self, problem: Diagnostic) {
        self.trouble.borrow_mut().get_or_insert(problem);
    }
}

fn scope<'f>(fragment: &'f Fragment, evaluator: &Evaluator, bound: &Bound) -> Option<Scope<'f>> {
    let mut scope = Scope::new();
    let value = |variable: usize, column: usize| {
        let cell = evaluator.world.cell(evaluator.columns[column], bound.ids[variable]);
        dynamic(cell, &evaluator.symbols.borrow())
    };
    for (name, constant) in &fragment.constants {
        scope.push_dynamic(name.as_str(), constant.clone());
    }
    for (name, clause) in &fragment.numbers {
        let number = Some(bound.numbers[*clause]).filter(|number| !number.is_nan())?;
        scope.push_dynamic(name.as_str(), number.into());
    }
    for (name, variable, column) in &fragment.bare {
        scope.push_dynamic(name.as_str(), value(*variable, *column)?);
    }
    for (name, object) in &fragment.objects {
        let mut map = Map::new();
        for (property, source) in &object.properties {
            if let Source::Column(column) = source {
                map.insert(property.as_str().into(), value(object.variable, *column)?);
            }
        }
        scope.push_dynamic(name.as_str(), Dynamic::from_map(map));
    }
    Some(scope)
}

/// A value as scripts see it; `None` is unknown.
pub(crate) fn dynamic(cell: Cell, symbols: &Symbols) -> Option<Dynamic> {
    Some(match cell {
        Cell::Unknown => return None,
        Cell::Number(number) => number.into(),
        Cell::Truth(truth) => truth.into(),
        Cell::Text(symbol) => {
            let text: &str = symbols.text(symbol)?;
            Dynamic::from(ImmutableString::from(text))
        }
    })
}

/// What a script gave as a property can hold it; the name of its type if it cannot.
pub(crate) fn plain(value: &Dynamic) -> Result<Option<Value>, &str> {
    if let Ok(number) = value.as_float() {
        Ok(Some(Value::Number(number)).filter(|_| !number.is_nan()))
    } else if let Ok(number) = value.as_int() {
        Ok(Some(Value::Number(number as f64)))
    } else if let Ok(truth) = value.as_bool() {
        Ok(Some(Value::Truth(truth)))
    } else if value.is_unit() {
        Ok(None)
    } else if value.is_string() || value.is_char() {
        Ok(Some(Value::from(value.to_string().as_str())))
    } else {
        Err(value.type_name())
    }
}
