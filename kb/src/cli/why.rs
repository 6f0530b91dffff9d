//! `adit why` and `adit why-not`.

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
    /// simulate --db` instead of a site its number alone)
    pub what: String,
    /// Of a mission: ask about what the robot did at this time instead of about its last stop
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub at: Option<f64>,
    /// Of a mission: the name of its world, where the database has several
    #[arg(long, value_name = "NAME")]
    pub world: Option<String>,
}

#[derive(Args, Debug)]
pub struct WhyNotArgs {
    #[command(flatten)]
    pub way: WayArgs,
    /// The room or door: `room d`, `door 7`
    #[arg(long, value_name = "WHAT")]
    pub through: String,
}

/// Rejections that are printed; all of them stand in the JSON.
const PRINTED: usize = 20;

pub fn why(args: &WhyArgs) -> Result<()> {
    let SiteArgs { site, .. } = &args.site;
    if site.is_file() && site.extension().is_none_or(|extension| extension != "toml") {
        return of_mission(args, site, &args.what);
    }
    if let Some(mission) = args.what.strip_prefix("mission ") {
        return of_mission(args, open(&args.site)?.database(), mission);
    }
    if args.at.is_some() || args.world.is_some() {
        let message = format!("--at and --world are for missions, and {} is none", args.what);
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
    if answer.conclusions.is_empty() {
        line(&format!("no rule concluded anything about {}", answer.name));
    }
    Ok(())
}

fn of_mission(args: &WhyArgs, database: &Path, mission: &str) -> Result<()> {
    let rules = &args.site.rules;
    let answer = of_journal::why(database, mission, args.world.as_deref(), args.at, rules.as_deref())?;
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
