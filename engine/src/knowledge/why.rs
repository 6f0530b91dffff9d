//! Why a property has its value.

use std::collections::{BTreeMap, HashMap};

use super::KnowledgeBase;
use super::derived::{Derived, Writer};
use super::voices::{Source, Voice};
use crate::conclusions::{Grounds, Justification, Justifications, Origin, Revision, Support, Witness};
use crate::machine::lane::NO_ROW;
use crate::rule::{Action, PropertyName, Rule};
use crate::rule_base::RuleBase;

impl KnowledgeBase {
    /// Why a property of the object with this key has its value; `None` if there is no such object or property,
    /// or nothing was told or concluded.
    pub fn why(&self, rules: &RuleBase, class: &str, key: &str, property: &str) -> Option<Justification> {
        let row = self.row(class, key)?;
        let name = PropertyName::new(class, property);
        let value = self.host_value(self.column(&name)?.cell(row));
        let key = key.to_owned();
        let told = |value| Justification {
            property: name.clone(),
            key: key.clone(),
            value,
            origin: Origin::Told,
            revisions: vec![],
        };
        let Some(derived) = self.known_derived(&name) else {
            return value.is_some().then(|| told(value));
        };
        let voices = self.voices(&name, derived);
        let origin = match voices.resolve(row as u32, derived.stages[0].kind()).1 {
            Source::Nobody => return None,
            Source::Told => Origin::Told,
            Source::Rule { rule, firing } => Origin::Rule(self.support(rules, rule, firing)?),
            Source::Dispute => {
                let said = |voice: &Voice| Some((voice.rule, voice.claims(row as u32).next()?.1));
                let (rule, firing) = voices.rules.iter().find_map(said)?;
                Origin::Rule(self.support(rules, rule, firing)?)
            }
        };
        let revisions = self.revisions(rules, &name, derived, row as u32);
        Some(Justification { property: name, key, value, origin, revisions })
    }

    /// For a property that rules conclude: the rule behind each object's value.
    pub fn justifications(&self, class: &str, property: &str) -> Option<Justifications> {
        let name = PropertyName::new(class, property);
        let derived = self.known_derived(&name)?;
        let of = |rule: usize| self.network.nodes.get(rule);
        let rules = derived
            .writers
            .iter()
            .filter_map(|writer| of(writer.rule).map(|node| (node.name.clone(), node.version.clone())))
            .collect();
        let merged = &derived.stages[0];
        let voices = self.voices(&name, derived);
        let writer = |row: usize| match voices.resolve(row as u32, merged.kind()).1 {
            Source::Rule { rule, .. } if !merged.is_unknown(row) => derived
                .writers
                .iter()
                .zip(0..)
                .find(|(writer, _)| writer.rule == rule)
                .map(|(_, number)| number),
            _ => None,
        };
        Some(Justifications { rules, of_row: (0..merged.len()).map(writer).collect() })
    }

    /// For a property that rules conclude: the different grounds of its values, and for each of these rows the place
    /// of its own among them; `None` where the value was told or is unknown. Objects that the row itself names are left
    /// out, so that rows of which rules say the same share their grounds.
    pub fn grounds(&self, class: &str, property: &str, rows: &[u32]) -> (Vec<Grounds>, Vec<Option<usize>>) {
        let name = PropertyName::new(class, property);
        let Some(derived) = self.known_derived(&name) else {
            return (Vec::new(), vec![None; rows.len()]);
        };
        // only looked up in: no order of it can reach an answer
        let mut places: HashMap<Grounds, usize> = HashMap::new();
        let mut different = Vec::new();
        let mut here = Grounds { rule: 0, witnesses: Vec::new() };
        let mut named: BTreeMap<usize, Vec<bool>> = BTreeMap::new();
        // rows beside each other mostly share theirs
        let mut last = 0;
        let (voices, merged) = (self.voices(&name, derived), &derived.stages[0]);
        let place = |&row: &u32| match voices.resolve(row, merged.kind()).1 {
            Source::Rule { rule, firing } if !merged.is_unknown(row as usize) => {
                let memory = self.network.nodes.get(rule)?.memory.as_ref()?;
                let named = named.entry(rule).or_insert_with(|| self.named(rule));
                let is_named = |clause: usize| named.get(clause) == Some(&true);
                let bound = |clause| {
                    Some(memory.witness(clause, firing)).filter(|&row| row != NO_ROW && !is_named(clause))
                };
                here.rule = rule;
                here.witnesses.clear();
                here.witnesses.extend((1..memory.witnesses.len()).map(bound));
                if different.get(last) != Some(&here) {
                    last = *places.entry(here.clone()).or_insert_with(|| {
                        different.push(here.clone());
                        different.len() - 1
                    });
                }
                Some(last)
            }
            _ => None,
        };
        let places = rows.iter().map(place).collect();
        (different, places)
    }

    /// For each clause of a rule whether the row itself names its object.
    fn named(&self, rule: usize) -> Vec<bool> {
        let key = |class: &str| {
            let table = &self.held.get(class)?.table;
            if let [column] = *table.key { Some(table.names[column].as_str()) } else { None }
        };
        let planned = self.network.nodes.get(rule).and_then(|node| node.planned.as_ref());
        planned.map_or_else(Vec::new, |planned| planned.plan.named(key))
    }

    /// For a property that rules revise: each such rule with the rows that it revises.
    pub fn revised<'r>(&self, rules: &'r RuleBase, class: &str, property: &str) -> Vec<(&'r Rule, Vec<u32>)> {
        let name = PropertyName::new(class, property);
        let mut out = vec![];
        for (rule, node) in rules.rules.iter().zip(&self.network.nodes) {
            if rule.level().is_none() || !rule.sets.contains_key(&name) {
                continue;
            }
            let mut rows = vec![];
            if let Some(memory) = &node.memory {
                for given in memory.given.iter().filter(|given| given.name == name) {
                    let firings = (0..memory.firings()).filter(|&firing| given.is_written(firing));
                    rows.extend(firings.map(|firing| memory.witness(given.variable, firing)));
                }
            }
            out.push((rule, rows));
        }
        out
    }

    fn support(&self, rules: &RuleBase, number: usize, firing: usize) -> Option<Support> {
        let rule = &rules.rules[number];
        let memory = self.network.nodes[number].memory.as_ref()?;
        let witness = |(clause, of): (usize, &crate::rule::Clause)| {
            let key = self.key(&of.class, memory.witness(clause, firing) as usize)?;
            Some(Witness { variable: of.variable.clone(), class: of.class.clone(), key })
        };
        Some(Support {
            rule: rule.name.clone(),
            version: rule.version.clone(),
            file: rule.file().to_owned(),
            line: rule.line,
            witnesses: rule.clauses.iter().enumerate().filter_map(witness).collect(),
        })
    }

    fn revisions(&self, rules: &RuleBase, name: &PropertyName, derived: &Derived, row: u32) -> Vec<Revision> {
        let mut revisions = vec![];
        for (level, revisers) in &derived.levels {
            for &number in revisers {
                let Action::Revise { operator, .. } = rules.rules[number].action else { continue };
                let voices = self.rules_of(name, [Writer { rule: number, priority: *level }]);
                for (amount, firing) in self.contributions(rules, &voices, row) {
                    if let Some(support) = self.support(rules, number, firing) {
                        revisions.push(Revision { level: *level, operator, amount, support });
                    }
                }
            }
        }
        revisions
    }
}
