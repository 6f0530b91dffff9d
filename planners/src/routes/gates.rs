//! Where a change of shape can pay: on the rim of the free space of the easier state.

use super::cone::Segment;
use super::graph::RouteGraph;
use super::mesh::{EPSILON, Exit};
use super::parts::{DoorIndex, RoomIndex};
use super::turning::Gate;
use crate::geometry::{Convex, Point, Rect};

/// So far a way into the harder state has to lead on beyond a gate, metres, unless a goal lies near: along every wall there
/// is a strip in which only a slimmer state fits, and which leads nowhere.
const DEEP_M: f64 = 0.5;

/// An area that ends so near to the rim of the easier state's space, metres, ends at the rim: changes thinner than that may be
/// left out beside others.
const THIN_M: f64 = 0.3;

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
        self.turning().gates[door.index()][side].get_or_init(|| {
            let (easier, harder) = if self.per_m(to) >= self.per_m(from) { (from, to) } else { (to, from) };
            let mut gates = Vec::new();
            let Some(area) = self[door].crossing.area().map(Convex::bounds) else { return Box::default() };
            let common = self[from].outline.bounds().intersection(&self[to].outline.bounds());
            let deep = |segment: Segment| Gate { segment, is_deep: true };
            if common.is_none_or(|common| !is_same(&common, &area)) {
                // something else than the two rooms limits the change: a body turns only where all that it sweeps is free
                return sides(&area)
                    .into_iter()
                    .flat_map(|side| self.clear_of_walls(side))
                    .map(deep)
                    .collect();
            }
            let is_equal = self.per_m(from).to_bits() == self.per_m(to).to_bits();
            for side in sides(&area) {
                let mut rim = self.rim(easier, side);
                let mut known = self.rim(harder, side);
                known.extend(rim.iter().copied());
                let (alike, otherwise) = self.beside(door, (from, to), side);
                known.extend(alike);
                for end in without(side, &known) {
                    let on = self.deep(easier, end, area.centre(), THIN_M, Further::Doors);
                    rim.extend(without(end, &on));
                }
                gates.extend(otherwise.into_iter().map(deep));
                if is_equal {
                    gates.extend(self.rim(harder, side).into_iter().map(deep));
                }
                if is_equal || easier == to {
                    gates.extend(rim.into_iter().map(deep));
                    continue;
                }
                for segment in rim {
                    let parts = self.deep(to, segment, area.centre(), DEEP_M, Further::AllWays);
                    let shallow = without(segment, &parts).into_iter();
                    gates.extend(parts.into_iter().map(deep));
                    gates.extend(shallow.map(|segment| {
                        let is_deep = self.leads_on_along(from, to, segment, area.centre());
                        Gate { segment, is_deep }
                    }));
                }
            }
            let clear = |gate: Gate| {
                self.clear_of_walls(gate.segment).into_iter().map(move |segment| Gate { segment, ..gate })
            };
            gates.into_iter().flat_map(clear).collect()
        })
    }

    /// The parts of a segment from which a room and those behind it go on for so many metres, away from a point.
    fn deep(
        &self,
        room: RoomIndex,
        segment: Segment,
        away_from: Point,
        metres: f64,
        by: Further,
    ) -> Vec<Segment> {
        let rect = self[room].outline.bounds();
        let upright = (segment.a.x - segment.b.x).abs() <= EPSILON;
        let (at, from) = if upright { (segment.a.x, away_from.x) } else { (segment.a.y, away_from.y) };
        let (low, high) = if upright { (rect.x0, rect.x1) } else { (rect.y0, rect.y1) };
        let far = if at > from { high } else { low };
        let depth = (far - at).abs();
        if depth >= metres - EPSILON {
            return vec![segment];
        }
        let line = |p: Point| if upright { Point::new(far, p.y) } else { Point::new(p.x, far) };
        let beyond = Segment { a: line(segment.a), b: line(segment.b) };
        let back = |p: Point| if upright { Point::new(at, p.y) } else { Point::new(p.x, at) };
        let mut parts = Vec::new();
        for exit in self.exits.portals(room).iter().filter(|exit| self.passage(exit.door).is_some()) {
            let Some(door) = self[exit.door].crossing.segment() else { continue };
            let (a, b) = (door.nearest_to(beyond.a), door.nearest_to(beyond.b));
            let on = |p: Point| beyond.nearest_to(p).distance(p) <= EPSILON;
            if on(a) && on(b) && a.distance(b) > EPSILON {
                let further = self.deep(exit.to, Segment { a, b }, away_from, metres - depth, by);
                parts.extend(further.into_iter().map(|part| Segment { a: back(part.a), b: back(part.b) }));
            }
        }
        if by == Further::AllWays {
            let strip = Rect::new(
                segment.a.x.min(beyond.a.x),
                segment.a.y.min(beyond.a.y),
                segment.b.x.max(beyond.b.x),
                segment.b.y.max(beyond.b.y),
            );
            for exit in self.exits.changes(room).iter().filter(|exit| self.passage(exit.door).is_some()) {
                let other = self[exit.to].outline.bounds();
                let (low, high) = if upright { (other.x0, other.x1) } else { (other.y0, other.y1) };
                let is_further = if at > from { high > far + EPSILON } else { low < far - EPSILON };
                let shared =
                    self[exit.door].crossing.area().and_then(|area| area.bounds().intersection(&strip));
                if let Some(shared) = shared.filter(|_| is_further) {
                    let (a, b) = (shared.nearest_to(segment.a), shared.nearest_to(segment.b));
                    let part = Segment { a: back(a), b: back(b) };
                    parts.extend(self.deep(exit.to, part, away_from, metres, by));
                }
            }
        }
        parts
    }

    /// Whether the shallow strip beyond a rim goes on along the rim, where the easier room and those behind it do not.
    fn leads_on_along(&self, easier: RoomIndex, harder: RoomIndex, rim: Segment, inside: Point) -> bool {
        let upright = (rim.a.x - rim.b.x).abs() <= EPSILON;
        let (rect, at) = (self[harder].outline.bounds(), if upright { rim.a.x } else { rim.a.y });
        let is_beyond_high = at > if upright { inside.x } else { inside.y };
        let far = match (upright, is_beyond_high) {
            (true, true) => rect.x1,
            (true, false) => rect.x0,
            (false, true) => rect.y1,
            (false, false) => rect.y0,
        };
        if (far - at).abs() <= EPSILON {
            return false;
        }
        // across the strip, or so far into the easier room, at an end of the rim
        let across = |end: Point, to: f64| {
            let (low, high) = (at.min(to), at.max(to));
            if upright {
                Segment { a: Point::new(low, end.y), b: Point::new(high, end.y) }
            } else {
                Segment { a: Point::new(end.x, low), b: Point::new(end.x, high) }
            }
        };
        let inner = if is_beyond_high { at - THIN_M } else { at + THIN_M };
        [(rim.a, rim.b), (rim.b, rim.a)].into_iter().any(|(end, other)| {
            self.deep(easier, across(end, inner), other, THIN_M, Further::Doors).is_empty()
                && !self.deep(harder, across(end, far), other, DEEP_M, Further::AllWays).is_empty()
        })
    }

    /// The parts of a side of a change's area beyond which the same change is possible; and those beyond which it has
    /// another price, or is shut.
    fn beside(
        &self,
        door: DoorIndex,
        (from, to): (RoomIndex, RoomIndex),
        side: Segment,
    ) -> (Vec<Segment>, Vec<Segment>) {
        let area = &self[door].crossing;
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
            let beside = &self[other].crossing;
            // a change back and forth may lie in the same area
            if is_of_layer && beside != area {
                let (a, b) = (beside.nearest_to(side.a), beside.nearest_to(side.b));
                let on = |p: Point| side.nearest_to(p).distance(p) <= EPSILON;
                if on(a) && on(b) && a.distance(b) > EPSILON {
                    let into = if is_like { &mut alike } else { &mut otherwise };
                    into.push(Segment { a, b });
                }
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
    fn rim(&self, room: RoomIndex, side: Segment) -> Vec<Segment> {
        let rect = self[room].outline.bounds();
        let upright = (side.a.x - side.b.x).abs() <= EPSILON;
        let on = |at: f64, limits: [f64; 2]| limits.iter().any(|limit| (at - limit).abs() <= EPSILON);
        let is_outline =
            if upright { on(side.a.x, [rect.x0, rect.x1]) } else { on(side.a.y, [rect.y0, rect.y1]) };
        if !is_outline || side.length() <= EPSILON {
            return Vec::new();
        }
        let across = |p: Point| if upright { p.x } else { p.y };
        let mut open: Vec<Segment> = Vec::new();
        for exit in self.exits.portals(room) {
            let door = exit.door;
            let Some(segment) = self[door].crossing.segment() else { continue };
            let is_beside = (across(segment.a) - across(side.a)).abs() <= EPSILON
                && (across(segment.b) - across(side.a)).abs() <= EPSILON;
            if is_beside && self.is_free(door) {
                open.push(segment);
            }
        }
        without(side, &open)
    }
}

fn is_same(a: &Rect, b: &Rect) -> bool {
    let pairs = [(a.x0, b.x0), (a.y0, b.y0), (a.x1, b.x1), (a.y1, b.y1)];
    pairs.iter().all(|(a, b)| (a - b).abs() <= EPSILON)
}

pub(super) fn sides(area: &Rect) -> [Segment; 4] {
    let [a, b, c, d] = [
        Point::new(area.x0, area.y0),
        Point::new(area.x1, area.y0),
        Point::new(area.x1, area.y1),
        Point::new(area.x0, area.y1),
    ];
    [Segment { a, b }, Segment { a: b, b: c }, Segment { a: d, b: c }, Segment { a, b: d }]
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
