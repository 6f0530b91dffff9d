//! Where ways that weigh metres may turn: about ends of doors, and where a change of shape may pay. Nobody asks where all
//! hardness lies on the doors, so it is found when first asked for, and follows the weights from then on.

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use std::num::NonZero;
use std::panic::resume_unwind;
use std::sync::{Arc, OnceLock};
use std::{array, thread};

use super::cone::Segment;
use super::mesh::{Mesh, NONE};
use super::parts::{DoorIndex, Passing, RoomIndex, RouteDoor, RouteRoom};
use crate::geometry::Rect;

/// Where a change may pay.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate {
    pub segment: Segment,
    /// Whether the harder state has room beyond it for more than half a metre.
    pub is_deep: bool,
    /// Whether it is the rim of both states, so that the change can only be one of several at one point.
    pub is_step: bool,
}

#[derive(Clone, Debug)]
pub(super) struct Turning {
    pub mesh: Arc<Mesh>,
    /// For each end of a door whether a way may bend there.
    bends: Vec<bool>,
    /// The ends about which one does not come from each room into each other one at no cost, with these rooms, by [`Mesh::parts`].
    parts: HashMap<u32, Vec<(RoomIndex, RoomIndex)>>,
    /// For each door what passing it changes.
    passing: Vec<Passing>,
    /// Door by door, in blocks. What clones find, all have, as long as nothing that a gate hangs on is otherwise in one of them.
    gates: Arc<Vec<Arc<Block>>>,
    /// From which layer into which one several changes cost less than one, somewhere, and what they cost at least; found when
    /// first asked for.
    pub sequences: OnceLock<BTreeMap<(u32, u32), f64>>,
}

/// Where it may pay to begin a change, in each direction, and whichever of its rooms is easier; found when first asked for.
type Gates = [[OnceLock<Box<[Gate]>>; 3]; 2];

/// The gates of some doors one after the other; most doors are never asked about.
type Block = [OnceLock<Arc<Gates>>; BLOCK];

const BLOCK: usize = 64;

/// So many ends are looked at on one thread.
const ENDS: usize = 20_000;

/// Farther away from the rooms of a change than this nothing touches where it may pay, metres.
const REACH_M: f64 = 1.0;

/// If more doors than these come to be passed otherwise, all gates are found anew.
const MANY: usize = 64;

impl Turning {
    pub fn new(rooms: &[RouteRoom], doors: &[RouteDoor], passing: Vec<Passing>, mesh: Arc<Mesh>) -> Self {
        let gates = Arc::new(blocks(doors.len(), |_| OnceLock::new()));
        let mut all = Self {
            bends: vec![false; mesh.ends_count()],
            parts: HashMap::new(),
            mesh,
            passing,
            gates,
            sequences: OnceLock::new(),
        };
        all.find_bends(rooms, doors, &(0..doors.len()).map(DoorIndex::new).collect::<Vec<_>>());
        all
    }

    /// Whether a way may bend at an end of a door.
    pub fn bends_at(&self, end: u32) -> bool {
        end != NONE && self.bends[end as usize]
    }

    /// Of an end about which one does not come from each room into each other one, the rooms that belong with a room.
    pub fn part_of(&self, end: u32, room: RoomIndex) -> Option<RoomIndex> {
        let parts = self.parts.get(&end)?;
        parts.iter().find(|(known, _)| *known == room).map(|(_, part)| *part)
    }

    /// The gates of a change in one of its directions.
    ///
    /// # Arguments
    /// `order` is that of what its rooms weigh.
    pub fn gates(
        &self,
        door: DoorIndex,
        (side, order): (usize, Ordering),
        find: impl FnOnce() -> Box<[Gate]>,
    ) -> &[Gate] {
        let gates = self.known_gates(door).get_or_init(Arc::default);
        gates[side][(order as i8 + 1) as usize].get_or_init(find)
    }

    fn known_gates(&self, door: DoorIndex) -> &OnceLock<Arc<Gates>> {
        &self.gates[door.index() / BLOCK][door.index() % BLOCK]
    }

