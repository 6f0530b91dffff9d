//! Robots that learn in cells (Chen, "Adaptive Path Planning for Flexible Manufacturing"): cells as files, rules as the
//! planner's judge, experience in the store, experiments.
//!
//! A cell is read once ([`Cell`]). A [`Session`] plans task by task, asks the rules ([`RuleJudge`]) what the paper leaves to
//! the application, and keeps after each task what it changed.

mod answer;
mod cell;
mod course;
mod draft;
mod drawn;
mod experiment;
mod explain;
mod figures;
mod judge;
mod keep;
mod keeping;
mod kept;
mod recall;
pub(crate) mod scenario;
mod session;
pub(crate) mod taught;
pub(crate) mod world;

pub use answer::{change_json, change_line, task_json};
pub use cell::{Cell, is_scenario};
pub use course::CellOf;
pub use drawn::drawn;
pub use experiment::{
    Outcome as ExperimentOutcome, Row, method_of, method_word, run as experiment, write_csv,
};
pub(crate) use judge::classes;
pub use judge::{RuleJudge, strategy_of};
pub use session::{Beginning, Done, Session};
