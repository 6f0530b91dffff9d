//! What the steps of a route take, on a map that is not cut into rooms: rules are asked of each.

use std::sync::{Mutex, PoisonError};

use adit_db::course::Course as Row;
use adit_db::measure::Measures;
use adit_db::route::Step;
use adit_engine::Consultation;

use super::consult::{Class, Of, Property, consult, object, typed};
use super::course::Asked;
use crate::error::Result;

/// A step of a route, and the metres that it leads.
struct Leg<'r> {
    robot: &'r str,
    step: &'r Step,
    metres: Option<f64>,
}

fn told<'r>() -> [Property<Leg<'r>>; 7] {
    [
        ("robot", Of::Text(|of| Some(of.robot))),
        ("kind", Of::Text(|of| Some(&of.step.kind))),
        ("place", Of::Text(|of| Some(&of.step.place))),
        ("state", Of::Text(|of| of.step.state.as_deref())),
        ("action", Of::Text(|of| of.step.action.as_deref())),
        ("metres", Of::Perhaps(|of| of.metres)),
        ("hardness", Of::Perhaps(|of| of.step.hardness)),
    ]
}

/// What rules are told of such steps; they are asked for the measures that there are.
pub fn class() -> Class {
    Class { name: "LEGS", told: typed(told()), asked: &[] }
}

/// The rules, ready to be asked what steps take.
pub struct Legs {
    names: Vec<String>,
    asked: Mutex<(Consultation, Option<String>)>,
}

impl Legs {
    pub fn new(asked: &Asked<'_>) -> Result<Self> {
        let measures = asked.objects("MEASURES");
        let names: Vec<String> = measures.rows().filter_map(|row| measures.text(row, "measure")).collect();
        let wanted: Vec<&str> = names.iter().map(String::as_str).collect();
        let Class { name, told, .. } = class();
        let asked = Mutex::new((asked.about(name, &told, &wanted)?, None));
        Ok(Self { names, asked })
    }

    /// Has each step of a route say what it takes, each waypoint what the way there takes, and the route what all of it does.
    pub fn measure(&self, row: &mut Row) {
        if self.names.is_empty() || row.steps.is_empty() {
            return;
        }
        let metres = |index: usize| {
            let far = |index: usize| row.waypoints.get(index).and_then(|point| point.distance);
            Some(far(index + 1)? - far(index)?)
        };
        let taken: Vec<Measures> = row
            .steps
            .iter()
            .enumerate()
            .map(|(index, step)| self.taken(&Leg { robot: &row.robot, step, metres: metres(index) }))
            .collect();
        let nothing = |(name, _): (&String, &f64)| (name.clone(), 0.0);
        let mut sum = Measures(taken[0].0.iter().map(nothing).collect());
        if let Some(first) = row.waypoints.first_mut() {
            first.measures = sum.clone();
        }
        for (index, taken) in taken.into_iter().enumerate() {
            sum = sum.and(&taken);
            row.steps[index].measures = taken.rounded();
            if let Some(point) = row.waypoints.get_mut(index + 1) {
                point.measures = sum.rounded();
            }
        }
        row.measures = sum.rounded();
    }

    fn taken(&self, leg: &Leg<'_>) -> Measures {
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        let (rules, trouble) = &mut *asked;
        consult(rules, &object(told(), leg), trouble);
        let of = |(output, name): (usize, &String)| {
            let amount = rules.number(output)?;
            if amount.is_finite() && amount >= 0.0 {
                return Some((name.clone(), amount));
            }
            trouble.get_or_insert_with(|| {
                format!(
                    "rules give {} the {name} {amount}; it must be finite and not negative",
                    leg.step.place
                )
            });
            None
        };
        Measures(self.names.iter().enumerate().filter_map(of).collect())
    }

    /// The first rule that failed when it was asked, or the first number that nothing can take.
    pub fn trouble(&self) -> Option<String> {
        self.asked.lock().unwrap_or_else(PoisonError::into_inner).1.clone()
    }
}
