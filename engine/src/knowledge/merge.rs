//! Brings together what is told and what rules gave, and applies revisions.

use std::collections::BTreeMap;

use super::KnowledgeBase;
use super::derived::{Claim, Derived, Layer, Made, NO_RULE};
use crate::column::Column;
use crate::diagnostic::{Code, Diagnostic};
use crate::machine::lane::NO_ROW;
use crate::machine::output::{Given, Output};
use crate::rule::{Action, PropertyName, Rule};
use crate::rule_base::RuleBase;
use crate::value::{Cell, Type};

impl KnowledgeBase {
    /// Makes the column of a property; `true` if every rule that concludes it was evaluated.
    pub(super) fn merge(&mut self, base: &RuleBase, name: &PropertyName) -> bool {
        let Some(held) = self.held.get(&name.class) else { return false };
        let writers: Vec<&Rule> =
            base.rules.iter().filter(|rule| rule.level().is_none() && rule.sets.contains_key(name)).collect();
        let mut made_from: Made = vec![(name.class.clone(), held.stamp)];
        made_from.extend(
            writers
                .iter()
                .filter_map(|rule| self.done.get(rule.name()).map(|done| (rule.name.clone(), done.stamp))),
        );
        let complete = made_from.len() == writers.len() + 1;
        let told = held.table.column(&name.property);
        if told.is_none() && made_from.len() == 1 {
            self.derived.remove(name);
            return false;
        }
        if self.derived.get(name).is_some_and(|derived| derived.made_from == made_from) {
            return complete;
        }
        let mut merging = Merging::new(told, held.table.len, self.kind(name, told, &writers));
        for (number, rule) in (0..).zip(&writers) {
            let given = self.done.get(rule.name()).and_then(|done| find(&done.output, name));
            if let Some(given) = given {
                merging.add(number, given, rule);
            }
        }
        let Merging { column, origin, disputes, problems, .. } = merging;
        let writers = writers.iter().map(|rule| rule.name.clone()).collect();
        let stamp = self.tick();
        let derived =
            Derived { writers, made_from, stamp, merged: column, origin, disputes, problems, layers: vec![] };
        self.derived.insert(name.clone(), derived);
        complete
    }

    /// The told type, or that of the first rule that has one.
    fn kind(&self, name: &PropertyName, told: Option<&Column>, writers: &[&Rule]) -> Type {
        let outputs = || writers.iter().filter_map(|rule| find(&self.done.get(rule.name())?.output, name));
        told.map(Column::kind)
            .or_else(|| outputs().find_map(|given| given.kind))
            .or_else(|| outputs().find_map(|given| given.cells.iter().find_map(|cell| cell.kind())))
            .unwrap_or(Type::Number)
    }

    /// Applies one level of revision; `true` if every revision of the level was evaluated.
    pub(super) fn revise(&mut self, base: &RuleBase, name: &PropertyName, level: i64) -> bool {
        let rules: Vec<&Rule> = base
            .rules
            .iter()
            .filter(|rule| rule.level() == Some(level) && rule.sets.contains_key(name))
            .collect();
        let Some((below, below_stamp)) = self.view(name, Some(level)) else { return false };
        let mut made_from: Made = vec![(name.to_string(), below_stamp)];
        made_from.extend(
            rules
                .iter()
                .filter_map(|rule| self.done.get(rule.name()).map(|done| (rule.name.clone(), done.stamp))),
        );
        let complete = made_from.len() == rules.len() + 1;
        let Some(derived) = self.derived.get(name) else { return false };
        let at = derived.layers.iter().position(|layer| layer.level >= level).unwrap_or(derived.layers.len());
        if derived.layers.get(at).is_some_and(|layer| layer.level == level && layer.made_from == made_from) {
            return complete;
        }
        let mut column = below.clone();
        if let Column::Numbers(values) = &mut column {
            for (operator, row, amount) in self.contributions(name, &rules) {
                values[row] = operator.apply(values[row], amount);
            }
        }
        let stamp = self.tick();
        if let Some(derived) = self.derived.get_mut(name) {
            derived.layers.truncate(at);
            derived.layers.push(Layer { level, made_from, stamp, column });
        }
        complete
    }

