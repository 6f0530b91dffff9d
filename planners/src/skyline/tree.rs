//! The least rank put on each column, with the least of any run of columns found quickly: a segment tree over
//! buckets of columns.

/// More than any rank: nothing was put there.
const NONE: u32 = u32::MAX;

/// Columns in a bucket: one line of the cache.
const BUCKET: usize = 16;

#[derive(Clone, Copy)]
struct Node {
    /// Least rank put on all columns of the node at once.
    whole: u32,
    /// Least rank put on any column of the node, as far as the node, its descendants and its columns know.
    any: u32,
}

const EMPTY: Node = Node { whole: NONE, any: NONE };

/// Ranks over columns. Putting only ever lowers, so marks need not be pushed down.
#[derive(Default)]
pub(super) struct LowestTree {
    /// Least rank put on each column by itself.
    columns: Vec<u32>,
    /// The root is node 1, the children of node `i` are `2i` and `2i + 1`, the buckets are the upper half.
    nodes: Vec<Node>,
}

impl LowestTree {
    pub(super) fn reset(&mut self, columns: u32) {
        let buckets = (columns as usize).div_ceil(BUCKET).max(1).next_power_of_two();
        self.columns.clear();
        self.columns.resize(buckets * BUCKET, NONE);
        self.nodes.clear();
        self.nodes.resize(2 * buckets, EMPTY);
    }

    /// The node of the bucket that holds the column.
    fn bucket(&self, column: usize) -> usize {
        self.nodes.len() / 2 + column / BUCKET
    }

    fn first_column(&self, bucket: usize) -> usize {
        (bucket - self.nodes.len() / 2) * BUCKET
    }

    /// Puts `rank` on the columns `from..to`, which must not be empty.
    pub(super) fn lower(&mut self, from: u32, to: u32, rank: u32) {
        let (from, to) = (from as usize, to as usize);
        let (first, last) = (self.bucket(from), self.bucket(to - 1));
        if first == last {
            self.lower_columns(from, to, rank);
        } else {
            self.lower_columns(from, self.first_column(first + 1), rank);
            self.lower_columns(self.first_column(last), to, rank);
        }
        let (mut left, mut right) = (first + 1, last);
        while left < right {
            if left & 1 == 1 {
                self.nodes[left].whole = rank.min(self.nodes[left].whole);
                self.nodes[left].any = rank.min(self.nodes[left].any);
                left += 1;
            }
            if right & 1 == 1 {
                right -= 1;
                self.nodes[right].whole = rank.min(self.nodes[right].whole);
                self.nodes[right].any = rank.min(self.nodes[right].any);
            }
            left /= 2;
            right /= 2;
        }
        self.tell_upwards(first, rank);
        self.tell_upwards(last, rank);
    }

    fn lower_columns(&mut self, from: usize, to: usize, rank: u32) {
        for known in &mut self.columns[from..to] {
            *known = rank.min(*known);
        }
    }

    fn tell_upwards(&mut self, mut node: usize, rank: u32) {
        while node > 0 {
            let known = &mut self.nodes[node].any;
            *known = rank.min(*known);
            node /= 2;
        }
    }

    pub(super) fn at(&self, column: u32) -> u32 {
        let column = column as usize;
        self.columns[column].min(self.upwards(self.bucket(column)))
    }

    /// Least rank put on `node` or an ancestor as a whole.
    fn upwards(&self, mut node: usize) -> u32 {
        let mut rank = NONE;
        while node > 0 {
            rank = rank.min(self.nodes[node].whole);
            node /= 2;
        }
        rank
    }

    /// Least rank on any of the columns `from..to`, which must not be empty.
    pub(super) fn lowest(&self, from: u32, to: u32) -> u32 {
        let (from, to) = (from as usize, to as usize);
        let (mut first, mut last) = (self.bucket(from), self.bucket(to - 1));
        if first == last {
            return self.lowest_column(from, to).min(self.upwards(first));
        }
        let mut rank = self.lowest_column(from, self.first_column(first + 1));
        rank = rank.min(self.lowest_column(self.first_column(last), to));
        // What was put on an ancestor of the first or the last bucket as a whole lies on a column asked for;
        // what lies between the two hangs from their ancestors, to the right of one and to the left of the other.
        while first + 1 < last {
            let right_of_first = self.nodes[first ^ 1].any;
            rank = rank.min(if first & 1 == 0 { right_of_first } else { NONE });
            let left_of_last = self.nodes[last ^ 1].any;
            rank = rank.min(if last & 1 == 1 { left_of_last } else { NONE });
            rank = rank.min(self.nodes[first].whole).min(self.nodes[last].whole);
            first /= 2;
            last /= 2;
        }
        // Neighbours now: cousins meet higher up, siblings at once.
        while first != last {
            rank = rank.min(self.nodes[first].whole).min(self.nodes[last].whole);
            first /= 2;
            last /= 2;
        }
        rank.min(self.upwards(first))
    }

