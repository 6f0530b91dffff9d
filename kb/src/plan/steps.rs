//! Asks the rules where a part goes in the junction that it is about to enter.

use std::sync::Arc;

use adit_engine::{ClassError, Consultation, Datum, RuleBase};
use adit_planners::channels::assembly::{Decision, Margin, StepFacts};

use super::gap::Asked;
use super::refusal::{NoPath, Spoke};
use super::rules::{STEPS, place};

pub(super) const OUTPUTS: [&str; 8] =
    ["rule", "margin_x", "margin_y", "margin_z", "gap_x", "gap_y", "gap_z", "refusal"];
const RULE: usize = 0;
const MARGIN: usize = 1;
const GAP: usize = 4;
const REFUSAL: usize = 7;
/// The axes, as rules call them.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The rules, ready to be asked step after step.
#[derive(Debug)]
pub struct Steps(Consultation);

/// What a world says of each step, besides its geometry.
#[derive(Clone, Copy, Debug)]
pub struct Wishes<'a, const D: usize> {
    /// The gap that is asked for at this junction.
    pub gap: &'a Asked<D>,
    /// Whether the part must not be scratched.
    pub fragile: bool,
    pub hurry: bool,
}

impl Steps {
    pub fn new(rules: Arc<RuleBase>) -> Result<Self, ClassError> {
        Ok(Self(Consultation::new(rules, "STEPS", STEPS, &OUTPUTS)?))
    }

    /// What the rules say of a step.
    pub fn decide<const D: usize>(
        &mut self,
        facts: &StepFacts<D>,
        wishes: Wishes<'_, D>,
    ) -> Result<Decision<D>, NoPath> {
        self.0.consult(&object(facts, wishes));
        if let Some(reason) = self.0.text(REFUSAL) {
            return Err(NoPath {
                junction: Some(facts.number),
                reason: reason.to_string(),
                considered: vec![],
            });
        }
        let mut decision = Decision { rule: self.0.number(RULE), gap: [0.0; D], margin: [Margin::Keep; D] };
        for at in 0..D {
            let axis = named::<D>(at);
            match self.0.number(GAP + axis) {
                Some(gap) => decision.gap[at] = gap,
                None => return Err(self.silent(facts.number, OUTPUTS[GAP + axis])),
            }
            match self.margin(axis) {
                Ok(margin) => decision.margin[at] = margin,
                Err(None) => return Err(self.silent(facts.number, OUTPUTS[MARGIN + axis])),
                Err(Some(found)) => {
                    let reason = format!(
                        "rules give {} of junction {} as \"{found}\"; expected \"{}\", \"{}\" or \"keep\"",
                        OUTPUTS[MARGIN + axis],
                        facts.number,
                        SIDES[axis].0,
                        SIDES[axis].1,
                    );
                    return Err(NoPath { junction: Some(facts.number), reason, considered: vec![] });
                }
            }
        }
        Ok(decision)
    }

    fn margin(&self, axis: usize) -> Result<Margin, Option<String>> {
        let output = MARGIN + axis;
        if self.0.is(output, SIDES[axis].0) {
            Ok(Margin::Low)
        } else if self.0.is(output, SIDES[axis].1) {
            Ok(Margin::High)
        } else if self.0.is(output, "keep") {
            Ok(Margin::Keep)
        } else {
            Err(self.0.value(output).map(|value| value.to_string()))
        }
    }

    /// No rule spoke, or several that disagree.
    fn silent(&mut self, junction: usize, property: &str) -> NoPath {
        super::refusal::silent(&mut self.0, "STEPS", junction, property)
    }

    /// Which rules spoke of the last step's margins, and why the others did not.
    pub fn considered(&mut self) -> Vec<Spoke> {
        self.0.considered("margin_x").into_iter().map(Spoke::from).collect()
    }

    /// Whether the rules look at one step alone, so that they are asked at full speed.
    pub const fn is_direct(&self) -> bool {
        self.0.is_direct()
    }

    /// What the rules were told of the last step and what they concluded, by property.
    pub fn facts(&mut self) -> Vec<super::keep::Fact> {
        super::keep::facts(&mut self.0, "STEPS", STEPS, &OUTPUTS)
    }
}

/// The sides of small and of large coordinates, as rules call them.
const SIDES: [(&str, &str); 3] = [("left", "right"), ("front", "back"), ("down", "up")];

/// Which of x, y and z an axis is.
pub(super) const fn named<const D: usize>(axis: usize) -> usize {
    if D == 2 { 2 * axis } else { axis }
}

fn object<'a, const D: usize>(facts: &StepFacts<D>, wishes: Wishes<'a, D>) -> [Datum<'a>; STEPS.len()] {
    let mut object = [Datum::Unknown; STEPS.len()];
    object[const { place(STEPS, "dimensions") }] = Datum::Number(D as f64);
    object[const { place(STEPS, "junction") }] = Datum::Number(facts.number as f64);
    object[const { place(STEPS, "entering") }] = Datum::Text(AXES[named::<D>(facts.entering)]);
    object[const { place(STEPS, "leaving") }] = Datum::Text(AXES[named::<D>(facts.leaving)]);
    let mut room = f64::INFINITY;
    for at in 0..D {
        let axis = named::<D>(at);
        object[const { place(STEPS, "junction_min_x") } + axis] = Datum::Number(facts.junction.min[at]);
        object[const { place(STEPS, "junction_max_x") } + axis] = Datum::Number(facts.junction.max[at]);
        object[const { place(STEPS, "part_min_x") } + axis] = Datum::Number(facts.part.min[at]);
        object[const { place(STEPS, "part_max_x") } + axis] = Datum::Number(facts.part.max[at]);
        if let Some(next) = &facts.next {
            object[const { place(STEPS, "next_min_x") } + axis] = Datum::Number(next.min[at]);
            object[const { place(STEPS, "next_max_x") } + axis] = Datum::Number(next.max[at]);
        }
        object[const { place(STEPS, "bound_x") } + axis] = Datum::Number(facts.bound[at]);
        object[const { place(STEPS, "asked_x") } + axis] = wishes.gap.along(at).into();
        room = room.min(facts.bound[at] / facts.part.size(at));
    }
    if facts.next.is_some() {
        object[const { place(STEPS, "next") }] = Datum::Number((facts.number - 1) as f64);
    }
    object[const { place(STEPS, "room") }] = Datum::Number(room);
    object[const { place(STEPS, "asked") }] = Datum::Text(wishes.gap.word());
    object[const { place(STEPS, "fragile") }] = Datum::Truth(wishes.fragile);
    object[const { place(STEPS, "hurry") }] = Datum::Truth(wishes.hurry);
    object
}
