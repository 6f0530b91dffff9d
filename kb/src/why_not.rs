//! Why not another way: what the best route through a room or door would cost, and what rules rejected there.

use adit_db::Tx;
use adit_db::door::Door;
use adit_engine::Rejected;
use adit_planners::geometry::Point;
use adit_planners::routes::{Start, Tree};
use serde::Serialize;

use crate::answer::pick_robot;
use crate::error::{Error, Result};
use crate::generation;
use crate::graph::{End, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::subject::Subject;
use crate::suggest::did_you_mean;
use crate::why::{Reasoned, conclusions};

/// Arrivals in a room from which a way on is tried; the cheapest come first.
const ARRIVALS: usize = 8;

/// Why a route does not lead through a room or door.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    /// In one sentence.
    pub reason: String,
    /// What is concluded about the room or door.
    pub conclusions: Vec<Reasoned>,
    /// What rules did not take on the way to that, and why not.
    pub rejected: Vec<Rejected>,
    /// Whether there were more objects than are looked at.
    pub truncated: bool,
}

impl KnowledgeBase {
    /// Why the best route from `start` to `goal` does not lead through a room or door (`room d`, `door 7`).
    ///
    /// Where tables, `site.toml` or the map were edited since the last build, everything is derived again first.
    pub fn why_not(&self, start: &str, goal: &str, through: &str, robot: Option<&str>) -> Result<WhyNot> {
        self.fresh()?.snapshot(|tx| {
            let subject = Subject::find(tx, through)?;
            let robot = pick_robot(tx, robot)?;
            let graph = SiteGraph::new(tx.rooms()?, tx.doors()?, tx.places()?);
            let question = Question::new(&graph, start, goal, &robot)?;
            let key = subject.key.parse().unwrap_or_default();
            let cost = match subject.class.as_str() {
                "rooms" => graph.room(key).and_then(|room| question.through_room(room)),
                "doors" => graph.door(key).and_then(|door| question.through_door(door)),
                _ => {
                    let message = format!("a route leads through rooms and doors, not {}", subject.name);
                    return Err(Error::said("why/through", message, None));
                }
            };
            let best = question.best();
            let reason = reason(&subject, graph.door(key), (start, goal), best, cost);
            let (rejected, truncated) = self.rejected(tx, &subject)?;
            Ok(WhyNot {
                generation: generation::read(tx)?,
                robot,
                start: start.to_owned(),
                goal: goal.to_owned(),
                best,
                cost,
                reason,
                conclusions: conclusions(tx, &Subject { property: None, ..subject.clone() })?,
                through: subject.name,
                rejected,
                truncated,
            })
        })
    }

    /// What rules rejected on the way to the values of a room or door, derived anew in memory.
    fn rejected(&self, tx: &mut Tx<'_>, subject: &Subject) -> Result<(Vec<Rejected>, bool)> {
        let (mut derived, rules) = self.derived_anew(tx)?;
        let class = subject.class.to_uppercase();
        let (mut rejected, mut truncated) = (Vec::new(), false);
        for property in ["hardness", "action", "passable"] {
            let asked = derived.knowledge.why_not(&rules, &class, &subject.key, property);
            for one in asked.iter().flat_map(|why| &why.rejected) {
                // one rule mostly gives all three, and rejects the same for each
                if !rejected.contains(one) {
                    rejected.push(one.clone());
                }
            }
            truncated |= asked.is_some_and(|why| why.truncated);
        }
        Ok((rejected, truncated))
    }
}

/// Ways from a start to a goal.
struct Question<'g> {
    graph: &'g SiteGraph,
    tree: Tree,
    goals: Vec<usize>,
    goal: Option<Point>,
}

impl<'g> Question<'g> {
    fn new(graph: &'g SiteGraph, start: &str, goal: &str, robot: &str) -> Result<Self> {
        let end = |name: &str| {
            graph.end(name).ok_or_else(|| {
                let message = format!("`{name}` is no place, no room and no point `x,y`");
                Error::said("route/unknown", message, did_you_mean(name, graph.names()))
            })
        };
        let (start, goal) = (end(start)?, end(goal)?);
        let at = if matches!(goal, End::Room(_)) { None } else { Some(graph.point(&goal)) };
        let tree = graph.graph().tree(&graph.start(&start, Some(robot)));
        Ok(Self { graph, tree, goals: graph.rooms_of(&goal, Some(robot)), goal: at })
    }

    fn best(&self) -> Option<f64> {
        self.cost(&self.tree)
    }

    /// What reaching the goal costs.
    fn cost(&self, tree: &Tree) -> Option<f64> {
        match self.goal {
            Some(goal) => {
                let (arrival, leg) = tree.best_at(self.graph.graph(), &self.goals, goal)?;
                Some(tree.arrivals[arrival].cost + leg)
            }
            None => self.goals.iter().find_map(|&room| tree.best(room)).map(|arrival| arrival.cost),
        }
    }

    fn on(&self, room: usize, at: Point) -> Option<f64> {
        let start = Start { rooms: vec![room], at };
        self.cost(&self.graph.graph().tree_until(&start, &self.goals, self.goal))
    }

    fn through_room(&self, room: usize) -> Option<f64> {
        let arrivals = self.tree.of_room[room].iter().take(ARRIVALS).map(|&index| self.tree.arrivals[index]);
        arrivals.filter_map(|arrival| Some(arrival.cost + self.on(room, arrival.at)?)).min_by(f64::total_cmp)
    }

    /// By the point that stands for the door; both ways, unless it is passed one way only.
    fn through_door(&self, door: &Door) -> Option<f64> {
        let hardness = door.hardness.value.filter(|_| door.passable.value == Some(true))?;
        let at = Point::new(door.at[0], door.at[1]);
        let (one, two) = (self.graph.room(door.side1.room)?, self.graph.room(door.side2.room)?);
        let ways = [(one, two), (two, one)];
        let ways = if door.one_way { &ways[..1] } else { &ways[..] };
        let cost = |&(from, to): &(usize, usize)| {
            let (arrival, leg) = self.tree.best_at(self.graph.graph(), &[from], at)?;
            Some(self.tree.arrivals[arrival].cost + leg + hardness + self.on(to, at)?)
        };
        ways.iter().filter_map(cost).min_by(f64::total_cmp)
    }
}

fn reason(
    subject: &Subject,
    door: Option<&Door>,
    (start, goal): (&str, &str),
    best: Option<f64>,
    cost: Option<f64>,
) -> String {
    use crate::number::number;
    let name = &subject.name;
    match (best, cost) {
        // the way through a door is measured by one point of it
        (Some(best), Some(cost)) if cost <= best * (1.0 + 1e-9) => {
            format!("the best route from {start} to {goal} leads through {name}, hardness {}", number(best))
        }
        (Some(best), Some(cost)) => format!(
            "through {name} it costs {}, {} more than the best route from {start} to {goal} ({})",
            number(cost),
            number(cost - best),
            number(best)
        ),
        (None, Some(cost)) => format!("through {name} it costs {}", number(cost)),
        (_, None) => match door.filter(|_| subject.class == "doors") {
            Some(door) if door.passable.value == Some(false) => format!("{name} lets no state through"),
            Some(door) if door.passable.value.is_none() || door.hardness.value.is_none() => {
                format!("{name} has no hardness: no rule gives it one, or rules disagree")
            }
            _ => format!("no way leads from {start} through {name} to {goal}"),
        },
    }
}
