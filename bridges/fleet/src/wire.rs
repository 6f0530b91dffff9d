//! What goes over the broker: one model of messages, and the one place in which the versions of VDA 5050 differ.

mod heard;
mod said;
mod version;
mod zones;

pub use heard::{Connection, Factsheet, Fault, Link, Report, connection, factsheet, of_another, state};
pub use said::{Action, Addressee, Blocking, Edge, Instant, Node, Order};
pub use version::Version;
pub use zones::{Zone, ZoneSet};
