//! Why a route does what it does, in the building's words.

use std::fmt::Write;

use super::{Holds, Stretch, WhyWay};
use crate::why::hindered::sentence;
use crate::why::meant::Meant;
use crate::why::said::{capital, cell, listed, roughly};
use crate::words::number::number;

/// A paragraph a stretch; one sentence where nothing is done but what is easiest.
///
/// # Arguments
/// `is_passed`: whether the route leads through, or by, what was asked about.
pub fn sentences(answer: &WhyWay, at: Option<&Meant>, is_passed: bool) -> Vec<String> {
    if !answer.stretches.is_empty() {
        return answer.stretches.iter().map(|stretch| paragraph(stretch, &answer.robot)).collect();
    }
    if let (Some(at), false) = (at, is_passed) {
        return vec![format!(
            "The route from {} to {} does not lead {}.",
            answer.start,
            answer.goal,
            at.words()
        )];
    }
    if answer.start == answer.goal {
        return vec![format!("The route starts at {}, which is its goal: nothing is driven.", answer.start)];
    }
    let place = at.map_or_else(|| "all along".to_owned(), Meant::words);
    let easiest = answer.easiest.as_ref().map_or_else(
        || "nothing is easier there".to_owned(),
        |easiest| format!("what the robot does {place} is the easiest there is: {}", easiest.to_lowercase()),
    );
    vec![format!("From {} to {}, {easiest}.", answer.start, answer.goal)]
}

fn paragraph(stretch: &Stretch, robot: &str) -> String {
    let action = stretch.action.to_lowercase();
    let name = stretch.state.clone().unwrap_or_else(|| stretch.action.clone());
    let place =
        if stretch.spaces.is_empty() { String::new() } else { format!(" in {}", listed(&stretch.spaces)) };
    let [[x0, y0], [x1, y1]] = [stretch.from, stretch.to];
    let stretch_words = format!("{action}{place}, from ({x0:.1}, {y0:.1}) to ({x1:.1}, {y1:.1})");
    let mut said = capital(&stretch_words);
    let why = sentence(&stretch.hindered);
    if !why.is_empty() {
        said.push_str(": ");
        said.push_str(&why);
    } else if !stretch.failed.is_empty() {
        said.push_str(": ");
        said.push_str(&stretch.failed.join("; "));
    }
    said.push('.');
    // in the paper's modes rules choose what is done at a door, so that without it there is another door, not another state
    let name = if stretch.state.is_some() { name } else { format!("a door at which that is done ({name})") };
    match &stretch.without {
        Some(other) if other.more > 0.0 => {
            let by = if other.by.is_empty() { String::new() } else { format!(", by {}", listed(&other.by)) };
            let (cost, more) = (number(other.cost), number(other.more));
            write!(said, " Without {name} the best way costs {cost}, {more} more{by}.").ok();
        }
        Some(other) => {
            write!(said, " Without {name} the best way costs as much, {}.", number(other.cost)).ok();
        }
        None => {
            write!(said, " Without {name} no way leads there.").ok();
        }
    }
    if let Some(holds) = &stretch.holds {
        write!(said, " {name} stays on the best way while {}.", within(holds, robot)).ok();
    }
    said
}

/// `the hardness of SQUAT (robots) is at most 5.6 (it is 4)`.
fn within(holds: &Holds, robot: &str) -> String {
    let cell = cell(&holds.table, &holds.key, &holds.column, robot);
    let about = if holds.exact { "" } else { "about " };
    let (floor, ceil) = (|value: f64| roughly(value, f64::floor), |value: f64| roughly(value, f64::ceil));
    let is = number(holds.value);
    match (holds.low, holds.high) {
        (Some(low), Some(high)) => {
            format!("{cell} is between {about}{} and {} (it is {is})", ceil(low), floor(high))
        }
        (Some(low), None) => format!("{cell} is above {about}{} (it is {is})", ceil(low)),
        (None, Some(high)) => format!("{cell} is below {about}{} (it is {is})", floor(high)),
        (None, None) => format!("{cell} has any value (it is {is})"),
    }
}
