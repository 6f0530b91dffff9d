//! Runs what stays with the interpreter, binding by binding.

use rhai::{Dynamic, EvalAltResult, Map, Scope};

use super::Machine;
use super::evaluate::Batch;
use super::lane::Rows;
use crate::class::value;
use crate::diagnostic::Code;
use crate::plan::action::Target;
use crate::plan::fragment::{Fragment, Source};
use crate::script::failure::failure;
use crate::script::interpreter::start_run;
use crate::symbols::Symbols;
use crate::value::{Cell, Value};

impl Machine<'_> {
    /// The fragment's value for each binding: unknown where anything that it looks at is unknown.
    pub(crate) fn interpret(&self, fragment: &Fragment, batch: Batch) -> Vec<Cell> {
        (0..batch.frame.len)
            .map(|index| {
                let active = batch.mask.is_none_or(|mask| mask[index]);
                let mut scope = self.scope(fragment, batch, index).filter(|_| active)?;
                self.run(fragment, &mut scope).map(|result| self.cell(&result, fragment))
            })
            .map(|cell| cell.unwrap_or(Cell::Unknown))
            .collect()
    }

    /// Runs a whole action for one binding. For each target: what was set, or `None` if it was not.
    /// Where anything that the action looks at is unknown, all that it may set is unknown.
    pub(crate) fn interpret_action(
        &self,
        fragment: &Fragment,
        targets: &[Target],
        batch: Batch,
        index: usize,
    ) -> Vec<Option<Cell>> {
        let Some(mut scope) = self.scope(fragment, batch, index) else {
            return vec![Some(Cell::Unknown); targets.len()];
        };
        if self.run(fragment, &mut scope).is_none() {
            return vec![Some(Cell::Unknown); targets.len()];
        }
        let set = |target: &Target| {
            let (name, _) = fragment.objects.iter().find(|(_, object)| object.variable == target.variable)?;
            let object = scope.get(name)?.as_map_ref().ok()?;
            let value = object.get(target.name.property.as_str())?.clone();
            drop(object);
            Some(self.cell(&value, fragment))
        };
        targets.iter().map(set).collect()
    }

    fn run(&self, fragment: &Fragment, scope: &mut Scope) -> Option<Dynamic> {
        if self.stopped.get() || self.tick().is_err() {
            return None;
        }
        start_run(self.deadline);
        match self.runner.eval_ast_with_scope::<Dynamic>(scope, &fragment.script) {
            Ok(result) => Some(result),
            Err(error) => {
                self.failed(fragment, &error);
                None
            }
        }
    }

    fn failed(&self, fragment: &Fragment, error: &EvalAltResult) {
        self.troubles.set(self.troubles.get() + 1);
        let (problem, limit) = failure(self.rule, fragment.position, error);
        if limit {
            self.stopped.set(true);
        }
        self.trouble.borrow_mut().get_or_insert(problem);
    }

    fn scope<'s>(&self, fragment: &'s Fragment, batch: Batch, index: usize) -> Option<Scope<'s>> {
        let mut scope = Scope::new();
        let column = |variable: usize, column: usize| {
            let row = batch.frame.rows[variable].at(index);
            self.dynamic(self.columns[column].cell(row as usize))
        };
        for (name, value) in &fragment.constants {
            scope.push_dynamic(name.as_str(), value.clone());
        }
        for (name, variable, number) in &fragment.bare {
            scope.push_dynamic(name.as_str(), column(*variable, *number)?);
        }
        for (name, clause) in &fragment.numbers {
            let Rows::Numbers(numbers) = &batch.frame.rows[*clause] else { return None };
            scope.push_constant_dynamic(name.as_str(), self.dynamic(Cell::number(numbers.at(index)))?);
        }
        for (name, object) in &fragment.objects {
            let mut map = Map::new();
            for (property, source) in &object.properties {
                let value = match source {
                    Source::Column(number) => column(object.variable, *number)?,
                    Source::Slot(slot) => self.dynamic(batch.slots[*slot].cell(index))?,
                };
                map.insert(property.as_str().into(), value);
            }
            scope.push_dynamic(name.as_str(), Dynamic::from_map(map));
        }
        for (name, slot, used) in &fragment.locals {
            let value = self.dynamic(batch.slots[*slot].cell(index));
            let value = if *used { value? } else { value.unwrap_or(Dynamic::UNIT) };
            scope.push_dynamic(name.as_str(), value);
        }
        Some(scope)
    }

    fn dynamic(&self, cell: Cell) -> Option<Dynamic> {
        dynamic(cell, &self.symbols.read())
    }

    fn cell(&self, value: &Dynamic, fragment: &Fragment) -> Cell {
        match plain(value) {
            Ok(value) => value.map_or(Cell::Unknown, |value| self.symbols.write().cell(&value)),
            Err(kind) => {
                let message =
                    format!("rule \"{}\": a property cannot hold a value of type {kind}", self.rule.name);
                self.troubles.set(self.troubles.get() + 1);
                let problem = fragment.file.error(Code::Evaluation, fragment.position, message);
                self.trouble.borrow_mut().get_or_insert(problem);
                Cell::Unknown
            }
        }
    }
}

/// A value as scripts see it; `None` is unknown.
pub(crate) fn dynamic(cell: Cell, symbols: &Symbols) -> Option<Dynamic> {
    value(cell, symbols).map(|value| (&value).into())
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
