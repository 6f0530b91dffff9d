//! Backward chaining: a value that is asked for, and nothing but what it needs.

use std::collections::BTreeMap;
use std::time::Instant;

use super::KnowledgeBase;
use super::conclude::{Asked, Run};
use super::dirty::Dirty;
use super::facts::FactError;
use super::memory::{Memory, Shape};
use super::network::Planned;
use crate::changes::Changes;
use crate::declared::{Declaration, Source};
use crate::machine::lane::Frame;
use crate::machine::output::{Buffer, Status};
use crate::order::Step;
use crate::plan::plan;
use crate::rule::{PropertyName, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::value::{Truth, Value};

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    Known(Value),
    /// No source gives one but the user: tell it, or that it is not known, and ask again.
    Ask(Question),
    NotKnown,
}

#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Question {
    pub property: PropertyName,
    pub key: String,
    /// The question as the property's declaration words it.
    pub text: String,
}

impl KnowledgeBase {
    /// Asks for a value. Of what nobody asked for yet, only what it needs is computed, source by source in the order
    /// that is declared: told, concluded by rules, a default, a question to the user.
    pub fn ask(
        &mut self,
        rules: &RuleBase,
        class: &str,
        key: &str,
        property: &str,
    ) -> Result<Answer, FactError> {
        if self.len(class).is_none() {
            return Err(FactError::NoClass { class: class.to_owned() });
        }
        let row = self.row(class, key).ok_or_else(|| FactError::no_object(class, &key))?;
        self.ask_rows(rules, class, &[row as u32], &[property]);
        if let Some(value) = self.value_at(class, row, property) {
            return Ok(Answer::Known(value));
        }
        let name = PropertyName::new(class, property);
        if self.network.not_known.contains(&(name.clone(), key.to_owned())) {
            return Ok(Answer::NotKnown);
        }
        let (this, asked) = (&mut *self, &name);
        let question = on_deep_stack(move || this.question(rules, asked, row as u32));
        Ok(question.map_or(Answer::NotKnown, |text| {
            Answer::Ask(Question { property: name, key: key.to_owned(), text })
        }))
    }

    /// Answers a question by "I do not know": it is not asked again, and what comes after it among the sources
    /// holds. Told values take it back.
    pub fn tell_not_known(&mut self, class: &str, key: &str, property: &str) {
        self.network.not_known.insert((PropertyName::new(class, property), key.to_owned()));
    }

    /// Asks for properties of several objects at once, and tells what was found out or changed on the way.
    pub fn ask_rows(&mut self, rules: &RuleBase, class: &str, rows: &[u32], properties: &[&str]) -> Changes {
        let mut run = self.begin(rules);
        run.asked = Some(Asked::new());
        self.advance_on(&mut run);
        let wanted = properties.iter().map(|property| {
            let rows = Dirty::Rows(rows.to_vec()).settle(usize::MAX);
            (PropertyName::new(class, *property), rows)
        });
        let asked = self.asked(rules, wanted.collect(), run.until);
        if asked.is_empty() {
            return self.noted(&run);
        }
        let mut second = Run::new(rules, run.until);
        second.asked = Some(asked);
        self.advance_on(&mut second);
        run.follow(second);
        self.noted(&run)
    }

    /// From the values that are wanted back to the objects for which rules have to be evaluated.
    fn asked(&mut self, base: &RuleBase, mut wanted: BTreeMap<PropertyName, Dirty>, until: Instant) -> Asked {
        let mut asked = Asked::new();
        for step in base.order.iter().rev() {
            let Step::Rule(index) = step else { continue };
            let rule = &base.rules[*index];
            if !rule.sets.keys().any(|name| wanted.contains_key(name)) {
                continue;
            }
            let Some(planned) = self.network.nodes[*index].planned.take() else { continue };
            if let Some(mut memory) = self.network.nodes[*index].memory.take() {
                let drivers = drivers(&memory, &wanted);
                if !drivers.is_none() {
                    self.spread(rule, &planned, &mut memory, &drivers, until, &mut wanted);
                    asked.insert(*index, drivers);
                }
                self.network.nodes[*index].memory = Some(memory);
            }
            self.network.nodes[*index].planned = Some(planned);
        }
        asked
    }

    fn spread(
        &self,
        rule: &Rule,
        planned: &Planned,
        memory: &mut Memory,
        drivers: &Dirty,
        until: Instant,
        wanted: &mut BTreeMap<PropertyName, Dirty>,
    ) {
        for (number, clause) in rule.clauses.iter().enumerate() {
            let concluded = planned.uses.anywhere[number]
                .iter()
                .map(|&column| &planned.plan.columns[column])
                .filter(|name| self.derived.contains_key(*name));
            let concluded: Vec<&PropertyName> = concluded.collect();
            if concluded.is_empty() {
                continue;
            }
            let rows = match (number, memory.shape) {
                (_, Shape::Whole) => Dirty::All,
                (0, _) => drivers.clone(),
                _ => self.joined_to(rule, planned, memory, drivers, number, until),
            };
            let rows = rows.settle(self.len(&clause.class).unwrap_or(0));
            for name in concluded {
                wanted.entry(name.clone()).or_default().join(&rows);
            }
        }
    }

