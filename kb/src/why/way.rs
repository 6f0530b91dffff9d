//! Why a route does what it does: for each stretch in another state than the easiest, what keeps the easier ones out, what the
//! best way without this state costs, and up to which value of its number the choice holds.
//!
//! The words are put together from the answer, and the answer is made of them: a circle that stays.

mod parts;
mod words;

use adit_engine::Value;
use adit_planners::geometry::{Point, Segment};
use adit_planners::routes::DoorIndex;
use serde::Serialize;

use super::contrast::without::Without;
use super::contrast::{Beside, Choice, Routes, Turn, is_best};
use super::course;
use super::hindered::{Driven, Hindered};
use crate::answer;
use crate::error::Result;
use crate::graph::SiteGraph;
use crate::live::Live;
use crate::state::State;
use crate::state::tunable::{Lever, Side};
use crate::why::probe::Prober;
use crate::why::why_not::failures;
use parts::{Ease, Manner, Part, is_at, parts, spaces_of};

/// Why a route does what it does.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct WhyWay {
    /// The state of the knowledge base that the answer rests on.
    pub generation: u64,
    /// Whose route.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// What the route costs; `null`: there is none.
    pub cost: Option<f64>,
    /// What is done most easily, on all the rest of the way; `null`: nothing is known of it.
    pub easiest: Option<String>,
    /// The stretches on which something else is done.
    pub stretches: Vec<Stretch>,
    /// All of it, a paragraph a stretch.
    pub sentences: Vec<String>,
}

/// A stretch of a route on which something else is done than what is easiest.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Stretch {
    /// The state; `null` in the paper's modes.
    pub state: Option<String>,
    /// What is done.
    pub action: String,
    /// The spaces that it leads through.
    pub spaces: Vec<String>,
    /// Where it begins.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// Metres.
    pub metres: f64,
    /// What they cost.
    pub cost: f64,
    /// The states that are easier, and what keeps each of them out.
    pub hindered: Vec<Hindered>,
    /// In the paper's modes: what each state fails at the door.
    pub failed: Vec<String>,
    /// The best way on which this is done nowhere; `null`: there is none.
    pub without: Option<Other>,
    /// Up to where the choice holds, in the number of the tables that says how hard this is; `null`: without an end.
    pub holds: Option<Holds>,
}

/// A way that does otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Other {
    /// What it costs.
    pub cost: f64,
    /// How much more that is.
    pub more: f64,
    /// The spaces that it leads through, and the route does not.
    pub by: Vec<String>,
}

/// Up to which value of a cell a choice holds.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Holds {
    /// Its table.
    pub table: String,
    /// Its row.
    pub key: String,
    /// Its column.
    pub column: String,
    /// What it is now, with the named tunings that are on.
    pub value: f64,
    /// Down to where; `null`: without an end.
    pub low: Option<f64>,
    /// Up to where; `null`: without an end.
    pub high: Option<f64>,
    /// Whether the ends are exact: but for rounding where all hardness lies on the doors, to a thousandth elsewhere; otherwise they
    /// were found by trying values.
    pub exact: bool,
}

impl WhyWay {
    /// Of which nothing is known yet.
    fn blank(generation: u64, (start, goal): (&str, &str), robot: String) -> Self {
        Self {
            generation,
            robot,
            start: start.to_owned(),
            goal: goal.to_owned(),
            cost: None,
            easiest: None,
            stretches: Vec::new(),
            sentences: Vec::new(),
        }
    }
}

impl Live {
    /// Why the best route from `start` to `goal` does what it does.
    ///
    /// # Arguments
    /// `at` keeps to the stretches at something, as [`why_not`](Self::why_not) is asked about it.
    pub fn why_way(&self, ends: (&str, &str), at: Option<&str>, robot: Option<&str>) -> Result<WhyWay> {
        self.fork().why_way(ends, at, robot)
    }
}

