//! Revisions: each level folds what its rules contribute into what the level below left.

use std::cmp::Ordering;
use std::sync::Arc;

use super::KnowledgeBase;
use super::conclude::Run;
use super::derived::Writer;
use super::dirty::Dirty;
use super::voices::Voice;
use crate::column::Column;
use crate::machine::lane::NO_ROW;
use crate::rule::{Action, PropertyName};
use crate::rule_base::RuleBase;
use crate::value::Cell;

impl KnowledgeBase {
    pub(super) fn revise(&mut self, run: &mut Run, name: &PropertyName, level: i64) {
        let Some(mut derived) = self.derived.remove(name) else { return };
        let stage = derived.stage(Some(level)) + 1;
        if run.recheck {
            let done = |&rule: &usize| self.network.nodes[rule].needs.is_empty();
            derived.complete[stage] =
                derived.complete[stage - 1] && derived.levels[stage - 1].1.iter().all(done);
        }
        if derived.stages.is_empty() || derived.pending[stage].is_none() {
            self.derived.insert(name.clone(), derived);
            return;
        }
        let len = derived.stages[0].len();
        let pending = std::mem::take(&mut derived.pending[stage]).settle(len);
        run.reasons.entry(name.clone()).or_default().join(&pending);
        let rules = derived.levels[stage - 1].1.clone();
        self.index(name, &rules);
        let mut changed = Dirty::None;
        let revising = |&rule: &usize| match run.base.rules[rule].action {
            Action::Revise { operator, .. } => {
                Some((operator, self.rules_of(name, [Writer { rule, priority: level }])))
            }
            _ => None,
        };
        let revising: Vec<_> = rules.iter().filter_map(revising).collect();
        for row in pending.rows(len) {
            let (mut value, before) = match (&*derived.stages[stage - 1], &*derived.stages[stage]) {
                (Column::Numbers(below), Column::Numbers(now)) => (below[row as usize], now[row as usize]),
                _ => continue,
            };
            for (operator, voices) in &revising {
                for (amount, _) in self.contributions(run.base, voices, row) {
                    value = operator.apply(value, amount.unwrap_or(f64::NAN));
                }
            }
            if !Cell::number(value).same(Cell::number(before)) {
                Arc::make_mut(&mut derived.stages[stage]).set(row as usize, Cell::number(value));
                changed.add(row);
            }
        }
        let changed = changed.settle(len);
        let of = derived.stages.len();
        run.changed(name, (stage, of), &changed);
        if let Some(next) = derived.pending.get_mut(stage + 1) {
            next.join(&changed);
        }
        self.derived.insert(name.clone(), derived);
    }

    /// What a rule that revises contributes to one object, with its firings, in an order that rests on keys alone: equal facts
    /// give equal bits, however rows are ordered.
    pub(super) fn contributions(
        &self,
        base: &RuleBase,
        voices: &[Voice<'_>],
        row: u32,
    ) -> Vec<(Option<f64>, usize)> {
        let mut claims: Vec<(Cell, usize)> = voices.iter().flat_map(|voice| voice.claims(row)).collect();
        if claims.len() > 1
            && let Some(&Voice { rule, memory, .. }) = voices.first()
        {
            let clauses = &base.rules[rule].clauses;
            claims.sort_by(|&(_, a), &(_, b)| {
                let by_key = |order: Ordering, (number, clause): (usize, &crate::rule::Clause)| {
                    order.then_with(|| {
                        self.order_of(&clause.class, memory.witness(number, a), memory.witness(number, b))
                    })
                };
                clauses.iter().enumerate().fold(Ordering::Equal, by_key)
            });
        }
        let number = |cell| if let Cell::Number(number) = cell { Some(number) } else { None };
        claims.into_iter().map(|(cell, firing)| (number(cell), firing)).collect()
    }

    fn order_of(&self, class: &str, a: u32, b: u32) -> Ordering {
        let Some(held) = self.held.get(class).filter(|_| a != NO_ROW && b != NO_ROW) else {
            return a.cmp(&b);
        };
        let symbols = self.symbols.read();
        let by_key = held.table.key.iter().fold(Ordering::Equal, |order, &column| {
            let column = &held.table.columns[column];
            order.then_with(|| match (column.cell(a as usize), column.cell(b as usize)) {
                (Cell::Number(a), Cell::Number(b)) => a.total_cmp(&b),
                (Cell::Text(a), Cell::Text(b)) => symbols.text(a).cmp(&symbols.text(b)),
                (Cell::Truth(a), Cell::Truth(b)) => a.cmp(&b),
                _ => Ordering::Equal,
            })
        });
        by_key.then(a.cmp(&b))
    }
}
