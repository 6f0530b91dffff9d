//! Rooms, doors and kept routes as the database has them, before a step.

use adit_db::Tx;
use adit_db::door::Door;
use adit_db::room::Room;
use adit_db::tree::Start;

use super::weighed::{Weighed, is_same_cut};
use crate::error::Result;
use crate::graph::SiteGraph;

/// Rooms, doors and kept routes as they were.
#[derive(Clone, Copy)]
pub struct Before<'a> {
    /// The rooms, by number.
    pub rooms: &'a [Room],
    /// The doors, by number.
    pub doors: &'a [Door],
    /// The starts that routes were kept from.
    pub starts: &'a [Start],
}

/// What the database has of rooms, doors and starts.
#[derive(Default)]
pub struct Rows {
    rooms: Vec<Room>,
    doors: Vec<Door>,
    starts: Vec<Start>,
}

impl Rows {
    /// Reads it.
    pub fn read(tx: &mut Tx<'_>) -> Result<Self> {
        Ok(Self { rooms: tx.rooms()?, doors: tx.doors()?, starts: tx.starts()? })
    }

    /// The site as it was.
    pub fn before(&self) -> Before<'_> {
        Before { rooms: &self.rooms, doors: &self.doors, starts: &self.starts }
    }
}

impl Before<'_> {
    pub fn door(&self, key: i64) -> Option<&Door> {
        self.doors.binary_search_by_key(&key, |door| door.door).ok().map(|index| &self.doors[index])
    }

    /// What rules say otherwise than they did; `None` where rooms or doors are cut anew.
    pub fn weighed(&self, graph: &SiteGraph) -> Option<Weighed> {
        let (old, new) = ((self.rooms, self.doors), (&*graph.rooms, &*graph.doors));
        is_same_cut(old, new).then(|| Weighed::between(old, new))
    }

    /// Whether routes were kept from these starts, in whatever order, each as the same tree.
    pub fn same_starts(&self, starts: &[Start]) -> bool {
        let sorted = |starts: &[Start]| {
            let mut starts = starts.to_vec();
            starts.sort_unstable_by(|a, b| (&a.name, &a.robot, a.tree).cmp(&(&b.name, &b.robot, b.tree)));
            starts
        };
        sorted(self.starts) == sorted(starts)
    }
}
