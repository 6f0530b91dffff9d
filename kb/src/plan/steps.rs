//! Asks the rules where a part goes in the junction that it is about to enter.

use std::sync::Arc;

use adit_engine::{ClassError, Consultation, Datum, RuleBase, Type};
use adit_planners::channels::assembly::{Decision, Margin, StepFacts};

use super::consult::{Class, consult, is_same, meant};
use super::gap::Wishes;
use super::refusal::{NoPath, Spoke};
use super::said::Fact;

/// What rules are told of a step of a part: it is about to enter a junction.
const STEPS: &[(&str, Type)] = &[
    ("part", Type::Text),
    ("dimensions", Type::Number),
    ("junction", Type::Number),
    ("next", Type::Number),
    ("entering", Type::Text),
    ("leaving", Type::Text),
    ("junction_min_x", Type::Number),
    ("junction_min_y", Type::Number),
    ("junction_min_z", Type::Number),
    ("junction_max_x", Type::Number),
    ("junction_max_y", Type::Number),
    ("junction_max_z", Type::Number),
    ("part_min_x", Type::Number),
    ("part_min_y", Type::Number),
    ("part_min_z", Type::Number),
    ("part_max_x", Type::Number),
    ("part_max_y", Type::Number),
    ("part_max_z", Type::Number),
    ("next_min_x", Type::Number),
    ("next_min_y", Type::Number),
    ("next_min_z", Type::Number),
    ("next_max_x", Type::Number),
    ("next_max_y", Type::Number),
    ("next_max_z", Type::Number),
    ("bound_x", Type::Number),
    ("bound_y", Type::Number),
    ("bound_z", Type::Number),
    ("room", Type::Number),
    ("asked", Type::Text),
    ("asked_x", Type::Number),
    ("asked_y", Type::Number),
    ("asked_z", Type::Number),
    ("fragile", Type::Truth),
    ("hurry", Type::Truth),
];

const OUTPUTS: [&str; 9] =
    ["rule", "margin_x", "margin_y", "margin_z", "gap_x", "gap_y", "gap_z", "refusal", "action"];
const RULE: usize = 0;
const MARGIN: usize = 1;
const GAP: usize = 4;
const REFUSAL: usize = 7;
const ACTION: usize = 8;
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// What rules are told of steps, and what they are asked.
pub(super) fn class() -> Class {
    Class { name: "STEPS", told: STEPS.to_vec(), asked: &OUTPUTS }
}

/// The rules, ready to be asked step after step.
#[derive(Debug)]
pub struct Steps(Consultation, Option<String>);

impl Steps {
    pub fn new(rules: &Arc<RuleBase>) -> Result<Self, ClassError> {
        Ok(Self::of(class().consultation(rules)?))
    }

    /// Of rules that are ready to be asked about steps.
    pub const fn of(steps: Consultation) -> Self {
        Self(steps, None)
    }

    /// The first rule that failed when it was asked.
    pub fn trouble(&self) -> Option<&str> {
        self.1.as_deref()
    }

    /// What the part does on its way into the last step's junction, if rules say so.
    pub fn action(&self) -> Option<Arc<str>> {
        self.0.text(ACTION)
    }

    /// What the rules say of a step.
    pub fn decide<const D: usize>(
        &mut self,
        facts: &StepFacts<D>,
        wishes: Wishes<'_, D>,
    ) -> Result<Decision<D>, NoPath> {
        consult(&mut self.0, &object(facts, wishes), &mut self.1);
        if let Some(reason) = self.0.text(REFUSAL) {
            return Err(NoPath::at(facts.number, reason.to_string()));
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
                    return Err(NoPath::at(facts.number, reason));
                }
            }
        }
        Ok(decision)
    }

    fn margin(&self, axis: usize) -> Result<Margin, Option<String>> {
        let (low, high) = SIDES[axis];
        meant(&self.0, MARGIN + axis, &[(low, Margin::Low), (high, Margin::High), ("keep", Margin::Keep)])
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
    pub fn facts(&mut self) -> Vec<Fact> {
        super::said::facts(&mut self.0, "STEPS", STEPS, &OUTPUTS)
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
    object[const { place("part") }] = Datum::Text(wishes.mover);
    object[const { place("dimensions") }] = Datum::Number(D as f64);
    object[const { place("junction") }] = Datum::Number(facts.number as f64);
    object[const { place("entering") }] = Datum::Text(AXES[named::<D>(facts.entering)]);
    object[const { place("leaving") }] = Datum::Text(AXES[named::<D>(facts.leaving)]);
    let mut room = f64::INFINITY;
    for at in 0..D {
        let axis = named::<D>(at);
        object[const { place("junction_min_x") } + axis] = Datum::Number(facts.junction.min[at]);
        object[const { place("junction_max_x") } + axis] = Datum::Number(facts.junction.max[at]);
        object[const { place("part_min_x") } + axis] = Datum::Number(facts.part.min[at]);
        object[const { place("part_max_x") } + axis] = Datum::Number(facts.part.max[at]);
        if let Some(next) = &facts.next {
            object[const { place("next_min_x") } + axis] = Datum::Number(next.min[at]);
            object[const { place("next_max_x") } + axis] = Datum::Number(next.max[at]);
        }
        object[const { place("bound_x") } + axis] = Datum::Number(facts.bound[at]);
        object[const { place("asked_x") } + axis] = wishes.gap.along(at).into();
        room = room.min(facts.bound[at] / facts.part.size(at));
    }
    if facts.next.is_some() {
        object[const { place("next") }] = Datum::Number((facts.number - 1) as f64);
    }
    object[const { place("room") }] = Datum::Number(room);
    object[const { place("asked") }] = Datum::Text(wishes.gap.word());
    object[const { place("fragile") }] = Datum::Truth(wishes.fragile);
    object[const { place("hurry") }] = Datum::Truth(wishes.hurry);
    object
}

/// Where a property stands in the list; asked when compiled.
const fn place(name: &str) -> usize {
    let mut at = 0;
    while !is_same(STEPS[at].0, name) {
        at += 1;
    }
    at
}
