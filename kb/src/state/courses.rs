//! Routes over a map that is not cut into rooms, as they are at one moment.

use std::collections::{BTreeMap, BTreeSet};

use adit_db::course::Course as Row;
use adit_db::place::Place;
use adit_planners::geometry::Point;

use super::State;
use crate::error::{Code, Error, Result};
use crate::graph::pairs::PlaceCosts;
use crate::plan::course::{Asked, Found, NoEnd, Pathfinder};
use crate::plan::figures;
use crate::plan::legs::Legs;
use crate::site::Starts;
use crate::site::driving::Driving;
use crate::words::suggest::did_you_mean;

/// The routes that are kept, between all ends of the map, and who finds others.
pub struct Courses {
    finder: Box<dyn Pathfinder>,
    legs: Legs,
    kept: Vec<Found>,
    starts: usize,
}

/// A kept route that is another one than before.
pub struct Changed {
    pub robot: String,
    pub start: String,
    pub goal: String,
    /// What it cost; `None`: there was none.
    pub old: Option<f64>,
    /// What it costs; `None`: there is none.
    pub new: Option<f64>,
    /// Whether it leads through other places.
    pub other_way: bool,
}

impl Changed {
    /// Whether there was one before, there is one now, and it leads another way.
    pub const fn is_rerouted(&self) -> bool {
        self.other_way && self.old.is_some() && self.new.is_some()
    }
}

impl State {
    /// The rules, to be asked about one object at a time, with all that is known now.
    pub fn asked(&self) -> Asked<'_> {
        Asked { rules: &self.inputs.rules, known: &self.knowledge }
    }

    /// The routes over the map as the inference has it now; `None` where it is cut into rooms, or there is none.
    pub(super) fn courses_now(&self) -> Result<Option<Courses>> {
        let Some(course) = self.site.course() else {
            // nobody reads them before a robot drives: what they may not be is said when they are edited
            figures::driving(&self.asked(), Driving::of_rooms())?;
            return Ok(None);
        };
        let finder = course.pathfinder(&self.asked())?;
        let legs = Legs::new(&self.asked())?;
        let ends: Vec<String> = finder.ends().into_iter().map(|end| end.place).collect();
        let starts = match &self.site.site().starts {
            Some(Starts::Named(names)) => known(names, &ends)?,
            Some(Starts::All) | None => ends.iter().map(String::as_str).collect(),
        };
        let mut kept = Vec::new();
        for robot in finder.robots() {
            for start in &starts {
                for goal in ends.iter().filter(|goal| goal != start) {
                    let mut found = finder.find(&robot, start, goal).map_err(no_end)?;
                    legs.measure(&mut found.row);
                    kept.push(found);
                }
            }
        }
        if let Some(trouble) = finder.trouble().or_else(|| legs.trouble()) {
            return Err(Error::said(Code::PlanRules, trouble, None));
        }
        let starts = starts.len();
        Ok(Some(Courses { finder, legs, kept, starts }))
    }
}

/// The names that `starts` in `site.toml` has, as far as they are ends.
fn known<'n>(names: &'n [String], ends: &[String]) -> Result<Vec<&'n str>> {
    match names.iter().find(|name| !ends.contains(name)) {
        None => Ok(names.iter().map(String::as_str).collect()),
        Some(unknown) => {
            let help = did_you_mean(unknown, ends.iter().map(String::as_str));
            let message = format!("`starts` names `{unknown}`, which is no place");
            Err(Error::said(Code::SiteUnknownStart, message, help))
        }
    }
}

fn no_end(end: NoEnd) -> Error {
    Error::said(Code::CourseTable, end.reason, None)
}

impl Courses {
    pub fn robots(&self) -> Vec<String> {
        self.finder.robots()
    }

    /// How many ends routes are kept from.
    pub const fn starts(&self) -> usize {
        self.starts
    }

    /// What there is of what, in words.
    pub fn summary(&self) -> String {
        self.finder.summary()
    }

    /// The junctions of which something is told by their number, and which have other numbers than before, in sentences.
    pub fn renumbered(&self, before: &Self) -> Vec<String> {
        let (was, is) = (before.finder.told_by_number(), self.finder.told_by_number());
        let others = was.iter().filter_map(|(number, was)| Some((number, was, is.get(number)?)));
        let others = others.filter(|(_, was, is)| was != is);
        let sentence = |(number, was, is)| {
            format!(
                "junctions are numbered otherwise: the gap of junction {number} was that of {was}, and is that of {is} now"
            )
        };
        others.map(sentence).collect()
    }

    /// What of the map counts for nothing, in sentences.
    pub fn notes(&self) -> Vec<String> {
        self.finder.notes()
    }

    /// Between what routes lead.
    pub fn ends(&self) -> Vec<Place> {
        self.finder.ends()
    }

    /// What lies outermost on the map.
    pub fn outermost(&self) -> Vec<Point> {
        self.finder.outermost()
    }

    /// The kept routes that are others than before, with those that are no more; where there was none before nor is now,
    /// nothing is other.
    pub fn changed(&self, before: &Self) -> Vec<Changed> {
        let key = |row: &Row| (row.robot.clone(), row.start.clone(), row.goal.clone());
        let rows = |courses: &Self| -> BTreeMap<_, Row> {
            courses.kept.iter().map(|found| (key(&found.row), found.row.clone())).collect()
        };
        let (old, new) = (rows(before), rows(self));
        let way = |row: &Row| row.steps.iter().map(|step| step.place.clone()).collect::<Vec<_>>();
        let keys: BTreeSet<_> = old.keys().chain(new.keys()).cloned().collect();
        let changed = keys.into_iter().filter_map(|key| {
            let (was, is) = (old.get(&key), new.get(&key));
            let costs = (was.and_then(|row| row.cost), is.and_then(|row| row.cost));
            if was == is || costs == (None, None) {
                return None;
            }
            let (robot, start, goal) = key;
            Some(Changed {
                robot,
                start,
                goal,
                old: costs.0,
                new: costs.1,
                other_way: was.map(way) != is.map(way),
            })
        });
        changed.collect()
    }

    pub fn kept(&self) -> &[Found] {
        &self.kept
    }

    /// The kept routes as rows.
    pub fn rows(&self) -> Vec<Row> {
        self.kept.iter().map(|found| found.row.clone()).collect()
    }

    /// What the kept routes cost; those that there are.
    pub fn place_costs(&self) -> PlaceCosts {
        let rows = self.kept.iter().map(|found| &found.row);
        rows.filter_map(|row| Some(((row.robot.clone(), row.start.clone(), row.goal.clone()), row.cost?)))
            .collect()
    }

    /// A route, one of the kept ones where it is.
    pub fn find(&self, robot: &str, start: &str, goal: &str) -> std::result::Result<Found, NoEnd> {
        let is_it = |Found { row, .. }: &&Found| row.robot == robot && row.start == start && row.goal == goal;
        let kept = self.kept.iter().find(is_it);
        match kept {
            Some(found) => Ok(found.clone()),
            None => Ok(self.measured(self.finder.find(robot, start, goal)?)),
        }
    }

    /// The map as a picture, with a route.
    pub fn picture(&self, title: &str, route: Option<[&str; 3]>) -> Result<String> {
        Ok(self.finder.picture(title, route)?)
    }

    /// The best route through something.
    pub fn find_through(&self, robot: &str, ends: [&str; 2], through: &str) -> Result<Found> {
        Ok(self.measured(self.finder.find_through(robot, ends, through)?))
    }

    fn measured(&self, mut found: Found) -> Found {
        self.legs.measure(&mut found.row);
        found
    }
}
