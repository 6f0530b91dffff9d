//! Asks the rules how a robot turns at the junction that it is about to enter, and what a passage weighs.

use std::sync::Arc;

use adit_engine::{ClassError, Consultation, Datum, RuleBase};
use adit_planners::channels::corridor::{
    Axis, Extreme, Offset, Part, Passage, Robot, Steer, StepFacts, Turn,
};

use super::gap::Asked;
use super::keep::Fact;
use super::refusal::{NoPath, Spoke, silent};
use super::rules::{PASSAGES, TURNS, place};

pub(super) const OUTPUTS: [&str; 10] =
    ["rule", "gap", "corner_x", "corner_y", "turns", "arrive_x", "arrive_y", "offset", "refusal", "remark"];
pub(super) const WEIGHED: [&str; 3] = ["weight", "passable", "refusal"];

/// The rules, ready to be asked turn after turn.
#[derive(Debug)]
pub struct Turns {
    junctions: Consultation,
    passages: Consultation,
    /// Why passages were refused, since the last path was looked for.
    refusals: Vec<Arc<str>>,
}

/// What a world says of each turn, besides its geometry.
#[derive(Clone, Copy, Debug)]
pub struct Wishes<'a> {
    pub gap: &'a Asked<1>,
    /// Whether the load must not be scratched.
    pub fragile: bool,
    pub hurry: bool,
}

impl Turns {
    pub fn new(rules: Arc<RuleBase>) -> Result<Self, ClassError> {
        Ok(Self {
            junctions: Consultation::new(Arc::clone(&rules), "TURNS", TURNS, &OUTPUTS)?,
            passages: Consultation::new(rules, "PASSAGES", PASSAGES, &WEIGHED)?,
            refusals: Vec::new(),
        })
    }

    /// Why passages were refused since this was last asked.
    pub fn take_refusals(&mut self) -> Vec<Arc<str>> {
        std::mem::take(&mut self.refusals)
    }

    /// What a passage weighs; `None` where it must not be used.
    pub fn weigh(
        &mut self,
        passage: &Passage,
        robot: Robot,
        wishes: Wishes<'_>,
    ) -> Result<Option<f64>, NoPath> {
        let mut object = [Datum::Unknown; PASSAGES.len()];
        object[const { place(PASSAGES, "channel") }] = Datum::Number(passage.channel as f64);
        object[const { place(PASSAGES, "length") }] = Datum::Number(passage.length);
        object[const { place(PASSAGES, "corridor") }] = Datum::Number(passage.width);
        object[const { place(PASSAGES, "room") }] = Datum::Number((passage.width - robot.width) / 2.0);
        object[const { place(PASSAGES, "width") }] = Datum::Number(robot.width);
        object[const { place(PASSAGES, "asked_gap") }] = wishes.gap.along(0).into();
        object[const { place(PASSAGES, "fragile") }] = Datum::Truth(wishes.fragile);
        object[const { place(PASSAGES, "hurry") }] = Datum::Truth(wishes.hurry);
        self.passages.consult(&object);
        let said = |what: &str| NoPath {
            junction: None,
            reason: format!("no rule says {what} of {passage}, or several disagree"),
            considered: vec![],
        };
        match self.passages.truth(1) {
            None => Err(said("whether it is passable")),
            Some(false) => {
                let refusal = self.passages.text(2);
                self.refusals.extend(refusal.filter(|refusal| !self.refusals.contains(refusal)));
                Ok(None)
            }
            Some(true) => self.passages.number(0).map(Some).ok_or_else(|| said("what the weight is")),
        }
    }

    /// How the rules turn the robot, and what they remark on.
    pub fn decide(
        &mut self,
        facts: &StepFacts,
        wishes: Wishes<'_>,
    ) -> Result<(Steer, Option<Arc<str>>), NoPath> {
        self.junctions.consult(&object(facts, wishes));
        let refused = |reason: String| NoPath { junction: Some(facts.junction), reason, considered: vec![] };
        if let Some(reason) = self.junctions.text(const { output("refusal") }) {
            return Err(refused(reason.to_string()));
        }
        let Some(gap) = self.junctions.number(const { output("gap") }) else {
            return Err(silent(&mut self.junctions, "TURNS", facts.junction, "gap"));
        };
        let steer = Steer {
            rule: self.junctions.number(const { output("rule") }).map(|rule| rule as u32),
            corner: (
                self.word(facts, const { output("corner_x") }, &EXTREMES)?,
                self.word(facts, const { output("corner_y") }, &EXTREMES)?,
            ),
            turn: self.word(facts, const { output("turns") }, &SENSES)?,
            gap,
            arriving: (
                self.word(facts, const { output("arrive_x") }, &OFFSETS)?,
                self.word(facts, const { output("arrive_y") }, &OFFSETS)?,
            ),
            measured_along: self.word(facts, const { output("offset") }, &AXES)?,
        };
        Ok((steer, self.junctions.text(const { output("remark") })))
    }

