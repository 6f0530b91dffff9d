//! The graph of routes: rooms joined by doors, what they weigh, and what is kept of both for searches.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::{Index, Range};
use std::sync::{Arc, OnceLock};

use fixedbitset::FixedBitSet;

use super::hierarchy::Hierarchy;
use super::mesh::{Exit, Exits, Mesh};
use super::parts::{DoorIndex, Passing, RoomIndex, RouteDoor, RouteRoom, Walking};
use super::turning::Turning;
use crate::geometry::{Rect, Segment};
use crate::search::Csr;

#[derive(Clone, Debug)]
pub struct RouteGraph {
    pub(super) rooms: Vec<RouteRoom>,
    pub(super) doors: Vec<RouteDoor>,
    /// How many rooms weigh their metres.
    pub(super) measured: usize,
    pub(super) hierarchy: Option<Hierarchy>,
    pub(super) exits: Exits,
    /// Found when first asked for.
    mesh: OnceLock<Arc<Mesh>>,
    /// Found when first asked for.
    turning: OnceLock<Box<Turning>>,
    /// The doors into each room; found when first asked for.
    pub(super) entries: OnceLock<Csr<Exit>>,
    /// Boundaries that nobody crosses.
    pub(super) closed: Vec<Closed>,
    /// The rooms cut along them; found when first asked for.
    pub(super) cut: OnceLock<Box<Cut>>,
    /// Boundaries along which these rooms are cut already.
    pub(super) walls: Vec<Closed>,
    /// Doors at which a way may turn back.
    pub(super) turns: FixedBitSet,
}

impl RouteGraph {
    /// The graph of all doors with a known hardness that are passable; other doors are kept for [`blockage`].
    pub fn new(rooms: Vec<RouteRoom>, doors: Vec<RouteDoor>) -> Self {
        let exits = Exits::new(rooms.len(), &doors);
        let measured = rooms.iter().filter(|room| room.is_measured()).count();
        Self {
            rooms,
            doors,
            measured,
            hierarchy: None,
            exits,
            mesh: OnceLock::new(),
            turning: OnceLock::new(),
            entries: OnceLock::new(),
            closed: Vec::new(),
            cut: OnceLock::new(),
            walls: Vec::new(),
            turns: FixedBitSet::new(),
        }
    }

    /// Lets ways turn back at some doors, where rooms weigh their metres: elsewhere none is better for it, and none is looked for.
    pub fn turn_back_at(&mut self, doors: impl IntoIterator<Item = DoorIndex>) {
        self.turns = doors.into_iter().map(DoorIndex::index).collect();
        self.mesh.take();
        self.turning.take();
        self.cut.take();
    }

    /// The rooms from which ways lead to some others only by doors at which ways turn back, and the rectangle about those doors; `None`
    /// where ways turn back nowhere.
    pub(super) fn leads_through(&self, to: impl Iterator<Item = RoomIndex>) -> Option<(FixedBitSet, Rect)> {
        let turns = self.turns.ones().map(|door| self.doors[door].crossing.bounds());
        let within =
            turns.reduce(|one, other| Rect::around(one.corners().into_iter().chain(other.corners())))?;
        let mut before = FixedBitSet::with_capacity(self.rooms.len());
        before.insert_range(..);
        let mut next: Vec<RoomIndex> = to.collect();
        while let Some(room) = next.pop() {
            if before.contains(room.index()) {
                before.remove(room.index());
                let into = self.entries().of(room.index()).iter();
                let into = into.filter(|exit| !self.turns.contains(exit.door.index()));
                next.extend(into.map(|exit| exit.to));
            }
        }
        Some((before, within))
    }

    /// Where ways that weigh metres may turn.
    pub(super) fn turning(&self) -> &Turning {
        self.turning.get_or_init(|| {
            let passing = self.door_indices().map(|door| self.passing_of(door)).collect();
            Box::new(Turning::new(&self.rooms, &self.doors, passing, Arc::clone(self.mesh())))
        })
    }

    /// Where doors end, whatever they weigh. Searches find it when they need it first; it may be asked for before it is known what
    /// rooms and doors weigh.
    pub(super) fn mesh(&self) -> &Arc<Mesh> {
        self.mesh.get_or_init(|| Arc::new(Mesh::new(self.rooms.len(), &self.doors, &self.turns)))
    }

    /// Finds what searches where rooms weigh their metres need to know of rooms and doors, whatever these weigh.
    pub fn prepare_mesh(&self) {
        self.mesh();
    }

