//! What is asked from outside, and what is answered: the planner itself decides nothing of this.

use super::experience::Experience;
use super::robot::Link;
use super::workcell::Placed;

/// What becomes of experience when the cell changed (Chen 1994, section 2.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Strategy {
    /// A0: it is forgotten, all of it.
    Forget,
    /// A1: all edges are verified, and what hangs together with the robot is kept.
    VerifyAll,
    /// A2: every vertex is reached from where the robot is, as if each were asked for, before the next task.
    RepairAll,
    /// A3: nothing at once; each task repairs what it needs.
    OnDemand,
}

/// How a change was, and what stands against it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChangeFacts {
    /// Objects in the cell, after the change.
    pub objects: u32,
    pub appeared: u32,
    pub gone: u32,
    /// Objects that were moved or turned.
    pub moved: u32,
    /// Objects that have another shape.
    pub reshaped: u32,
    /// The longest way by which one was moved, metres.
    pub moved_m: f64,
    /// The widest angle by which one was turned, radians.
    pub turned: f64,
    /// Tasks that were done since the last change, or since the beginning.
    pub tasks: u32,
    /// Vertices of the experience graph, without those that were dropped because of the change.
    pub vertices: u32,
    pub vertices_moved: u32,
    /// Vertices that could not go along, and were dropped.
    pub vertices_dropped: u32,
    /// Share of the vertices that are not known to be free any more (0 to 1).
    pub unsure_vertices: f64,
    pub edges: u32,
    /// Share of all edges so far that broke (0 to 1).
    pub broken_edges: f64,
    /// Evaluations of a call of Solve over those of a call of Reach, by all calls so far; 1 before there were any.
    pub solve_over_reach: f64,
}

/// An object to which a subgoal may be attached. What takes time to tell is told when it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct LandmarkFacts<'o> {
    pub object: &'o str,
    /// Metres from the tool to the origin of the object's frame.
    pub distance_m: f64,
    /// Whether it is said to be moved now and then.
    pub is_movable: bool,
    pub times_moved: u32,
    /// Whether the subgoal is the goal of the task itself, and not on the way there.
    pub is_goal: bool,
    pub(super) placed: &'o Placed,
    /// The robot at the subgoal.
    pub(super) links: &'o [Link],
    pub(super) experience: &'o Experience,
}

impl LandmarkFacts<'_> {
    /// The least distance from the robot to the object that is known, metres; infinite where none is.
    pub fn clearance_m(&self) -> f64 {
        let slack = self.placed.slack(self.links, f64::INFINITY);
        if slack < 0.0 { f64::INFINITY } else { slack }
    }

    /// How many subgoals are attached to it already.
    pub fn subgoals(&self) -> u32 {
        self.experience.hung_on(self.object)
    }
}

/// An edge that was not verified since an object changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeFacts {
    /// Tasks since it was verified.
    pub age_tasks: u32,
    /// Changes of the cell since it was verified.
    pub age_changes: u32,
    /// How often it was verified, the first time included.
    pub times_verified: u32,
    /// How many objects changed since it was verified, or came.
    pub unverified_objects: u32,
    /// Of all edges of the graph so far, the share that broke (0 to 1).
    pub broken_edges: f64,
    /// Its length, by the distance of configurations.
    pub length: f64,
}

/// Whether an edge is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// As it is. The check before execution still refuses a path that is in collision.
    AsItIs,
    /// Once Reach can follow it.
    Verify,
    /// Not any more: it is removed.
    GiveUp,
}

/// Whatever is a choice. In the knowledge base these are rules.
pub trait Judge {
    /// What becomes of experience after a change.
    fn strategy(&mut self, facts: &ChangeFacts) -> Strategy;

    /// How well an object serves as landmark of a subgoal: the one with the least value is taken, of equal ones the first;
    /// `None` where it does not serve.
    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64>;

    /// Whether an edge is used that was not verified since an object changed.
    fn trust(&mut self, facts: &EdgeFacts) -> Trust;
}
