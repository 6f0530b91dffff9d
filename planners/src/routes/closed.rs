//! Boundaries that nobody crosses, in whichever shape: rooms of all layers are cut along them, since what is a door of
//! one layer lies in the middle of another one's room.

use std::ops::Range;

use super::Best;
use super::cone::{Segment, cross};
use super::gates::without;
use super::graph::{Closed, Cut, RouteGraph};
use super::mesh::EPSILON;
use super::parts::{Crossing, DoorIndex, Entry, Goal, RoomIndex, RouteDoor, RouteRoom, Start, Walking};
use super::way::{Leg, Way, Ways};
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Point, Rect};

/// The key of an opening between two parts of a room.
pub(super) const NO_DOOR: u32 = u32::MAX;

/// So near to a closed boundary no shape is changed, metres.
pub(super) const CLEAR_M: f64 = 0.01;

impl Closed {
    /// For whoever comes along.
    pub fn for_all(segment: Segment) -> Self {
        Self { segment, is_open_to_left: false, only: None }
    }

    /// For whoever comes from its left: one passes it to that side only.
    pub fn to_left(segment: Segment) -> Self {
        Self { is_open_to_left: true, ..Self::for_all(segment) }
    }

    pub fn holds_for(&self, room: RoomIndex) -> bool {
        self.only.as_ref().is_none_or(|only| only.iter().any(|rooms| rooms.contains(&room.index())))
    }

    /// Of two rooms that lie on either side of it, which it may be crossed into.
    fn leads_into(&self, rooms: [&Convex; 2]) -> [bool; 2] {
        let Segment { a, b } = self.segment;
        rooms.map(|room| self.is_open_to_left && cross(a, b, room.centre()) > 0.0)
    }

    /// A room's parts on both sides, where the boundary lies within it: one that goes along a side lies on the doors there.
    fn cut(&self, room: &Convex) -> Option<[Convex; 2]> {
        room.clip(self.segment).filter(|shared| shared.length() > SNAP_M)?;
        let Segment { a, b } = self.segment;
        let is_broad = |part: &Convex| {
            let mut off = part.corners().map(|corner| cross(a, b, corner).abs() / a.distance(b));
            off.any(|off| off > SNAP_M)
        };
        let side = |line: Segment| room.left_of(line).filter(is_broad);
        Some([side(self.segment)?, side(self.segment.reversed())?])
    }
}

impl RouteGraph {
    /// Closes boundaries: no way crosses them, in any room, and no shape is changed on them. Those of before are open again.
    pub fn close(&mut self, closed: Vec<Closed>) {
        if self.closed != closed {
            self.closed = closed;
            self.cut.take();
        }
    }

    pub fn closed(&self) -> &[Closed] {
        &self.closed
    }

    /// The rooms cut along closed boundaries; `None` where there are none, or nothing is walked in rooms: then a door that
    /// is not passable is all.
    pub(super) fn cut(&self) -> Option<&Cut> {
        if self.closed.is_empty() || self.is_on_doors() {
            return None;
        }
        Some(self.cut.get_or_init(|| Box::new(Cut::new(self))))
    }

    /// The rooms cut along closed boundaries, where one of these is closed for whoever starts there: to others it is as if there
    /// were none.
    pub(super) fn cut_for(&self, start: &Start) -> Option<&Cut> {
        let is_concerned = |entry: &Entry| self.closed.iter().any(|closed| closed.holds_for(entry.room));
        if start.rooms.iter().any(is_concerned) { self.cut() } else { None }
    }

    /// Weighs what is cut anew, too.
    pub(super) fn reweigh_cut(
        &mut self,
        rooms: &[(RoomIndex, Walking)],
        doors: &[(DoorIndex, Option<f64>, bool)],
    ) {
        let Some(cut) = self.cut.get_mut() else { return };
        let Cut { graph, parts, pieces, .. } = cut.as_mut();
        let (parts, pieces) = (&*parts, &*pieces);
        graph.reweigh(
            rooms
                .iter()
                .flat_map(|&(room, walking)| parts[room.index()].iter().map(move |&part| (part, walking))),
            doors.iter().flat_map(|&(door, hardness, passable)| {
                pieces[door.index()].iter().map(move |&piece| (piece, hardness, passable))
            }),
        );
    }

