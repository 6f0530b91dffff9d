//! Where a change of shape can pay: on the rim of the free space of the easier state.

use std::collections::BTreeMap;

use super::cone::{Segment, cross};
use super::graph::RouteGraph;
use super::mesh::{EPSILON, Exit};
use super::parts::{Crossing, DoorIndex, RoomIndex};
use super::turning::Gate;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Convex, Point};

/// So far a way into the harder state has to lead on beyond a gate, metres, unless a goal lies near: along every wall there
/// is a strip in which only a slimmer state fits, and which leads nowhere.
const DEEP_M: f64 = 0.5;

/// An area that ends so near to the rim of the easier state's space, metres, ends at the rim: changes thinner than that may be
/// left out beside others.
const THIN_M: f64 = 0.3;

/// Beyond so much of a rim, metres, it is judged at once whether a way leads on.
const PIECE_M: f64 = 1.0;

/// By what a way may go on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Further {
    Doors,
    /// By doors, and by another change of shape into a state that has room beyond.
    AllWays,
}

impl RouteGraph {
    /// The segments on which the change `door` is begun from the room `from`.
    ///
    /// As long as the easier state has room, nobody leaves it, and as soon as it has, everybody takes it: so a shape
    /// is changed where the easier of the two rooms ends and none like it follows; and where the change gets
    /// another price.
    pub(super) fn gates(&self, door: DoorIndex, from: RoomIndex) -> &[Gate] {
        let (to, side) = self.beyond(door, from);
        self.turning().gates(door, (side, self.order(door)), || {
            let (easier, harder) = if self.per_m(to) >= self.per_m(from) { (from, to) } else { (to, from) };
            let mut gates = Vec::new();
            let Some(area) = self[door].crossing.area() else { return Box::default() };
            let centre = area.centre();
            let common = self[from].outline.common(&self[to].outline);
            let deep = |segment: Segment| Gate { segment, is_deep: true, is_step: false };
            if common.is_none_or(|common| !is_same(&common, area)) {
                // something else than the two rooms limits the change: a body turns only where all that it sweeps is free
                return area.sides().flat_map(|side| self.clear_of_walls(from, side)).map(deep).collect();
            }
            let is_equal = self.per_m(from).to_bits() == self.per_m(to).to_bits();
            for side in area.sides() {
                let [of_easier, of_harder] = [easier, harder].map(|room| self.rim(room, side));
                let (alike, otherwise) = self.beside(door, (from, to), side);
                gates.extend(otherwise.into_iter().map(deep));
                let known = [of_easier.as_slice(), &of_harder, &alike].concat();
                let mut rim = of_easier;
                for end in without(side, &known) {
                    let beyond = |room| Sweep::beyond(self, end, centre, THIN_M, Further::Doors).deep(room);
                    let by_easier = beyond(easier);
                    rim.extend(beyond(harder).into_iter().flat_map(|part| without(part, &by_easier)));
                }
                if is_equal {
                    gates.extend(rim.into_iter().chain(of_harder).map(deep));
                    continue;
                }
                for (segment, is_step) in rim.into_iter().flat_map(|part| parted(part, &of_harder)) {
                    if easier == to {
                        gates.push(Gate { segment, is_deep: true, is_step });
                        continue;
                    }
                    let parts = Sweep::beyond(self, segment, centre, DEEP_M, Further::AllWays).deep(to);
                    let shallow = without(segment, &parts);
                    gates.extend(parts.into_iter().map(|segment| Gate { segment, is_deep: true, is_step }));
                    gates.extend(shallow.into_iter().flat_map(pieces).map(|segment| {
                        let is_deep = self.leads_on(from, to, segment);
                        Gate { segment, is_deep, is_step }
                    }));
                }
            }
            let clear = |gate: Gate| {
                self.clear_of_walls(from, gate.segment)
                    .into_iter()
                    .map(move |segment| Gate { segment, ..gate })
            };
            gates.into_iter().flat_map(clear).collect()
        })
    }

    /// The sides of the area in which a change of shape is possible, without what lies on walls of the room changed into.
    pub(super) fn sides(&self, door: DoorIndex, into: RoomIndex) -> impl Iterator<Item = Segment> {
        let sides = self[door].crossing.area().into_iter().flat_map(Convex::sides);
        sides.flat_map(move |side| self.clear_of_walls(into, side))
    }

