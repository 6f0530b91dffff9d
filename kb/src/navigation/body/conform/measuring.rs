//! Whether it measures what is about it, and feels what it touches.

use adit_planners::geometry::Point;

use super::exam::{Exam, Over, PATIENCE_S};
use super::moving::{SLOW_M_S, STEP_M, go, went};
use super::scan::Scan;
use crate::navigation::body::message::Order;

/// About so far it turns, radians.
const TURN: f64 = 0.5;

/// A scan may take so long, seconds by the body's clock.
const SCAN_S: f64 = 60.0;

/// So many turns of what measures make a scan that one false echo does not spoil.
const TURNS: usize = 3;

/// One of two ways to see something is the right one where it fits so much better.
const BETTER: f64 = 0.7;

/// What is to be touched is no farther away, metres.
const NEAR_M: f64 = 3.0;

/// It would go on so far behind that, and may be felt so much too late, metres.
const BEYOND_M: f64 = 0.5;
const LATE_M: f64 = 0.15;

/// Something ahead is felt within so many radians.
const AHEAD: f64 = 0.8;

/// A share of the directions that is all of them: some readings may get lost.
const ALL: f64 = 0.9;

fn scan(exam: &mut Exam, turns: usize) -> Result<Scan, Over> {
    let directions = exam.profile()?.directions as usize;
    let mut senses = Vec::new();
    let mut readings = 0;
    let begun_s = exam.sense()?.time_s;
    loop {
        let one = exam.sense()?;
        readings += one.readings.len();
        let is_late = one.time_s - begun_s > SCAN_S || senses.len() > turns * directions * 10;
        senses.push(one);
        if readings >= turns * directions || is_late {
            return Ok(Scan::of(&senses, directions));
        }
    }
}

/// Turns and moves, with a look around before and after.
pub fn all_around(exam: &mut Exam) -> Result<(), Over> {
    let directions = exam.profile()?.directions as usize;
    let one = scan(exam, 1)?;
    let seen = format!("{} of {directions} in the first {directions} readings", one.measured);
    exam.say("directions", one.measured as f64 >= ALL * directions as f64, seen);

    let before = scan(exam, TURNS)?;
    // as many directions as make about half a radian
    let by = (TURN / before.step()).round().max(1.0);
    let turn = by * before.step();
    let done = exam.done(&Order::Turn { by_rad: turn }, PATIENCE_S)?;
    went(exam, "left", &done, (0.0, turn));
    let after = scan(exam, TURNS)?;
    let by = by as isize;
    either(exam, "bearings", [after.differs_turned(&before, by), after.differs_turned(&before, -by)]);
    let done = exam.done(&Order::Turn { by_rad: -turn }, PATIENCE_S)?;
    went(exam, "right", &done, (0.0, -turn));

    let before = scan(exam, TURNS)?;
    let done = exam.done(&go(STEP_M), PATIENCE_S)?;
    went(exam, "ahead", &done, (STEP_M, 0.0));
    let after = scan(exam, TURNS)?;
    either(exam, "nearer", [after.differs_moved(&before, STEP_M), after.differs_moved(&before, -STEP_M)]);
    let done = exam.done(&go(-STEP_M), PATIENCE_S)?;
    went(exam, "back", &done, (-STEP_M, 0.0));
    Ok(())
}

/// Keeps which of two ways to see it fits: as it should be, or the other way about.
fn either(exam: &mut Exam, check: &'static str, fits: [Option<f64>; 2]) {
    let [Some(right), Some(wrong)] = fits else {
        exam.say(check, None, "too little was heard to tell");
        return;
    };
    let seen = format!("{right:.3} m off on the whole; {wrong:.3} m, were it the other way about");
    let held = if right <= wrong * BETTER {
        Some(true)
    } else if wrong <= right * BETTER {
        Some(false)
    } else {
        None
    };
    exam.say(
        check,
        held,
        if held.is_some() { seen } else { format!("what is about it looks alike: {seen}") },
    );
}

/// Goes to what is nearest, until that is felt.
pub fn contact(exam: &mut Exam) -> Result<(), Over> {
    if !exam.profile()?.has_skirt {
        exam.say("contact", None, "it has no skirt");
        return Ok(());
    }
    let around = scan(exam, TURNS)?;
    let nearest = around.nearest();
    let gap = |range: f64, radius: f64| (range - radius).max(0.0);
    let radius = exam.outline()?.rim().extent_m(Point::new(1.0, 0.0));
    let Some((bearing, range)) = nearest.filter(|(_, range)| gap(*range, radius) <= NEAR_M) else {
        exam.say("contact", None, format!("nothing to touch is within {NEAR_M} m"));
        return Ok(());
    };
    let gap = gap(range, radius);
    exam.done(&Order::Turn { by_rad: adit_planners::pose::wrapped(bearing) }, PATIENCE_S)?;
    let far = gap + BEYOND_M;
    let done = exam.done(&go(far), 2.0 * far / SLOW_M_S + PATIENCE_S)?;
    let went = done.way().at.length();
    let touch = done.senses.iter().find_map(|senses| senses.contact);
    let is_ahead = touch.is_some_and(|touch| touch.bearing_rad.abs() <= AHEAD);
    let felt =
        touch.map_or("nothing felt".to_owned(), |touch| format!("felt at {:.2} rad", touch.bearing_rad));
    let seen = format!("{felt}, {went:.2} m on the way to what is {gap:.2} m off, of a move of {far:.2} m");
    if exam.found("contact").is_none() {
        exam.say("contact", is_ahead && went <= gap + LATE_M, seen);
    }
    exam.done(&go(-STEP_M), PATIENCE_S).map(|_| ())
}
