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
pub mod cli;
pub mod draw;
pub mod edit;
mod error;
pub mod fit;
mod graph;
mod knowledge;
mod live;
pub mod navigation;
pub mod plan;
pub mod preview;
mod serve;
mod site;
pub mod state;
pub mod why;
mod words;

pub use answer::{Answer, Status};
pub use preview::compare::Compared;

pub use edit::Tell;
pub use error::problem::Problem;
pub use error::{Code, Error, Finding, Nearest, Result};
pub use knowledge::{KnowledgeBase, Tested};
pub use live::report::{Change, Concluded, Counts, Report, Routes};
pub use live::{Live, Outcome, Renewal, View};
pub use site::{Rooms, Site, Starts};
pub use state::State;
pub use words::progress::{Progress, Silent, Spinner, Stage};