impl State {
    /// As [`Live::why_way`], of the state that was forked.
    pub fn why_way(
        mut self,
        (start, goal): (&str, &str),
        at: Option<&str>,
        robot: Option<&str>,
    ) -> Result<WhyWay> {
        if let Some(courses) = &self.courses {
            let robot = answer::pick(&self.robots(), robot)?;
            let (cost, sentences) = course::why_way(courses, (start, goal), at, &robot)?;
            return Ok(WhyWay { cost, sentences, ..WhyWay::blank(self.generation, (start, goal), robot) });
        }
        self.site.site().needs_rooms()?;
        let robot = answer::pick(&self.robots(), robot)?;
        let meant = at.map(|at| self.meant(at, &robot)).transpose()?;
        let routes = Routes::new(&self, start, goal, &robot)?;
        let best = Choice::among(&routes, self.graph().graph());
        let mut answer = WhyWay::blank(self.generation, (start, goal), robot.clone());
        answer.cost = best.as_ref().map(|best| best.driven.cost);
        let Some(best) = best else {
            let basis = self.basis();
            let why = basis.why_shut(&routes.start, &routes.goal);
            answer.sentences.push(match why {
                Some(why) => format!("No route leads from {start} to {goal}: {why}."),
                None => format!("No route leads from {start} to {goal}."),
            });
            return Ok(answer);
        };
        let ease = Ease::of(&self, &robot);
        answer.easiest = ease.easiest(&self);
        let parts: Vec<Part> = parts(self.graph(), &best, routes.is_on_doors());
        let is_other = |part: &&Part| !ease.is_easiest(&part.manner);
        let is_meant = |part: &&Part| meant.as_ref().is_none_or(|meant| is_at(self.graph(), meant, part));
        let is_passed = meant.is_none() || parts.iter().any(|part| is_meant(&part));
        let asked: Vec<&Part> = parts.iter().filter(is_other).filter(is_meant).collect();
        let mut manners: Vec<Manner> = Vec::new();
        for part in &asked {
            if !manners.contains(&part.manner) {
                manners.push(part.manner.clone());
            }
            let mut stretch = Stretch::of(part);
            match &part.manner {
                Manner::State(of) => {
                    let driven = Driven { legs: &part.legs, per_m: part.per_m };
                    let easier = ease.easier_than(of, part.per_m);
                    stretch.hindered =
                        easier.into_iter().filter_map(|easier| self.hindered(easier, &driven)).collect();
                }
                Manner::Action(_) => stretch.failed = self.failed(&part.doors),
            }
            answer.stretches.push(stretch);
        }
        let passed = spaces_of(self.graph(), &best);
        let mut contrasts = Vec::new();
        for manner in &manners {
            let without = manner.without(self.graph());
            let (others, other) = Without::new(self.graph().graph(), (&routes.start, &routes.goal), without);
            contrasts.push((manner.clone(), others, other));
        }
        let said: Vec<Option<Other>> = contrasts
            .iter()
            .map(|(_, _, other)| other.as_ref().map(|other| Other::of(self.graph(), &best, other, &passed)))
            .collect();
        let mut prober = Prober::new(self);
        let mut holds = Vec::new();
        for (manner, others, other) in &contrasts {
            let is_dearer = other.as_ref().is_some_and(|other| !is_best(best.tight.cost, other.tight.cost));
            let found = if is_dearer { Holds::of(manner, &mut prober, &routes, others)? } else { None };
            holds.push(found);
        }
        for (stretch, part) in answer.stretches.iter_mut().zip(&asked) {
            let Some(place) = manners.iter().position(|manner| *manner == part.manner) else { continue };
            (stretch.without, stretch.holds) = (said[place].clone(), holds[place].clone());
        }
        answer.sentences = words::sentences(&answer, meant.as_ref(), is_passed);
        Ok(answer)
    }

    /// What each state fails at doors, in the paper's modes.
    fn failed(&mut self, doors: &[DoorIndex]) -> Vec<String> {
        let mut rejected = Vec::new();
        for &door in doors {
            let key = self.graph()[door].door.to_string();
            let asked = self.knowledge.why_not(&self.inputs.rules, "DOORS", &key, "hardness");
            rejected.extend(asked.into_iter().flat_map(|why| why.rejected));
        }
        failures(&rejected)
    }
}

impl Holds {
    /// Up to where the cells of its own row hold the choice.
    fn of(manner: &Manner, prober: &mut Prober, routes: &Routes, others: &Without) -> Result<Option<Self>> {
        let is_own = |lever: &Lever, fork: &State| match manner {
            Manner::State((robot, state)) => {
                lever.class == "ROBOTS" && lever.key == format!("{robot}/{state}")
            }
            Manner::Action(action) => {
                lever.class == "ROBOTS"
                    && matches!(fork.knowledge.value_at("ROBOTS", lever.row, "action"), Some(Value::Text(of)) if *of == **action)
            }
        };
        let beside = Beside::new(routes, others);
        let effects = prober.effects_in("ROBOTS")?;
        for effect in effects {
            if !is_own(&effect.lever, &prober.fork) {
                continue;
            }
            let mut turn = Turn::new(prober, &beside);
            let lever = &effect.lever;
            let sides = turn.ends(&[(&effect, Side::Below), (&effect, Side::Above)], None)?;
            let exact = sides.iter().all(|side| side.is_exact);
            let mut ends =
                sides.into_iter().map(|side| side.end.filter(|end| end.cost().is_some()).map(|end| end.at));
            let [low, high] = [ends.next().flatten(), ends.next().flatten()];
            if low.is_some() || high.is_some() {
                let (table, key, column) =
                    (lever.class.to_lowercase(), lever.key.clone(), lever.column.clone());
                return Ok(Some(Self { table, key, column, value: lever.value, low, high, exact }));
            }
        }
        Ok(None)
    }
}

impl Stretch {
    fn of(part: &Part) -> Self {
        let end = |p: Option<Point>| p.map_or([0.0; 2], |p| [p.x, p.y]);
        Self {
            state: match &part.manner {
                Manner::State((_, state)) => Some(state.clone()),
                Manner::Action(_) => None,
            },
            action: part.action.clone(),
            spaces: part.spaces.clone(),
            from: end(part.legs.first().map(|leg| leg.a)),
            to: end(part.legs.last().map(|leg| leg.b)),
            metres: part.legs.iter().map(Segment::length).sum(),
            cost: part.cost,
            hindered: Vec::new(),
            failed: Vec::new(),
            without: None,
            holds: None,
        }
    }
}

impl Other {
    fn of(graph: &SiteGraph, best: &Choice, other: &Choice, passed: &[String]) -> Self {
        let costs = Choice::costs(Some(best), Some(other));
        let (cost, than) = (costs.1.unwrap_or_default(), costs.0.unwrap_or_default());
        let mut by = spaces_of(graph, other);
        by.retain(|space| !passed.contains(space));
        Self { cost, more: cost - than, by }
    }
}
