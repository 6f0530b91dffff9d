//! Rooms and doors as a mesh of convex cells: which doors lead out of a room, and about which of their ends a taut
//! way may bend.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use fixedbitset::FixedBitSet;
use petgraph::unionfind::UnionFind;
use smallvec::SmallVec;

use super::parts::{DoorIndex, Passing, RoomIndex, RouteDoor, RouteRoom};
use crate::geometry::Point;
use crate::geometry::tolerance::{ROUNDING_M, SNAP_M};
use crate::search::Csr;

/// No end of a door.
pub(super) const NONE: u32 = u32::MAX;

/// Two points closer than this are one, metres.
pub(super) const EPSILON: f64 = ROUNDING_M;

/// Two roundings of one point differ by less than this, metres.
const NEAR_M: f64 = 0.1 * SNAP_M;

/// Sides that meet on one line may turn by so much there, radians, where corners are rounded to a grid.
const OUT_OF_LINE: f64 = 1e-4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exit {
    pub door: DoorIndex,
    /// The room that it leads to.
    pub to: RoomIndex,
}

/// Which doors lead out of which room, whatever they weigh.
#[derive(Clone, Debug)]
pub(super) struct Exits {
    /// For each room its doors to pass.
    portals: Csr<Exit>,
    /// For each room the doors that lead into it and not back; `to` is the room from which.
    portals_into: Csr<Exit>,
    /// For each room the changes of shape that begin in it.
    changes: Csr<Exit>,
    /// For each room the changes that lead into it; `to` is the room where they begin.
    changes_into: Csr<Exit>,
}

/// Where doors end, whatever they weigh.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    /// For each room its layer: rooms that doors to pass both ways join are of one.
    layer: Vec<u32>,
    /// For each door the ends of its segment, by number; [`NONE`] for a change.
    ends: Vec<[u32; 2]>,
    /// The doors that end at each end.
    at_end: Vec<Vec<DoorIndex>>,
    /// Where each end lies.
    points: Vec<Point>,
}

impl Exits {
    pub fn new(rooms: usize, doors: &[RouteDoor]) -> Self {
        let (mut portals, mut portals_into) = (Vec::new(), Vec::new());
        let (mut changes, mut changes_into) = (Vec::new(), Vec::new());
        for (index, door) in doors.iter().enumerate() {
            let index = DoorIndex::new(index);
            let there = Exit { door: index, to: door.room2 };
            let back = Exit { door: index, to: door.room1 };
            let both = [(door.room1, there, door.room2, back), (door.room2, back, door.room1, there)];
            for (from, exit, to, entry) in &both[..if door.one_way { 1 } else { 2 }] {
                if door.is_change() {
                    changes.push((from.index(), *exit));
                    changes_into.push((to.index(), *entry));
                } else {
                    portals.push((from.index(), *exit));
                    portals_into.extend(door.one_way.then_some((to.index(), *entry)));
                }
            }
        }
        let [portals, portals_into, changes, changes_into] = [portals, portals_into, changes, changes_into]
            .map(|items: Vec<(usize, Exit)>| Csr::new(rooms, items));
        Self { portals, portals_into, changes, changes_into }
    }

    /// The doors beside a room, whichever way they lead.
    pub fn portals_beside(&self, room: RoomIndex) -> impl Iterator<Item = &Exit> {
        self.portals(room).iter().chain(self.portals_into.of(room.index()))
    }

    pub fn portals(&self, room: RoomIndex) -> &[Exit] {
        self.portals.of(room.index())
    }

    pub fn changes(&self, room: RoomIndex) -> &[Exit] {
        self.changes.of(room.index())
    }

    pub fn changes_into(&self, room: RoomIndex) -> &[Exit] {
        self.changes_into.of(room.index())
    }
}

impl Mesh {
    /// # Arguments
    /// `turns` are doors that lead into a copy of the rooms, and join nothing.
    pub fn new(rooms: usize, doors: &[RouteDoor], turns: &FixedBitSet) -> Self {
        let layer = joined(rooms, doors, |_, door| !door.one_way);
        let ground = joined(rooms, doors, |index, _| !turns.contains(index));
        let mut numbers = Numbers::default();
        let mut ends = vec![[NONE; 2]; doors.len()];
        let (mut at_end, mut points) = (Vec::<Vec<DoorIndex>>::new(), Vec::new());
        for (index, door) in doors.iter().enumerate() {
            let Some(segment) = door.crossing.segment() else { continue };
            for (end, point) in ends[index].iter_mut().zip([segment.a, segment.b]) {
                *end = numbers.of(ground[door.room1.index()], point);
                if points.len() <= *end as usize {
                    points.push(point);
                    at_end.push(Vec::new());
                }
                let (at, index) = (&mut at_end[*end as usize], DoorIndex::new(index));
                if at.last() != Some(&index) {
                    at.push(index);
                }
            }
        }
        Self { layer, ends, at_end, points }
    }

