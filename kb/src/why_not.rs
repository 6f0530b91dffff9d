//! Why not another way: what the best route through a room or door would cost, and what rules rejected there.

use adit_db::Tx;
use adit_db::door::Door;
use adit_engine::Rejected;
use adit_planners::geometry::Point;
use adit_planners::routes::{Goal, Start};
use serde::Serialize;

use crate::answer::pick_robot;
use crate::error::{Error, Result};
use crate::generation;
use crate::graph::{End, SiteGraph};
use crate::knowledge::KnowledgeBase;
use crate::subject::Subject;
use crate::suggest::did_you_mean;
use crate::why::{Reasoned, conclusions};

/// Points of a room or a door over which a way is tried.
const POINTS: usize = 9;

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
    start: Start,
    goal: Goal,
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
        Ok(Self { graph, start: graph.start(&start, Some(robot)), goal: graph.goal(&goal, Some(robot)) })
    }

    fn best(&self) -> Option<f64> {
        self.cost(&self.start, &self.goal)
    }

    fn cost(&self, start: &Start, goal: &Goal) -> Option<f64> {
        self.graph.graph().way(start, std::slice::from_ref(goal)).map(|(_, way)| way.cost)
    }

    /// What it costs to come to a point in a room.
    fn to(&self, room: usize, at: Point) -> Option<f64> {
        self.cost(&self.start, &Goal { rooms: vec![room], at: Some(at) })
    }

    /// What it costs to go on from a point in a room.
    fn on(&self, room: usize, at: Point) -> Option<f64> {
        self.cost(&Start { rooms: vec![room], at }, &self.goal)
    }

    /// By where it is entered at least cost, by its middle, or by one of its doors.
    fn through_room(&self, room: usize) -> Option<f64> {
        let first = Goal { rooms: vec![room], at: None };
        let entered =
            self.graph.graph().way(&self.start, &[first]).and_then(|(_, way)| way.legs.last().copied());
        let middle = self.graph.point(&End::Room(room));
        let doors = self.graph.graph().doors().iter();
        let doors = doors.filter(|door| !door.is_change() && (door.room1 == room || door.room2 == room));
        let points = entered.map(|leg| leg.to).into_iter().chain([middle]);
        let points = points.chain(doors.map(|door| door.crossing.centre())).take(POINTS);
        points.filter_map(|at| Some(self.to(room, at)? + self.on(room, at)?)).min_by(f64::total_cmp)
    }

    /// By one of some points of the door; both ways, unless it is passed one way only.
    fn through_door(&self, door: &Door) -> Option<f64> {
        let hardness = door.hardness.value.filter(|_| door.passable.value == Some(true))?;
        let (one, two) = (self.graph.room(door.side1.room)?, self.graph.room(door.side2.room)?);
        let ways = [(one, two), (two, one)];
        let ways = if door.one_way { &ways[..1] } else { &ways[..] };
        let [x0, y0, x1, y1] = door.segment;
        let share = |part: usize| part as f64 / (POINTS - 1) as f64;
        let along = |part| Point::new(x0 + (x1 - x0) * share(part), y0 + (y1 - y0) * share(part));
        let points: Vec<Point> = if self.graph.graph().is_on_doors() {
            vec![Point::new(door.at[0], door.at[1])]
        } else {
            (0..POINTS).map(along).collect()
        };
        let cost =
            |(from, to): (usize, usize), at: Point| Some(self.to(from, at)? + hardness + self.on(to, at)?);
        let all = ways.iter().flat_map(|&way| points.iter().filter_map(move |&at| cost(way, at)));
        all.min_by(f64::total_cmp)
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
