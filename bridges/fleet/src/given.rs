//! The order that a vehicle has: its base, which it will drive, and its horizon, which may still change.

use serde_json::Value;

use crate::site::Fleet;
use crate::way::{SAME, Stop, distance};
use crate::wire::{Action, Blocking, Edge, Node, Order};

/// An order as it was sent last.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    pub id: String,
    pub update: u32,
    pub goal: String,
    pub stops: Vec<Stop>,
    /// How many stops are released.
    pub released: usize,
    /// The stop with which the last message began.
    stitch: usize,
    /// The map and the robot of the vehicle.
    map: String,
    robot: String,
}

impl Given {
    /// A new order along a way, with its first base.
    pub fn new(id: String, goal: String, (map, robot): (String, String), stops: Vec<Stop>) -> Self {
        let stops = with_changes_apart(stops);
        let mut given = Self { id, update: 0, goal, stops, released: 1, stitch: 0, map, robot };
        given.release();
        given
    }

    /// Where the base ends.
    pub fn base_end(&self) -> &Stop {
        &self.stops[self.released - 1]
    }

    /// Whether all of it is released.
    pub fn is_whole(&self) -> bool {
        self.released == self.stops.len()
    }

    /// Releases what lies before the next doorway.
    fn release(&mut self) {
        let ahead = &self.stops[self.released..];
        let wait = ahead.iter().position(|stop| stop.is_wait);
        self.released += wait.map_or(ahead.len(), |wait| wait + 1);
    }

    /// An update with another horizon, where there is one, and with more of it released, where it shall be; whether there is
    /// anything to say.
    pub fn updated(&mut self, way: Option<Vec<Stop>>, goal: &str, more: bool) -> bool {
        let stitch = self.released - 1;
        let horizon = way.map(|way| continued(&self.stops[stitch], way));
        let is_other =
            horizon.as_ref().is_some_and(|horizon| !is_same(horizon, &self.stops[self.released..]));
        if let Some(horizon) = horizon.filter(|_| is_other) {
            self.stops.truncate(self.released);
            self.stops.extend(horizon);
        }
        goal.clone_into(&mut self.goal);
        let grows = more && !self.is_whole();
        if grows {
            self.release();
        }
        if !is_other && !grows {
            return false;
        }
        self.stitch = stitch;
        self.update += 1;
        true
    }

    /// The stop that the vehicle says it has reached; `None` where that is none that was released to it.
    pub fn reached(&self, sequence: u32, node: &str) -> Option<usize> {
        let index = sequence as usize / 2;
        let stop = self.stops[..self.released].get(index)?;
        (sequence.is_multiple_of(2) && stop.id == node).then_some(index)
    }

    /// Metres from a point to the end of the base, by the stops after the one that was reached.
    pub fn left(&self, reached: usize, from: [f64; 2]) -> f64 {
        let mut at = from;
        let ahead = self.stops[..self.released].iter().skip(reached + 1);
        ahead.map(|stop| distance(std::mem::replace(&mut at, stop.at), stop.at)).sum()
    }

    /// In which direction the way has led on from a point after so many metres, radians; what it does nearer by says nothing of
    /// what is ahead.
    pub fn heading(&self, reached: usize, from: [f64; 2], metres: f64) -> Option<f64> {
        let (mut at, mut left) = (from, metres);
        for stop in self.stops.iter().skip(reached + 1) {
            let leg = distance(at, stop.at);
            if leg >= left {
                let share = left / leg;
                at = [0, 1].map(|axis| at[axis] + share * (stop.at[axis] - at[axis]));
                break;
            }
            (at, left) = (stop.at, left - leg);
        }
        (distance(from, at) > SAME).then(|| (at[1] - from[1]).atan2(at[0] - from[0]))
    }

    /// The doorways that are released and not yet passed.
    pub fn doorways_ahead(&self, reached: usize) -> Vec<String> {
        let ahead = self.stops[..self.released].iter().skip(reached + 1);
        ahead.filter_map(|stop| stop.doorway.clone()).collect()
    }

    /// The message that says it: from the last stop that the vehicle knows to be released.
    pub fn order(&self, fleet: &Fleet) -> Order {
        let said = self.stitch..self.stops.len();
        let nodes = said.clone().map(|index| self.node(index, fleet)).collect();
        let edges = said.skip(1).map(|index| self.edge(index)).collect();
        Order { id: self.id.clone(), update: self.update, nodes, edges }
    }

    fn node(&self, index: usize, fleet: &Fleet) -> Node {
        let stop = &self.stops[index];
        Node {
            id: stop.id.clone(),
            sequence: 2 * index as u32,
            words: stop.words.clone(),
            released: index < self.released,
            at: stop.at,
            facing: stop.facing,
            deviation: stop.deviation,
            map: self.map.clone(),
            actions: stop
                .becomes
                .as_ref()
                .and_then(|state| self.change(index, state, fleet))
                .into_iter()
                .collect(),
        }
    }

    fn edge(&self, index: usize) -> Edge {
        let (from, to) = (&self.stops[index - 1], &self.stops[index]);
        Edge {
            id: format!("{} - {}", from.id, to.id),
            sequence: 2 * index as u32 - 1,
            words: to.space.clone(),
            released: index < self.released,
            start: from.id.clone(),
            end: to.id.clone(),
            speed: to.speed,
            height: to.height,
            facing: to.facing,
            length: distance(from.at, to.at),
            corridor: to.clearance.filter(|metres| *metres > SAME),
            actions: Vec::new(),
        }
    }

    /// What the vehicle does to come into a state, where rules say that it is an action of its own.
    fn change(&self, index: usize, state: &str, fleet: &Fleet) -> Option<Action> {
        let state = fleet.state(&self.robot, state)?;
        let blocking = state.blocking.as_deref().and_then(Blocking::read).unwrap_or(Blocking::Hard);
        Some(Action {
            id: format!("{} {index}", self.id),
            kind: state.action.clone()?,
            words: state.state.clone(),
            blocking,
            parameters: vec![("state".to_owned(), Value::from(state.state.clone()))],
        })
    }
}

/// The way that goes on from a stop; where it goes on in another state, that is changed at a stop of its own, since what was
/// released stays as it was said.
fn continued(from: &Stop, mut way: Vec<Stop>) -> Vec<Stop> {
    let leaves = way.first().and_then(|first| first.becomes.clone().or_else(|| first.state.clone()));
    if leaves.is_some() && from.state.is_some() && leaves != from.state && from.becomes != leaves {
        let first = Stop { state: from.state.clone(), becomes: leaves, is_wait: false, ..way[0].clone() };
        way[0] = from.clone();
        way.insert(1, Stop { id: format!("{} again", first.id), ..first });
    }
    with_changes_apart(way).split_off(1)
}

/// Where it waits nothing is done: who waits there may hear the stop once more. (The start of an order is none.)
fn with_changes_apart(mut way: Vec<Stop>) -> Vec<Stop> {
    for stop in &mut way {
        stop.is_wait &= stop.becomes.is_none();
        stop.deviation = stop.deviation.filter(|_| stop.becomes.is_none());
    }
    way
}

fn is_same(one: &[Stop], other: &[Stop]) -> bool {
    let near = |(a, b): (&Stop, &Stop)| {
        let is_same =
            a.becomes == b.becomes && a.doorway == b.doorway && a.state == b.state && a.speed == b.speed;
        is_same && distance(a.at, b.at) < SAME
    };
    one.len() == other.len() && one.iter().zip(other).all(near)
}
