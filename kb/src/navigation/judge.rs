//! The navigator's judge: rules say what the robot does next, what becomes of a segment, what a way weighs, and which
//! opening it explores next.

use std::sync::{Arc, Mutex, PoisonError};

use adit_engine::{ClassError, Considered, Consultation, Datum, RuleBase, Type, Value};
use adit_planners::floor_plan::Way;
use adit_planners::local_model::{SegmentFacts, Source, Transition};
use adit_planners::navigation::learn::{Guide, OpeningFacts};
use adit_planners::navigation::{Action, Judge, Mode, State, StateDecision, StateFacts, WayFacts};

use super::told::{self, Told};
use crate::error::{Code, Error, Result};
use crate::plan::consult::Of::{Number, Perhaps, Text, Truth};
use crate::plan::consult::{Class, Memory, Property, consult, meant, object, word_for};
use crate::plan::course::Asked;
use crate::plan::{Said, Spoke, said};

/// What rules are told of a situation.
const SITUATIONS: [Property<StateFacts>; 53] = [
    ("mode", Text(|of| word_for(&MODES, &of.mode))),
    ("state", Text(|of| word_for(&STATES, &of.state))),
    ("has_goal", Truth(|of| of.has_goal)),
    ("distance", Number(|of| of.distance_m)),
    ("is_falling", Truth(|of| of.is_falling)),
    ("heading_error", Number(|of| of.heading_error)),
    ("off_line", Number(|of| of.off_line_m)),
    ("free", Number(|of| of.free_m)),
    ("echo", Number(|of| of.echo_m)),
    ("is_obstacle_moving", Truth(|of| of.is_obstacle_moving)),
    ("is_contact", Truth(|of| of.is_contact)),
    ("back_offs", Number(|of| of.back_offs.into())),
    ("is_busy", Truth(|of| of.is_busy)),
    ("is_changing", Truth(|of| of.is_changing)),
    ("has_room", Truth(|of| of.has_room)),
    ("is_scan_complete", Truth(|of| of.is_scan_complete)),
    ("scans", Number(|of| of.scans.into())),
    ("left", Perhaps(|of| of.left_m)),
    ("right", Perhaps(|of| of.right_m)),
    ("detours_here", Number(|of| of.detours_here.into())),
    ("closed_here", Number(|of| of.closed_here.into())),
    ("waits", Number(|of| of.waits.into())),
    ("has_way", Truth(|of| of.has_way)),
    ("is_shut", Truth(|of| of.is_shut)),
    ("retries", Number(|of| of.retries.into())),
    ("sigma", Number(|of| of.sigma_m)),
    ("sigma_heading", Number(|of| of.sigma_heading)),
    ("has_walls", Truth(|of| of.has_walls)),
    ("unexplained", Number(|of| of.unexplained)),
    ("contradicted", Number(|of| of.contradicted.into())),
    ("is_matched", Truth(|of| of.is_matched)),
    ("is_searched", Truth(|of| of.is_searched)),
    ("searches", Number(|of| of.searches.into())),
    ("is_aside", Truth(|of| of.is_aside)),
    ("seeks", Number(|of| of.seeks.into())),
    ("is_last", Truth(|of| of.is_last)),
    ("time", Number(|of| of.time_s)),
    ("goal_tolerance", Number(|of| of.settings.goal_tolerance_m)),
    ("turning_resolution", Number(|of| of.settings.turning_resolution)),
    ("highway_half_width", Number(|of| of.settings.highway_half_width_m)),
    ("look_ahead", Number(|of| of.settings.look_ahead_m)),
    ("most_waits", Number(|of| of.settings.most_waits.into())),
    ("most_detours", Number(|of| of.settings.most_detours.into())),
    ("most_reports", Number(|of| of.settings.most_reports.into())),
    ("most_retries", Number(|of| of.settings.most_retries.into())),
    ("most_back_offs", Number(|of| of.settings.most_back_offs.into())),
    ("no_way_after", Number(|of| of.settings.no_way_after_s)),
    ("sure", Number(|of| of.settings.sure_m)),
    ("sure_heading", Number(|of| of.settings.sure_heading)),
    ("most_unexplained", Number(|of| of.settings.most_unexplained)),
    ("most_contradicted", Number(|of| of.settings.most_contradicted.into())),
    ("most_searches", Number(|of| of.settings.most_searches.into())),
    ("most_seeks", Number(|of| of.settings.most_seeks.into())),
];

