//! Why nothing is sent to a vehicle.

use super::words;
use crate::site::Fleet;
use crate::wire::{Factsheet, Report};

/// In words; `None` where it may drive on.
pub fn why(
    report: &Report,
    factsheet: Option<&Factsheet>,
    (robot, map): (&str, &str),
    fleet: &Fleet,
) -> Option<String> {
    if let Some(at) = &report.position {
        if !at.localized {
            return Some("it does not know where it is".to_owned());
        }
        if !at.map_id.is_empty() && at.map_id != map {
            return Some(format!("it is on map `{}`, and the site's is called `{map}`", at.map_id));
        }
    }
    if !matches!(report.operating_mode.as_str(), "AUTOMATIC" | "SEMIAUTOMATIC" | "") {
        return Some(format!("its operating mode is {}", report.operating_mode));
    }
    // what a bumper or a protective field set off (AUTOACK) ends by itself
    if !matches!(report.safety.emergency_stop.as_str(), "NONE" | "AUTOACK" | "") {
        return Some(format!("it is stopped by its emergency stop ({})", report.safety.emergency_stop));
    }
    if report.paused {
        return Some("it is paused".to_owned());
    }
    let stopping =
        report.errors.iter().find(|error| fleet.meaning(&error.error_type, &error.error_level).stops);
    if let Some(error) = stopping {
        return Some(words::error(error));
    }
    too_large(factsheet?, robot, fleet)
}

/// What the maker says of its body does not fit the robot whose routes it drives.
fn too_large(factsheet: &Factsheet, robot: &str, fleet: &Fleet) -> Option<String> {
    let body = factsheet.body?;
    let states = fleet.states.get(robot)?;
    let largest = |of: fn(&crate::site::State) -> f64| states.iter().map(of).fold(0.0, f64::max);
    let (width, height) = (largest(|state| state.width), largest(|state| state.height));
    let bound = |what: &str, is: f64, most: f64| {
        format!("by its factsheet it is {is} m {what}, robot {robot} at most {most} m")
    };
    // a tenth of a millimetre is how makers round
    if body.width > width + 1e-4 {
        Some(bound("wide", body.width, width))
    } else if body.height > height + 1e-4 {
        Some(bound("high", body.height, height))
    } else {
        None
    }
}
