//! States that others stand in for: one that is no easier than a smaller one, and no cheaper to change into or out of, is on no
//! best way, so nobody changes from a third one into it.

use super::record::State;
use crate::facts::Facts;

/// Of which two states of a robot the one fits wherever the other does.
pub(super) const SMALLER: &str = "SMALLER_STATES";

/// What is read of which states stand in for others, where anybody says so.
pub(super) const NEEDS: [&str; 5] = [
    "SMALLER_STATES.robot?",
    "SMALLER_STATES.state?",
    "SMALLER_STATES.smaller?",
    "SMALLER_STATES.stands_in?",
    "SMALLER_STATES.rooms_differ?",
];

/// Which state stands in for which.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StandIns {
    /// For states, by index, the one that can stand in for each.
    by: Vec<Option<usize>>,
    /// Those that are changed into and out of from everywhere all the same.
    needed: Vec<usize>,
}

impl StandIns {
    /// Of so many states, from pairs of a state and one that can stand in for it. Of two that can for each other, the later one
    /// is stood in for; of several, the first one that itself is not.
    pub fn new(states: usize, pairs: &[(usize, usize)]) -> Self {
        let of = |state: usize| pairs.iter().filter(move |pair| pair.0 == state).map(|pair| pair.1);
        let mut first = vec![None; states];
        for state in (0..states).rev() {
            first[state] = of(state).find(|&other| root(&first, other) != state);
        }
        let is_own = |state: &usize| first[*state].is_none();
        let best = |state: usize| first[state].and_then(|first| of(state).find(is_own).or(Some(first)));
        Self { by: (0..states).map(best).collect(), needed: Vec::new() }
    }

    /// Those that rules say.
    pub(super) fn read(known: &Facts, states: &[State]) -> Result<Self, String> {
        let Some(table) = known.get(SMALLER).filter(|table| table.column("stands_in").is_some()) else {
            return Ok(Self::default());
        };
        let (robots, of, smaller) = (table.texts("robot")?, table.texts("state")?, table.texts("smaller")?);
        let index = |row: usize, name: &[Option<String>]| {
            states
                .iter()
                .position(|state| state.robot == robots[row] && Some(&state.state) == name[row].as_ref())
        };
        let pairs = |property: &str| -> Result<Vec<(usize, usize)>, String> {
            let truths = table.truths(property)?;
            let rows = (0..table.len()).filter(|&row| truths[row] == Some(true));
            Ok(rows.filter_map(|row| Some((index(row, of)?, index(row, smaller)?))).collect())
        };
        let mut all = Self::new(states.len(), &pairs("stands_in")?);
        if table.column("rooms_differ").is_some() {
            let differ = pairs("rooms_differ")?;
            all.needed = (0..states.len())
                .filter(|&state| all.by[state].is_some_and(|by| differ.contains(&(state, by))))
                .collect();
        }
        Ok(all)
    }

    /// Whether a change between two states may be on a best way, or joins one of them with its stand-in. That one stays where
    /// the state turns out to be needed, so that the same doors tell so before and after.
    pub(super) fn may_pay(&self, one: usize, other: usize) -> bool {
        let by = |state: usize| self.by.get(state).copied().flatten();
        let is_free = |state: usize| by(state).is_none() || self.needed.contains(&state);
        one == other || is_free(one) && is_free(other) || by(one) == Some(other) || by(other) == Some(one)
    }
}

/// The state that stands in for one in the end.
fn root(chosen: &[Option<usize>], mut state: usize) -> usize {
    while let Some(other) = chosen[state] {
        state = other;
    }
    state
}