    /// The parts of a gate out of a room that keep clear of closed boundaries.
    pub(super) fn clear_of_walls(&self, room: RoomIndex, gate: Segment) -> Vec<Segment> {
        if self.walls.is_empty() {
            return vec![gate];
        }
        // along the wall and across it
        let on_gate = |wall: &Segment| {
            let about = Rect::new(0.0, 0.0, wall.length(), 0.0).grown(CLEAR_M);
            let [a, b] = [gate.a, gate.b].map(|end| (end - wall.a).seen_along(wall.direction()));
            let (enters, leaves) = Convex::from(about).shares(a, b)?;
            Some(Segment { a: gate.at(enters), b: gate.at(leaves) })
        };
        without(gate, &self.walls_of(room).filter_map(on_gate).collect::<Vec<_>>())
    }

    /// The boundaries along which a room was cut, if it was.
    pub(super) fn walls_of(&self, room: RoomIndex) -> impl Iterator<Item = &Segment> {
        self.walls.iter().filter(move |wall| wall.holds_for(room)).map(|wall| &wall.segment)
    }

    /// Those of them that nobody passes, from neither side.
    pub(super) fn shut_of(&self, room: RoomIndex) -> impl Iterator<Item = &Segment> {
        let shut = self.walls.iter().filter(move |wall| wall.holds_for(room) && !wall.is_open_to_left);
        shut.map(|wall| &wall.segment)
    }

    /// Whether a point of a room lies on a closed boundary.
    pub(super) fn is_on_wall(&self, room: RoomIndex, p: Point) -> bool {
        self.walls_of(room).any(|wall| wall.distance(p) <= EPSILON)
    }
}

impl Cut {
    fn new(of: &RouteGraph) -> Self {
        let (mut outlines, mut rooms, mut parts) = (Vec::new(), Vec::new(), Vec::new());
        for (index, room) in of.room_indices().zip(&of.rooms) {
            let first = outlines.len();
            outlines
                .extend(parts_of(&room.outline, of.closed.iter().filter(|closed| closed.holds_for(index))));
            rooms.resize(outlines.len(), index);
            parts.push((first..outlines.len()).map(RoomIndex::new).collect());
        }
        let graph = RouteGraph::new(Vec::new(), Vec::new());
        let mut all = Self { graph, rooms, doors: Vec::new(), parts, pieces: Vec::new() };
        let (mut doors, mut shut) = (Vec::new(), Vec::new());
        let cut = (outlines.as_slice(), of.closed.as_slice());
        for (index, door) in of.door_indices().zip(&of.doors) {
            let first = doors.len();
            all.add_pieces(cut, door, (&mut doors, &mut shut));
            all.pieces.push((first..doors.len()).map(DoorIndex::new).collect());
            all.doors.resize(doors.len(), Some(index));
        }
        all.add_openings(cut, (&mut doors, &mut shut));
        doors.append(&mut shut);
        all.doors.resize(doors.len(), None);
        let part = |(outline, &room): (Convex, &RoomIndex)| RouteRoom { outline, ..of[room].clone() };
        all.graph = RouteGraph::new(outlines.into_iter().zip(&all.rooms).map(part).collect(), doors);
        let parts_of = |rooms: &Range<usize>| {
            let begins = |room: usize| all.parts.get(room).map_or(all.rooms.len(), |parts| parts[0].index());
            begins(rooms.start)..begins(rooms.end)
        };
        let wall = |closed: &Closed| Closed {
            only: closed.only.as_ref().map(|only| only.iter().map(parts_of).collect()),
            ..closed.clone()
        };
        all.graph.walls = of.closed.iter().map(wall).collect();
        let turns = of.turns.ones().flat_map(|door| &all.pieces[door]).copied();
        all.graph.turns = turns.map(DoorIndex::index).collect();
        all
    }

