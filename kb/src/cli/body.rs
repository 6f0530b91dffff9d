//! `adit body`: our simulated robot as others hear it, by lines of JSON. `adit conform`: whether a body does what the protocol
//! asks.

use std::io::{self, BufRead, BufReader, Write, stdin, stdout};
use std::net::TcpListener;
use std::path::PathBuf;

use adit_planners::navigation::{Advance, Mission, Trip};
use adit_planners::pose::Pose;
use adit_planners::simulator::Simulator;
use clap::Args;
use serde_json::json;

use super::args::{SiteArgs, heading, timeout};
use super::build::open;
use super::output::{either, line, remark, table};
use super::routed::point;
use super::simulate::{may_begin, of_robot};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::navigation::body::conform::{Check, conform as examine};
use crate::navigation::body::{Host, Link, Outline};
use crate::navigation::ground::Ground;
use crate::navigation::judge::Judges;
use crate::navigation::missions::Stage;
use crate::site::whole;

#[derive(Args, Debug)]
pub struct BodyArgs {
    /// Folder of a site whose rooms are cut by state, or whose map has walls; or such a map alone: a TOML file with `[floor_plan]`
    pub site: PathBuf,
    /// Where the robot stands: a place or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub start: String,
    /// Where it looks at first, in degrees
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub heading: f64,
    /// The state in which it begins; otherwise the first one in which it fits there
    #[arg(long)]
    pub state: Option<String>,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
    /// Of the errors of wheels and sonar; the same seed gives the same errors
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Folder of *.rhai files, instead of the site's own or the shipped ones
    #[arg(long, value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Answer who connects to this address, one after the other, each with a robot at START; not standard input
    #[arg(long, value_name = "ADDRESS:PORT")]
    pub listen: Option<String>,
    /// Write down at the end where the robot really was, and how far it really went: a JSON file
    #[arg(long, value_name = "FILE")]
    pub truth: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub struct ConformArgs {
    /// The body: a program that is started, with its arguments, in quotes; or `tcp://HOST:PORT`
    #[arg(value_name = "COMMAND")]
    pub body: String,
    /// It answers within so long
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    pub timeout: f64,
    /// Print the checks as JSON
    #[arg(long)]
    pub json: bool,
}

/// Answers as a simulated robot, until it is left.
pub fn body(args: &BodyArgs) -> Result<()> {
    let heading = heading(args.heading)?;
    let site = SiteArgs { site: args.site.clone(), db: None, rules: args.rules.clone(), json: false };
    let live = Live::open(open(&site)?)?;
    let mission = |at| Mission::between(Pose { at, heading }, at, args.seed);
    if live.site().course().is_some() {
        let (robot, floor) = of_robot(&live, args.robot.as_deref())?;
        let at = floor.point(&args.start)?;
        may_begin(&floor, at)?;
        let stage = Stage::new(&floor, &Judges::new(&live.asked(), &floor.told)?)?;
        let shapes = vec![Outline { name: robot, radius_m: floor.network.disc.radius, length_m: None }];
        let shape = shape(args, &shapes, &[0])?;
        let made = || stage.body(&mission(at));
        return Robot { args, shapes, shape, senses: stage.senses(), made: &made }.answer();
    }
    let ground = Ground::of(&live.fork(), args.robot.as_deref())?;
    let at = point(&live, &args.start)?;
    let mut fitting: Vec<usize> =
        ground.fitting(&live.fork(), at)?.iter().map(|stance| ground.buildings[*stance].shape).collect();
    fitting.dedup();
    let shapes = ground.outlines.clone();
    let shape = shape(args, &shapes, &fitting)?;
    let (on, outfit) = ground.stage(ground.stance_at(shape, heading));
    let senses = (outfit.robot.sonar_range_m, outfit.robot.has_skirt);
    let made = || mission(at).body(&on, &outfit).map_err(Error::of(Code::SimulateImpossible));
    Robot { args, shapes, shape, senses, made: &made }.answer()
}

/// The shape in which it begins: one of those that fit.
fn shape(args: &BodyArgs, shapes: &[Outline], fitting: &[usize]) -> Result<usize> {
    let Some(state) = &args.state else { return Ok(fitting[0]) };
    fitting.iter().copied().find(|shape| shapes[*shape].name == *state).ok_or_else(|| {
        let all: Vec<&str> = fitting.iter().map(|shape| shapes[*shape].name.as_str()).collect();
        let message =
            format!("the robot does not fit there in a state `{state}`; it fits in {}", all.join(", "));
        Error::said(Code::SimulateImpossible, message, None)
    })
}

/// A robot that begins anew for each who drives it.
struct Robot<'r> {
    args: &'r BodyArgs,
    shapes: Vec<Outline>,
    /// In which it begins, by number.
    shape: usize,
    /// How far it hears, and whether it has a skirt.
    senses: (f64, bool),
    made: &'r dyn Fn() -> Result<Simulator>,
}

