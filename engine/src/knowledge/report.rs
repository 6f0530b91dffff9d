//! What hosts are told of all rules and objects: what waits, conflicts, gaps, what was left out, what failed.

use std::collections::BTreeMap;
use std::time::Instant;

use super::KnowledgeBase;
use super::derived::Derived;
use super::voices::{Source, Voices};
use crate::conclusions::{Conclusions, Conflict, Gap, LeftOut, Reason, Waiting};
use crate::diagnostic::{Code, Diagnostic};
use crate::machine::output::{Buffer, Status};
use crate::rule::PropertyName;
use crate::rule_base::RuleBase;
use crate::script::syntax::Quantifier;
use crate::value::Cell;

impl KnowledgeBase {
    /// What the last inference left open, over all rules and objects; `evaluated` is empty.
    pub(super) fn report(&mut self, base: &RuleBase) -> Conclusions {
        let names: Vec<PropertyName> = self.derived.keys().cloned().collect();
        for name in &names {
            self.index(name, &self.derived[name].rules());
        }
        let until = self.limits.end(self.limits.inference);
        let mut report = Conclusions::default();
        for (number, rule) in base.rules.iter().enumerate() {
            let node = &self.network.nodes[number];
            if !node.needs.is_empty() {
                report.waiting.push(Waiting { rule: rule.name.clone(), needs: node.needs.clone() });
                continue;
            }
            report.diagnostics.extend(node.problems.iter().cloned());
            report.diagnostics.extend(node.memory.as_ref().and_then(|memory| memory.problem.clone()));
            report.left_out.extend(self.left_out(base, number, until));
        }
        report.waiting.sort_by_key(|waiting| self.place(base, &waiting.rule));
        for (name, derived) in &self.derived {
            if derived.stages.is_empty() {
                continue;
            }
            report.diagnostics.extend(self.mistyped(base, name, derived));
            let conflicts = self.conflicts(base, name, derived);
            report
                .diagnostics
                .extend(conflicts.first().and_then(|first| disagreement(base, first, conflicts.len())));
            report.conflicts.extend(conflicts);
            if derived.complete.last() == Some(&true) {
                report.gaps.extend(self.gap(base, name, derived));
            }
        }
        report
    }

    /// What failed in the last inference: rules that were stopped, and values of another type than their
    /// property's. The errors of [`conclude`](Self::conclude) without its report on all objects.
    pub fn problems(&self, base: &RuleBase) -> Vec<Diagnostic> {
        let mut problems = vec![];
        for node in &self.network.nodes {
            problems.extend(node.problems.iter().cloned());
            problems.extend(node.memory.as_ref().and_then(|memory| memory.problem.clone()));
        }
        for (name, derived) in self.derived.iter().filter(|(_, derived)| !derived.stages.is_empty()) {
            problems.extend(self.mistyped(base, name, derived));
        }
        problems
    }

    #[allow(clippy::unused_self)] // it reads as a question to the knowledge base
    fn place(&self, base: &RuleBase, rule: &str) -> usize {
        let is = |step: &crate::order::Step| matches!(step, crate::order::Step::Rule(number) if base.rules[*number].name == rule);
        base.order.iter().position(is).unwrap_or(usize::MAX)
    }

    fn left_out(&self, base: &RuleBase, number: usize, until: Instant) -> Vec<LeftOut> {
        let (rule, node) = (&base.rules[number], &self.network.nodes[number]);
        let (Some(planned), Some(memory)) = (&node.planned, &node.memory) else { return vec![] };
        let mut out = vec![];
        for (at, clause) in rule.clauses.iter().enumerate() {
            let objects = match &memory.candidates[at] {
                Some(candidates) => candidates.left_out,
                None if at == 0 => {
                    memory.statuses.iter().filter(|&&status| status == Status::LEFT_OUT).count()
                }
                None => {
                    let machine = self.machine(rule, &planned.plan, until);
                    self.candidates(&machine, &planned.plan, at).map_or(0, |found| found.left_out)
                }
            };
            if objects > 0 {
                let (variable, class) = (clause.variable.clone(), clause.class.clone());
                out.push(LeftOut { rule: rule.name.clone(), variable, class, objects });
            }
        }
        out
    }

    /// Values of another type than the property's, which interpreted parts can give.
    fn mistyped(&self, base: &RuleBase, name: &PropertyName, derived: &Derived) -> Vec<Diagnostic> {
        let kind = derived.stages[0].kind();
        let mut problems = vec![];
        for writer in &derived.writers {
            let (rule, node) = (&base.rules[writer.rule], &self.network.nodes[writer.rule]);
            let Some(memory) = &node.memory else { continue };
            let wrong = |cell: &&Cell| cell.kind().is_some_and(|given| given != kind);
            let of = memory.given.iter().filter(|given| given.name == *name);
            let count: usize = of
                .map(|given| match &given.values {
                    Buffer::Cells(cells) => cells.iter().filter(wrong).count(),
                    Buffer::Typed(column) if column.kind() == kind => 0,
                    Buffer::Typed(column) => (0..column.len()).filter(|&at| !column.is_unknown(at)).count(),
                })
                .sum();
            if count > 0
                && let Some(position) = rule.sets.get(name)
            {
                let message =
                    format!("{name} holds {}; rule \"{}\" gave something else", kind.plural(), rule.name);
                problems.push(
                    rule.file.error(Code::Type, *position, message).label(format!("for {count} objects")),
                );
            }
        }
        problems
    }

