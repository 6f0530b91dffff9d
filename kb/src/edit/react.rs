//! Rules that react. What they tell is written as edits are, with who = the rule: a column of a table of the site's own is
//! set, rows of such tables come and go, and all else is a fact.

use std::collections::{BTreeMap, BTreeSet};

use adit_db::carried_out::CarriedOut as Kept;
use adit_db::history::Author;
use adit_db::relation::Form;
use adit_db::told::Told as Row;
use adit_db::{Cell, Tx};
use adit_engine::{CarriedOut, Diagnostic, Firing, RuleBase, Told as Done, Value};
use adit_planners::facts::{Column, Table};

use super::Tell;
use super::undo::called;
use crate::error::{Code, Error, Result};
use crate::knowledge::classes::{self, ROUTES};
use crate::knowledge::told::{Object, Told};
use crate::site::clock::stored;
use crate::state::keep::LastBuild;
use crate::state::{Nothing, State, Step};
use crate::words::progress::Progress;

/// Reactions that follow from what planners gave anew because of reactions: so many times at most.
const ROUNDS: usize = 100;

/// What a state recalls of planners' facts.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Recalled {
    OfLastBuild,
    Nothing,
}

impl State {
    /// As [`State::step`]; then rules that react are carried out, what they tell is written, and the state steps to that, until
    /// none waits. The step says what they did.
    pub(crate) fn step_and_react(
        &mut self,
        tx: &mut Tx<'_>,
        told: Told,
        recalled: Recalled,
        progress: &dyn Progress,
    ) -> Result<Step> {
        let inputs = self.inputs.clone();
        let rules = &inputs.rules;
        let mut step = self.step_recalling(tx, told, recalled, progress)?;
        if !rules.rules().iter().any(adit_engine::Rule::reacts) {
            return Ok(step);
        }
        let known = tx.carried_out()?;
        let mut carried_out: Vec<CarriedOut> = known.iter().map(of_kept).collect();
        let (mut said, mut notes, mut failed) = (Vec::new(), BTreeSet::new(), Vec::new());
        for round in 0.. {
            self.tell_routes(rules, &step)?;
            self.knowledge.resume(rules, &carried_out);
            if !self.knowledge.is_waiting(rules) {
                break;
            }
            if round == ROUNDS {
                notes.insert(endless(&said));
                break;
            }
            let mut fork = self.knowledge.fork();
            fork.resume(rules, &carried_out);
            let run = fork.react(rules);
            failed.extend(run.diagnostics.iter().filter(|problem| notes.insert(note(problem))).cloned());
            carried_out = fork.carried_out(rules);
            let mut tables = Tables::of(self, tx)?;
            for firing in &run.firings {
                said.extend(self.write(tx, (firing, &step), &mut tables)?);
            }
            if run.firings.is_empty() {
                break;
            }
            let told = self.site.told(tx, rules)?;
            self.take_back()?;
            step = self.step_recalling(tx, told, recalled, progress)?;
        }
        let now: Vec<Kept> = self.knowledge.carried_out(rules).into_iter().map(kept).collect();
        if now != known {
            tx.replace_carried_out(&now)?;
        }
        step.told.notes.extend(notes);
        (step.reacted, step.failed) = (said, failed);
        Ok(step)
    }

    fn step_recalling(
        &mut self,
        tx: &mut Tx<'_>,
        told: Told,
        recalled: Recalled,
        progress: &dyn Progress,
    ) -> Result<Step> {
        match recalled {
            Recalled::OfLastBuild => self.step(told, &mut LastBuild(tx), progress),
            Recalled::Nothing => self.step(told, &mut Nothing, progress),
        }
    }

    /// Tells what routes between places cost, where a rule that reacts reads that.
    fn tell_routes(&mut self, rules: &RuleBase, step: &Step) -> Result<()> {
        if !rules.rules().iter().any(|rule| rule.classes().any(|class| class == ROUTES)) {
            return Ok(());
        }
        let costs = self.place_costs(step);
        let text = |of: fn(&(String, String, String)) -> &String| -> Column {
            costs.keys().map(|ends| Some(of(ends).clone())).collect()
        };
        let table = Table::default()
            .with("robot", text(|ends| &ends.0))
            .with("start", text(|ends| &ends.1))
            .with("goal", text(|ends| &ends.2))
            .with("cost", costs.values().map(|cost| Some(*cost)).collect::<Column>());
        classes::assert(&mut self.knowledge, ROUTES, &table, false)
    }

