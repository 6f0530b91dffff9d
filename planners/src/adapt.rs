//! Path planning that learns from task to task, and whose experience outlives changes of the cell.
//!
//! Chen 1994, "Adaptive Path Planning for Flexible Manufacturing": a fast local planner, [`Reach`], does most tasks along a
//! graph of subgoals, the [`Experience`]; where that fails, a slow global one, [`Solve`], is called, and what it found is
//! abstracted into subgoals. Subgoals hang on objects and move along with them. What broke because the cell changed is found
//! and repaired when a task needs it, or by another [`Strategy`]. What is decided comes from a [`Judge`].
//!
//! The planner is generic over the configuration space ([`Robot`]): a [`PointRobot`] in the plane and an [`Arm`] of n links come with it.
//! The measure of cost is the evaluation: one configuration against one object. A [`Workcell`] counts each of them, and
//! keeps what it taught, so that nothing is evaluated twice.

pub(crate) mod arm;
mod clearance;
mod execution;
mod experience;
mod experiment;
mod judge;
mod nearest;
mod noted;
mod object;
mod planner;
mod point_robot;
mod probe;
mod reach;
mod robot;
mod shape;
mod solve;
mod ways;
mod workcell;

pub use arm::{Arm, ArmError};
pub use clearance::Clearance;
pub use execution::{Collision, collision};
pub use experience::{Edge, EdgeId, Experience, ExperienceError, TagPoint, Vertex, VertexId};
pub use experiment::{Curve, Experiment, KeepNothing, Keeper, Method, Row, Scenario};
pub use judge::{ChangeFacts, EdgeFacts, Judge, LandmarkFacts, Strategy, Trust};
pub use noted::{Noted, ObjectChange, Removal};
pub use object::Object;
pub use planner::{Adapt, Changed, Heuristic, Outcome, Plugins, Progress, Report, Settings, Tally};
pub use point_robot::PointRobot;
pub use probe::Probe;
pub use reach::{Reach, Straight};
pub use robot::{Configuration, Limit, Link, Links, Robot, any_configuration, between, distance, length};
pub use shape::{Shape, ShapeError};
pub use solve::{RrtConnect, Solve, Taught};
pub use workcell::{Placed, Revision, TOUCHING_M, Workcell, WorkcellError};
