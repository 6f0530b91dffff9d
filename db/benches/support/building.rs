//! The synthetic multi-storey building of the routing peers (their gen.py), made anew: corridors, rooms on both sides,
//! stairs and lifts, 2.4 doors a room.

use super::graph::{Edge, Graph};

const SIDE_DOORS: f64 = 0.33;
const ONE_WAY: f64 = 0.03;

/// A building of 1,000 rooms on 2 storeys, 10,000 on 5, more on 10.
pub fn building(rooms: usize) -> Graph {
    let storeys = match rooms {
        0..=2_000 => 2,
        2_001..=10_000 => 5,
        _ => 10,
    };
    let per = rooms / storeys;
    let width = 20.max((per as f64).sqrt().round() as usize);
    let mut chance = Chance(20_240_607 + rooms as u64);
    let place = |room: usize| (room % per % width, room % per / width);
    let corridor = |room: usize| place(room).1 % 3 == 1 || place(room).0.is_multiple_of(20);
    let mut edges = Vec::new();
    for room in 0..rooms {
        let (x, y) = place(room);
        let right = room + 1;
        if x + 1 < width && room % per + 1 < per {
            if corridor(room) && corridor(right) {
                edges.push(edge(room, right, chance.within(1, 3)));
            } else if chance.unit() < SIDE_DOORS {
                let one_way = !(corridor(room) || corridor(right)) && chance.unit() < ONE_WAY;
                edges.push(Edge { one_way, ..edge(room, right, chance.within(2, 16)) });
            }
        }
        let down = room + width;
        if room % per + width < per && (corridor(room) || corridor(down)) {
            let both = corridor(room) && corridor(down);
            edges.push(edge(room, down, chance.within(1, if both { 3 } else { 11 })));
        }
        if room + per < rooms && x.is_multiple_of(40) && y % 12 == 1 {
            edges.push(edge(room, room + per, if x.is_multiple_of(80) { 6.0 } else { 12.0 }));
        }
    }
    let loose = loose_ends(rooms, &edges, width);
    edges.extend(loose);
    Graph { rooms, edges }
}

fn edge(a: usize, b: usize, hardness: f64) -> Edge {
    Edge { a, b, hardness, one_way: false }
}

/// Doors that join what is left apart to the room above, or to the left.
fn loose_ends(rooms: usize, edges: &[Edge], width: usize) -> Vec<Edge> {
    let mut parts = Parts((0..rooms).collect());
    for edge in edges.iter().filter(|edge| !edge.one_way) {
        parts.join(edge.a, edge.b);
    }
    let mut joined = Vec::new();
    for room in 1..rooms {
        let other = if room >= width { room - width } else { room - 1 };
        if parts.of(room) != parts.of(0) && parts.of(room) != parts.of(other) {
            parts.join(room, other);
            joined.push(edge(other, room, 5.0));
        }
    }
    joined
}

struct Parts(Vec<usize>);

impl Parts {
    fn of(&mut self, mut room: usize) -> usize {
        while self.0[room] != room {
            self.0[room] = self.0[self.0[room]];
            room = self.0[room];
        }
        room
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// Steele's `SplitMix64`: the same building on each machine.
pub struct Chance(pub u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, low: u64, below: u64) -> f64 {
        (low + self.next() % (below - low)) as f64
    }

    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }
}
