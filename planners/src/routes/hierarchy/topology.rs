//! What of a hierarchy does not hang on weights: ranks, arcs, and which doors lie under which arc.

use super::order::order;
use crate::geometry::Point;
use crate::routes::parts::RouteDoor;
use crate::search::Csr;

/// No rank, arc or door.
const NONE: u32 = u32::MAX;

/// Rooms by rank, and the arcs between them: where two rooms are joined by rooms of lower rank only, or by a door.
///
/// The rooms that arcs lead up to from a room lie on one chain up to a root, so on its way up a search knows each of them
/// by its level. All rooms that hang below one have ranks next to each other.
#[derive(Debug)]
pub(super) struct Topology {
    pub rank: Vec<u32>,
    /// The room of each rank, by index.
    pub room: Vec<u32>,
    /// For each rank its arcs up, by their heads: the higher ranks, ascending.
    up: Csr<u32>,
    /// For each arc the lower rank.
    pub tails: Vec<u32>,
    /// For each arc the level of its head.
    pub levels: Vec<u32>,
    /// For each arc how many heads from here on lie right above one another, this one included.
    pub runs: Vec<u32>,
    /// For each rank how high it lies: one below the rank that comes next on the chain up; roots lie highest.
    pub level: Vec<u32>,
    /// For each rank the lowest rank of those that hang below it, or its own.
    pub lowest: Vec<u32>,
    /// The arcs that lead up to each rank, those of lower tails first.
    into: Csr<u32>,
    /// For each arc the first of its doors, by index; [`NONE`] where there is none.
    pub first_door: Vec<u32>,
    /// For each door the next one of the same arc, of higher key.
    pub next_door: Vec<u32>,
    /// For each door its arc; [`NONE`] where it leads back into the same room.
    pub arc_of: Vec<u32>,
    /// For each door whether it leads up from its first room.
    pub is_up: Vec<bool>,
    /// How many ways over one rank there are under all arcs.
    pub triangles: usize,
    /// One more than the level of roots.
    pub height: usize,
}

impl Topology {
    pub fn new(at: Vec<Point>, doors: &[RouteDoor]) -> Self {
        let mut joined: Vec<(u32, u32)> = doors
            .iter()
            .map(|door| [door.room1, door.room2].map(|room| room.index() as u32))
            .filter(|[one, two]| one != two)
            .map(|[one, two]| (one.min(two), one.max(two)))
            .collect();
        joined.sort_unstable();
        joined.dedup();
        let room = below_one_another(&order(at, &joined), &joined);
        let rank = inverse(&room);
        let (up, parent) = fill(&lists_up(&rank, &joined));
        let count = room.len();
        let tails: Vec<u32> = (0..count).flat_map(|tail| up.range(tail).map(move |_| tail as u32)).collect();
        let mut depth = vec![0_u32; count];
        for rank in (0..count).rev().filter(|&rank| parent[rank] != NONE) {
            depth[rank] = depth[parent[rank] as usize] + 1;
        }
        let deepest = depth.iter().max().copied().unwrap_or(0);
        let level: Vec<u32> = depth.into_iter().map(|depth| deepest - depth).collect();
        let mut lowest: Vec<u32> = (0..count as u32).collect();
        for rank in (0..count).filter(|&rank| parent[rank] != NONE) {
            let above = parent[rank] as usize;
            lowest[above] = lowest[above].min(lowest[rank]);
        }
        let into = Csr::new(count, (0..).zip(up.items()).map(|(arc, &head)| (head as usize, arc)));
        let levels: Vec<u32> = up.items().iter().map(|&head| level[head as usize]).collect();
        let runs = runs(&tails, &levels);
        let height = deepest as usize + 1;
        let ups = (0..count).map(|rank| up.of(rank).len());
        let triangles = ups.map(|up| up * up.saturating_sub(1) / 2).sum();
        let mut all = Self {
            rank,
            room,
            up,
            tails,
            levels,
            runs,
            level,
            lowest,
            into,
            first_door: Vec::new(),
            next_door: vec![NONE; doors.len()],
            arc_of: vec![NONE; doors.len()],
            is_up: vec![false; doors.len()],
            triangles,
            height,
        };
        all.lay_doors(doors);
        all
    }

    fn lay_doors(&mut self, doors: &[RouteDoor]) {
        self.first_door = vec![NONE; self.tails.len()];
        let mut by_key: Vec<u32> = (0..doors.len() as u32).collect();
        by_key.sort_unstable_by_key(|&door| std::cmp::Reverse(doors[door as usize].door));
        for door in by_key {
            let RouteDoor { room1, room2, .. } = doors[door as usize];
            let (one, two) = (self.rank[room1.index()], self.rank[room2.index()]);
            if let Some(arc) = self.arc(one.min(two), one.max(two)) {
                self.arc_of[door as usize] = arc;
                self.is_up[door as usize] = one < two;
                self.next_door[door as usize] = std::mem::replace(&mut self.first_door[arc as usize], door);
            }
        }
    }

