//! Asks the rules how a robot turns at the junction that it is about to enter, and what a passage weighs.

use std::sync::Arc;

use adit_engine::{ClassError, Consultation, RuleBase};
use adit_planners::channels::corridor::{
    Axis, Extreme, Offset, Part, Passage, Robot, Steer, StepFacts, Turn,
};

use super::consult::Of::{Number, Perhaps, Text, Truth};
use super::consult::{Class, Property, consult, is_same, meant, object, typed, word_for};
use super::gap::Wishes;
use super::refusal::{NoPath, Spoke, silent};
use super::said::{Fact, Said};

const OUTPUTS: [&str; 12] = [
    "rule",
    "gap",
    "corner_x",
    "corner_y",
    "turns",
    "arrive_x",
    "arrive_y",
    "offset",
    "refusal",
    "remark",
    "action",
    "falls_back",
];
const OF_PASSAGES: [&str; 4] = ["weight", "passable", "refusal", "action"];

/// What rules are told of turns and passages, and what they are asked.
pub(super) fn classes() -> [Class; 2] {
    [Class::new("TURNS", told_of_turns(), &OUTPUTS), Class::new("PASSAGES", told_of_passages(), &OF_PASSAGES)]
}

/// The rules, ready to be asked turn after turn.
#[derive(Debug)]
pub struct Turns {
    junctions: Consultation,
    passages: Consultation,
    /// Why passages were refused, since the last path was looked for.
    refusals: Vec<Arc<str>>,
    /// The first rule that failed.
    trouble: Option<String>,
}

impl Turns {
    pub fn new(rules: &Arc<RuleBase>) -> Result<Self, ClassError> {
        let [junctions, passages] = classes();
        Ok(Self::of(junctions.consultation(rules)?, passages.consultation(rules)?))
    }

    /// Of rules that are ready to be asked about turns and passages.
    pub const fn of(junctions: Consultation, passages: Consultation) -> Self {
        Self { junctions, passages, refusals: Vec::new(), trouble: None }
    }

    /// Why passages were refused since this was last asked.
    pub fn take_refusals(&mut self) -> Vec<Arc<str>> {
        std::mem::take(&mut self.refusals)
    }

    /// What a passage weighs; `None` where it must not be used.
    pub fn weigh(&mut self, passage: Entered<'_>) -> Option<f64> {
        consult(&mut self.passages, &object(told_of_passages(), &passage), &mut self.trouble);
        let number = passage.passage.channel;
        let unsaid = |what: &str| Arc::from(format!("rules do not say {what} channel {number}, or disagree"));
        let refusal = match (self.passages.truth(1), self.passages.number(0)) {
            (Some(true), Some(weight)) if weight.is_finite() && weight >= 0.0 => return Some(weight),
            (Some(true), Some(weight)) => Some(Arc::from(format!(
                "rules give channel {number} the weight {weight}; it must be finite and not negative"
            ))),
            (Some(true), None) => Some(unsaid("the weight of")),
            (Some(false), _) => self.passages.text(2),
            (None, _) => Some(unsaid("whether one may drive through")),
        };
        self.refusals.extend(refusal.filter(|refusal| !self.refusals.contains(refusal)));
        None
    }

    /// The first rule that failed when it was asked.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// What rules were told of a passage that is driven, and what they said.
    pub fn driven_in(&mut self, passage: Entered<'_>) -> Said {
        self.passages.consult(&object(told_of_passages(), &passage));
        let considered = self.passages.considered("weight").into_iter().map(Spoke::from).collect();
        let facts =
            super::said::facts(&mut self.passages, "PASSAGES", &typed(told_of_passages()), &OF_PASSAGES);
        let place = format!("channel {}", passage.passage.channel);
        Said { junction: 0, place, considered, facts, action: self.passages.text(3) }
    }

    /// What the robot does in the last turn, if rules say so.
    pub fn action(&self) -> Option<Arc<str>> {
        self.junctions.text(const { output("action") })
    }

    /// Whether rules say of the last turn that the safest gap is driven where the one that is asked for cannot be kept.
    pub fn falls_back(&self) -> bool {
        self.junctions.truth(const { output("falls_back") }) == Some(true)
    }

    /// How the rules turn the robot, and what they remark on.
    pub fn decide(
        &mut self,
        facts: &StepFacts,
        wishes: Wishes<'_, 1>,
    ) -> Result<(Steer, Option<Arc<str>>), NoPath> {
        consult(&mut self.junctions, &object(told_of_turns(), &(facts, wishes)), &mut self.trouble);
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
const fn told_of_turns<'t>() -> [Property<(&'t StepFacts, Wishes<'t, 1>)>; 17] {
    [
        ("robot", Text(|(_, wishes)| Some(wishes.mover))),
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

/// A passage that a robot is about to enter: a stretch of one corridor, between two junctions, the start or the goal.
#[derive(Clone, Copy, Debug)]
pub struct Entered<'p> {
    pub passage: &'p Passage,
    pub robot: Robot,
    pub wishes: Wishes<'p, 1>,
    /// Whether its corridor is closed.
    pub is_closed: bool,
}

/// What rules are told of a passage.
const fn told_of_passages<'p>() -> [Property<Entered<'p>>; 10] {
    [
        ("channel", Number(|of| of.passage.channel as f64)),
        ("robot", Text(|of| Some(of.wishes.mover))),
        ("length", Number(|of| of.passage.length)),
        ("corridor", Number(|of| of.passage.width)),
        ("room", Number(|of| (of.passage.width - of.robot.width) / 2.0)),
        ("width", Number(|of| of.robot.width)),
        ("asked_gap", Perhaps(|of| of.wishes.gap.along(0))),
        ("fragile", Truth(|of| of.wishes.fragile)),
        ("hurry", Truth(|of| of.wishes.hurry)),
        ("closed", Truth(|of| of.is_closed)),
    ]
}