    /// The objects of a later clause that some objects of the first can meet there: those that an index gives, where
    /// told values alone decide, else all.
    fn joined_to(
        &self,
        rule: &Rule,
        planned: &Planned,
        memory: &mut Memory,
        drivers: &Dirty,
        number: usize,
        until: Instant,
    ) -> Dirty {
        let clause = &planned.plan.clauses[number];
        let told = |variable: usize, column: &usize| {
            variable <= number && !self.derived.contains_key(&planned.plan.columns[*column])
        };
        let keys = clause.joins.iter().map(|join| join.key.variables() | 1);
        let Dirty::Rows(rows) = drivers else { return Dirty::All };
        let decided = !clause.joins.is_empty()
            && (clause.by.is_none() || clause.by_own)
            && keys.fold(0, |all, key| all | key) == 1
            && planned.uses.matching[number].iter().all(|column| told(number, column))
            && planned.uses.anywhere[0].iter().all(|column| told(0, column));
        if !decided {
            return Dirty::All;
        }
        let machine = self.machine(rule, &planned.plan, until);
        if memory.candidates[number].is_none() {
            memory.candidates[number] = self.candidates(&machine, &planned.plan, number);
        }
        let Some(index) = memory.candidates[number].as_ref().and_then(|found| found.index.as_ref()) else {
            return Dirty::All;
        };
        let frame = Frame::of(planned.plan.clauses.len(), 0, rows);
        let keys = machine.keys(clause, &frame);
        let mut found = Dirty::Rows(vec![]);
        for at in 0..rows.len() {
            found.extend(index.rows(keys.iter().map(|key| key.cell(at))).iter().copied());
        }
        found
    }

    /// The question that is declared for a property of an object, if there is one.
    fn question(&self, base: &RuleBase, name: &PropertyName, row: u32) -> Option<String> {
        let declared = base.declared.properties.get(name)?;
        let asks = |declaration: &&Declaration| self.is_of(declaration, row);
        let text = declared.iter().find(asks)?.sources.iter().find_map(|source| match source {
            Source::Ask(text) => Some(text),
            _ => None,
        })?;
        Some(self.worded(text, &name.class, row as usize))
    }

    /// Whether an object is one of those that a declaration speaks of.
    fn is_of(&self, declaration: &Declaration, row: u32) -> bool {
        let rule = &declaration.rule;
        let known = super::evaluate::Known { base: self, rule: Some(rule), told: None };
        let Ok(plan) = plan(rule, &known, &self.symbols) else { return false };
        let machine = self.machine(rule, &plan, self.limits.end(self.limits.rule));
        let frame = Frame::of(1, 0, &[row]);
        plan.clauses[0]
            .own
            .as_ref()
            .is_none_or(|own| machine.values(own, &frame).truths().at(0) == Truth::True)
    }

    /// A question with the properties of the object where they stand in braces.
    fn worded(&self, text: &str, class: &str, row: usize) -> String {
        let mut out = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            out.push_str(before);
            let Some((property, after)) = after.split_once('}') else {
                out.push('{');
                rest = after;
                continue;
            };
            match self.value_at(class, row, property) {
                Some(value) => out.push_str(&value.to_string()),
                None => out.push('?'),
            }
            rest = after;
        }
        out + rest
    }
}

/// The objects of a rule's first clause that may give what is wanted, and were not asked for yet.
fn drivers(memory: &Memory, wanted: &BTreeMap<PropertyName, Dirty>) -> Dirty {
    if memory.unasked == 0 {
        return Dirty::None;
    }
    let mut drivers = Dirty::None;
    for given in &memory.given {
        let Some(rows) = wanted.get(&given.name) else { continue };
        let untyped = matches!(given.values, Buffer::Cells(_));
        if given.variable == 0 && memory.shape != Shape::Whole && !untyped {
            drivers.join(rows);
        } else {
            drivers = Dirty::All;
        }
    }
    let unasked = |row: &u32| memory.statuses.get(*row as usize) == Some(&Status::UNASKED);
    match drivers.settle(memory.statuses.len()) {
        Dirty::Rows(rows) => {
            let rows: Vec<u32> = rows.into_iter().filter(unasked).collect();
            if rows.is_empty() { Dirty::None } else { Dirty::Rows(rows) }
        }
        Dirty::All => Dirty::Rows(memory.waiting()),
        Dirty::None => Dirty::None,
    }
}