    /// Takes over what is known of where changes of shape pay in another graph.
    ///
    /// # Arguments
    /// `doors` gives each door the other graph's that is the same between the same rooms, if one is.
    pub fn know_changes(&mut self, of: &Self, doors: impl Iterator<Item = Option<DoorIndex>>) {
        let Some(known) = of.turning.get() else { return };
        self.turning();
        if let Some(turning) = self.turning.get_mut() {
            turning.know_gates(known, doors);
        }
    }

    /// Makes [`way`](Self::way) quick between any two rooms, where all hardness lies on the doors; elsewhere it does
    /// nothing. What is prepared follows [`reweigh`](Self::reweigh), and clones share what does not hang on weights.
    ///
    /// It takes about half a second for 100,000 doors.
    pub fn prepare(&mut self) {
        if self.hierarchy.is_none() && self.is_on_doors() {
            let passing = self.door_indices().map(|door| self.passing_both_ways(door)).collect();
            self.hierarchy = Some(Hierarchy::new(&self.rooms, &self.doors, passing));
        }
    }

    /// What passing a door weighs from its first room and from its second; infinite where it is not passed.
    fn passing_both_ways(&self, door: DoorIndex) -> [f64; 2] {
        let weight = self.passage(door).unwrap_or(f64::INFINITY);
        [weight, if self[door].one_way { f64::INFINITY } else { weight }]
    }

    /// Weighs rooms and doors anew; what is not named stays as it is.
    ///
    /// Where all hardness lies on the doors, and no room comes to weigh or to be entered otherwise, it takes as long as
    /// there are doors named, and ways that lead through them.
    pub fn reweigh(
        &mut self,
        rooms: impl IntoIterator<Item = (RoomIndex, Walking)>,
        doors: impl IntoIterator<Item = (DoorIndex, Option<f64>, bool)>,
    ) {
        let (rooms, doors) = (rooms.into_iter().collect::<Vec<_>>(), doors.into_iter().collect::<Vec<_>>());
        self.reweigh_cut(&rooms, &doors);
        let was_on_doors = self.is_on_doors();
        let (mut touched, mut prices) = (Vec::new(), BTreeMap::new());
        let rooms: Vec<(RoomIndex, Walking)> =
            rooms.into_iter().filter(|(room, walking)| self[*room].walking != *walking).collect();
        if !rooms.is_empty() {
            touched = self.door_indices().collect();
        }
        for (room, walking) in rooms {
            let room = &mut self.rooms[room.index()];
            self.measured -= usize::from(room.is_measured());
            room.walking = walking;
            self.measured += usize::from(room.is_measured());
        }
        let is_all = !touched.is_empty();
        // nothing that hangs on prices is known before
        let is_turning = self.turning.get().is_some();
        for (door, hardness, passable) in doors {
            let of = &mut self.doors[door.index()];
            let before = of.weight();
            (of.hardness, of.passable) = (hardness, passable);
            if is_turning && of.is_change() && of.weight() != before {
                prices.entry(door).or_insert(before);
            }
            if !is_all {
                touched.push(door);
            }
        }
        self.reweigh_hierarchy(&touched);
        let passing: Vec<_> = match self.turning.get() {
            Some(_) => touched.iter().map(|&door| (door, self.passing_of(door))).collect(),
            None => return,
        };
        let is_on_doors = was_on_doors && self.is_on_doors();
        let is_other_price = !self.are_priced_alike(&prices);
        let Some(turning) = self.turning.get_mut() else { return };
        if is_all || !prices.is_empty() {
            turning.sequences = OnceLock::new();
        }
        let mut otherwise = turning.pass((&self.rooms, &self.doors), &passing);
        if is_on_doors {
            return;
        }
        // a gate hangs on what is free beside it, and on which changes have one price
        if is_other_price {
            otherwise.extend(prices.keys());
        }
        turning.forget_near((&self.rooms, &self.doors), &otherwise);
    }

    /// Whether changes of shape between the same layers have one price where they had one, and only there.
    ///
    /// # Arguments
    /// `before` has the prices that are others now.
    fn are_priced_alike(&self, before: &BTreeMap<DoorIndex, Option<f64>>) -> bool {
        let (mut now_of, mut was_of) = (BTreeMap::new(), BTreeMap::new());
        let mut changes = self.door_indices().filter(|&door| !before.is_empty() && self[door].is_change());
        changes.all(|door| {
            let of = &self[door];
            let layers = [of.room1, of.room2].map(|room| self.turning().mesh.layer(room));
            let priced = |price: Option<f64>| (layers, price.map(f64::to_bits));
            let now = priced(of.weight());
            let was = before.get(&door).map_or(now, |price| priced(*price));
            *now_of.entry(was).or_insert(now) == now && *was_of.entry(now).or_insert(was) == was
        })
    }

