//! A floor plan with its robot.

use adit_planners::floor_plan::{Disc, FloorPlan, Network};
use adit_planners::geometry::Point;
use adit_planners::navigation::Building;

use super::told::Told;
use crate::error::{Code, Error, Result};
use crate::site::driving::Driving;
use crate::words::point::point;
use crate::words::suggest::did_you_mean;

/// A floor plan, the network of places for a robot, and what the robot goes by.
#[derive(Debug)]
pub struct Floor {
    pub plan: FloorPlan,
    pub network: Network,
    /// How it drives, and what it senses.
    pub driving: Driving,
    /// What the world says of doorways and regions.
    pub told: Told,
}

impl Floor {
    pub fn names(&self) -> Vec<&str> {
        self.plan.places().iter().map(|place| place.name.as_str()).collect()
    }

    /// The building as a robot drives in it: its ways leave room beside the robot, where there is a way with room.
    pub fn building(&self) -> Building {
        let disc = Disc {
            margin: self.network.disc.margin.max(self.driving.navigation.detour_room_m),
            ..self.network.disc
        };
        let with_room = Network::new(&self.plan, disc).unwrap_or_else(|_| self.network.clone());
        Building::new(&self.plan, with_room)
    }

    /// A place by its name, or a point `x,y`.
    pub fn point(&self, text: &str) -> Result<Point> {
        if let Some(place) = self.plan.places().iter().find(|place| place.name == text) {
            return Ok(place.at);
        }
        point(text).ok_or_else(|| {
            let message = format!("`{text}` is no place of the plan, and no point `x,y`");
            let names = self.names();
            let help = did_you_mean(text, names.iter().copied());
            let help = help.or_else(|| Some(format!("places: {}", names.join(", "))));
            Error::said(Code::PlanUnknownPlace, message, help)
        })
    }
}
