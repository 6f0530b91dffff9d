//! Backward chaining: a value that is asked for, and nothing but what it needs.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

use super::KnowledgeBase;
use super::conclude::{Asked, Run};
use super::dirty::Dirty;
use super::facts::FactError;
use super::memory::{Memory, Shape};
use super::network::Planned;
use crate::changes::Changes;
use crate::declared::{Declaration, Source};
use crate::machine::lane::{Frame, NO_ROW};
use crate::machine::output::{Buffer, Status};
use crate::order::Step;
use crate::plan::kinds::{Key, Kind, Kinds};
use crate::plan::plan;
use crate::plan::uses::Uses;
use crate::rule::{PropertyName, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::value::{Truth, Type, Value};

#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    Known(Value),
    /// What would settle it, or a part of it, and no source gives but the user: tell it, or that it is not known, and ask again.
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
    /// that is declared: told, concluded by rules, a default, a question to the user. Where rules could conclude it if they
    /// knew more, what they lack is asked for first, one after the other, as the rules speak of it.
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
        Ok(self.ask_row(rules, class, row, property).0)
    }

    /// As [`ask`](Self::ask), by the object's row from 0; with it what was computed for it.
    pub fn ask_row(
        &mut self,
        rules: &RuleBase,
        class: &str,
        row: usize,
        property: &str,
    ) -> (Answer, Changes) {
        let changes = self.ask_rows(rules, class, &[row as u32], &[property]);
        (self.answer(rules, &PropertyName::new(class, property), row), changes)
    }

    fn answer(&mut self, rules: &RuleBase, name: &PropertyName, row: usize) -> Answer {
        if let Some(value) = self.value_at(&name.class, row, &name.property) {
            return Answer::Known(value);
        }
        let this = &mut *self;
        let question = on_deep_stack(move || this.lacking(rules, name, row as u32, &mut BTreeSet::new()));
        question.map_or(Answer::NotKnown, Answer::Ask)
    }

    /// The first question that an answer to which may settle a value that is unknown.
    fn lacking(
        &mut self,
        base: &RuleBase,
        name: &PropertyName,
        row: u32,
        seen: &mut BTreeSet<(PropertyName, u32)>,
    ) -> Option<Question> {
        let is_known = self.value_at(&name.class, row as usize, &name.property).is_some();
        let may_come = base.declared.properties.contains_key(name)
            || base.rules.iter().any(|rule| rule.sets.contains_key(name));
        if is_known || !may_come || !seen.insert((name.clone(), row)) {
            return None;
        }
        for index in 0..base.rules.len() {
            if base.rules[index].sets.contains_key(name) {
                for (input, rows) in self.inputs(base, index, name, row) {
                    let found = rows.into_iter().find_map(|row| self.lacking(base, &input, row, seen));
                    if found.is_some() {
                        return found;
                    }
                }
            }
        }
        let key = self.key(&name.class, row as usize)?;
        if self.network.not_known.contains(&(name.clone(), key.clone())) {
            return None;
        }
        let text = self.question(base, name, row)?;
        Some(Question { property: name.clone(), key, text })
    }

    /// What a rule may lack to say something of an object, as it speaks of it, with the objects of which it may lack that.
    fn inputs(
        &mut self,
        base: &RuleBase,
        index: usize,
        name: &PropertyName,
        row: u32,
    ) -> Vec<(PropertyName, Vec<u32>)> {
        let rule = &base.rules[index];
        let node = &mut self.network.nodes[index];
        let (Some(planned), Some(memory)) = (node.planned.take(), node.memory.take()) else {
            return self.awaited(rule, name, row);
        };
        let mut memory = Arc::unwrap_or_clone(memory);
        let mut inputs: Vec<(PropertyName, Vec<u32>)> = vec![];
        let sets_first = memory.given.iter().any(|given| given.name == *name && given.variable == 0);
        let is_whole = memory.shape == Shape::Whole;
        let drivers = if sets_first && !is_whole { vec![row] } else { self.all_rows(&rule.clauses[0].class) };
        let until = self.limits.end(self.limits.inference);
        for driver in drivers {
            let at = if is_whole { 0 } else { driver };
            let status = memory.statuses.get(at as usize).copied().unwrap_or(Status::UNASKED);
            let last = match status.unmet() {
                Some(clause) => Some(clause),
                None if status == Status::SILENT && !is_whole => continue,
                None if status == Status::LEFT_OUT => Some(0),
                None => None,
            };
            // What was not met may be met if more were known of what that clause and those before it look at.
            let uses = last.map(|last| Uses::of_clauses(&planned.plan.clauses[..=last]));
            let uses = uses.as_ref().unwrap_or(&planned.uses);
            for (number, clause) in rule.clauses.iter().enumerate().take(uses.anywhere.len()) {
                let columns = &uses.anywhere[number];
                let witness = memory.witness(number, at as usize);
                let rows = match number {
                    0 => vec![driver],
                    _ if status == Status::THEN && memory.shape == Shape::Single && witness != NO_ROW => {
                        vec![witness]
                    }
                    _ => {
                        let joined = Dirty::Rows(vec![driver]);
                        match self.joined_to(rule, &planned, &mut memory, &joined, number, until) {
                            Dirty::Rows(rows) => rows,
                            Dirty::None => vec![],
                            Dirty::All => self.all_rows(&clause.class),
                        }
                    }
                };
                let names = columns.iter().map(|&column| &planned.plan.columns[column]);
                inputs.extend(names.map(|input| (input.clone(), rows.clone())));
            }
        }
        inputs.sort_by_key(|(input, _)| rule.reads.get(input).map(|at| (at.line(), at.position())));
        let node = &mut self.network.nodes[index];
        (node.planned, node.memory) = (Some(planned), Some(Arc::new(memory)));
        inputs
    }

    /// What a rule that waits reads: something of it has no object yet that it is known of.
    fn awaited(&self, rule: &Rule, name: &PropertyName, row: u32) -> Vec<(PropertyName, Vec<u32>)> {
        let mut reads: Vec<_> = rule.reads.iter().collect();
        reads.sort_by_key(|(_, at)| (at.line(), at.position()));
        let is_own = |input: &PropertyName| input.class == name.class && rule.clauses[0].class == name.class;
        let rows = |input: &PropertyName| if is_own(input) { vec![row] } else { self.all_rows(&input.class) };
        reads.into_iter().map(|(input, _)| (input.clone(), rows(input))).collect()
    }

    fn all_rows(&self, class: &str) -> Vec<u32> {
        (0..self.len(class).unwrap_or(0) as u32).collect()
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
            if let Some(memory) = self.network.nodes[*index].memory.take() {
                let mut memory = Arc::unwrap_or_clone(memory);
                let drivers = drivers(&memory, &wanted);
                if !drivers.is_none() {
                    self.spread(rule, &planned, &mut memory, &drivers, until, &mut wanted);
                    asked.insert(*index, drivers);
                }
                self.network.nodes[*index].memory = Some(Arc::new(memory));
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

    /// Makes the properties that users are asked for and of which nobody has told anything yet: unknown, they keep no rule
    /// waiting. What they hold is seen from the rules that read them.
    pub(super) fn make_askable(&mut self, base: &RuleBase) {
        let is_asked = |declared: &Vec<Declaration>| {
            declared.iter().any(|of| of.sources.iter().any(|source| matches!(source, Source::Ask(_))))
        };
        let missing: Vec<&PropertyName> = base
            .declared
            .properties
            .iter()
            .filter(|(name, declared)| is_asked(declared) && self.held.contains_key(&name.class))
            .map(|(name, _)| name)
            .filter(|name| self.told_column(name).is_none())
            .collect();
        for name in missing {
            let kind = self.kind_by_use(base, name);
            if let Some(held) = self.held.get_mut(&name.class) {
                held.table.widen(&name.property, kind);
                self.network.recheck = true;
            }
        }
    }

    /// The type with which the rules that read a property find least amiss.
    fn kind_by_use(&self, base: &RuleBase, name: &PropertyName) -> Type {
        let kinds = [Type::Truth, Type::Number, Type::Text];
        let amiss = |kind: &Type| -> usize {
            let known = super::evaluate::Known { base: self, rule: None, told: None };
            let supposed = Supposed { known, name, kind: *kind };
            let readers = base.rules.iter().filter(|rule| rule.reads.contains_key(name));
            // what else is amiss is so with each of them
            readers.filter_map(|rule| plan(rule, &supposed, &self.symbols).err()).flatten().count()
        };
        kinds.into_iter().min_by_key(amiss).unwrap_or(Type::Truth)
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

/// What is known, and of one property a type that is tried.
struct Supposed<'s> {
    known: super::evaluate::Known<'s>,
    name: &'s PropertyName,
    kind: Type,
}

impl Kinds for Supposed<'_> {
    fn kind(&self, property: &PropertyName) -> Kind {
        match self.known.kind(property) {
            _ if property == self.name => Kind::Holds(Some(self.kind)),
            // may be told some day
            Kind::Missing => Kind::Holds(None),
            kind @ Kind::Holds(_) => kind,
        }
    }

    fn declared(&self, property: &PropertyName) -> Option<Type> {
        self.known.declared(property)
    }

    fn key(&self, class: &str) -> Key {
        self.known.key(class)
    }

    fn properties(&self, class: &str) -> Vec<String> {
        self.known.properties(class)
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
