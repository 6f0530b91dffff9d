//! What the rules that react see of the knowledge base: their own copy of the columns, by object, with the values
//! of before where they have just changed.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::index::Index;
use crate::changes::ClassChanges;
use crate::column::Column;
use crate::rule::PropertyName;
use crate::value::Cell;

/// Where the values come from.
pub(crate) trait Facts {
    /// Whether there is such a class.
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
    /// The first number that was never given.
    next: u32,
    /// Its columns by their numbers in the world.
    columns: Vec<usize>,
    indexes: Vec<usize>,
    /// Whether a clause other than `each` ranges over it: then what an object was before counts too.
    pub(crate) watched: bool,
    added: BTreeSet<u32>,
    removed: BTreeSet<u32>,
    changed: BTreeSet<(u32, usize)>,
}

/// What happened to the objects of one class.
#[derive(Debug, Default)]
pub(crate) struct Difference {
    pub(crate) added: Vec<u32>,
    /// Objects that are gone, and what they were: an object with their values, which is in no index.
    pub(crate) removed: Vec<(u32, Option<u32>)>,
    /// Objects with other values, the columns, and what they were.
    pub(crate) changed: Vec<(u32, Vec<usize>, Option<u32>)>,
}

/// All objects that the rules look at.
#[derive(Debug, Default)]
pub(crate) struct World {
    pub(crate) classes: Vec<Objects>,
    numbers: BTreeMap<String, usize>,
    pub(crate) columns: Vec<Vec<Cell>>,
    names: Vec<PropertyName>,
    pub(crate) indexes: Vec<Index>,
    /// Whether rows were put in another order, so that numbers have to be given anew.
    pub(crate) scrambled: bool,
}

impl World {
    /// The number of a class.
    pub(crate) fn class(&mut self, name: &str, facts: &dyn Facts) -> usize {
        if let Some(&number) = self.numbers.get(name) {
            return number;
        }
        let count = facts.count(name) as u32;
        self.classes.push(Objects {
            ids: Arc::new((0..count).collect()),
            next: count,
            columns: vec![],
            indexes: vec![],
            watched: false,
            added: BTreeSet::new(),
            removed: BTreeSet::new(),
            changed: BTreeSet::new(),
        });
        self.numbers.insert(name.to_owned(), self.classes.len() - 1);
        self.classes.len() - 1
    }

    /// The number of a column.
    pub(crate) fn column(&mut self, name: &PropertyName, facts: &dyn Facts) -> usize {
        if let Some(number) = self.names.iter().position(|known| known == name) {
            return number;
        }
        let class = self.class(&name.class, facts);
        let column = facts.column(name);
        let cell = |row| column.map_or(Cell::Unknown, |column| column.cell(row));
        self.columns.push((0..self.classes[class].ids.len()).map(cell).collect());
        self.names.push(name.clone());
        self.classes[class].columns.push(self.columns.len() - 1);
        self.columns.len() - 1
    }

    /// The number of the index over these columns of a class.
    pub(crate) fn index(&mut self, class: usize, columns: &[usize]) -> usize {
        if let Some(number) = self.indexes.iter().position(|index| index.columns == columns) {
            return number;
        }
        let mut index = Index::new(columns.to_vec());
        for &id in self.classes[class].ids.iter() {
            index.insert(id, &self.columns);
        }
        self.indexes.push(index);
        self.classes[class].indexes.push(self.indexes.len() - 1);
        self.indexes.len() - 1
    }

    /// One value; unknown where nothing is bound.
    pub(crate) fn cell(&self, column: usize, id: u32) -> Cell {
        self.columns[column].get(id as usize).copied().unwrap_or(Cell::Unknown)
    }

    /// The row of an object.
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

    /// Fetches what was noted, and tells what happened, by class. Afterwards [`World::settle`] drops what was.
    pub(crate) fn fetch(&mut self, facts: &dyn Facts) -> Vec<Difference> {
        (0..self.classes.len()).map(|class| self.fetch_class(class, facts)).collect()
    }

    fn fetch_class(&mut self, class: usize, facts: &dyn Facts) -> Difference {
        let objects = &mut self.classes[class];
        let mut difference = Difference::default();
        if objects.added.is_empty() && objects.removed.is_empty() && objects.changed.is_empty() {
            return difference;
        }
        let (added, removed) = (std::mem::take(&mut objects.added), std::mem::take(&mut objects.removed));
        let mut changed: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (id, column) in std::mem::take(&mut objects.changed) {
            if !added.contains(&id) {
                changed.entry(id).or_default().push(column);
            }
        }
        let (next, watched) = (objects.next as usize, objects.watched);
        for &column in &objects.columns {
            self.columns[column].resize(next, Cell::Unknown);
        }
        for &id in &removed {
            let before = watched.then(|| self.copy(class, id));
            self.unindex(class, id);
            difference.removed.push((id, before));
        }
        for (id, mut columns) in changed {
            let Some(row) = self.row(class, id) else { continue };
            columns.retain(|&column| self.now(column, row, facts) != self.cell(column, id));
            if columns.is_empty() {
                continue;
            }
            let before = watched.then(|| self.copy(class, id));
            self.unindex(class, id);
            for &column in &columns {
                self.columns[column][id as usize] = self.now(column, row, facts);
            }
            self.reindex(class, id);
            difference.changed.push((id, columns, before));
        }
        for &id in &added {
            let Some(row) = self.row(class, id) else { continue };
            for at in 0..self.classes[class].columns.len() {
                let column = self.classes[class].columns[at];
                self.columns[column][id as usize] = self.now(column, row, facts);
            }
            self.reindex(class, id);
            difference.added.push(id);
        }
        difference
    }

    fn now(&self, column: usize, row: usize, facts: &dyn Facts) -> Cell {
        facts.column(&self.names[column]).map_or(Cell::Unknown, |column| column.cell(row))
    }

    /// A new object with the values of another.
    fn copy(&mut self, class: usize, id: u32) -> u32 {
        let mut copy = id;
        for &column in &self.classes[class].columns {
            let cell = self.columns[column][id as usize];
            copy = self.columns[column].len() as u32;
            self.columns[column].push(cell);
        }
        copy
    }

    fn unindex(&mut self, class: usize, id: u32) {
        for &index in &self.classes[class].indexes {
            self.indexes[index].remove(id, &self.columns);
        }
    }

    fn reindex(&mut self, class: usize, id: u32) {
        for &index in &self.classes[class].indexes {
            self.indexes[index].insert(id, &self.columns);
        }
    }

    /// Drops what objects were before they changed.
    pub(crate) fn settle(&mut self) {
        for objects in &self.classes {
            for &column in &objects.columns {
                self.columns[column].truncate(objects.next as usize);
            }
        }
    }

    /// The objects are again those of before.
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
