//! Two copies of a graph that take turns: readers hold the one, the writer changes the other.

use std::sync::Arc;

use adit_planners::routes::{DoorIndex, RoomIndex};
use rayon::prelude::*;

use crate::graph::SiteGraph;

use super::weighed::Weighed;

/// A graph that is changed while others read it. Neither waits for the other.
pub struct Twin {
    shown: Arc<SiteGraph>,
    other: Option<Arc<SiteGraph>>,
    /// In what the other copy may differ from the shown one.
    lag: Lag,
}

#[derive(Default)]
struct Lag {
    rooms: Vec<RoomIndex>,
    doors: Vec<DoorIndex>,
}

impl Lag {
    fn note(&mut self, weighed: &Weighed) {
        self.rooms.extend(weighed.rooms.iter().map(|(room, _)| *room));
        self.doors.extend(weighed.doors.iter().map(|(door, _)| *door));
    }
}

impl Twin {
    /// Takes a graph. The second copy is made by the first edit.
    pub fn new(graph: SiteGraph) -> Self {
        Self::of(Arc::new(graph))
    }

    /// As [`new`](Self::new), of a graph that others may read already.
    pub fn of(shown: Arc<SiteGraph>) -> Self {
        Self { shown, other: None, lag: Lag::default() }
    }

    /// One of its own that begins with what is shown.
    pub fn fork(&self) -> Self {
        Self::of(Arc::clone(&self.shown))
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
    pub fn write(&mut self, weighed: &Weighed) {
        let free = self.other.take().and_then(|other| Arc::try_unwrap(other).ok());
        let lag = std::mem::take(&mut self.lag);
        let building = weighed.building.as_ref().unwrap_or(&self.shown.building);
        let (rooms, doors) = (weighed.rooms.par_iter().cloned(), weighed.doors.par_iter().cloned());
        let graph = if let Some(mut graph) = free {
            let late = (lag.rooms.as_slice(), lag.doors.as_slice());
            graph.follow(&self.shown, late, rooms, doors, building);
            graph
        } else {
            let mut graph = SiteGraph::clone(&self.shown);
            graph.write(rooms, doors, building);
            graph
        };
        self.lag.note(weighed);
        self.other = Some(Arc::new(graph));
    }

    /// What was written last, and is not shown yet.
    pub fn written(&self) -> &Arc<SiteGraph> {
        self.other.as_ref().unwrap_or(&self.shown)
    }

    /// Shows what was written.
    pub fn turn(&mut self) {
        if let Some(other) = &mut self.other {
            std::mem::swap(&mut self.shown, other);
        }
    }
}