    /// Writes what a rule told; in sentences what that is.
    fn write(
        &self,
        tx: &mut Tx<'_>,
        (firing, step): (&Firing, &Step),
        tables: &mut Tables,
    ) -> Result<Vec<String>> {
        let author = Author { who: called(&firing.rule), why: firing.because.clone() };
        let mut said = Vec::new();
        for done in &firing.told {
            let words = self.write_one(tx, (done, step), tables, &author).map_err(|error| {
                let message = format!("{} cannot do what it says: {error}", author.who);
                Error::said(Code::RuleNotCarriedOut, message, Some(format!("it was met by {}", author.why)))
            })?;
            said.extend(words.map(|words| format!("{words}, by {} ({})", author.who, author.why)));
        }
        Ok(said)
    }

    fn write_one(
        &self,
        tx: &mut Tx<'_>,
        (done, step): (&Done, &Step),
        tables: &mut Tables,
        author: &Author,
    ) -> Result<Option<String>> {
        match done {
            Done::Object { class, properties } => {
                let table = tables.own(class)?;
                let mut row = Vec::new();
                for (property, value) in properties {
                    tables.widen(tx, &table, property, value)?;
                    row.push((property.as_str(), cell(value)));
                }
                let edited = tx.add_row(&table, &row, author)?;
                Ok(Some(format!("{table}.{}: {}", edited.key, super::change(&Cell::Null, &edited.new))))
            }
            Done::Gone { class, key } => {
                let table = tables.own(class)?;
                let edited = tx.remove_row(&table, key, author)?;
                Ok(Some(format!("{table}.{}: {}", edited.key, super::change(&edited.old, &Cell::Null))))
            }
            Done::Value { class, key, property, value, lasts } => {
                let table = tables.own(class).ok().filter(|_| lasts.is_none());
                // what is told of the property stands before its cell, and before what this rule told earlier
                let is_all = value.is_none() || table.is_some();
                let who = (!is_all).then_some(author.who.as_str());
                let over = facts_about(&tx.facts_told()?, step, (class, key, property), who);
                for id in &over {
                    tx.remove_row("told", &id.to_string(), author)?;
                }
                if let Some(table) = table {
                    return tables.set(tx, (&table, key, property), value.as_ref(), author);
                }
                let Some(value) = value else {
                    let words = format!("nothing is told of {class} {key} {property} any more");
                    return Ok((!over.is_empty()).then_some(words));
                };
                let now = self.site.clock().now();
                let until = lasts.and_then(|seconds| {
                    now.checked_add(std::time::Duration::try_from_secs_f64(seconds.ceil()).ok()?).ok()
                });
                let tell = Tell {
                    class: class.clone(),
                    object: key.clone(),
                    property: property.clone(),
                    value: value.to_string(),
                    until: until.map(stored),
                    new_property: true,
                };
                // the last build kept what there was before this one
                let object = Object::placed(&self.knowledge, class, key);
                let row = tell.row_about(tx, (&self.site, &self.inputs.rules), author, object)?;
                let done = tx.add_row("told", &row, author)?;
                Ok(Some(format!("fact {}: {}", done.key, super::change(&Cell::Null, &done.new))))
            }
        }
    }
}

/// The tables of the site's own, with their columns.
struct Tables {
    columns: BTreeMap<String, BTreeSet<String>>,
}

impl Tables {
    fn of(state: &State, tx: &mut Tx<'_>) -> Result<Self> {
        let planned = state.site.planned_classes();
        let own = tx.user_tables()?.into_iter().filter(|table| {
            matches!(table.form, Form::Table) && !planned.contains(&table.name.to_uppercase())
        });
        let own: BTreeSet<String> = own.map(|table| table.name).collect();
        let named = tx.relations()?.into_iter().filter(|relation| own.contains(&relation.name));
        Ok(Self {
            columns: named.map(|relation| (relation.name, relation.columns.into_iter().collect())).collect(),
        })
    }

