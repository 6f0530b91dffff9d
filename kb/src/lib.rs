//! Adit: a rule engine and knowledge base that tells a mobile robot which way to go and how to move.
//!
//! A map becomes rooms and doors, a rule base gives each of them a hardness and an action, and the routes of least
//! total hardness are kept in a SQLite database, where the best sequence of actions is one query away.
//!
//! ```no_run
//! use adit::{KnowledgeBase, Silent};
//!
//! let knowledge = KnowledgeBase::open("my-site".as_ref())?;
//! let report = knowledge.build(&Silent)?;
//! println!("{} rooms, {} doors", report.rooms.total, report.doors.total);
//! let answer = knowledge.route("dock", "ward 6", None)?;
//! for step in &answer.steps {
//!     println!("{} {} {:?}", step.kind, step.place, step.action);
//! }
//! # Ok::<(), adit::Error>(())
//! ```

pub mod adapt;
pub mod answer;
mod classes;
pub mod cli;
mod clock;
mod compare;
pub mod draw;
pub mod edit;
mod error;
pub mod firm;
pub mod fit;
mod gauge;
mod generation;
mod graph;
mod grounds;
mod hours;
mod inputs;
mod keep;
mod knowledge;
mod lint;
mod live;
pub mod navigation;
mod number;
mod pairs;
pub mod plan;
pub mod preview;
mod problem;
mod progress;
mod reason;
mod report;
mod robots;
mod rows;
mod rules;
mod scene;
mod serve;
mod shipped;
mod site;
pub mod state;
mod states;
mod subject;
mod suggest;
mod tables;
mod told;
mod trees;
mod tunings;
pub mod watch;
mod weights;
mod whole;
pub mod why;
pub mod why_not;

pub use answer::{Answer, Status};
pub use compare::Compared;

pub use error::{Error, Result};
pub use knowledge::{KnowledgeBase, Tested};
pub use live::{Live, Outcome, Renewal, View};
pub use problem::Problem;
pub use progress::{Progress, Silent, Spinner};
pub use report::{Change, Counts, Report, Routes};
pub use site::{Rooms, Site, Starts};
pub use state::{Stage, State};
pub use told::Tell;
