//! Puts a body through what the protocol asks: what is said and answered, how it moves, what it measures.
//!
//! The robot stands where half a metre about it is free and something stands within three metres; it turns, goes some decimetres
//! ahead and back, changes its shape, and at last goes slowly to what is nearest until its skirt feels that.

mod exam;
mod manners;
mod measuring;
mod moving;
mod scan;

use serde::Serialize;

use super::link::Link;
use exam::{Exam, Over};

/// One thing that the protocol asks, and whether a body does it.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    pub check: &'static str,
    /// What is asked.
    pub asks: &'static str,
    /// `None` where it could not be tried.
    pub held: Option<bool>,
    /// What was seen.
    pub seen: String,
}

/// All checks, in the order in which they are told.
const CHECKS: [(&str, &str); 24] = [
    ("version", "another version of the protocol is refused in words"),
    ("hello", "`hello` is answered with this version, shapes, directions and range that make sense"),
    ("unknown", "what is no message is refused in words, and the link lives on"),
    ("rest", "at first it stands, is idle, and its odometry is 0, 0, 0"),
    ("directions", "all directions are measured within a turn"),
    ("left", "a turn above 0 is counter-clockwise, and odometry follows"),
    ("right", "a turn below 0 is clockwise, and odometry follows"),
    ("bearings", "bearings are counter-clockwise: after a turn to the left all is farther to the right"),
    ("ahead", "a move above 0 is ahead, and odometry follows"),
    ("nearer", "bearing 0 is ahead, and ranges are metres: what is ahead comes nearer by what odometry says"),
    ("back", "a move below 0 is back, and odometry follows"),
    ("aside", "a move with a bearing goes there, and the body keeps its facing"),
    ("speed", "it goes no faster than it is told"),
    ("stop", "`stop` ends a move"),
    ("anew", "a new command ends the old one"),
    ("change", "a change of shape takes effect, and not before it is done"),
    ("contact", "a contact is felt, and ends the move"),
    ("busy", "it is busy until a command is done, and then no more"),
    ("time", "time grows from answer to answer"),
    ("angles", "angles are radians, within a turn either way"),
    ("ranges", "ranges are 0 to what it said, or null"),
    ("readings", "readings are no more than there are directions, and carry the odometry of their time"),
    ("answers", "every line is answered by one line, a message of the protocol, in time"),
    ("bye", "`bye` is answered, and ends it"),
];

/// Puts a body through all of it.
pub fn conform(link: Link) -> Vec<Check> {
    let mut exam = Exam::new(link);
    // what was not come to is not tried
    let outcome = examined(&mut exam);
    exam.take_stock();
    let why = match outcome {
        Ok(()) => "it was not come to".to_owned(),
        Err(Over) => "the link was over before".to_owned(),
    };
    let of = |(check, asks): (&'static str, &'static str)| {
        let (held, seen) = exam.found(check).unwrap_or_else(|| (None, why.clone()));
        Check { check, asks, held, seen }
    };
    CHECKS.map(of).into()
}

fn examined(exam: &mut Exam) -> Result<(), Over> {
    manners::version(exam)?;
    manners::hello(exam)?;
    manners::unknown(exam)?;
    moving::rest(exam)?;
    measuring::all_around(exam)?;
    moving::aside(exam)?;
    moving::speed(exam)?;
    moving::stop(exam)?;
    moving::anew(exam)?;
    moving::change(exam)?;
    measuring::contact(exam)?;
    manners::bye(exam)
}
