//! The store of Adit: schema, migrations, transactions, and the SQL views that users query.
//!
//! A site's database is one SQLite file that any client reads without anything of ours. [`Store`] is the blocking way
//! in, [`Tx`] one transaction of it; the module of each table has the same functions in async form, on any
//! `sqlx::SqliteConnection`.

pub mod area;
pub mod backup;
mod block;
mod bulk;
pub mod carried_out;
pub mod cell;
pub mod conclusion;
mod connection;
pub mod course;
pub mod doctor;
pub mod door;
mod dynamic;
pub mod edit;
mod error;
pub mod experience;
mod failure;
pub mod floor_plan;
mod guard;
pub mod history;
pub mod hours;
pub mod kept;
pub mod laid;
pub mod layer;
pub mod learned;
pub mod load;
pub mod measure;
mod migrate;
pub mod mission;
pub mod place;
pub mod postgres;
pub mod query;
mod reason;
pub mod relation;
pub mod robot;
pub mod room;
pub mod route;
pub mod saved;
pub mod schema;
pub mod site;
pub mod space;
pub mod stale;
mod store;
pub mod told;
mod transaction;
pub mod traversal;
pub mod tree;
pub mod tuning;
pub mod weight;
mod worlds;

pub use cell::Cell;
pub use error::{Error, Result};
pub use migrate::VERSION;
pub use reason::Derived;
pub use store::Store;
pub use transaction::Tx;