impl Robot<'_> {
    fn answer(&self) -> Result<()> {
        let Some(address) = &self.args.listen else {
            return self.serve(stdin().lock(), stdout().lock());
        };
        let cannot = |error: io::Error| {
            Error::said(Code::BodyListen, format!("cannot listen at {address}: {error}"), None)
        };
        let listener = TcpListener::bind(address).map_err(cannot)?;
        remark(&format!("listening at tcp://{}", listener.local_addr().map_err(cannot)?));
        loop {
            let (stream, _) = listener.accept().map_err(cannot)?;
            stream.set_nodelay(true).map_err(cannot)?;
            self.serve(BufReader::new(stream.try_clone().map_err(cannot)?), stream)?;
        }
    }

    fn serve(&self, mut input: impl BufRead, mut output: impl Write) -> Result<()> {
        let body = (self.made)()?;
        let mut before = body.pose().at;
        let mut host = Host::new(body, (self.shapes.clone(), self.shape), self.senses);
        let mut trip = Trip::begun(before, self.shape, self.shapes.len());
        let mut deepest_m = f64::NEG_INFINITY;
        let served = host.serve(&mut input, &mut output, |body| {
            let at = body.pose().at;
            let advance = Advance { metres: before.distance(at), seconds: 0.0, is_under_way: false };
            trip.note(&advance, (at, body.shape()), None, &[]);
            before = at;
            deepest_m = deepest_m.max(body.overlap_m());
        });
        if let Err(error) = served {
            // who drives it hung up
            remark(&format!("the link is over: {error}"));
        }
        self.tell(&host.body, &trip, deepest_m)
    }

    /// Writes the truth down, where that is wanted.
    fn tell(&self, body: &Simulator, trip: &Trip, deepest_m: f64) -> Result<()> {
        let Some(file) = &self.args.truth else { return Ok(()) };
        let pose = body.pose();
        let metres: serde_json::Map<_, _> = self
            .shapes
            .iter()
            .zip(&trip.metres)
            .filter(|(_, metres)| **metres > 0.0)
            .map(|(state, metres)| (state.name.clone(), json!(metres)))
            .collect();
        let truth = json!({
            "x": pose.at.x, "y": pose.at.y, "heading": pose.heading.to_degrees(),
            "state": self.shapes[body.shape()].name, "length": trip.path_m(),
            "by_state": metres, "touches": body.touches().iter().filter(|touch| touch.by_robot).count(),
            "overlap": deepest_m.is_finite().then_some(deepest_m), "seconds": body.time_s(),
        });
        whole::write(file, format!("{truth}\n").as_bytes())
    }
}

/// Puts a body through what the protocol asks; `false` where it does not do all of it.
pub fn conform(args: &ConformArgs) -> Result<bool> {
    let link = Link::open(&args.body, timeout(args.timeout)?).map_err(Error::of(Code::BodyUnheard))?;
    let checks = examine(link);
    let has_held = checks.iter().all(|check| check.held != Some(false))
        && checks.iter().any(|check| check.held == Some(true));
    let answer = json!({"body": args.body, "held": has_held, "checks": checks});
    either(args.json, &answer, |_| show(&checks))?;
    Ok(has_held)
}

fn show(checks: &[Check]) {
    let word = |held| match held {
        Some(true) => "held",
        Some(false) => "NOT HELD",
        None => "not tried",
    };
    let cells = |check: &Check| vec![check.check.to_owned(), word(check.held).to_owned(), check.seen.clone()];
    table(&["check", "", "seen"], checks.iter().map(cells));
    let count = |held| checks.iter().filter(|check| check.held == held).count();
    line(&format!("{} held, {} not held, {} not tried", count(Some(true)), count(Some(false)), count(None)));
    for check in checks.iter().filter(|check| check.held == Some(false)) {
        line(&format!("{} asks: {}", check.check, check.asks));
    }
}
