//! Why not: each rule that could set a property is gone through for one object, and what it rejects is noted.

mod walk;

use super::KnowledgeBase;
use crate::conclusions::Origin;
use crate::machine::candidates::Candidates;
use crate::rejection::{Rejected, Rejection, WhyNot};
use crate::rule::{PropertyName, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::script::syntax::Quantifier;
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
                rejected.push(Rejected::of_rule(rule, reason));
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
        let mut walked = Walked::default();
        let Some(node) = self.network.nodes.get(number) else { return walked };
        let Some(planned) = &node.planned else { return walked };
        let machine = self.machine(rule, &planned.plan, self.limits.end(self.limits.rule));
        let kept = |number: usize| node.memory.as_ref()?.candidates[number].as_ref();
        let made = |number: usize| {
            let drives = number == 0 && rule.clauses[0].quantifier == Quantifier::Each;
            if drives || kept(number).is_some() {
                None
            } else {
                self.candidates(&machine, &planned.plan, number)
            }
        };
        let made: Vec<Option<Candidates>> = (0..rule.clauses.len()).map(made).collect();
        let candidates: Vec<Option<&Candidates>> =
            made.iter().enumerate().map(|(number, made)| kept(number).or(made.as_ref())).collect();
        for (_, target, _) in planned.plan.targets(rule).into_iter().filter(|(set, ..)| *set == name) {
            let mut walk = Walk {
                knowledge: self,
                machine: &machine,
                plan: &planned.plan,
                candidates: &candidates,
                target: (target, row),
                budget: MOST_OBJECTS,
                rejected: vec![],
                truncated: false,
            };
            walked.applied |= walk.run();
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
        Some(Rejected::of_rule(rule, Rejection::Overruled { by }))
    }
}

#[derive(Default)]
struct Walked {
    rejected: Vec<Rejected>,
    applied: bool,
    truncated: bool,
}
