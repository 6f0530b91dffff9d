//! Sites in PostgreSQL: their rows and their files, for several services at once.
//!
//! Rows are shared, the thinking is local. A service has a copy of the site's database of its own, in SQLite, and everything is
//! done there. What is here is a layer at the commit: triggers note which rows a transaction changed ([`capture`]), and before it
//! is committed these rows go to PostgreSQL, with one row of a log, in one transaction that checks who may write ([`log`]). Other
//! services take the entries of the log in their order, and put the same rows into their copies.
//!
//! Who may write is said by a lease: a row with owner, end, and a number that grows with each owner. An edit that is committed
//! names owner and number, and the entry that it follows; where one of them is another by now, nothing of it is kept.
//!
//! What is used of PostgreSQL is what its distributed kin have, too: transactions that are tried again where they collide
//! (40001), `INSERT … ON CONFLICT`, `FOR UPDATE`, arrays, `unnest`. `NOTIFY` is a hint, and may be missing.

mod capture;
mod changes;
mod hint;
mod link;
mod log;
mod place;
mod replica;
mod rows;
mod schema;
mod tables;
mod upgrade;
mod upkeep;

pub use crate::failure::Failure;
pub use changes::File;
pub use hint::listen;
pub use place::Place;
pub use replica::{Entry, Replica};
pub(crate) use rows::{Leaving, copy_in};
pub use rows::{copy_out, sites};
pub use upgrade::{Upgraded, upgrade};