    /// What an output's word stands for.
    fn word<T: Copy>(&mut self, facts: &StepFacts, at: usize, words: &[(&str, T)]) -> Result<T, NoPath> {
        if let Some((_, meant)) = words.iter().find(|(word, _)| self.junctions.is(at, word)) {
            return Ok(*meant);
        }
        let Some(found) = self.junctions.value(at) else {
            return Err(silent(&mut self.junctions, "TURNS", facts.junction, OUTPUTS[at]));
        };
        let words: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let (name, junction) = (OUTPUTS[at], facts.junction);
        let reason =
            format!("rules give {name} of junction {junction} as \"{found}\"; expected {}", words.join(", "));
        Err(NoPath { junction: Some(facts.junction), reason, considered: vec![] })
    }

    /// Which rules spoke of the last turn's corner, and why the others did not.
    pub fn considered(&mut self) -> Vec<Spoke> {
        self.junctions.considered("corner_x").into_iter().map(Spoke::from).collect()
    }

    /// What the rules were told of the last turn and what they concluded, by property.
    pub fn facts(&mut self) -> Vec<Fact> {
        super::keep::facts(&mut self.junctions, "TURNS", TURNS, &OUTPUTS)
    }

    /// Whether the rules look at one turn or passage alone, so that they are asked at full speed.
    pub const fn is_direct(&self) -> bool {
        self.junctions.is_direct() && self.passages.is_direct()
    }
}

const EXTREMES: [(&str, Extreme); 2] = [("min", Extreme::Min), ("max", Extreme::Max)];
const SENSES: [(&str, Turn); 2] = [("left", Turn::Left), ("right", Turn::Right)];
const AXES: [(&str, Axis); 2] = [("x", Axis::X), ("y", Axis::Y)];
const OFFSETS: [(&str, Offset); 4] = [
    ("+c", Offset { is_negative: false, part: Part::Cos }),
    ("-c", Offset { is_negative: true, part: Part::Cos }),
    ("+s", Offset { is_negative: false, part: Part::Sin }),
    ("-s", Offset { is_negative: true, part: Part::Sin }),
];

/// The number of an output; asked when compiled.
const fn output(name: &str) -> usize {
    let mut at = 0;
    while !super::rules::same(OUTPUTS[at].as_bytes(), name.as_bytes()) {
        at += 1;
    }
    at
}

fn object<'a>(facts: &StepFacts, wishes: Wishes<'a>) -> [Datum<'a>; TURNS.len()] {
    let mut object = [Datum::Unknown; TURNS.len()];
    let centre = facts.rect.centre();
    object[const { place(TURNS, "junction") }] = Datum::Number(facts.junction as f64);
    object[const { place(TURNS, "entering") }] =
        Datum::Text(if facts.entering == Axis::X { "x" } else { "y" });
    object[const { place(TURNS, "junction_x") }] = Datum::Number(centre.x);
    object[const { place(TURNS, "junction_y") }] = Datum::Number(centre.y);
    object[const { place(TURNS, "robot_x") }] = Datum::Number(facts.present.x);
    object[const { place(TURNS, "robot_y") }] = Datum::Number(facts.present.y);
    object[const { place(TURNS, "next_x") }] = Datum::Number(facts.next.x);
    object[const { place(TURNS, "next_y") }] = Datum::Number(facts.next.y);
    object[const { place(TURNS, "corridor") }] = Datum::Number(facts.width);
    object[const { place(TURNS, "bound") }] = Datum::Number(facts.safest);
    object[const { place(TURNS, "width") }] = Datum::Number(facts.robot.width);
    object[const { place(TURNS, "length") }] = Datum::Number(facts.robot.length);
    object[const { place(TURNS, "asked") }] = Datum::Text(wishes.gap.word());
    object[const { place(TURNS, "asked_gap") }] = wishes.gap.along(0).into();
    object[const { place(TURNS, "fragile") }] = Datum::Truth(wishes.fragile);
    object[const { place(TURNS, "hurry") }] = Datum::Truth(wishes.hurry);
    object
}