/// What rules are told of a segment of the local model.
const SEGMENTS: [Property<SegmentFacts>; 15] = [
    ("source", Text(|of| word_for(&SOURCES, &of.source))),
    ("confidence", Number(|of| of.confidence.into())),
    ("is_matched", Truth(|of| of.is_matched)),
    ("is_visible", Truth(|of| of.is_visible)),
    ("is_seen_free", Truth(|of| of.is_seen_free)),
    ("is_moving", Truth(|of| of.is_moving)),
    ("beams_on", Number(|of| of.beams_on.into())),
    ("beams_through", Number(|of| of.beams_through.into())),
    ("free", Number(|of| of.free_m)),
    ("age", Number(|of| of.age.into())),
    ("unseen", Number(|of| of.unseen.into())),
    ("distance", Number(|of| of.distance_m)),
    ("length", Number(|of| of.length_m)),
    ("sigma", Number(|of| of.sigma_m)),
    ("is_learning", Truth(|of| of.is_learning)),
];

/// What rules are told of an opening, through which a robot that learns a building may go on.
const OPENINGS: [Property<OpeningFacts>; 8] = [
    ("width", Number(|of| of.width_m)),
    ("distance", Number(|of| of.distance_m)),
    ("off_asked", Perhaps(|of| of.off_asked)),
    ("is_in_sight", Truth(|of| of.is_in_sight)),
    ("times_tried", Number(|of| of.times_tried.into())),
    ("time", Number(|of| of.time_s)),
    ("driven", Number(|of| of.driven_m)),
    ("radius", Number(|of| of.radius_m)),
];

/// What is asked of ways.
const OF_WAYS: &[&str] = &["weight", "passable", "action"];

/// The classes of objects that rules are asked about.
pub(crate) fn classes() -> [Class; 4] {
    const OF_SEGMENTS: &[&str] =
        &["becomes", "source", "is_kept", "counts_for_pose", "is_anchored", "is_cut"];
    [
        Class::new("SITUATIONS", SITUATIONS, &["next", "action"]),
        Class::new("SEGMENTS", SEGMENTS, OF_SEGMENTS),
        Class { name: "WAYS", told: told::ways(), asked: OF_WAYS },
        Class::new("OPENINGS", OPENINGS, &["explore", "worth"]),
    ]
}

#[derive(Debug)]
pub struct RuleJudge {
    situations: Consultation,
    segments: Consultation,
    ways: Consultation,
    openings: Consultation,
    /// What was said of segments, while that helps.
    known: Option<Memory<SegmentFacts, (Transition, Option<Source>)>>,
    /// The properties of ways, in the order in which they are told.
    of_ways: Vec<String>,
    told: Told,
    trouble: Option<String>,
    /// Whether a way of which rules say nothing is just not taken.
    leaves_unsaid: bool,
}

impl RuleJudge {
    /// Makes rules ready that know nothing but what they are told.
    pub fn new(rules: &Arc<RuleBase>) -> std::result::Result<Self, ClassError> {
        let told = Told::default();
        Self::made(&told, |class, told, asked| Consultation::new(Arc::clone(rules), class, told, asked))
    }

    /// Makes rules ready that know nothing but what they are told, for missions.
    pub fn of_rules(rules: &Arc<RuleBase>) -> Result<Self> {
        Self::new(rules).map_err(Error::of(Code::PlanRules))
    }

    /// Makes ready for routes over a site, whose rules may look at all that is known of it.
    pub fn of_routes(asked: &Asked<'_>, told: &Told) -> Result<Self> {
        Ok(Self { leaves_unsaid: true, ..Self::of_mission(asked, told)? })
    }

    /// Makes ready for a mission on a site, which ends where rules do not say what they are asked.
    pub fn of_mission(asked: &Asked<'_>, told: &Told) -> Result<Self> {
        Self::made(told, |class, told, outputs| asked.about(class, told, outputs))
    }

    fn made<E>(
        told: &Told,
        ready: impl Fn(&str, &[(&str, Type)], &[&str]) -> std::result::Result<Consultation, E>,
    ) -> std::result::Result<Self, E> {
        let [situations, segments, ways, openings] = classes();
        let of_ways: Vec<(&str, Type)> = ways.told.iter().copied().chain(told.further()).collect();
        let made = |class: &Class| ready(class.name, &class.told, class.asked);
        let segments = made(&segments)?;
        Ok(Self {
            known: Memory::of(&segments, SEGMENTS),
            situations: made(&situations)?,
            segments,
            ways: ready(ways.name, &of_ways, ways.asked)?,
            openings: made(&openings)?,
            of_ways: of_ways.iter().map(|(name, _)| (*name).to_owned()).collect(),
            told: told.clone(),
            trouble: None,
            leaves_unsaid: false,
        })
    }

