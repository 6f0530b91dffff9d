//! What several verbs take.

use std::path::PathBuf;
use std::time::Duration;

use adit_db::history::Author;
use clap::Args;

use crate::error::{Code, Error, Result};

/// What every verb on a site takes.
#[derive(Args, Debug, Clone)]
pub struct SiteArgs {
    /// Folder of the site, or the file of a map of corridors, parts, walls, a cell or lanes alone
    pub site: PathBuf,
    /// The database, instead of `site.db` in the site's folder
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// Folder of *.rhai files, instead of the site's own or the shipped ones
    #[arg(long, value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// Where to go on a site, and who goes.
#[derive(Args, Debug)]
pub struct WayArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub start: String,
    /// A place, a room or `x,y`
    #[arg(allow_hyphen_values = true)]
    pub goal: String,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
}

#[derive(Args, Debug, Clone)]
#[allow(clippy::struct_excessive_bools)] // flags of a command line
pub struct SimulateArgs {
    /// Folder of a site whose rooms are cut by state, or whose map has walls; or such a map alone: a TOML file with `[floor_plan]`
    pub site: PathBuf,
    /// Where to start, a place or `x,y`; without START and GOAL missions with obstacles are drawn by chance
    #[arg(allow_hyphen_values = true, requires = "goal")]
    pub start: Option<String>,
    /// Where to go, likewise
    #[arg(allow_hyphen_values = true)]
    pub goal: Option<String>,
    /// Where the robot looks at first, in degrees
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub heading: f64,
    /// How many missions
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub missions: u32,
    /// Of chance; the same seed gives the same missions
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Folder of *.rhai files, instead of the site's own or the shipped ones
    #[arg(long, value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Which robot, where the site has several
    #[arg(long)]
    pub robot: Option<String>,
    /// Keep each mission with its journal in this database
    #[arg(long, value_name = "FILE")]
    pub db: Option<PathBuf>,
    /// On each mission that is drawn somebody carries the robot off once, of which it is told nothing
    #[arg(long, conflicts_with_all = ["start", "robots", "learn", "drive", "curve"])]
    pub kidnap: bool,
    /// So many robots at once, where rooms are cut by state: each drives from errand to errand, in the way of the others, and hears
    /// what they tell the site
    #[arg(long, value_name = "N", requires = "tell", conflicts_with_all = ["start", "film", "learn", "learned", "curve"],
          value_parser = clap::value_parser!(u8).range(2..=32))]
    pub robots: Option<u8>,
    /// Until when they set out on errands
    #[arg(long, value_name = "MINUTES", requires = "robots", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..))]
    pub minutes: u16,
    /// In so many doorways people open and shut doors meanwhile
    #[arg(long, value_name = "N", requires = "robots", default_value_t = 0)]
    pub doors: u8,
    /// Tell the site what the robot meets: which doorways it finds blocked (`DOORWAYS.blocked`), where rules decide what follows;
    /// what stands in its way, where rooms are cut by state, for an hour
    #[arg(long, conflicts_with_all = ["learn", "learned", "curve"])]
    pub tell: bool,
    /// Keep them in the site's own
    #[arg(long, conflicts_with = "db")]
    pub keep: bool,
    /// Instead of missions, learn the building, of which the robot knows nothing but where it starts, a place or `x,y`;
    /// with --db or --keep what was learned is kept
    #[arg(long, value_name = "START", allow_hyphen_values = true, conflicts_with_all = ["start", "curve", "learned", "drive"])]
    pub learn: Option<String>,
    /// The direction of exploration that the user points out: towards a place or `x,y`
    #[arg(long, value_name = "WHERE", allow_hyphen_values = true, requires = "learn")]
    pub towards: Option<String>,
    /// The robot knows of the building what was learned of it and stands in --db, or the site's own database
    #[arg(long, conflicts_with = "curve")]
    pub learned: bool,
    /// The database in which what was learned stands.
    #[arg(skip)]
    pub learned_in: Option<PathBuf>,
    /// Instead of missions, drive by hand in the learned building: a file of orders, or `-` for standard input
    #[arg(long, value_name = "FILE", requires = "learned", conflicts_with_all = ["start", "film"])]
    pub drive: Option<PathBuf>,
    /// Instead of missions, drive from stop to stop, and draw how wrong the estimated pose is over the distance: .svg or
    /// .png; on a floor plan with the walls known and with a model built on the way. --missions says how many drives of each
    #[arg(long, value_name = "FILE", conflicts_with_all = ["start", "db", "keep", "film"])]
    pub curve: Option<PathBuf>,
    /// How far such a drive goes
    #[arg(long, value_name = "METRES", default_value_t = 200.0)]
    pub metres: f64,
    /// Make a film of a mission: an animated SVG
    #[arg(long, value_name = "FILE")]
    pub film: Option<PathBuf>,
    /// Which mission is filmed
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    pub mission: usize,
    /// How many times as fast as time the film plays
    #[arg(long, value_name = "TIMES", default_value_t = 8.0)]
    pub speed: f64,
    /// Print a row a mission as JSON
    #[arg(long)]
    pub json: bool,
}

/// How long an answer is waited for.
pub fn timeout(seconds: f64) -> Result<Duration> {
    const MOST_S: f64 = 3600.0;
    if seconds > 0.0 && seconds <= MOST_S {
        return Ok(Duration::from_secs_f64(seconds));
    }
    let message =
        format!("--timeout {seconds:?} is no time; expected seconds, more than 0 and at most {MOST_S}");
    Err(Error::said(Code::BodyTimeout, message, None))
}

/// The heading at the start, radians.
pub fn heading(degrees: f64) -> Result<f64> {
    if (-360.0..=360.0).contains(&degrees) {
        return Ok(degrees.to_radians());
    }
    let message = format!("--heading {degrees:?} is no heading; expected degrees from -360 to 360");
    Err(Error::said(Code::SimulateHeading, message, None))
}

/// Whoever runs the program.
pub fn author(why: &str) -> Author {
    let who = std::env::var("USER").or_else(|_| std::env::var("LOGNAME"));
    Author { who: who.unwrap_or_else(|_| "cli".to_owned()), why: why.to_owned() }
}
