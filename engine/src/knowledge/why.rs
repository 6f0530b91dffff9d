//! Why a property has its value.

use super::KnowledgeBase;
use super::derived::NO_RULE;
use crate::conclusions::{Justification, Justifications, Origin, Revision, Support, Witness};
use crate::machine::lane::NO_ROW;
use crate::rule::{Action, PropertyName, Rule};
use crate::rule_base::RuleBase;
use crate::value::Cell;

impl KnowledgeBase {
    /// Why a property of the object with this key has its value; `None` if there is no such object or property,
    /// or nothing was told or concluded.
    pub fn why(&self, rules: &RuleBase, class: &str, key: &str, property: &str) -> Option<Justification> {
        let row = self.row(class, key)?;
        let name = PropertyName::new(class, property);
        let value = self.host_value(self.column(&name)?.cell(row));
        let key = key.to_owned();
        let Some(derived) = self.derived.get(&name) else {
            value.as_ref()?;
            return Some(Justification {
                property: name,
                key,
                value,
                origin: Origin::Told,
                revisions: vec![],
            });
        };
        let &(writer, firing) = derived.origin.get(row)?;
        let origin = if writer == NO_RULE {
            (!derived.merged.is_unknown(row)).then_some(Origin::Told)?
        } else {
            let rule = rules.rules.iter().find(|rule| rule.name == derived.writers[writer as usize])?;
            Origin::Rule(self.support(rule, firing)?)
        };
        let revisions = self.revisions(rules, &name, row);
        Some(Justification { property: name, key, value, origin, revisions })
    }

    /// For a property that rules conclude: the rule behind each object's value.
    pub fn justifications(&self, class: &str, property: &str) -> Option<Justifications> {
        let derived = self.derived.get(&PropertyName::new(class, property))?;
        let version = |name: &String| self.done.get(name).map_or(String::new(), |done| done.version.clone());
        let rules = derived.writers.iter().map(|name| (name.clone(), version(name))).collect();
        let of_row = derived
            .origin
            .iter()
            .enumerate()
            .map(|(row, &(writer, _))| {
                (writer != NO_RULE && !derived.merged.is_unknown(row)).then_some(writer)
            })
            .collect();
        Some(Justifications { rules, of_row })
    }

    /// For a property that rules conclude: the row that a variable of its rule stands for, for each object.
    /// `None` where another rule, or no rule, gave the value.
    pub fn witness_rows(
        &self,
        rule: &Rule,
        class: &str,
        property: &str,
        variable: &str,
    ) -> Option<Vec<Option<u32>>> {
        let derived = self.derived.get(&PropertyName::new(class, property))?;
        let number = rule.clauses.iter().position(|clause| clause.variable == variable)?;
        let rows = self.done.get(rule.name())?.output.witnesses.get(number)?;
        let writer = derived.writers.iter().position(|name| name == rule.name())? as u32;
        let witness = |&(by, firing): &(u32, u32)| {
            let row = (by == writer).then(|| rows.get(firing as usize).copied()).flatten()?;
            (row != NO_ROW).then_some(row)
        };
        Some(derived.origin.iter().map(witness).collect())
    }

    /// For a property that rules revise: each such rule with the rows that it revises.
    pub fn revised<'r>(&self, rules: &'r RuleBase, class: &str, property: &str) -> Vec<(&'r Rule, Vec<u32>)> {
        let name = PropertyName::new(class, property);
        let revises = |rule: &&Rule| rule.level().is_some() && rule.sets.contains_key(&name);
        let rows = |rule: &'r Rule| {
            let given = self.done.get(rule.name()).into_iter().flat_map(|done| &done.output.given);
            (rule, given.flat_map(|given| given.rows.iter().copied()).collect())
        };
        rules.rules.iter().filter(revises).map(rows).collect()
    }

    fn support(&self, rule: &Rule, firing: u32) -> Option<Support> {
        let output = &self.done.get(rule.name())?.output;
        let witness = |(clause, rows): (&crate::rule::Clause, &Vec<u32>)| {
            let row = *rows.get(firing as usize)?;
            let key = self.key(&clause.class, row as usize)?;
            Some(Witness { variable: clause.variable.clone(), class: clause.class.clone(), key })
        };
        Some(Support {
            rule: rule.name.clone(),
            version: rule.version.clone(),
            file: rule.file().to_owned(),
            line: rule.line,
            witnesses: rule.clauses.iter().zip(&output.witnesses).filter_map(witness).collect(),
        })
    }

    fn revisions(&self, rules: &RuleBase, name: &PropertyName, row: usize) -> Vec<Revision> {
        let mut revisions = vec![];
        for rule in rules.rules.iter().filter(|rule| rule.sets.contains_key(name)) {
            let Action::Revise { operator, level, .. } = rule.action else { continue };
            let Some(done) = self.done.get(rule.name()) else { continue };
            for given in &done.output.given {
                for (nth, _) in given.rows.iter().enumerate().filter(|&(_, &at)| at as usize == row) {
                    let amount = match given.cells[nth] {
                        Cell::Number(amount) => Some(amount),
                        _ => None,
                    };
                    if let Some(support) = self.support(rule, given.firings[nth]) {
                        revisions.push(Revision { level, operator, amount, support });
                    }
                }
            }
        }
        revisions.sort_by(|a, b| (a.level, &a.support.rule).cmp(&(b.level, &b.support.rule)));
        revisions
    }
}
