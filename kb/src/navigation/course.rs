//! A floor plan as a site: the tables that its file fills, and paths over adits (Crowley).

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use adit_db::Cell;
use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_db::route::{Step, Waypoint};
use adit_engine::Schema;
use adit_planners::facts::Facts;
use adit_planners::floor_plan::clear::wall_distance;
use adit_planners::floor_plan::{
    Disc, Drawn, FloorPlan, Network, NoPath, Path, RegionsAndAdits, Rule, Spot, Way, outline,
};
use adit_planners::geometry::{Point, Segment};
use adit_planners::navigation::{Judge, Settings, WayFacts};
use adit_planners::planner::Planner;
use adit_planners::read::{Code as MapCode, Problem};
use adit_planners::world;

use super::floor::Floor;
use super::judge::RuleJudge;
use super::told::{Mark, Told, kind_of};
use crate::draw::render_floor;
use crate::error::{Error, Result};
use crate::plan::Spoke;
use crate::plan::consult::Class;
use crate::plan::course::{
    Asked, Course, Found, NoEnd, Pathfinder, name_of, no_map, no_through, numbered, point,
};
use crate::plan::rules::Kind;
use crate::site::tables::TableFile;
use crate::words::suggest::did_you_mean;

const WALLS: [(&str, &str); 5] =
    [("wall", "INTEGER"), ("x0", "REAL"), ("y0", "REAL"), ("x1", "REAL"), ("y1", "REAL")];
const SOLIDS: [(&str, &str); 2] = [("solid", "INTEGER"), ("outline", "TEXT")];
const VEHICLES: [(&str, &str); 3] = [("robot", "TEXT"), ("radius", "REAL"), ("margin", "REAL")];
const MARKS: [(&str, &str); 6] = [
    ("mark", "INTEGER"),
    ("what", "TEXT"),
    ("x", "REAL"),
    ("y", "REAL"),
    ("property", "TEXT"),
    ("value", "TEXT"),
];

/// What the robot is called.
const ROBOT: &str = "robot";

/// A floor plan as its file has it.
#[derive(Debug)]
pub struct FloorOf {
    pub file: PathBuf,
    pub floor: Floor,
}