    /// Has the gates that are known of another graph's doors for these ones.
    ///
    /// # Arguments
    /// `doors` gives each door the other graph's that is the same change between the same rooms.
    pub fn know_gates(&mut self, of: &Self, doors: impl Iterator<Item = Option<DoorIndex>>) {
        let known = |door: DoorIndex| of.known_gates(door).get().map(|gates| Arc::new(Gates::clone(gates)));
        let mut doors = doors.map(|door| door.and_then(known).map_or_else(OnceLock::new, OnceLock::from));
        self.gates = Arc::new(blocks(self.passing.len(), |_| doors.next().unwrap_or_default()));
    }

    /// Forgets the gates of changes between rooms that these doors come near to.
    pub fn forget_near(&mut self, (rooms, doors): (&[RouteRoom], &[RouteDoor]), which: &[DoorIndex]) {
        if which.is_empty() {
            return;
        }
        let about: Vec<Rect> =
            which.iter().map(|door| doors[door.index()].crossing.bounds().grown(REACH_M)).collect();
        if about.len() > MANY {
            self.gates = Arc::new(blocks(doors.len(), |_| OnceLock::new()));
            return;
        }
        let is_near = |door: &RouteDoor| {
            let rooms = [door.room1, door.room2].map(|room| rooms[room.index()].outline.bounds());
            about.iter().any(|about| rooms.iter().any(|room| about.overlaps(room)))
        };
        let blocks = Arc::make_mut(&mut self.gates);
        for (door, _) in doors.iter().enumerate().filter(|(_, door)| door.is_change() && is_near(door)) {
            // one that is not known yet, too: another copy may find it, as it is there
            Arc::make_mut(&mut blocks[door / BLOCK])[door % BLOCK] = OnceLock::new();
        }
    }

    /// Takes what passing these doors changes now; those for which it is otherwise.
    pub fn pass(
        &mut self,
        (rooms, doors): (&[RouteRoom], &[RouteDoor]),
        passing: &[(DoorIndex, Passing)],
    ) -> Vec<DoorIndex> {
        let changed: Vec<DoorIndex> = passing
            .iter()
            .filter(|(door, now)| self.passing[door.index()] != *now)
            .map(|(door, _)| *door)
            .collect();
        for (door, now) in passing {
            self.passing[door.index()] = *now;
        }
        self.find_bends(rooms, doors, &changed);
        changed
    }

    /// Finds about which ends of these doors a way may bend.
    fn find_bends(&mut self, rooms: &[RouteRoom], doors: &[RouteDoor], which: &[DoorIndex]) {
        let ends = which.iter().flat_map(|&door| self.mesh.ends(door)).filter(|&end| end != NONE);
        let mut ends: Vec<u32> = ends.collect();
        ends.sort_unstable();
        ends.dedup();
        let passing = |door: DoorIndex| self.passing[door.index()];
        let find = |&end: &u32| {
            let bends = self.mesh.bends(rooms, doors, end, passing);
            (end, bends, self.mesh.parts(doors, end, passing))
        };
        for (end, bends, parts) in side_by_side(&ends, find) {
            self.bends[end as usize] = bends;
            if parts.is_empty() {
                self.parts.remove(&end);
            } else {
                self.parts.insert(end, parts);
            }
        }
    }
}

/// What is known of the gates of so many doors, door by door.
fn blocks(doors: usize, mut of: impl FnMut(usize) -> OnceLock<Arc<Gates>>) -> Vec<Arc<Block>> {
    let mut block = |first: usize| {
        Arc::new(array::from_fn(|place| {
            let door = first * BLOCK + place;
            if door < doors { of(door) } else { OnceLock::new() }
        }))
    };
    (0..doors.div_ceil(BLOCK)).map(&mut block).collect()
}

/// What comes of each of many, on as many threads as there are cores. Threads of a pool that wait for one graph's turning might have
/// begun to find it.
fn side_by_side<T: Sync, R: Send>(all: &[T], find: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(all.len() / ENDS).max(1);
    if threads == 1 {
        return all.iter().map(find).collect();
    }
    let find = &find;
    thread::scope(|scope| {
        let parts = all.chunks(all.len().div_ceil(threads));
        let parts = parts.map(|part| scope.spawn(move || part.iter().map(find).collect::<Vec<R>>()));
        let parts: Vec<_> = parts.collect();
        let joined = parts.into_iter().map(|part| part.join().unwrap_or_else(|panic| resume_unwind(panic)));
        joined.flatten().collect()
    })
}
