//! Rooms, doors and kept routes before a step.

use adit_db::door::Door;
use adit_db::place::Place;
use adit_db::tree::Start;

use crate::graph::{SiteGraph, place_node};

/// Rooms, doors and kept routes as they were.
#[derive(Clone, Copy)]
pub struct Before<'a> {
    pub graph: &'a SiteGraph,
    /// The starts that routes were kept from.
    pub starts: &'a [Start],
    /// The places that there were; the graph of a build has those of now.
    pub places: &'a [Place],
}

impl Before<'_> {
    /// The node of a place in the trees that were kept.
    pub fn node_of(&self, place: &str) -> Option<i64> {
        self.places.iter().position(|of| of.place == place).map(place_node)
    }

    pub fn door(&self, key: i64) -> Option<&Door> {
        self.graph.door(key).map(|door| &self.graph[door])
    }

    /// Whether routes were kept from these starts, in whatever order, each as the same tree.
    pub fn same_starts(&self, starts: &[Start]) -> bool {
        let sorted = |starts: &[Start]| {
            let mut starts = starts.to_vec();
            starts.sort_unstable_by(|a, b| (&a.name, &a.robot, a.tree).cmp(&(&b.name, &b.robot, b.tree)));
            starts
        };
        sorted(self.starts) == sorted(starts)
    }
}