    /// Whether the rules look at one object alone, so that they are asked at full speed.
    pub const fn is_direct(&self) -> bool {
        self.situations.is_direct() && self.segments.is_direct() && self.ways.is_direct()
    }

    /// What the robot does on the way that was asked about last, if rules say so.
    pub fn action(&self) -> Option<Arc<str>> {
        self.ways.text(2)
    }

    /// What rules were told of a way and what they said; `place` is what people call it.
    pub fn said_of(&mut self, way: &Way, place: String) -> Said {
        self.weigh(&WayFacts { way, is_cut: false, times_blocked: 0 });
        let considered = self.ways.considered("weight").into_iter().map(Spoke::from).collect();
        let facts = said::facts(&mut self.ways, "WAYS", &told::ways(), OF_WAYS);
        Said { junction: 0, place, considered, facts, action: self.action() }
    }

    /// Why nobody comes along a way: that it is told to be closed, or the rule that lets nobody; `None` where it is neither.
    pub fn refused_by(&mut self, way: &Way) -> Option<String> {
        self.weigh(&WayFacts { way, is_cut: false, times_blocked: 0 });
        if self.ways.truth(1) == Some(true) {
            return None;
        }
        let facts = said::facts(&mut self.ways, "WAYS", &told::ways(), &["passable"]);
        let is_closed = |fact: &said::Fact| fact.property == "closed" && fact.value == Value::Truth(true);
        if facts.iter().any(is_closed) {
            return Some("is closed".to_owned());
        }
        let rule = facts.iter().find_map(|fact| fact.rule.as_ref().filter(|_| fact.property == "passable"));
        rule.map(|(rule, _)| format!("lets nobody through by the rule \"{rule}\""))
    }

    /// The first thing that failed, or that the rules did not say, or said in words that mean nothing. From then on they
    /// are not asked any more: there is no way, and what comes of it counts for nothing.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Asks about a situation of which a value is known for each property that has one.
    ///
    /// # Returns
    /// The next state and the action as words, and which rules were looked at.
    pub fn consider<'f>(&mut self, told: impl Fn(&str) -> Datum<'f>) -> ([String; 2], Vec<Considered>) {
        let object = SITUATIONS.map(|(name, _)| told(name));
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
const ACTIONS: [(&str, Action); 12] = [
    ("none", Action::None),
    ("back off", Action::BackOff),
    ("left", Action::Left),
    ("right", Action::Right),
    ("close", Action::Close),
    ("retry", Action::Retry),
    ("match", Action::Match),
    ("search", Action::Search),
    ("seek", Action::Seek),
    ("resume", Action::Resume),
    ("no way", Action::NoWay),
    ("lost", Action::Lost),
];
const MODES: [(&str, Mode); 4] = [
    ("automatic", Mode::Automatic),
    ("manual", Mode::Manual),
    ("learn", Mode::Learn),
    ("route", Mode::Route),
];
const SOURCES: [(&str, Source); 3] =
    [("sonar", Source::SONAR), ("contact", Source::CONTACT), ("recalled", Source::RECALLED)];

/// The word for a state, as rules and the journal have it.
pub fn state_word(state: State) -> &'static str {
    word_for(&STATES, &state).unwrap_or("hold")
}

pub fn action_word(action: Action) -> &'static str {
    word_for(&ACTIONS, &action).unwrap_or("none")
}

