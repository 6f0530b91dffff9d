//! Boundaries that nobody crosses, in whichever shape: rooms of all layers are cut along them, since what is a door of
//! one layer lies in the middle of another one's room.

use super::cone::{Segment, cross};
use super::gates::without;
use super::graph::{Closed, Cut, RouteGraph};
use super::mesh::EPSILON;
use super::parts::{DoorIndex, Entry, Goal, RoomIndex, RouteDoor, RouteRoom, Start, Walking};
use super::way::{Leg, Way, Ways};
use crate::geometry::{Point, Rect};

/// The key of an opening between two parts of a room.
const NO_DOOR: u32 = u32::MAX;

/// So near to a closed boundary no shape is changed, metres.
const CLEAR_M: f64 = 0.01;

impl Closed {
    fn is_upright(&self) -> bool {
        self.segment.dx() <= EPSILON
    }

    /// A room's parts on both sides, where the boundary lies within it.
    fn cut(&self, room: Rect) -> Option<[Rect; 2]> {
        let s = &self.segment;
        let parts = if self.is_upright() {
            [Rect::new(room.x0, room.y0, s.x0, room.y1), Rect::new(s.x0, room.y0, room.x1, room.y1)]
        } else {
            [Rect::new(room.x0, room.y0, room.x1, s.y0), Rect::new(room.x0, s.y0, room.x1, room.y1)]
        };
        let shared = common(&room, s);
        let is_within = parts.iter().all(|part| part.smaller_side() > EPSILON);
        (is_within && is_segment(&shared)).then_some(parts)
    }

    /// The boundary, where it lies on the line of a segment.
    fn on_line_of(&self, segment: &Rect) -> Option<Segment> {
        let s = &self.segment;
        let is_upright = segment.dx() <= EPSILON;
        let is_on = if is_upright {
            self.is_upright() && (s.x0 - segment.x0).abs() <= EPSILON
        } else {
            !self.is_upright() && (s.y0 - segment.y0).abs() <= EPSILON
        };
        is_on.then(|| Segment::of(s))
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

    /// The parts of a gate that keep clear of closed boundaries.
    pub(super) fn clear_of_walls(&self, gate: Segment) -> Vec<Segment> {
        if self.walls.is_empty() {
            return vec![gate];
        }
        let on_gate = |wall: &Rect| {
            let about = Rect::new(wall.x0 - CLEAR_M, wall.y0 - CLEAR_M, wall.x1 + CLEAR_M, wall.y1 + CLEAR_M);
            let (a, b) = (about.nearest_to(gate.a), about.nearest_to(gate.b));
            let is_on = |p: Point| gate.nearest_to(p).distance(p) <= EPSILON;
            (is_on(a) && is_on(b)).then_some(Segment { a, b })
        };
        without(gate, &self.walls.iter().filter_map(on_gate).collect::<Vec<_>>())
    }

    /// Whether a point lies on a closed boundary.
    pub(super) fn is_on_wall(&self, p: Point) -> bool {
        self.walls.iter().any(|wall| wall.nearest_to(p).distance(p) <= EPSILON)
    }
}

impl Cut {
    fn new(of: &RouteGraph) -> Self {
        let (mut rects, mut rooms, mut parts) = (Vec::new(), Vec::new(), Vec::new());
        for (index, room) in of.room_indices().zip(&of.rooms) {
            let first = rects.len();
            rects.extend(parts_of(room.rect, &of.closed));
            rooms.resize(rects.len(), index);
            parts.push((first..rects.len()).map(RoomIndex::new).collect());
        }
        let graph = RouteGraph::new(Vec::new(), Vec::new());
        let mut all = Self { graph, rooms, doors: Vec::new(), parts, pieces: Vec::new() };
        let (mut doors, mut shut) = (Vec::new(), Vec::new());
        let cut = (rects.as_slice(), of.closed.as_slice());
        for (index, door) in of.door_indices().zip(&of.doors) {
            let first = doors.len();
            all.add_pieces(cut, door, (&mut doors, &mut shut));
            all.pieces.push((first..doors.len()).map(DoorIndex::new).collect());
            all.doors.resize(doors.len(), Some(index));
        }
        all.add_openings(cut, (&mut doors, &mut shut));
        doors.append(&mut shut);
        all.doors.resize(doors.len(), None);
        let walking = |(&rect, &room): (&Rect, &RoomIndex)| RouteRoom { rect, walking: of[room].walking };
        all.graph = RouteGraph::new(rects.iter().zip(&all.rooms).map(walking).collect(), doors);
        all.graph.walls = of.closed.iter().map(|closed| closed.segment).collect();
        all
    }

