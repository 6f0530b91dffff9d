//! Cutting corners (Chen 1994, section 2.6).

use super::Adapt;
use crate::adapt::experience::{VertexId, ends};
use crate::adapt::noted::Noted;

impl Adapt {
    /// Shortens a sequence whose edges hold: from each vertex it goes on to the last one that Reach connects with it. Each
    /// shortcut becomes an edge; those that are not free are not tried again until the cell changes.
    pub(super) fn cut_corners(&mut self, sequence: &[VertexId]) -> Vec<VertexId> {
        let mut cut: Vec<VertexId> = sequence.first().copied().into_iter().collect();
        let mut here = 0;
        while here + 1 < sequence.len() {
            let farther = (here + 2..sequence.len()).rev();
            let next = farther.into_iter().find(|&next| self.shortcut(sequence[here], sequence[next]));
            here = next.unwrap_or(here + 1);
            cut.push(sequence[here]);
        }
        cut
    }

    /// Whether two vertices are connected by an edge that is verified, or may be by a new one.
    fn shortcut(&mut self, from: VertexId, to: VertexId) -> bool {
        if let Some(edge) = self.experience.edge(from, to) {
            return self.is_verified(edge);
        }
        if self.progress.refused.contains(&ends(from, to)) {
            return false;
        }
        let (start, end) = (self.at(from), self.at(to));
        if let Some(path) = self.reach(&start, &end) {
            self.add_edge(from, to, path);
            return true;
        }
        self.progress.refused.insert(ends(from, to));
        self.noted.push(Noted::CutRefused { ends: ends(from, to), revision: self.cell.revision() });
        false
    }
}