impl Judge for RuleJudge {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        if self.trouble.is_none() {
            consult(&mut self.situations, &object(SITUATIONS, facts), &mut self.trouble);
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
        if self.known.as_mut().is_some_and(Memory::is_idle) {
            self.known = None;
        }
        if let Some((transition, source)) = self.known.as_mut().and_then(|known| known.recall(facts)) {
            return Transition { source: source.unwrap_or(facts.source), ..transition };
        }
        consult(&mut self.segments, &object(SEGMENTS, facts), &mut self.trouble);
        let of = |output| self.segments.truth(output);
        let (Some(becomes), Some(is_kept)) = (self.segments.number(0), of(2)) else {
            self.missing("what becomes of a segment", None);
            return unchanged;
        };
        let source = meant(&self.segments, 1, &SOURCES).ok();
        let transition = Transition {
            confidence: becomes.clamp(0.0, 255.0) as u8,
            source: source.unwrap_or(facts.source),
            is_kept,
            counts_for_pose: of(3).unwrap_or(false),
            is_anchored: of(4).unwrap_or(false),
            is_cut: of(5).unwrap_or(false),
        };
        if let Some(known) = &mut self.known {
            known.keep((transition, source));
        }
        transition
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        if self.trouble.is_some() {
            return None;
        }
        let mut way = object(told::measured(), facts).to_vec();
        way.resize(self.of_ways.len(), Datum::Unknown);
        self.told.of(facts.way, &mut way, |name| self.of_ways.iter().position(|known| known == name));
        consult(&mut self.ways, &way, &mut self.trouble);
        match (self.ways.truth(1), self.ways.number(0)) {
            (Some(false), _) => None,
            (Some(true), Some(weight)) if weight.is_finite() && weight >= 0.0 => Some(weight),
            _ if self.leaves_unsaid => None,
            _ => {
                self.missing("what a way weighs, or whether it is passable", None);
                None
            }
        }
    }
}

impl Guide for RuleJudge {
    fn opening(&mut self, facts: &OpeningFacts) -> Option<f64> {
        if self.trouble.is_some() {
            return None;
        }
        consult(&mut self.openings, &object(OPENINGS, facts), &mut self.trouble);
        match (self.openings.truth(0), self.openings.number(1)) {
            (Some(false), _) => None,
            (Some(true), Some(worth)) if !worth.is_nan() => Some(worth),
            _ => {
                self.missing("whether an opening is explored, or what it is worth", None);
                None
            }
        }
    }
}

/// Judges for missions that are run side by side, one for each thread.
#[derive(Debug)]
pub struct Judges(Mutex<Vec<RuleJudge>>);

impl Judges {
    pub fn new(asked: &Asked<'_>, told: &Told) -> Result<Self> {
        let judge = |_| RuleJudge::of_mission(asked, told);
        let judges = (0..rayon::current_num_threads().max(1)).map(judge).collect::<Result<_>>();
        Ok(Self(Mutex::new(judges?)))
    }

    /// Lets a judge work, and ends with an error where rules failed, or did not say what they were asked.
    pub fn ask<T>(&self, work: impl FnOnce(&mut RuleJudge) -> Result<T>) -> Result<T> {
        let taken = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let Some(mut judge) = taken else {
            return Err(Error::said(Code::SimulateRules, "more missions at a time than threads", None));
        };
        let done = work(&mut judge);
        let trouble = judge.trouble().map(str::to_owned);
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(judge);
        match trouble {
            Some(trouble) => Err(Error::said(Code::SimulateRules, trouble, None)),
            None => done,
        }
    }
}

/// A judge of whom it is known which rules spoke.
pub trait Considers: Judge {
    /// Which rules spoke of the last situation, and why the others did not.
    fn considered(&mut self) -> Vec<Considered>;
}

impl Considers for RuleJudge {
    fn considered(&mut self) -> Vec<Considered> {
        self.situations.considered("next")
    }
}

/// A judge that notes which rule decided, where the state changed or something was done.
#[derive(Debug)]
pub struct Noting<'j, J> {
    judge: &'j mut J,
    /// For each decision that was told the rule that spoke.
    pub decided: Vec<Option<Considered>>,
}

impl<'j, J: Considers> Noting<'j, J> {
    pub const fn new(judge: &'j mut J) -> Self {
        Self { judge, decided: Vec::new() }
    }
}

impl<J: Considers> Judge for Noting<'_, J> {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        let decision = self.judge.next_state(facts);
        // the decisions that the navigator tells of
        if facts.state != decision.state || decision.action != Action::None {
            let rows = self.judge.considered();
            self.decided.push(rows.into_iter().find(|row| row.miss.is_none()));
        }
        decision
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        self.judge.segment(facts)
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        self.judge.weigh(facts)
    }
}

/// What the rules are told of a situation: each property with its value.
pub fn told_of(facts: &StateFacts) -> impl Iterator<Item = (&'static str, Datum<'_>)> {
    SITUATIONS.map(|(name, _)| name).into_iter().zip(object(SITUATIONS, facts))
}
