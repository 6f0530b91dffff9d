//! Why not another way, over a map that is not cut into rooms: what it would cost, and what it leads through.

use super::WhyNot;
use crate::answer::Answer;
use crate::error::Result;
use crate::plan::course::Found;
use crate::state::Courses;
use crate::words::number::number;

/// Why the best route does not lead through something: what that would cost, and what it leads through instead.
pub fn why_not(courses: &Courses, route: [&str; 3], through: &str, generation: u64) -> Result<WhyNot> {
    let [robot, start, goal] = route;
    let best = courses.find(robot, start, goal)?;
    let other = courses.find_through(robot, [start, goal], through)?;
    let places = |found: &Found| {
        let places =
            found.row.steps.iter().filter(|step| step.hardness.is_some_and(|hardness| hardness > 0.0));
        places.map(|step| step.place.clone()).collect::<Vec<_>>()
    };
    let (reason, sentence) = match (best.row.cost, other.row.cost) {
        (_, None) => {
            let reason = other.row.reason.clone().unwrap_or_default();
            let sentence = format!("no way leads through {through}: {reason}");
            (sentence.clone(), sentence)
        }
        (Some(least), Some(cost)) if cost > least => {
            let more = number(cost - least);
            let reason = format!("the way through {through} costs {more} more");
            let sentence = format!(
                "the way through {through} costs {} (by {}), the best one {} (by {})",
                number(cost),
                places(&other).join(", "),
                number(least),
                places(&best).join(", ")
            );
            (reason, sentence)
        }
        (_, Some(cost)) => {
            let reason = format!("the best way leads through {through}, or one that costs no more does");
            let sentence = format!("{reason}: {}", number(cost));
            (sentence.clone(), sentence)
        }
    };
    let weighs = |step: &adit_db::route::Step| {
        let rule = step.rule.as_ref().map_or(String::new(), |rule| format!(", by rule \"{rule}\""));
        format!("{} weighs {}{rule}", step.place, step.hardness.map_or("nothing".to_owned(), number))
    };
    let row = &other.row;
    let answer = (row.reason.is_none()).then(|| Answer {
        cost: row.cost,
        distance: row.distance,
        measures: row.measures.clone(),
        steps: row.steps.clone(),
        waypoints: row.waypoints.clone(),
        ..Answer::blank(robot, start, &[goal.to_owned()], generation)
    });
    Ok(WhyNot {
        generation,
        robot: robot.to_owned(),
        start: start.to_owned(),
        goal: goal.to_owned(),
        through: through.to_owned(),
        best: best.row.cost,
        cost: row.cost,
        reason,
        sentence,
        driven: None,
        deciding: row.steps.iter().filter(|step| step.kind == "line").map(weighs).collect(),
        would_win: None,
        not_looked_further: true,
        conclusions: Vec::new(),
        rejected: Vec::new(),
        truncated: false,
        route: answer,
    })
}
