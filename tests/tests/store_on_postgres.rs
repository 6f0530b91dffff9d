//! The store's suite on copies of sites in PostgreSQL: after each test the rows are there, and in the copy of whoever followed the
//! log, to the bit.
//!
//! Of `db/tests/store` what writes and reads is here. What is of files, of edits from outside and of SQLite's own plans is not: a copy
//! is made anew whenever its service starts, and nobody else writes to it. `tests/postgres/views.rs` has the plans.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::redundant_closure_for_method_calls,
    reason = "tests: helpers unwrap too, exact numbers are meant, and closures say what is read"
)]

#[path = "../../db/tests/store/conclusions.rs"]
mod conclusions;
#[path = "../../db/tests/store/editing.rs"]
mod editing;
#[path = "../../db/tests/store/example.rs"]
mod example;
#[path = "../../db/tests/store/experience.rs"]
mod experience;
#[path = "postgres/made.rs"]
mod made;
#[path = "../../db/tests/store/paper.rs"]
mod paper;
#[path = "../../db/tests/store/routes.rs"]
mod routes;
