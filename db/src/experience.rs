//! What robots learned in cells: the tables `cells`, `cell_objects`, `object_changes`, `subgoals`, `edges`,
//! `subgoal_pairs`, `clearances`, `tasks` and `strategies`.
//!
//! Experience is written step by step: [`Tx::keep_step`] takes what one task changed. What was taken out keeps its row.
//!
//! What is kept and recalled are the types below, which a transaction hands to both: a circle that stays.

mod keep;
mod numbers;
mod recall;
mod records;

use crate::error::Result;
use crate::transaction::Tx;

/// A cell, as a whole, between two tasks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// Under which its experience is kept.
    pub cell: String,
    /// What its robot is; experience of another robot is none.
    pub robot: String,
    /// What chance is drawn from; a text, since SQL has no unsigned numbers of 64 bits.
    pub seed: String,
    /// Tasks that were done.
    pub tasks: i64,
    /// The state of the cell.
    pub revision: i64,
    /// The number that the next subgoal gets.
    pub next_subgoal: i64,
    /// The number that the next edge gets.
    pub next_edge: i64,
    /// Where the robot is.
    pub configuration: Vec<f64>,
    /// The subgoal by which it stands.
    pub stands: Option<i64>,
    /// Other figures of the planner, as JSON.
    pub figures: String,
    /// The cell, and its file, of which its experience is a copy.
    pub copied_from: Option<String>,
}

/// An object, as the planner last saw it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object {
    /// Its name.
    pub object: String,
    /// The state of the cell since which it is as it is.
    pub revision: i64,
    /// How often it was moved or turned.
    pub times_moved: i64,
    /// Whether it is said to be moved now and then.
    pub movable: bool,
    /// Where its frame lies: metres, metres, radians.
    pub pose: [f64; 3],
    /// Its corners in its frame.
    pub polygon: Vec<[f64; 2]>,
}

/// How an object changed.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectChange {
    /// The state of the cell from then on.
    pub revision: i64,
    /// Its name.
    pub object: String,
    /// Before which task.
    pub task: i64,
    /// `appeared`, `gone`, `moved` or `reshaped`.
    pub how: &'static str,
}

/// A subgoal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Subgoal {
    /// Its number.
    pub subgoal: i64,
    /// The robot's configuration there.
    pub configuration: Vec<f64>,
    /// On what it hangs.
    pub tag: Option<Tag>,
    /// The task in which it was made.
    pub made_task: i64,
}

/// A tag-point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tag {
    /// The landmark.
    pub object: String,
    /// The tool in the landmark's frame: metres, metres, radians.
    pub tool: [f64; 3],
    /// The branch of the inverse kinematics.
    pub branch: i64,
}

/// An edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edge {
    /// Its number.
    pub edge: i64,
    /// The subgoals at its ends.
    pub ends: [i64; 2],
    /// The path between them, without both ends.
    pub via: Vec<Vec<f64>>,
    /// Whether nothing is known of it since an end of it moved.
    pub loose: bool,
    /// By the distance of configurations.
    pub length: f64,
    /// The task in which it was made.
    pub made_task: i64,
    /// The task in which it was last verified.
    pub verified_task: i64,
    /// The state of the cell in which it was.
    pub verified_revision: i64,
    /// How often it was.
    pub times_verified: i64,
}

/// Something that was taken out of the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Removed {
    /// Its number.
    pub number: i64,
    /// In which task.
    pub task: i64,
    /// Why.
    pub because: &'static str,
    /// Of an edge, in which state of the cell.
    pub revision: Option<i64>,
    /// Of an edge, the object in its way, where that is known.
    pub object: Option<String>,
}

/// A pair of subgoals that was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The subgoals.
    pub ends: [i64; 2],
    /// Whether the path between them was tightened; otherwise a shortcut between them is not free.
    pub tightened: bool,
    /// In which state of the cell.
    pub revision: i64,
}

