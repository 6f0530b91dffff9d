//! Conflicts, and objects that rules left without a value.

use std::collections::BTreeMap;

use super::KnowledgeBase;
use super::derived::{Derived, NO_RULE};
use super::merge::find;
use crate::conclusions::{Conflict, Gap, Reason};
use crate::machine::output::Failure;
use crate::rule::{PropertyName, Rule};
use crate::rule_base::RuleBase;

impl KnowledgeBase {
    pub(super) fn conflicts(&self, name: &PropertyName, derived: &Derived) -> Vec<Conflict> {
        derived
            .disputes
            .iter()
            .map(|(&row, claims)| Conflict {
                property: name.clone(),
                key: self.key(&name.class, row as usize).unwrap_or_default(),
                values: claims
                    .iter()
                    .filter_map(|&(writer, _, cell)| {
                        Some((derived.writers.get(writer as usize)?.clone(), self.host_value(cell)?))
                    })
                    .collect(),
            })
            .collect()
    }

    /// The objects without a value of a property that rules conclude.
    pub(super) fn gap(&self, base: &RuleBase, name: &PropertyName, derived: &Derived) -> Option<Gap> {
        let (column, _) = derived.view(None);
        let rows: Vec<u32> =
            (0..column.len() as u32).filter(|&row| column.is_unknown(row as usize)).collect();
        if rows.is_empty() || derived.writers.is_empty() {
            return None;
        }
        let writers: Vec<(&Rule, BTreeMap<u32, Failure>)> = derived
            .writers
            .iter()
            .filter_map(|writer| base.rules.iter().find(|rule| rule.name == *writer))
            .map(|rule| (rule, self.failures(rule, name)))
            .collect();
        let mut reasons: BTreeMap<Reason, usize> = BTreeMap::new();
        for &row in &rows {
            *reasons.entry(reason(derived, &writers, row)).or_default() += 1;
        }
        Some(Gap { property: name.clone(), rows, reasons: reasons.into_iter().collect() })
    }

    /// Where a rule failed, by the row of its first variable, if the property is one of that variable's class.
    fn failures(&self, rule: &Rule, name: &PropertyName) -> BTreeMap<u32, Failure> {
        let Some(done) = self.done.get(rule.name()) else { return BTreeMap::new() };
        if rule.clauses[0].class != name.class || find(&done.output, name).is_none() {
            return BTreeMap::new();
        }
        done.output.failures.iter().map(|failure| (failure.row, *failure)).collect()
    }
}

fn reason(derived: &Derived, writers: &[(&Rule, BTreeMap<u32, Failure>)], row: u32) -> Reason {
    if derived.disputes.contains_key(&row) {
        return Reason::Conflict;
    }
    let (writer, _) = derived.origin[row as usize];
    if writer != NO_RULE
        && let Some(rule) = derived.writers.get(writer as usize)
    {
        return Reason::Unknown { rule: rule.clone() };
    }
    for (rule, failures) in writers {
        if let Some(failure) = failures.get(&row) {
            let variable = rule.clauses[failure.clause as usize].variable.clone();
            let rule = rule.name.clone();
            return if failure.unknown > 0 {
                Reason::Undecided { rule, variable }
            } else {
                Reason::Unmet { rule, variable }
            };
        }
    }
    Reason::NoRule
}