    fn lowest_column(&self, from: usize, to: usize) -> u32 {
        self.columns[from..to].iter().copied().fold(NONE, u32::min)
    }

    /// The first column after `column` that has a rank below `limit`. `column` itself must have none.
    pub(super) fn first_after(&self, column: u32, limit: u32) -> Option<u32> {
        let column = column as usize;
        let mut node = self.bucket(column);
        let end = self.first_column(node + 1);
        if let Some(covered) = (column + 1..end).find(|&other| self.columns[other] < limit) {
            return Some(covered as u32);
        }
        while node > 1 {
            if node & 1 == 0 && self.nodes[node + 1].any < limit {
                let (bucket, whole) = self.outermost(node + 1, limit, 0);
                let start = self.first_column(bucket);
                let is_covered = |&other: &usize| whole || self.columns[other] < limit;
                return (start..start + BUCKET).find(is_covered).map(|covered| covered as u32);
            }
            node /= 2;
        }
        None
    }

    /// The last column before `column` that has a rank below `limit`. `column` itself must have none.
    pub(super) fn last_before(&self, column: u32, limit: u32) -> Option<u32> {
        let column = column as usize;
        let mut node = self.bucket(column);
        let start = self.first_column(node);
        if let Some(covered) = (start..column).rev().find(|&other| self.columns[other] < limit) {
            return Some(covered as u32);
        }
        while node > 1 {
            if node & 1 == 1 && self.nodes[node - 1].any < limit {
                let (bucket, whole) = self.outermost(node - 1, limit, 1);
                let start = self.first_column(bucket);
                let is_covered = |&other: &usize| whole || self.columns[other] < limit;
                return (start..start + BUCKET).rev().find(is_covered).map(|covered| covered as u32);
            }
            node /= 2;
        }
        None
    }

    /// The leftmost (`side` 0) or rightmost (`side` 1) bucket below `node` with a column that has a rank below `limit`,
    /// and whether all its columns have.
    fn outermost(&self, mut node: usize, limit: u32, side: usize) -> (usize, bool) {
        let buckets = self.nodes.len() / 2;
        let mut whole = self.nodes[node].whole < limit;
        while node < buckets {
            let near = 2 * node + side;
            node = if whole || self.nodes[near].any < limit { near } else { near ^ 1 };
            whole |= self.nodes[node].whole < limit;
        }
        (node, whole)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const COLUMNS: u32 = 200;

    fn runs() -> impl Strategy<Value = Vec<(u32, u32, u32)>> {
        let run = (0..COLUMNS, 1..COLUMNS, 0_u32..50);
        let run = run.prop_map(|(from, length, rank)| (from, (from + length).min(COLUMNS), rank));
        prop::collection::vec(run, 0..20)
    }

    proptest! {
        #[test]
        fn it_answers_as_a_plain_array_does(puts in runs(), asked in runs()) {
            let mut tree = LowestTree::default();
            tree.reset(COLUMNS);
            let mut plain = [NONE; COLUMNS as usize];
            for (from, to, rank) in puts {
                tree.lower(from, to, rank);
                for known in &mut plain[from as usize..to as usize] {
                    *known = rank.min(*known);
                }
            }
            for (from, to, limit) in asked {
                let column = from as usize;
                prop_assert_eq!(tree.at(from), plain[column]);
                let lowest = plain[column..to as usize].iter().copied().fold(NONE, u32::min);
                prop_assert_eq!(tree.lowest(from, to), lowest);
                if plain[column] >= limit {
                    let after = (from + 1..COLUMNS).find(|&other| plain[other as usize] < limit);
                    prop_assert_eq!(tree.first_after(from, limit), after);
                    let before = (0..from).rev().find(|&other| plain[other as usize] < limit);
                    prop_assert_eq!(tree.last_before(from, limit), before);
                }
            }
        }
    }
}
