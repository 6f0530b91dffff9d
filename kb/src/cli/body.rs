//! `adit body`: our simulated robot as others hear it, by lines of JSON. `adit conform`: whether a body does what the protocol
//! asks.

use std::io::{self, BufRead, BufReader, Write, stdin, stdout};
use std::net::TcpListener;
use std::path::PathBuf;

use adit_planners::navigation::{Log, Mission};
use adit_planners::pose::Pose;
use adit_planners::simulator::Simulator;
use clap::Args;
use serde_json::json;

use super::args::{SiteArgs, heading, timeout};
use super::build::open;
use super::output::{either, line, remark, table};
use super::routed::point;
use crate::body::conform::{Check, conform as examine};
use crate::body::{Host, Link};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::navigation::ground::Ground;
use crate::site::whole;

#[derive(Args, Debug)]
pub struct BodyArgs {
    /// Folder of a site whose rooms are cut by state
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
    let ground = Ground::of(&live.fork(), args.robot.as_deref())?;
    let at = point(&live, &args.start)?;
    let shape = shape(args, &ground, &ground.fitting(&live.fork(), at)?)?;
    let mission = Mission { start: Pose { at, heading }, goal: at, obstacles: Vec::new(), seed: args.seed };
    let robot = Robot { args, ground: &ground, shape, mission };
    let Some(address) = &args.listen else {
        return robot.serve(stdin().lock(), stdout().lock());
    };
    let cannot = |error: io::Error| {
        Error::said(Code::BodyListen, format!("cannot listen at {address}: {error}"), None)
    };
    let listener = TcpListener::bind(address).map_err(cannot)?;
    remark(&format!("listening at tcp://{}", listener.local_addr().map_err(cannot)?));
    loop {
        let (stream, _) = listener.accept().map_err(cannot)?;
        stream.set_nodelay(true).map_err(cannot)?;
        robot.serve(BufReader::new(stream.try_clone().map_err(cannot)?), stream)?;
    }
}

/// The shape in which it begins.
fn shape(args: &BodyArgs, ground: &Ground, fitting: &[usize]) -> Result<usize> {
    let Some(state) = &args.state else { return Ok(fitting[0]) };
    let fits = |shape: &usize| ground.states[*shape] == *state;
    fitting.iter().copied().find(fits).ok_or_else(|| {
        let all: Vec<&str> = fitting.iter().map(|shape| ground.states[*shape].as_str()).collect();
        let message = format!(
            "{} does not fit there in a state `{state}`; it fits in {}",
            ground.robot,
            all.join(", ")
        );
        Error::said(Code::SimulateImpossible, message, None)
    })
}

/// A robot that begins anew for each who drives it.
struct Robot<'r> {
    args: &'r BodyArgs,
    ground: &'r Ground,
    shape: usize,
    mission: Mission,
}

impl Robot<'_> {
    fn serve(&self, mut input: impl BufRead, mut output: impl Write) -> Result<()> {
        let (on, outfit) = self.ground.stage(self.shape);
        let body = self.mission.body(&on, &outfit).map_err(Error::of(Code::SimulateImpossible))?;
        let figures = (outfit.robot.sonar_range_m, outfit.robot.has_skirt);
        let mut host = Host::new(body, (self.ground.outlines(), self.shape), figures);
        let mut log = Log::begun(self.mission.start.at, self.shape, self.ground.states.len());
        let (mut before, mut deepest_m) = (self.mission.start.at, f64::NEG_INFINITY);
        let served = host.serve(&mut input, &mut output, |body| {
            let at = body.pose().at;
            log.note(before.distance(at), at, body.shape());
            before = at;
            deepest_m = deepest_m.max(body.overlap_m());
        });
        if let Err(error) = served {
            // who drives it hung up
            remark(&format!("the link is over: {error}"));
        }
        self.tell(&host.body, &log, deepest_m)
    }

    /// Writes the truth down, where that is wanted.
    fn tell(&self, body: &Simulator, log: &Log, deepest_m: f64) -> Result<()> {
        let Some(file) = &self.args.truth else { return Ok(()) };
        let pose = body.pose();
        let metres: serde_json::Map<_, _> = self
            .ground
            .states
            .iter()
            .zip(&log.metres)
            .filter(|(_, metres)| **metres > 0.0)
            .map(|(state, metres)| (state.clone(), json!(metres)))
            .collect();
        let truth = json!({
            "x": pose.at.x, "y": pose.at.y, "heading": pose.heading.to_degrees(),
            "state": self.ground.states[body.shape()], "length": log.metres.iter().sum::<f64>(),
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
