//! Tuning from experience: what robots measured on their way, and the hardness that fits it best.
//!
//! A traversal is so many metres in a state; what was measured (seconds, joules) is told of it, or of the whole mission
//! that it is a part of: measured = sum of distance times hardness, and noise. [`estimate`] finds the hardness of each
//! state by least squares, none of them negative.
//!
//! Time and energy scatter more on long ways than on short ones, as if each metre added a noise of its own: so an
//! observation counts by the inverse of its metres. Intervals do not rest on that: they are made with the errors as they
//! were found (White's, in the form HC3 of `MacKinnon` and White, which small samples need), at 95 % of Student's t.
//!
//! Hardness has no unit of its own: all of it may be scaled, and each route stays the best. So what is proposed is scaled
//! such that one state, the one with the most metres, keeps its present hardness, unless the measure itself is
//! wanted as hardness.

mod estimate;
mod nnls;
mod upload;

use std::collections::{BTreeMap, BTreeSet};

use adit_db::history::Author;
use adit_db::robot::State;
use adit_db::traversal::Traversal;
use adit_db::{Store, Tx};
use serde::Serialize;

use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::generation;
use crate::words::suggest::did_you_mean;
pub use estimate::{Estimate, Observation, Unknown, Value, estimate};
pub use upload::{Row, rows_of_csv};

/// What is proposed from all traversals of one robot and measure.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Fit {
    /// The state of the knowledge base that the present values are of.
    pub generation: u64,
    /// Whose.
    pub robot: String,
    /// Of which measure.
    pub measure: Option<String>,
    /// The state that keeps its hardness; `null`: hardness is the measure a metre.
    pub reference: Option<String>,
    /// Traversals and missions that count.
    pub observations: usize,
    /// How much an observation of one metre scatters, in the measure.
    pub residual_sd: Option<f64>,
    /// A proposal for each state that was driven in.
    pub cells: Vec<FitCell>,
    /// What cannot be said, and why.
    pub notes: Vec<String>,
}

/// What is proposed for one cell.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct FitCell {
    /// Its table.
    pub table: String,
    /// Its row.
    pub key: String,
    /// Its column.
    pub column: String,
    /// What it is.
    pub present: f64,
    /// What fits best; `null` where the traversals do not tell.
    pub proposed: Option<f64>,
    /// Lower end of the interval that holds the true value with 95 %.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Observations in which the state was driven in.
    pub observations: usize,
}

/// What hardness is measured in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale<'a> {
    /// The state with the most metres keeps its present hardness.
    #[default]
    MostDriven,
    /// This state does.
    Reference(&'a str),
    /// Hardness is the measure a metre.
    Measure,
}

/// What was added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct Added {
    /// Rows that were added.
    pub added: usize,
    /// How many of them are as one that was there already, and count twice from now on.
    pub again: usize,
    /// Rows that there now are.
    pub total: usize,
}

/// Adds traversals, all or none.
pub(crate) fn add(tx: &mut Tx<'_>, rows: &[Row], measure: Option<&str>, author: &Author) -> Result<Added> {
    let (states, before) = (tx.states()?, tx.traversals()?);
    let new = upload::checked(rows, measure, &states, &before, &author.who)?;
    tx.add_traversals(&new)?;
    let key = |row: &Traversal| {
        let Traversal { mission, robot, state, distance, measured, measure, .. } = row.clone();
        (mission, robot, state, measure, distance.to_bits(), measured.to_bits())
    };
    let known: BTreeSet<_> = before.iter().map(key).collect();
    let again = new.iter().filter(|row| known.contains(&key(row))).count();
    Ok(Added { added: new.len(), again, total: before.len() + new.len() })
}

impl KnowledgeBase {
    /// Adds traversals, all or none; an error names the first row that cannot be, from 1.
    ///
    /// # Arguments
    /// `measure` is what is measured where a row does not say.
    pub fn add_traversals(&self, rows: &[Row], measure: Option<&str>, author: &Author) -> Result<Added> {
        Store::open(self.database())?.transaction(|tx| add(tx, rows, measure, author))
    }

    /// All traversals, in the order in which they were added.
    pub fn traversals(&self) -> Result<Vec<Traversal>> {
        Ok(Store::open_read_only(self.database())?.snapshot(|tx| tx.traversals())?)
    }

    /// Removes all traversals; how many there were.
    pub fn clear_traversals(&self) -> Result<u64> {
        Ok(Store::open(self.database())?.transaction(|tx| tx.clear_traversals())?)
    }

    /// The hardness of a robot's states that fits its traversals best.
    ///
    /// # Arguments
    /// `robot` and `measure` may be left out where there is one.
    pub fn fit(&self, robot: Option<&str>, measure: Option<&str>, scale: Scale<'_>) -> Result<Fit> {
        Store::open_read_only(self.database())?.snapshot(|tx| fit(tx, robot, measure, scale))
    }
}

