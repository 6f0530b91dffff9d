//! What vehicles report, told to the site. In a circle with the vehicle's file, of which it is a part.

use std::collections::BTreeSet;

use serde::Serialize;
use serde_json::Value;

use super::{About, Driver, Effect, Now, World, held, words};
use crate::wire::Link;

/// What blocks a vehicle is so far ahead on its way where nobody knows how large it is, metres.
const REACH: f64 = 0.5;

/// Where a vehicle is, for people who look on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Whereabout {
    name: String,
    x: f64,
    y: f64,
    /// Degrees.
    heading: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    doing: Option<String>,
}

/// Characters of what it does that people read at a glance; the service takes no more.
const GLANCE: usize = 200;

impl Driver {
    /// Where it is; `None` where it does not know, is on another map, or was not heard.
    pub fn whereabout(&self, world: &World<'_>) -> Option<Whereabout> {
        let report = self.report.as_ref().filter(|_| self.link.is_none_or(|link| link == Link::Online))?;
        let at =
            report.position.as_ref().filter(|at| at.localized && at.x.is_finite() && at.y.is_finite())?;
        let map = self.map(world);
        if !(at.map_id.is_empty() || at.map_id == map)
            || held::off_the_map(report, &map, world.bounds).is_some()
        {
            return None;
        }
        let doing: String = self.doing.chars().filter(|letter| !letter.is_control()).take(GLANCE).collect();
        Some(Whereabout {
            name: self.row.name.clone(),
            x: at.x,
            y: at.y,
            heading: at.theta.to_degrees().rem_euclid(360.0),
            robot: self.row.robot.clone(),
            doing: Some(doing).filter(|doing| !doing.trim().is_empty()),
        })
    }

    /// What errors mean is done once each time that they come.
    pub(super) fn act_on_errors(&mut self, now: &Now<'_, '_>, effects: &mut Vec<Effect>) {
        let Now { report, world, .. } = now;
        let present: BTreeSet<String> = report.errors.iter().map(|error| error.error_type.clone()).collect();
        self.acted.retain(|known| present.contains(known));
        for error in &report.errors {
            let meaning = world.fleet.meaning(&error.error_type, &error.error_level);
            let (Some(seconds), Some(at)) = (meaning.closes_for, report.position.as_ref()) else {
                if self.acted.insert(error.error_type.clone()) {
                    effects.push(Effect::Say(format!("{} reports {}", self.row.name, words::error(error))));
                }
                continue;
            };
            // who drives on is not blocked
            if report.driving || !self.acted.insert(error.error_type.clone()) {
                continue;
            }
            let reach = world.fleet.breadth(&self.robot(world)).unwrap_or(REACH);
            let ahead = self.given.as_ref();
            let ahead = ahead.and_then(|sent| sent.order.heading(sent.reached, [at.x, at.y], reach));
            let only = (!meaning.for_all).then(|| self.row.robot.clone()).flatten();
            effects.push(Effect::Block {
                at: [at.x, at.y],
                heading: ahead.unwrap_or(at.theta).to_degrees().rem_euclid(360.0),
                seconds,
                only,
                why: format!("{} reports {}", self.row.name, words::error(error)),
            });
        }
    }

    /// Writes into the table what it has columns for, where it is another value than before.
    pub(super) fn tell(&mut self, doing: String, effects: &mut Vec<Effect>) {
        self.doing.clone_from(&doing);
        let mut values = vec![("doing", Value::from(doing))];
        if let Some(link) = self.link {
            values.push(("connection", Value::from(link.word())));
        }
        if let Some(report) = &self.report {
            values.push(("localized", Value::from(report.position.as_ref().is_some_and(|at| at.localized))));
            let charge = report.battery.map(|battery| battery.charge);
            if let Some(charge) = charge.filter(|charge| (0.0..=100.0).contains(charge)) {
                values.push(("battery", Value::from(charge.round())));
            } else if let Some(charge) = charge
                && self.said.insert(About::Battery)
            {
                // once: it may say so by turns
                let name = &self.row.name;
                let words =
                    format!("{name} says that its battery is at {charge} per cent, which is not believed");
                effects.push(Effect::Say(words));
            }
            let errors: BTreeSet<&str> =
                report.errors.iter().map(|error| error.error_type.as_str()).collect();
            values.push(("errors", Value::from(errors.into_iter().collect::<Vec<_>>().join(", "))));
            let here = self.given.as_ref().filter(|sent| sent.order.id == report.order_id);
            if let Some(sent) = here {
                let stop = &sent.order.stops[sent.reached];
                values.push(("space", Value::from(stop.space.clone())));
            }
        }
        for (column, value) in values {
            if self.cells.takes(column, &value) {
                effects.push(Effect::Write { column, value });
            }
        }
    }
}
