//! `adit route`.

use adit_db::measure::Measure;
use clap::Args;

use super::args::WayArgs;
use super::build::open;
use super::output::{json, line, maybe, number, remark, table};
use crate::answer::{Answer, Status};
use crate::edit::Errand;
use crate::error::{Code, Result};
use crate::words::measure::taken;

#[derive(Args, Debug)]
pub struct RouteArgs {
    #[command(flatten)]
    pub way: WayArgs,
    /// Another goal, as often as you like; the route leads to the one that costs least
    #[arg(long = "or", value_name = "GOAL", allow_hyphen_values = true)]
    pub others: Vec<String>,
    /// Print every step, not only where the action changes
    #[arg(long)]
    pub steps: bool,
    /// Move a start or goal at which the robot fits in no state by up to so many metres, to the nearest point
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    pub within: Option<f64>,
    /// Keep away from a doorway, a space, an area, a kind of area or a point `x,y` on this way, as often as you like
    #[arg(long, value_name = "NAME", allow_hyphen_values = true)]
    pub avoid: Vec<String>,
    /// What the robot carries on this way
    #[arg(long, value_name = "NAME")]
    pub load: Option<String>,
    /// In which state the robot starts; unless said, in whichever is cheapest
    #[arg(long, value_name = "STATE")]
    pub start_state: Option<String>,
    /// In which state it arrives
    #[arg(long, value_name = "STATE")]
    pub goal_state: Option<String>,
    /// The route as it would be at this time: `2026-11-21T18:00`, `18:00`, `2h`
    #[arg(long, value_name = "TIME")]
    pub at: Option<String>,
}

/// Prints the route, and gives the exit status.
pub fn run(args: &RouteArgs) -> Result<u8> {
    let goals: Vec<String> = std::iter::once(&args.way.goal).chain(&args.others).cloned().collect();
    let knowledge = open(&args.way.site)?.at(args.at.as_deref())?.within(args.within)?;
    let errand = Errand {
        avoid: args.avoid.clone(),
        load: args.load.clone(),
        at: args.at.clone(),
        start_state: args.start_state.clone(),
        start_facing: None,
        goal_state: args.goal_state.clone(),
    };
    let (start, robot) = (&args.way.start, args.way.robot.as_deref());
    // another moment alone needs no names of the last build
    let answer = if errand == (Errand { at: errand.at.clone(), ..Errand::default() }) {
        let answer = knowledge.route_to_nearest(start, &goals, robot)?;
        if errand.at.is_none() {
            knowledge.rules_not_built()?.iter().for_each(|note| remark(&format!("note: {note}")));
        }
        answer
    } else {
        knowledge.route_on_errand(&errand, (start, &goals), robot)?
    };
    for lost in knowledge.lost()? {
        remark(&format!("note: {lost}"));
    }
    if args.way.site.json {
        json(&answer)?;
        if let Some(reason) = &answer.reason {
            remark(reason);
        }
    } else if args.steps {
        steps(&answer, &knowledge.measures()?);
    } else {
        summary(&answer, &knowledge.measures()?);
    }
    Ok(answer.status.code().map_or(u8::from(answer.status == Status::NoRoute), Code::exit))
}

/// Prints an answer for people; whether there are steps to print.
fn head(answer: &Answer, measures: &[Measure]) -> bool {
    let (start, goal) = (&answer.start, &answer.goal);
    for instead in &answer.taken {
        let name = if instead.end == "start" { start } else { goal };
        line(&format!("the {} is not at {name}, but at {instead}", instead.end));
    }
    match answer.status {
        Status::Ok => {
            let metres = answer.distance.map_or(String::new(), |metres| format!(", {metres:.1} m"));
            let taken = taken(&answer.measures, measures)
                .map_or(String::new(), |taken| format!(", takes about {taken}"));
            line(&format!("{start} to {goal}, hardness {}{metres}{taken}:", maybe(answer.cost)));
        }
        Status::SameRoom => line(&format!("{start} and {goal} are in the same room:")),
        Status::NoRoute => {
            line(&format!(
                "no route from {start} to {goal}: {}",
                answer.reason.as_deref().unwrap_or_default()
            ));
            return false;
        }
        Status::UnknownStart | Status::UnknownGoal => {
            remark(answer.reason.as_deref().unwrap_or_default());
            return false;
        }
    }
    true
}

