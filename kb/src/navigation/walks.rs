//! Paths over a floor plan as it is, over the adits by what rules say that ways weigh (Crowley).

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_planners::floor_plan::{Network, NoPath, Path, Rule, Spot, Way};
use adit_planners::geometry::{Point, Segment};
use adit_planners::navigation::{Judge, WayFacts};

use super::floor::Floor;
use super::judge::RuleJudge;
use super::stretches::{OfWay, rows, sorted};
use crate::draw::render_floor;
use crate::error::Result;
use crate::plan::Said;
use crate::plan::course::{Found, NoEnd, Pathfinder, no_through, numbered};
use crate::words::number::{counted, number};
use crate::words::point::point;
use crate::words::suggest::did_you_mean;

/// A robot on the plan.
pub struct Walker {
    pub robot: String,
    pub floor: Floor,
    /// Why it fits through no doorway.
    pub unfit: Option<String>,
    pub judge: Mutex<RuleJudge>,
}

/// Paths over a floor plan as it is.
pub struct Walkers {
    pub places: BTreeMap<String, Point>,
    pub walkers: Vec<Walker>,
}

impl Walkers {
    fn end(&self, text: &str, is_start: bool) -> std::result::Result<Point, NoEnd> {
        self.places.get(text).copied().or_else(|| point(text)).ok_or_else(|| {
            let meant = did_you_mean(text, self.places.keys().map(String::as_str));
            let meant = meant.map_or(String::new(), |help| format!("; {help}"));
            NoEnd { is_start, reason: format!("`{text}` is no place and no point `x,y`{meant}") }
        })
    }

    fn walker(&self, robot: &str) -> std::result::Result<&Walker, NoEnd> {
        let walker = self.walkers.iter().find(|walker| walker.robot == robot);
        walker.ok_or_else(|| NoEnd { is_start: true, reason: format!("there is no robot `{robot}`") })
    }

    fn path(&self, robot: &str, ends: [&str; 2], rule: Rule) -> std::result::Result<Walked<'_>, NoEnd> {
        let walker = self.walker(robot)?;
        let (start, goal) = (self.end(ends[0], true)?, self.end(ends[1], false)?);
        if let Some(unfit) = &walker.unfit {
            return Ok(Walked { walker, path: Err(unfit.clone()), said: BTreeMap::new(), legs: Vec::new() });
        }
        let mut judge = walker.judge.lock().unwrap_or_else(PoisonError::into_inner);
        let mut said = BTreeMap::new();
        // those that lead from the start and to the goal are of this path alone
        let mut of_ends: Vec<Way> = Vec::new();
        // through which doorways rules let nobody
        let mut refused: BTreeMap<usize, Way> = BTreeMap::new();
        let path = walker.floor.network.path(start, goal, rule, |way| {
            let weight = judge.weigh(&WayFacts { way, is_cut: false, times_blocked: 0 });
            if let (None, Some(doorway)) = (weight, way.doorway) {
                refused.insert(doorway, way.clone());
            }
            let weight = weight?;
            let of_way = OfWay { weight, length: way.length, action: judge.action(), rule: None };
            said.insert(sorted(way.from, way.to), of_way);
            if [way.from, way.to].iter().any(|end| matches!(end, Spot::Start | Spot::Goal)) {
                of_ends.push(way.clone());
            }
            Some(weight)
        });
        let path = match judge.trouble() {
            Some(trouble) => Err(trouble.to_owned()),
            None => path.map_err(|reason| match reason {
                NoPath::NoWay if !refused.is_empty() => because(&refused, &mut judge),
                NoPath::Start => unfit(&walker.floor, ("start", start)),
                NoPath::Goal => unfit(&walker.floor, ("goal", goal)),
                other => other.to_string(),
            }),
        };
        let mut legs = Vec::new();
        if let Ok(path) = &path {
            let adits = path.adits.iter().map(|adit| Spot::Adit(*adit));
            let spots: Vec<Spot> = [Spot::Start].into_iter().chain(adits).chain([Spot::Goal]).collect();
            for pair in spots.windows(2) {
                let ends = sorted(pair[0], pair[1]);
                let is_it = |way: &&Way| sorted(way.from, way.to) == ends;
                let way = of_ends.iter().chain(&walker.floor.network.ways).find(is_it);
                let place = way.map(|way| match (way.doorway, way.region) {
                    (Some(doorway), _) => format!("doorway {doorway}"),
                    (None, region) => format!("region {}", region.unwrap_or_default()),
                });
                let Some((way, place)) = way.zip(place) else { continue };
                let of_leg = judge.said_of(way, place);
                if let Some(of_way) = said.get_mut(&ends) {
                    of_way.rule = of_leg.rule_of("weight");
                }
                legs.push(of_leg);
            }
        }
        drop(judge);
        Ok(Walked { walker, path, said, legs })
    }
}