    fn conflicts(&self, base: &RuleBase, name: &PropertyName, derived: &Derived) -> Vec<Conflict> {
        derived.disputes.iter().map(|&row| self.dispute(base, name, derived, row)).collect()
    }

    /// What rules disagree about: a property of the object with this key. `None` where they do not, or there is no such object.
    pub fn conflict(&self, base: &RuleBase, class: &str, key: &str, property: &str) -> Option<Conflict> {
        let row = u32::try_from(self.row(class, key)?).ok()?;
        let name = PropertyName::new(class, property);
        let derived = self.known_derived(&name)?;
        let is_disputed = derived.disputes.iter().any(|&disputed| disputed == row);
        is_disputed.then(|| self.dispute(base, &name, derived, row))
    }

    fn dispute(&self, base: &RuleBase, name: &PropertyName, derived: &Derived, row: u32) -> Conflict {
        let mut values: Vec<(String, crate::value::Value)> = vec![];
        let mut seen: Vec<Cell> = vec![];
        let mut priority = None;
        for voice in self.rules_of(name, derived.writers.iter().copied()) {
            if priority.is_some_and(|priority| voice.priority < priority) {
                break;
            }
            for (cell, _) in voice.claims(row) {
                if cell.kind() == Some(derived.stages[0].kind()) && !seen.contains(&cell) {
                    seen.push(cell);
                    priority = Some(voice.priority);
                    values.extend(
                        self.host_value(cell).map(|value| (base.rules[voice.rule].name.clone(), value)),
                    );
                }
            }
        }
        let key = self.key(&name.class, row as usize).unwrap_or_default();
        Conflict { property: name.clone(), key, values }
    }

    fn gap(&self, base: &RuleBase, name: &PropertyName, derived: &Derived) -> Option<Gap> {
        let column = derived.stages.last()?;
        let rows: Vec<u32> =
            (0..column.len() as u32).filter(|&row| column.is_unknown(row as usize)).collect();
        if rows.is_empty() || derived.writers.is_empty() {
            return None;
        }
        let mut reasons: BTreeMap<Reason, usize> = BTreeMap::new();
        let voices = self.voices(name, derived);
        for &row in &rows {
            *reasons.entry(self.reason(base, name, (derived, &voices), row)).or_default() += 1;
        }
        Some(Gap { property: name.clone(), rows, reasons: reasons.into_iter().collect() })
    }

    fn reason(
        &self,
        base: &RuleBase,
        name: &PropertyName,
        (derived, voices): (&Derived, &Voices<'_>),
        row: u32,
    ) -> Reason {
        match voices.resolve(row, derived.stages[0].kind()).1 {
            Source::Dispute => return Reason::Conflict,
            Source::Rule { rule, .. } => return Reason::Unknown { rule: base.rules[rule].name.clone() },
            Source::Nobody | Source::Told => {}
        }
        for writer in &derived.writers {
            let (rule, node) = (&base.rules[writer.rule], &self.network.nodes[writer.rule]);
            let Some(memory) = &node.memory else { continue };
            if rule.clauses[0].class != name.class {
                continue;
            }
            let Some(clause) = memory.statuses.get(row as usize).and_then(|status| status.unmet()) else {
                continue;
            };
            let clause = &rule.clauses[clause];
            let (rule, variable) = (rule.name.clone(), clause.variable.clone());
            return match clause.quantifier {
                _ if memory.undecided.contains_key(&row) => Reason::Undecided { rule, variable },
                Quantifier::None => Reason::Found { rule, variable },
                Quantifier::All => Reason::NotAll { rule, variable },
                _ => Reason::Unmet { rule, variable },
            };
        }
        Reason::NoRule
    }
}

fn disagreement(base: &RuleBase, first: &Conflict, count: usize) -> Option<Diagnostic> {
    let said: Vec<String> =
        first.values.iter().map(|(rule, value)| format!("\"{rule}\" says {value}")).collect();
    let (last, _) = first.values.last()?;
    let rule = base.rules.iter().find(|rule| rule.name == *last)?;
    let (property, key) = (&first.property, &first.key);
    let message = format!("rules disagree about {property} of {key}: {}", said.join(", "));
    let others = if count == 1 { String::new() } else { format!(", as {} others", count - 1) };
    let help = format!(
        "{key} has no value of it now{others}; give one of the rules a `where` that keeps them apart"
    );
    Some(rule.file.error(Code::Conflict, *rule.sets.get(&first.property)?, message).warning().help(help))
}