    /// The pieces of a door between the parts of its rooms, as far as no boundary closes it; what one closes is added to
    /// `shut`.
    fn add_pieces(
        &self,
        cut @ (outlines, _): (&[Convex], &[Closed]),
        door: &RouteDoor,
        (doors, shut): (&mut Vec<RouteDoor>, &mut Vec<RouteDoor>),
    ) {
        let (ones, twos) = (&self.parts[door.room1.index()], &self.parts[door.room2.index()]);
        for &room1 in ones {
            for &room2 in twos {
                let is_whole = ones.len() == 1 && twos.len() == 1;
                let crossing = if is_whole {
                    Some(door.crossing.clone())
                } else {
                    within(&door.crossing, [room1, room2].map(|room| &outlines[room.index()]))
                };
                let Some(crossing) = crossing else { continue };
                let piece = RouteDoor { room1, room2, crossing, ..door.clone() };
                if piece.is_change() {
                    doors.push(piece);
                } else {
                    divide((&piece, door.room1), cut, doors, shut);
                }
            }
        }
    }

    /// The openings between parts of one room, as far as no boundary closes them.
    fn add_openings(
        &self,
        cut @ (outlines, _): (&[Convex], &[Closed]),
        (doors, shut): (&mut Vec<RouteDoor>, &mut Vec<RouteDoor>),
    ) {
        for parts in &self.parts {
            for (index, &room1) in parts.iter().enumerate() {
                for &room2 in &parts[index + 1..] {
                    let border = outlines[room1.index()].border(&outlines[room2.index()]);
                    let Some(segment) = border else { continue };
                    let opening = RouteDoor {
                        door: NO_DOOR,
                        room1,
                        room2,
                        crossing: Crossing::Through(segment),
                        at: segment.middle(),
                        hardness: Some(0.0),
                        passable: true,
                        one_way: false,
                    };
                    divide((&opening, self.rooms[room1.index()]), cut, doors, shut);
                }
            }
        }
    }

    pub fn way(&self, start: &Start, goals: &[Goal], is_wide: bool, limit: f64) -> Option<Best> {
        let goals: Vec<Goal> = goals.iter().map(|goal| self.goal(goal)).collect();
        let Best { goal, tight, wide } = self.graph.way_at(&self.start(start), &goals, is_wide, limit)?;
        Some(Best { goal, tight: self.whole(&tight), wide: wide.map(|wide| self.whole(&wide)) })
    }

    pub fn ways(&self, start: &Start, goals: &[Goal], rooms: bool) -> Ways {
        let goals: Vec<Goal> = goals.iter().map(|goal| self.goal(goal)).collect();
        let found = self.graph.ways(&self.start(start), &goals, rooms);
        let nearest = |parts: &Vec<RoomIndex>| {
            let ways = parts.iter().filter_map(|&part| found.rooms[part.index()].as_ref());
            ways.min_by(|one, two| one.cost.total_cmp(&two.cost)).map(|way| self.whole(way))
        };
        Ways {
            goals: found.goals.iter().map(|way| way.as_ref().map(|way| self.whole(way))).collect(),
            rooms: if rooms { self.parts.iter().map(nearest).collect() } else { Vec::new() },
        }
    }

    /// A start and a goal in the graph of the parts.
    pub fn ends(&self, start: &Start, goal: &Goal) -> (Start, Goal) {
        (self.start(start), self.goal(goal))
    }

    fn start(&self, start: &Start) -> Start {
        Start { rooms: self.parts_at(&start.rooms, Some(start.at)), at: start.at }
    }

    fn goal(&self, goal: &Goal) -> Goal {
        Goal { rooms: self.parts_at(&goal.rooms, goal.at), at: goal.at }
    }

    /// The parts of rooms, as far as they hold a point.
    fn parts_at(&self, rooms: &[Entry], at: Option<Point>) -> Vec<Entry> {
        let holds =
            |part: RoomIndex, at: Option<Point>| at.is_none_or(|at| self.graph[part].outline.contains(at));
        let of = |&Entry { room, joint }: &Entry| {
            let (parts, at) = (&self.parts[room.index()], joint.or(at));
            let held = parts.iter().copied().filter(move |&part| parts.len() == 1 || holds(part, at));
            held.map(move |room| Entry { room, joint })
        };
        rooms.iter().flat_map(of).collect()
    }