/// What an evaluation taught about an object, in its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// The object.
    pub object: String,
    /// A point of the segment that is free, or of the object.
    pub a: [f64; 2],
    /// The other end of a segment that is free; `None` of what is taken.
    pub b: Option<[f64; 2]>,
    /// Metres.
    pub within: f64,
}

/// A task that was done, or tried.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Task {
    /// Its number, from 1.
    pub task: i64,
    /// The goal's name.
    pub goal: String,
    /// The goal's configuration; `None` where it has none.
    pub configuration: Option<Vec<f64>>,
    /// Why there is no path; `None` where there is.
    pub reason: Option<String>,
    /// What it cost.
    pub evaluations: i64,
    /// Calls of Solve.
    pub solve_calls: i64,
    /// Calls of Reach.
    pub reach_calls: i64,
    /// The path.
    pub path: Option<Vec<Vec<f64>>>,
    /// Its length.
    pub length: Option<f64>,
}

/// What rules decided about the experience after a change.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strategy {
    /// The state of the cell.
    pub revision: i64,
    /// Before which task.
    pub task: i64,
    /// `a0` to `a3`.
    pub strategy: &'static str,
    /// What they were told, as JSON.
    pub facts: String,
    /// The rule that decided.
    pub rule: Option<crate::mission::Decided>,
}

/// All that a planner needs to go on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Experience {
    /// The cell.
    pub cell: Cell,
    /// Its objects, in their order.
    pub objects: Vec<Object>,
    /// The subgoals that are there, by number.
    pub subgoals: Vec<Subgoal>,
    /// The edges that are there, by number.
    pub edges: Vec<Edge>,
    /// Pairs of subgoals that were looked at.
    pub subgoal_pairs: Vec<Pair>,
    /// What is known of objects, in the order in which it was learned.
    pub clearances: Vec<Clearance>,
}

/// What one task changed. Numbers that stand in several lists are first added, then changed, then removed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Step {
    /// The cell from now on.
    pub cell: Cell,
    /// All objects from now on, where one changed.
    pub objects: Option<Vec<Object>>,
    /// How they did.
    pub object_changes: Vec<ObjectChange>,
    /// All that was there before is forgotten, in this task.
    pub forgotten: Option<i64>,
    /// New subgoals.
    pub subgoals: Vec<Subgoal>,
    /// Subgoals that moved.
    pub moved: Vec<(i64, Vec<f64>)>,
    /// Subgoals that were taken out.
    pub subgoals_removed: Vec<Removed>,
    /// New edges.
    pub edges: Vec<Edge>,
    /// Edges that were verified, or of which nothing is known any more.
    pub edges_changed: Vec<Edge>,
    /// Edges that were taken out.
    pub edges_removed: Vec<Removed>,
    /// Pairs of subgoals that were looked at.
    pub subgoal_pairs: Vec<Pair>,
    /// Objects of which nothing is known any more.
    pub clearances_forgotten: Vec<String>,
    /// What was learned of objects.
    pub clearances: Vec<Clearance>,
    /// The tasks.
    pub tasks: Vec<Task>,
    /// What rules decided.
    pub strategies: Vec<Strategy>,
}

impl Tx<'_> {
    /// Reads the experience of a cell; `None` where there is none.
    pub fn experience(&mut self, cell: &str) -> Result<Option<Experience>> {
        self.run(async |connection| recall::read(connection, cell).await)
    }

    /// The names of the cells of which there is experience.
    pub fn cells(&mut self) -> Result<Vec<String>> {
        self.run(async |connection| recall::cells(connection).await)
    }

    /// Keeps what a step changed.
    pub fn keep_step(&mut self, step: &Step) -> Result<()> {
        self.run(async |connection| keep::step(connection, step).await)
    }

    /// Keeps the whole experience of a cell in the stead of what is there: a copy of another's.
    pub fn keep_experience(&mut self, experience: &Experience) -> Result<()> {
        self.run(async |connection| keep::whole(connection, experience).await)
    }

    /// Forgets a cell, with its tasks.
    pub fn forget_cell(&mut self, cell: &str) -> Result<()> {
        self.run(async |connection| keep::forget(connection, cell).await)
    }
}
