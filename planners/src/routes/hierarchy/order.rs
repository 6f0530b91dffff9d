//! In which order rooms are contracted: those that part the floor last.
//!
//! A nested dissection. Rooms are swept in six directions, four straight ones and two along the doors; of all places
//! where a sweep can halt, the one is taken whose front has the fewest rooms for the balance of what lies on both sides.
//! On grids of rooms this leaves two thirds of the arcs that flow cuts (crate `cch`) leave, in a third of their time.

use crate::geometry::Point;
use crate::search::Csr;

/// The share of rooms that lies on the smaller side at least.
const SMALLER_SIDE: f64 = 0.3;

/// Of halts with as many rooms in front, the one that parts the rooms more evenly counts so much less.
const EVENLY: f64 = 1e-3;

/// Parts with fewer rooms are not worth a task of their own.
const TASK: usize = 2_000;

/// A part of the floor, with rooms numbered from 0.
struct Part {
    /// What the rooms are called outside.
    names: Vec<u32>,
    at: Vec<Point>,
    neighbours: Csr<u32>,
}

struct Halt {
    /// Rooms of the front, more where the sides are out of balance.
    price: f64,
    /// Rooms in the order of the sweep.
    swept: Vec<u32>,
    passed: usize,
    /// Whether the front is taken from the rooms passed.
    is_behind: bool,
}

/// The rooms, by index, in the order of contraction.
///
/// # Arguments
/// `at` is where each room lies; `joined` are pairs of rooms with a door between them, each pair once.
pub(super) fn order(at: Vec<Point>, joined: &[(u32, u32)]) -> Vec<u32> {
    let names = (0..at.len() as u32).collect();
    Part::new(names, at, joined).dissected()
}

impl Part {
    fn new(names: Vec<u32>, at: Vec<Point>, joined: &[(u32, u32)]) -> Self {
        let both = joined.iter().flat_map(|&(one, two)| [(one as usize, two), (two as usize, one)]);
        let neighbours = Csr::new(names.len(), both);
        Self { names, at, neighbours }
    }

    fn neighbours(&self, room: u32) -> &[u32] {
        self.neighbours.of(room as usize)
    }

    /// Its rooms, by their names outside: first both sides, then the front between them.
    fn dissected(self) -> Vec<u32> {
        if self.names.len() <= 2 {
            return self.names;
        }
        let Some(halt) = self.best_halt() else { return self.names };
        let (sides, front) = self.cut(&halt);
        let is_task = self.names.len() >= TASK;
        drop(self);
        let [one, two] = sides;
        let (mut all, other) = if is_task {
            rayon::join(|| one.dissected(), || two.dissected())
        } else {
            (one.dissected(), two.dissected())
        };
        all.extend(other);
        all.extend(front);
        all
    }

    fn best_halt(&self) -> Option<Halt> {
        let along = |key: &dyn Fn(Point) -> (f64, f64)| {
            let keys: Vec<(f64, f64)> = self.at.iter().map(|&at| key(at)).collect();
            let mut rooms: Vec<u32> = (0..self.names.len() as u32).collect();
            rooms.sort_unstable_by(|&one, &two| {
                let (a, b) = (keys[one as usize], keys[two as usize]);
                a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(one.cmp(&two))
            });
            rooms
        };
        let mut best: Option<Halt> = None;
        let mut try_sweep = |swept: Vec<u32>| {
            let halt = self.halt(swept);
            if best.as_ref().is_none_or(|best| halt.price < best.price) {
                best = Some(halt);
            }
        };
        for key in [
            (&|at: Point| (at.x, at.y)) as &dyn Fn(Point) -> (f64, f64),
            &|at| (at.y, at.x),
            &|at| (at.x + at.y, at.x),
            &|at| (at.x - at.y, at.x),
        ] {
            let swept = along(key);
            // where walls stand in the way, what is near is not near along the doors
            let from = swept[0];
            try_sweep(swept);
            if self.names.len() > 16 {
                try_sweep(self.by_doors(from));
            }
        }
        best
    }

