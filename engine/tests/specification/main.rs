//! The engine's behaviour, as its users may rely on it.

mod conflicts;
mod doors;
mod explanation;
mod interpreter;
mod joins;
mod limits;
mod order;
mod revisions;
mod support;
mod unknown;
mod wrong_files;