    /// Whether a change may pay as one of several at one point: not where one change does the same at no higher price.
    pub(super) fn is_step_on_a_way(&self, door: DoorIndex, from: RoomIndex) -> bool {
        let (to, _) = self.beyond(door, from);
        let layer = |room| self.turning().mesh.layer(room);
        let own = self.passage(door).unwrap_or(f64::INFINITY);
        // the changes that come after it, or before it, and those that do the same at once
        let (others, at_once, end) = if self.per_m(to) >= self.per_m(from) {
            (self.exits.changes(to), self.exits.changes(from), layer(from))
        } else {
            (self.exits.changes_into(from), self.exits.changes_into(to), layer(to))
        };
        others.iter().filter(|other| layer(other.to) != end).any(|other| {
            let both = self.passage(other.door).map(|price| own + price + EPSILON);
            let does_the_same = |exit: &&Exit| layer(exit.to) == layer(other.to);
            let is_no_more = |exit: &Exit| self.passage(exit.door) <= both && self.is_open(exit.door);
            both.is_some() && !at_once.iter().filter(does_the_same).any(is_no_more)
        })
    }

    /// Whether the harder state comes out of the neighbourhood of a rim where the easier one does not: elsewhere what lies
    /// beyond the rim is a strip that the easier state goes along as well.
    fn leads_on(&self, easier: RoomIndex, harder: RoomIndex, rim: Segment) -> bool {
        let (ahead, across) = (rim.direction() * DEEP_M, rim.direction().perpendicular() * DEEP_M);
        let (from, to) = (rim.a - ahead, rim.b + ahead);
        let about = Convex::new(vec![from - across, to - across, to + across, from + across]);
        let with = self.leaves(&about, easier, |exit| self.is_free(exit.door));
        let without = self.leaves(&about, harder, |exit| self.passage(exit.door).is_some());
        let all: f64 = about.sides().map(|side| side.length()).sum();
        !are_covered(&without, &with, all)
    }

    /// Where one comes out of an area from a room in it by doors in it that may be passed: from where to where along its
    /// outline.
    fn leaves(&self, about: &Convex, room: RoomIndex, may: impl Fn(&Exit) -> bool) -> Vec<(f64, f64)> {
        let (mut rooms, mut next, mut found) = (vec![room], 0, Vec::new());
        while let Some(&room) = rooms.get(next) {
            next += 1;
            let mut begun = 0.0;
            for side in about.sides() {
                let length = side.length();
                if let Some((from, to)) = self[room].outline.shares(side.a, side.b) {
                    found.push((begun + from * length, begun + to * length));
                }
                begun += length;
            }
            for exit in self.exits.portals(room).iter().chain(self.exits.changes(room)) {
                let is_met = || match &self[exit.door].crossing {
                    Crossing::Through(segment) => about.clip(*segment).is_some(),
                    Crossing::Within(area) => about.overlaps(area),
                };
                if !rooms.contains(&exit.to) && may(exit) && is_met() {
                    rooms.push(exit.to);
                }
            }
        }
        found
    }

    /// The parts of a side of a change's area beyond which the same change is possible; and those beyond which it has
    /// another price, or is shut.
    fn beside(
        &self,
        door: DoorIndex,
        (from, to): (RoomIndex, RoomIndex),
        side: Segment,
    ) -> (Vec<Segment>, Vec<Segment>) {
        let area = self[door].crossing.area();
        let weight = self.passage(door);
        let free = self.exits.portals(from).iter().filter(|exit| self.is_free(exit.door));
        let rooms = std::iter::once(from).chain(free.map(|exit| exit.to));
        let (mut alike, mut otherwise) = (Vec::new(), Vec::new());
        for exit in rooms.flat_map(|room| self.exits.changes(room)) {
            let Exit { door: other, to: room } = *exit;
            let is_of_layer =
                other != door && self.turning().mesh.layer(room) == self.turning().mesh.layer(to);
            let is_like =
                self.per_m(room).to_bits() == self.per_m(to).to_bits() && self.passage(other) == weight;
            let beside = self[other].crossing.area();
            // a change back and forth may lie in the same area
            if is_of_layer && beside != area {
                let into = if is_like { &mut alike } else { &mut otherwise };
                into.extend(beside.and_then(|beside| beside.clip_near(side)));
            }
        }
        (alike, otherwise)
    }

    /// The room behind a door, and which of the door's directions leads there.
    fn beyond(&self, door: DoorIndex, from: RoomIndex) -> (RoomIndex, usize) {
        let door = &self[door];
        if door.room1 == from { (door.room2, 0) } else { (door.room1, 1) }
    }

    /// The parts of a segment on a room's outline beyond which none like it follows.
    pub(super) fn rim(&self, room: RoomIndex, side: Segment) -> Vec<Segment> {
        let outline = self[room].outline.sides();
        let on = outline.filter_map(|of_room| side.shared_with(&of_room));
        let free = self.exits.portals(room).iter().filter(|exit| self.is_free(exit.door));
        let open = free.filter_map(|exit| side.shared_with(&self[exit.door].crossing.segment()?));
        let (on, open): (Vec<Segment>, Vec<Segment>) = (on.collect(), open.collect());
        on.into_iter().flat_map(|part| without(part, &open)).collect()
    }
}