    /// The rooms by how many doors lie between them and one of them.
    fn by_doors(&self, from: u32) -> Vec<u32> {
        let mut is_seen = vec![false; self.names.len()];
        let mut rooms = Vec::with_capacity(self.names.len());
        for first in std::iter::once(from).chain(0..self.names.len() as u32) {
            if std::mem::replace(&mut is_seen[first as usize], true) {
                continue;
            }
            let mut at = rooms.len();
            rooms.push(first);
            while let Some(&room) = rooms.get(at) {
                at += 1;
                for &next in self.neighbours(room) {
                    if !std::mem::replace(&mut is_seen[next as usize], true) {
                        rooms.push(next);
                    }
                }
            }
        }
        rooms
    }

    fn halt(&self, swept: Vec<u32>) -> Halt {
        let count = swept.len();
        let mut turn = vec![0_usize; count];
        for (index, &room) in swept.iter().enumerate() {
            turn[room as usize] = index;
        }
        // by how many the front grows, behind and ahead, when so many rooms have been passed
        let (mut behind, mut ahead) = (vec![0_i64; count + 2], vec![0_i64; count + 2]);
        for (index, &room) in swept.iter().enumerate() {
            let turns = || self.neighbours(room).iter().map(|&next| turn[next as usize]);
            let first = turns().min().unwrap_or(index).min(index);
            let last = turns().max().unwrap_or(index).max(index);
            behind[index + 1] += 1;
            behind[last + 1] -= 1;
            ahead[first + 1] += 1;
            ahead[index + 1] -= 1;
        }
        let margin = ((count as f64 * SMALLER_SIDE) as usize).clamp(1, count / 2);
        let (mut fronts, mut best) = ((0, 0), (f64::INFINITY, count / 2, true));
        for passed in 0..=count - margin {
            fronts = (fronts.0 + behind[passed], fronts.1 + ahead[passed]);
            if passed < margin {
                continue;
            }
            let smaller = passed.min(count - passed) as f64 / count as f64;
            let front = fronts.0.min(fronts.1) as f64;
            let price = front * (1.5 - smaller) - smaller * EVENLY;
            if price < best.0 {
                best = (price, passed, fronts.0 <= fronts.1);
            }
        }
        Halt { price: best.0, swept, passed: best.1, is_behind: best.2 }
    }

    /// What lies on both sides of the front, and the front.
    fn cut(&self, halt: &Halt) -> ([Self; 2], Vec<u32>) {
        let mut is_passed = vec![false; self.names.len()];
        for &room in &halt.swept[..halt.passed] {
            is_passed[room as usize] = true;
        }
        let is_front = |room: u32| {
            let side = is_passed[room as usize];
            side == halt.is_behind
                && self.neighbours(room).iter().any(|&next| is_passed[next as usize] != side)
        };
        let fronts: Vec<bool> = (0..self.names.len() as u32).map(is_front).collect();
        let side = |is_first: bool| {
            let mut number = vec![u32::MAX; self.names.len()];
            let mut rooms = Vec::new();
            for room in 0..self.names.len() {
                if is_passed[room] == is_first && !fronts[room] {
                    number[room] = rooms.len() as u32;
                    rooms.push(room as u32);
                }
            }
            let mut joined = Vec::new();
            for &room in &rooms {
                let lower = self.neighbours(room).iter().filter(|&&next| next > room);
                let within = lower.filter(|&&next| number[next as usize] != u32::MAX);
                joined.extend(within.map(|&next| (number[room as usize], number[next as usize])));
            }
            let names = rooms.iter().map(|&room| self.names[room as usize]).collect();
            let at = rooms.iter().map(|&room| self.at[room as usize]).collect();
            Self::new(names, at, &joined)
        };
        ([side(true), side(false)], self.along(&fronts))
    }

    /// The rooms of a front from one of its ends to the other: neighbours get ranks next to each other.
    fn along(&self, fronts: &[bool]) -> Vec<u32> {
        let mut rooms: Vec<usize> = (0..self.names.len()).filter(|&room| fronts[room]).collect();
        let extent = |of: fn(&Point) -> f64| {
            let all = || rooms.iter().map(|&room| of(&self.at[room]));
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        let is_wide = extent(|at| at.x) >= extent(|at| at.y);
        let key = |room: usize| {
            let at = self.at[room];
            if is_wide { (at.x, at.y) } else { (at.y, at.x) }
        };
        rooms.sort_unstable_by(|&one, &two| {
            let (a, b) = (key(one), key(two));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(one.cmp(&two))
        });
        rooms.into_iter().map(|room| self.names[room]).collect()
    }
}
