//! `adit why` and `adit why-not`.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use clap::Args;

use super::args::{SiteArgs, WayArgs};
use super::build::open;
use super::output::{json, line};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::navigation::why as of_journal;

#[derive(Args, Debug)]
pub struct WhyArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// What: `door 7`, `room d`, `doors.7`, `doors.7.hardness`; `mission 3`: why the robot stopped (of a database of `adit
    /// simulate --db` instead of a site its number alone); with GOAL, where a route starts: a place, a space, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub what: String,
    /// Where the route leads: why it does what it does, stretch by stretch
    #[arg(allow_hyphen_values = true)]
    pub goal: Option<String>,
    /// Of a route: only its stretches at this space, doorway, area, named door or point; of a mission: ask about what the robot
    /// did at this time, in seconds, instead of about its last stop
    #[arg(long, value_name = "WHAT", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// Of a route: which robot, where the site has several
    #[arg(long, requires = "goal")]
    pub robot: Option<String>,
    /// Of a mission: the name of its world, where the database has several
    #[arg(long, value_name = "NAME")]
    pub world: Option<String>,
}

#[derive(Args, Debug)]
pub struct WhyNotArgs {
    #[command(flatten)]
    pub way: WayArgs,
    /// A space, a doorway, an area, a named door, `room d`, `door 7`, a place, or a point `x,y` by which to go
    #[arg(long, value_name = "WHAT", allow_hyphen_values = true)]
    pub through: String,
}

/// Rejections that are printed; all of them stand in the JSON.
const PRINTED: usize = 20;

/// Whether a file is one of missions, and no map.
fn is_database(file: &Path) -> bool {
    let mut head = [0; 16];
    let read = File::open(file).and_then(|mut file| file.read_exact(&mut head));
    read.is_ok() && head == *b"SQLite format 3\0"
}

pub fn why(args: &WhyArgs) -> Result<()> {
    let SiteArgs { site, .. } = &args.site;
    // what is asked without a goal of a file that is no map of our own is a mission
    let is_map = args.goal.is_some() || site.extension().is_some_and(|extension| extension == "toml");
    if site.is_file() && (is_database(site) || !is_map) {
        return of_mission(args, site, &args.what);
    }
    if let Some(mission) = args.what.strip_prefix("mission ") {
        return of_mission(args, open(&args.site)?.database(), mission);
    }
    if let (Some(goal), None) = (&args.goal, &args.world) {
        return of_route(args, goal);
    }
    if args.at.is_some() || args.world.is_some() {
        let message =
            format!("--at is for routes and missions, --world for missions, and {} is none", args.what);
        let help = "`adit simulate SITE --keep` keeps missions; `adit why SITE \"mission 1\"` asks about one";
        return Err(Error::said(Code::WhyNoMissions, message, Some(help.to_owned())));
    }
    let answer = Live::open(open(&args.site)?)?.why(&args.what)?;
    if args.site.json {
        return json(&answer);
    }
    for conclusion in &answer.conclusions {
        line(&conclusion.why);
    }
    if let Some(easier) = &answer.easier {
        line(&format!("nothing easier goes there: {easier}"));
    }
    if answer.conclusions.is_empty() {
        line(&format!("no rule concluded anything about {}", answer.name));
    }
    Ok(())
}

fn of_route(args: &WhyArgs, goal: &str) -> Result<()> {
    let live = Live::open(open(&args.site)?)?;
    let answer = live.why_way((&args.what, goal), args.at.as_deref(), args.robot.as_deref())?;
    if args.site.json {
        return json(&answer);
    }
    for sentence in &answer.sentences {
        line(sentence);
    }
    Ok(())
}

fn of_mission(args: &WhyArgs, database: &Path, mission: &str) -> Result<()> {
    let seconds = |at: &String| {
        at.trim().parse::<f64>().map_err(|_| {
            let message = format!("--at {at:?} is no time of a mission; expected seconds");
            Error::said(Code::WhyNoMissions, message, None)
        })
    };
    let at = args.at.as_ref().map(seconds).transpose()?;
    let rules = &args.site.rules;
    let answer = of_journal::why(database, mission, args.world.as_deref(), at, rules.as_deref())?;
    if args.site.json {
        return json(&answer);
    }
    for text in answer.lines() {
        line(&text);
    }
    Ok(())
}

pub fn why_not(args: &WhyNotArgs) -> Result<()> {
    let WayArgs { site, start, goal, robot } = &args.way;
    let answer = Live::open(open(site)?)?.why_not(start, goal, &args.through, robot.as_deref())?;
    if site.json {
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
