//! Ways as sums of what they pass, and the search for the best one at given weights.

use std::sync::{Mutex, OnceLock, PoisonError};

use adit_planners::routes::{
    CompactGraph, CompactTree, DoorIndex, Goal, RoomIndex, RouteGraph, Start, Walking, Way,
};

use crate::error::Result;
use crate::state::State;
use crate::state::tunable::Weights;

/// So near to the end of an interval, as a share of it, it is looked at what the best way is.
const HAIR: f64 = 1e-3;

/// A way: what it costs is a sum over the metres in its rooms and over its doors.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Path {
    /// Rooms, in the order driven, each with the metres walked in it; none where rooms weigh nothing.
    pub metres: Vec<(RoomIndex, f64)>,
    /// Doors, in the order passed.
    pub doors: Vec<DoorIndex>,
}

impl Path {
    /// A way that was measured.
    pub fn of(way: &Way) -> Self {
        Self {
            metres: way.legs.iter().map(|leg| (leg.room, leg.length())).collect(),
            doors: way.legs.iter().filter_map(|leg| leg.door).collect(),
        }
    }

    /// It, and from its end on another one.
    #[must_use]
    pub fn then(mut self, on: Self) -> Self {
        self.metres.extend(on.metres);
        self.doors.extend(on.doors);
        self
    }

    /// The same way in another graph.
    pub fn renamed(
        self,
        room: impl Fn(RoomIndex) -> RoomIndex,
        door: impl Fn(DoorIndex) -> DoorIndex,
    ) -> Self {
        Self {
            metres: self.metres.into_iter().map(|(of, metres)| (room(of), metres)).collect(),
            doors: self.doors.into_iter().map(door).collect(),
        }
    }

    /// What it costs; infinite where it is not passed.
    pub fn cost(&self, weights: &Weights) -> f64 {
        let walked = self.metres.iter().map(|&(room, metres)| match weights[room] {
            Walking::OnDoors => 0.0,
            // a corner that is only touched costs nothing, whatever the room weighs
            Walking::PerMetre(hardness) => {
                if metres > 0.0 {
                    hardness * metres
                } else {
                    0.0
                }
            }
            Walking::Unknown => f64::INFINITY,
        });
        walked.sum::<f64>() + self.doors.iter().map(|&door| weights[door]).sum::<f64>()
    }
}

/// Finds best ways between two ends as weights change.
pub struct Routes {
    pub start: Start,
    pub goal: Goal,
    searched: Searched,
    /// How everything weighs at present, with the best way there, once it is known.
    best: OnceLock<(Weights, Option<Path>)>,
}

enum Searched {
    OnDoors(Pool<CompactGraph>),
    Measured(Box<Pool<Measured>>),
}

/// Graphs that are weighed as they were asked for last: one for each search that goes on at the same time.
struct Pool<T> {
    first: T,
    idle: Mutex<Vec<T>>,
}

impl<T: Clone> Pool<T> {
    fn new(first: T) -> Self {
        Self { first, idle: Mutex::default() }
    }

    fn lend<R>(&self, to: impl FnOnce(&mut T) -> R) -> R {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let lent = idle().pop();
        let mut lent = lent.unwrap_or_else(|| self.first.clone());
        let result = to(&mut lent);
        idle().push(lent);
        result
    }
}

#[derive(Clone)]
struct Measured {
    graph: RouteGraph,
    now: Weights,
}

impl Routes {
    /// Between two names of places, rooms or points.
    pub fn new(fork: &State, start: &str, goal: &str, robot: &str) -> Result<Self> {
        let (start, goal) = (fork.end(start)?, fork.end(goal)?);
        let graph = fork.graph();
        let (gauge, robot) = (Some(&*fork.gauge), Some(robot));
        let (start, goal) = (graph.start(gauge, &start, robot), graph.goal(gauge, &goal, robot));
        Ok(Self::between(graph.graph(), start, goal))
    }

    pub fn between(graph: &RouteGraph, start: Start, goal: Goal) -> Self {
        let searched = if let Some(compact) = CompactGraph::new(graph) {
            Searched::OnDoors(Pool::new(compact))
        } else {
            let measured = Measured { graph: graph.clone(), now: Weights::of(graph) };
            Searched::Measured(Box::new(Pool::new(measured)))
        };
        Self { start, goal, searched, best: OnceLock::new() }
    }