    /// The pieces of a door between the parts of its rooms, as far as no boundary closes it; what one closes is added to
    /// `shut`.
    fn add_pieces(
        &self,
        (rects, closed): (&[Rect], &[Closed]),
        door: &RouteDoor,
        (doors, shut): (&mut Vec<RouteDoor>, &mut Vec<RouteDoor>),
    ) {
        for &room1 in &self.parts[door.room1.index()] {
            for &room2 in &self.parts[door.room2.index()] {
                let crossing = common(&common(&door.crossing, &rects[room1.index()]), &rects[room2.index()]);
                let piece = RouteDoor { room1, room2, crossing, ..*door };
                if door.is_change() {
                    doors.extend((crossing.smaller_side() > EPSILON).then_some(piece));
                } else if is_segment(&crossing) {
                    divide(&piece, closed, doors, shut);
                }
            }
        }
    }

    /// The openings between parts of one room, as far as no boundary closes them.
    fn add_openings(
        &self,
        (rects, closed): (&[Rect], &[Closed]),
        (doors, shut): (&mut Vec<RouteDoor>, &mut Vec<RouteDoor>),
    ) {
        for parts in &self.parts {
            for (index, &room1) in parts.iter().enumerate() {
                for &room2 in &parts[index + 1..] {
                    let crossing = common(&rects[room1.index()], &rects[room2.index()]);
                    if is_segment(&crossing) {
                        let (at, hardness) = (crossing.centre(), Some(0.0));
                        let opening = RouteDoor {
                            door: NO_DOOR,
                            room1,
                            room2,
                            crossing,
                            at,
                            hardness,
                            passable: true,
                            one_way: false,
                        };
                        divide(&opening, closed, doors, shut);
                    }
                }
            }
        }
    }

    pub fn way(&self, start: &Start, goals: &[Goal]) -> Option<(usize, Way)> {
        let goals: Vec<Goal> = goals.iter().map(|goal| self.goal(goal)).collect();
        let (goal, way) = self.graph.way(&self.start(start), &goals)?;
        Some((goal, self.whole(&way)))
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

    /// The graph of the parts, with a start and a goal in it.
    pub fn with(&self, start: &Start, goal: &Goal) -> (&RouteGraph, Start, Goal) {
        (&self.graph, self.start(start), self.goal(goal))
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
            |part: RoomIndex, at: Option<Point>| at.is_none_or(|at| self.graph[part].rect.contains(at));
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

/// A rectangle cut along boundaries.
fn parts_of(room: Rect, closed: &[Closed]) -> Vec<Rect> {
    let mut parts = vec![room];
    for boundary in closed {
        parts = parts.into_iter().flat_map(|part| boundary.cut(part).map_or(vec![part], Vec::from)).collect();
    }
    parts
}

/// Adds the parts of a door that no boundary closes to `doors`, the others to `shut`.
fn divide(door: &RouteDoor, closed: &[Closed], doors: &mut Vec<RouteDoor>, shut: &mut Vec<RouteDoor>) {
    let segment = Segment::of(&door.crossing);
    let crossing = |part: Segment| Rect::new(part.a.x, part.a.y, part.b.x, part.b.y);
    let mut open = vec![segment];
    for boundary in closed {
        let Some(on) = boundary.on_line_of(&door.crossing) else { continue };
        let part = common(&door.crossing, &boundary.segment);
        if is_segment(&part) {
            shut.push(RouteDoor { door: boundary.door, crossing: part, passable: false, ..*door });
            open = open.iter().flat_map(|part| without(*part, &[on])).collect();
        }
    }
    doors.extend(open.into_iter().map(|part| RouteDoor { crossing: crossing(part), ..*door }));
}

/// What two rectangles share, be it a segment; its sides are negative where they share nothing.
fn common(a: &Rect, b: &Rect) -> Rect {
    Rect { x0: a.x0.max(b.x0), y0: a.y0.max(b.y0), x1: a.x1.min(b.x1), y1: a.y1.min(b.y1) }
}

fn is_segment(rect: &Rect) -> bool {
    let (thin, long) = (rect.dx().min(rect.dy()), rect.dx().max(rect.dy()));
    (-EPSILON..=EPSILON).contains(&thin) && long > EPSILON
}

/// Whether one leg goes on as the other one.
fn is_straight(one: &Leg, two: &Leg) -> bool {
    let (long, longer) = (one.length(), two.length());
    let aside = cross(one.from, one.to, two.to).abs();
    long <= EPSILON || longer <= EPSILON || aside <= EPSILON * long.max(longer).max(1.0)
}
