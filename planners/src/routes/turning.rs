//! Where ways that weigh metres may turn: about ends of doors, and where a change of shape may pay. Nobody asks where all
//! hardness lies on the doors, so it is found when first asked for, and follows the weights from then on.

use std::sync::{Arc, OnceLock};

use super::cone::Segment;
use super::mesh::{Mesh, NONE};
use super::parts::{DoorIndex, Passing, RouteDoor, RouteRoom};

/// Where a change may pay.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate {
    pub segment: Segment,
    /// Whether the harder state has room beyond it for more than half a metre.
    pub is_deep: bool,
}

#[derive(Clone, Debug)]
pub(super) struct Turning {
    pub mesh: Mesh,
    /// For each end of a door whether a way may bend there.
    pub bends: Vec<bool>,
    /// For each door what passing it changes.
    passing: Vec<Passing>,
    /// What clones find, all have, as long as nothing that gates hang on is otherwise in one of them.
    pub gates: Arc<Gates>,
}

/// For each change, and both of its directions, where it may pay to begin it; found when first asked for.
pub(super) type Gates = Vec<[OnceLock<Box<[Gate]>>; 2]>;

pub(super) fn unknown_gates(doors: usize) -> Arc<Gates> {
    Arc::new(vec![[OnceLock::new(), OnceLock::new()]; doors])
}

impl Turning {
    pub fn new(rooms: &[RouteRoom], doors: &[RouteDoor], passing: Vec<Passing>) -> Self {
        let mesh = Mesh::new(rooms.len(), doors);
        let gates = unknown_gates(doors.len());
        let mut all = Self { bends: vec![false; mesh.ends_count()], mesh, passing, gates };
        all.find_bends(rooms, doors, &(0..doors.len()).map(DoorIndex::new).collect::<Vec<_>>());
        all
    }

    /// Takes what passing these doors changes now; whether it is otherwise for any of them.
    pub fn pass(
        &mut self,
        (rooms, doors): (&[RouteRoom], &[RouteDoor]),
        passing: &[(DoorIndex, Passing)],
    ) -> bool {
        let changed: Vec<DoorIndex> = passing
            .iter()
            .filter(|(door, now)| self.passing[door.index()] != *now)
            .map(|(door, _)| *door)
            .collect();
        for (door, now) in passing {
            self.passing[door.index()] = *now;
        }
        self.find_bends(rooms, doors, &changed);
        !changed.is_empty()
    }

    /// Finds about which ends of these doors a way may bend.
    fn find_bends(&mut self, rooms: &[RouteRoom], doors: &[RouteDoor], which: &[DoorIndex]) {
        let ends = which.iter().flat_map(|&door| self.mesh.ends(door)).filter(|&end| end != NONE);
        let mut ends: Vec<u32> = ends.collect();
        ends.sort_unstable();
        ends.dedup();
        for end in ends {
            self.bends[end as usize] = self.mesh.bends(rooms, doors, end, |door| self.passing[door.index()]);
        }
    }
}
