//! What the rules that react see of the knowledge base: their own copy of the columns, by object, which stays as it was
//! until the matches that rest on it are found.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::changes::ClassChanges;
use crate::column::Column;
use crate::machine::candidates::Candidates;
use crate::rule::PropertyName;
use crate::value::{Cell, Type};

pub(crate) trait Facts {
    fn has(&self, class: &str) -> bool;
    /// How many objects a class has; 0 if there is no such class.
    fn count(&self, class: &str) -> usize;
    /// A property as hosts see it.
    fn column(&self, name: &PropertyName) -> Option<&Column>;
}

/// The objects of a class. An object keeps its number as long as it lives; numbers rise with the rows.
#[derive(Debug)]
pub(crate) struct Objects {
    /// For each row the object's number.
    pub(crate) ids: Arc<Vec<u32>>,
    next: u32,
    columns: Vec<usize>,
    added: BTreeSet<u32>,
    removed: BTreeSet<u32>,
    changed: BTreeSet<(u32, usize)>,
}

#[derive(Debug, Default)]
pub(crate) struct Difference {
    pub(crate) added: Vec<u32>,
    pub(crate) removed: Vec<u32>,
    /// Objects with other values, and the columns.
    pub(crate) changed: Vec<(u32, Vec<usize>)>,
}

/// The objects of a class, found by the values in some columns.
#[derive(Debug)]
pub(crate) struct Found {
    class: usize,
    columns: Vec<usize>,
    pub(crate) candidates: Candidates,
}

#[derive(Debug, Default)]
pub(crate) struct World {
    pub(crate) classes: Vec<Objects>,
    numbers: BTreeMap<String, usize>,
    pub(crate) columns: Vec<Column>,
    names: Vec<PropertyName>,
    pub(crate) candidates: Vec<Found>,
    /// Whether rows were put in another order, so that numbers have to be given anew.
    pub(crate) scrambled: bool,
}

impl World {
    pub(crate) fn class(&mut self, name: &str, facts: &dyn Facts) -> usize {
        if let Some(&number) = self.numbers.get(name) {
            return number;
        }
        let count = facts.count(name) as u32;
        self.classes.push(Objects {
            ids: Arc::new((0..count).collect()),
            next: count,
            columns: vec![],
            added: BTreeSet::new(),
            removed: BTreeSet::new(),
            changed: BTreeSet::new(),
        });
        self.numbers.insert(name.to_owned(), self.classes.len() - 1);
        self.classes.len() - 1
    }

    pub(crate) fn column(&mut self, name: &PropertyName, facts: &dyn Facts) -> usize {
        if let Some(number) = self.names.iter().position(|known| known == name) {
            return number;
        }
        let class = self.class(&name.class, facts);
        // A property that is not there yet may hold anything once it is.
        let unknown = || Column::unknown(Type::Truth, self.classes[class].ids.len());
        self.columns.push(facts.column(name).cloned().unwrap_or_else(unknown));
        self.names.push(name.clone());
        self.classes[class].columns.push(self.columns.len() - 1);
        self.columns.len() - 1
    }

    pub(crate) fn candidates(&mut self, class: usize, columns: Vec<usize>) -> usize {
        let known = |found: &Found| found.class == class && found.columns == columns;
        if let Some(number) = self.candidates.iter().position(known) {
            return number;
        }
        let mut candidates = Candidates::empty(columns.len());
        for &id in self.classes[class].ids.iter() {
            candidates.insert(id, columns.iter().map(|&column| self.columns[column].cell(id as usize)));
        }
        self.candidates.push(Found { class, columns, candidates });
        self.candidates.len() - 1
    }

    pub(crate) fn row(&self, class: usize, id: u32) -> Option<usize> {
        let ids = &self.classes[class].ids;
        if self.scrambled {
            return ids.iter().position(|&known| known == id);
        }
        // As long as nothing was removed, numbers are rows.
        match ids.get(id as usize) {
            Some(&same) if same == id => Some(id as usize),
            _ => ids.binary_search(&id).ok(),
        }
    }

    /// Notes that something changed; the values are fetched by [`World::fetch`].
    pub(crate) fn note(&mut self, class: &str, changes: &ClassChanges) {
        let Some(&number) = self.numbers.get(class) else { return };
        let objects = &mut self.classes[number];
        if let Some(moved) = &changes.moved {
            self.scrambled |= objects.move_to(moved);
        }
        if changes.moved.is_none()
            && changes.added.first().is_some_and(|&row| (row as usize) < objects.ids.len())
        {
            // Nobody moved, but new ones stand where others were: the class is another.
            for id in std::mem::take(Arc::make_mut(&mut objects.ids)) {
                objects.gone(id);
            }
        }
        for &row in &changes.added {
            let at = (row as usize).min(objects.ids.len());
            self.scrambled |= at < objects.ids.len();
            Arc::make_mut(&mut objects.ids).insert(at, objects.next);
            objects.added.insert(objects.next);
            objects.next += 1;
        }
        for (property, rows) in &changes.changed {
            let named = |name: &PropertyName| name.class == class && name.property == *property;
            let Some(column) = self.names.iter().position(named) else { continue };
            objects
                .changed
                .extend(rows.iter().filter_map(|&row| Some((*objects.ids.get(row as usize)?, column))));
        }
    }

