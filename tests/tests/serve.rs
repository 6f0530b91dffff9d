//! The service as an integrator, a robot and an attacker meet it.
#![allow(clippy::unwrap_used)]

#[path = "serve/file.rs"]
mod file;
#[path = "serve/requests.rs"]
mod requests;
#[path = "serve/suite.rs"]
mod suite;
