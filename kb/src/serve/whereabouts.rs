//! Where robots are, as they said last, and what they were told. Nothing of it is kept in the site: it is true for a moment.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde::Serialize;
use utoipa::ToSchema;

use adit_planners::geometry::Point;

use super::fault::{Answered, Fault};
use super::follower::Following;
use crate::live::View;

/// Robots that are known at once.
const MOST: usize = 10_000;

/// Who was not heard for so long is not known any more, unless it follows a route.
const FORGOTTEN: Duration = Duration::from_mins(10);

/// Where a robot said that it is.
#[derive(Clone, Debug)]
pub struct Report {
    pub robot: Option<String>,
    pub at: Point,
    /// Degrees, counterclockwise from the x axis.
    pub heading: Option<f64>,
    pub state: Option<String>,
    pub doing: Option<String>,
    /// Who said so.
    pub who: String,
    pub heard: Instant,
}

/// Who is where, by what people call it.
#[derive(Default)]
pub struct Whereabouts(Mutex<BTreeMap<String, Report>>);

/// A robot: where it is, and which way it follows.
#[derive(Debug, Serialize, ToSchema)]
pub struct Whereabout {
    /// What people call it; null of who follows a route without a name.
    name: Option<String>,
    /// Whose routes it drives.
    robot: Option<String>,
    x: f64,
    y: f64,
    /// Degrees, counterclockwise from the x axis.
    heading: Option<f64>,
    /// The state in which it says to be.
    state: Option<String>,
    /// What it does, in words of its own.
    doing: Option<String>,
    /// The space in which that is.
    space: Option<String>,
    /// Who said where it is; null where it only asked for a way from there.
    who: Option<String>,
    /// Seconds since it said where it is, or asked for its way.
    seconds: f64,
    way: Option<Way>,
}

/// The way that a robot follows.
#[derive(Debug, Serialize, ToSchema)]
struct Way {
    goal: String,
    /// Total hardness; null where there is no way.
    cost: Option<f64>,
    /// Why there is no way.
    reason: Option<String>,
    /// Where the way bends, metres.
    points: Vec<[f64; 2]>,
    /// What it was told, the newest last.
    told: Vec<Word>,
}

/// What a robot was told.
#[derive(Debug, Serialize, ToSchema)]
struct Word {
    /// How long ago.
    seconds: f64,
    words: String,
}

impl Whereabouts {
    fn all(&self) -> MutexGuard<'_, BTreeMap<String, Report>> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|_, report| report.heard.elapsed() < FORGOTTEN);
        all
    }

    /// Takes up where robots are; all of them, or none.
    pub fn hear(&self, reports: Vec<(String, Report)>) -> Answered<()> {
        let mut all = self.all();
        let new = reports.iter().filter(|(name, _)| !all.contains_key(name)).count();
        if all.len() + new > MOST {
            return Err(Fault::share());
        }
        all.extend(reports);
        Ok(())
    }

    /// A robot is nowhere any more; whether it was known.
    pub fn forget(&self, name: &str) -> bool {
        self.all().remove(name).is_some()
    }

    /// All robots by name, each with its way; then those that follow one without a name.
    pub fn listed(&self, following: Vec<Following>, view: &View) -> Vec<Whereabout> {
        let mut named: BTreeMap<String, Following> = BTreeMap::new();
        let mut nameless = Vec::new();
        for one in following {
            match one.name.clone() {
                // of several streams of one robot the one that said last from where
                Some(name) => match named.get(&name) {
                    Some(other) if other.moved > one.moved => {}
                    _ => drop(named.insert(name, one)),
                },
                None => nameless.push(one),
            }
        }
        let mut listed: Vec<Whereabout> = Vec::new();
        for (name, report) in self.all().iter() {
            let way = named.remove(name);
            let robot = report.robot.clone().or_else(|| Some(way.as_ref()?.answer.robot.clone()));
            listed.push(Whereabout {
                name: Some(name.clone()),
                robot,
                x: report.at.x,
                y: report.at.y,
                heading: report.heading,
                state: report.state.clone(),
                doing: report.doing.clone(),
                space: None,
                who: Some(report.who.clone()),
                seconds: report.heard.elapsed().as_secs_f64(),
                way: way.as_ref().map(Way::of),
            });
        }
        nameless.sort_by_key(|one| one.since);
        listed.extend(named.into_values().chain(nameless).filter_map(|one| asked(&one)));
        listed
            .sort_by(|one, other| (one.name.is_none(), &one.name).cmp(&(other.name.is_none(), &other.name)));
        let points: Vec<Point> = listed.iter().map(|robot| Point::new(robot.x, robot.y)).collect();
        let building = &view.graph().building;
        for (robot, space) in listed.iter_mut().zip(building.spaces_at(&points)) {
            robot.space = space.and_then(|space| building.space(space.space));
        }
        listed
    }
}

/// Of whom no more is known than from where it asked for a way. `None` where that is no point.
fn asked(following: &Following) -> Option<Whereabout> {
    let at = following.at?;
    Some(Whereabout {
        name: following.name.clone(),
        robot: Some(following.answer.robot.clone()),
        x: at.x,
        y: at.y,
        heading: None,
        state: None,
        doing: None,
        space: None,
        who: None,
        seconds: following.moved.elapsed().as_secs_f64(),
        way: Some(Way::of(following)),
    })
}

impl Way {
    fn of(following: &Following) -> Self {
        let answer = &following.answer;
        let told = following
            .told
            .iter()
            .map(|(when, words)| Word { seconds: when.elapsed().as_secs_f64(), words: words.clone() });
        Self {
            goal: answer.goal.clone(),
            cost: answer.cost,
            reason: answer.reason.clone(),
            points: answer.waypoints.iter().map(|point| [point.x, point.y]).collect(),
            told: told.collect(),
        }
    }
}
