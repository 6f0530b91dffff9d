//! Missions drawn by chance on three floor plans, judged by an exact search that knows all obstacles.

use std::path::Path;

use adit_planners::floor_plan::read_floor_plan;
use adit_planners::navigation::{Drivable, Ending, Outfit, draw};

use super::scene::building;
use super::table::Table;

const PLANS: [&str; 3] = ["house-7.json", "office-14.json", "plant-25.json"];

/// More of them are run by `examples/missions.rs`.
const MISSIONS: u64 = 10;

#[test]
fn what_is_possible_arrives_what_is_not_is_said_and_nothing_is_run_into() {
    let (mut arrived, mut refused) = (0, 0);
    for name in PLANS {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(name);
        let plan = read_floor_plan(&path).unwrap();
        let building = building(&plan);
        let outfit = Outfit::default();
        for number in 0..MISSIONS {
            let mission = draw(&plan, &building.network, outfit.robot.radius_m, number).unwrap();
            let Some(possible) = mission.possible(mission.start.at, &plan, outfit.robot.radius_m) else {
                continue;
            };
            let outcome = mission
                .run(&Drivable::of(&building.walls, &building), &outfit, None, &mut Table, |_| {}, None)
                .unwrap();
            let told = format!("{name} {number}: {possible:?} {outcome:?}");
            assert!(outcome.overlap_m < 1e-6, "{told}");
            match outcome.trip.ending {
                Ending::Arrived => {
                    arrived += 1;
                    assert!(possible.is_for_radius && outcome.miss_m < 0.2, "{told}");
                }
                Ending::NoWay => {
                    refused += 1;
                    assert!(!possible.is_with_room, "{told}");
                }
                Ending::Lost | Ending::Silent | Ending::OutOfPatience => panic!("{told}"),
            }
        }
    }
    assert!(arrived > 10 && refused > 3, "{arrived} arrived, {refused} refused: no fair draw");
}
