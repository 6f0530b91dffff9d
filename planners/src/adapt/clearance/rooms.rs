//! Free room about an object, found by where a link is.

use smallvec::{SmallVec, smallvec};

use crate::adapt::robot::Link;
use crate::geometry::{Point, Segment};

/// Rooms that are known to be free, in a tree: those of a node lie about one segment, and how far the widest of them comes
/// from there bounds what any of them can give. A search goes on where that is most (branch and bound).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rooms(Vec<Node>);

/// Everything nearer to a segment than so many metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    axis: Axis,
    within_m: f64,
}

/// A segment, made ready for many questions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    segment: Segment,
    along: Point,
    /// One over the square of its length; 0 where it is a point.
    per_square: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    about: Axis,
    /// No point of its rooms is farther from there, metres.
    reach_m: f64,
    inside: Inside,
}

#[derive(Clone, Debug, PartialEq)]
enum Inside {
    Rooms(Vec<Room>),
    Halves([usize; 2]),
}

/// So many rooms are looked at one by one.
const FEW: usize = 12;

impl Axis {
    fn new(segment: Segment) -> Self {
        let along = segment.b - segment.a;
        let square = along.dot(along);
        Self { segment, along, per_square: if square > 0.0 { 1.0 / square } else { 0.0 } }
    }

    fn squared(&self, p: Point) -> f64 {
        let out = p - self.segment.a;
        let off = out - self.along * (out.dot(self.along) * self.per_square).clamp(0.0, 1.0);
        off.dot(off)
    }

    /// Square of the distance of the farther end of a segment, which no point of that exceeds.
    fn farther_squared(&self, segment: &Segment) -> f64 {
        self.squared(segment.b).max(self.squared(segment.a))
    }

    /// How far the ends of a segment are from its own.
    fn apart_squared(&self, segment: &Segment) -> f64 {
        let Segment { a, b } = self.segment;
        a.squared_distance(segment.a).max(b.squared_distance(segment.b))
    }
}

impl Room {
    /// By how many metres the room exceeds a link. It is convex, so what holds both ends of the link holds all of it.
    pub fn slack(&self, link: &Link) -> f64 {
        self.within_m - link.radius - self.axis.farther_squared(&link.axis).sqrt()
    }
}

impl Node {
    fn of(rooms: Vec<Room>) -> Self {
        let count = rooms.len() as f64;
        let mean = |end: fn(&Segment) -> Point| {
            rooms.iter().fold(Point::default(), |sum, room| sum + end(&room.axis.segment)) * (1.0 / count)
        };
        let about = Axis::new(Segment::new(mean(|axis| axis.a), mean(|axis| axis.b)));
        let mut node = Self { about, reach_m: 0.0, inside: Inside::Rooms(Vec::new()) };
        for room in &rooms {
            node.stretch(room);
        }
        node.inside = Inside::Rooms(rooms);
        node
    }

    fn stretch(&mut self, room: &Room) {
        let off = self.about.farther_squared(&room.axis.segment).sqrt();
        self.reach_m = self.reach_m.max(off + room.within_m);
    }

    /// No room in it exceeds an axis by more metres.
    fn bound(&self, axis: &Segment) -> f64 {
        self.reach_m - self.about.farther_squared(axis).sqrt()
    }
}

impl Rooms {
    pub fn put(&mut self, axis: Segment, within_m: f64) {
        let room = Room { axis: Axis::new(axis), within_m };
        if self.0.is_empty() {
            self.0.push(Node::of(vec![room]));
            return;
        }
        let mut at = 0;
        loop {
            self.0[at].stretch(&room);
            match &mut self.0[at].inside {
                Inside::Halves([one, other]) => {
                    let (one, other) = (*one, *other);
                    let apart = |half: usize| self.0[half].about.apart_squared(&axis);
                    at = if apart(one) <= apart(other) { one } else { other };
                }
                Inside::Rooms(rooms) => {
                    rooms.push(room);
                    if rooms.len() > FEW {
                        let rooms = std::mem::take(rooms);
                        self.halve(at, rooms);
                    }
                    return;
                }
            }
        }
    }

    /// Parts the rooms of a node where their ends lie farthest apart.
    fn halve(&mut self, at: usize, mut rooms: Vec<Room>) {
        const ENDS: [fn(&Room) -> f64; 4] = [
            |room| room.axis.segment.a.x,
            |room| room.axis.segment.a.y,
            |room| room.axis.segment.b.x,
            |room| room.axis.segment.b.y,
        ];
        let wide = |of: &fn(&Room) -> f64| {
            let (low, high) = rooms
                .iter()
                .map(of)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
            high - low
        };
        let widest = ENDS.into_iter().max_by(|one, other| wide(one).total_cmp(&wide(other)));
        let of = widest.unwrap_or(ENDS[0]);
        rooms.sort_by(|one, other| of(one).total_cmp(&of(other)));
        let rest = rooms.split_off(rooms.len() / 2);
        let halves = [self.0.len(), self.0.len() + 1];
        self.0.extend([Node::of(rooms), Node::of(rest)]);
        self.0[at].inside = Inside::Halves(halves);
    }

    /// The room that exceeds a link by most metres, and by how many, or any that exceeds it by `enough`; `None` where none
    /// holds its axis.
    pub fn widest(&self, link: &Link, enough: f64) -> Option<(f64, &Room)> {
        let (mut best, mut most) = (None, 0.0);
        let mut left: SmallVec<[(f64, usize); 32]> = smallvec![(f64::INFINITY, 0)];
        while let Some((bound, at)) = left.pop() {
            if bound <= most {
                continue;
            }
            match self.0.get(at).map(|node| &node.inside) {
                Some(Inside::Halves(halves)) => {
                    let [one, other] = halves.map(|half| (self.0[half].bound(&link.axis), half));
                    left.extend(if one.0 <= other.0 { [one, other] } else { [other, one] });
                }
                Some(Inside::Rooms(rooms)) => {
                    for room in rooms {
                        let room_left = room.within_m - most;
                        // The outer end of a link is mostly the one that a room does not hold.
                        let outer = room.axis.squared(link.axis.b);
                        if room_left <= 0.0 || outer >= room_left * room_left {
                            continue;
                        }
                        let squared = outer.max(room.axis.squared(link.axis.a));
                        if squared < room_left * room_left {
                            most = room.within_m - squared.sqrt();
                            best = Some(room);
                            if most >= enough + link.radius {
                                return Some((most - link.radius, room));
                            }
                        }
                    }
                }
                None => {}
            }
        }
        best.map(|room| (most - link.radius, room))
    }

    /// The segments, and how near to them everything is free.
    pub fn all(&self) -> impl Iterator<Item = (Segment, f64)> + '_ {
        let rooms = self.0.iter().flat_map(|node| match &node.inside {
            Inside::Rooms(rooms) => rooms.as_slice(),
            Inside::Halves(_) => &[],
        });
        rooms.map(|room| (room.axis.segment, room.within_m))
    }
}
