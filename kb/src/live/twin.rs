//! Two copies of a graph that take turns: readers hold the one, the writer changes the other.

use std::sync::Arc;

use crate::graph::SiteGraph;

use super::kept::Written;

/// A graph that is changed while others read it. Neither waits for the other.
pub struct Twin {
    shown: Arc<SiteGraph>,
    other: Option<Arc<SiteGraph>>,
    /// In what the other copy may differ from the shown one.
    lag: Lag,
}

/// Rooms and doors by index.
#[derive(Default)]
struct Lag {
    rooms: Vec<usize>,
    doors: Vec<usize>,
}

impl Lag {
    fn note(&mut self, written: &Written) {
        self.rooms.extend(written.rooms.iter().map(|(row, _)| *row));
        self.doors.extend(written.doors.iter().map(|(row, _)| *row));
    }
}

impl Twin {
    /// Takes a graph. The second copy is made by the first edit.
    pub fn new(graph: SiteGraph) -> Self {
        Self { shown: Arc::new(graph), other: None, lag: Lag::default() }
    }

    /// Keeps ways between any two rooms ready, in both copies.
    pub fn prepare(&mut self) {
        let mut graph = SiteGraph::clone(&self.shown);
        graph.prepare();
        *self = Self::new(graph);
    }

    /// The graph as it was committed last.
    pub fn shown(&self) -> &Arc<SiteGraph> {
        &self.shown
    }

    /// The graph as it is after an edit that is not committed yet. It is seen by [`turn`](Self::turn) only.
    ///
    /// Costs what this edit and the one before changed; a copy of all where someone still reads what was shown before.
    pub fn write(&mut self, written: &Written) -> &SiteGraph {
        let free = self.other.take().and_then(|other| Arc::try_unwrap(other).ok());
        let lag = std::mem::take(&mut self.lag);
        let graph = if let Some(mut graph) = free {
            graph.follow(&self.shown, (&lag.rooms, &lag.doors), &written.rooms, &written.doors);
            graph
        } else {
            let mut graph = SiteGraph::clone(&self.shown);
            graph.write(&written.rooms, &written.doors);
            graph
        };
        self.lag.note(written);
        self.other.insert(Arc::new(graph))
    }

    /// Shows what was written.
    pub fn turn(&mut self) {
        if let Some(other) = &mut self.other {
            std::mem::swap(&mut self.shown, other);
        }
    }
}