    /// What the revisions of a level contribute, in an order that rests on names and keys alone: equal facts give
    /// equal bits, however rows and files are ordered.
    fn contributions(
        &self,
        name: &PropertyName,
        rules: &[&Rule],
    ) -> Vec<(crate::rule::Operator, usize, f64)> {
        let mut sorted: Vec<&&Rule> = rules.iter().collect();
        sorted.sort_by(|a, b| a.name.cmp(&b.name));
        let mut out = vec![];
        for rule in sorted {
            let Action::Revise { operator, .. } = rule.action else { continue };
            let Some(done) = self.done.get(rule.name()) else { continue };
            let Some(given) = find(&done.output, name) else { continue };
            let ranks: Vec<Option<Vec<u32>>> = rule.classes().map(|class| self.ranks(class)).collect();
            let rank = |firing: u32| -> Vec<u32> {
                done.output
                    .witnesses
                    .iter()
                    .zip(&ranks)
                    .map(|(rows, ranks)| {
                        let row = rows[firing as usize];
                        ranks.as_ref().and_then(|ranks| ranks.get(row as usize)).copied().unwrap_or(row)
                    })
                    .collect()
            };
            let mut firings: Vec<(Vec<u32>, usize)> =
                given.firings.iter().enumerate().map(|(nth, &firing)| (rank(firing), nth)).collect();
            firings.sort();
            for (_, nth) in firings {
                let amount = match given.cells[nth] {
                    Cell::Number(amount) => amount,
                    _ => f64::NAN,
                };
                if given.rows[nth] != NO_ROW {
                    out.push((operator, given.rows[nth] as usize, amount));
                }
            }
        }
        out
    }

    /// For each row its place in the order of keys.
    fn ranks(&self, class: &str) -> Option<Vec<u32>> {
        let table = &self.held.get(class)?.table;
        let symbols = self.symbols.borrow();
        let mut rows: Vec<u32> = (0..table.len as u32).collect();
        rows.sort_by(|&a, &b| {
            table.key.iter().fold(std::cmp::Ordering::Equal, |order, &column| {
                let column = &table.columns[column];
                order.then_with(|| match (column.cell(a as usize), column.cell(b as usize)) {
                    (Cell::Number(a), Cell::Number(b)) => a.total_cmp(&b),
                    (Cell::Text(a), Cell::Text(b)) => symbols.text(a).cmp(&symbols.text(b)),
                    (Cell::Truth(a), Cell::Truth(b)) => a.cmp(&b),
                    _ => std::cmp::Ordering::Equal,
                })
            })
        });
        let mut ranks = vec![0; rows.len()];
        for (rank, row) in (0..).zip(rows) {
            ranks[row as usize] = rank;
        }
        Some(ranks)
    }
}

pub(super) fn find<'o>(output: &'o Output, name: &PropertyName) -> Option<&'o Given> {
    output.given.iter().find(|given| given.name == *name)
}

/// A column in the making.
struct Merging<'t> {
    told: Option<&'t Column>,
    column: Column,
    origin: Vec<(u32, u32)>,
    disputes: BTreeMap<u32, Vec<Claim>>,
    problems: Vec<Diagnostic>,
}

impl<'t> Merging<'t> {
    fn new(told: Option<&'t Column>, len: usize, kind: Type) -> Self {
        let column = told.map_or_else(|| Column::unknown(kind, len), Clone::clone);
        Self { told, column, origin: vec![(NO_RULE, 0); len], disputes: BTreeMap::new(), problems: vec![] }
    }

    fn add(&mut self, writer: u32, given: &Given, rule: &Rule) {
        let mut mistyped = 0;
        for ((&row, &firing), &cell) in given.rows.iter().zip(&given.firings).zip(&given.cells) {
            let at = row as usize;
            if self.told.is_some_and(|told| !told.is_unknown(at)) {
                continue;
            }
            if cell == Cell::Unknown {
                // It says nothing, but the rule did apply: that explains the gap.
                if self.origin[at].0 == NO_RULE {
                    self.origin[at] = (writer, firing);
                }
                continue;
            }
            if cell.kind() != Some(self.column.kind()) {
                mistyped += 1;
                continue;
            }
            self.claim(row, (writer, firing, cell));
        }
        if mistyped > 0
            && let Some(position) = rule.sets.get(&given.name)
        {
            let place = rule.file.source.place(*position);
            let holds = self.column.kind().plural();
            let message = format!("{} holds {holds}; rule \"{}\" gave something else", given.name, rule.name);
            self.problems.push(
                Diagnostic::error(Code::Type, &place, message).label(format!("for {mistyped} objects")),
            );
        }
    }

    fn claim(&mut self, row: u32, claim: Claim) {
        let at = row as usize;
        if let Some(claims) = self.disputes.get_mut(&row) {
            if claims.iter().all(|&(_, _, cell)| cell != claim.2) {
                claims.push(claim);
            }
            return;
        }
        let held = self.column.cell(at);
        if held == Cell::Unknown {
            self.column.set(at, claim.2);
            self.origin[at] = (claim.0, claim.1);
        } else if held != claim.2 {
            let (writer, firing) = self.origin[at];
            self.disputes.insert(row, vec![(writer, firing, held), claim]);
            self.column.set(at, Cell::Unknown);
        }
    }
}
