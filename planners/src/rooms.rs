//! Rooms: rectangles that part the free space, each of one height (Abou-Ali et al., "Rooms generation").

mod cutter;
mod greedy;
mod low_bridges;
mod order;
pub mod outline;
mod paper;
mod queue;
mod table;
mod taken;

use crate::geometry::Rect;

pub use greedy::greedy_rooms;
pub use paper::{PaperRooms, paper_rooms};

pub(crate) use low_bridges::{cut_low_bridges, known_low_bridges};
pub(crate) use order::area_key;
pub(crate) use table::{DoorRow, GIVES, RoomRow, facts, room_facts};

/// A room of the paper's modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    pub rect: Rect,
    /// Clear height, in metres; `None` is unlimited.
    pub height: Option<f64>,
}

/// A bridge too low for the tallest state, which makes its area a room: the paper's list 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowBridge {
    pub rect: Rect,
    /// Clear height under it, in metres.
    pub height: f64,
}
