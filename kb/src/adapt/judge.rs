//! The planner's judge: rules say what becomes of experience after a change, which object a subgoal is attached to, and
//! whether an edge is still trusted.

use std::sync::Arc;

use adit_engine::{ClassError, Considered, Consultation, RuleBase};
use adit_planners::adapt::{ChangeFacts, EdgeFacts, Judge, LandmarkFacts, Strategy, Trust};

use super::explain::Explained;
use crate::plan::consult::Of::{self, Number, Perhaps, Text, Truth};
use crate::plan::consult::{Class, Property, consult, meant, object, object_of, word_for};
use crate::plan::course::Asked;

/// What rules are told of a change of a cell.
const CELL_CHANGES: [Property<ChangeFacts>; 15] = [
    ("objects", Number(|of| of.objects.into())),
    ("appeared", Number(|of| of.appeared.into())),
    ("gone", Number(|of| of.gone.into())),
    ("moved", Number(|of| of.moved.into())),
    ("reshaped", Number(|of| of.reshaped.into())),
    ("moved_by", Number(|of| of.moved_m)),
    ("turned_by", Number(|of| of.turned)),
    ("tasks", Number(|of| of.tasks.into())),
    ("subgoals", Number(|of| of.vertices.into())),
    ("subgoals_moved", Number(|of| of.vertices_moved.into())),
    ("subgoals_dropped", Number(|of| of.vertices_dropped.into())),
    ("unsure_subgoals", Number(|of| of.unsure_vertices)),
    ("edges", Number(|of| of.edges.into())),
    ("broken_edges", Number(|of| of.broken_edges)),
    ("solve_over_reach", Number(|of| of.solve_over_reach)),
];

/// What rules are told of an object to which a subgoal may be attached.
const fn landmarks<'o>() -> [Property<LandmarkFacts<'o>>; 7] {
    [
        ("object", Text(|of| Some(of.object))),
        ("distance", Number(|of| of.distance_m)),
        ("clearance", Perhaps(|of| Some(of.clearance_m()).filter(|metres| metres.is_finite()))),
        ("is_movable", Truth(|of| of.is_movable)),
        ("times_moved", Number(|of| of.times_moved.into())),
        ("subgoals", Number(|of| of.subgoals().into())),
        ("is_goal", Truth(|of| of.is_goal)),
    ]
}

/// What rules are told of an edge that was not verified since an object changed.
const EDGES: [Property<EdgeFacts>; 6] = [
    ("age", Number(|of| of.age_tasks.into())),
    ("age_changes", Number(|of| of.age_changes.into())),
    ("times_verified", Number(|of| of.times_verified.into())),
    ("unverified_objects", Number(|of| of.unverified_objects.into())),
    ("broken_edges", Number(|of| of.broken_edges)),
    ("length", Number(|of| of.length)),
];

/// The classes of objects that rules are asked about.
pub(crate) fn classes() -> [Class; 3] {
    [
        Class::new("CELL_CHANGES", CELL_CHANGES, &["strategy"]),
        Class::new("LANDMARKS", landmarks(), &["weight", "serves"]),
        Class::new("EDGES", EDGES, &["trust"]),
    ]
}

const STRATEGIES: [(&str, Strategy); 4] = [
    ("a0", Strategy::Forget),
    ("a1", Strategy::VerifyAll),
    ("a2", Strategy::RepairAll),
    ("a3", Strategy::OnDemand),
];
const TRUSTS: [(&str, Trust); 3] =
    [("use", Trust::AsItIs), ("verify", Trust::Verify), ("give up", Trust::GiveUp)];

/// The word for a strategy, as rules, tables and the command line have it.
pub fn strategy_word(strategy: Strategy) -> &'static str {
    word_for(&STRATEGIES, &strategy).unwrap_or("a3")
}

pub fn strategy_of(word: &str) -> Option<Strategy> {
    STRATEGIES.iter().find(|(known, _)| *known == word).map(|(_, strategy)| *strategy)
}

#[derive(Debug)]
pub struct RuleJudge {
    changes: Consultation,
    landmarks: Consultation,
    edges: Consultation,
    /// Taken whatever rules say: the strategy that an experiment or the command line asks for.
    fixed: Option<Strategy>,
    considered: Vec<Considered>,
    /// `None` where nobody wants to know which rules decided.
    explained: Option<Explained>,
    trouble: Option<String>,
}

impl RuleJudge {
    /// Makes ready; a `fixed` strategy is taken whatever rules say. Which rules decided is kept if it `explains`.
    pub fn new(rules: &Arc<RuleBase>, fixed: Option<Strategy>, explains: bool) -> Result<Self, ClassError> {
        Self::made((fixed, explains), |class| class.consultation(rules))
    }

