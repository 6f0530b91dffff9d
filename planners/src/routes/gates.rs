//! Where a change of shape can pay: on the rim of the free space of the easier state.

use super::cone::Segment;
use super::mesh::EPSILON;
use super::{RouteGraph, Walking};
use crate::geometry::{Point, Rect};

impl RouteGraph {
    /// The segments on which the change `door` is begun from the room `from`.
    ///
    /// As long as the easier state has room, nobody leaves it, and as soon as it has, everybody takes it: so a shape
    /// is changed where the easier of the two rooms ends and none like it follows. And where the area in which it
    /// can be changed at this price ends though both rooms go on.
    pub(super) fn gates(&self, door: usize, from: usize) -> &[Segment] {
        let RouteDoorSides { to, side } = self.sides(door, from);
        self.gates[door][side].get_or_init(|| {
            let (easier, harder) = if self.per_m(to) >= self.per_m(from) { (from, to) } else { (to, from) };
            let mut gates = Vec::new();
            for side in sides(&self.doors()[door].crossing) {
                let rim = self.rim(easier, side);
                let mut known = self.rim(harder, side);
                known.extend(rim.iter().copied());
                known.extend(self.beside(door, (from, to), side));
                gates.extend(rim);
                gates.extend(without(side, &known));
            }
            gates.into()
        })
    }

    /// The parts of a side of a change's area beyond which the same change is possible.
    fn beside(&self, door: usize, (from, to): (usize, usize), side: Segment) -> Vec<Segment> {
        let area = self.doors()[door].crossing;
        let weight = self.passage(door);
        let free = self.mesh.portals.of(from).iter().filter(|exit| self.is_free(exit.door as usize));
        let rooms = std::iter::once(from).chain(free.map(|exit| exit.to as usize));
        let mut found = Vec::new();
        for exit in rooms.flat_map(|room| self.mesh.changes.of(room)) {
            let (other, room) = (exit.door as usize, exit.to as usize);
            let is_like = other != door
                && self.mesh.layer[room] == self.mesh.layer[to]
                && self.per_m(room).to_bits() == self.per_m(to).to_bits()
                && self.passage(other) == weight;
            let beside = &self.doors()[other].crossing;
            // a change back and forth may lie in the same area
            if is_like && beside != &area {
                let (a, b) = (beside.nearest_to(side.a), beside.nearest_to(side.b));
                let on = |p: Point| side.nearest_to(p).distance(p) <= EPSILON;
                if on(a) && on(b) && a.distance(b) > EPSILON {
                    found.push(Segment { a, b });
                }
            }
        }
        found
    }

    fn sides(&self, door: usize, from: usize) -> RouteDoorSides {
        let door = &self.doors()[door];
        if door.room1 == from {
            RouteDoorSides { to: door.room2, side: 0 }
        } else {
            RouteDoorSides { to: door.room1, side: 1 }
        }
    }

    /// The parts of a segment on a room's outline beyond which none like it follows.
    fn rim(&self, room: usize, side: Segment) -> Vec<Segment> {
        let rect = &self.rooms()[room].rect;
        let upright = (side.a.x - side.b.x).abs() <= EPSILON;
        let on = |at: f64, limits: [f64; 2]| limits.iter().any(|limit| (at - limit).abs() <= EPSILON);
        let is_outline =
            if upright { on(side.a.x, [rect.x0, rect.x1]) } else { on(side.a.y, [rect.y0, rect.y1]) };
        if !is_outline || side.length() <= EPSILON {
            return Vec::new();
        }
        let across = |p: Point| if upright { p.x } else { p.y };
        let mut open: Vec<Segment> = Vec::new();
        for exit in self.mesh.portals.of(room) {
            let door = exit.door as usize;
            let segment = Segment::of(&self.doors()[door].crossing);
            let is_beside = (across(segment.a) - across(side.a)).abs() <= EPSILON
                && (across(segment.b) - across(side.a)).abs() <= EPSILON;
            if is_beside && self.is_free(door) {
                open.push(segment);
            }
        }
        without(side, &open)
    }

    /// Whether a door can be passed for nothing, between rooms of equal hardness.
    pub(super) fn is_free(&self, door: usize) -> bool {
        let (one, two) = (self.doors()[door].room1, self.doors()[door].room2);
        !self.doors()[door].one_way
            && self.passage(door) == Some(0.0)
            && self.per_m(one).to_bits() == self.per_m(two).to_bits()
    }

    /// Hardness of a metre; 0 where all hardness lies on the doors, infinite where no route enters.
    pub(super) fn per_m(&self, room: usize) -> f64 {
        match self.rooms()[room].walking {
            Walking::OnDoors => 0.0,
            Walking::PerMetre(hardness) => hardness,
            Walking::Unknown => f64::INFINITY,
        }
    }

    /// Whether a route may enter the room.
    pub(super) fn is_entered(&self, room: usize) -> bool {
        self.rooms()[room].walking != Walking::Unknown
    }

    /// What passing a door weighs, where it can be passed.
    pub(super) fn passage(&self, door: usize) -> Option<f64> {
        let of = &self.doors()[door];
        of.weight().filter(|_| self.is_entered(of.room1) && self.is_entered(of.room2))
    }

    /// The least hardness of a metre in a room that may be entered.
    pub(super) fn least_per_m(&self) -> f64 {
        let all = (0..self.rooms().len()).map(|room| self.per_m(room));
        let least = all.fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    }
}

struct RouteDoorSides {
    to: usize,
    side: usize,
}

fn sides(area: &Rect) -> [Segment; 4] {
    let [a, b, c, d] = [
        Point::new(area.x0, area.y0),
        Point::new(area.x1, area.y0),
        Point::new(area.x1, area.y1),
        Point::new(area.x0, area.y1),
    ];
    [Segment { a, b }, Segment { a: b, b: c }, Segment { a: d, b: c }, Segment { a, b: d }]
}

/// The parts of an axis-parallel segment that none of some others on its line covers.
fn without(side: Segment, others: &[Segment]) -> Vec<Segment> {
    let upright = (side.a.x - side.b.x).abs() <= EPSILON;
    let along = |p: Point| if upright { p.y } else { p.x };
    let ends = |segment: &Segment| {
        let (a, b) = (along(segment.a), along(segment.b));
        (a.min(b), a.max(b))
    };
    let (low, high) = ends(&side);
    let mut covered: Vec<(f64, f64)> = others.iter().map(ends).collect();
    covered.sort_by(|one, two| one.0.total_cmp(&two.0));
    let at = |along: f64| if upright { Point::new(side.a.x, along) } else { Point::new(along, side.a.y) };
    let mut rest = Vec::new();
    let mut from = low;
    for (begins, ends) in covered.into_iter().chain([(high, high)]) {
        let to = begins.min(high);
        if to - from > EPSILON {
            rest.push(Segment { a: at(from), b: at(to) });
        }
        from = from.max(ends);
    }
    rest
}