    /// The table of a class.
    fn own(&self, class: &str) -> Result<String> {
        let found = self.columns.keys().find(|name| name.to_uppercase() == class);
        found.cloned().ok_or_else(|| {
            let message = format!(
                "{class} is no table of the site's own: its objects are not for rules to make or to forget"
            );
            Error::said(Code::EditUnknownTable, message, None)
        })
    }

    /// Sets a cell; in words what that changed. What is no column has no value to take back.
    fn set(
        &mut self,
        tx: &mut Tx<'_>,
        (table, key, property): (&str, &str, &str),
        value: Option<&Value>,
        author: &Author,
    ) -> Result<Option<String>> {
        match value {
            Some(value) => self.widen(tx, table, property, value)?,
            None if self.columns.get(table).is_none_or(|columns| !columns.contains(property)) => {
                return Ok(Some(format!("nothing is told of {table} {key} {property} any more")));
            }
            None => {}
        }
        let value = value.map_or(Cell::Null, cell);
        if tx.cell(table, key, property)? == value {
            return Ok(None);
        }
        let edited = tx.set_cell((table, key, property), &value, author)?;
        Ok(Some(format!("{table}.{}.{property}: {} → {}", edited.key, edited.old, edited.new)))
    }

    /// Adds a column where there is none of this name.
    fn widen(&mut self, tx: &mut Tx<'_>, table: &str, column: &str, value: &Value) -> Result<()> {
        let Some(columns) = self.columns.get_mut(table) else { return Ok(()) };
        if columns.insert(column.to_owned()) {
            let kind = match value {
                Value::Number(_) => "REAL",
                Value::Text(_) => "TEXT",
                Value::Truth(_) => "BOOLEAN",
            };
            tx.add_column(table, column, kind)?;
        }
        Ok(())
    }
}

/// Makes the tables of classes of which rules tell objects, where there is none: their rows are numbered.
pub(crate) fn make_tables(tx: &mut Tx<'_>, rules: &RuleBase) -> Result<()> {
    let known: BTreeSet<String> =
        tx.relations()?.into_iter().map(|known| known.name.to_uppercase()).collect();
    for class in rules.tells().filter(|class| !known.contains(&class.to_uppercase())) {
        tx.replace_user_table(&class.to_lowercase(), &[("row", "INTEGER")], &["row"], [])?;
    }
    Ok(())
}

/// The facts about a property of an object, by number; only those of one teller, where one is named.
fn facts_about(
    rows: &[Row],
    step: &Step,
    (class, key, property): (&str, &String, &str),
    who: Option<&str>,
) -> Vec<i64> {
    let is_object = |row: &Row| row.key.as_ref() == Some(key) || step.attached.keys(row.id).contains(key);
    let about = rows.iter().filter(|row| {
        row.class == class
            && row.property == property
            && who.is_none_or(|who| row.who == who)
            && is_object(row)
    });
    about.map(|row| row.id).collect()
}

fn cell(value: &Value) -> Cell {
    match value {
        Value::Number(number) => Cell::Real(*number),
        Value::Text(text) => Cell::from(&**text),
        Value::Truth(truth) => Cell::Integer((*truth).into()),
    }
}

fn note(problem: &Diagnostic) -> String {
    let help = problem.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
    format!("{} ({}, line {}){help}", problem.message, problem.file, problem.line)
}

fn endless(said: &[String]) -> String {
    let last = said.last().map_or_else(String::new, |last| format!("; the last thing that was told: {last}"));
    format!(
        "rules that react do not come to an end in {ROUNDS} rounds: what they tell makes planners give other facts{last}"
    )
}

fn of_kept(kept: &Kept) -> CarriedOut {
    let Kept { rule, version, because } = kept.clone();
    CarriedOut { rule, version, because }
}

fn kept(done: CarriedOut) -> Kept {
    let CarriedOut { rule, version, because } = done;
    Kept { rule, version, because }
}
