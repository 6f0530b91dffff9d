//! The navigator's judge: rules say what the robot does next, what becomes of a segment, and what a way weighs.

use std::sync::Arc;

use adit_engine::{ClassError, Considered, Consultation, Datum, RuleBase, Type};
use adit_planners::local_model::{SegmentFacts, Source, Transition};
use adit_planners::navigation::{Action, Judge, Mode, State, StateDecision, StateFacts, WayFacts};

use super::told::Told;
use crate::plan::rules::{consult, place};

/// What rules are told of a situation.
pub const SITUATIONS: &[(&str, Type)] = &[
    ("mode", Type::Text),
    ("state", Type::Text),
    ("has_goal", Type::Truth),
    ("distance", Type::Number),
    ("is_falling", Type::Truth),
    ("heading_error", Type::Number),
    ("off_line", Type::Number),
    ("free", Type::Number),
    ("echo", Type::Number),
    ("is_obstacle_moving", Type::Truth),
    ("is_contact", Type::Truth),
    ("back_offs", Type::Number),
    ("is_busy", Type::Truth),
    ("is_scan_complete", Type::Truth),
    ("scans", Type::Number),
    ("left", Type::Number),
    ("right", Type::Number),
    ("detours_here", Type::Number),
    ("waits", Type::Number),
    ("has_way", Type::Truth),
    ("retries", Type::Number),
    ("time", Type::Number),
    ("goal_tolerance", Type::Number),
    ("turning_resolution", Type::Number),
    ("highway_half_width", Type::Number),
    ("look_ahead", Type::Number),
    ("most_waits", Type::Number),
    ("most_detours", Type::Number),
    ("most_retries", Type::Number),
    ("most_back_offs", Type::Number),
    ("no_way_after", Type::Number),
];

/// What rules are told of a segment of the local model.
pub const SEGMENTS: &[(&str, Type)] = &[
    ("source", Type::Text),
    ("confidence", Type::Number),
    ("is_matched", Type::Truth),
    ("is_visible", Type::Truth),
    ("is_seen_free", Type::Truth),
    ("is_moving", Type::Truth),
    ("beams_on", Type::Number),
    ("beams_through", Type::Number),
    ("free", Type::Number),
    ("age", Type::Number),
    ("unseen", Type::Number),
    ("distance", Type::Number),
    ("length", Type::Number),
    ("sigma", Type::Number),
    ("is_learning", Type::Truth),
];

/// What rules are told of a way between adits.
pub const WAYS: &[(&str, Type)] = &[
    ("length", Type::Number),
    ("clearance", Type::Number),
    ("doorway", Type::Number),
    ("region", Type::Number),
    ("is_cut", Type::Truth),
    ("times_blocked", Type::Number),
    ("squeaks", Type::Truth),
];

/// So many of them follow from the floor plan and from what was seen; the others a world tells.
pub const MEASURED: usize = 6;

/// What is asked of them.
pub(crate) const OF_SITUATIONS: [&str; 2] = ["next", "action"];
/// What is asked of them.
pub(crate) const OF_SEGMENTS: [&str; 6] =
    ["becomes", "source", "is_kept", "counts_for_pose", "is_anchored", "is_cut"];
/// What is asked of them.
pub(crate) const OF_WAYS: [&str; 2] = ["weight", "passable"];

#[derive(Debug)]
pub struct RuleJudge {
    situations: Consultation,
    segments: Consultation,
    ways: Consultation,
    /// The properties of ways, in the order in which they are told.
    of_ways: Vec<String>,
    told: Told,
    trouble: Option<String>,
}

impl RuleJudge {
    /// Makes ready for a world that tells nothing of its doorways and regions.
    pub fn new(rules: &Arc<RuleBase>) -> Result<Self, ClassError> {
        Self::with(rules, &Told::default())
    }

    /// Makes ready for a world that tells this of its doorways and regions.
    pub fn with(rules: &Arc<RuleBase>, told: &Told) -> Result<Self, ClassError> {
        let rules = || Arc::clone(rules);
        let ways: Vec<(&str, Type)> = WAYS.iter().copied().chain(told.further()).collect();
        Ok(Self {
            situations: Consultation::new(rules(), "SITUATIONS", SITUATIONS, &OF_SITUATIONS)?,
            segments: Consultation::new(rules(), "SEGMENTS", SEGMENTS, &OF_SEGMENTS)?,
            ways: Consultation::new(rules(), "WAYS", &ways, &OF_WAYS)?,
            of_ways: ways.iter().map(|(name, _)| (*name).to_owned()).collect(),
            told: told.clone(),
            trouble: None,
        })
    }

    /// Whether the rules look at one object alone, so that they are asked at full speed.
    pub const fn is_direct(&self) -> bool {
        self.situations.is_direct() && self.segments.is_direct() && self.ways.is_direct()
    }

    /// The first thing that failed, or that the rules did not say, or said in words that mean nothing. From then on they
    /// are not asked any more: there is no way, and what comes of it counts for nothing.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Which rules spoke of the last situation, and why the others did not.
    pub fn considered(&mut self) -> Vec<Considered> {
        self.situations.considered("next")
    }

