//! Whether it moves as it is told, and says so.

use std::f64::consts::FRAC_PI_2;

use adit_planners::pose::{Pose, wrapped};

use super::exam::{Done, Exam, Over, PATIENCE_S};
use crate::navigation::body::message::{Order, Senses};

/// By how much a turn may miss, radians; a move, metres.
const TURN: f64 = 0.1;
const MOVE_M: f64 = 0.05;

/// How far and how fast it goes, metres and metres a second.
pub const STEP_M: f64 = 0.3;
pub const SLOW_M_S: f64 = 0.1;

/// Something moves once odometry says so much, metres.
const OFF_M: f64 = 0.03;

/// A change of shape is done after so long, seconds.
const CHANGED_S: f64 = 120.0;

/// How much faster than it is told it may be on the whole.
const FASTER: f64 = 1.2;

pub const fn go(distance_m: f64) -> Order {
    Order::Move { distance_m, speed_m_s: SLOW_M_S, bearing_rad: 0.0 }
}

fn told(way: &Pose) -> String {
    format!("odometry went {:.3} m ahead, {:.3} m aside, {:.3} rad", way.at.x, way.at.y, way.heading)
}

/// Keeps whether it went as it was told: so far, and turned by so much.
pub fn went(exam: &mut Exam, check: &'static str, done: &Done, (ahead_m, turn): (f64, f64)) {
    let way = done.way();
    let is_there = (way.at.x - ahead_m).abs() <= MOVE_M && way.at.y.abs() <= MOVE_M;
    let held = is_there && wrapped(way.heading - turn).abs() <= TURN;
    match &done.refused {
        Some(why) => exam.say(check, false, why.clone()),
        None => exam.say(check, held, format!("{}, asked {ahead_m:.3} m, {turn:.3} rad", told(&way))),
    }
}

pub fn rest(exam: &mut Exam) -> Result<(), Over> {
    let mut held = true;
    let mut seen = String::new();
    let shape = exam.profile()?.shape.clone();
    for _ in 0..3 {
        let Senses { odometry, is_busy, shape: now, .. } = exam.sense()?;
        let pose = Pose::from(odometry);
        held &= pose.at.length() <= MOVE_M && wrapped(pose.heading).abs() <= TURN && !is_busy && now == shape;
        let busy = if is_busy { "busy" } else { "idle" };
        seen = format!("{:.3}, {:.3}, {:.3} rad, {busy}, in {now}", pose.at.x, pose.at.y, pose.heading);
    }
    exam.say("rest", held, seen);
    Ok(())
}

pub fn speed(exam: &mut Exam) -> Result<(), Over> {
    let done = exam.done(&go(STEP_M), PATIENCE_S)?;
    let mean = done.way().at.length() / done.seconds;
    let seen = format!("{mean:.3} m/s on the whole, asked {SLOW_M_S}");
    let held = done.refused.is_none().then_some(mean <= SLOW_M_S * FASTER);
    exam.say("speed", held, done.refused.clone().unwrap_or(seen));
    exam.done(&go(-done.way().at.x), PATIENCE_S).map(|_| ())
}

/// Sets off, and says where it was then and when something else was commanded.
fn set_off(exam: &mut Exam) -> Result<(Pose, Pose), Over> {
    let from = exam.pose()?;
    exam.obey(&go(STEP_M))?.ok();
    let is_off =
        |senses: &Senses| from.at.distance(Pose::from(senses.odometry).at) >= OFF_M || !senses.is_busy;
    exam.until(is_off, PATIENCE_S)?;
    Ok((from, exam.pose()?))
}

pub fn stop(exam: &mut Exam) -> Result<(), Over> {
    let (from, off) = set_off(exam)?;
    let stopped = exam.done(&Order::Stop {}, PATIENCE_S)?;
    exam.until(|_| false, 1.0)?;
    let now = exam.pose()?;
    let far = off.at.distance(now.at);
    let seen = format!("{far:.3} m more after `stop`, of a move of {STEP_M} m");
    let moved = from.at.distance(off.at) >= OFF_M;
    exam.say("stop", moved.then_some(far <= MOVE_M && stopped.refused.is_none()), seen);
    exam.done(&go(-from.to(&now).at.x), PATIENCE_S).map(|_| ())
}

pub fn anew(exam: &mut Exam) -> Result<(), Over> {
    const ASIDE: f64 = 0.4;
    let (from, off) = set_off(exam)?;
    let moved = from.at.distance(off.at) >= OFF_M;
    let turned = exam.done(&Order::Turn { by_rad: ASIDE }, PATIENCE_S)?;
    let way = turned.way();
    let held = way.at.length() <= MOVE_M && wrapped(way.heading - ASIDE).abs() <= TURN;
    let held = held && turned.refused.is_none();
    exam.say("anew", moved.then_some(held), format!("a turn of {ASIDE} rad in a move: {}", told(&way)));
    exam.done(&Order::Turn { by_rad: -way.heading }, PATIENCE_S)?;
    let now = exam.pose()?;
    exam.done(&go(-from.to(&now).at.x), PATIENCE_S).map(|_| ())
}

/// Goes to a side and back: a body that is longer than wide keeps its facing.
pub fn aside(exam: &mut Exam) -> Result<(), Over> {
    if exam.outline()?.length_m.is_none() {
        exam.say("aside", None, "it is round, and goes where it looks");
        return Ok(());
    }
    let aside = |distance_m| Order::Move { distance_m, speed_m_s: SLOW_M_S, bearing_rad: FRAC_PI_2 };
    let done = exam.done(&aside(STEP_M), PATIENCE_S)?;
    let way = done.way();
    let is_there = way.at.x.abs() <= MOVE_M && (way.at.y - STEP_M).abs() <= MOVE_M;
    let held = is_there && wrapped(way.heading).abs() <= TURN && done.refused.is_none();
    // what is felt on the way ends it
    let is_felt = done.senses.iter().any(|senses| senses.contact.is_some());
    exam.say("aside", (held || !is_felt).then_some(held), done.refused.clone().unwrap_or_else(|| told(&way)));
    exam.done(&aside(-way.at.y), PATIENCE_S).map(|_| ())
}

pub fn change(exam: &mut Exam) -> Result<(), Over> {
    let profile = exam.profile()?.clone();
    let others = profile.shapes.iter().filter(|outline| outline.name != profile.shape);
    let (mut before, mut seen) = (profile.shape.clone(), Vec::new());
    for name in others.map(|outline| &outline.name).chain([&profile.shape]) {
        if *name == before {
            continue;
        }
        let done = exam.done(&Order::Change { shape: name.clone() }, CHANGED_S)?;
        if let Some(why) = done.refused {
            exam.fault("change", why);
            return Ok(());
        }
        let after = done.senses.last().map_or("", |last| last.shape.as_str()).to_owned();
        if after != *name {
            exam.fault("change", format!("it is in {after} after a change from {before} to {name}"));
            before = after;
            continue;
        }
        if done.senses.iter().any(|senses| senses.is_busy && senses.shape != before) {
            exam.fault(
                "change",
                format!("it was in another shape before the change from {before} to {name} was done"),
            );
        }
        seen.push(format!("{before} to {name} in {:.1} s", done.seconds));
        before.clone_from(name);
    }
    match exam.found("change") {
        Some(_) => {}
        None if seen.is_empty() => exam.say("change", None, "it has one shape"),
        None => exam.say("change", true, seen.join(", ")),
    }
    Ok(())
}