/// Prints every step of an answer.
pub fn steps(answer: &Answer, measures: &[Measure]) {
    if !head(answer, measures) {
        return;
    }
    let known: Vec<&str> = measures.iter().map(|of| of.measure.as_str()).collect();
    let known: Vec<&str> = known.into_iter().filter(|name| answer.measures.0.contains_key(*name)).collect();
    let rows = answer.steps.iter().map(|step| {
        let taken = known.iter().map(|name| maybe(step.measures.0.get(*name).copied()));
        let row = vec![
            step.step.to_string(),
            step.kind.clone(),
            step.place.clone(),
            step.state.clone().unwrap_or_default(),
            step.action.clone().unwrap_or_default(),
            maybe(step.hardness),
            number(step.cost),
            maybe(step.x),
            maybe(step.y),
            step.z.map_or(String::new(), number),
            step.heading.map_or(String::new(), |heading| format!("{heading:.0}°")),
            step.space.clone().or_else(|| step.doorway.clone()).unwrap_or_default(),
        ];
        row.into_iter().chain(taken).collect()
    });
    let mut columns = vec![
        "step", "kind", "place", "state", "action", "hardness", "cost", "x", "y", "z", "heading", "where",
    ];
    columns.extend(&known);
    table(&columns, rows);
}

/// Prints a route over a map that is not cut into rooms: a line a step, where it leads and through what.
fn one_by_one(answer: &Answer) {
    let rows = answer.steps.iter().map(|step| {
        let [x, y] = [step.x, step.y].map(|value| format!("{:.1}", value.unwrap_or_default()));
        let to = step.z.map_or_else(|| format!("to {x}, {y}"), |z| format!("to {x}, {y}, {z:.1}"));
        let hardness = format!("hardness {:.1}", step.hardness.unwrap_or_default());
        vec![step.action.clone().unwrap_or_default(), to, hardness, step.place.clone()]
    });
    table(&["", "", "", ""], rows);
    for text in &answer.remarks {
        remark(&format!("note: {text}"));
    }
}

/// Steps with one action, one after the other.
struct Run {
    action: String,
    hardness: f64,
    to: [f64; 2],
    /// The spaces that it leads through.
    spaces: Vec<String>,
}

/// Prints an answer in a few lines: a line for each run of steps with one action, and the spaces that it leads through.
pub fn summary(answer: &Answer, measures: &[Measure]) {
    if !head(answer, measures) {
        return;
    }
    if answer.steps.iter().all(|step| !["room", "door", "change"].contains(&step.kind.as_str())) {
        return one_by_one(answer);
    }
    let mut runs: Vec<Run> = Vec::new();
    for step in &answer.steps {
        let action = step.action.clone().unwrap_or_default();
        if runs.last().is_none_or(|run| run.action != action) {
            runs.push(Run { action, hardness: 0.0, to: [0.0; 2], spaces: Vec::new() });
        }
        let Some(run) = runs.last_mut() else { continue };
        run.hardness += step.hardness.unwrap_or_default();
        run.to = [step.x.unwrap_or_default(), step.y.unwrap_or_default()];
        // where a run begins on a space's edge, nothing is walked there yet
        let space = step.space.as_ref().filter(|_| step.hardness.is_some_and(|hardness| hardness > 0.0));
        run.spaces.extend(space.filter(|space| run.spaces.last() != Some(space)).cloned());
    }
    let rows = runs.into_iter().map(|Run { action, hardness, to: [x, y], spaces }| {
        vec![action, format!("to {x:.1}, {y:.1}"), format!("hardness {hardness:.1}"), spaces.join(", ")]
    });
    table(&["", "", "", ""], rows);
}
