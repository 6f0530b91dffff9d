//! Vehicles that speak VDA 5050 drive the routes of a site that is served.
//!
//! It is a client of the site's service as anybody's program would be: it knows nothing of the knowledge base but what
//! `kb/SERVICE.md` says. [`driver`] decides, and neither waits nor sends; [`fleet`] does what it says.

mod broker;
pub mod cli;
pub mod driver;
mod fleet;
pub mod given;
mod heard;
pub mod site;
pub mod way;
pub mod wire;