impl Course for FloorOf {
    fn name(&self) -> &'static str {
        "floor plan"
    }

    fn tables(&self) -> Vec<TableFile> {
        let Floor { plan, network, told, .. } = &self.floor;
        let number = |place: usize| Cell::Integer(place as i64 + 1);
        let walls = plan.walls().iter().enumerate().map(|(place, [a, b])| {
            vec![number(place), Cell::Real(a.x), Cell::Real(a.y), Cell::Real(b.x), Cell::Real(b.y)]
        });
        let solids = plan.solids().iter().enumerate().map(|(place, corners)| {
            let corners: Vec<[f64; 2]> = corners.iter().map(|at| [at.x, at.y]).collect();
            vec![number(place), Cell::from(serde_json::json!(corners).to_string().as_str())]
        });
        let Disc { radius, margin } = network.disc;
        let vehicle = vec![Cell::from(ROBOT), Cell::Real(radius), Cell::Real(margin)];
        let marks = told.marks().iter().enumerate().map(|(place, mark)| {
            vec![
                number(place),
                Cell::from(mark.what.as_str()),
                Cell::Real(mark.at.x),
                Cell::Real(mark.at.y),
                Cell::from(mark.property.as_str()),
                Cell::from(mark.value.as_str()),
            ]
        });
        vec![
            TableFile::of_map(&self.file, "walls", (&WALLS, 1), walls.collect()),
            TableFile::of_map(&self.file, "solids", (&SOLIDS, 1), solids.collect()),
            TableFile::of_map(&self.file, "vehicles", (&VEHICLES, 1), vec![vehicle]),
            TableFile::of_map(&self.file, "marks", (&MARKS, 1), marks.collect()),
        ]
    }

    fn places(&self) -> Vec<Place> {
        let place = |place: &world::Place| Place { place: place.name.clone(), x: place.at.x, y: place.at.y };
        self.floor.plan.places().iter().map(place).collect()
    }

    fn planner(&self) -> Option<Arc<dyn Planner>> {
        Some(Arc::new(RegionsAndAdits))
    }

    fn asks(&self) -> Vec<Class> {
        Kind::Navigation.classes()
    }

    fn declare(&self, schema: &mut Schema, told: &Facts) {
        let marks = told.get("MARKS");
        let texts = |name: &str| marks.and_then(|marks| marks.texts(name).ok()).unwrap_or_default();
        for (property, value) in texts("property").iter().zip(texts("value")) {
            let (Some(property), Some(value)) = (property, value) else { continue };
            if schema.kind("WAYS", property).is_none() {
                schema.add("WAYS", property, kind_of(value));
            }
        }
    }

    fn pathfinder(&self, asked: &Asked<'_>) -> Result<Box<dyn Pathfinder>> {
        let drawn = drawn(asked, &self.floor.plan.name)?;
        let places: BTreeMap<String, Point> =
            drawn.places.iter().map(|place| (place.name.clone(), place.at)).collect();
        let plan = FloorPlan::new(drawn).map_err(|errors| Error::all(errors.problems))?;
        let vehicles = asked.objects("VEHICLES");
        let marks = marks(asked)?;
        let doorways = asked.objects("DOORWAYS");
        let closed: Vec<usize> = doorways.rows().filter(|row| doorways.truth(*row, "closed")).collect();
        let vehicle = |row: usize| -> Result<Walker> {
            let disc = Disc {
                radius: vehicles.needed(row, "radius")?,
                margin: vehicles.number(row, "margin").unwrap_or(0.0),
            };
            let is_too_wide = |problem: &Problem| problem.code == MapCode::RobotTooWide;
            let (network, unfit) = match Network::new(&plan, disc) {
                Ok(network) => (network, None),
                Err(errors) if errors.problems.iter().all(is_too_wide) => {
                    let why = errors
                        .problems
                        .into_iter()
                        .map(|problem| problem.message)
                        .collect::<Vec<_>>()
                        .join("; ");
                    (Network::none(disc), Some(why))
                }
                Err(errors) => return Err(Error::all(errors.problems)),
            };
            let told = match unfit {
                None => Told::by(&marks, &closed, &network).map_err(no_map)?,
                Some(_) => Told::default(),
            };
            let judge = RuleJudge::by(asked, &told)?;
            let robot = vehicles.text(row, "robot").unwrap_or_default();
            let floor = Floor { plan: plan.clone(), network, settings: Settings::default(), told };
            Ok(Walker { robot, floor, unfit, judge: Mutex::new(judge) })
        };
        let walkers = vehicles.rows().map(vehicle).collect::<Result<Vec<_>>>()?;
        Ok(Box::new(Walkers { places, walkers }))
    }
}

/// The plan as its tables have it.
fn drawn(asked: &Asked<'_>, name: &str) -> Result<Drawn> {
    let (walls, solids, places) = (asked.objects("WALLS"), asked.objects("SOLIDS"), asked.objects("PLACES"));
    let wall = |row: usize| -> Result<[Point; 2]> {
        let at = |x, y| Ok::<_, Error>(Point::new(walls.needed(row, x)?, walls.needed(row, y)?));
        Ok([at("x0", "y0")?, at("x1", "y1")?])
    };
    let solid = |row: usize| -> Result<Vec<Point>> {
        let text = solids.text(row, "outline").unwrap_or_default();
        outline(&text).map_err(|_| solids.wrong(row, "outline", "corners as [[x,y],…]", Some(&text)))
    };
    let place = |row: usize| -> Result<world::Place> {
        let at = Point::new(places.needed(row, "x")?, places.needed(row, "y")?);
        Ok(world::Place { name: places.text(row, "place").unwrap_or_default(), at })
    };
    Ok(Drawn {
        name: name.to_owned(),
        walls: walls.rows().map(wall).collect::<Result<_>>()?,
        solids: solids.rows().map(solid).collect::<Result<_>>()?,
        places: places.rows().map(place).collect::<Result<_>>()?,
    })
}

fn marks(asked: &Asked<'_>) -> Result<Vec<Mark>> {
    let marks = asked.objects("MARKS");
    let mark = |row: usize| -> Result<Mark> {
        let what = marks.text(row, "what").unwrap_or_default();
        if !["doorway", "region"].contains(&what.as_str()) {
            return Err(marks.wrong(row, "what", "`doorway` or `region`", Some(&what)));
        }
        Ok(Mark {
            what,
            at: Point::new(marks.needed(row, "x")?, marks.needed(row, "y")?),
            property: marks.text(row, "property").unwrap_or_default(),
            value: marks.text(row, "value").unwrap_or_default(),
        })
    };
    marks.rows().map(mark).collect()
}

