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
        const FINEST: f64 = 0.4;
        /// What a round gained by less than this share leaves little to the next one.
        const AGAIN: f64 = 0.05;
        for _ in 0..ROUNDS {
            let before = length(&path);
            let mut window = WIDEST * before;
            while window > FINEST {
                self.slide(&mut path, window, LEAST * before);
                window /= NARROWER;
            }
            if length(&path) > (1.0 - AGAIN) * before {
                break;
            }
        }
        path
    }

    /// Moves a window along a path, and goes straight through it wherever that is free and shorter by more than `least`.
    fn slide(&mut self, path: &mut Vec<Configuration>, window: f64, least: f64) {
        let mut corners = lengths(path);
        let mut start = 0.0;
        while start < corners[corners.len() - 1] {
            let end = (start + window).min(corners[corners.len() - 1]);
            let (first, last) = (leg(&corners, start), leg(&corners, end));
            // On one leg there is nothing to gain.
            if first < last {
                let (a, b) = (on(path, &corners, (first, start)), on(path, &corners, (last, end)));
                if end - start - distance(&a, &b) > least && Probe::new(&mut self.cell).is_motion_free(&a, &b)
                {
                    path.splice(first + 1..=last, [a, b]);
                    path.dedup();
                    corners = lengths(path);
                }
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

/// How far along a path each of its corners is.
fn lengths(path: &[Configuration]) -> Vec<f64> {
    let legs = path.windows(2).map(|ends| distance(&ends[0], &ends[1]));
    let sums = legs.scan(0.0, |sum, leg| {
        *sum += leg;
        Some(*sum)
    });
    std::iter::once(0.0).chain(sums).collect()
}

/// The leg of a path on which a place lies, by how far along it is.
fn leg(corners: &[f64], at: f64) -> usize {
    let before = corners.partition_point(|corner| *corner <= at);
    before.saturating_sub(1).min(corners.len().saturating_sub(2))
}

/// The place on a leg that is so far along its path.
fn on(path: &[Configuration], corners: &[f64], (leg, at): (usize, f64)) -> Configuration {
    let long = corners[leg + 1] - corners[leg];
    between(&path[leg], &path[leg + 1], ((at - corners[leg]) / long).min(1.0))
}
