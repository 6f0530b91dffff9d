//! Zones, told to a vehicle that knows them. In a circle with the vehicle's file, of which it is a part.

use std::hash::{DefaultHasher, Hash, Hasher};

use super::{Driver, Effect, Now};
use crate::wire::{Action, Blocking, Instant, Version, Zone, ZoneSet};

impl Driver {
    /// Tells it the site's zones where it has others, and has it use them.
    pub(super) fn tell_zones(&mut self, now: &Now<'_, '_>, effects: &mut Vec<Effect>) {
        if now.to.version < Version::V3_0 {
            return;
        }
        let (mut zones, mut refused) = (Vec::new(), Vec::new());
        for area in now.world.areas {
            match area.meaning(&now.world.fleet.zones) {
                Ok(Some(meaning)) => {
                    zones.push(Zone { id: area.name.clone(), corners: area.corners.clone(), meaning });
                }
                Ok(None) => {}
                Err(why) => refused.push(why),
            }
        }
        let map = self.map(now.world);
        let id = named(&zones, &map);
        let has_none = self.zones.is_none() && zones.is_empty();
        if has_none && refused.is_empty() || self.zones.as_ref() == Some(&(id.clone(), refused.clone())) {
            return;
        }
        effects.extend(refused.iter().map(|why| Effect::Say(format!("{}: {why}", self.row.name))));
        let is_same = self.zones.as_ref().is_some_and(|(known, _)| *known == id);
        self.zones = Some((id.clone(), refused));
        if is_same || has_none {
            return;
        }
        let words = &now.world.clock.words;
        self.heads[2] = self.heads[2].wrapping_add(1);
        let message = now.to.zone_set(&ZoneSet { id: id.clone(), map, zones }, self.heads[2], words);
        effects.push(Effect::Send { to: now.to.clone(), topic: "zoneSet", message });
        self.heads[1] = self.heads[1].wrapping_add(1);
        let action = Action {
            id: format!("zones {words} {}", self.heads[2]),
            kind: "enableZoneSet".to_owned(),
            words: "the site's areas".to_owned(),
            blocking: Blocking::None,
            parameters: vec![("zoneSetId".to_owned(), id.into())],
        };
        let message = now.to.instant(&Instant { actions: vec![action] }, self.heads[1], words);
        effects.push(Effect::Send { to: now.to.clone(), topic: "instantActions", message });
    }
}

/// A name that equal zones share.
fn named(zones: &[Zone], map: &str) -> String {
    let mut hasher = DefaultHasher::new();
    (map, format!("{zones:?}")).hash(&mut hasher);
    format!("areas {:016x}", hasher.finish())
}
