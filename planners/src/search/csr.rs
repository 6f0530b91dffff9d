//! Lists by index, one behind the other in one array (compressed sparse rows).

use std::ops::Range;

/// For each index from 0 up a list, in the order in which its items were given.
#[derive(Clone, Debug)]
pub struct Csr<T> {
    /// Where each list begins, and where the last one ends.
    begins: Vec<u32>,
    items: Vec<T>,
}

impl<T> Default for Csr<T> {
    fn default() -> Self {
        Self { begins: vec![0], items: Vec::new() }
    }
}

impl<T: Copy> Csr<T> {
    /// `count` lists of items that are given with the index of their list. O(count + items).
    pub fn new(count: usize, items: impl IntoIterator<Item = (usize, T)>) -> Self {
        let given: Vec<(usize, T)> = items.into_iter().collect();
        let mut begins = vec![0_u32; count + 1];
        for (list, _) in &given {
            begins[list + 1] += 1;
        }
        for list in 0..count {
            begins[list + 1] += begins[list];
        }
        let mut next = begins.clone();
        let mut items: Vec<T> = given.iter().map(|(_, item)| *item).collect();
        for (list, item) in given {
            items[next[list] as usize] = item;
            next[list] += 1;
        }
        Self { begins, items }
    }
}

impl<T> Csr<T> {
    pub fn push(&mut self, list: impl IntoIterator<Item = T>) {
        self.items.extend(list);
        self.begins.push(self.items.len() as u32);
    }

    pub fn len(&self) -> usize {
        self.begins.len() - 1
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn of(&self, list: usize) -> &[T] {
        &self.items[self.range(list)]
    }

    pub fn of_mut(&mut self, list: usize) -> &mut [T] {
        let range = self.range(list);
        &mut self.items[range]
    }

    /// Where in [all items](Self::items) a list lies.
    pub fn range(&self, list: usize) -> Range<usize> {
        self.begins[list] as usize..self.begins[list + 1] as usize
    }

    /// The items of all lists, one list behind the other.
    pub fn items(&self) -> &[T] {
        &self.items
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_keep_their_order_within_a_list() {
        let lists = Csr::new(3, [(2, 'a'), (0, 'b'), (2, 'c'), (0, 'd')]);
        assert_eq!([lists.of(0), lists.of(1), lists.of(2)], [&['b', 'd'][..], &[], &['a', 'c']]);
        assert_eq!((lists.range(2), lists.len()), (2..4, 3));
    }
}
