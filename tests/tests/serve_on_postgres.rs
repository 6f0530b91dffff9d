//! The service as an integrator, a robot and an attacker meet it, on sites in PostgreSQL.
//!
//! Left out are `serve/file.rs`, which is of a file that there is none of, and, for the sake of time, `serve/requests.rs`, which does
//! not come near a database: `ADIT_TESTS_ON=postgres tests/run --test serve -- --skip file::` runs that, too.
#![allow(clippy::unwrap_used)]

#[path = "serve/suite.rs"]
mod suite;
