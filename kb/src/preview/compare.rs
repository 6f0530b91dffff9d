//! Routes between places under two named tunings, side by side.

use std::collections::BTreeMap;
use std::sync::Arc;

use adit_db::history::Author;
use adit_db::{Store, Tx};
use serde::Serialize;

use crate::edit::Edit;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::inputs::Inputs;
use crate::live::Memory;
use crate::words::progress::Silent;

/// The name that stands for no tuning at all.
pub const BASE: &str = "base";

/// More pairs of places than this are not compared.
const MOST: usize = 5_000;

/// A route between two places.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// Whose.
    pub robot: String,
    /// Where from.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// Cost with the first tuning on; `None`: no route.
    pub one: Option<f64>,
    /// Cost with the other tuning on; `None`: no route.
    pub other: Option<f64>,
}

type Costs = BTreeMap<(String, String, String), Option<f64>>;

impl KnowledgeBase {
    /// What kept routes between places cost with one tuning on alone, and with another; `base` is none. Nothing is
    /// changed.
    pub fn compare(&self, one: &str, other: &str) -> Result<Vec<Compared>> {
        let inputs = self.inputs(&Silent)?;
        let mut store = Store::open(self.database())?;
        let mut costs = [one, other].map(|tuning| self.costs(&mut store, &inputs, tuning)).into_iter();
        let (Some(one), Some(other)) = (costs.next(), costs.next()) else { return Ok(Vec::new()) };
        let (one, other) = (one?, other?);
        let pairs = one.keys().chain(other.keys().filter(|pair| !one.contains_key(*pair)));
        let compared = pairs.map(|pair| {
            let (robot, start, goal) = pair.clone();
            let cost = |costs: &Costs| costs.get(pair).copied().flatten();
            Compared { robot, start, goal, one: cost(&one), other: cost(&other) }
        });
        Ok(compared.collect())
    }

    fn costs(&self, store: &mut Store, inputs: &Arc<Inputs>, tuning: &str) -> Result<Costs> {
        store.rehearse(|tx| {
            let author = Author { who: String::new(), why: String::new() };
            let mut is_on = false;
            for active in tx.active_tunings()? {
                if active == tuning {
                    is_on = true;
                } else {
                    Edit::Switch(active, false).apply(tx, self, &inputs.rules, &author)?;
                }
            }
            if tuning != BASE && !is_on {
                Edit::Switch(tuning.to_owned(), true).apply(tx, self, &inputs.rules, &author)?;
            }
            Memory::build(tx, &self.shared(), inputs, &Silent)?;
            if self.course().is_some() {
                return Ok(tx.course_costs()?.into_iter().collect());
            }
            costs_between_places(tx)
        })
    }
}

fn costs_between_places(tx: &mut Tx<'_>) -> Result<Costs> {
    let places = tx.places()?;
    let is_place = |name: &str| places.iter().any(|place| place.place == name);
    let starts: Vec<_> = tx.starts()?.into_iter().filter(|start| is_place(&start.name)).collect();
    if starts.len() * places.len() > MOST {
        let message =
            format!("{} routes between places are more than are compared", starts.len() * places.len());
        let help = format!("name at most {} in `starts` of site.toml", MOST / places.len().max(1));
        return Err(Error::said(Code::TuningTooMany, message, Some(help)));
    }
    let mut costs = Costs::new();
    for start in &starts {
        for goal in places.iter().filter(|goal| goal.place != start.name) {
            let route = tx.route(&start.robot, &start.name, &goal.place)?;
            let pair = (start.robot.clone(), start.name.clone(), goal.place.clone());
            costs.insert(pair, route.and_then(|route| route.cost));
        }
    }
    Ok(costs)
}