    /// Whether all hardness lies on the doors, so that a way is a list of doors.
    pub fn is_on_doors(&self) -> bool {
        matches!(self.searched, Searched::OnDoors(_))
    }

    /// What the best way costs as it is driven, off walls.
    pub fn driven_cost(&self, weights: &Weights) -> Option<f64> {
        match &self.searched {
            Searched::OnDoors(_) => Some(self.best(weights, f64::INFINITY)?.cost(weights)),
            Searched::Measured(graphs) => graphs.lend(|measured| {
                let graph = measured.weighed(weights);
                graph.way(&self.start, std::slice::from_ref(&self.goal)).map(|(_, way)| way.cost)
            }),
        }
    }

    /// The best way where everything weighs so; `None` where there is none, or it costs more than a limit. How far off walls it
    /// keeps turns no choice, and is not looked at.
    pub fn best(&self, weights: &Weights, limit: f64) -> Option<Path> {
        if let Some((_, path)) = self.best.get().filter(|(present, _)| present == weights) {
            return path.clone();
        }
        self.best_between(weights, (&self.start, &self.goal), limit)
    }

    /// As [`best`](Self::best), between other ends.
    pub fn best_between(
        &self,
        weights: &Weights,
        (start, goal): (&Start, &Goal),
        limit: f64,
    ) -> Option<Path> {
        match &self.searched {
            Searched::OnDoors(graphs) => graphs.lend(|graph| {
                weigh(graph, weights);
                best_of(&graph.tree(start), goal)
            }),
            Searched::Measured(graphs) => graphs.lend(|measured| {
                let graph = measured.weighed(weights);
                let way = graph.tightest_way_within(start, std::slice::from_ref(goal), limit);
                way.map(|(_, way)| Path::of(&way))
            }),
        }
    }

    /// Keeps the best way as everything weighs in a graph, which is asked for again.
    pub fn know(&self, graph: &RouteGraph, best: Option<&Way>) {
        if !self.is_on_doors() {
            self.best.get_or_init(|| (Weights::of(graph), best.map(Path::of)));
        }
    }

    /// By so much more, as a share, a way may cost than the best one and still count as one of the best: where ways are measured,
    /// two searches for one of them may bend a hair apart.
    pub fn rounding(&self) -> f64 {
        if self.is_on_doors() { 1e-9 } else { 1e-6 }
    }

    /// As a share of a value, how near to it the best way is looked at, since it bends a little otherwise at each value.
    pub fn hair(&self) -> f64 {
        if self.is_on_doors() { 0.0 } else { HAIR }
    }
}

impl Measured {
    /// The graph with these weights.
    fn weighed(&mut self, weights: &Weights) -> &RouteGraph {
        let rooms = self.now.rooms.iter().zip(&weights.rooms).enumerate();
        let rooms: Vec<_> = rooms
            .filter(|(_, (now, then))| now != then)
            .map(|(room, (_, then))| (RoomIndex::new(room), *then))
            .collect();
        let doors = self.now.doors.iter().zip(&weights.doors).enumerate();
        let doors: Vec<_> = doors
            .filter(|(_, (now, then))| now.total_cmp(then).is_ne())
            .map(|(door, (_, then))| {
                (DoorIndex::new(door), Some(*then).filter(|weight| weight.is_finite()), then.is_finite())
            })
            .collect();
        if !rooms.is_empty() || !doors.is_empty() {
            self.graph.reweigh(rooms, doors);
            self.now.clone_from(weights);
        }
        &self.graph
    }
}

/// Gives the doors of a graph these weights.
fn weigh(graph: &mut CompactGraph, weights: &Weights) {
    for (door, &weight) in (0..).map(DoorIndex::new).zip(&weights.doors) {
        graph.reweigh(door, Some(weight).filter(|weight| weight.is_finite()));
    }
}

/// The way to the goal that costs least.
fn best_of(tree: &CompactTree, goal: &Goal) -> Option<Path> {
    let reached = goal.rooms.iter().map(|entry| entry.room).filter(|&room| tree.cost(room).is_finite());
    let mut at = reached.min_by(|&one, &two| tree.cost(one).total_cmp(&tree.cost(two)))?;
    let mut doors = Vec::new();
    while let Some((before, door)) = tree.before(at) {
        doors.push(door);
        at = before;
    }
    doors.reverse();
    Some(Path { metres: Vec::new(), doors })
}