    pub(crate) fn differences(&self, facts: &dyn Facts) -> Vec<Difference> {
        (0..self.classes.len()).map(|class| self.difference(class, facts)).collect()
    }

    fn difference(&self, class: usize, facts: &dyn Facts) -> Difference {
        let objects = &self.classes[class];
        let mut changed: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for &(id, column) in objects.changed.iter().filter(|(id, _)| !objects.added.contains(id)) {
            let Some(row) = self.row(class, id) else { continue };
            if self.now(column, row, facts) != self.columns[column].cell(id as usize) {
                changed.entry(id).or_default().push(column);
            }
        }
        Difference {
            added: objects.added.iter().copied().collect(),
            removed: objects.removed.iter().copied().collect(),
            changed: changed.into_iter().collect(),
        }
    }

    pub(crate) fn fetch(&mut self, differences: &[Difference], facts: &dyn Facts) {
        for (class, difference) in differences.iter().enumerate() {
            let objects = &mut self.classes[class];
            (objects.added, objects.removed, objects.changed) = Default::default();
            if difference.is_empty() {
                continue;
            }
            let changed = || difference.changed.iter().map(|(id, _)| *id);
            for found in self.candidates.iter_mut().filter(|found| found.class == class) {
                for id in difference.removed.iter().copied().chain(changed()) {
                    let values = found.columns.iter().map(|&column| self.columns[column].cell(id as usize));
                    found.candidates.remove(id, values);
                }
            }
            for at in 0..self.classes[class].columns.len() {
                let (column, next) = (self.classes[class].columns[at], self.classes[class].next);
                self.columns[column].resize(next as usize);
                let of_column = |(id, columns): &(u32, Vec<usize>)| columns.contains(&column).then_some(*id);
                let changed = difference.changed.iter().filter_map(of_column);
                for id in difference.added.iter().copied().chain(changed) {
                    let Some(row) = self.row(class, id) else { continue };
                    let cell = self.now(column, row, facts);
                    if let (Some(kind), false) = (cell.kind(), self.columns[column].set(id as usize, cell)) {
                        // It holds another type now, so every value of before is gone.
                        self.columns[column] = Column::unknown(kind, next as usize);
                        self.columns[column].set(id as usize, cell);
                    }
                }
            }
            for found in self.candidates.iter_mut().filter(|found| found.class == class) {
                for id in difference.added.iter().copied().chain(changed()) {
                    let values = found.columns.iter().map(|&column| self.columns[column].cell(id as usize));
                    found.candidates.insert(id, values);
                }
            }
        }
    }

    fn now(&self, column: usize, row: usize, facts: &dyn Facts) -> Cell {
        facts.column(&self.names[column]).map_or(Cell::Unknown, |column| column.cell(row))
    }

    pub(crate) fn go_back(&mut self, ids: Vec<Arc<Vec<u32>>>) {
        for (objects, ids) in self.classes.iter_mut().zip(ids) {
            objects.ids = ids;
            (objects.added, objects.removed, objects.changed) = Default::default();
        }
    }

    /// Whether most numbers stand for objects that are gone.
    pub(crate) fn is_sparse(&self) -> bool {
        self.classes.iter().any(|objects| objects.next as usize > 2 * objects.ids.len() + 1000)
    }
}

impl Difference {
    pub(crate) fn is_empty(&self) -> bool {
        self.added.is_empty() && self.removed.is_empty() && self.changed.is_empty()
    }
}

impl Objects {
    /// Objects go to other rows; whether that changes their order.
    fn move_to(&mut self, moved: &[Option<u32>]) -> bool {
        let before = std::mem::take(&mut self.ids);
        let mut ids = Vec::with_capacity(before.len());
        let mut late: Vec<(u32, u32)> = vec![];
        for (&id, to) in before.iter().zip(moved) {
            match to {
                None => self.gone(id),
                Some(row) if late.is_empty() && *row as usize == ids.len() => ids.push(id),
                Some(row) => late.push((*row, id)),
            }
        }
        let scrambled = !late.is_empty();
        late.sort_unstable();
        ids.extend(late.into_iter().map(|(_, id)| id));
        self.ids = Arc::new(ids);
        scrambled
    }

    fn gone(&mut self, id: u32) {
        if !self.added.remove(&id) {
            self.removed.insert(id);
        }
        let of_it: Vec<_> = self.changed.range((id, 0)..=(id, usize::MAX)).copied().collect();
        for change in of_it {
            self.changed.remove(&change);
        }
    }
}
