//! Brings together what was told of a property and what rules conclude.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::KnowledgeBase;
use super::conclude::Run;
use super::derived::{Derived, Heard, heard};
use super::dirty::Dirty;
use super::voices::{Source, Voice};
use crate::column::Column;
use crate::machine::output::Buffer;
use crate::rule::PropertyName;
use crate::value::Type;

impl KnowledgeBase {
    pub(super) fn merge(&mut self, run: &mut Run, name: &PropertyName) {
        let Some(mut derived) = self.derived.remove(name) else { return };
        if run.recheck {
            self.settle(name, &mut derived, run);
        }
        if derived.stages.is_empty() || derived.pending[0].is_none() {
            self.derived.insert(name.clone(), derived);
            return;
        }
        let len = derived.stages[0].len();
        let pending = std::mem::take(&mut derived.pending[0]).settle(len);
        run.reasons.entry(name.clone()).or_default().join(&pending);
        self.index(name, &derived.rules());
        let kind = derived.stages[0].kind();
        let changed = match pending {
            Dirty::All => self.merge_all(name, &mut derived),
            pending => self.merge_rows(name, &mut derived, &pending.rows(len)),
        };
        // Who reads it was planned for another type.
        self.network.recheck |= derived.stages[0].kind() != kind;
        let changed = changed.settle(len);
        let of = derived.stages.len();
        run.changed(name, (0, of), &changed);
        if let Some(next) = derived.pending.get_mut(1) {
            next.join(&changed);
        }
        self.derived.insert(name.clone(), derived);
    }

    /// Finds out whether the property is there at all, whole, and of which type.
    fn settle(&mut self, name: &PropertyName, derived: &mut Derived, run: &mut Run) {
        let Some(held) = self.held.get(&name.class) else {
            derived.stages.clear();
            return;
        };
        let told = held.table.column(&name.property).is_some();
        let done = |&rule: &usize| self.network.nodes[rule].needs.is_empty();
        let writers = derived.rules();
        derived.complete[0] = writers.iter().all(done);
        if !told && !writers.iter().any(done) {
            for stage in 0..derived.stages.len() {
                run.changed(name, (stage, derived.stages.len()), &Dirty::All);
            }
            derived.stages.clear();
            derived.pending.fill(Dirty::All);
            return;
        }
        let kind = self.kind(name, &writers);
        let fits = derived
            .stages
            .first()
            .is_some_and(|column| column.kind() == kind && column.len() == held.table.len);
        if !fits {
            let unknown = Arc::new(Column::unknown(kind, held.table.len));
            derived.stages = std::iter::repeat_n(unknown, derived.levels.len() + 1).collect();
            derived.pending.fill(Dirty::All);
            derived.fresh = true;
            for stage in 0..derived.stages.len() {
                run.changed(name, (stage, derived.stages.len()), &Dirty::All);
            }
        }
    }

    /// The told type, or that of the first rule that has one.
    fn kind(&self, name: &PropertyName, writers: &[usize]) -> Type {
        let given = || {
            let memories = writers.iter().filter_map(|&rule| self.network.nodes[rule].memory.as_ref());
            memories.flat_map(|memory| &memory.given).filter(|given| given.name == *name)
        };
        let typed = |buffer: &Buffer| match buffer {
            Buffer::Typed(column) => Some(column.kind()),
            Buffer::Cells(_) => None,
        };
        let found = |buffer: &Buffer| match buffer {
            Buffer::Cells(cells) => cells.iter().find_map(|cell| cell.kind()),
            Buffer::Typed(_) => None,
        };
        self.told_column(name)
            .map(Column::kind)
            .or_else(|| given().find_map(|given| typed(&given.values)))
            .or_else(|| given().find_map(|given| found(&given.values)))
            .unwrap_or(Type::Number)
    }

    /// Makes it fast to find the firings that set a row.
    pub(super) fn index(&mut self, name: &PropertyName, rules: &[usize]) {
        let len = self.len(&name.class).unwrap_or(0);
        for &rule in rules {
            let Some(memory) = &mut self.network.nodes[rule].memory else { continue };
            for at in 0..memory.given.len() {
                if memory.given[at].name == *name && !memory.is_prepared(at) {
                    Arc::make_mut(memory).prepare(at, len);
                }
            }
        }
    }

