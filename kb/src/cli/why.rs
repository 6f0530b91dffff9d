//! `adit why` and `adit why-not`.

use super::build::open;
use super::output::{json, line};
use super::{WhyArgs, WhyNotArgs};
use crate::error::Result;
use crate::live::Live;

/// Rejections that are printed; all of them stand in the JSON.
const PRINTED: usize = 20;

/// Prints why an object is as it is.
pub fn why(args: &WhyArgs) -> Result<()> {
    let answer = Live::open(open(&args.site)?)?.why(&args.what)?;
    if args.site.json {
        return json(&answer);
    }
    for conclusion in &answer.conclusions {
        line(&conclusion.why);
    }
    if answer.conclusions.is_empty() {
        line(&format!("no rule concluded anything about {}", answer.name));
    }
    Ok(())
}

/// Prints why no route leads through a room or door.
pub fn why_not(args: &WhyNotArgs) -> Result<()> {
    let robot = args.robot.as_deref();
    let live = Live::open(open(&args.site)?)?;
    let answer = live.why_not(&args.start, &args.goal, &args.through, robot)?;
    if args.site.json {
        return json(&answer);
    }
    line(&answer.reason);
    if answer.sentence != answer.reason {
        line(&answer.sentence);
    }
    for deciding in answer.deciding.iter().filter(|_| answer.cost.is_none()) {
        line(&format!("  {deciding}"));
    }
    for conclusion in &answer.conclusions {
        line(&format!("  {}", conclusion.why));
    }
    for rejected in answer.rejected.iter().take(PRINTED) {
        line(&format!("  {rejected}"));
    }
    let more = answer.rejected.len().saturating_sub(PRINTED);
    if more > 0 || answer.truncated {
        line(&format!("  and {more} more rejected{}", if answer.truncated { ", at least" } else { "" }));
    }
    Ok(())
}
