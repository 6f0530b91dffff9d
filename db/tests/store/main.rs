//! The store as its callers and as plain SQL clients see it.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::float_cmp,
    clippy::redundant_closure_for_method_calls,
    reason = "tests: helpers unwrap too, exact numbers are meant, and closures say what is read"
)]

mod blocks;
mod clients;
mod conclusions;
mod editing;
mod example;
mod experience;
mod made;
mod opening;
mod paper;
mod plan;
mod queries;
mod relations;
mod routes;
mod schema;
mod stale;
mod worlds;
