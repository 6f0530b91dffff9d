//! A vehicle type on a lane: what is told to rules about it.

use std::collections::BTreeMap;

use adit_planners::lanes::{Lane, Node, Use, VehicleType};

use super::tables::Now;
use crate::plan::consult::Of::{Number, Perhaps, Text, Truth};
use crate::plan::consult::Property;

/// What a vehicle carries.
#[derive(Clone, Debug, Default)]
pub struct Carried {
    pub load: String,
    /// Metres on top of the vehicle.
    pub height: f64,
}

/// What a vehicle type carries now, by its name.
pub type Carrying = BTreeMap<String, Carried>;

pub struct Travel<'n> {
    lane: &'n Lane,
    from: &'n Node,
    to: &'n Node,
    length_m: f64,
    vehicle: &'n VehicleType,
    /// What the file allows this type here.
    allowed: Option<&'n Use>,
    lists_types: bool,
    carried: Option<&'n Carried>,
    is_door_closed: bool,
    closed_lift: Option<&'n str>,
}

/// Metres along a lane; between levels with the height.
pub fn length_m(now: &Now, lane: &Lane, [from, to]: [&Node; 2]) -> f64 {
    let elevation = |node: &Node| {
        let level = now.graph.levels.iter().find(|level| level.level == node.level);
        level.map_or(0.0, |level| level.elevation)
    };
    lane.length.unwrap_or_else(|| from.at.distance(to.at).hypot(elevation(from) - elevation(to)))
}

impl<'n> Travel<'n> {
    pub fn of(
        now: &'n Now,
        (lane, ends): (&'n Lane, [&'n Node; 2]),
        vehicle: &'n VehicleType,
        uses: &[&'n Use],
        carrying: &'n Carrying,
    ) -> Self {
        let lift = [lane.lift.as_ref(), ends[0].lift.as_ref(), ends[1].lift.as_ref()];
        Self {
            lane,
            from: ends[0],
            to: ends[1],
            length_m: length_m(now, lane, ends),
            vehicle,
            allowed: uses.iter().find(|of| of.vehicle_type == vehicle.vehicle_type).copied(),
            lists_types: !uses.is_empty(),
            carried: carrying.get(&vehicle.vehicle_type),
            is_door_closed: lane.doors().any(|door| now.closed_doors.contains(door)),
            closed_lift: lift
                .into_iter()
                .flatten()
                .find(|lift| now.closed_lifts.contains(*lift))
                .map(String::as_str),
        }
    }

    /// The same with other goods, or none.
    #[must_use]
    pub fn carrying(self, carried: Option<&'n Carried>) -> Self {
        Self { carried, ..self }
    }

    /// A load of no height that the file allows here.
    pub fn allowed_load(&self) -> Carried {
        let sets = self.allowed.and_then(|of| of.load_sets.as_deref()).unwrap_or("load");
        Carried { load: sets.split(',').next().unwrap_or_default().trim().to_owned(), height: 0.0 }
    }

    fn height(&self) -> Option<f64> {
        Some(self.vehicle.height? + self.carried.map_or(0.0, |of| of.height))
    }

    /// The lowest of the limits that hold here, m/s.
    fn limit(&self) -> Option<f64> {
        let allowed = self.allowed.and_then(|of| of.max_speed);
        self.lane.speed_limit.into_iter().chain(allowed).min_by(f64::total_cmp)
    }

    /// The end that is closed, by its name where it has one.
    fn closed_node(&self) -> Option<&str> {
        let closed = [self.to, self.from].into_iter().find(|node| node.closed)?;
        Some(closed.name.as_deref().unwrap_or(&closed.node))
    }

    /// The end that is not for the vehicle.
    fn unlisted_node(&self) -> Option<&str> {
        let mut ends = [self.from, self.to].into_iter();
        ends.find(|node| !node.is_for(&self.vehicle.vehicle_type)).map(|node| node.node.as_str())
    }

    fn is_set_allowed(&self) -> bool {
        let sets = self.allowed.and_then(|of| of.load_sets.as_deref());
        let Some((sets, carried)) = sets.zip(self.carried) else { return true };
        sets.split(',').any(|set| set.trim() == carried.load)
    }
}

/// What rules are told of a vehicle type on a lane.
pub const fn told<'n>() -> [Property<Travel<'n>>; 39] {
    [
        ("lane", Text(|of| Some(&of.lane.lane))),
        ("name", Text(|of| of.lane.name.as_deref())),
        ("vehicle_type", Text(|of| Some(&of.vehicle.vehicle_type))),
        ("from_node", Text(|of| Some(&of.from.node))),
        ("to_node", Text(|of| Some(&of.to.node))),
        ("level", Text(|of| Some(&of.from.level))),
        ("to_level", Text(|of| Some(&of.to.level))),
        ("length", Number(|of| of.length_m)),
        ("graph", Text(|of| of.lane.graph.as_deref())),
        ("of_graph", Text(|of| of.vehicle.graph.as_deref())),
        ("closed", Truth(|of| of.lane.closed)),
        ("is_door_closed", Truth(|of| of.is_door_closed)),
        ("is_lift_closed", Truth(|of| of.closed_lift.is_some())),
        ("closed_lift", Text(|of| of.closed_lift)),
        ("is_node_closed", Truth(|of| of.from.closed || of.to.closed)),
        ("closed_node", Text(Travel::closed_node)),
        ("door", Text(|of| of.lane.door.as_deref())),
        ("lift", Text(|of| of.lane.lift.as_deref())),
        ("orientation", Text(|of| of.lane.orientation.as_deref())),
        ("told_action", Text(|of| of.lane.action.as_deref())),
        ("cost", Perhaps(|of| of.lane.cost)),
        ("is_cost_fixed", Truth(|of| of.lane.is_cost_fixed)),
        ("penalty", Perhaps(|of| of.lane.penalty)),
        ("speed_share", Perhaps(|of| of.lane.speed_share)),
        ("limit", Perhaps(Travel::limit)),
        ("speed", Perhaps(|of| of.vehicle.speed)),
        ("height", Perhaps(Travel::height)),
        ("min_height", Perhaps(|of| of.allowed?.min_height)),
        ("max_height", Perhaps(|of| of.allowed?.max_height)),
        ("lists_types", Truth(|of| of.lists_types)),
        ("is_listed", Truth(|of| of.allowed.is_some())),
        ("unlisted_node", Text(Travel::unlisted_node)),
        ("is_for_loaded", Truth(|of| of.allowed.and_then(|of| of.loaded).unwrap_or(true))),
        ("is_for_unloaded", Truth(|of| of.allowed.and_then(|of| of.unloaded).unwrap_or(true))),
        ("load_sets", Text(|of| of.allowed?.load_sets.as_deref())),
        ("is_loaded", Truth(|of| of.carried.is_some())),
        ("load", Text(|of| of.carried.map(|of| of.load.as_str()))),
        ("is_set_allowed", Truth(Travel::is_set_allowed)),
        ("rotation_allowed", Truth(|of| of.allowed.and_then(|of| of.rotation_allowed).unwrap_or(true))),
    ]
}
