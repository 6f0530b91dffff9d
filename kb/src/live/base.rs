//! What is told of a site, and what follows in memory: the part of [`Live`](super::Live) that edits change first.

use adit_engine::{KnowledgeBase as Inference, Value};
use adit_planners::facts::{Column, Facts, Table};

use crate::classes;
use crate::derive::Derived;
use crate::error::{Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::told::{Attached, Told};

/// Base facts, and an inference over them.
pub struct Base {
    /// What people, robots and tables tell.
    pub told: Told,
    /// Which objects facts are about.
    pub attached: Attached,
    /// What planners said of classes other than rooms and doors.
    pub planned: Facts,
    /// What facts of an edit that is not committed yet are about.
    pub pending: Option<Attached>,
    /// What rules concluded.
    pub knowledge: Inference,
}

impl Base {
    /// What a derivation made of what was told.
    pub fn of(derived: Derived, told: Told) -> Self {
        let Derived { knowledge, attached, facts: mut planned, .. } = derived;
        planned.retain(|class, _| !["ROOMS", "DOORS"].contains(&class.as_str()));
        Self { told, attached, planned, pending: None, knowledge }
    }

    /// A copy to try edits on; the inference goes on from what was concluded.
    pub fn fork(&self) -> Self {
        Self {
            told: self.told.clone(),
            attached: self.attached.clone(),
            planned: self.planned.clone(),
            pending: None,
            knowledge: self.knowledge.fork(),
        }
    }

    /// Tells the classes and facts that differ. Other columns than before have to be looked at as a build does.
    ///
    /// # Returns
    /// Which objects facts are now about; `None` where all has to be derived anew.
    pub fn tell(&mut self, told: &Told, site: &KnowledgeBase) -> Result<Option<Attached>> {
        if told.classes.len() != self.told.classes.len() {
            return Ok(None);
        }
        let kinds = |table: &Table| -> Vec<_> {
            let kind = |(name, column): &(String, Column)| (name.clone(), std::mem::discriminant(column));
            table.columns.iter().map(kind).collect()
        };
        let Some(mut attached) = self.told_of_planned(told, site)? else { return Ok(None) };
        for (class, table) in &told.classes {
            let Some(before) = self.told.classes.get(class) else { return Ok(None) };
            if kinds(before) != kinds(table) {
                return Ok(None);
            }
            if before != table || !self.told.facts_of(class).eq(told.facts_of(class)) {
                classes::assert(&mut self.knowledge, class, table)?;
            }
            told.tell(&mut self.knowledge, class, &mut attached)?;
        }
        Ok(Some(attached))
    }

    /// Tells the facts about what planners give.
    fn told_of_planned(&mut self, told: &Told, site: &KnowledgeBase) -> Result<Option<Attached>> {
        let planned = |told: &Told| -> Vec<_> {
            let facts = told.facts.iter().filter(|fact| !told.classes.contains_key(&fact.class));
            facts.cloned().collect()
        };
        let (before, now) = (planned(&self.told), planned(told));
        let given: Vec<String> =
            site.planners().iter().flat_map(|planner| planner.signature().gives).collect();
        let is_given = |class: &str, property: &str| {
            given.iter().any(|given| {
                let name = given.split(':').next().unwrap_or(given);
                classes::split(name.trim()) == (class, property)
            })
        };
        // what a planner said of rooms and doors is not in memory any more
        let differ = before
            .iter()
            .filter(|fact| !now.contains(fact))
            .chain(now.iter().filter(|f| !before.contains(f)));
        let is_forgotten = |class: &str| !self.planned.contains_key(class);
        if differ.into_iter().any(|fact| is_forgotten(&fact.class) && is_given(&fact.class, &fact.property)) {
            return Ok(None);
        }
        let mut attached = Attached::default();
        told.attach(&self.knowledge, |class| !told.classes.contains_key(class), &mut attached);
        self.pending = Some(attached.clone());
        self.change_planned(&self.attached.clone(), &attached, told)?;
        Ok(Some(attached))
    }

    /// Tells of each object of a planner's class what counts now instead of before.
    fn change_planned(&mut self, before: &Attached, now: &Attached, told: &Told) -> Result<()> {
        let is_planned = |class: &str| !told.classes.contains_key(class);
        for ((class, row, property), fact) in
            now.cells().iter().filter(|((class, _, _), _)| is_planned(class))
        {
            fact.tell_row(&mut self.knowledge, class, *row, property)?;
        }
        for cell in
            before.cells().keys().filter(|cell| is_planned(&cell.0) && !now.cells().contains_key(*cell))
        {
            let (class, row, property) = cell;
            let said = self.planned.get(class).and_then(|table| table.column(property));
            let value = said.and_then(|column| value_of(column, *row));
            let told = self.knowledge.tell_row(class, *row, property, value);
            told.map_err(|error| Error::said("tell/refused", error.to_string(), None))?;
        }
        Ok(())
    }

    /// The robots, in the order of their names.
    pub fn robots(&self) -> Vec<String> {
        let states = self.told.classes.get("ROBOTS").and_then(|table| table.texts("robot").ok());
        let mut robots: Vec<String> = states.into_iter().flatten().flatten().cloned().collect();
        robots.dedup();
        robots
    }

    /// Makes what was told what counts.
    pub fn accept(&mut self, told: Told, attached: Attached) {
        (self.told, self.attached, self.pending) = (told, attached, None);
    }

    /// Tells again what counted before an edit that was not committed.
    pub fn take_back(&mut self) -> Result<()> {
        let told = self.told.clone();
        if let Some(pending) = self.pending.take() {
            self.change_planned(&pending, &self.attached.clone(), &told)?;
        }
        for (class, table) in &told.classes {
            classes::assert(&mut self.knowledge, class, table)?;
            told.tell(&mut self.knowledge, class, &mut Attached::default())?;
        }
        Ok(())
    }
}

/// A value of a column as it is told.
fn value_of(column: &Column, row: usize) -> Option<Value> {
    match column {
        Column::Number(values) => values[row].map(Value::Number),
        Column::Text(values) => values[row].as_deref().map(Value::from),
        Column::Truth(values) => values[row].map(Value::Truth),
    }
}