    /// Makes ready for a site, whose rules may look at all that is known of it.
    pub fn of_site(asked: &Asked<'_>, fixed: Option<Strategy>, explains: bool) -> crate::error::Result<Self> {
        Self::made((fixed, explains), |class| asked.consultation(class))
    }

    fn made<E>(
        (fixed, explains): (Option<Strategy>, bool),
        ready: impl Fn(&Class) -> Result<Consultation, E>,
    ) -> Result<Self, E> {
        let [changes, landmarks, edges] = classes();
        Ok(Self {
            changes: ready(&changes)?,
            landmarks: ready(&landmarks)?,
            edges: ready(&edges)?,
            fixed,
            considered: Vec::new(),
            explained: explains.then(Explained::default),
            trouble: None,
        })
    }

    /// The first thing that failed, or that the rules did not say, or said in words that mean nothing. From then on they
    /// are not asked any more.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Which rules spoke of the strategy when it was last asked for, and why the others did not; empties the list.
    pub fn take_considered(&mut self) -> Vec<Considered> {
        std::mem::take(&mut self.considered)
    }

    /// Which rules decided since this was last asked, if that is kept.
    pub fn take_explained(&mut self) -> Explained {
        self.explained.as_mut().map(std::mem::take).unwrap_or_default()
    }

    fn missing(&mut self, what: &str, found: Option<String>, wanted: &str) {
        let found = found.map_or_else(String::new, |found| format!(", but {found}"));
        self.trouble.get_or_insert_with(|| format!("rules do not say {what}{found}; expected {wanted}"));
    }
}

impl Judge for RuleJudge {
    fn strategy(&mut self, facts: &ChangeFacts) -> Strategy {
        if let Some(fixed) = self.fixed {
            return fixed;
        }
        if self.trouble.is_some() {
            return Strategy::OnDemand;
        }
        consult(&mut self.changes, &object(CELL_CHANGES, facts), &mut self.trouble);
        self.considered = self.changes.considered("strategy");
        match meant(&self.changes, 0, &STRATEGIES) {
            Ok(strategy) => {
                if let Some(explained) = &mut self.explained {
                    explained.add("strategy", strategy_word(strategy), &self.considered);
                }
                strategy
            }
            Err(found) => {
                self.missing("the strategy after a change", found, "\"a0\", \"a1\", \"a2\" or \"a3\"");
                Strategy::OnDemand
            }
        }
    }

    fn landmark(&mut self, facts: &LandmarkFacts<'_>) -> Option<f64> {
        if self.trouble.is_some() {
            return None;
        }
        // Who explains tells all that was known, whether rules look at it or not.
        let is_told = |input| self.explained.is_some() || self.landmarks.looks_at(input);
        let told = object_of(landmarks(), facts, is_told);
        consult(&mut self.landmarks, &told, &mut self.trouble);
        if let Some(explained) = &mut self.explained {
            let answer = self
                .landmarks
                .truth(1)
                .map_or("unknown", |serves| if serves { "serves" } else { "does not" });
            let answer = format!("{} {answer}", facts.object);
            explained.add("landmark", &answer, &self.landmarks.considered("serves"));
        }
        match (self.landmarks.truth(1), self.landmarks.number(0)) {
            (Some(false), _) => None,
            (Some(true), Some(weight)) if weight.is_finite() => Some(weight),
            _ => {
                let what = format!("whether object {} serves as landmark, or what it weighs", facts.object);
                self.missing(&what, None, "`serves`, and a finite `weight`");
                None
            }
        }
    }

    fn trust(&mut self, facts: &EdgeFacts) -> Trust {
        if self.trouble.is_some() {
            return Trust::Verify;
        }
        consult(&mut self.edges, &object(EDGES, facts), &mut self.trouble);
        match meant(&self.edges, 0, &TRUSTS) {
            Ok(trust) => {
                if let Some(explained) = &mut self.explained {
                    let word = word_for(&TRUSTS, &trust).unwrap_or_default();
                    explained.add("trust", word, &self.edges.considered("trust"));
                }
                trust
            }
            Err(found) => {
                self.missing("whether an edge is trusted", found, "\"use\", \"verify\" or \"give up\"");
                Trust::Verify
            }
        }
    }
}

/// What rules were told of a change, as JSON.
pub fn told(facts: &ChangeFacts) -> serde_json::Value {
    let number = |of: Of<ChangeFacts>| if let Number(of) = of { Some(of(facts)) } else { None };
    CELL_CHANGES.into_iter().map(|(name, of)| (name.to_owned(), serde_json::json!(number(of)))).collect()
}
