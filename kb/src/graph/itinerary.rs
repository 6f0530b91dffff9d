//! What makes a way another way to people: another doorway, another space, or another state in one of them. That it turns round a
//! corner by a finger's breadth elsewhere, or changes shape a step earlier, does not.

use std::hash::{DefaultHasher, Hash, Hasher};

use adit_planners::geometry::Point;
use adit_planners::routes::{DoorIndex, RoomIndex};

use super::SiteGraph;

/// A way as people tell it apart from others, made step by step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Itinerary {
    told: u64,
    /// State and space in which it is.
    within: Option<(u64, Option<i64>)>,
    /// The door that was passed last.
    door: Option<DoorIndex>,
}

impl Itinerary {
    /// A number that is equal for ways that people do not tell apart.
    pub const fn told(self) -> u64 {
        self.told
    }

    /// Goes on through a room, moving in it or not, and out of it by a door. Rooms that are of no state are told apart by their
    /// doors alone.
    #[must_use]
    pub fn through(
        mut self,
        graph: &SiteGraph,
        room: RoomIndex,
        moves: bool,
        door: Option<DoorIndex>,
    ) -> Self {
        let room = &graph[room];
        if room.layer.is_none() {
            self.told = hash(&(self.told, door));
        } else if moves {
            let within = (hash(&room.layer), room.space);
            if self.within != Some(within) {
                let from = self.within.and_then(|(_, space)| space);
                let doorway = from.zip(room.space).zip(self.door).and_then(|((from, to), door)| {
                    let [x, y] = graph[door].at;
                    let doorway = graph.building.doorway(from, to, Point::new(x, y))?;
                    Some(doorway.doorway)
                });
                self.told = hash(&(self.told, within, doorway));
                self.within = Some(within);
            }
        }
        self.door = door.or(self.door);
        self
    }
}

fn hash(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}
