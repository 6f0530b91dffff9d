//! Which free rectangles are the channels.

use super::free::FreeSpace;
use crate::channels::assembly::Cuboid;
use crate::channels::assembly::chain::is_bend;

/// How good a chain is, down to the rectangle that it has come to.
#[derive(Clone, Copy)]
struct Chain {
    /// Junctions that are not larger than the part.
    tight: usize,
    channels: usize,
    /// What the tightest junction leaves around the part.
    room: f64,
    before: Option<usize>,
}

impl Chain {
    fn is_better_than(&self, other: &Self) -> bool {
        let order = (self.tight, self.channels).cmp(&(other.tight, other.channels));
        order.then(other.room.total_cmp(&self.room)).is_lt()
    }
}

/// A rectangle in the role of a channel along an axis.
type Role = usize;

/// The best chain from the top to a rectangle that holds the part (Dijkstra): along z and along x in turn.
pub(super) fn best_chain(free: &FreeSpace, part: &Cuboid<2>) -> Option<Vec<Cuboid<2>>> {
    let count = free.rects.len();
    // Roles along z come first, then those along x, each in the order of the rectangles.
    let rect = |role: Role| &free.rects[role % count];
    let mouth = Chain { tight: 0, channels: 1, room: f64::INFINITY, before: None };
    let starts = free.rects.iter().map(|rect| (rect.max[1] >= free.frame.max[1]).then_some(mouth));
    let mut best: Vec<Option<Chain>> = starts.chain(std::iter::repeat_n(None, count)).collect();
    let mut done = vec![false; 2 * count];
    loop {
        let open = (0..2 * count).filter(|&role| !done[role]);
        let chains = open.filter_map(|role| Some((role, best[role]?)));
        let (role, chain) = chains.reduce(|a, b| if b.1.is_better_than(&a.1) { b } else { a })?;
        if free.holds(rect(role), part) {
            return Some(followed_back(role, &best).into_iter().map(|role| *rect(role)).collect());
        }
        done[role] = true;
        let (axes, others) = if role < count { ([1, 0], count..2 * count) } else { ([0, 1], 0..count) };
        for next in others {
            if done[next] || !is_bend([rect(role), rect(next)], axes, free.tolerance) {
                continue;
            }
            let Some(junction) = rect(role).intersection(rect(next)) else { continue };
            let room =
                (0..2).map(|axis| (junction.size(axis) - part.size(axis)) / 2.0).fold(chain.room, f64::min);
            let is_tight = (0..2).any(|axis| junction.size(axis) <= part.size(axis));
            let longer = Chain {
                tight: chain.tight + usize::from(is_tight),
                channels: chain.channels + 1,
                room,
                before: Some(role),
            };
            if best[next].is_none_or(|known| longer.is_better_than(&known)) {
                best[next] = Some(longer);
            }
        }
    }
}

fn followed_back(role: Role, best: &[Option<Chain>]) -> Vec<Role> {
    let before = |&role: &Role| best[role].and_then(|chain| chain.before);
    let mut roles: Vec<Role> = std::iter::successors(Some(role), before).collect();
    roles.reverse();
    roles
}
