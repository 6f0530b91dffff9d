//! Tightening a path between its corners (Chen 1994, section 2.6: the quality of a solution can be improved locally).

use super::Adapt;
use crate::adapt::experience::{VertexId, ends};
use crate::adapt::judge::Judge;
use crate::adapt::noted::Noted;
use crate::adapt::probe::Probe;
use crate::adapt::robot::{Configuration, between, distance, length};

/// A path that was made shorter by less than this share is left as it was.
const WORTHWHILE: f64 = 0.01;

impl Adapt {
    /// Shortens the path along a sequence of vertices by free straight motions between any two places on it. A path that
    /// became shorter is added to the graph, as a chain between the same two vertices. Each pair of vertices is tightened
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
        let Some(chain) = tight.windows(2).map(|p| self.reach(&p[0], &p[1])).collect() else {
            return sequence.to_vec();
        };
        let first = self.experience.next_numbers().0;
        self.augment(from, chain, Some(to), judge);
        let added = (first..self.experience.next_numbers().0).map(VertexId);
        std::iter::once(from).chain(added).chain([to]).collect()
    }

    fn tightened_path(&mut self, mut path: Vec<Configuration>) -> Vec<Configuration> {
        const ROUNDS: u32 = 3;
        const FINEST: f64 = 0.25;
        for _ in 0..ROUNDS {
            let before = length(&path);
            let mut window = before / 2.0;
            while window > FINEST {
                self.slide(&mut path, window);
                window /= 2.0;
            }
            if length(&path) > (1.0 - WORTHWHILE) * before {
                break;
            }
        }
        path
    }

    /// Moves a window along a path, and goes straight through it wherever that is shorter and free.
    fn slide(&mut self, path: &mut Vec<Configuration>, window: f64) {
        let mut start = 0.0;
        while start < length(path) {
            let (first, a) = place(path, start);
            let (last, b) = place(path, start + window);
            let inner = [&[a.clone()][..], &path[first + 1..=last], &[b.clone()][..]].concat();
            let is_shorter = distance(&a, &b) < (1.0 - WORTHWHILE / 10.0) * length(&inner);
            if is_shorter && Probe::new(&mut self.cell).is_motion_free(&a, &b) {
                path.splice(first + 1..=last, [a, b]);
                path.dedup();
            }
            start += window / 2.0;
        }
    }
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
