//! Rows by the values of some columns, kept up to date row by row.

use std::collections::HashMap;

use crate::value::Cell;

/// The objects of a class by what some columns hold. Groups are sorted; they are only looked up, never walked.
///
/// Values are told apart by a hash alone: whoever looks up has to compare.
#[derive(Debug)]
pub(crate) struct Index {
    /// The columns by their numbers in the world.
    pub(crate) columns: Vec<usize>,
    groups: HashMap<u64, Vec<u32>>,
    /// Objects of which a column is unknown.
    unknown: Vec<u32>,
}

impl Index {
    pub(crate) fn new(columns: Vec<usize>) -> Self {
        Self { columns, groups: HashMap::new(), unknown: vec![] }
    }

    /// Takes in an object of a world with these columns.
    pub(crate) fn insert(&mut self, id: u32, columns: &[Vec<Cell>]) {
        let group = match key(self.columns.iter().map(|&column| columns[column][id as usize])) {
            Some(key) => self.groups.entry(key).or_default(),
            None => &mut self.unknown,
        };
        if let Err(at) = group.binary_search(&id) {
            group.insert(at, id);
        }
    }

    /// Takes out an object, whose values are those that it was inserted with.
    pub(crate) fn remove(&mut self, id: u32, columns: &[Vec<Cell>]) {
        let key = key(self.columns.iter().map(|&column| columns[column][id as usize]));
        let group = match key {
            Some(key) => self.groups.get_mut(&key),
            None => Some(&mut self.unknown),
        };
        let Some(group) = group else { return };
        if let Ok(at) = group.binary_search(&id) {
            group.remove(at);
        }
        if let (true, Some(key)) = (group.is_empty(), key) {
            self.groups.remove(&key);
        }
    }

    /// The objects with these values, and perhaps some others; `None` if a value is unknown.
    pub(crate) fn find(&self, cells: impl Iterator<Item = Cell>) -> Option<&[u32]> {
        Some(self.groups.get(&key(cells)?).map_or(&[], Vec::as_slice))
    }

    /// The objects of which a column is unknown.
    pub(crate) fn unknown(&self) -> &[u32] {
        &self.unknown
    }
}

/// FNV-1a over the values; `None` if one is unknown.
fn key(cells: impl Iterator<Item = Cell>) -> Option<u64> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for cell in cells {
        let bits = match cell {
            Cell::Unknown => return None,
            // Minus zero equals zero.
            Cell::Number(number) => (number + 0.0).to_bits(),
            Cell::Text(symbol) => u64::from(symbol.id()),
            Cell::Truth(truth) => u64::from(truth),
        };
        hash = (hash ^ bits).wrapping_mul(0x0000_0100_0000_01b3);
        hash ^= hash >> 32;
    }
    Some(hash)
}
