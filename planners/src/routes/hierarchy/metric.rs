//! What the arcs of a hierarchy weigh, both ways, and over what.

use std::cmp::Ordering;

use super::topology::Topology;

/// The arc weighs what its easiest door weighs; any other number is one more than the rank that the way leads down to.
pub(super) const BY_DOOR: u32 = 0;

/// What a way weighs, and over what it leads. Of ways that weigh the same the one over the lowest rank counts, a door
/// before all; so what is kept does not hang on the order in which it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Over {
    pub weight: f64,
    pub over: u32,
}

impl Over {
    /// Whether this one counts rather than the other.
    pub fn is_better(self, than: Self) -> bool {
        match self.weight.total_cmp(&than.weight) {
            Ordering::Less => true,
            Ordering::Equal => self.over < than.over,
            Ordering::Greater => false,
        }
    }
}

/// What the arcs weigh.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Metric {
    /// For each door what passing it weighs, from its first room and from its second.
    pub passing: Vec<[f64; 2]>,
    /// For each arc what leads up it weighs.
    pub up: Vec<f64>,
    /// For each arc what leads down it weighs.
    pub down: Vec<f64>,
    /// For each arc over what the ways up and down lead.
    pub over: Vec<[u32; 2]>,
}

impl Metric {
    /// What weighs nothing yet.
    pub fn new(topology: &Topology, passing: Vec<[f64; 2]>) -> Self {
        let arcs = topology.tails.len();
        let (up, down) = (vec![f64::INFINITY; arcs], vec![f64::INFINITY; arcs]);
        let mut metric = Self { passing, up, down, over: vec![[BY_DOOR; 2]; arcs] };
        metric.customize(topology);
        metric
    }

    /// The easiest door of an arc, by index; of several the one with the lowest key.
    pub fn door(&self, topology: &Topology, arc: u32, is_up: bool) -> Option<u32> {
        let mut doors = topology.doors(arc);
        let first = doors.next()?;
        Some(doors.fold(first, |best, door| {
            let [weight, known] = [door, best].map(|door| self.passed(topology, door, is_up));
            if weight < known { door } else { best }
        }))
    }

    /// What passing a door weighs, up or down its arc.
    pub fn passed(&self, topology: &Topology, door: u32, is_up: bool) -> f64 {
        let is_first = topology.is_up[door as usize] == is_up;
        self.passing[door as usize][usize::from(!is_first)]
    }

    /// What an arc weighs, up and down.
    pub fn get(&self, arc: u32) -> [Over; 2] {
        let [up, down] = self.over[arc as usize];
        [
            Over { weight: self.up[arc as usize], over: up },
            Over { weight: self.down[arc as usize], over: down },
        ]
    }

    pub fn set(&mut self, arc: u32, [up, down]: [Over; 2]) {
        (self.up[arc as usize], self.down[arc as usize]) = (up.weight, down.weight);
        self.over[arc as usize] = [up.over, down.over];
    }
}

/// What an arc's doors weigh, up and down.
pub(super) fn by_doors(passing: &[[f64; 2]], topology: &Topology, arc: u32) -> [f64; 2] {
    let mut least = [f64::INFINITY; 2];
    for door in topology.doors(arc) {
        let [first, second] = passing[door as usize];
        let (up, down) = if topology.is_up[door as usize] { (first, second) } else { (second, first) };
        least = [least[0].min(up), least[1].min(down)];
    }
    least
}
