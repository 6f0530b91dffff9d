//! Tightening a path between its corners (Chen 1994, section 2.6: the quality of a solution can be improved locally).

use super::Adapt;
use crate::adapt::experience::{VertexId, ends};
use crate::adapt::judge::Judge;
use crate::adapt::noted::Noted;
use crate::adapt::probe::Probe;
use crate::adapt::robot::{Configuration, between, distance, length};

/// A path that was made shorter by less than this share is left as it was.
const WORTHWHILE: f64 = 0.01;

/// A shortcut is looked at where it gains more than this share of the path.
const LEAST: f64 = 0.007;

/// The first window, as a share of the path, and by what each next one is shorter.
const WIDEST: f64 = 0.85;
const NARROWER: f64 = 1.6;

/// A path that became shorter is kept in pieces about as long, by the distance of configurations: where they meet there are subgoals.
const PIECE: f64 = 1.0;

impl Adapt {
    /// Shortens the path along a sequence of vertices by free straight motions between any two places on it. A path that
    /// became shorter is added to the graph, in pieces between the same two vertices. Each pair of vertices is tightened
    /// once in each state of the cell. Gives the sequence of the shorter path.
    pub(super) fn tighten(&mut self, sequence: &[VertexId], judge: &mut dyn Judge) -> Vec<VertexId> {
        let (from, to) = (sequence[0], sequence[sequence.len() - 1]);
        let pair = ends(from, to);
        if sequence.len() < 3 || !self.progress.tightened.insert(pair) {
            return sequence.to_vec();
        }
        self.noted.push(Noted::Tightened { ends: pair, revision: self.cell.revision() });
        let mut path: Vec<Configuration> =
            sequence.windows(2).flat_map(|p| self.experience.path(p[0], p[1]).unwrap_or_default()).collect();
        path.dedup();
        let tight = self.tightened_path(path.clone());
        if length(&tight) > (1.0 - WORTHWHILE) * length(&path) {
            return sequence.to_vec();
        }
        let first = self.experience.next_numbers().0;
        self.augment(from, pieces(&tight), Some(to), judge);
        let added = (first..self.experience.next_numbers().0).map(VertexId);
        std::iter::once(from).chain(added).chain([to]).collect()
    }

    fn tightened_path(&mut self, mut path: Vec<Configuration>) -> Vec<Configuration> {
        const ROUNDS: u32 = 2;
        const FINEST: f64 = 0.25;
        for _ in 0..ROUNDS {
            let before = length(&path);
            let mut window = WIDEST * before;
            while window > FINEST {
                self.slide(&mut path, window, LEAST * before);
                window /= NARROWER;
            }
            if length(&path) > (1.0 - WORTHWHILE) * before {
                break;
            }
        }
        path
    }

    /// Moves a window along a path, and goes straight through it wherever that is free and shorter by more than `least`.
    fn slide(&mut self, path: &mut Vec<Configuration>, window: f64, least: f64) {
        let (mut start, mut end) = (0.0, length(path));
        while start < end {
            let (first, a) = place(path, start);
            let (last, b) = place(path, start + window);
            let inner = &path[first + 1..=last];
            let around = match inner {
                [] => distance(&a, &b),
                [one] => distance(&a, one) + distance(one, &b),
                [one, .., other] => distance(&a, one) + length(inner) + distance(other, &b),
            };
            if around - distance(&a, &b) > least && Probe::new(&mut self.cell).is_motion_free(&a, &b) {
                path.splice(first + 1..=last, [a, b]);
                path.dedup();
                end = length(path);
            }
            start += window / 2.0;
        }
    }
}

/// A path in pieces that meet at its corners, none of them short.
fn pieces(path: &[Configuration]) -> Vec<Vec<Configuration>> {
    let mut pieces = vec![vec![path[0].clone()]];
    let mut left = length(path);
    let mut long = 0.0;
    for ends in path.windows(2) {
        let last = pieces.len() - 1;
        pieces[last].push(ends[1].clone());
        let leg = distance(&ends[0], &ends[1]);
        (long, left) = (long + leg, left - leg);
        if long >= PIECE && left >= PIECE / 2.0 {
            pieces.push(vec![ends[1].clone()]);
            long = 0.0;
        }
    }
    pieces
}

/// The place on a path at a length from its beginning, and the last corner before it.
fn place(path: &[Configuration], mut at: f64) -> (usize, Configuration) {
    for (corner, ends) in path.windows(2).enumerate() {
        let long = distance(&ends[0], &ends[1]);
        if at < long {
            return (corner, between(&ends[0], &ends[1], at / long));
        }
        at -= long;
    }
    (path.len().saturating_sub(2), path.last().cloned().unwrap_or_default())
}
