//! `adit drive`: a mission of a robot that is heard by lines of JSON, on the routes of a site or on a floor plan.

use std::path::{Path, PathBuf};
use std::time::Duration;

use adit_planners::pose::Pose;
use adit_planners::rim::Rim;
use clap::Args;

use super::args::{SiteArgs, heading, timeout};
use super::build::open;
use super::kept::{Kept, Of};
use super::output::{either, line, remark};
use super::routed::{Setting, point};
use super::simulate::{may_begin, of_robot, rules_of};
use crate::error::Result;
use crate::live::Live;
use crate::navigation::body::{Link, Remote, Used};
use crate::navigation::judge::{Judges, RuleJudge};
use crate::navigation::missions::{Row, Stage, ended, refuse};
use crate::navigation::reporting::{Reporting, Reports};
use crate::words::number::{counted, number};

#[derive(Args, Debug)]
pub struct DriveArgs {
    /// Folder of a site whose rooms are cut by state, or whose map has walls; or such a map alone: a TOML file with `[floor_plan]`
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
    /// Tell the site what the robot meets, as `adit simulate` does
    #[arg(long)]
    pub tell: bool,
    /// Print how it went as JSON
    #[arg(long)]
    pub json: bool,
}

/// Drives a mission; `false` where it did not arrive.
pub fn run(args: &DriveArgs) -> Result<bool> {
    let driver = Driver { args, timeout: timeout(args.timeout)?, heading: heading(args.heading)? };
    let site = SiteArgs { site: args.site.clone(), db: None, rules: args.rules.clone(), json: args.json };
    let live = Live::open(open(&site)?)?;
    if args.keep || args.tell {
        live.site().needs_folder()?;
    }
    let own = args.keep.then(|| live.site().database().to_owned());
    let db = own.as_deref().or(args.db.as_deref());
    let (row, world, said) = if live.site().course().is_some() {
        driver.on_floor(live, db)?
    } else {
        driver.on_routes(live, db)?
    };
    either(args.json, &row, |row| show(row, &world))?;
    for text in &said {
        remark(text);
    }
    Ok(row.ending == "arrived")
}

/// A mission, the name of its world, and what the site was told, and what followed, in sentences.
type Driven = (Row, String, Vec<String>);

struct Driver<'a> {
    args: &'a DriveArgs,
    timeout: Duration,
    /// Radians.
    heading: f64,
}

impl Driver<'_> {
    fn greet(&self, used: &[Used]) -> Remote {
        Remote::greet(Link::open(&self.args.body, self.timeout), used)
    }

    /// Over rooms that are cut by state.
    fn on_routes(&self, mut live: Live, db: Option<&Path>) -> Result<Driven> {
        let args = self.args;
        let setting = Setting::new(&live, args.robot.as_deref(), args.tell)?;
        let (at, goal) = (point(&live, &args.start)?, point(&live, &args.goal)?);
        setting.ground.fitting(&live.fork(), at)?;
        let mut kept = Kept::open(setting.of(), db, args.keep)?;
        let mut on = setting.missions(&mut live, args.tell);
        let mut body = self.greet(&setting.ground.used());
        let driven = on.drive(kept.before + 1, (Pose { at, heading: self.heading }, goal), &mut body);
        body.bye();
        let (journal, said) = driven?;
        let row = kept.keep(on.live, WORDS, journal)?;
        Ok((row, setting.name.clone(), said))
    }

    /// Over the network of a floor plan, for a body that stays in its shape.
    fn on_floor(&self, mut live: Live, db: Option<&Path>) -> Result<Driven> {
        let args = self.args;
        let (robot, floor) = of_robot(&live, args.robot.as_deref())?;
        let bases = rules_of(live.site());
        let (at, goal) = (floor.point(&args.start)?, floor.point(&args.goal)?);
        may_begin(&floor, at)?;
        let of = Of { world: &floor.plan.name, bases: &bases, states: &[], robot: &robot };
        let mut kept = Kept::open(of, db, args.keep)?;
        let number = kept.before + 1;
        let stage = Stage::new(&floor, &Judges::new(&live.asked(), &floor.told)?)?;
        let ends = (Pose { at, heading: self.heading }, goal);
        let used = [Used { name: None, rim: Rim::disc(floor.network.disc.radius) }];
        let (journal, said) = if args.tell {
            let reports = Reports::default();
            let plan = |live: &Live, robot: &str| Ok(of_robot(live, Some(robot))?.1);
            let mut judge = Reporting::new(&mut live, &reports, plan, (&robot, number))?;
            let mut body = self.greet(&used);
            let journal = stage.drive(&mut judge, number, ends, &mut body, |entry| reports.hear(entry));
            body.bye();
            refuse(judge.trouble())?;
            (journal, judge.said)
        } else {
            let mut judge = RuleJudge::of_mission(&live.asked(), &floor.told)?;
            let mut body = self.greet(&used);
            let journal = stage.drive(&mut judge, number, ends, &mut body, |_| {});
            body.bye();
            refuse(judge.trouble())?;
            (journal, Vec::new())
        };
        let row = kept.keep(&live, WORDS, journal)?;
        Ok((row, floor.plan.name.clone(), said))
    }
}

/// What is kept in traversals is one of these.
const WORDS: &str = "mission";

fn show(row: &Row, site: &str) {
    let more = match (row.ending, &row.silence) {
        ("arrived", _) => ", by its own account".to_owned(),
        (_, Some(why)) => format!(": {why}"),
        _ => String::new(),
    };
    line(&format!("mission {} of {site}: it {}{more}", row.mission, ended(row.ending)));
    let states: Vec<String> =
        row.by_state.iter().map(|(state, metres)| format!("{state} {} m", number(*metres))).collect();
    let states = if states.is_empty() { String::new() } else { format!(" ({})", states.join(", ")) };
    line(&format!(
        "{} m by its wheels{states} in {} s, {}, {} closed, {} of shape, {} felt",
        number(row.length),
        number(row.seconds),
        counted(row.detours as usize, "detour"),
        counted(row.replans as usize, "way"),
        counted(row.changes as usize, "change"),
        if row.touches == 1 { "1 touch".to_owned() } else { format!("{} touches", row.touches) },
    ));
}