/// A robot on the plan.
struct Walker {
    robot: String,
    floor: Floor,
    /// Why it fits through no doorway.
    unfit: Option<String>,
    judge: Mutex<RuleJudge>,
}

/// Paths over a floor plan as it is.
struct Walkers {
    places: BTreeMap<String, Point>,
    walkers: Vec<Walker>,
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

    fn path(
        &self,
        robot: &str,
        ends: [&str; 2],
        shut: Option<&dyn Fn(&Way) -> bool>,
    ) -> std::result::Result<Walked<'_>, NoEnd> {
        let walker = self.walker(robot)?;
        let (start, goal) = (self.end(ends[0], true)?, self.end(ends[1], false)?);
        if let Some(unfit) = &walker.unfit {
            return Ok(Walked { walker, path: Err(unfit.clone()), said: BTreeMap::new() });
        }
        let mut judge = walker.judge.lock().unwrap_or_else(PoisonError::into_inner);
        let mut said = BTreeMap::new();
        // those that lead from the start and to the goal are of this path alone
        let mut of_ends: Vec<Way> = Vec::new();
        // through which doorways rules let nobody
        let mut refused: BTreeMap<usize, Way> = BTreeMap::new();
        let path = walker.floor.network.path(start, goal, Rule::Tight, |way| {
            if shut.is_some_and(|shut| shut(way)) {
                return None;
            }
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
                other => other.to_string(),
            }),
        };
        if let Ok(path) = &path {
            let adits = path.adits.iter().map(|adit| Spot::Adit(*adit));
            let spots: Vec<Spot> = [Spot::Start].into_iter().chain(adits).chain([Spot::Goal]).collect();
            for pair in spots.windows(2) {
                let ends = sorted(pair[0], pair[1]);
                let is_it = |way: &&Way| sorted(way.from, way.to) == ends;
                let way = of_ends.iter().chain(&walker.floor.network.ways).find(is_it);
                let rule = way.and_then(|way| judge.rule_of(way)).map(|rule| name_of(&Spoke::from(rule)));
                if let Some(of_way) = said.get_mut(&ends) {
                    of_way.rule = rule;
                }
            }
        }
        drop(judge);
        Ok(Walked { walker, path, said })
    }
}

/// Why nothing leads on: through which doorways rules let nobody, and by which rule.
fn because(refused: &BTreeMap<usize, Way>, judge: &mut RuleJudge) -> String {
    let said = refused.iter().map(|(doorway, way)| {
        let rule = judge.refused_by(way).map(|rule| format!(" (rule \"{}\")", rule.rule));
        format!("doorway {doorway}{}", rule.unwrap_or_default())
    });
    let said: Vec<String> = said.collect();
    format!("rules let nobody through {}, and no other way joins the start and the goal", said.join(", "))
}

/// A path that was looked for.
struct Walked<'w> {
    walker: &'w Walker,
    path: std::result::Result<Path, String>,
    /// What rules say of each way, by its ends.
    said: BTreeMap<(Spot, Spot), OfWay>,
}

/// What rules say of a way.
struct OfWay {
    weight: f64,
    /// Metres.
    length: f64,
    action: Option<Arc<str>>,
    rule: Option<String>,
}

fn sorted(one: Spot, other: Spot) -> (Spot, Spot) {
    if one <= other { (one, other) } else { (other, one) }
}

impl Pathfinder for Walkers {
    fn robots(&self) -> Vec<String> {
        self.walkers.iter().map(|walker| walker.robot.clone()).collect()
    }

    fn ends(&self) -> Vec<Place> {
        self.places.iter().map(|(place, at)| Place { place: place.clone(), x: at.x, y: at.y }).collect()
    }

    fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let walked = self.path(robot, [start, goal], None)?;
        Ok(found([robot, start, goal], &walked))
    }

    fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found> {
        let network = &self.walker(robot)?.floor.network;
        let doorways = network.regions.doorways.len();
        let doorway = numbered(through, "doorway").filter(|number| *number < doorways).ok_or_else(|| {
            no_through(through, &format!("`doorway 0` to `doorway {}`", doorways.saturating_sub(1)))
        })?;
        let walked = self.path(robot, ends, None)?;
        let is_through = walked.path.as_ref().is_ok_and(|path| path.doorways.contains(&doorway));
        if is_through {
            return Ok(found([robot, ends[0], ends[1]], &walked));
        }
        // to the doorway on the one side, and on from the other
        let mut best: Option<Found> = None;
        for adit in network.adits.iter().filter(|adit| adit.doorway == doorway) {
            let named = |at: Point| format!("{},{}", at.x, at.y);
            let (here, there) = (named(adit.at), named(network.adits[adit.twin].at));
            let is_this = |way: &Way| way.doorway == Some(doorway);
            let before = self.path(robot, [ends[0], &here], Some(&is_this))?;
            let across = self.path(robot, [&here, &there], None)?;
            if !across.path.as_ref().is_ok_and(|path| path.doorways == [doorway]) {
                continue;
            }
            let after = self.path(robot, [&there, ends[1]], Some(&is_this))?;
            let parts = [before, across, after].map(|walked| found([robot, ends[0], ends[1]], &walked));
            let joined = joined(parts, [robot, ends[0], ends[1]]);
            let is_better = match &best {
                None => true,
                Some(best) => {
                    joined.row.cost.is_some_and(|cost| best.row.cost.is_none_or(|least| cost < least))
                }
            };
            if is_better {
                best = Some(joined);
            }
        }
        Ok(best.unwrap_or_else(|| {
            let mut judge = self
                .walkers
                .iter()
                .find(|walker| walker.robot == robot)
                .map(|walker| walker.judge.lock().unwrap_or_else(PoisonError::into_inner));
            let way = network.ways.iter().find(|way| way.doorway == Some(doorway));
            let rule = way.and_then(|way| judge.as_mut()?.refused_by(way));
            let reason = match rule {
                Some(rule) => format!("the rule \"{}\" lets nobody through {through}", rule.rule),
                None if way.is_none() => format!("{robot} does not fit through {through}"),
                None => format!("no way leads to {through} and on from it"),
            };
            let reason = Some(reason);
            let row = Row { reason, ..Row::blank(robot, ends[0], ends[1]) };
            Found { row, said: Vec::new() }
        }))
    }

    fn picture(&self, title: &str, route: Option<[&str; 3]>) -> std::result::Result<String, NoEnd> {
        let Some([robot, start, goal]) = route else {
            let Some(Walker { floor, .. }) = self.walkers.first() else { return Ok(String::new()) };
            return Ok(render_floor(title, &floor.plan, &floor.network, None));
        };
        let walked = self.path(robot, [start, goal], None)?;
        let Floor { plan, network, .. } = &walked.walker.floor;
        Ok(render_floor(title, plan, network, walked.path.as_ref().ok()))
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
        format!(
            "{} regions, {} doorways, {} adits",
            regions.regions.len(),
            regions.doorways.len(),
            adits.len()
        )
    }
}

/// Parts of a way, one after the other.
fn joined(parts: [Found; 3], [robot, start, goal]: [&str; 3]) -> Found {
    let mut row = Row::blank(robot, start, goal);
    let (mut cost, mut distance) = (0.0, 0.0);
    for Found { row: part, .. } in parts {
        if let Some(reason) = part.reason {
            return Found {
                row: Row { reason: Some(reason), ..Row::blank(robot, start, goal) },
                said: Vec::new(),
            };
        }
        row.clearance = match (row.clearance, part.clearance) {
            (Some(one), Some(other)) => Some(one.min(other)),
            (one, other) => one.or(other),
        };
        for step in part.steps {
            let number = row.steps.len() as i64 + 1;
            row.steps.push(Step { step: number, cost: step.cost + cost, ..step });
        }
        for point in part.waypoints.into_iter().skip(usize::from(!row.waypoints.is_empty())) {
            let number = row.waypoints.len() as i64 + 1;
            let far = point.distance.map(|metres| metres + distance);
            row.waypoints.push(Waypoint {
                waypoint: number,
                cost: point.cost + cost,
                distance: far,
                ..point
            });
        }
        cost += part.cost.unwrap_or_default();
        distance += part.distance.unwrap_or_default();
    }
    (row.cost, row.distance) = (Some(cost), Some(distance));
    Found { row, said: Vec::new() }
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
    Found { row, said: Vec::new() }
}

