//! Runs the body of a reaction, and prepares the classes that bodies tell.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rhai::{Dynamic, Scope};

use super::KnowledgeBase;
use super::evaluate::Known;
use super::react::Run;
use super::undo::Edit;
use crate::agenda::Binding;
use crate::agenda::world::Facts;
use crate::class::Class;
use crate::column::Column;
use crate::diagnostic::{Code, Diagnostic};
use crate::machine::interpret::{dynamic, plain};
use crate::plan::fragment::{Fragment, Source};
use crate::plan::reaction::told;
use crate::rule::{PropertyName, Rule};
use crate::rule_base::RuleBase;
use crate::script::failure::failure;
use crate::script::interpreter::start_run;
use crate::script::reactor::{Lasting, Object, Write, reactor, with_run};
use crate::told::NamesTold;
use crate::value::Value;

impl Facts for KnowledgeBase {
    fn has(&self, class: &str) -> bool {
        self.held.contains_key(class)
    }

    fn count(&self, class: &str) -> usize {
        self.len(class).unwrap_or(0)
    }

    fn column(&self, name: &PropertyName) -> Option<&Column> {
        Self::column(self, name)
    }
}

impl KnowledgeBase {
    /// Makes the classes that bodies tell, and the properties whose type can be seen, so that rules that read them
    /// do not wait.
    pub(super) fn prepare(&mut self, rules: &RuleBase) {
        let names = NamesTold::of(&rules.rules);
        for class in names.classes.keys().filter(|class| !self.has(class)).copied().collect::<Vec<_>>() {
            // A class without properties is always right.
            self.assert(Class::new(class, &[])).unwrap_or_default();
        }
        let missing = |base: &Self| {
            names.properties.keys().any(|name| base.has(&name.class) && base.view(name, None).is_none())
        };
        if !missing(self) {
            return;
        }
        for rule in &rules.rules {
            let Some(reaction) = rule.reaction() else { continue };
            let kinds = Known { base: self, rule: None, told: Some(&names) };
            for (name, kind, _) in told(rule, reaction, &kinds, &self.symbols) {
                let Some(kind) = kind.filter(|_| self.view(&name, None).is_none()) else { continue };
                if let Some(held) = self.held.get_mut(&name.class) {
                    held.table.widen(&name.property, kind);
                    self.network.recheck = true;
                }
            }
        }
    }

    pub(super) fn body(
        &self,
        number: usize,
        binding: &Binding,
        rows: &[Option<usize>],
        run: &Run,
    ) -> Result<Vec<Edit>, Box<Diagnostic>> {
        let rule = &run.rules.rules[number];
        let outside = self.outside(run);
        let Some((body, columns, numbers)) = self.agenda.body(&outside, number, binding) else {
            return Ok(vec![]);
        };
        let known = self.known(rule, body, columns, binding);
        let mut scope = Scope::new();
        for (name, constant) in &body.constants {
            scope.push_dynamic(name.as_str(), constant.clone());
        }
        for (name, clause) in &body.numbers {
            let number = numbers[*clause];
            scope.push_dynamic(name.as_str(), if number.is_nan() { Dynamic::UNIT } else { number.into() });
        }
        let bound = rule.clauses.iter().enumerate().filter(|(_, clause)| clause.quantifier.binds());
        for (variable, clause) in bound {
            scope.push_dynamic(clause.variable.as_str(), Dynamic::from(Object(variable)));
        }
        start_run(run.until.min(self.limits.end(self.limits.rule)));
        let (done, writes) = with_run(known, || {
            let evaluate = || reactor().eval_ast_with_scope::<Dynamic>(&mut scope, &body.script);
            catch_unwind(AssertUnwindSafe(evaluate))
        });
        match done {
            Ok(Ok(_)) => {}
            Ok(Err(error)) => return Err(failure(rule, body.position, &error).0.into()),
            Err(_) => {
                let message = format!("rule \"{}\" failed inside the engine", rule.name);
                return Err(rule.file.error(Code::Panic, rule.position, message).into());
            }
        }
        let edits = writes.into_iter().filter_map(|write| edit(rule, body, rows, write).transpose());
        edits.collect()
    }

    fn known(
        &self,
        rule: &Rule,
        body: &Fragment,
        columns: &[usize],
        ids: &[u32],
    ) -> Vec<BTreeMap<String, Dynamic>> {
        let symbols = self.symbols.read();
        let mut known = vec![BTreeMap::new(); rule.clauses.len()];
        for object in body.objects.values() {
            for (property, source) in &object.properties {
                let Source::Column(column) = source else { continue };
                let cell = self.agenda.world.columns[columns[*column]].cell(ids[object.variable] as usize);
                let value = dynamic(cell, &symbols).map(|value| (property.clone(), value));
                known[object.variable].extend(value);
            }
        }
        known
    }
}

/// What a body asked for, with objects as rows; nothing where the object is gone.
fn edit(
    rule: &Rule,
    body: &Fragment,
    rows: &[Option<usize>],
    write: Write,
) -> Result<Option<Edit>, Box<Diagnostic>> {
    let value = |property: &str, value: &Dynamic| -> Result<Option<Value>, Box<Diagnostic>> {
        plain(value).map_err(|kind| {
            let message = format!("rule \"{}\": `{property}` cannot hold a value of type {kind}", rule.name);
            let problem = rule.file.error(Code::Evaluation, body.position, message);
            problem.help("nothing of this action was done").into()
        })
    };
    let object = |variable: usize| {
        let row = rows.get(variable).copied().flatten()?;
        Some((rule.clauses[variable].class.clone(), row))
    };
    Ok(match write {
        Write::Value { variable, property, value: given } => {
            let lasting = given.clone().try_cast::<Lasting>();
            let lasts = lasting.as_ref().map(|lasting| lasting.seconds);
            if lasts.is_some_and(|seconds| !seconds.is_finite() || seconds <= 0.0) {
                let message = format!(
                    "rule \"{}\": `{property}` cannot last {seconds} s",
                    rule.name,
                    seconds = lasts.unwrap_or_default()
                );
                let problem = rule.file.error(Code::Evaluation, body.position, message);
                return Err(problem.help("nothing of this action was done").into());
            }
            let value = value(&property, lasting.as_ref().map_or(&given, |lasting| &lasting.value))?;
            object(variable).map(|(class, row)| Edit::Value { class, row, property, value, lasts })
        }
        Write::Gone { variable } => object(variable).map(|(class, row)| Edit::Gone { class, row }),
        Write::Object { class, properties } => {
            let mut known = BTreeMap::new();
            for (property, given) in properties {
                if let Some(value) = value(&property, &given)? {
                    known.insert(property.to_string(), value);
                }
            }
            Some(Edit::Object { class, properties: known })
        }
    })
}
