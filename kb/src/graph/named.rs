//! What people have names for: areas, named doors, doorways and spaces, each of one class.

use super::Building;

pub struct Named<'b> {
    pub areas: Vec<String>,
    pub doors: Vec<String>,
    pub building: &'b Building,
}

impl Named<'_> {
    /// Of which class something is.
    pub fn class_of(&self, what: &str) -> Option<&'static str> {
        if self.doors.iter().any(|door| door == what) {
            return Some("NAMED_DOORS");
        }
        if self.areas.iter().any(|area| area == what) {
            return Some("AREAS");
        }
        if self.building.doorway_named(what).is_some() {
            return Some("DOORWAYS");
        }
        self.building.space_named(what).map(|_| "SPACES")
    }

    pub fn names(&self) -> impl Iterator<Item = String> {
        self.areas.iter().chain(&self.doors).cloned().chain(self.building.names())
    }
}