    pub fn layer(&self, room: RoomIndex) -> u32 {
        self.layer[room.index()]
    }

    pub fn ends(&self, door: DoorIndex) -> [u32; 2] {
        self.ends[door.index()]
    }

    /// The doors that end where this one does at a point; `None` where it does not end there.
    pub fn doors_at(&self, door: DoorIndex, at: Point) -> Option<&[DoorIndex]> {
        let is_there = |end: &&u32| **end != NONE && self.points[**end as usize].distance(at) <= SNAP_M;
        self.ends[door.index()].iter().find(is_there).map(|&end| self.at_end[end as usize].as_slice())
    }

    pub fn ends_count(&self) -> usize {
        self.points.len()
    }

    /// Whether a taut way may bend at an end.
    ///
    /// # Arguments
    /// `passing` says of a door what passing it changes.
    pub fn bends(
        &self,
        rooms: &[RouteRoom],
        doors: &[RouteDoor],
        end: u32,
        passing: impl Fn(DoorIndex) -> Passing,
    ) -> bool {
        let all = &self.at_end[end as usize];
        let bends = |counts: &dyn Fn(Passing) -> bool| {
            let passed = || all.iter().filter(|&&door| counts(passing(door)));
            let mut around: Vec<RoomIndex> =
                passed().flat_map(|&door| [doors[door.index()].room1, doors[door.index()].room2]).collect();
            around.sort_unstable();
            around.dedup();
            let at = self.points[end as usize];
            let free: f64 = around.iter().map(|&room| rooms[room.index()].outline.angle_at(at)).sum();
            // free ground all around, joined all around: there is nothing to bend about
            let is_whole = free >= TAU - OUT_OF_LINE && passed().count() >= around.len() && around.len() > 2;
            free > PI + EPSILON && !is_whole
        };
        bends(&|passing| passing == Passing::Free)
            || all.iter().any(|&door| passing(door) == Passing::Open)
                && bends(&|passing| passing != Passing::Shut)
    }

    /// The rooms about an end, each with one that stands for all those with which doors that end there join it at no cost, both ways;
    /// empty where one stands for all.
    pub fn parts(
        &self,
        doors: &[RouteDoor],
        end: u32,
        passing: impl Fn(DoorIndex) -> Passing,
    ) -> Vec<(RoomIndex, RoomIndex)> {
        let all = &self.at_end[end as usize];
        let mut rooms: SmallVec<[(RoomIndex, RoomIndex); 8]> = SmallVec::new();
        for &door in all {
            let RouteDoor { room1, room2, .. } = doors[door.index()];
            let [one, two] = [room1, room2].map(|room| {
                let known = rooms.iter().find(|(known, _)| *known == room).map(|(_, part)| *part);
                known.unwrap_or_else(|| {
                    rooms.push((room, room));
                    room
                })
            });
            if passing(door) == Passing::Free {
                rooms.iter_mut().filter(|(_, part)| *part == two).for_each(|(_, part)| *part = one);
            }
        }
        let is_one = rooms.iter().all(|(_, part)| *part == rooms[0].1);
        if is_one { Vec::new() } else { rooms.into_vec() }
    }
}

/// Numbers points where doors end.
#[derive(Default)]
struct Numbers {
    known: BTreeMap<(u32, i64, i64), u32>,
    count: u32,
}

impl Numbers {
    /// The number of a point of some rooms that are numbered together.
    fn of(&mut self, rooms: u32, point: Point) -> u32 {
        // what roundings of one point differ by is far below, what doors differ by far above
        let key = |x: f64, y: f64| (rooms, (x / SNAP_M).round() as i64, (y / SNAP_M).round() as i64);
        let own = key(point.x, point.y);
        let beside = || {
            let near = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
            let keys = near.map(|(x, y)| key(point.x + NEAR_M * x, point.y + NEAR_M * y));
            keys.into_iter().filter(|near| *near != own).find_map(|near| self.known.get(&near).copied())
        };
        let known = self.known.get(&own).copied().or_else(beside);
        let number = known.unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.known.insert(own, number);
        number
    }
}

/// For each room a number that is the same for all rooms that doors to pass join with it, of those that count.
fn joined(rooms: usize, doors: &[RouteDoor], counts: impl Fn(usize, &RouteDoor) -> bool) -> Vec<u32> {
    let mut joined = UnionFind::<u32>::new(rooms);
    for (_, door) in
        doors.iter().enumerate().filter(|(index, door)| !door.is_change() && counts(*index, door))
    {
        joined.union(door.room1.index() as u32, door.room2.index() as u32);
    }
    joined.into_labeling()
}