/// A path as rows: a step for each region and each doorway that it passes, a waypoint where it bends. A step weighs its
/// metres, and what rules say of the way besides.
fn rows(
    network: &Network,
    barriers: &[[Point; 2]],
    path: &Path,
    said: &BTreeMap<(Spot, Spot), OfWay>,
) -> (Vec<Step>, Vec<Waypoint>) {
    let mut points = Vec::new();
    let mut distance = 0.0;
    for (place, at) in path.points.iter().enumerate() {
        let from = place.checked_sub(1).map(|before| path.points[before]);
        distance += from.map_or(0.0, |from| from.distance(*at));
        points.push(Waypoint {
            waypoint: place as i64 + 1,
            x: at.x,
            y: at.y,
            heading: from.and_then(|from| heading(from, *at)),
            clearance: from.map(|from| wall_distance(&[from, *at], barriers) - network.disc.radius),
            distance: Some(distance),
            cost: distance,
            ..Waypoint::default()
        });
    }
    let (mut steps, mut cost): (Vec<Step>, f64) = (Vec::new(), 0.0);
    let mut push =
        |kind: &str, place: String, (ends, metres): ((Spot, Spot), f64), [from, to]: [Point; 2]| {
            let of_way = said.get(&ends);
            // what is more than its metres is kept whole when a way is pulled tight, what is less goes with them
            let hardness = of_way.map_or(metres, |of_way| {
                let more = of_way.weight - of_way.length;
                if more >= 0.0 { metres + more } else { metres * of_way.weight / of_way.length }
            });
            cost += hardness;
            steps.push(Step {
                step: steps.len() as i64 + 1,
                kind: kind.to_owned(),
                place,
                action: of_way.and_then(|of_way| of_way.action.as_deref()).map(str::to_owned),
                hardness: Some(hardness),
                cost,
                x: Some(to.x),
                y: Some(to.y),
                heading: heading(from, to),
                rule: of_way.and_then(|of_way| of_way.rule.clone()),
                ..Step::default()
            });
        };
    // where the path crosses each doorway: how far along, and the point
    let mut rest = path.points.clone();
    let mut last = Spot::Start;
    let (mut so_far, mut along) = (0.0, Vec::new());
    for pair in path.adits.windows(2) {
        let (here, there) = (&network.adits[pair[0]], &network.adits[pair[1]]);
        if here.doorway != there.doorway || here.twin != pair[1] {
            continue;
        }
        let doorway = &network.regions.doorways[here.doorway];
        let (metres, at, after) = split(&rest, Segment::new(doorway.from, doorway.to));
        let [one, other] = [pair[0], pair[1]].map(Spot::Adit);
        so_far += metres;
        along.extend([so_far, so_far]);
        push("region", format!("region {}", here.region), (sorted(last, one), metres), at);
        push("doorway", format!("doorway {}", here.doorway), (sorted(one, other), 0.0), at);
        (rest, last) = (after, Spot::Adit(pair[1]));
    }
    let to = *rest.last().unwrap_or(&rest[0]);
    let from = rest.iter().rev().nth(1).copied().unwrap_or(to);
    let metres: f64 = rest.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let region =
        network.region_of(to).map_or("the goal's region".to_owned(), |region| format!("region {region}"));
    along.push(so_far + metres);
    push("region", region, (sorted(last, Spot::Goal), metres), [from, to]);
    weigh_points(&mut points, &steps, &along);
    (steps, points)
}

/// What a way costs up to each point: evenly along each step, which ends so many metres `along` it.
fn weigh_points(points: &mut [Waypoint], steps: &[Step], along: &[f64]) {
    for point in points {
        let at = point.distance.unwrap_or_default();
        let step = along.iter().position(|end| at <= *end + 1e-9).unwrap_or(steps.len().saturating_sub(1));
        let (begin, before) = match step.checked_sub(1) {
            Some(before) => (along[before], steps[before].cost),
            None => (0.0, 0.0),
        };
        let (end, cost) = (along[step], steps[step].cost);
        let share = if end > begin { ((at - begin) / (end - begin)).clamp(0.0, 1.0) } else { 1.0 };
        point.cost = before + share * (cost - before);
    }
}

/// A polyline up to where it first crosses a segment: the metres, the corner before that point with it, and the rest from
/// there.
fn split(points: &[Point], across: Segment) -> (f64, [Point; 2], Vec<Point>) {
    let mut metres = 0.0;
    for (place, pair) in points.windows(2).enumerate() {
        let leg = Segment::new(pair[0], pair[1]);
        if let Some(at) = leg.crossing(&across) {
            let rest = [&[at], &points[place + 1..]].concat();
            return (metres + pair[0].distance(at), [pair[0], at], rest);
        }
        metres += leg.length();
    }
    let last = *points.last().unwrap_or(&points[0]);
    (metres, [last, last], vec![last])
}

fn heading(from: Point, to: Point) -> Option<f64> {
    (from.distance(to) > 0.0).then(|| (to.y - from.y).atan2(to.x - from.x).to_degrees())
}
