//! Why not another way: what the best route through something would cost, contrasted with the best one, what decides, and
//! what would have to be otherwise.
//!
//! The contrast puts the answer into words, and the answer is made of them: a circle that stays.

mod course;
mod words;

pub(super) use words::failures;

use std::sync::Arc;

use adit_engine::Rejected;
use serde::Serialize;

use super::contrast::through::Through;
use super::contrast::{Beside, Choice, Path, Routes, Turn, Ways, is_best};
use super::meant::Meant;
use crate::answer::{self, Answer};
use crate::error::Result;
use crate::live::Live;
use crate::state::State;
use crate::state::tunable::{Effect, Side};
use crate::why::Reasoned;
use crate::why::probe::Prober;
use crate::why::subject::Subject;

/// Why a route does not lead through something.
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
    /// What it is asked to lead through, as people call it.
    pub through: String,
    /// Cost of the best route; `None`: there is no route at all.
    pub best: Option<f64>,
    /// Cost of the best route found through that; `None`: none leads there and on.
    pub cost: Option<f64>,
    /// What both cost as they are driven, farther off walls, where `best` and `cost` are what they cost close to walls: it is by
    /// that that ways are chosen, and the other one may cost no more than the best when both are driven.
    pub driven: Option<[f64; 2]>,
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
    /// What is concluded about it, where it is a room or a door.
    pub conclusions: Vec<Reasoned>,
    /// What rules did not take on the way to that, and why not.
    #[schema(value_type = Vec<Object>)]
    pub rejected: Vec<Rejected>,
    /// Whether there were more objects than are looked at.
    pub truncated: bool,
    /// The route through it; `None` where there is none.
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
    /// Where the way would be the best, or as good as any other; to a thousandth it is the first such value.
    pub wins_at: f64,
    /// What it would cost there.
    pub cost: f64,
}

impl Live {
    /// Why the best route from `start` to `goal` does not lead through something: a space, a doorway, an area, a named door,
    /// `room d`, `door 7`, a place, or a point `x,y`.
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
        let robot = answer::pick(&self.robots(), robot)?;
        let meant = self.meant(through, &robot)?;
        let routes = Routes::new(&self, start, goal, &robot)?;
        let ends = (&routes.start, &routes.goal);
        let graph = self.graph().graph();
        let best = Choice::among(&routes, graph);
        let (passing, found) = Through::new(graph, ends, meant.via.clone());
        let is_driven = |way: &Choice| passing.holds_way(graph, &way.driven);
        // farther off walls it may lead past
        let tightly = |way: Choice| Choice { driven: way.tight.clone(), ..way };
        let led = best.clone().filter(is_driven);
        let is_led = led.is_some();
        let touched = best.clone().filter(|best| !is_led && passing.holds_way(graph, &best.tight));
        let way = led.or(touched.map(tightly));
        let found = found.map(|way| if is_driven(&way) { way } else { tightly(way) });
        let closed = words::closed(&self, &meant, &robot);
        let way = way.or(found).filter(|_| closed.is_none());
        let costs = Choice::costs(best.as_ref(), way.as_ref());
        let driven = best.as_ref().zip(way.as_ref()).filter(|(best, way)| best.is_chosen_close_to_walls(way));
        let driven = driven.map(|(best, way)| [best, way].map(|way| way.driven.cost));
        let reason = closed.unwrap_or_else(|| {
            words::reason(&self, &meant, &routes, (start, goal), (costs.0, costs.1, is_led))
        });
        let answer = |way: &Choice| -> Result<Answer> {
            let mut answer = Answer::blank(&robot, start, &[goal.to_owned()], self.generation);
            self.basis().along(&way.driven, routes.goal.at.is_some(), &mut answer)?;
            Ok(answer)
        };
        let route = way.as_ref().map(answer).transpose()?;
        let (mut conclusions, mut rejected, mut truncated) = (Vec::new(), Vec::new(), false);
        if let Some(subject) = &meant.subject {
            (rejected, truncated) = self.rejected(subject);
            conclusions = self.conclusions(&Subject { property: None, ..subject.clone() })?.0;
        }
        let mut answer = WhyNot {
            generation: self.generation,
            robot,
            start: start.to_owned(),
            goal: goal.to_owned(),
            through: meant.name.clone(),
            best: costs.0,
            cost: costs.1,
            driven,
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
            (Some(best), Some(way)) if !is_best(best.tight.cost, way.tight.cost) => {
                answer.contrast(
                    self,
                    (&meant, &routes, &passing),
                    [&best.tight, &way.tight].map(Path::of),
                )?;
            }
            (_, None) => answer.deciding = words::failures(&answer.rejected),
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
    fn contrast(
        &mut self,
        fork: State,
        (meant, routes, passing): (&Meant, &Routes, &Through),
        ways: [Path; 2],
    ) -> Result<()> {
        let on_doors = |path: Path| Path { metres: Vec::new(), doors: path.doors };
        let [best, way] = if routes.is_on_doors() { ways.map(on_doors) } else { ways };
        let mut prober = Prober::new(fork);
        (self.would_win, self.not_looked_further) = would_win(&mut prober, routes, passing)?;
        self.deciding = words::deciding(&prober, &best, &way);
        self.sentence = words::sentence(self, meant);
        Ok(())
    }
}

/// The cell that has to change least, as a share of what it is, for a way through to cost no more than any other; and
/// whether time was over before all were looked at.
fn would_win(prober: &mut Prober, routes: &Routes, others: &dyn Ways) -> Result<(Option<WouldWin>, bool)> {
    let effects = prober.effects()?;
    let beside = Beside::new(routes, others);
    let mut turn = Turn::new(prober, &beside);
    let guess = |effect: Arc<Effect>| (turn.guess(&effect), effect);
    let mut guessed: Vec<(f64, Arc<Effect>)> = effects.into_iter().map(guess).collect();
    guessed.sort_by(|(one, _), (two, _)| one.total_cmp(two));
    let mut effects: Vec<Arc<Effect>> = guessed.into_iter().map(|(_, effect)| effect).collect();
    let (mut found, mut least, mut is_cut) = (None, None, false);
    // the likeliest first; whatever it shows, the others are not looked at beyond it
    let others = effects.split_off(1.min(effects.len()));
    for effects in [effects, others] {
        let never = turn.without_end_below(&effects, least);
        let sides = |(effect, never): (&'_ Arc<Effect>, bool)| {
            let below = (!never).then_some(Side::Below);
            below.into_iter().chain([Side::Above]).map(|side| (Arc::clone(effect), side)).collect::<Vec<_>>()
        };
        let asked: Vec<(Arc<Effect>, Side)> = effects.iter().zip(never).flat_map(sides).collect();
        let within: Vec<(&Effect, Side)> = asked.iter().map(|(effect, side)| (&**effect, *side)).collect();
        for ((effect, _), side) in asked.iter().zip(turn.ends(&within, least)?) {
            let lever = &effect.lever;
            // between values that were tried there may be one that would do
            is_cut |= !side.is_whole || !side.is_exact && side.end.is_none();
            let Some(end) = side.end else { continue };
            let (wins_at, Some(cost)) = (end.won_at, end.cost()) else { continue };
            let share = (wins_at - lever.value).abs() / lever.scale();
            if least.is_none_or(|least| share < least) {
                least = Some(share);
                let (table, key, column) =
                    (lever.class.to_lowercase(), lever.key.clone(), lever.column.clone());
                found = Some(WouldWin { table, key, column, value: lever.value, wins_at, cost });
            }
        }
    }
    Ok((found, is_cut))
}