    /// The arcs up from a rank.
    pub fn arcs(&self, rank: u32) -> std::ops::Range<usize> {
        self.up.range(rank as usize)
    }

    /// For each arc the higher rank.
    pub fn heads(&self) -> &[u32] {
        self.up.items()
    }

    /// How many arcs lead up from lower ranks.
    pub fn arcs_before(&self, rank: u32) -> usize {
        self.arcs(rank).start
    }

    /// The arcs that lead up to a rank.
    pub fn arcs_into(&self, rank: u32) -> &[u32] {
        self.into.of(rank as usize)
    }

    /// The arc between two ranks, the lower one first.
    pub fn arc(&self, tail: u32, head: u32) -> Option<u32> {
        let found = self.up.of(tail as usize).binary_search(&head).ok()?;
        Some((self.arcs(tail).start + found) as u32)
    }

    /// The rank next above, where the chain up goes on.
    pub fn parent(&self, rank: u32) -> Option<u32> {
        self.up.of(rank as usize).first().copied()
    }

    /// The doors of an arc, by index, those of lower keys first.
    pub fn doors(&self, arc: u32) -> impl Iterator<Item = u32> + '_ {
        let some = |door: u32| (door != NONE).then_some(door);
        std::iter::successors(some(self.first_door[arc as usize]), move |&door| {
            some(self.next_door[door as usize])
        })
    }
}

fn inverse(room: &[u32]) -> Vec<u32> {
    let mut rank = vec![0; room.len()];
    for (index, &room) in (0..).zip(room) {
        rank[room as usize] = index;
    }
    rank
}

/// For each rank the ranks above that doors join it with, ascending.
fn lists_up(rank: &[u32], joined: &[(u32, u32)]) -> Csr<u32> {
    let ranked = joined.iter().map(|&(one, two)| (rank[one as usize], rank[two as usize]));
    let mut arcs: Vec<(u32, u32)> = ranked.map(|(one, two)| (one.min(two), one.max(two))).collect();
    arcs.sort_unstable();
    Csr::new(rank.len(), arcs.into_iter().map(|(tail, head)| (tail as usize, head)))
}

/// The same order of contraction, but for rooms that do not hang on one another: such that all that hang below a room
/// come right before it.
fn below_one_another(room: &[u32], joined: &[(u32, u32)]) -> Vec<u32> {
    let rank = inverse(room);
    let mut down: Vec<(u32, u32)> = joined
        .iter()
        .map(|&(one, two)| (rank[one as usize], rank[two as usize]))
        .map(|(one, two)| (one.max(two), one.min(two)))
        .collect();
    down.sort_unstable();
    // each rank's parent is the lowest rank above that something below it leads to (Liu 1990)
    let mut parent = vec![NONE; room.len()];
    let mut top: Vec<u32> = (0..room.len() as u32).collect();
    for (head, tail) in down {
        let mut at = tail;
        while top[at as usize] != at {
            let next = top[at as usize];
            top[at as usize] = top[next as usize];
            at = top[at as usize];
        }
        if at != head {
            parent[at as usize] = head;
            top[at as usize] = head;
        }
    }
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); room.len()];
    let mut waiting: Vec<u32> = Vec::new();
    for (rank, &above) in (0..).zip(&parent) {
        match below.get_mut(above as usize) {
            Some(below) => below.push(rank),
            None => waiting.push(rank),
        }
    }
    // from the last one back: a rank, then all below it
    let mut ordered = Vec::with_capacity(room.len());
    while let Some(rank) = waiting.pop() {
        ordered.push(room[rank as usize]);
        waiting.extend(&below[rank as usize]);
    }
    ordered.reverse();
    ordered
}

/// All arcs: a rank leads up to where doors lead from it, and to where those lead that hang below it.
/// With them for each rank the lowest one above that it leads to.
fn fill(up: &Csr<u32>) -> (Csr<u32>, Vec<u32>) {
    let count = up.len();
    let mut filled = Csr::default();
    let mut parent = vec![NONE; count];
    let mut seen = vec![NONE; count];
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); count];
    for rank in 0..count {
        let mut heads = Vec::new();
        seen[rank] = rank as u32;
        let mut take = |heads: &mut Vec<u32>, head: u32| {
            if std::mem::replace(&mut seen[head as usize], rank as u32) != rank as u32 {
                heads.push(head);
            }
        };
        for &head in up.of(rank) {
            take(&mut heads, head);
        }
        for child in std::mem::take(&mut below[rank]) {
            for &head in filled.of(child as usize) {
                take(&mut heads, head);
            }
        }
        heads.sort_unstable();
        if let Some(&above) = heads.first() {
            parent[rank] = above;
            below[above as usize].push(rank as u32);
        }
        filled.push(heads);
    }
    (filled, parent)
}

fn runs(tails: &[u32], levels: &[u32]) -> Vec<u32> {
    let mut runs = vec![1; tails.len()];
    for arc in (1..tails.len()).rev() {
        if tails[arc - 1] == tails[arc] && levels[arc - 1] + 1 == levels[arc] {
            runs[arc - 1] = runs[arc] + 1;
        }
    }
    runs
}