    /// A way through parts as one through rooms: in a room it bends where a boundary ends, and only there.
    fn whole(&self, way: &Way) -> Way {
        let mut legs: Vec<Leg> = Vec::with_capacity(way.legs.len());
        for leg in &way.legs {
            let door = leg.door.and_then(|door| self.doors[door.index()]);
            let leg = Leg { room: self.rooms[leg.room.index()], door, ..*leg };
            match legs.last_mut() {
                Some(last) if last.door.is_none() && is_straight(last, &leg) => {
                    *last = Leg { from: last.from, hardness: last.hardness + leg.hardness, ..leg };
                }
                _ => legs.push(leg),
            }
        }
        Way { legs, cost: way.cost }
    }
}

/// An outline cut along boundaries.
fn parts_of<'c>(room: &Convex, closed: impl Iterator<Item = &'c Closed>) -> Vec<Convex> {
    let mut parts = vec![room.clone()];
    for boundary in closed {
        let cut = |part: Convex| boundary.cut(&part).map_or(vec![part], Vec::from);
        parts = parts.into_iter().flat_map(cut).collect();
    }
    parts
}

/// Where a door is crossed between parts of its rooms.
fn within(crossing: &Crossing, rooms: [&Convex; 2]) -> Option<Crossing> {
    let [one, two] = rooms;
    match crossing {
        Crossing::Through(segment) => {
            let segment = two.clip(one.clip(*segment)?)?;
            (segment.length() > SNAP_M).then_some(Crossing::Through(segment))
        }
        Crossing::Within(area) => {
            let area = area.common(one)?.common(two)?;
            (area.breadth() > EPSILON).then_some(Crossing::Within(area))
        }
    }
}

/// A part of a door, and whether it is passed from its first room to its second, and back.
type Part = (Segment, [bool; 2]);

/// Adds the parts of a door out of a room that no boundary closes to `doors`, the others, each by the number of its boundary,
/// to `shut`; what may be passed one way only stands in both.
fn divide(
    (door, room): (&RouteDoor, RoomIndex),
    (outlines, closed): (&[Convex], &[Closed]),
    doors: &mut Vec<RouteDoor>,
    shut: &mut Vec<RouteDoor>,
) {
    let Some(segment) = door.crossing.segment() else { return };
    let mut open: Vec<Part> = vec![(segment, [true, !door.one_way])];
    for (number, boundary) in (0..).zip(closed).filter(|(_, boundary)| boundary.holds_for(room)) {
        let Some(part) = segment.shared_with(&boundary.segment) else { continue };
        let crossing = Crossing::Through(part);
        shut.push(RouteDoor { door: number, crossing, passable: false, ..door.clone() });
        let leads = boundary.leads_into([door.room1, door.room2].map(|room| &outlines[room.index()]));
        let narrow = |(open, ways): Part| -> Vec<Part> {
            let rest = without(open, &[part]).into_iter().map(move |rest| (rest, ways));
            let ways = [ways[0] && leads[1], ways[1] && leads[0]];
            let within = open.shared_with(&part).filter(|_| ways != [false; 2]);
            rest.chain(within.map(|within| (within, ways))).collect()
        };
        open = open.into_iter().flat_map(narrow).collect();
    }
    let piece = |(part, ways): Part| {
        let [room1, room2] = if ways[0] { [door.room1, door.room2] } else { [door.room2, door.room1] };
        RouteDoor {
            room1,
            room2,
            crossing: Crossing::Through(part),
            one_way: ways != [true; 2],
            ..door.clone()
        }
    };
    // past the end of a boundary, a rounding is no way around it
    let is_way = |(part, _): &Part| *part == segment || part.length() > SNAP_M;
    doors.extend(open.into_iter().filter(is_way).map(piece));
}

/// Whether one leg goes on as the other one.
fn is_straight(one: &Leg, two: &Leg) -> bool {
    let (long, longer) = (one.length(), two.length());
    let aside = cross(one.from, one.to, two.to).abs();
    long <= EPSILON || longer <= EPSILON || aside <= EPSILON * long.max(longer).max(1.0)
}
