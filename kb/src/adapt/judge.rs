//! The planner's judge: rules say what becomes of experience after a change, which object a subgoal is attached to, and
//! whether an edge is still trusted.

use std::sync::Arc;

use adit_engine::{ClassError, Considered, Consultation, Datum, RuleBase, Type};
use adit_planners::adapt::{ChangeFacts, EdgeFacts, Judge, LandmarkFacts, Strategy, Trust};

use super::explain::Explained;
use crate::plan::rules::{consult, place};

/// What rules are told of a change of a cell.
pub const CELL_CHANGES: &[(&str, Type)] = &[
    ("objects", Type::Number),
    ("appeared", Type::Number),
    ("gone", Type::Number),
    ("moved", Type::Number),
    ("reshaped", Type::Number),
    ("moved_by", Type::Number),
    ("turned_by", Type::Number),
    ("tasks", Type::Number),
    ("subgoals", Type::Number),
    ("subgoals_moved", Type::Number),
    ("subgoals_dropped", Type::Number),
    ("unsure_subgoals", Type::Number),
    ("edges", Type::Number),
    ("broken_edges", Type::Number),
    ("solve_over_reach", Type::Number),
];

/// What rules are told of an object to which a subgoal may be attached.
pub const LANDMARKS: &[(&str, Type)] = &[
    ("object", Type::Text),
    ("distance", Type::Number),
    ("clearance", Type::Number),
    ("is_movable", Type::Truth),
    ("times_moved", Type::Number),
    ("subgoals", Type::Number),
    ("is_goal", Type::Truth),
];

/// What rules are told of an edge that was not verified since an object changed.
pub const EDGES: &[(&str, Type)] = &[
    ("age", Type::Number),
    ("age_changes", Type::Number),
    ("times_verified", Type::Number),
    ("unverified_objects", Type::Number),
    ("broken_edges", Type::Number),
    ("length", Type::Number),
];

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
    STRATEGIES.iter().find(|(_, known)| *known == strategy).map_or("a3", |(word, _)| word)
}

pub fn strategy_of(word: &str) -> Option<Strategy> {
    STRATEGIES.iter().find(|(known, _)| *known == word).map(|(_, strategy)| *strategy)
}