/// From which parts of a segment one has gone on in a room, and how far one had come by changes of shape.
type Explored = BTreeMap<RoomIndex, Vec<((f64, f64), f64)>>;

/// What lies straight beyond a segment.
struct Sweep<'g> {
    graph: &'g RouteGraph,
    segment: Segment,
    /// Along the segment; what lies beyond it lies to the left.
    ahead: Point,
    metres: f64,
    by: Further,
}

impl<'g> Sweep<'g> {
    /// So many metres away from a point.
    fn beyond(graph: &'g RouteGraph, segment: Segment, away_from: Point, metres: f64, by: Further) -> Self {
        let is_left = cross(segment.a, segment.b, away_from) > 0.0;
        let segment = if is_left { segment.reversed() } else { segment };
        Self { graph, segment, ahead: segment.direction(), metres, by }
    }

    /// Metres along the segment, and beyond it.
    fn seen(&self, p: Point) -> Point {
        (p - self.segment.a).seen_along(self.ahead)
    }

    /// The parts of the segment from which a room and those behind it go on for so many metres.
    fn deep(&self, room: RoomIndex) -> Vec<Segment> {
        let mut parts = Vec::new();
        let length = self.segment.length();
        self.go_on(room, ((0.0, length), 0.0), &mut Explored::new(), &mut parts);
        let at = |along: f64| self.segment.at(along / length);
        joined(parts).into_iter().map(|(from, to)| Segment { a: at(from), b: at(to) }).collect()
    }

    /// The same, of a part of the segment, from a room that one has come into; `highest` is how far one has come by other changes
    /// of shape.
    fn find(
        &self,
        room: RoomIndex,
        (part, highest): ((f64, f64), f64),
        explored: &mut Explored,
        deep: &mut Vec<(f64, f64)>,
    ) {
        let graph = self.graph;
        let outline = &graph[room].outline;
        let top = outline.corners().map(|corner| self.seen(corner).y).fold(highest, f64::max);
        let mut is_all = false;
        for side in outline.sides() {
            // seen from within, the far sides run back
            let (b, a) = (self.seen(side.a), self.seen(side.b));
            let Some((from, to)) = overlap((a.x, b.x), part) else { continue };
            let height = |x: f64| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
            let least = self.metres - EPSILON;
            let (one, two) = (height(from), height(to));
            let limit = || from + (to - from) * ((least - one) / (two - one));
            match (one >= least, two >= least) {
                (true, true) => deep.push((from, to)),
                (true, false) => deep.push((from, limit())),
                (false, true) => deep.push((limit(), to)),
                (false, false) => {}
            }
            is_all |= one.min(two) >= least && from <= part.0 && to >= part.1;
        }
        if is_all {
            return;
        }
        let is_open = |exit: &&Exit| graph.passage(exit.door).is_some();
        let inside = self.seen(outline.centre());
        for exit in graph.exits.portals(room).iter().filter(is_open) {
            let Some(door) = graph[exit.door].crossing.segment() else { continue };
            let (a, b) = (self.seen(door.a), self.seen(door.b));
            let (a, b) = if a.x < b.x { (a, b) } else { (b, a) };
            let is_above = cross(a, b, inside) < 0.0 && a.y.max(b.y) > -EPSILON;
            if let Some(part) = overlap((a.x, b.x), part).filter(|_| is_above) {
                self.go_on(exit.to, (part, top), explored, deep);
            }
        }
        if self.by == Further::Doors {
            return;
        }
        for exit in graph.exits.changes(room).iter().filter(is_open) {
            let Some(area) = graph[exit.door].crossing.area() else { continue };
            let highest = |of: &Convex| of.corners().map(|corner| self.seen(corner).y).fold(0.0, f64::max);
            if highest(&graph[exit.to].outline) <= top + EPSILON || highest(area) <= EPSILON {
                continue;
            }
            let beyond = area.left_of(self.segment);
            let along = beyond.iter().flat_map(Convex::corners).map(|corner| self.seen(corner).x);
            let (from, to) =
                along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            if let Some(part) = overlap((from, to), part) {
                self.go_on(exit.to, (part, top), explored, deep);
            }
        }
    }

