//! What comes to the fleet, from wherever.

use crate::site::{Area, Fleet as Tables, Route};
use crate::way::Bridge;

/// Something that was heard.
pub enum Heard {
    /// The broker is there, or why it is not.
    Broker(Option<String>),
    /// A message, with its topic.
    Message(String, Vec<u8>),
    /// The site's tables, or why they are not to be had.
    Tables(Result<Tables, String>),
    /// What is low over the floor, and how far the map goes.
    Map(Vec<Bridge>, Option<[f64; 4]>),
    Areas(Vec<Area>),
    /// Something of the floor is another one.
    Floor,
    /// The way of a vehicle, and who follows it.
    Route {
        vehicle: String,
        epoch: u64,
        follower: String,
        route: Route,
    },
    /// The way of a vehicle as it is now.
    Fresh {
        vehicle: String,
        epoch: u64,
        route: Route,
    },
    /// Whether what was released is still a way.
    Checked {
        vehicle: String,
        order: String,
        update: u32,
        holds: bool,
    },
    /// An edit of a cell of its row was answered, as the answer of this number.
    Written {
        vehicle: String,
        column: &'static str,
        answer: u64,
    },
    /// The goal that was reached is out of the table.
    Cleared {
        vehicle: String,
    },
    /// For the log.
    Said(String),
    Tick,
}
