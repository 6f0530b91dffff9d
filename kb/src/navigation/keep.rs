//! A floor plan with its network, as it is kept.

use adit_db::floor_plan::{Adit, Doorway, FloorPlan, Place, Way};
use adit_planners::floor_plan::Spot;
use adit_planners::geometry::Point;
use adit_planners::navigation::{Judge, WayFacts};

use super::floor::Floor;
use super::judge::RuleJudge;

/// What is kept of a floor plan, and of what rules say that its ways weigh.
pub fn record(world: &str, rules: &str, floor: &Floor, judge: &mut RuleJudge) -> FloorPlan {
    let network = &floor.network;
    let mut weigh = |way| judge.weigh(&WayFacts { way, is_cut: false, times_blocked: 0 });
    let ways = network.ways.iter().filter_map(|way| {
        let Spot::Adit(to) = way.to else { return None };
        let (from_adit, from_place) = match way.from {
            Spot::Adit(adit) => (Some(adit as i64), None),
            Spot::Place(number) => (None, Some(floor.plan.places()[number].name.clone())),
            // of paths that are asked for, not of the network
            Spot::Start | Spot::Goal => return None,
        };
        Some(Way {
            from_adit,
            from_place,
            to: to as i64,
            doorway: way.doorway.map(|number| number as i64),
            region: way.region.map(|number| number as i64),
            length: way.length,
            clearance: way.clearance,
            weight: weigh(way),
        })
    });
    FloorPlan {
        world: world.to_owned(),
        rules: rules.to_owned(),
        radius: network.disc.radius,
        margin: network.disc.margin,
        area: floor.plan.free_area(),
        regions: network
            .regions
            .regions
            .iter()
            .map(|region| (region.outline.iter().map(pair).collect(), region.area))
            .collect(),
        doorways: network
            .regions
            .doorways
            .iter()
            .map(|doorway| Doorway {
                regions: doorway.regions.map(|region| region as i64),
                ends: [doorway.from.x, doorway.from.y, doorway.to.x, doorway.to.y],
                width: doorway.width(),
            })
            .collect(),
        adits: network
            .adits
            .iter()
            .map(|adit| Adit {
                doorway: adit.doorway as i64,
                region: adit.region as i64,
                twin: adit.twin as i64,
                at: pair(&adit.at),
            })
            .collect(),
        places: floor
            .plan
            .places()
            .iter()
            .map(|place| Place {
                name: place.name.clone(),
                at: pair(&place.at),
                region: network.region_of(place.at).map(|region| region as i64),
            })
            .collect(),
        ways: ways.collect(),
    }
}

fn pair(at: &Point) -> [f64; 2] {
    [at.x, at.y]
}
