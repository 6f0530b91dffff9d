//! What is kept between inferences follows where other rules are taken over, and where objects come, go or move.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::KnowledgeBase;
use super::derived::{Derived, Writer};
use super::dirty::Dirty;
use super::network::Node;
use super::pending::Held;
use crate::column::Column;
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;

impl KnowledgeBase {
    /// Takes over another rule base; rules that stayed as they were keep what they gave. Returns the properties
    /// that no rule concludes any more.
    pub(super) fn take_over(&mut self, base: &RuleBase) -> Vec<PropertyName> {
        if self.network.base == Some(base.id) {
            return vec![];
        }
        self.network.base = Some(base.id);
        self.network.recheck = true;
        let mut before: BTreeMap<String, Node> =
            self.network.nodes.drain(..).map(|node| (node.name.clone(), node)).collect();
        for rule in &base.rules {
            let kept = before.remove(rule.name()).filter(|node| node.version == rule.version);
            let fresh = || Node { name: rule.name.clone(), version: rule.version.clone(), ..Node::default() };
            self.network.nodes.push(kept.unwrap_or_else(fresh));
        }
        let concluded = base.concluded();
        let gone: Vec<PropertyName> =
            self.derived.keys().filter(|name| !concluded.contains(name)).cloned().collect();
        for name in &gone {
            self.derived.remove(name);
        }
        for name in concluded {
            let stages = self.derived.remove(name).map(|derived| derived.stages).unwrap_or_default();
            self.derived.insert(name.clone(), derived(base, name, stages));
        }
        gone
    }

    /// Drops what rests on a class that is new or gone.
    pub(super) fn forget(&mut self, base: &RuleBase, class: &str) {
        for (rule, node) in base.rules.iter().zip(&mut self.network.nodes) {
            if rule.classes().any(|of| of == class) {
                node.memory = None;
                node.planned = None;
                for name in rule.sets.keys() {
                    if let Some(derived) = self.derived.get_mut(name) {
                        derived.pending.fill(Dirty::All);
                    }
                }
            }
        }
        for (_, derived) in self.derived.iter_mut().filter(|(name, _)| name.class == class) {
            derived.stages.clear();
            derived.disputes.clear();
            derived.pending.fill(Dirty::All);
        }
    }

    /// Brings everything along after objects of a class came, went or moved.
    pub(super) fn reshape(&mut self, base: &RuleBase, class: &str) {
        let Some(Held { table, pending }) = self.held.get(class) else { return };
        let (len, moved) = (table.len, pending.moved.as_deref());
        let keeps_order = pending.keeps_order();
        for (_, derived) in self.derived.iter_mut().filter(|(name, _)| name.class == class) {
            for stage in &mut derived.stages {
                *stage = Arc::new(stage.moved(moved, len));
            }
            for rows in &mut derived.pending {
                *rows = match moved {
                    Some(moved) => std::mem::take(rows).moved(moved),
                    None => std::mem::take(rows),
                };
                rows.extend(pending.added.iter().copied());
            }
            if let Some(moved) = moved {
                derived.disputes =
                    derived.disputes.iter().filter_map(|&row| moved.get(row as usize).copied()?).collect();
            }
        }
        for (rule, node) in base.rules.iter().zip(&mut self.network.nodes) {
            if rule.classes().all(|of| of != class) {
                continue;
            }
            let Some(memory) = node.memory.as_mut().map(Arc::make_mut) else { continue };
            let others = memory.given.iter().filter(|given| given.variable != 0);
            let mut touched: Vec<PropertyName> = others.map(|given| given.name.clone()).collect();
            if memory.follows(rule, class, keeps_order) {
                let of_class = rule.clauses.iter().enumerate().filter(|(_, clause)| clause.class == class);
                for (number, _) in of_class {
                    if number == 0 {
                        memory.move_drivers(moved, len);
                    } else if let Some(moved) = moved {
                        memory.move_witnesses(number, moved);
                        // One that was unknown may be gone.
                        memory.lost.extend(memory.undecided.keys());
                    }
                    memory.candidates[number] = None;
                }
            } else {
                node.memory = None;
                touched = rule.sets.keys().cloned().collect();
            }
            for name in touched {
                if let Some(derived) = self.derived.get_mut(&name) {
                    derived.pending.fill(Dirty::All);
                }
            }
        }
    }
}

/// How rules give a property. What it held before is kept, so that what stays the same does not count as changed.
fn derived(base: &RuleBase, name: &PropertyName, stages: Vec<Arc<Column>>) -> Derived {
    let mut writers = vec![];
    let mut levels: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for (number, rule) in base.rules.iter().enumerate().filter(|(_, rule)| rule.sets.contains_key(name)) {
        match rule.level() {
            Some(level) => levels.entry(level).or_default().push(number),
            None => writers.push(Writer { rule: number, priority: rule.priority }),
        }
    }
    writers.sort_by_key(|writer| (std::cmp::Reverse(writer.priority), writer.rule));
    for rules in levels.values_mut() {
        rules.sort_by(|&a, &b| base.rules[a].name.cmp(&base.rules[b].name));
    }
    let levels: Vec<(i64, Vec<usize>)> = levels.into_iter().collect();
    let stages = if stages.len() == levels.len() + 1 { stages } else { vec![] };
    Derived {
        writers,
        pending: vec![Dirty::All; levels.len() + 1],
        complete: vec![false; levels.len() + 1],
        levels,
        hypothesis: base.hypotheses().contains(name),
        stages,
        rules_first: base.declared.rules_first(name),
        fresh: false,
        disputes: BTreeSet::new(),
    }
}
