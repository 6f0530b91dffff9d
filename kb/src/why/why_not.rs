//! Why not another way: what the best route through a room or door would cost, contrasted with the best one, what
//! decides, and what would have to be otherwise.
//!
//! The contrast puts the answer into words, and the answer is made of them: a circle that stays.

mod contrast;
mod course;
mod through;

use std::time::{Duration, Instant};

use adit_engine::Rejected;
use serde::Serialize;

use crate::answer::{self, Answer};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::state::State;
use crate::why::Reasoned;
use crate::why::firm::{Path, Prober, Routes, Through, Turn, scale};
use crate::why::subject::Subject;
use through::{Choice, Passing, Question, Via};

/// How long is looked for a cell that would decide otherwise.
const PATIENCE: Duration = Duration::from_secs(10);

/// Why a route does not lead through a room or door.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct WhyNot {
    /// The state of the knowledge base that the answer rests on.
    pub generation: u64,
    /// Whose route.
    pub robot: String,
    /// From where.
    pub start: String,
    /// Where to.
    pub goal: String,
    /// The room or door, as people call it.
    pub through: String,
    /// Cost of the best route; `None`: there is no route at all.
    pub best: Option<f64>,
    /// Cost of the best route found through the room or door; `None`: none leads there and on.
    pub cost: Option<f64>,
    /// In a few words.
    pub reason: String,
    /// With numbers: what it would cost, what would be done instead of what, and what would have to be otherwise.
    pub sentence: String,
    /// What decides, one thing a sentence: the dearest door or room, or for each state the comparison that it fails.
    pub deciding: Vec<String>,
    /// The cell that would have to change least for this way to be the best, where one alone can do it.
    pub would_win: Option<WouldWin>,
    /// Whether not all cells were looked at, to the end of what they may be: another one may do it, or do it sooner.
    pub not_looked_further: bool,
    /// What is concluded about the room or door.
    pub conclusions: Vec<Reasoned>,
    /// What rules did not take on the way to that, and why not.
    #[schema(value_type = Vec<Object>)]
    pub rejected: Vec<Rejected>,
    /// Whether there were more objects than are looked at.
    pub truncated: bool,
    /// The route through the room or door; `None` where there is none.
    #[schema(value_type = Option<Object>)]
    pub route: Option<Answer>,
}

/// A cell with which another way would be the best.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct WouldWin {
    /// Its table.
    pub table: String,
    /// Its row.
    pub key: String,
    /// Its column.
    pub column: String,
    /// What it is.
    pub value: f64,
    /// From where on the way would be the best; there it costs as much as any other.
    pub wins_at: f64,
    /// What it would cost there.
    pub cost: f64,
}

impl Live {
    /// Why the best route from `start` to `goal` does not lead through a room or door (`room d`, `door 7`).
    pub fn why_not(&self, start: &str, goal: &str, through: &str, robot: Option<&str>) -> Result<WhyNot> {
        self.fork().why_not(start, goal, through, robot)
    }
}

