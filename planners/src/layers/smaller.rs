//! Which states fit wherever another one does, as facts. Whether such a one is as good as the other besides, rules say.

use super::planner::{OF_ROBOTS, moving_states};
use super::record::State;
use super::stand_ins::SMALLER;
use crate::facts::{Column, Facts, Table};
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::World;

/// The planner "smaller states". It gives `SMALLER_STATES`: robot, state, smaller, for each two states that move where the
/// smaller one fits wherever the other does, whatever the walls: it is a disc no wider, and passes all bridges that the other
/// passes. They stand in the order of `ROBOTS`.
#[derive(Debug)]
pub struct SmallerStates;

impl Planner for SmallerStates {
    fn name(&self) -> &'static str {
        "smaller states"
    }

    fn signature(&self) -> Signature {
        let gives = ["robot", "state", "smaller"].map(|property| format!("{SMALLER}.{property}: text"));
        Signature { needs: OF_ROBOTS.map(str::to_owned).into(), gives: gives.into() }
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let fact =
            |what| PlannerError::Fact { planner: self.name().to_owned(), class: "ROBOTS".to_owned(), what };
        let (states, _) = moving_states(known, world.clearance).map_err(fact)?;
        let pairs = states.iter().flat_map(|state| states.iter().map(move |smaller| (state, smaller)));
        let pairs: Vec<_> = pairs.filter(|(state, smaller)| fits_wherever(world, smaller, state)).collect();
        let table = Table::default()
            .with("robot", pairs.iter().map(|(state, _)| state.robot.clone()).collect::<Column>())
            .with("state", pairs.iter().map(|(state, _)| state.state.clone()).collect::<Column>())
            .with("smaller", pairs.iter().map(|(_, smaller)| smaller.state.clone()).collect::<Column>());
        Ok(Facts::from([(SMALLER.to_owned(), table)]))
    }
}

fn fits_wherever(world: &World, smaller: &State, state: &State) -> bool {
    let narrowest = state.length.map_or(state.width, |length| length.min(state.width));
    let passes = |of: &State, bridge: f64| of.height < bridge;
    smaller.robot == state.robot
        && smaller.state != state.state
        && smaller.length.is_none()
        && smaller.width <= narrowest
        && world.bridges.iter().all(|bridge| passes(smaller, bridge.height) || !passes(state, bridge.height))
}