    /// Asks about a situation of which a value is known for each property that has one.
    ///
    /// # Returns
    /// The next state and the action as words, and which rules were looked at.
    pub fn consider<'f>(&mut self, told: impl Fn(&str) -> Datum<'f>) -> ([String; 2], Vec<Considered>) {
        let object = SITUATIONS.iter().map(|(name, _)| told(name)).collect::<Vec<_>>();
        consult(&mut self.situations, &object, &mut self.trouble);
        let said =
            [0, 1].map(|output| self.situations.text(output).map_or(String::new(), |text| text.to_string()));
        (said, self.considered())
    }

    fn missing(&mut self, what: &str, found: Option<String>) {
        let found = found.map_or_else(String::new, |found| format!(", but \"{found}\""));
        self.trouble.get_or_insert_with(|| format!("rules do not say {what}{found}"));
    }
}

const STATES: [(&str, State); 6] = [
    ("hold", State::Hold),
    ("decide", State::Decide),
    ("turn", State::Turn),
    ("move", State::Move),
    ("wait", State::Wait),
    ("blocked", State::Blocked),
];
const ACTIONS: [(&str, Action); 7] = [
    ("none", Action::None),
    ("back off", Action::BackOff),
    ("left", Action::Left),
    ("right", Action::Right),
    ("close", Action::Close),
    ("retry", Action::Retry),
    ("no way", Action::NoWay),
];
const SOURCES: [(&str, Source); 3] =
    [("sonar", Source::SONAR), ("contact", Source::CONTACT), ("recalled", Source::RECALLED)];

/// The word for a state, as rules and the journal have it.
pub fn state_word(state: State) -> &'static str {
    STATES.iter().find(|(_, known)| *known == state).map_or("hold", |(word, _)| word)
}

pub fn action_word(action: Action) -> &'static str {
    ACTIONS.iter().find(|(_, known)| *known == action).map_or("none", |(word, _)| word)
}

fn meant<T: Copy>(
    consultation: &Consultation,
    output: usize,
    words: &[(&str, T)],
) -> Result<T, Option<String>> {
    let found = words.iter().find(|(word, _)| consultation.is(output, word));
    found.map(|(_, meant)| *meant).ok_or_else(|| consultation.value(output).map(|value| value.to_string()))
}

impl Judge for RuleJudge {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        if self.trouble.is_none() {
            consult(&mut self.situations, &situation(facts), &mut self.trouble);
        }
        if self.trouble.is_some() {
            return StateDecision { state: State::Hold, action: Action::NoWay };
        }
        let state = meant(&self.situations, 0, &STATES);
        let action = meant(&self.situations, 1, &ACTIONS);
        match (state, action) {
            (Ok(state), Ok(action)) => StateDecision { state, action },
            (state, action) => {
                let what = format!("the next state and action in state {}", state_word(facts.state));
                self.missing(&what, state.err().or(action.err()).flatten());
                // Rules that say nothing end the mission where the robot stands.
                StateDecision { state: State::Hold, action: Action::NoWay }
            }
        }
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        let unchanged = Transition {
            confidence: facts.confidence,
            source: facts.source,
            is_kept: true,
            counts_for_pose: false,
            is_anchored: false,
            is_cut: false,
        };
        if self.trouble.is_some() {
            return unchanged;
        }
        consult(&mut self.segments, &segment(facts), &mut self.trouble);
        let of = |output| self.segments.truth(output);
        let (Some(becomes), Some(is_kept)) = (self.segments.number(0), of(2)) else {
            self.missing("what becomes of a segment", None);
            return unchanged;
        };
        Transition {
            confidence: becomes.clamp(0.0, 255.0) as u8,
            source: meant(&self.segments, 1, &SOURCES).unwrap_or(facts.source),
            is_kept,
            counts_for_pose: of(3).unwrap_or(false),
            is_anchored: of(4).unwrap_or(false),
            is_cut: of(5).unwrap_or(false),
        }
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        if self.trouble.is_some() {
            return None;
        }
        let mut object = vec![Datum::Unknown; self.of_ways.len()];
        object[const { place(WAYS, "length") }] = Datum::Number(facts.way.length);
        object[const { place(WAYS, "clearance") }] = Datum::Number(facts.way.clearance);
        object[const { place(WAYS, "doorway") }] = facts.way.doorway.map(|number| number as f64).into();
        object[const { place(WAYS, "region") }] = facts.way.region.map(|number| number as f64).into();
        object[const { place(WAYS, "is_cut") }] = Datum::Truth(facts.is_cut);
        object[const { place(WAYS, "times_blocked") }] = Datum::Number(f64::from(facts.times_blocked));
        self.told.of(facts.way, &mut object, |name| self.of_ways.iter().position(|known| known == name));
        consult(&mut self.ways, &object, &mut self.trouble);
        match (self.ways.truth(1), self.ways.number(0)) {
            (Some(false), _) => None,
            (Some(true), Some(weight)) if weight.is_finite() && weight >= 0.0 => Some(weight),
            _ => {
                self.missing("what a way weighs, or whether it is passable", None);
                None
            }
        }
    }
}