    /// Goes on in a room, from those parts from which that was not done yet by as few changes of shape: from the others nothing
    /// new is found, and there are more ways through many rooms than can be followed. One that comes into a room again is among
    /// them: its part is no wider, and it has come no less far.
    fn go_on(
        &self,
        to: RoomIndex,
        (part, top): ((f64, f64), f64),
        explored: &mut Explored,
        deep: &mut Vec<(f64, f64)>,
    ) {
        let known = explored.entry(to).or_default();
        let before = known.iter().filter(|(_, highest)| *highest <= top).map(|(part, _)| *part);
        let rest = rest_of(part, before.collect());
        known.push((part, top));
        for part in rest {
            self.find(to, (part, top), explored, deep);
        }
    }
}

/// What two stretches have in common; `None` where that is less than a rounding.
fn overlap(one: (f64, f64), two: (f64, f64)) -> Option<(f64, f64)> {
    let (from, to) = (one.0.max(two.0), one.1.min(two.1));
    (to - from > EPSILON).then_some((from, to))
}

/// What is left of a stretch without some others.
fn rest_of((mut from, to): (f64, f64), mut others: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    others.sort_by(|one, two| one.0.total_cmp(&two.0));
    let mut rest = Vec::new();
    for (begins, ends) in others {
        rest.extend(overlap((from, begins), (from, to)));
        from = from.max(ends);
    }
    rest.extend(overlap((from, to), (from, to)));
    rest
}

/// Whether all of some stretches of a closed line of a length lies no farther than [`DEEP_M`] from some others, with nothing
/// but such stretches between.
fn are_covered(all: &[(f64, f64)], others: &[(f64, f64)], length: f64) -> bool {
    // twice round, so that what goes on past the beginning is in one piece
    let round = |of: &[(f64, f64)]| {
        joined(of.iter().copied().chain(of.iter().map(|(a, b)| (a + length, b + length))).collect())
    };
    let (runs, others) = (round(all), round(others));
    runs.into_iter().all(|(from, to)| {
        let is_whole = to - from > length;
        if from > length + EPSILON || from <= EPSILON && !is_whole {
            // it is found where it begins the second time round, whole
            return true;
        }
        let mut last = None;
        for &(begins, ends) in others.iter().filter(|(begins, ends)| *ends >= from && *begins <= to) {
            let (gap, most) = match last {
                Some(last) => (begins - last, 2.0 * DEEP_M),
                None if is_whole => (0.0, DEEP_M),
                None => (begins - from, DEEP_M),
            };
            if gap > most + EPSILON {
                return false;
            }
            last = Some(ends);
        }
        last.is_some_and(|last| is_whole || to - last <= DEEP_M + EPSILON)
    })
}

/// Stretches put together where they meet, in their order.
fn joined(mut stretches: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    stretches.sort_by(|one, two| one.0.total_cmp(&two.0));
    stretches.dedup_by(|next, last| {
        let meets = next.0 <= last.1 + SNAP_M;
        if meets {
            last.1 = last.1.max(next.1);
        }
        meets
    });
    stretches
}

/// A segment cut into equal pieces of at most [`PIECE_M`].
fn pieces(segment: Segment) -> impl Iterator<Item = Segment> {
    let count = (segment.length() / PIECE_M).ceil().max(1.0) as u32;
    let at = move |number: u32| segment.at(f64::from(number) / f64::from(count));
    (0..count).map(move |number| Segment { a: at(number), b: at(number + 1) })
}

fn is_same(a: &Convex, b: &Convex) -> bool {
    let holds = |one: &Convex, other: &Convex| other.corners().all(|corner| one.distance(corner) <= SNAP_M);
    holds(a, b) && holds(b, a)
}

/// The parts of a segment, with whether one of some others on its line covers them.
fn parted(side: Segment, others: &[Segment]) -> Vec<(Segment, bool)> {
    let free = without(side, others);
    let covered = without(side, &free);
    free.into_iter().map(|part| (part, false)).chain(covered.into_iter().map(|part| (part, true))).collect()
}

/// The parts of a segment that none of some others on its line covers.
pub(super) fn without(side: Segment, others: &[Segment]) -> Vec<Segment> {
    let (length, ahead) = (side.length(), side.direction());
    let along = |p: Point| (p - side.a).dot(ahead);
    let ends = |segment: &Segment| {
        let (a, b) = (along(segment.a), along(segment.b));
        (a.min(b), a.max(b))
    };
    let mut covered: Vec<(f64, f64)> = others.iter().map(ends).collect();
    covered.sort_by(|one, two| one.0.total_cmp(&two.0));
    let (mut rest, mut from) = (Vec::new(), 0.0_f64);
    for (begins, ends) in covered.into_iter().chain([(length, length)]) {
        let to = begins.min(length);
        if to - from > EPSILON {
            let a = if from > 0.0 { side.at(from / length) } else { side.a };
            let b = if to < length { side.at(to / length) } else { side.b };
            rest.push(Segment { a, b });
        }
        from = from.max(ends);
    }
    rest
}