    /// Weighs these doors anew where ways between any two rooms are prepared.
    fn reweigh_hierarchy(&mut self, doors: &[DoorIndex]) {
        let Some(mut hierarchy) = self.hierarchy.take() else { return };
        hierarchy.reweigh(doors.iter().map(|&door| (door, self.passing_both_ways(door))));
        self.hierarchy = Some(hierarchy);
    }

    pub(super) fn passing_of(&self, door: DoorIndex) -> Passing {
        if self.is_free(door) {
            Passing::Free
        } else if self.passage(door).is_some() {
            Passing::Open
        } else {
            Passing::Shut
        }
    }

    /// Which of a door's rooms is easier.
    pub(super) fn order(&self, door: DoorIndex) -> Ordering {
        self.per_m(self[door].room2).total_cmp(&self.per_m(self[door].room1))
    }

    /// Whether no room weighs its metres.
    pub fn is_on_doors(&self) -> bool {
        self.measured == 0
    }

    pub(super) fn is_open(&self, door: DoorIndex) -> bool {
        self.passage(door).is_some()
    }

    pub fn room_indices(&self) -> impl Iterator<Item = RoomIndex> + use<> {
        (0..self.rooms.len()).map(RoomIndex::new)
    }

    pub fn door_indices(&self) -> impl Iterator<Item = DoorIndex> + use<> {
        (0..self.doors.len()).map(DoorIndex::new)
    }

    pub fn rooms(&self) -> &[RouteRoom] {
        &self.rooms
    }

    /// The doors, passable or not.
    pub fn doors(&self) -> &[RouteDoor] {
        &self.doors
    }

    /// Whether a door can be passed for nothing, between rooms of equal hardness, both ways.
    pub(super) fn is_free(&self, door: DoorIndex) -> bool {
        !self[door].one_way && self.costs_nothing(door)
    }

    /// Whether a door is passed for nothing, between rooms of equal hardness, in the ways in which it is passed.
    pub(super) fn costs_nothing(&self, door: DoorIndex) -> bool {
        let (one, two) = (self[door].room1, self[door].room2);
        self.passage(door) == Some(0.0) && self.per_m(one).to_bits() == self.per_m(two).to_bits()
    }

    /// Hardness of a metre; 0 where all hardness lies on the doors, infinite where no route enters.
    pub(super) fn per_m(&self, room: RoomIndex) -> f64 {
        match self[room].walking {
            Walking::OnDoors => 0.0,
            Walking::PerMetre(hardness) => hardness,
            Walking::Unknown => f64::INFINITY,
        }
    }

    pub(super) fn is_entered(&self, room: RoomIndex) -> bool {
        self[room].walking != Walking::Unknown
    }

    /// What passing a door weighs, where it can be passed.
    pub(super) fn passage(&self, door: DoorIndex) -> Option<f64> {
        let of = &self[door];
        of.weight().filter(|_| self.is_entered(of.room1) && self.is_entered(of.room2))
    }

    /// The least hardness of a metre in a room that may be entered.
    pub(super) fn least_per_m(&self) -> f64 {
        let all = self.room_indices().map(|room| self.per_m(room));
        let least = all.fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    }
}

impl Index<RoomIndex> for RouteGraph {
    type Output = RouteRoom;

    fn index(&self, room: RoomIndex) -> &RouteRoom {
        &self.rooms[room.index()]
    }
}

impl Index<DoorIndex> for RouteGraph {
    type Output = RouteDoor;

    fn index(&self, door: DoorIndex) -> &RouteDoor {
        &self.doors[door.index()]
    }
}

/// A boundary that no way crosses, or none from one side.
#[derive(Clone, Debug, PartialEq)]
pub struct Closed {
    pub segment: Segment,
    /// Whether ways may cross it from its right to its left, as one looks from its first end to its second.
    pub is_open_to_left: bool,
    /// The rooms for which it is closed, by index; `None`: for all.
    pub only: Option<Vec<Range<usize>>>,
}

/// The graph of the parts into which closed boundaries cut rooms.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    pub graph: RouteGraph,
    /// Of each part its room.
    pub rooms: Vec<RoomIndex>,
    /// Of each door of the graph the site's; `None` for one between two parts of a room.
    pub doors: Vec<Option<DoorIndex>>,
    /// Of each room its parts.
    pub parts: Vec<Vec<RoomIndex>>,
    /// Of each door of the site the graph's.
    pub pieces: Vec<Vec<DoorIndex>>,
}