/// What the rules are told of a situation: each property with its value.
pub fn told_of(facts: &StateFacts) -> impl Iterator<Item = (&'static str, Datum<'static>)> {
    SITUATIONS.iter().map(|(name, _)| *name).zip(situation(facts))
}

fn situation(facts: &StateFacts) -> [Datum<'static>; SITUATIONS.len()] {
    let mut object = [Datum::Unknown; SITUATIONS.len()];
    let settings = &facts.settings;
    let mode = match facts.mode {
        Mode::Automatic => "automatic",
        Mode::Manual => "manual",
        Mode::Learn => "learn",
    };
    object[const { place(SITUATIONS, "mode") }] = Datum::Text(mode);
    object[const { place(SITUATIONS, "state") }] = Datum::Text(state_word(facts.state));
    for (at, truth) in [
        (const { place(SITUATIONS, "has_goal") }, facts.has_goal),
        (const { place(SITUATIONS, "is_falling") }, facts.is_falling),
        (const { place(SITUATIONS, "is_obstacle_moving") }, facts.is_obstacle_moving),
        (const { place(SITUATIONS, "is_contact") }, facts.is_contact),
        (const { place(SITUATIONS, "is_busy") }, facts.is_busy),
        (const { place(SITUATIONS, "is_scan_complete") }, facts.is_scan_complete),
        (const { place(SITUATIONS, "has_way") }, facts.has_way),
    ] {
        object[at] = Datum::Truth(truth);
    }
    for (at, number) in [
        (const { place(SITUATIONS, "distance") }, facts.distance_m),
        (const { place(SITUATIONS, "heading_error") }, facts.heading_error),
        (const { place(SITUATIONS, "off_line") }, facts.off_line_m),
        (const { place(SITUATIONS, "free") }, facts.free_m),
        (const { place(SITUATIONS, "echo") }, facts.echo_m),
        (const { place(SITUATIONS, "detours_here") }, f64::from(facts.detours_here)),
        (const { place(SITUATIONS, "waits") }, f64::from(facts.waits)),
        (const { place(SITUATIONS, "retries") }, f64::from(facts.retries)),
        (const { place(SITUATIONS, "back_offs") }, f64::from(facts.back_offs)),
        (const { place(SITUATIONS, "scans") }, f64::from(facts.scans)),
        (const { place(SITUATIONS, "time") }, facts.time_s),
        (const { place(SITUATIONS, "most_back_offs") }, f64::from(settings.most_back_offs)),
        (const { place(SITUATIONS, "no_way_after") }, settings.no_way_after_s),
        (const { place(SITUATIONS, "goal_tolerance") }, settings.goal_tolerance_m),
        (const { place(SITUATIONS, "turning_resolution") }, settings.turning_resolution),
        (const { place(SITUATIONS, "highway_half_width") }, settings.highway_half_width_m),
        (const { place(SITUATIONS, "look_ahead") }, settings.look_ahead_m),
        (const { place(SITUATIONS, "most_waits") }, f64::from(settings.most_waits)),
        (const { place(SITUATIONS, "most_detours") }, f64::from(settings.most_detours)),
        (const { place(SITUATIONS, "most_retries") }, f64::from(settings.most_retries)),
    ] {
        object[at] = Datum::Number(number);
    }
    object[const { place(SITUATIONS, "left") }] = facts.left_m.into();
    object[const { place(SITUATIONS, "right") }] = facts.right_m.into();
    object
}

fn segment(facts: &SegmentFacts) -> [Datum<'static>; SEGMENTS.len()] {
    let mut object = [Datum::Unknown; SEGMENTS.len()];
    let source = SOURCES.iter().find(|(_, source)| *source == facts.source);
    object[const { place(SEGMENTS, "source") }] = source.map(|(word, _)| *word).into();
    for (at, truth) in [
        (const { place(SEGMENTS, "is_matched") }, facts.is_matched),
        (const { place(SEGMENTS, "is_visible") }, facts.is_visible),
        (const { place(SEGMENTS, "is_seen_free") }, facts.is_seen_free),
        (const { place(SEGMENTS, "is_moving") }, facts.is_moving),
        (const { place(SEGMENTS, "is_learning") }, facts.is_learning),
    ] {
        object[at] = Datum::Truth(truth);
    }
    for (at, number) in [
        (const { place(SEGMENTS, "confidence") }, f64::from(facts.confidence)),
        (const { place(SEGMENTS, "beams_on") }, f64::from(facts.beams_on)),
        (const { place(SEGMENTS, "beams_through") }, f64::from(facts.beams_through)),
        (const { place(SEGMENTS, "free") }, facts.free_m),
        (const { place(SEGMENTS, "age") }, f64::from(facts.age)),
        (const { place(SEGMENTS, "unseen") }, f64::from(facts.unseen)),
        (const { place(SEGMENTS, "distance") }, facts.distance_m),
        (const { place(SEGMENTS, "length") }, facts.length_m),
        (const { place(SEGMENTS, "sigma") }, facts.sigma_m),
    ] {
        object[at] = Datum::Number(number);
    }
    object
}
