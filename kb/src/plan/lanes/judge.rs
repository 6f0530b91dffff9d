//! Rules judge lanes: what a vehicle type makes of each.

use adit_engine::Consultation;

use super::travel::{Travel, told};
use crate::plan::consult::{Class, consult, object, typed};
use crate::plan::{Said, Spoke, said};

const CLASS: &str = "TRAVELS";
const ASKED: &[&str] = &["weight", "passable", "refusal", "action"];

/// What rules are told of a vehicle type on a lane, and what they are asked.
pub fn class() -> Class {
    Class::new(CLASS, told(), ASKED)
}

/// The rules, ready to be asked about lanes.
pub struct Judge {
    rules: Consultation,
    trouble: Option<String>,
}

/// What a lane weighs, or why a vehicle may not drive there.
pub type Weighed = Result<f64, String>;

impl Judge {
    pub const fn new(rules: Consultation) -> Self {
        Self { rules, trouble: None }
    }

    /// The first rule that failed.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    pub fn weigh(&mut self, travel: &Travel<'_>, lane: &str) -> Weighed {
        consult(&mut self.rules, &object(told(), travel), &mut self.trouble);
        match (self.rules.truth(1), self.rules.number(0)) {
            (Some(true), Some(weight)) if weight.is_finite() && weight >= 0.0 => Ok(weight),
            (Some(true), Some(weight)) => {
                Err(format!("rules give lane {lane} the weight {weight}; it must be finite and not negative"))
            }
            (Some(true), None) => Err(format!("rules do not say what lane {lane} weighs, or disagree")),
            (Some(false), _) => {
                let refusal = self.rules.text(2).map(|refusal| refusal.to_string());
                Err(refusal.unwrap_or_else(|| format!("rules let nobody drive on lane {lane}")))
            }
            (None, _) => Err(format!("rules do not say whether one may drive on lane {lane}, or disagree")),
        }
    }

    /// What rules were told of it and what they said.
    pub fn said(&mut self, travel: &Travel<'_>, lane: &str) -> Said {
        self.rules.consult(&object(told(), travel));
        let considered = self.rules.considered("weight").into_iter().map(Spoke::from).collect();
        let facts = said::facts(&mut self.rules, CLASS, &typed(told()), ASKED);
        Said { junction: 0, place: format!("lane {lane}"), considered, facts, action: self.rules.text(3) }
    }
}
