//! The service as an integrator, a robot and an attacker meet it, on sites in PostgreSQL.
//!
//! Left out are `serve/file.rs`, which is of a file that there is none of, and `serve/requests.rs`, which is more than half of the time
//! and differs least: `ADIT_TESTS_ON=postgres cargo test --workspace --test serve -- --skip file::` runs that, too.
#![allow(clippy::unwrap_used)]

#[path = "serve/suite.rs"]
mod suite;