/// Why a robot cannot stand at an end.
fn unfit(floor: &Floor, (end, at): (&str, Point)) -> String {
    if !floor.plan.is_free(at) {
        return format!(
            "the {end} ({}, {}) lies outside of the plan, or in a wall",
            number(at.x),
            number(at.y)
        );
    }
    let walls = floor.plan.barriers();
    let nearest = walls.iter().map(|wall| Segment::from(*wall).distance(at)).fold(f64::INFINITY, f64::min);
    let disc = floor.network.disc;
    format!(
        "the robot cannot stand at the {end} ({}, {}): a wall is {} m away, and it needs more than {} m",
        number(at.x),
        number(at.y),
        number(nearest),
        number(disc.reach())
    )
}

/// Why nothing leads on: through which doorways rules let nobody, and by which rule.
fn because(refused: &BTreeMap<usize, Way>, judge: &mut RuleJudge) -> String {
    let said = refused.iter().map(|(doorway, way)| {
        let why = judge
            .refused_by(way)
            .unwrap_or_else(|| "lets nobody through: no rule says that it may be passed".to_owned());
        format!("doorway {doorway} {why}")
    });
    let said: Vec<String> = said.collect();
    format!("{}; no other way joins the start and the goal", said.join(", "))
}

/// A path that was looked for.
struct Walked<'w> {
    walker: &'w Walker,
    path: std::result::Result<Path, String>,
    /// What rules say of each way, by its ends.
    said: BTreeMap<(Spot, Spot), OfWay>,
    /// What rules said of each stretch of the path.
    legs: Vec<Said>,
}

impl Pathfinder for Walkers {
    fn robots(&self) -> Vec<String> {
        self.walkers.iter().map(|walker| walker.robot.clone()).collect()
    }

    fn ends(&self) -> Vec<Place> {
        self.places.iter().map(|(place, at)| Place { place: place.clone(), x: at.x, y: at.y }).collect()
    }

    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let walked = self.path(robot, [start, goal], Rule::Tight)?;
        Ok(found([robot, start, goal], &walked))
    }

    fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found> {
        let network = &self.walker(robot)?.floor.network;
        let doorways = network.regions.doorways.len();
        let doorway = numbered(through, "doorway").filter(|number| *number < doorways).ok_or_else(|| {
            no_through(through, &format!("`doorway 0` to `doorway {}`", doorways.saturating_sub(1)))
        })?;
        let walked = self.path(robot, ends, Rule::Tight)?;
        let is_best = walked.path.as_ref().is_ok_and(|path| path.doorways.contains(&doorway));
        let walked = if is_best { walked } else { self.path(robot, ends, Rule::Through(doorway))? };
        if walked.path.is_ok() {
            return Ok(found([robot, ends[0], ends[1]], &walked));
        }
        let mut judge = walked.walker.judge.lock().unwrap_or_else(PoisonError::into_inner);
        let way = network.ways.iter().find(|way| way.doorway == Some(doorway));
        let reason = match way.map(|way| judge.refused_by(way)) {
            Some(Some(why)) => format!("{through} {why}"),
            None => format!("{robot} does not fit through {through}"),
            Some(None) => format!("no way leads to {through} and on from it"),
        };
        let row = Row { reason: Some(reason), ..Row::blank(robot, ends[0], ends[1]) };
        Ok(Found { row, said: Vec::new() })
    }

    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd> {
        let Some([robot, start, goal]) = route else {
            let Some(Walker { floor, .. }) = self.walkers.first() else { return Ok(String::new()) };
            return Ok(drawn(title, floor, None));
        };
        let walked = self.path(robot, [start, goal], Rule::Tight)?;
        Ok(drawn(title, &walked.walker.floor, walked.path.as_ref().ok()))
    }

    fn trouble(&self) -> Option<String> {
        let troubles = self.walkers.iter().map(|walker| {
            let judge = walker.judge.lock().unwrap_or_else(PoisonError::into_inner);
            judge.trouble().map(str::to_owned)
        });
        troubles.flatten().next()
    }

    fn summary(&self) -> String {
        let fits = self.walkers.iter().find(|walker| walker.unfit.is_none());
        let Some(Walker { floor, .. }) = fits else {
            return "no robot that fits through a doorway".to_owned();
        };
        let Network { regions, adits, .. } = &floor.network;
        [(regions.regions.len(), "region"), (regions.doorways.len(), "doorway"), (adits.len(), "adit")]
            .map(|(count, what)| counted(count, what))
            .join(", ")
    }
}

fn drawn(title: &str, floor: &Floor, path: Option<&Path>) -> String {
    let Floor { plan, network, told, .. } = floor;
    render_floor(title, plan, network, |doorway| told.is_closed(doorway), path)
}

/// What came of it, as it is kept.
fn found([robot, start, goal]: [&str; 3], walked: &Walked<'_>) -> Found {
    let mut row = Row::blank(robot, start, goal);
    match &walked.path {
        Err(reason) => row.reason = Some(reason.clone()),
        Ok(path) => {
            let network = &walked.walker.floor.network;
            (row.steps, row.waypoints) =
                rows(network, &walked.walker.floor.plan.barriers(), path, &walked.said);
            (row.cost, row.distance) = (row.steps.last().map(|step| step.cost), Some(path.length));
            let near = row.waypoints.iter().filter_map(|at| at.clearance);
            row.clearance = near.min_by(f64::total_cmp);
        }
    }
    Found { row, said: walked.legs.iter().cloned().map(Arc::new).collect() }
}
