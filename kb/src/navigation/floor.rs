//! A floor plan with its robot, as a world of `adit plan` and `adit simulate`.

use std::sync::Arc;

use adit_engine::RuleBase;
use adit_planners::floor_plan::{Disc, FloorPlan, Network, NoPath, Path as Walk, Rule};
use adit_planners::geometry::Point;
use adit_planners::navigation::{Building, Judge, Settings, WayFacts};
use serde_json::{Value, json};

use super::judge::RuleJudge;
use super::told::Told;
use crate::error::{Code, Error, Result};
use crate::words::number::number;
use crate::words::suggest::did_you_mean;

/// A floor plan, the network of places for a robot, and what the robot goes by.
#[derive(Debug)]
pub struct Floor {
    pub plan: FloorPlan,
    pub network: Network,
    /// Tolerances and other figures.
    pub settings: Settings,
    /// What the world says of doorways and regions.
    pub told: Told,
}

impl Floor {
    pub fn names(&self) -> Vec<&str> {
        self.plan.places().iter().map(|place| place.name.as_str()).collect()
    }

    pub fn judge(&self, rules: &Arc<RuleBase>) -> Result<RuleJudge> {
        RuleJudge::with(rules, &self.told).map_err(Error::of(Code::PlanRules))
    }

    /// The building as a robot drives in it: its ways leave room beside the robot, where there is a way with room.
    pub fn building(&self) -> Building {
        let disc =
            Disc { margin: self.network.disc.margin.max(self.settings.detour_room_m), ..self.network.disc };
        let with_room = Network::new(&self.plan, disc).unwrap_or_else(|_| self.network.clone());
        Building::new(&self.plan, with_room)
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
                    Code::PlanUnknownPlace,
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
            Some(trouble) => Err(Error::said(Code::PlanRules, trouble.to_owned(), None)),
            None => Ok(walked),
        }
    }
}

/// A path on a floor plan, and how long the untightened ones are.
#[derive(Clone, Debug)]
pub struct Walked {
    pub tight: std::result::Result<Walk, NoPath>,
    /// Over all adits, untightened: metres.
    pub all_adits: Option<f64>,
    /// By the paper's rule of the nearest adit: metres.
    pub nearest_adit: Option<f64>,
}

impl Walked {
    pub const fn is_path(&self) -> bool {
        self.tight.is_ok()
    }

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