fn fit(tx: &mut Tx<'_>, robot: Option<&str>, measure: Option<&str>, scale: Scale<'_>) -> Result<Fit> {
    let robot = crate::answer::pick_robot(tx, robot)?;
    let mut rows = tx.traversals()?;
    rows.retain(|row| row.robot == robot);
    let measure = one_measure(&rows, measure)?;
    rows.retain(|row| Some(&row.measure) == measure.as_ref());
    let mut states = tx.states_in_force()?;
    states.retain(|state| state.robot == robot);
    let estimate = estimate(&observations(&rows));
    let (reference, factor, mut notes) = scaled(scale, &states, &rows, &estimate)?;
    let of_reference = reference.as_ref().and_then(|state| estimate.values.get(state));
    let cell = |state: &State| {
        let value = estimate.values.get(&state.state)?;
        let is_reference = reference.as_deref() == Some(&*state.state);
        let interval = match (is_reference, of_reference) {
            (true, _) => Some((state.hardness, state.hardness)),
            (false, Some(reference)) => estimate.ratio(value, reference),
            (false, None) => value.interval,
        };
        let proposed =
            if is_reference { Some(state.hardness) } else { value.value.map(|value| value * factor) };
        let scale = if is_reference {
            1.0
        } else if of_reference.is_some() {
            factor * of_reference.and_then(|r| r.value).unwrap_or(1.0)
        } else {
            factor
        };
        Some(FitCell {
            table: "robots".to_owned(),
            key: format!("{}/{}", state.robot, state.state),
            column: "hardness".to_owned(),
            present: state.hardness,
            proposed,
            low: interval.map(|(low, _)| low * scale),
            high: interval.map(|(_, high)| high * scale),
            observations: value.observations,
        })
    };
    let cells: Vec<FitCell> = states.iter().filter_map(cell).collect();
    notes.extend(estimate.notes());
    // One that no room is cut for is not driven in.
    let cut = tx.states_with_rooms(&robot)?;
    let may_be_driven_in = |state: &&str| cut.is_empty() || cut.iter().any(|with_rooms| with_rooms == state);
    let idle: Vec<&str> = states
        .iter()
        .map(|state| &*state.state)
        .filter(|state| !estimate.values.contains_key(*state))
        .filter(may_be_driven_in)
        .collect();
    if !idle.is_empty() {
        notes.push(format!("never driven in: {}", idle.join(", ")));
    }
    for gone in estimate.values.keys().filter(|state| states.iter().all(|known| known.state != **state)) {
        notes.push(format!(
            "{gone} is no state of {robot} any more: its metres count, and nothing is proposed for it"
        ));
    }
    Ok(Fit {
        generation: generation::read(tx)?,
        robot,
        measure,
        reference,
        observations: estimate.observations,
        residual_sd: estimate.residual_sd,
        cells,
        notes,
    })
}

/// The measure that is asked for, or the only one.
fn one_measure(rows: &[Traversal], wanted: Option<&str>) -> Result<Option<String>> {
    let mut known: Vec<&str> = rows.iter().map(|row| &*row.measure).collect();
    known.sort_unstable();
    known.dedup();
    match (wanted, known.as_slice()) {
        (Some(wanted), _) if known.contains(&wanted) || known.is_empty() => Ok(Some(wanted.to_owned())),
        (Some(wanted), _) => {
            let help = did_you_mean(wanted, known.iter().copied());
            let help = help.unwrap_or_else(|| format!("there are measurements of {}", known.join(", ")));
            Err(Error::said(
                Code::FitUnknownMeasure,
                format!("nothing is measured in `{wanted}`"),
                Some(help),
            ))
        }
        (None, [one]) => Ok(Some((*one).to_owned())),
        (None, []) => Ok(None),
        (None, several) => {
            let message = format!("there are measurements of {}: say which are meant", several.join(", "));
            Err(Error::said(Code::FitWhichMeasure, message, Some("`--measure seconds`".to_owned())))
        }
    }
}

/// Traversals as observations: the rows of a mission are one.
fn observations(rows: &[Traversal]) -> Vec<Observation> {
    let mut missions: BTreeMap<&str, Observation> = BTreeMap::new();
    let mut all = Vec::new();
    for row in rows {
        let one = |observation: &mut Observation| {
            *observation.metres.entry(row.state.clone()).or_default() += row.distance;
        };
        if let Some(mission) = &row.mission {
            one(missions.entry(mission).or_insert_with(|| Observation::measured(row.measured)));
        } else {
            let mut single = Observation::measured(row.measured);
            one(&mut single);
            all.push(single);
        }
    }
    all.extend(missions.into_values());
    all
}

/// Which state keeps its hardness, and by what all others are multiplied.
fn scaled(
    scale: Scale<'_>,
    states: &[State],
    rows: &[Traversal],
    estimate: &Estimate,
) -> Result<(Option<String>, f64, Vec<String>)> {
    let metres = |state: &State| {
        rows.iter().filter(|row| row.state == state.state).map(|row| row.distance).sum::<f64>()
    };
    let usable = |state: &&State| {
        let value = estimate.values.get(&state.state).and_then(|value| value.value);
        state.hardness > 0.0 && value.is_some_and(|value| value > 0.0)
    };
    let reference = match scale {
        Scale::Measure => return Ok((None, 1.0, Vec::new())),
        Scale::MostDriven => {
            states.iter().filter(usable).max_by(|one, two| metres(one).total_cmp(&metres(two)))
        }
        Scale::Reference(name) => {
            let found = states.iter().find(|state| state.state == name);
            let Some(found) = found else {
                let help = did_you_mean(name, states.iter().map(|state| &*state.state));
                return Err(Error::said(Code::FitUnknownState, format!("there is no state `{name}`"), help));
            };
            Some(found).filter(usable)
        }
    };
    match reference {
        Some(state) => {
            let value = estimate.values.get(&state.state).and_then(|value| value.value).unwrap_or(1.0);
            Ok((Some(state.state.clone()), state.hardness / value, Vec::new()))
        }
        None if rows.is_empty() => Ok((None, 1.0, vec!["there are no measurements yet".to_owned()])),
        None => {
            let note = "no state can keep its hardness: hardness is what was measured, per metre".to_owned();
            Ok((None, 1.0, vec![note]))
        }
    }
}
