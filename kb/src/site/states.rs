//! The states of robots as they count.

use adit_db::robot::State;
use adit_db::{Cell, Tx};

use crate::error::Result;

/// All states, with the named tunings that are on, and the sizes that rules made of those in the table.
pub fn in_force(tx: &mut Tx<'_>) -> Result<Vec<State>> {
    let mut states = tx.states_in_force()?;
    for state in &mut states {
        let key = Cell::from(format!("{}/{}", state.robot, state.state).as_str());
        for concluded in tx.conclusions("robots", &key)? {
            let size = match concluded.property.as_str() {
                "height" => &mut state.height,
                "width" => &mut state.width,
                _ => continue,
            };
            if let Cell::Real(metres) = concluded.value {
                *size = metres;
            }
        }
    }
    Ok(states)
}
