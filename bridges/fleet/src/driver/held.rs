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

/// Metres beyond the map's edge at which a vehicle may take itself to be.
const STRAY: f64 = 0.5;

/// That it says to be off the map, in words; `None` where it means another map, or does not know where it is.
pub fn off_the_map(report: &Report, map: &str, bounds: Option<[f64; 4]>) -> Option<String> {
    let (at, [x0, y0, x1, y1]) = (report.position.as_ref()?, bounds?);
    let is_of_map = at.localized && (at.map_id.is_empty() || at.map_id == map);
    let is_off = at.x < x0 - STRAY || at.x > x1 + STRAY || at.y < y0 - STRAY || at.y > y1 + STRAY;
    (is_of_map && is_off).then(|| {
        let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(|metres| (metres * 100.0).round() / 100.0);
        format!("it says that it is off the map, which goes from {x0},{y0} to {x1},{y1}")
    })
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
