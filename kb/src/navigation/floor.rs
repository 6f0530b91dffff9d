//! A floor plan with its robot, as a world of `adit plan` and `adit simulate`.

use std::path::Path;

use adit_planners::floor_plan::{Disc, FloorPlan, Network, NoPath, Path as Walk, Rule, read_floor_plan};
use adit_planners::geometry::Point;
use adit_planners::navigation::{Judge, Settings, WayFacts};
use adit_planners::read::{Fields, Problem};
use serde_json::{Value, json};

use super::judge::RuleJudge;
use crate::error::{Error, Result};
use crate::number::number;
use crate::suggest::did_you_mean;

/// A floor plan, the network of places for a robot, and what the robot goes by.
#[derive(Debug)]
pub struct Floor {
    /// The plan.
    pub plan: FloorPlan,
    /// Regions, adits and ways.
    pub network: Network,
    /// Tolerances and other figures.
    pub settings: Settings,
}

const KEYS: [&str; 3] = ["file", "robot", "navigation"];
/// What a user may set of the navigator: key, unit, and what it is.
const FIGURES: [&str; 9] = [
    "goal_tolerance",
    "turning_resolution",
    "highway_half_width",
    "look_ahead",
    "speed",
    "detour_clearance",
    "most_waits",
    "most_detours",
    "most_retries",
];

/// Reads `[floor_plan]`; the plan's file lies beside the world's.
pub fn read(fields: &Fields<'_, '_>, folder: &Path, problems: &mut Vec<Problem>) -> Result<Option<Floor>> {
    fields.refuse_unknown(&KEYS, problems);
    let file = fields.string("file", problems);
    let disc =
        fields.table("robot", "robot", problems).map_or(Some(Disc { radius: 0.25, margin: 0.0 }), |robot| {
            robot.refuse_unknown(&["radius", "margin"], problems);
            let radius = robot.positive("radius", problems);
            let margin = match robot.get("margin") {
                None => Some(0.0),
                Some(_) => robot.number("margin", problems).map(|margin| margin.value),
            };
            Some(Disc { radius: radius?.value, margin: margin? })
        });
    let settings = settings(fields, problems);
    let (Some(file), Some(disc)) = (file, disc) else { return Ok(None) };
    if !problems.is_empty() {
        return Ok(None);
    }
    let plan = read_floor_plan(&folder.join(&file.value)).map_err(|error| Error::all(error.problems))?;
    let network = Network::new(&plan, disc).map_err(|error| Error::all(error.problems))?;
    Ok(Some(Floor { plan, network, settings }))
}

fn settings(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Settings {
    let mut settings = Settings::default();
    let Some(table) = fields.table("navigation", "[floor_plan.navigation]", problems) else {
        return settings;
    };
    table.refuse_unknown(&FIGURES, problems);
    let mut figure =
        |key| table.get(key).and_then(|_| table.positive(key, problems)).map(|found| found.value);
    let count = |found: f64| found.min(f64::from(u32::MAX)) as u32;
    if let Some(metres) = figure("goal_tolerance") {
        settings.goal_tolerance_m = metres;
    }
    if let Some(degrees) = figure("turning_resolution") {
        settings.turning_resolution = degrees.to_radians();
    }
    if let Some(metres) = figure("highway_half_width") {
        settings.highway_half_width_m = metres;
    }
    if let Some(metres) = figure("look_ahead") {
        settings.look_ahead_m = metres;
    }
    if let Some(speed) = figure("speed") {
        settings.speed_m_s = speed;
    }
    if let Some(metres) = figure("detour_clearance") {
        settings.detour_clearance_m = metres;
    }
    settings.most_waits = figure("most_waits").map_or(settings.most_waits, count);
    settings.most_detours = figure("most_detours").map_or(settings.most_detours, count);
    settings.most_retries = figure("most_retries").map_or(settings.most_retries, count);
    settings
}

impl Floor {
    /// The names of its places.
    pub fn names(&self) -> Vec<&str> {
        self.plan.places().iter().map(|place| place.name.as_str()).collect()
    }

    /// A place by its name, or a point `x,y`.
    pub fn point(&self, text: &str) -> Result<Point> {
        if let Some(place) = self.plan.places().iter().find(|place| place.name == text) {
            return Ok(place.at);
        }
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some([x, y]) if x.is_finite() && y.is_finite() => Ok(Point::new(*x, *y)),
            _ => {
                let message = format!("`{text}` is no place of the plan, and no point `x,y`");
                let names = self.names();
                let help = did_you_mean(text, names.iter().copied());
                Err(Error::said(
                    "plan/unknown-place",
                    message,
                    help.or_else(|| Some(format!("places: {}", names.join(", ")))),
                ))
            }
        }
    }

    /// The path from a point to another: searched over all adits by what rules say that ways weigh, and pulled tight.
    pub fn plan(&self, start: Point, goal: Point, judge: &mut RuleJudge) -> Result<Walked> {
        let mut path = |rule| {
            self.network.path(start, goal, rule, |way| {
                judge.weigh(&WayFacts { way, is_cut: false, times_blocked: 0 })
            })
        };
        let walked = Walked {
            tight: path(Rule::Tight),
            all_adits: path(Rule::AllAdits).ok().map(|path| path.length),
            nearest_adit: path(Rule::Nearest).ok().map(|path| path.length),
        };
        match judge.trouble() {
            Some(trouble) => Err(Error::said("plan/rules", trouble.to_owned(), None)),
            None => Ok(walked),
        }
    }
}

/// A path on a floor plan, and how long the untightened ones are.
#[derive(Clone, Debug)]
pub struct Walked {
    /// The path that is driven.
    pub tight: std::result::Result<Walk, NoPath>,
    /// Over all adits, untightened: metres.
    pub all_adits: Option<f64>,
    /// By the paper's rule of the nearest adit: metres.
    pub nearest_adit: Option<f64>,
}

impl Walked {
    /// Whether there is a path.
    pub const fn is_path(&self) -> bool {
        self.tight.is_ok()
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        match &self.tight {
            Err(reason) => json!({"status": "no_path", "reason": reason.to_string()}),
            Ok(path) => json!({
                "status": "ok",
                "waypoints": path.points.iter().map(|at| [at.x, at.y]).collect::<Vec<_>>(),
                "length": path.length,
                "weight": path.weight,
                "adits": path.adits,
                "doorways": path.doorways,
                "length_over_all_adits": self.all_adits,
                "length_by_nearest_adit": self.nearest_adit,
            }),
        }
    }

    /// For people.
    pub fn lines(&self) -> Vec<String> {
        match &self.tight {
            Err(reason) => vec![format!("no path: {reason}")],
            Ok(path) => {
                let mut lines: Vec<String> =
                    path.points.iter().map(|at| format!("  ({}, {})", number(at.x), number(at.y))).collect();
                let untightened = |length: Option<f64>| length.map_or_else(|| "none".to_owned(), number);
                lines.push(format!(
                    "length {}; over all adits {}, by the nearest adit {}",
                    number(path.length),
                    untightened(self.all_adits),
                    untightened(self.nearest_adit)
                ));
                lines
            }
        }
    }
}
