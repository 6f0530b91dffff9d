//! Asks the rules how a robot turns at the junction that it is about to enter, and what a passage weighs.

use std::sync::Arc;

use adit_engine::{ClassError, Consultation, RuleBase};
use adit_planners::channels::corridor::{
    Axis, Extreme, Offset, Part, Passage, Robot, Steer, StepFacts, Turn,
};

use super::consult::Of::{Number, Perhaps, Text, Truth};
use super::consult::{Class, Property, is_same, meant, object, typed, word_for};
use super::gap::Wishes;
use super::refusal::{NoPath, Spoke, silent};
use super::said::Fact;

const OUTPUTS: [&str; 10] =
    ["rule", "gap", "corner_x", "corner_y", "turns", "arrive_x", "arrive_y", "offset", "refusal", "remark"];

/// What rules are told of turns and passages, and what they are asked.
pub(super) fn classes() -> [Class; 2] {
    [
        Class::new("TURNS", told_of_turns(), &OUTPUTS),
        Class::new("PASSAGES", told_of_passages(), &["weight", "passable", "refusal"]),
    ]
}

/// The rules, ready to be asked turn after turn.
#[derive(Debug)]
pub struct Turns {
    junctions: Consultation,
    passages: Consultation,
    /// Why passages were refused, since the last path was looked for.
    refusals: Vec<Arc<str>>,
}

impl Turns {
    pub fn new(rules: &Arc<RuleBase>) -> Result<Self, ClassError> {
        let [junctions, passages] = classes();
        Ok(Self {
            junctions: junctions.consultation(rules)?,
            passages: passages.consultation(rules)?,
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
        wishes: Wishes<'_, 1>,
    ) -> Result<Option<f64>, NoPath> {
        self.passages.consult(&object(told_of_passages(), &(passage, robot, wishes)));
        let said =
            |what: &str| NoPath::because(format!("no rule says {what} of {passage}, or several disagree"));
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
        wishes: Wishes<'_, 1>,
    ) -> Result<(Steer, Option<Arc<str>>), NoPath> {
        self.junctions.consult(&object(told_of_turns(), &(facts, wishes)));
        if let Some(reason) = self.junctions.text(const { output("refusal") }) {
            return Err(NoPath::at(facts.junction, reason.to_string()));
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

    fn word<T: Copy>(&mut self, facts: &StepFacts, at: usize, words: &[(&str, T)]) -> Result<T, NoPath> {
        let (name, junction) = (OUTPUTS[at], facts.junction);
        meant(&self.junctions, at, words).map_err(|found| {
            let Some(found) = found else { return silent(&mut self.junctions, "TURNS", junction, name) };
            let words: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
            let wanted = words.join(", ");
            let reason =
                format!("rules give {name} of junction {junction} as \"{found}\"; expected {wanted}");
            NoPath::at(junction, reason)
        })
    }

    /// Which rules spoke of the last turn's corner, and why the others did not.
    pub fn considered(&mut self) -> Vec<Spoke> {
        self.junctions.considered("corner_x").into_iter().map(Spoke::from).collect()
    }

    /// What the rules were told of the last turn and what they concluded, by property.
    pub fn facts(&mut self) -> Vec<Fact> {
        super::said::facts(&mut self.junctions, "TURNS", &typed(told_of_turns()), &OUTPUTS)
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
    while !is_same(OUTPUTS[at], name) {
        at += 1;
    }
    at
}

/// What rules are told of a turn of a robot: it is about to enter a junction.
const fn told_of_turns<'t>() -> [Property<(&'t StepFacts, Wishes<'t, 1>)>; 16] {
    [
        ("junction", Number(|(facts, _)| facts.junction as f64)),
        ("entering", Text(|(facts, _)| word_for(&AXES, &facts.entering))),
        ("junction_x", Number(|(facts, _)| facts.rect.centre().x)),
        ("junction_y", Number(|(facts, _)| facts.rect.centre().y)),
        ("robot_x", Number(|(facts, _)| facts.present.x)),
        ("robot_y", Number(|(facts, _)| facts.present.y)),
        ("next_x", Number(|(facts, _)| facts.next.x)),
        ("next_y", Number(|(facts, _)| facts.next.y)),
        ("corridor", Number(|(facts, _)| facts.width)),
        ("bound", Number(|(facts, _)| facts.safest)),
        ("width", Number(|(facts, _)| facts.robot.width)),
        ("length", Number(|(facts, _)| facts.robot.length)),
        ("asked", Text(|(_, wishes)| Some(wishes.gap.word()))),
        ("asked_gap", Perhaps(|(_, wishes)| wishes.gap.along(0))),
        ("fragile", Truth(|(_, wishes)| wishes.fragile)),
        ("hurry", Truth(|(_, wishes)| wishes.hurry)),
    ]
}

/// What rules are told of a passage: a stretch of one corridor, between two junctions, the start or the goal.
const fn told_of_passages<'p>() -> [Property<(&'p Passage, Robot, Wishes<'p, 1>)>; 8] {
    [
        ("channel", Number(|(passage, ..)| passage.channel as f64)),
        ("length", Number(|(passage, ..)| passage.length)),
        ("corridor", Number(|(passage, ..)| passage.width)),
        ("room", Number(|(passage, robot, _)| (passage.width - robot.width) / 2.0)),
        ("width", Number(|(_, robot, _)| robot.width)),
        ("asked_gap", Perhaps(|(.., wishes)| wishes.gap.along(0))),
        ("fragile", Truth(|(.., wishes)| wishes.fragile)),
        ("hurry", Truth(|(.., wishes)| wishes.hurry)),
    ]
}