    fn merge_all(&self, name: &PropertyName, derived: &mut Derived) -> Dirty {
        let kind = self.retyped(name, derived);
        if let Some(kind) = kind {
            let len = derived.stages[0].len();
            derived.stages.fill(Arc::new(Column::unknown(kind, len)));
            derived.pending.iter_mut().skip(1).for_each(|pending| *pending = Dirty::All);
        }
        let before = std::mem::replace(&mut derived.stages[0], Arc::new(Column::unknown(Type::Number, 0)));
        let fresh = std::mem::take(&mut derived.fresh) || kind.is_some();
        derived.disputes.clear();
        let straight = match self.straight(name, derived, &before).cloned() {
            Some(column) => Some(column),
            None => self.side_by_side(name, derived, &before).map(|(column, disputes)| {
                derived.disputes = disputes;
                column
            }),
        };
        let (column, changed) = match straight {
            Some(column) if fresh => (column, Dirty::All),
            Some(column) => {
                let differing = Dirty::Rows(before.differing(&column));
                (column, differing)
            }
            None => {
                let mut column = Column::unknown(before.kind(), before.len());
                let voices = self.voices(name, derived);
                let kind = column.kind();
                for row in 0..column.len() as u32 {
                    let (cell, source) = voices.resolve(row, kind);
                    column.set(row as usize, cell);
                    if source == Source::Dispute {
                        derived.disputes.insert(row);
                    }
                }
                let differing = if fresh { Dirty::All } else { Dirty::Rows(before.differing(&column)) };
                (column, differing)
            }
        };
        derived.stages[0] = Arc::new(column);
        changed
    }

    /// The type that the values have now, if it is another one: of a property that only interpreted parts give.
    fn retyped(&self, name: &PropertyName, derived: &Derived) -> Option<Type> {
        let kind = self.kind(name, &derived.rules());
        (kind != derived.stages[0].kind()).then_some(kind)
    }

    /// The whole column where one rule alone gives it, object by object.
    fn straight(&self, name: &PropertyName, derived: &Derived, before: &Column) -> Option<&Column> {
        let [writer] = derived.writers.as_slice() else { return None };
        if self.told_column(name).is_some() {
            return None;
        }
        let memory = self.network.nodes[writer.rule].memory.as_ref()?;
        let mut given = memory.given.iter().filter(|given| given.name == *name);
        let (given, None) = (given.next()?, given.next()) else { return None };
        match &given.values {
            Buffer::Typed(column)
                if memory.sets_own(given)
                    && column.kind() == before.kind()
                    && column.len() == before.len() =>
            {
                Some(column)
            }
            _ => None,
        }
    }

    /// The whole column where each rule gives it object by object, and nobody tells it.
    fn side_by_side(
        &self,
        name: &PropertyName,
        derived: &Derived,
        before: &Column,
    ) -> Option<(Column, BTreeSet<u32>)> {
        if derived.hypothesis || self.told_column(name).is_some() {
            return None;
        }
        let voices = self.rules_of(name, derived.writers.iter().copied());
        if voices.iter().any(|voice| !voice.is_own) {
            return None;
        }
        let kind = before.kind();
        let mut column = Column::unknown(kind, before.len());
        let mut disputes = BTreeSet::new();
        for row in 0..before.len() {
            let said = |voice: &Voice| {
                let claim = voice.memory.claim(voice.at, row);
                (voice.priority, claim.filter(|cell| cell.kind() == Some(kind)))
            };
            match heard(voices.iter().map(said)) {
                Heard::Value(cell) => {
                    column.set(row, cell);
                }
                Heard::Dispute => {
                    disputes.insert(row as u32);
                }
                Heard::Nothing => {}
            }
        }
        Some((column, disputes))
    }

    fn merge_rows(&self, name: &PropertyName, derived: &mut Derived, rows: &[u32]) -> Dirty {
        if self.retyped(name, derived).is_some() {
            return self.merge_all(name, derived);
        }
        let mut changed = Dirty::None;
        let (len, kind) = (derived.stages[0].len(), derived.stages[0].kind());
        let voices = self.voices(name, derived);
        for &row in rows.iter().filter(|&&row| (row as usize) < len) {
            let (cell, source) = voices.resolve(row, kind);
            if source == Source::Dispute {
                derived.disputes.insert(row);
            } else {
                derived.disputes.remove(&row);
            }
            if !derived.stages[0].cell(row as usize).same(cell) {
                Arc::make_mut(&mut derived.stages[0]).set(row as usize, cell);
                changed.add(row);
            }
        }
        changed
    }
}
