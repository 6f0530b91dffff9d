//! A site that is served, as bridges ask it: all that they know of the knowledge base is what its service answers by HTTP.

mod http;
mod program;
mod route;

pub use http::{Site, Trouble, query};
pub use program::{ended, say};
pub use route::{Followed, Nearest, Route, Step, Waypoint};