impl State {
    /// As [`Live::why_not`], of the state that was forked; the site is not held up meanwhile.
    pub fn why_not(mut self, start: &str, goal: &str, through: &str, robot: Option<&str>) -> Result<WhyNot> {
        if let Some(courses) = &self.courses {
            let robot = answer::pick(&self.robots(), robot)?;
            return course::why_not(courses, [&robot, start, goal], through, self.generation);
        }
        let subject = Subject::find(&self, through)?;
        let robot = answer::pick(&self.robots(), robot)?;
        let question = Question::new(&self, start, goal, &robot)?;
        let key = subject.key.parse().unwrap_or_default();
        let via = match subject.class.as_str() {
            "rooms" => self.graph().room(key).map(Via::Room),
            "doors" => self.graph().door(key).map(Via::Door),
            _ => {
                let message = format!("a route leads through rooms and doors, not {}", subject.name);
                return Err(Error::said(Code::WhyThrough, message, None));
            }
        };
        let best = question.best();
        let (way, passing) = via.map(|via| question.passing(via)).unzip();
        let is_through =
            |way: &Choice| passing.as_ref().is_some_and(|passing| passing.holds_way(&way.driven));
        let way = best.clone().filter(is_through).or(way.flatten());
        let is_to_point = question.is_to_point();
        let (rejected, truncated) = self.rejected(&subject);
        let named = Subject { property: None, ..subject.clone() };
        let (conclusions, _) = self.conclusions(&named)?;
        let door = self.graph().door(key).map(|door| &self.graph()[door]);
        let costs = Choice::costs(best.as_ref(), way.as_ref());
        let reason = contrast::reason(&subject, door, (start, goal), costs);
        let answer = |way: &Choice| -> Result<Answer> {
            let mut answer = Answer::blank(&robot, start, &[goal.to_owned()], self.generation);
            self.basis().along(&way.driven, is_to_point, &mut answer)?;
            Ok(answer)
        };
        let route = way.as_ref().map(answer).transpose()?;
        let mut answer = WhyNot {
            generation: self.generation,
            robot,
            start: start.to_owned(),
            goal: goal.to_owned(),
            through: subject.name,
            best: costs.0,
            cost: costs.1,
            sentence: reason.clone(),
            reason,
            deciding: Vec::new(),
            would_win: None,
            not_looked_further: false,
            conclusions,
            rejected,
            truncated,
            route,
        };
        match (best, way) {
            (Some(best), Some(way)) if !contrast::is_best(best.tight.cost, way.tight.cost) => {
                let paths = (Path::of(&best.tight), Path::of(&way.tight));
                if let Some(passing) = passing {
                    answer.contrast(self, paths, &passing)?;
                }
            }
            (_, None) => answer.deciding = contrast::failures(&answer.rejected),
            _ => {}
        }
        Ok(answer)
    }

    /// What rules rejected on the way to the values of a room or door.
    fn rejected(&mut self, subject: &Subject) -> (Vec<Rejected>, bool) {
        let class = subject.class.to_uppercase();
        let (mut rejected, mut truncated) = (Vec::new(), false);
        for property in ["hardness", "action", "passable"] {
            let asked = self.knowledge.why_not(&self.inputs.rules, &class, &subject.key, property);
            for one in asked.iter().flat_map(|why| &why.rejected) {
                // one rule mostly gives all three, and rejects the same for each
                if !rejected.contains(one) {
                    rejected.push(one.clone());
                }
            }
            truncated |= asked.is_some_and(|why| why.truncated);
        }
        (rejected, truncated)
    }
}

impl WhyNot {
    /// Fills in what decides between the best way and this one, and what would have to be otherwise.
    fn contrast(&mut self, fork: State, (best, way): (Path, Path), passing: &Passing) -> Result<()> {
        let routes = Routes::new(&fork, &self.start, &self.goal, &self.robot)?;
        let (best, way) = if routes.is_on_doors() {
            let doors = |path: Path| Path { metres: Vec::new(), doors: path.doors };
            (doors(best), doors(way))
        } else {
            (best, way)
        };
        let mut prober = Prober::new(fork);
        (self.would_win, self.not_looked_further) = would_win(&mut prober, &routes, passing)?;
        self.deciding = contrast::deciding(&prober, &best, &way);
        self.sentence = contrast::sentence(self);
        Ok(())
    }
}

/// The cell that has to change least, as a share of what it is, for a way through to cost no more than any other; and
/// whether time was over before all were looked at.
fn would_win(
    prober: &mut Prober,
    routes: &Routes,
    through: &dyn Through,
) -> Result<(Option<WouldWin>, bool)> {
    let deadline = Instant::now() + PATIENCE;
    let levers = prober.levers()?;
    let mut turn = Turn::new(prober, routes, through, deadline);
    let guesses: Result<Vec<f64>> = levers.iter().map(|lever| turn.guess(lever)).collect();
    let mut guessed: Vec<_> = guesses?.into_iter().zip(levers).collect();
    guessed.sort_by(|(one, _), (two, _)| one.total_cmp(two));
    let (mut found, mut least) = (None, f64::INFINITY);
    for (_, lever) in guessed {
        let Some((wins_at, cost)) = turn.nearest(&lever, least)? else { continue };
        let share = (wins_at - lever.value).abs() / scale(&lever);
        if share < least {
            least = share;
            let (table, key, column) = (lever.class.to_lowercase(), lever.key, lever.column);
            found = Some(WouldWin { table, key, column, value: lever.value, wins_at, cost });
        }
    }
    Ok((found, turn.is_cut()))
}
