//! Why not: each rule that could set a property is gone through by hand for one object, and what it rejects is noted.

mod rows;
mod tests_of;
mod walk;

use super::KnowledgeBase;
use super::evaluate::{Known, below};
use crate::column::Column;
use crate::conclusions::Origin;
use crate::machine::Machine;
use crate::rejection::{Rejected, Rejection, WhyNot};
use crate::rule::{PropertyName, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use tests_of::TestsOfRule;
use walk::Walk;

/// Objects of which it is said why one rule did not take them.
const MOST_OBJECTS: usize = 1_000;

impl KnowledgeBase {
    /// Why a property of the object with this key has no other value: for each rule that could set or revise it, the
    /// objects that its clauses did not take, each with the part of `where` that failed or the value by which it lost,
    /// and the clause that was not met where the rule did not apply. At most 1,000 objects a rule are named; in a
    /// class of more than 50 not those that an equation keeps apart. `None` if there is no such object. Asks of the
    /// knowledge base as the last inference left it.
    pub fn why_not(&mut self, rules: &RuleBase, class: &str, key: &str, property: &str) -> Option<WhyNot> {
        let row = u32::try_from(self.row(class, key)?).ok()?;
        let name = PropertyName::new(class, property);
        let (mut rejected, mut truncated) = (vec![], false);
        for (number, rule) in rules.rules.iter().enumerate() {
            if rule.reacts() || !rule.sets.contains_key(&name) {
                continue;
            }
            let needs = self.network.nodes.get(number).map_or(&[][..], |node| &node.needs);
            if !needs.is_empty() {
                let reason = Rejection::Waiting { needs: needs.to_vec() };
                rejected.push(of_rule(rule, reason));
                continue;
            }
            // The interpreter may need more stack than the caller has.
            let walked = on_deep_stack(|| self.walk(number, rule, &name, row));
            let applied = walked.applied;
            rejected.extend(walked.rejected);
            truncated |= walked.truncated;
            if applied && rule.level().is_none() {
                rejected.extend(self.overruled(rules, rule, (class, key, property)));
            }
        }
        let value = self.value_at(class, row as usize, property);
        Some(WhyNot { property: name, key: key.to_owned(), value, rejected, truncated })
    }

    fn walk(&mut self, number: usize, rule: &Rule, name: &PropertyName, row: u32) -> Walked {
        static NONE: Column = Column::Truths(vec![]);
        let mut walked = Walked::default();
        let Some(planned) = self.network.nodes.get(number).and_then(|node| node.planned.as_ref()) else {
            return walked;
        };
        let Some((tests, columns)) =
            TestsOfRule::new(rule, &Known { base: self, rule: Some(rule), told: None }, &self.symbols)
        else {
            return walked;
        };
        let column = |name| self.view(name, below(rule, name)).unwrap_or(&NONE);
        let columns = columns.iter().map(column).collect();
        let until = self.limits.end(self.limits.rule);
        let machine = Machine::new(rule, columns, &self.symbols, until, false);
        for (_, target, _) in planned.plan.targets(rule).into_iter().filter(|(set, ..)| *set == name) {
            let mut walk = Walk::new(self, &machine, &tests, (target, row), MOST_OBJECTS);
            let applied = walk.run();
            walked.applied |= applied;
            walked.truncated |= walk.truncated;
            walked.rejected.extend(walk.rejected);
        }
        walked
    }

    /// What stands against the value that a rule gives, if it is not the one that counts.
    fn overruled(
        &self,
        rules: &RuleBase,
        rule: &Rule,
        (class, key, property): (&str, &str, &str),
    ) -> Option<Rejected> {
        let by = match self.why(rules, class, key, property)?.origin {
            Origin::Told => None,
            Origin::Rule(support) if support.rule == rule.name => return None,
            Origin::Rule(support) => Some(support.rule),
        };
        Some(of_rule(rule, Rejection::Overruled { by }))
    }
}

/// What came of going through a rule.
#[derive(Default)]
struct Walked {
    rejected: Vec<Rejected>,
    applied: bool,
    truncated: bool,
}

fn of_rule(rule: &Rule, reason: Rejection) -> Rejected {
    Rejected {
        rule: rule.name.clone(),
        version: rule.version.clone(),
        file: rule.file().to_owned(),
        line: rule.line,
        variable: None,
        class: None,
        key: None,
        reason,
    }
}
