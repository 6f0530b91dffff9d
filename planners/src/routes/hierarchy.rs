//! Ways of least hardness between any two rooms, where all hardness lies on the doors: a customizable contraction
//! hierarchy (Dibbelt, Strasser, Wagner 2016).
//!
//! Rooms are ranked once; then weights of doors may change as they like. A weight is a number as rules give it, doors may
//! lead one way, and what no state passes weighs infinity.

mod customize;
mod metric;
mod order;
mod partial;
mod query;
mod topology;

use std::sync::Arc;

use metric::Metric;
pub(super) use query::Passed;
use topology::Topology;

use super::parts::{DoorIndex, RouteDoor, RouteRoom};

/// Rooms and doors, ready for ways between any two rooms.
#[derive(Clone, Debug)]
pub(super) struct Hierarchy {
    /// What clones share.
    topology: Arc<Topology>,
    metric: Metric,
}

impl Hierarchy {
    /// Ranks the rooms, and weighs all doors.
    ///
    /// # Arguments
    /// `passing` is what passing each door weighs, from its first room and from its second; infinite where it is not passed.
    /// Where several doors lead from one room to another, the one of lower key counts.
    pub fn new(rooms: &[RouteRoom], doors: &[RouteDoor], passing: Vec<[f64; 2]>) -> Self {
        let at = rooms.iter().map(|room| room.outline.centre()).collect();
        let topology = Arc::new(Topology::new(at, doors));
        let metric = Metric::new(&topology, passing);
        Self { topology, metric }
    }

    pub fn reweigh(&mut self, doors: impl Iterator<Item = (DoorIndex, [f64; 2])>) {
        let is_other = |(door, passing): &(DoorIndex, [f64; 2])| {
            self.metric.passing[door.index()].map(f64::to_bits) != passing.map(f64::to_bits)
        };
        let doors: Vec<_> =
            doors.filter(is_other).map(|(door, passing)| (door.index() as u32, passing)).collect();
        if !self.metric.reweigh(&self.topology, &doors) {
            self.metric.customize(&self.topology);
        }
    }
}
