//! `adit drive`: a mission of a robot that is heard by lines of JSON, on the routes of a site.

use std::path::PathBuf;

use adit_planners::pose::Pose;
use clap::Args;

use super::args::{SiteArgs, heading, timeout};
use super::build::open;
use super::output::{either, line, remark};
use super::routed::{Kept, Setting, point};
use crate::body::{Link, Remote};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::navigation::missions::Row;
use crate::words::number::{counted, number};

#[derive(Args, Debug)]
pub struct DriveArgs {
    /// Folder of a site whose rooms are cut by state
    pub site: PathBuf,
    /// Where the robot stands: a place or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub start: String,
    /// Where to go, likewise
    #[arg(allow_hyphen_values = true)]
    pub goal: String,
    /// The robot: a program that is started, with its arguments, in quotes; or `tcp://HOST:PORT`
    #[arg(long, value_name = "COMMAND")]
    pub body: String,
    /// A robot that does not answer for so long is not heard any more
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    pub timeout: f64,
    /// Where it looks at first, in degrees
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub heading: f64,
    /// Which robot of the site it is, where that has several
    #[arg(long)]
    pub robot: Option<String>,
    /// Folder of *.rhai files, instead of the site's own or the shipped ones
    #[arg(long, value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Keep the mission with its journal in this database
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// Keep it in the site's own, and what was measured for `adit fit`
    #[arg(long, conflicts_with = "db")]
    pub keep: bool,
    /// Tell the site what the robot meets, for an hour
    #[arg(long)]
    pub tell: bool,
    /// Print how it went as JSON
    #[arg(long)]
    pub json: bool,
}

/// Drives a mission; `false` where it did not arrive.
pub fn run(args: &DriveArgs) -> Result<bool> {
    let (timeout, heading) = (timeout(args.timeout)?, heading(args.heading)?);
    let site = SiteArgs { site: args.site.clone(), db: None, rules: args.rules.clone(), json: args.json };
    let mut live = Live::open(open(&site)?)?;
    if live.site().course().is_some() {
        let message = format!("the map of {} is not cut into rooms", live.site().site().name);
        let help = "robots are driven on the routes of sites whose rooms are cut by state".to_owned();
        return Err(Error::said(Code::CourseUnfit, message, Some(help)));
    }
    if args.keep {
        live.site().needs_folder()?;
    }
    let own = args.keep.then(|| live.site().database().to_owned());
    let setting = Setting::of(&live, args.robot.as_deref(), args.tell)?;
    let mut kept = Kept::open(&setting, own.as_deref().or(args.db.as_deref()), args.keep)?;
    let (at, goal) = (point(&live, &args.start)?, point(&live, &args.goal)?);
    setting.ground.fitting(&live.fork(), at)?;
    let mut on = setting.missions(&mut live, args.tell);
    let mut body = Remote::greet(Link::open(&args.body, timeout), &setting.ground.used());
    let driven = on.drive(kept.before + 1, (Pose { at, heading }, goal), &mut body);
    body.bye();
    let (journal, said) = driven?;
    let row = kept.keep(on.live, "mission", journal)?;
    either(args.json, &row, |row| show(row, &setting.name))?;
    for text in &said {
        remark(text);
    }
    Ok(row.ending == "arrived")
}

fn show(row: &Row, site: &str) {
    let ended = match (row.ending, &row.silence) {
        ("arrived", _) => "it arrived, by its own account".to_owned(),
        ("no_way", _) => "it found no way".to_owned(),
        ("lost", _) => "it does not know where it is".to_owned(),
        ("silent", Some(why)) => format!("it is not heard any more: {why}"),
        _ => "it gave up".to_owned(),
    };
    line(&format!("mission {} of {site}: {ended}", row.mission));
    let states: Vec<String> =
        row.by_state.iter().map(|(state, metres)| format!("{state} {} m", number(*metres))).collect();
    line(&format!(
        "{} m by its wheels in {} s ({}), {} change{} of shape",
        number(row.length),
        number(row.seconds),
        if states.is_empty() { "it stood".to_owned() } else { states.join(", ") },
        row.changes,
        if row.changes == 1 { "" } else { "s" },
    ));
    line(&format!(
        "{}, {} closed, {} felt",
        counted(row.detours as usize, "detour"),
        counted(row.replans as usize, "way"),
        if row.touches == 1 { "1 touch".to_owned() } else { format!("{} touches", row.touches) },
    ));
}
