//! What a robot that learns a building asks: rules say which opening it explores next, and when it is done.

use std::sync::Arc;

use adit_engine::{Consultation, Datum, RuleBase, Type};
use adit_planners::local_model::{SegmentFacts, Transition};
use adit_planners::navigation::learn::{Guide, OpeningFacts};
use adit_planners::navigation::{Judge, StateDecision, StateFacts, WayFacts};

use super::floor::Floor;
use super::judge::RuleJudge;
use crate::error::{Error, Result};
use crate::plan::rules::{consult, place};

/// What rules are told of an opening.
pub const OPENINGS: &[(&str, Type)] = &[
    ("width", Type::Number),
    ("distance", Type::Number),
    ("off_asked", Type::Number),
    ("is_in_sight", Type::Truth),
    ("times_tried", Type::Number),
    ("time", Type::Number),
    ("driven", Type::Number),
    ("radius", Type::Number),
];

/// What is asked of them.
pub(crate) const OF_OPENINGS: [&str; 2] = ["explore", "worth"];

/// Rules as the guide of an exploration.
#[derive(Debug)]
pub struct RuleGuide {
    judge: RuleJudge,
    openings: Consultation,
    trouble: Option<String>,
}

impl RuleGuide {
    /// Makes ready for a world.
    pub fn new(floor: &Floor, rules: &Arc<RuleBase>) -> Result<Self> {
        let openings = Consultation::new(Arc::clone(rules), "OPENINGS", OPENINGS, &OF_OPENINGS)
            .map_err(|error| Error::said("simulate/rules", error.to_string(), None))?;
        Ok(Self { judge: floor.judge(rules)?, openings, trouble: None })
    }

    /// The first thing that failed, or that the rules did not say, or said in words that mean nothing.
    pub fn trouble(&self) -> Option<&str> {
        self.judge.trouble().or(self.trouble.as_deref())
    }
}

impl Judge for RuleGuide {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        self.judge.next_state(facts)
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        self.judge.segment(facts)
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        self.judge.weigh(facts)
    }
}

impl Guide for RuleGuide {
    fn opening(&mut self, facts: &OpeningFacts) -> Option<f64> {
        if self.trouble().is_some() {
            return None;
        }
        let mut object = [Datum::Unknown; OPENINGS.len()];
        for (at, number) in [
            (const { place(OPENINGS, "width") }, facts.width_m),
            (const { place(OPENINGS, "distance") }, facts.distance_m),
            (const { place(OPENINGS, "times_tried") }, f64::from(facts.times_tried)),
            (const { place(OPENINGS, "time") }, facts.time_s),
            (const { place(OPENINGS, "driven") }, facts.driven_m),
            (const { place(OPENINGS, "radius") }, facts.radius_m),
        ] {
            object[at] = Datum::Number(number);
        }
        object[const { place(OPENINGS, "off_asked") }] = facts.off_asked.into();
        object[const { place(OPENINGS, "is_in_sight") }] = Datum::Truth(facts.is_in_sight);
        consult(&mut self.openings, &object, &mut self.trouble);
        match (self.openings.truth(0), self.openings.number(1)) {
            (Some(false), _) => None,
            (Some(true), Some(worth)) if !worth.is_nan() => Some(worth),
            _ => {
                let what = "rules do not say whether an opening is explored, or what it is worth";
                self.trouble.get_or_insert_with(|| what.to_owned());
                None
            }
        }
    }
}