/// What is asked of a change.
pub(crate) const OF_CELL_CHANGES: [&str; 1] = ["strategy"];
/// What is asked of a landmark.
pub(crate) const OF_LANDMARKS: [&str; 2] = ["weight", "serves"];
/// What is asked of an edge.
pub(crate) const OF_EDGES: [&str; 1] = ["trust"];

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
        let rules = || Arc::clone(rules);
        Ok(Self {
            changes: Consultation::new(rules(), "CELL_CHANGES", CELL_CHANGES, &OF_CELL_CHANGES)?,
            landmarks: Consultation::new(rules(), "LANDMARKS", LANDMARKS, &OF_LANDMARKS)?,
            edges: Consultation::new(rules(), "EDGES", EDGES, &OF_EDGES)?,
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
        consult(&mut self.changes, &change(facts), &mut self.trouble);
        self.considered = self.changes.considered("strategy");
        match meant(&self.changes, &STRATEGIES) {
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
        consult(&mut self.landmarks, &landmark(facts), &mut self.trouble);
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
        consult(&mut self.edges, &edge(facts), &mut self.trouble);
        match meant(&self.edges, &TRUSTS) {
            Ok(trust) => {
                if let Some(explained) = &mut self.explained {
                    let word = TRUSTS.iter().find(|(_, known)| *known == trust).map_or("", |(word, _)| word);
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

/// What the word in the first output means; otherwise what is there.
fn meant<T: Copy>(consultation: &Consultation, words: &[(&str, T)]) -> Result<T, Option<String>> {
    let found = words.iter().find(|(word, _)| consultation.is(0, word));
    found.map(|(_, meant)| *meant).ok_or_else(|| consultation.value(0).map(|value| value.to_string()))
}

fn change(facts: &ChangeFacts) -> [Datum<'static>; CELL_CHANGES.len()] {
    let mut object = [Datum::Unknown; CELL_CHANGES.len()];
    for (at, number) in [
        (const { place(CELL_CHANGES, "objects") }, f64::from(facts.objects)),
        (const { place(CELL_CHANGES, "appeared") }, f64::from(facts.appeared)),
        (const { place(CELL_CHANGES, "gone") }, f64::from(facts.gone)),
        (const { place(CELL_CHANGES, "moved") }, f64::from(facts.moved)),
        (const { place(CELL_CHANGES, "reshaped") }, f64::from(facts.reshaped)),
        (const { place(CELL_CHANGES, "moved_by") }, facts.moved_m),
        (const { place(CELL_CHANGES, "turned_by") }, facts.turned),
        (const { place(CELL_CHANGES, "tasks") }, f64::from(facts.tasks)),
        (const { place(CELL_CHANGES, "subgoals") }, f64::from(facts.vertices)),
        (const { place(CELL_CHANGES, "subgoals_moved") }, f64::from(facts.vertices_moved)),
        (const { place(CELL_CHANGES, "subgoals_dropped") }, f64::from(facts.vertices_dropped)),
        (const { place(CELL_CHANGES, "unsure_subgoals") }, facts.unsure_vertices),
        (const { place(CELL_CHANGES, "edges") }, f64::from(facts.edges)),
        (const { place(CELL_CHANGES, "broken_edges") }, facts.broken_edges),
        (const { place(CELL_CHANGES, "solve_over_reach") }, facts.solve_over_reach),
    ] {
        object[at] = Datum::Number(number);
    }
    object
}

/// What rules were told of a change, as JSON.
pub fn told(facts: &ChangeFacts) -> serde_json::Value {
    let values = change(facts);
    let number = |value: &Datum<'_>| if let Datum::Number(number) = value { Some(*number) } else { None };
    CELL_CHANGES
        .iter()
        .zip(&values)
        .map(|((name, _), value)| ((*name).to_owned(), serde_json::json!(number(value))))
        .collect()
}

fn landmark<'f>(facts: &LandmarkFacts<'f>) -> [Datum<'f>; LANDMARKS.len()] {
    let mut object = [Datum::Unknown; LANDMARKS.len()];
    object[const { place(LANDMARKS, "object") }] = Datum::Text(facts.object);
    object[const { place(LANDMARKS, "distance") }] = Datum::Number(facts.distance_m);
    let clearance = Some(facts.clearance_m).filter(|metres| metres.is_finite());
    object[const { place(LANDMARKS, "clearance") }] = clearance.into();
    object[const { place(LANDMARKS, "is_movable") }] = Datum::Truth(facts.is_movable);
    object[const { place(LANDMARKS, "times_moved") }] = Datum::Number(f64::from(facts.times_moved));
    object[const { place(LANDMARKS, "subgoals") }] = Datum::Number(f64::from(facts.subgoals));
    object[const { place(LANDMARKS, "is_goal") }] = Datum::Truth(facts.is_goal);
    object
}

fn edge(facts: &EdgeFacts) -> [Datum<'static>; EDGES.len()] {
    let mut object = [Datum::Unknown; EDGES.len()];
    for (at, number) in [
        (const { place(EDGES, "age") }, f64::from(facts.age_tasks)),
        (const { place(EDGES, "age_changes") }, f64::from(facts.age_changes)),
        (const { place(EDGES, "times_verified") }, f64::from(facts.times_verified)),
        (const { place(EDGES, "unverified_objects") }, f64::from(facts.unverified_objects)),
        (const { place(EDGES, "broken_edges") }, facts.broken_edges),
        (const { place(EDGES, "length") }, facts.length),
    ] {
        object[at] = Datum::Number(number);
    }
    object
}
